use super::{Movement, Verdict};
use crate::Snapshot;

/// The work of all motors, in J (see [`Snapshot::motor_work`]). A cost: give it a negative weight.
#[derive(Clone, Debug, Default)]
pub struct Energy {
    start: f64,
    now: f64,
}

impl Movement for Energy {
    fn name(&self) -> &str {
        "energy"
    }

    fn unit(&self) -> &str {
        "J"
    }

    fn begin(&mut self, start: &Snapshot) {
        self.start = start.motor_work;
        self.now = self.start;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.now = now.motor_work;
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.now - self.start
    }
}
