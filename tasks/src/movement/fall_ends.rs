use super::{Movement, Verdict};
use crate::Snapshot;

/// Ends the episode when the torso touches the ground. Its value is 1 if that happened and 0 if not, so that a weight
/// can also charge for it.
///
/// Not for creatures whose torso rests on the ground, such as the apod: theirs would end at the first step.
#[derive(Clone, Debug, Default)]
pub struct FallEnds {
    fallen: bool,
}

impl Movement for FallEnds {
    fn name(&self) -> &str {
        "fall-ends"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn begin(&mut self, _: &Snapshot) {
        self.fallen = false;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.fallen |= now.torso().touching;
        if self.fallen { Verdict::End } else { Verdict::GoOn }
    }

    fn value(&self) -> f64 {
        f64::from(u8::from(self.fallen))
    }
}
