use super::{Movement, Verdict};
use crate::Snapshot;
use std::f64::consts::{PI, TAU};

/// How often the torso has turned over: the number of times it got upside down in one direction, further than ever
/// before. Turning half round counts 1, one and a half times round 2; rocking back and forth counts no more. A cost:
/// give it a negative weight.
#[derive(Clone, Debug, Default)]
pub struct Rollovers {
    last: f64,
    turned: f64,
    furthest: f64,
}

impl Movement for Rollovers {
    fn name(&self) -> &str {
        "rollovers"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn begin(&mut self, start: &Snapshot) {
        *self = Self { last: f64::from(start.torso().angle()), turned: 0.0, furthest: 0.0 };
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let angle = f64::from(now.torso().angle());
        // The shorter way round from the last angle: a torso turns less than half round in a step.
        let mut turn = angle - self.last;
        if turn > PI {
            turn -= TAU;
        } else if turn < -PI {
            turn += TAU;
        }
        self.last = angle;
        self.turned += turn;
        self.furthest = self.furthest.max(self.turned.abs());
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        ((self.furthest + PI) / TAU).floor()
    }
}
