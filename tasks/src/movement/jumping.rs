use super::{Movement, Verdict};
use crate::Snapshot;

/// How high the torso has been: its highest y minus its y at the start, in m; never negative.
///
/// The fitness of the reference system (Gegendorfer 2017) for jumping.
#[derive(Clone, Debug, Default)]
pub struct Jumping {
    start: f32,
    highest: f32,
}

impl Movement for Jumping {
    fn name(&self) -> &str {
        "jumping"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn begin(&mut self, start: &Snapshot) {
        self.start = start.torso().y;
        self.highest = self.start;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.highest = self.highest.max(now.torso().y);
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        f64::from(self.highest) - f64::from(self.start)
    }
}
