//! How long each part of a step takes.

use std::time::Instant;

/// Where the time of a creature's step goes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    /// For each part.
    pub(crate) seconds: [f64; Part::ALL.len()],
}

/// A part of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    SenseAndThink,
    FindContacts,
    Fall,
    PrepareJoints,
    PrepareContacts,
    SolveJoints,
    SolveContacts,
    Move,
    RelaxJoints,
    RelaxContacts,
    Measure,
}

impl Part {
    pub(crate) const ALL: [(Self, &'static str); 11] = [
        (Self::SenseAndThink, "sense and think"),
        (Self::FindContacts, "find contacts"),
        (Self::Fall, "fall"),
        (Self::PrepareJoints, "prepare joints"),
        (Self::PrepareContacts, "prepare contacts"),
        (Self::SolveJoints, "solve joints"),
        (Self::SolveContacts, "solve contacts"),
        (Self::Move, "move"),
        (Self::RelaxJoints, "relax joints"),
        (Self::RelaxContacts, "relax contacts"),
        (Self::Measure, "measure"),
    ];
}

/// A stopwatch that is told when a part of a step is done.
pub(crate) struct Laps {
    pub(crate) profile: Profile,
    last: Instant,
    /// What looking at the clock takes, s.
    look: f64,
}

impl Laps {
    pub(crate) fn start() -> Self {
        const LOOKS: u32 = 100;
        let mut look = f64::INFINITY;
        for _ in 0..LOOKS {
            let mut laps = Self { profile: Profile::default(), last: Instant::now(), look: 0.0 };
            for _ in 0..LOOKS {
                laps.lap(Part::Fall);
            }
            // The fastest counts: the operating system interrupts the others.
            look = look.min(laps.profile.seconds.iter().sum::<f64>() / f64::from(LOOKS));
        }
        Self { profile: Profile::default(), last: Instant::now(), look }
    }

    /// Not inlined: training has no stopwatch, and no code for one in the middle of the solver.
    #[inline(never)]
    pub(crate) fn lap(&mut self, part: Part) {
        let now = Instant::now();
        self.profile.seconds[part as usize] += now.duration_since(self.last).as_secs_f64() - self.look;
        self.last = now;
    }
}

impl Profile {
    /// The name of each part of a step, and the µs it takes for one creature.
    pub fn parts(&self) -> impl Iterator<Item = (&'static str, f64)> + '_ {
        Part::ALL.iter().map(|&(part, name)| (name, 1e6 * self.seconds[part as usize]))
    }

    /// The µs that physics takes for a creature's step: all but sensing, thinking and measuring.
    pub fn physics(&self) -> f64 {
        let rest = [Part::SenseAndThink, Part::Measure].map(|part| self.seconds[part as usize]);
        1e6 * (self.seconds.iter().sum::<f64>() - rest.iter().sum::<f64>())
    }
}
