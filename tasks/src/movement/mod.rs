//! Movements: what is rewarded, each in a file of its own.

mod alternation;
mod backwards;
mod carrying;
mod climbing;
mod cruising;
mod energy;
mod fall_ends;
mod flights;
mod foot;
mod footfalls;
mod getting_up;
mod haste;
mod headway;
mod hopping;
mod idleness;
mod jumping;
mod landing;
mod leap;
mod long_jump;
mod no_exploits;
mod objectives;
mod playing;
mod posture;
mod rhythm;
mod rollovers;
mod running;
mod slip;
mod standing;
mod sum;
mod swimming;
mod time_aloft;
mod upright;
mod vibration;
mod walking;

pub use {
    alternation::Alternation,
    backwards::Backwards,
    carrying::Carrying,
    climbing::Climbing,
    cruising::{Cruising, CruisingSettings},
    energy::Energy,
    fall_ends::FallEnds,
    footfalls::Footfalls,
    getting_up::{GettingUp, GettingUpSettings},
    haste::{Haste, HasteSettings},
    headway::{Headway, HeadwaySettings},
    hopping::Hopping,
    idleness::Idleness,
    jumping::Jumping,
    landing::Landing,
    leap::Leap,
    long_jump::LongJump,
    no_exploits::{NoExploits, NoExploitsSettings},
    objectives::Objectives,
    playing::{Playing, PlayingSettings},
    posture::{Posture, PostureSettings},
    rhythm::{Rhythm, RhythmSettings},
    rollovers::Rollovers,
    running::Running,
    slip::Slip,
    standing::{Standing, StandingSettings},
    sum::Sum,
    swimming::Swimming,
    time_aloft::TimeAloft,
    upright::Upright,
    vibration::Vibration,
    walking::{Walking, WalkingSettings},
};

use crate::{Body, Snapshot};

/// Turns an episode into a number: the fitness, or a term of it.
///
/// A movement is a small accumulator. [`begin`](Self::begin) is called once with the settled body, then
/// [`observe`](Self::observe) after each step, then [`value`](Self::value).
///
/// An implementor owes:
/// - `begin` forgets everything of an earlier episode;
/// - `value` depends on the snapshots since `begin` alone, and may be asked at any time after it;
/// - `observe` allocates nothing.
///
/// Check yours with [`check_movement`](crate::conformance::check_movement).
///
/// The type must be `Clone` (each evaluation watches with a clone of its own); the rest of [`MovementClone`] follows.
pub trait Movement: MovementClone + Send + Sync {
    /// The name users choose it by: lower case, hyphens.
    fn name(&self) -> &str;

    /// The unit of the value: "m", "J", "s", "1" for a count.
    fn unit(&self) -> &str;

    /// Whose movement it will watch, if the environment knows: told before anything else, and before an episode in which
    /// the body weighs something else. What an earlier body was is forgotten. Most movements need not know.
    fn bind(&mut self, body: &Body) {
        let _ = body;
    }

    /// An episode begins with the body in this state.
    fn begin(&mut self, start: &Snapshot);

    /// A step has passed. Says whether the episode goes on.
    fn observe(&mut self, now: &Snapshot) -> Verdict;

    /// What the episode so far is worth; larger is better for whatever is a fitness of its own.
    fn value(&self) -> f64;

    /// Calls `tell` with the name and value of everything worth a measurement in the evaluation; by default the
    /// movement itself.
    fn measurements(&self, tell: &mut dyn FnMut(&str, f64)) {
        tell(self.name(), self.value());
    }

    /// Calls `tell` with each objective of a search for several, all to be maximised: as many, in the same order, each
    /// time. By default there are none, and the value is all there is to be had.
    fn objectives(&self, tell: &mut dyn FnMut(f64)) {
        let _ = tell;
    }
}

/// Whether an episode goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It goes on.
    GoOn,
    /// It ends here; the value is what it is now.
    End,
    /// What happens is not to be scored, for this reason: the evaluation fails.
    Fail(&'static str),
}

/// Clones a movement behind a box; every `Movement` that is `Clone` has it.
pub trait MovementClone {
    /// A boxed copy.
    fn boxed_clone(&self) -> Box<dyn Movement>;
}

impl<M: Movement + Clone + 'static> MovementClone for M {
    fn boxed_clone(&self) -> Box<dyn Movement> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Movement> {
    fn clone(&self) -> Self {
        (**self).boxed_clone()
    }
}
