use super::{Movement, Verdict, upright::Turn};
use crate::{Body, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// Watches the posture of a body with legs: how far its torso turns from its start, how low it sinks, and whether anything
/// but a foot touches the ground. Its value is the way the torso made out of posture, m, forwards or backwards: all way where
/// one of the limits is broken, and otherwise the square of the tilt's share of its limit, so that a search is drawn towards
/// an upright gait before it meets a limit. With a weight of −1 such way earns nothing. It ends the episode of a body that is
/// far out of posture.
///
/// Between limit and end there is room: a search that ends at the first stumble never learns to run. Legless bodies are left alone.
/// On uneven ground the torso may sink as low as it likes.
#[derive(Clone, Debug, Default)]
pub struct Posture {
    settings: PostureSettings,
    legless: bool,
    uneven_ground: bool,
    others: Vec<usize>,
    turn: Turn,
    time: f32,
    start: f32,
    x: f32,
    way: f32,
    /// How long parts that are no feet have touched the ground since they last left it, s.
    touched: f32,
}

/// Settings of [`Posture`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PostureSettings {
    /// The farthest the torso may turn, degrees; above 0, default 40.
    pub tilt: f32,
    /// So much farther it may turn before the episode ends, degrees; from 0 to 180, default 20.
    pub margin: f32,
    /// The lowest the torso may get, as a share of its start height; from 0 to 1, default 0.65. At three quarters of it the
    /// episode ends.
    pub height: f32,
    /// How long parts that are no feet may touch the ground at a time before the episode ends, s; from 0 to 1, default 0.2.
    pub brush: f32,
}

impl Default for PostureSettings {
    fn default() -> Self {
        Self { tilt: 40.0, margin: 20.0, height: 0.65, brush: 0.2 }
    }
}

/// The share of the lowest height at which a body has fallen.
const LYING: f32 = 0.75;

impl Posture {
    /// With these settings.
    ///
    /// # Errors
    /// If one is out of range.
    pub fn new(settings: PostureSettings) -> Result<Self, SettingError> {
        if !(settings.tilt.is_finite() && settings.tilt > 0.0) {
            return Err(SettingError::new("tilt", settings.tilt, "finite and above 0"));
        }
        SettingError::check_range("margin", settings.margin, 0.0, 180.0)?;
        SettingError::check_range("height", settings.height, 0.0, 1.0)?;
        SettingError::check_range("brush", settings.brush, 0.0, 1.0)?;
        Ok(Self { settings, ..Self::default() })
    }
}

impl Movement for Posture {
    fn name(&self) -> &str {
        "posture"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.legless = body.legless || body.legs.is_empty();
        self.uneven_ground = body.uneven_ground;
        self.others = body.parts_without_feet();
    }

    fn begin(&mut self, start: &Snapshot) {
        self.turn = Turn::from(start.torso());
        self.start = start.torso().y;
        (self.time, self.x) = (start.time, start.torso().x);
        (self.touched, self.way) = (0.0, 0.0);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if self.legless {
            return Verdict::GoOn;
        }
        self.turn.follow(now.torso());
        let seconds = now.time - self.time;
        self.time = now.time;
        let touches = self.others.iter().any(|&part| now.parts[part].touching);
        self.touched = if touches { self.touched + seconds } else { 0.0 };
        let PostureSettings { tilt, margin, height, brush } = self.settings;
        let turned = self.turn.angle.abs().to_degrees();
        let share = if self.uneven_ground { 1.0 } else { now.torso().y / self.start };
        let out = if touches || share < height { 1.0 } else { (turned / tilt).min(1.0) };
        self.way += out * out * (now.torso().x - self.x).abs();
        self.x = now.torso().x;
        if turned > tilt + margin || share < LYING * height || self.touched > brush {
            Verdict::End
        } else {
            Verdict::GoOn
        }
    }

    fn value(&self) -> f64 {
        self.way.into()
    }
}
