use super::{Movement, Verdict};
use crate::{Body, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// How far the torso has come at a walk, in m: at a given speed, and without flying.
///
/// What counts is the way forwards in each half second. Up to the target speed it counts in full; what is beyond it is
/// taken off again, so that at twice the speed nothing is left, and beyond that less. Half seconds are worth most if all
/// are alike: what is missing in one cannot be made up for in another. In a walk some part is always on the ground: what
/// a half second earns is reduced by twice the share of it that was spent in the air. Standing is worth 0, going backwards
/// less.
#[derive(Clone, Debug)]
pub struct Walking {
    speed: f64,
    body_length: Option<f32>,
    /// Where this half second began, m, and when, s.
    from: f32,
    since: f32,
    x: f32,
    time: f32,
    /// Of this half second, s.
    aloft: f32,
    walked: f64,
}

/// Settings of [`Walking`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct WalkingSettings {
    /// How fast it is to walk, body lengths a second; from 0 to 100, default 1.
    pub speed: f64,
}

/// s.
const PERIOD: f32 = 0.5;

impl Default for WalkingSettings {
    fn default() -> Self {
        Self { speed: 1.0 }
    }
}

impl Walking {
    /// With these settings.
    ///
    /// # Errors
    /// If the speed is out of range.
    pub fn new(settings: WalkingSettings) -> Result<Self, SettingError> {
        SettingError::check_range("speed", settings.speed, 0.0, 100.0)?;
        Ok(Self { speed: settings.speed, ..Self::default() })
    }

    /// What the half second under way has earned, m.
    fn earned(&self) -> f64 {
        let seconds = f64::from(self.time) - f64::from(self.since);
        let way = f64::from(self.x) - f64::from(self.from);
        let target = self.speed * f64::from(self.body_length.unwrap_or(1.0)) * seconds;
        let earned = way.min(2.0 * target - way);
        if earned <= 0.0 { earned } else { earned * (1.0 - 2.0 * f64::from(self.aloft) / seconds).max(0.0) }
    }
}

impl Default for Walking {
    fn default() -> Self {
        let WalkingSettings { speed } = WalkingSettings::default();
        Self { speed, body_length: None, from: 0.0, since: 0.0, x: 0.0, time: 0.0, aloft: 0.0, walked: 0.0 }
    }
}

impl Movement for Walking {
    fn name(&self) -> &str {
        "walking"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.body_length = Some(body.body_length);
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.from, self.x) = (start.torso().x, start.torso().x);
        (self.since, self.time) = (start.time, start.time);
        (self.aloft, self.walked) = (0.0, 0.0);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if self.time - self.since >= PERIOD {
            self.walked += self.earned();
            (self.from, self.since, self.aloft) = (self.x, self.time, 0.0);
        }
        if now.aloft() {
            self.aloft += now.time - self.time;
        }
        (self.x, self.time) = (now.torso().x, now.time);
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.walked + self.earned()
    }
}
