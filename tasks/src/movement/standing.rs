use super::{Movement, Verdict};
use crate::{Body, PartState, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// How long it stands still and upright, in s, counted from a given time on; what it does before is its own affair.
///
/// Each moment counts from 0 to 1, the product of three: *still* is 1 if no part moves, and a half if the fastest one moves
/// at 0.1 body lengths a second; *upright* is 1 in the start pose and 0 from 60° of tilt on; *up* is 1 if the torso is at
/// least 0.95 times as high as at the start and 0 at half of that height. A torso that lies on the ground counts 0, unless
/// it did so at the start, as that of an apod does. So neither lying still nor running upright is worth much. For level
/// ground.
#[derive(Clone, Debug)]
pub struct Standing {
    after: f64,
    body_length: Option<f32>,
    start: PartState,
    began: f32,
    time: f32,
    stood: f64,
}

/// Settings of [`Standing`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct StandingSettings {
    /// From when on it is to stand, s; from 0 to 1000, default 2. An episode that is shorter is worth nothing.
    pub after: f64,
}

/// At this speed, in body lengths a second, it is half as still as can be.
const RESTLESS: f64 = 0.1;
/// The cosine of the tilt from which on it is not upright: of 60°.
const TILTED: f64 = 0.5;
/// Of the start height.
const UP: f64 = 0.95;
const DOWN: f64 = 0.5;

impl Default for StandingSettings {
    fn default() -> Self {
        Self { after: 2.0 }
    }
}

impl Standing {
    /// With these settings.
    ///
    /// # Errors
    /// If the time is out of range.
    pub fn new(settings: StandingSettings) -> Result<Self, SettingError> {
        SettingError::check_range("after", settings.after, 0.0, 1000.0)?;
        Ok(Self { after: settings.after, ..Self::default() })
    }

    /// How much this moment is one of standing, 0 to 1.
    fn stands(&self, now: &Snapshot) -> f64 {
        let (start, torso) = (&self.start, now.torso());
        if torso.touching && !start.touching {
            return 0.0;
        }
        let cos = f64::from(start.cos * torso.cos + start.sin * torso.sin);
        let upright = ((cos - TILTED) / (1.0 - TILTED)).clamp(0.0, 1.0);
        let height = if start.y > 0.0 { f64::from(torso.y) / f64::from(start.y) } else { 1.0 };
        let up = ((height - DOWN) / (UP - DOWN)).clamp(0.0, 1.0);
        let square =
            |part: &PartState| f64::from(part.vx) * f64::from(part.vx) + f64::from(part.vy) * f64::from(part.vy);
        let fastest = now.parts.iter().map(square).fold(0.0, f64::max);
        let restless = RESTLESS * f64::from(self.body_length.unwrap_or(1.0));
        upright * up / (1.0 + fastest / (restless * restless))
    }
}

impl Default for Standing {
    fn default() -> Self {
        let StandingSettings { after } = StandingSettings::default();
        Self { after, body_length: None, start: PartState::default(), began: 0.0, time: 0.0, stood: 0.0 }
    }
}

impl Movement for Standing {
    fn name(&self) -> &str {
        "standing"
    }

    fn unit(&self) -> &str {
        "s"
    }

    fn bind(&mut self, body: &Body) {
        self.body_length = Some(body.body_length);
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.start, self.began, self.time, self.stood) = (*start.torso(), start.time, start.time, 0.0);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if f64::from(now.time) - f64::from(self.began) > self.after {
            self.stood += self.stands(now) * (f64::from(now.time) - f64::from(self.time));
        }
        self.time = now.time;
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.stood
    }
}
