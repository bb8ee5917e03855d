use super::{Movement, Verdict};
use crate::{Body, BodyPart, Snapshot};

/// How much higher the ground is on which the feet last stood, in m, the mean of all feet, and a fifth of the distance
/// the torso has come forwards. For stairs and slopes; down is negative.
///
/// A foot that is lifted keeps the height it stood on, so height cannot be had by jumping, rearing up or stretching, nor
/// by a foot that is held up at the end. Of a body without legs, or one that is not known, all parts count as feet.
#[derive(Clone, Debug, Default)]
pub struct Climbing {
    /// Which parts are feet, and their shapes; empty: nothing is known of the body.
    feet: Vec<(usize, BodyPart)>,
    /// How high above the lowest of the start each foot last stood, m.
    stood: Vec<f32>,
    ground: f32,
    start: f32,
    x: f32,
}

/// What a metre forwards is worth, in metres of height.
const FORWARDS: f64 = 0.2;

impl Movement for Climbing {
    fn name(&self) -> &str {
        "climbing"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        let with_shape = |part: usize| (part, body.parts[part].clone());
        self.feet = match body.legless || body.legs.is_empty() {
            true => (0..body.parts.len()).map(with_shape).collect(),
            false => body.feet().map(with_shape).collect(),
        };
    }

    fn begin(&mut self, start: &Snapshot) {
        let count = if self.feet.is_empty() { start.parts.len() } else { self.feet.len() };
        self.ground = (0..count).map(|foot| self.sole(foot, start).0).fold(f32::INFINITY, f32::min);
        self.stood.clear();
        self.stood.resize(count, 0.0);
        (self.start, self.x) = (start.torso().x, start.torso().x);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.x = now.torso().x;
        for foot in 0..self.stood.len() {
            let (height, touching) = self.sole(foot, now);
            if touching {
                self.stood[foot] = height - self.ground;
            }
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        let climbed = self.stood.iter().copied().map(f64::from).sum::<f64>() / self.stood.len().max(1) as f64;
        climbed + FORWARDS * (f64::from(self.x) - f64::from(self.start))
    }
}

impl Climbing {
    /// How high the lowest point of a foot is, and whether it touches the ground.
    fn sole(&self, foot: usize, now: &Snapshot) -> (f32, bool) {
        match self.feet.get(foot) {
            Some((index, part)) => (part.lowest_point(&now.parts[*index]), now.parts[*index].touching),
            None => (now.parts[foot].y, now.parts[foot].touching),
        }
    }
}
