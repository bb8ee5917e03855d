use super::{Movement, Verdict, upright::Turn};
use crate::{Body, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// Ends the episode of a body with legs when it loses its posture: when its torso turns too far from its start, sinks too
/// low, or when anything but a foot touches the ground. Its value is 1 if that happened and 0 if not.
///
/// A brush is forgiven, since a gait may brush the ground a little. Legless bodies are left alone. On uneven
/// ground the torso may sink as low as it likes.
#[derive(Clone, Debug, Default)]
pub struct Posture {
    settings: PostureSettings,
    legless: bool,
    uneven_ground: bool,
    others: Vec<usize>,
    turn: Turn,
    lowest: f32,
    time: f32,
    /// How long parts that are no feet have touched the ground since they last left it, s.
    touched: f32,
    lost: bool,
}

/// Settings of [`Posture`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PostureSettings {
    /// The farthest the torso may turn, degrees; above 0, default 40.
    pub tilt: f32,
    /// The lowest the torso may get, as a share of its start height; from 0 to 1, default 0.65.
    pub height: f32,
    /// How long a part that is no foot may touch the ground at a time, s; from 0 to 1, default 0.06, a brush.
    pub brush: f32,
}

impl Default for PostureSettings {
    fn default() -> Self {
        Self { tilt: 40.0, height: 0.65, brush: 0.06 }
    }
}

impl Posture {
    /// With these settings.
    ///
    /// # Errors
    /// If one is out of range.
    pub fn new(settings: PostureSettings) -> Result<Self, SettingError> {
        if !(settings.tilt.is_finite() && settings.tilt > 0.0) {
            return Err(SettingError::new("tilt", settings.tilt, "finite and above 0"));
        }
        SettingError::check_range("height", settings.height.into(), 0.0, 1.0)?;
        SettingError::check_range("brush", settings.brush.into(), 0.0, 1.0)?;
        Ok(Self { settings, ..Self::default() })
    }
}

impl Movement for Posture {
    fn name(&self) -> &str {
        "posture"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn meet(&mut self, body: &Body) {
        self.legless = body.legless || body.legs.is_empty();
        self.uneven_ground = body.uneven_ground;
        self.others = body.parts_without_feet();
    }

    fn begin(&mut self, start: &Snapshot) {
        self.turn = Turn::from(start.torso());
        self.lowest = self.settings.height * start.torso().y;
        (self.time, self.touched, self.lost) = (start.time, 0.0, false);
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
        self.lost |= self.turn.angle.abs() > self.settings.tilt.to_radians()
            || (!self.uneven_ground && now.torso().y < self.lowest)
            || self.touched > self.settings.brush;
        if self.lost { Verdict::End } else { Verdict::GoOn }
    }

    fn value(&self) -> f64 {
        f64::from(u8::from(self.lost))
    }
}
