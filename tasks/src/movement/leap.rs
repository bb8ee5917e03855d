use super::{Movement, Verdict};
use crate::{Body, Snapshot};

/// How high the centre of mass rises above its start in a leap, m: in a flight of at least 0.22 s that all legs began
/// together. 0 without one.
///
/// All of the rise counts if each leg lost the ground within 0.12 s of the others. Otherwise less than half does, and nothing
/// if one did 0.4 s before: a search that earns nothing before all is right never gets there, and one that earns much has no
/// reason to. And all of that counts only of a flight whose landing the body survives: one that is still in its episode 0.3 s
/// after it touched down, or leaps again. Of the others a quarter does, or searches would leap high and fall. For the same
/// reason a quarter counts of what is higher than half of the start height, or 0.4 body lengths for a body without legs.
///
/// [`Jumping`](super::Jumping) also counts a torso that is lifted by a body that only stretches.
#[derive(Clone, Debug, Default)]
pub struct Leap {
    masses: Vec<f32>,
    feet: Vec<usize>,
    /// A rise beyond this counts for little, m.
    enough: f32,
    start: f32,
    down: Vec<bool>,
    left: Vec<f32>,
    /// Since when no part touches the ground, and how much of a leap the beginning of the flight was, 0 to 1.
    flight: Option<(f32, f32)>,
    rise: f32,
    /// When the last flight came down, and what it is worth, m.
    landed: Option<(f32, f32)>,
    best: f32,
}

/// s.
const TOGETHER: f32 = 0.12;
/// s.
const APART: f32 = 0.4;
/// The share of the rise that counts of a leap that legs begin just too far apart.
const UNEVEN: f32 = 0.4;
/// Start heights.
const ENOUGH: f32 = 0.5;
/// Of a body without legs, body lengths.
const ENOUGH_LEGLESS: f32 = 0.4;
/// The share that counts of what is beyond enough.
const BEYOND: f32 = 0.25;
/// A flight shorter than this is a stumble, s.
const SHORTEST: f32 = 0.22;
/// How long after a flight the body has to last, s.
const SETTLED: f32 = 0.3;
/// The share of the rise that counts of a flight whose landing is not survived.
const FALLEN: f32 = 0.25;

impl Leap {
    /// What counts of the rise so far, m.
    fn counted(&self) -> f32 {
        let enough = if self.enough > 0.0 { self.enough } else { f32::INFINITY };
        self.rise.min(enough) + BEYOND * (self.rise - enough).max(0.0)
    }

    /// How far the flight under way has risen, m, and how much of a leap it is, 0 to 1; if it lasts long enough to be one.
    pub(super) fn under_way(&self, now: &Snapshot) -> Option<(f32, f32)> {
        let (since, share) = self.flight?;
        (now.time - since >= SHORTEST).then_some((self.rise, share))
    }
}

impl Movement for Leap {
    fn name(&self) -> &str {
        "leap"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.enough = if body.legless { ENOUGH_LEGLESS * body.body_length } else { ENOUGH * body.start_height };
        self.masses = body.parts.iter().map(|part| part.mass).collect();
        self.feet = if body.legless { Vec::new() } else { body.feet().collect() };
        self.down = vec![true; self.feet.len()];
        self.left = vec![0.0; self.feet.len()];
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.start, self.rise, self.best) = (centre_height(&self.masses, start), 0.0, 0.0);
        (self.flight, self.landed) = (None, None);
        for (index, &foot) in self.feet.iter().enumerate() {
            self.down[index] = start.parts[foot].touching;
            self.left[index] = start.time - 10.0;
        }
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        for (index, &foot) in self.feet.iter().enumerate() {
            let touching = now.parts[foot].touching;
            if self.down[index] && !touching {
                self.left[index] = now.time;
            }
            self.down[index] = touching;
        }
        if !now.aloft() {
            if let Some((since, share)) = self.flight.take()
                && now.time - since >= SHORTEST
            {
                self.landed = Some((now.time, share * self.counted()));
            }
            self.rise = 0.0;
            if let Some((_, worth)) = self.landed.take_if(|(time, _)| now.time - *time >= SETTLED) {
                self.best = self.best.max(worth);
            }
            return Verdict::GoOn;
        }
        let first = self.left.iter().copied().fold(f32::INFINITY, f32::min);
        let apart = if self.feet.is_empty() { 0.0 } else { now.time - first };
        let uneven = UNEVEN * ((APART - apart) / (APART - TOGETHER)).max(0.0);
        let share = if apart <= TOGETHER { 1.0 } else { uneven };
        let (since, share) = *self.flight.get_or_insert((now.time, share));
        self.rise = self.rise.max(centre_height(&self.masses, now) - self.start);
        if now.time - since >= SHORTEST {
            // It leaps again: a foot that leaves the ground for a moment is no leap.
            if let Some((_, worth)) = self.landed.take() {
                self.best = self.best.max(worth);
            }
            self.best = self.best.max(FALLEN * share * self.counted());
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.best.into()
    }
}

/// The height of the centre of mass, m; of the torso where masses are not known.
fn centre_height(masses: &[f32], snapshot: &Snapshot) -> f32 {
    let total: f32 = masses.iter().sum();
    if masses.len() != snapshot.parts.len() || total <= 0.0 {
        return snapshot.torso().y;
    }
    masses.iter().zip(&snapshot.parts).map(|(mass, part)| mass * part.y).sum::<f32>() / total
}
