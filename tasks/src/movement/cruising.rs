use super::{Movement, Verdict};
use crate::{Body, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// How far the torso has come forwards, in m, up to a given speed and discounted by what it cost: thrifty running.
///
/// The value is *d* / (1 + *c*), where *d* is the distance, but at most the speed times the time, and *c* the motors' work
/// over weight times *d*: the cost of transport (Gabrielli & von Kármán 1950, *What price speed?*). A metre that costs
/// nothing is worth one, at a cost of transport of 1 it is worth half. What is faster than the speed earns nothing, and
/// its work is charged all the same. It is the whole distance that counts, so a slow start can be made up for.
///
/// Standing is worth 0, and so is work that gets nowhere. A body that falls over without any work is worth the distance
/// of its fall, and no more. Backwards is negative, whatever it cost.
#[derive(Clone, Debug)]
pub struct Cruising {
    speed: f64,
    body_length: f64,
    /// N; of a body that is not known, or has none, 1.
    weight: f64,
    start: Reading,
    now: Reading,
}

/// Settings of [`Cruising`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct CruisingSettings {
    /// How fast it is to be, body lengths a second; from 0 to 100, default 2.
    pub speed: f64,
}

/// What is read off at a moment.
#[derive(Clone, Copy, Debug, Default)]
struct Reading {
    /// s.
    time: f64,
    /// Of the torso, m.
    x: f64,
    /// Of all motors, J.
    work: f64,
}

impl Default for CruisingSettings {
    fn default() -> Self {
        Self { speed: 2.0 }
    }
}

impl Cruising {
    /// With these settings.
    ///
    /// # Errors
    /// If the speed is out of range.
    pub fn new(settings: CruisingSettings) -> Result<Self, SettingError> {
        SettingError::check_range("speed", settings.speed, 0.0, 100.0)?;
        Ok(Self { speed: settings.speed, ..Self::default() })
    }
}

impl Default for Cruising {
    fn default() -> Self {
        let CruisingSettings { speed } = CruisingSettings::default();
        Self { speed, body_length: 1.0, weight: 1.0, start: Reading::default(), now: Reading::default() }
    }
}

impl Movement for Cruising {
    fn name(&self) -> &str {
        "cruising"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.body_length = body.body_length.into();
        let weight = body.weight().abs();
        self.weight = if weight > 0.0 { weight } else { 1.0 };
    }

    fn begin(&mut self, start: &Snapshot) {
        self.start = Reading::read(start);
        self.now = self.start;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.now = Reading::read(now);
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        let wanted = self.speed * self.body_length * (self.now.time - self.start.time);
        let distance = (self.now.x - self.start.x).min(wanted);
        if distance <= 0.0 {
            return distance;
        }
        // The same as d / (1 + c), and not divided by a distance of nearly nothing.
        distance * distance / (distance + (self.now.work - self.start.work) / self.weight)
    }
}

impl Reading {
    fn read(now: &Snapshot) -> Self {
        Self { time: now.time.into(), x: now.torso().x.into(), work: now.motor_work }
    }
}
