use super::{Movement, Verdict};
use crate::{Body, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// How far the torso gets beyond what a wanted speed would take it, m. Weigh it negatively, but by less than 1, so that
/// more speed still counts, but less than a safer gait.
#[derive(Clone, Debug, Default)]
pub struct Haste {
    settings: HasteSettings,
    /// m/s.
    speed: f32,
    start: f32,
    x: f32,
    begun: f32,
    time: f32,
}

/// Settings of [`Haste`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HasteSettings {
    /// The speed up to which all way counts, body lengths/s; above 0, default 2.
    pub speed: f32,
}

impl Default for HasteSettings {
    fn default() -> Self {
        Self { speed: 2.0 }
    }
}

impl Haste {
    /// With these settings.
    ///
    /// # Errors
    /// If the speed is not above 0.
    pub fn new(settings: HasteSettings) -> Result<Self, SettingError> {
        if !(settings.speed.is_finite() && settings.speed > 0.0) {
            return Err(SettingError::new("speed", settings.speed, "finite and above 0"));
        }
        Ok(Self { settings, ..Self::default() })
    }
}

impl Movement for Haste {
    fn name(&self) -> &str {
        "haste"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.speed = self.settings.speed * body.body_length;
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.start, self.x) = (start.torso().x, start.torso().x);
        (self.begun, self.time) = (start.time, start.time);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        (self.x, self.time) = (now.torso().x, now.time);
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        f64::from((self.x - self.start).abs() - self.speed * (self.time - self.begun)).max(0.0)
    }
}
