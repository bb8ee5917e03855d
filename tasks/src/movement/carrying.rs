use super::{Movement, Verdict};
use crate::{Body, PartState, Snapshot};

/// How far the torso has come forwards as if it carried a full glass, in m: each bit of the way counts the less, the more
/// the torso is tilted and the faster it moves up or down meanwhile. At 10° of tilt against the start, or at 0.25 body
/// lengths a second up or down, a metre is worth half. For level ground.
///
/// Ways back count in full, so that nothing is gained by going forwards level and backwards tilted; standing earns nothing.
#[derive(Clone, Debug, Default)]
pub struct Carrying {
    body_length: Option<f32>,
    start: PartState,
    x: f32,
    carried: f64,
}

/// The sine of the tilt at which a metre is worth half: of 10°.
const TILT: f64 = 0.1736;
/// The speed up or down at which a metre is worth half, body lengths a second.
const SHAKING: f64 = 0.25;

impl Movement for Carrying {
    fn name(&self) -> &str {
        "carrying"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.body_length = Some(body.body_length);
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.start, self.x, self.carried) = (*start.torso(), start.torso().x, 0.0);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let torso = now.torso();
        let way = f64::from(torso.x) - f64::from(self.x);
        self.x = torso.x;
        self.carried += if way > 0.0 { way * self.level(torso) } else { way };
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.carried
    }
}

impl Carrying {
    /// What a metre is worth, 0 to 1.
    fn level(&self, torso: &PartState) -> f64 {
        let cos = f64::from(self.start.cos * torso.cos + self.start.sin * torso.sin);
        let sin = f64::from(self.start.cos * torso.sin - self.start.sin * torso.cos);
        if cos <= 0.0 {
            return 0.0;
        }
        let (tilt, shaking) = (sin / TILT, f64::from(torso.vy) / (SHAKING * self.body_length.map_or(1.0, f64::from)));
        1.0 / ((1.0 + tilt * tilt) * (1.0 + shaking * shaking))
    }
}
