use super::{Movement, Verdict};
use crate::{Body, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// Ends the episode when there is no headway: less than 0.2 body lengths forwards, or backwards if the settings say so, in
/// any one of its seconds, the first among them. Its value is 1 if that happened and 0 if not.
///
/// Standing safely on the spot is where searches for running get stuck; with this it lasts a second and earns nothing.
#[derive(Clone, Debug, Default)]
pub struct Headway {
    backwards: bool,
    least: f32,
    /// Where the torso was at the beginning of this second.
    x: f32,
    since: f32,
    stuck: bool,
}

/// Settings of [`Headway`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct HeadwaySettings {
    /// Whether the way to get ahead is backwards; default false.
    pub backwards: bool,
}

/// Body lengths a second.
const LEAST_SPEED: f32 = 0.2;
/// s.
const PERIOD: f32 = 1.0;

impl Headway {
    /// With these settings.
    ///
    /// # Errors
    /// None: all settings make sense.
    pub fn new(settings: HeadwaySettings) -> Result<Self, SettingError> {
        Ok(Self { backwards: settings.backwards, ..Self::default() })
    }
}

impl Movement for Headway {
    fn name(&self) -> &str {
        "headway"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn bind(&mut self, body: &Body) {
        self.least = LEAST_SPEED * PERIOD * body.body_length;
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.x, self.since, self.stuck) = (start.torso().x, start.time, false);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if now.time - self.since >= PERIOD {
            let x = now.torso().x;
            let way = if self.backwards { self.x - x } else { x - self.x };
            self.stuck = way < self.least;
            (self.x, self.since) = (x, now.time);
        }
        if self.stuck { Verdict::End } else { Verdict::GoOn }
    }

    fn value(&self) -> f64 {
        f64::from(u8::from(self.stuck))
    }
}
