use super::{Movement, Verdict};
use crate::Snapshot;

/// How far the torso has come: its x at the end minus its x at the start, in m. Backwards is negative.
///
/// The fitness of the reference system (Gegendorfer 2017) for running.
#[derive(Clone, Debug, Default)]
pub struct Running {
    start: f32,
    now: f32,
}

impl Movement for Running {
    fn name(&self) -> &str {
        "running"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn begin(&mut self, start: &Snapshot) {
        self.start = start.torso().x;
        self.now = self.start;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.now = now.torso().x;
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        f64::from(self.now) - f64::from(self.start)
    }
}
