use super::{Movement, Verdict, upright::Turn};
use crate::Snapshot;

/// How much the torso sways: the standard deviation of its angle beyond 8°, in degrees. Weigh it negatively.
#[derive(Clone, Debug, Default)]
pub struct Sway {
    turn: Turn,
    sum: f64,
    squares: f64,
    count: f64,
}

/// Degrees.
const FREE: f64 = 8.0;

impl Movement for Sway {
    fn name(&self) -> &str {
        "sway"
    }

    fn unit(&self) -> &str {
        "°"
    }

    fn begin(&mut self, start: &Snapshot) {
        *self = Self { turn: Turn::from(start.torso()), ..Self::default() };
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.turn.follow(now.torso());
        let angle = f64::from(self.turn.angle);
        self.sum += angle;
        self.squares += angle * angle;
        self.count += 1.0;
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        if self.count == 0.0 {
            return 0.0;
        }
        let mean = self.sum / self.count;
        let deviation = (self.squares / self.count - mean * mean).max(0.0).sqrt();
        (deviation.to_degrees() - FREE).max(0.0)
    }
}
