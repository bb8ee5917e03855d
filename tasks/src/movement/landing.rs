use super::{Leap, Movement, Verdict, upright::Turn};
use crate::{Body, Snapshot};

/// What comes after a jump, s: the time since the first [leap](Leap) in which the body stands as it stood at the start
/// (within 15° and 12 % of its start height, slower than 0.2 body lengths/s), or has leapt no more than 1.2 s ago. Of a body
/// with legs that leaps on less counts the more its torso is tilted, by the square of the tilt: nothing at 45°.
///
/// Only a leap of 0.35 start heights and 6 cm (without legs: 0.3 body lengths) counts, and one that all legs began
/// together: with a share for less, searches settle for hops.
///
/// A term that ends the episode when the body falls is what makes it land on its feet: see
/// [`Posture`](super::Posture).
#[derive(Clone, Debug, Default)]
pub struct Landing {
    leap: Leap,
    legless: bool,
    body_length: f32,
    start_height: f32,
    /// What a leap has to rise by, m.
    high: f32,
    turn: Turn,
    start: f32,
    time: f32,
    /// When the last flight that may be a leap was under way for the last time.
    leapt: f32,
    /// What it is worth, 0 to 1.
    worth: f32,
    /// What the best so far was worth.
    best: f32,
    good: f32,
}

/// Start heights.
const RISE: f32 = 0.35;
/// m.
const LEAST_RISE: f32 = 0.06;
/// Body lengths.
const LEGLESS_RISE: f32 = 0.3;
/// s.
const LEAPS_ON: f32 = 1.2;
/// rad.
const TILT: f32 = 0.26;
/// Start heights.
const HEIGHT: f32 = 0.12;
/// Body lengths a second.
const SPEED: f32 = 0.2;

impl Movement for Landing {
    fn name(&self) -> &str {
        "landing"
    }

    fn unit(&self) -> &str {
        "s"
    }

    fn bind(&mut self, body: &Body) {
        self.leap.bind(body);
        self.legless = body.legless;
        (self.body_length, self.start_height) = (body.body_length, body.start_height);
        self.high = if body.legless { LEGLESS_RISE * body.body_length } else { RISE * body.start_height };
    }

    fn begin(&mut self, start: &Snapshot) {
        self.leap.begin(start);
        self.turn = Turn::from(start.torso());
        (self.start, self.time) = (start.torso().y, start.time);
        (self.leapt, self.worth, self.best, self.good) = (start.time, 0.0, 0.0, 0.0);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.leap.observe(now);
        self.turn.follow(now.torso());
        let seconds = now.time - self.time;
        self.time = now.time;
        if let Some((rise, share)) = self.leap.under_way(now) {
            let worth = if rise >= self.high.max(LEAST_RISE) && share == 1.0 { 1.0 } else { 0.0 };
            // The worth of a flight is that of its peak.
            self.worth = if now.time - self.leapt > 2.0 * seconds { worth } else { self.worth.max(worth) };
            self.best = self.best.max(self.worth);
            self.leapt = now.time;
        }
        if self.best > 0.0 {
            let leaps_on = now.time - self.leapt <= LEAPS_ON;
            let leaping = if leaps_on { self.worth * self.uprightness() } else { 0.0 };
            // A hop that is no leap does not keep it from standing.
            let stands = leaping == 0.0 && self.stands(now);
            self.good += seconds * if stands { self.best } else { leaping };
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.good.into()
    }
}

impl Landing {
    /// How much a moment of leaping on counts, 0 to 1. Where half of one at 45° counts searches find jumps sooner, but more of these turn
    /// over in other worlds (docs/gaits-experiments.md).
    fn uprightness(&self) -> f32 {
        if self.legless { 1.0 } else { self.turn.uprightness() }
    }

    fn stands(&self, now: &Snapshot) -> bool {
        let torso = now.torso();
        self.turn.angle.abs() < TILT
            && (torso.y - self.start).abs() < HEIGHT * self.start_height
            && libm::hypotf(torso.vx, torso.vy) < SPEED * self.body_length
    }
}
