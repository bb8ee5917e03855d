use super::{Movement, Verdict};
use crate::{Body, BodyHinge, Snapshot};

/// How fast joints turn back and forth, beyond what the eye likes to follow: for each actuated joint the reversals a
/// second above 8 (4 Hz), averaged over the joints. Weigh it negatively.
///
/// A joint reverses when it has turned back by more than 2° from its furthest angle.
#[derive(Clone, Debug, Default)]
pub struct Vibration {
    joints: Vec<Joint>,
    start: f32,
    time: f32,
}

#[derive(Clone, Debug, Default)]
struct Joint {
    hinge: BodyHinge,
    rising: bool,
    /// Cosine and sine of the furthest angle since the last reversal.
    furthest: [f32; 2],
    reversals: u32,
}

/// Reversals a second.
const MOST: f32 = 8.0;
/// The sine of 2°.
const NOTABLE: f32 = 0.035;

impl Movement for Vibration {
    fn name(&self) -> &str {
        "vibration"
    }

    fn unit(&self) -> &str {
        "1/s"
    }

    fn bind(&mut self, body: &Body) {
        self.joints = body.actuated().map(|hinge| Joint { hinge: hinge.clone(), ..Joint::default() }).collect();
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.start, self.time) = (start.time, start.time);
        for joint in &mut self.joints {
            (joint.furthest, joint.rising, joint.reversals) = (joint.hinge.direction(&start.parts), true, 0);
        }
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.time = now.time;
        for joint in &mut self.joints {
            let [cos, sin] = joint.hinge.direction(&now.parts);
            let [c, s] = joint.furthest;
            let turned = c * sin - s * cos;
            let ahead = if joint.rising { turned } else { -turned };
            if ahead > 0.0 {
                joint.furthest = [cos, sin];
            } else if ahead < -NOTABLE {
                joint.rising = !joint.rising;
                joint.furthest = [cos, sin];
                joint.reversals += 1;
            }
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        let seconds = self.time - self.start;
        if self.joints.is_empty() || seconds <= 0.0 {
            return 0.0;
        }
        let excess = |joint: &Joint| f64::from((joint.reversals as f32 / seconds - MOST).max(0.0));
        self.joints.iter().map(excess).sum::<f64>() / self.joints.len() as f64
    }
}
