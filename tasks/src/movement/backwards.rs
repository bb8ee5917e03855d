use super::{Movement, Verdict};
use crate::Snapshot;

/// How far the torso has come backwards: its x at the start minus its x at the end, in m. Forwards is negative.
///
/// [`Running`](super::Running) mirrored: what cannot be had by cheating there cannot be had here. Its gait is judged by
/// the rules of running, with backwards for forwards.
#[derive(Clone, Debug, Default)]
pub struct Backwards {
    start: f32,
    now: f32,
}

impl Movement for Backwards {
    fn name(&self) -> &str {
        "backwards"
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
        f64::from(self.start) - f64::from(self.now)
    }
}
