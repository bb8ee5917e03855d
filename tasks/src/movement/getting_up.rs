use super::{Movement, Verdict};
use crate::{Body, PartState, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// How far it gets up, and stays up, for a creature that is drawn lying on its back or its side: 0 as it lies, 1 when it
/// stands upright.
///
/// Two fifths of it are the torso's turn from the start pose to upright; the rest, which also needs the turn, is its rise
/// above where it lay, by 0.8 times the length of its longest leg (without legs the turn is all). A body on its end is
/// worth at most a quarter, so that it does better to fall over to the right side, even if it lies on its belly then. While the
/// torso moves at half a metre a second, its rise is worth half: up in the air is not up on its legs.
///
/// The value is a mean in which each moment counts by the time since the start: what is up early and stays up is worth most, a
/// leap at the end little, and so is a somersault that comes to lie again.
#[derive(Clone, Debug)]
pub struct GettingUp {
    turn: f64,
    /// By how much it has to rise, m; 0: it has no legs to rise on.
    rise: f64,
    start: PartState,
    /// Cosine and sine of the torso's angle when it is upright.
    upright: [f64; 2],
    /// When it lay, s.
    begun: f32,
    time: f32,
    up: f64,
}

/// Settings of [`GettingUp`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct GettingUpSettings {
    /// By how much the torso has to turn from its start pose to be upright, counter-clockwise, degrees; from 10 to 180, or
    /// from −180 to −10, default 180.
    pub turn: f64,
}

/// The least turn, degrees.
const LEAST: f64 = 10.0;
/// What the turn alone is worth.
const TURN: f64 = 0.4;
/// Of the longest leg's length.
const RISE: f64 = 0.8;
/// The speed of the torso at which its rise is worth half, m/s.
const HASTE: f64 = 0.5;

impl Default for GettingUpSettings {
    fn default() -> Self {
        Self { turn: 180.0 }
    }
}

impl GettingUp {
    /// With these settings.
    ///
    /// # Errors
    /// If the turn is out of range.
    pub fn new(settings: GettingUpSettings) -> Result<Self, SettingError> {
        if !(LEAST..=180.0).contains(&settings.turn.abs()) {
            return Err(SettingError::new("turn", settings.turn, "from 10 to 180, or from -180 to -10"));
        }
        Ok(Self { turn: settings.turn.to_radians(), ..Self::default() })
    }

    /// How far it is up at this moment, 0 to 1.
    fn height(&self, torso: &PartState) -> f64 {
        let [cos, sin] = self.upright;
        // From cos(turn), as it lies, to 1.
        let towards = cos * f64::from(torso.cos) + sin * f64::from(torso.sin);
        let lying = libm::cos(self.turn);
        let turned = ((towards - lying) / (1.0 - lying)).clamp(0.0, 1.0);
        let risen = match self.rise > 0.0 {
            true => ((f64::from(torso.y) - f64::from(self.start.y)) / self.rise).clamp(0.0, 1.0),
            false => 1.0,
        };
        // Up in the air is not up on its legs.
        let (vx, vy) = (f64::from(torso.vx), f64::from(torso.vy));
        let rest = 1.0 / (1.0 + (vx * vx + vy * vy) / (HASTE * HASTE));
        turned * turned * (TURN + (1.0 - TURN) * risen * rest)
    }
}

impl Default for GettingUp {
    fn default() -> Self {
        let turn = GettingUpSettings::default().turn.to_radians();
        Self { turn, rise: 0.0, start: PartState::default(), upright: [1.0, 0.0], begun: 0.0, time: 0.0, up: 0.0 }
    }
}

impl Movement for GettingUp {
    fn name(&self) -> &str {
        "getting-up"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn bind(&mut self, body: &Body) {
        // A body that lies on its back counts as legless: no leg is on the ground.
        let length = |leg: &Vec<usize>| leg.iter().map(|&part| f64::from(body.parts[part].length())).sum::<f64>();
        self.rise = RISE * body.legs.iter().map(length).fold(0.0, f64::max);
    }

    fn begin(&mut self, start: &Snapshot) {
        self.start = *start.torso();
        let (cos, sin) = (f64::from(self.start.cos), f64::from(self.start.sin));
        let (c, s) = (libm::cos(self.turn), libm::sin(self.turn));
        self.upright = [cos * c - sin * s, sin * c + cos * s];
        (self.begun, self.time, self.up) = (start.time, start.time, 0.0);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let before = f64::from(self.time) - f64::from(self.begun);
        self.time = now.time;
        let after = f64::from(self.time) - f64::from(self.begun);
        if after > 0.0 {
            // The mean of the height, each moment weighted by its time.
            self.up += (self.height(now.torso()) - self.up) * (1.0 - (before / after) * (before / after));
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.up
    }
}
