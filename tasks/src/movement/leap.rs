use super::{Movement, Verdict};
use crate::{Body, Snapshot};

/// How high the centre of mass rises above its start in a true leap, m: in a flight of at least 0.22 s that all legs began
/// together, each losing the ground within 0.12 s of the others. 0 without one.
///
/// [`Jumping`](super::Jumping) also counts a torso that is lifted by a body that only stretches.
#[derive(Clone, Debug, Default)]
pub struct Leap {
    masses: Vec<f32>,
    feet: Vec<usize>,
    start: f32,
    down: Vec<bool>,
    left: Vec<f32>,
    /// Since when no part touches the ground, and whether the flight began as a leap.
    flight: Option<(f32, bool)>,
    rise: f32,
    best: f32,
}

/// s.
const TOGETHER: f32 = 0.12;
/// A flight shorter than this is a stumble, s.
const SHORTEST: f32 = 0.22;

impl Leap {
    /// How far the flight under way has risen, m, if it began as a leap and lasts long enough to be one.
    pub(super) fn under_way(&self, now: &Snapshot) -> Option<f32> {
        let (since, together) = self.flight?;
        (together && now.time - since >= SHORTEST).then_some(self.rise)
    }
}

impl Movement for Leap {
    fn name(&self) -> &str {
        "leap"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn meet(&mut self, body: &Body) {
        self.masses = body.parts.iter().map(|part| part.mass).collect();
        self.feet = if body.legless { Vec::new() } else { body.feet().collect() };
        self.down = vec![true; self.feet.len()];
        self.left = vec![0.0; self.feet.len()];
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.start, self.flight, self.rise, self.best) = (centre_height(&self.masses, start), None, 0.0, 0.0);
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
            self.flight = None;
            self.rise = 0.0;
            return Verdict::GoOn;
        }
        let first = self.left.iter().copied().fold(f32::INFINITY, f32::min);
        let (since, together) =
            *self.flight.get_or_insert((now.time, now.time - first <= TOGETHER || self.feet.is_empty()));
        self.rise = self.rise.max(centre_height(&self.masses, now) - self.start);
        if together && now.time - since >= SHORTEST {
            self.best = self.best.max(self.rise);
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
