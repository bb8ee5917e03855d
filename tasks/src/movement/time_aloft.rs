use super::{Movement, Verdict};
use crate::Snapshot;

/// How long no part touched the ground, in s, summed over the episode.
#[derive(Clone, Debug, Default)]
pub struct TimeAloft {
    last: f32,
    aloft: f64,
}

impl Movement for TimeAloft {
    fn name(&self) -> &str {
        "time-aloft"
    }

    fn unit(&self) -> &str {
        "s"
    }

    fn begin(&mut self, start: &Snapshot) {
        *self = Self { last: start.time, aloft: 0.0 };
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if now.aloft() {
            self.aloft += f64::from(now.time - self.last);
        }
        self.last = now.time;
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.aloft
    }
}
