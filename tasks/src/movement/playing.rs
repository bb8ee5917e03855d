use super::{Movement, Verdict, upright::Turn};
use crate::{Body, Command, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// How long the body does as it is told, in s: how long it moves at the [commanded](crate::Command) speed, or stands still where
/// that is 0, and a number of seconds for every jump.
///
/// Each moment counts from 0 to 1. Half of it is for the way to go: it falls in proportion to the error, to 0 at an error of 1
/// body length a second plus the commanded speed. The other half is for being there: it is 1 without an error, and a half of
/// that at 0.1 body lengths a second plus a tenth of the commanded speed. The speed is that of the torso, forwards, smoothed over
/// 0.25 s. Told to stand, a body in which nothing moves counts double one whose parts move about. And if it has legs, one that carries
/// its torso at 0.85 of its start height or higher, on flat ground, counts double one that has bent them to 0.6: what crouches
/// has nothing left to jump with. Standing or moving, a body on legs whose torso is tilted by at most 20° counts double one that is
/// tilted by 45°.
///
/// After a press the moments do not count until the body has landed, or for 1.5 s, and the jump does, once these are over: all of it if the body leaves the
/// ground within 0.5 s and its centre of mass rises by 0.42 start heights above its start (0.3 body lengths if it has no legs),
/// in proportion to the rise below that. While a foot is on the ground 0.4 of the rise counts that its speed would take it to,
/// so that a search is drawn towards a push-off before anything leaves the ground; of a jump that comes too late 0.15, and nothing of
/// one for which a leg leaves the ground less than 0.2 s after the press. Of a jump that is off the
/// commanded speed by 1 body length a second plus that speed 0.2 counts, and all of one that is off by 0.4 of this or less: a jump out
/// of a run may cost some speed. Of legs that leave the ground one after the other less counts: nothing where they do so
/// 0.25 s apart; of a jump in which anything but a foot touches the ground 0.4; and of a body on legs the less the farther its torso tilts
/// in it, by the square of the tilt: 0.4 at 45° or more.
#[derive(Clone, Debug)]
pub struct Playing {
    jump_worth: f64,
    body_length: f64,
    masses: Vec<f64>,
    /// Empty for a body without legs.
    feet: Vec<usize>,
    /// Parts that are no feet, of a body with legs.
    others: Vec<usize>,
    /// The rise of a whole jump, m.
    enough: f64,
    /// m/s².
    gravity: f64,
    /// Height of the torso at the start, m; `None` where it may be carried at any height.
    tall: Option<f64>,
    turn: Turn,
    /// Height of the centre of mass at the start, and now, m.
    rest: f64,
    centre: f64,
    time: f64,
    speed: f64,
    command: Command,
    /// When each foot last left the ground, s; infinity while it is down.
    left: Vec<f64>,
    jump: Option<Jump>,
    followed: f64,
    jumped: f64,
}

/// Settings of [`Playing`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct PlayingSettings {
    /// What a jump is worth, s; from 0 to 100, default 1.5: as much as the time that does not count, so that with jumps and without
    /// the best that can be done is worth about as much.
    pub jump: f64,
}

impl Default for PlayingSettings {
    fn default() -> Self {
        Self { jump: JUMP_SECONDS }
    }
}

/// A jump that is due.
#[derive(Clone, Copy, Debug)]
struct Jump {
    /// When the button was pressed, s.
    pressed: f64,
    /// How much of a jump the flight is that answered the press, 0 to 1; `None`: there is none yet.
    flight: Option<f64>,
    /// What it is worth so far, 0 to 1.
    worth: f64,
    /// Whether a part that is no foot has touched the ground.
    spoilt: bool,
    /// How upright the torso has been at the least, 0 to 1.
    upright: f64,
    /// Whether the body has come down again.
    landed: bool,
}

/// Over which the speed is smoothed, s.
const SMOOTH: f64 = 0.25;
/// How long after the press a jump has, s.
pub(super) const JUMP_SECONDS: f64 = 1.5;
/// By when the body has to leave the ground, s.
const ANSWER: f64 = 0.5;
/// The rise of a whole jump, in start heights; of a body without legs in body lengths.
const ENOUGH: f64 = 0.42;
const ENOUGH_LEGLESS: f64 = 0.3;
/// m.
const LEAST_RISE: f64 = 0.06;
/// What counts of the rise that is promised on the ground.
const PROMISED: f64 = 0.4;
/// What counts of a jump that goes nowhere near the commanded speed...
const ONWARDS: f64 = 0.2;
/// ...and all of it counts from so near on: where each bit of speed counts, jumps out of a fast run are too low.
const NEAR_ENOUGH: f64 = 0.6;
/// What counts of a jump that comes too late.
const LATE: f64 = 0.15;
/// What leaves the ground sooner after the press does not count, s: a body hops off its legs as they are, and a search that has found that
/// does not find the crouch any more.
const CROUCH: f64 = 0.2;
/// What counts of a jump in which a part that is no foot touches the ground, or the torso turns over.
const SPOILT: f64 = 0.4;
/// Legs that push off within this of each other push off together, s...
const TOGETHER: f64 = 0.1;
/// ...and so far apart they do not jump.
const APART: f64 = 0.25;
/// At this speed of its fastest part, in body lengths a second, a standing body is half as still as can be.
const RESTLESS: f64 = 0.3;
/// A torso at this share of its start height is carried high enough...
const TALL: f64 = 0.85;
/// ...and at this one, on legs that are bent, it counts half.
const BENT: f64 = 0.6;
/// A torso that is tilted by no more than this is upright, rad...
const UPRIGHT: f64 = 20.0 * DEGREE;
/// ...and at this it counts half.
const TILTED: f64 = 45.0 * DEGREE;
const DEGREE: f64 = std::f64::consts::PI / 180.0;

impl Default for Playing {
    fn default() -> Self {
        Self {
            jump_worth: PlayingSettings::default().jump,
            body_length: 1.0,
            masses: Vec::new(),
            feet: Vec::new(),
            others: Vec::new(),
            enough: ENOUGH,
            gravity: 9.81,
            tall: None,
            turn: Turn::default(),
            rest: 0.0,
            centre: 0.0,
            time: 0.0,
            speed: 0.0,
            command: Command::default(),
            left: Vec::new(),
            jump: None,
            followed: 0.0,
            jumped: 0.0,
        }
    }
}

impl Playing {
    /// With these settings.
    ///
    /// # Errors
    /// If what a jump is worth is out of range.
    pub fn new(settings: PlayingSettings) -> Result<Self, SettingError> {
        SettingError::check_range("jump", settings.jump, 0.0, 100.0)?;
        Ok(Self { jump_worth: settings.jump, ..Self::default() })
    }

    /// How much a moment counts, 0 to 1.
    fn follows(&self, now: &Snapshot) -> f64 {
        let wanted = f64::from(self.command.speed);
        let there = self.error() / (0.1 + 0.1 * wanted.abs());
        let follows = 0.5 * self.near() + 0.5 / (1.0 + there * there);
        let follows = follows * half_at((TILTED - self.tilt()) / (TILTED - UPRIGHT));
        if wanted == 0.0 { 0.5 * follows * (1.0 + self.stillness(now)) * self.tallness(now) } else { follows }
    }

    /// What counts of standing with the torso at its height, 0.5 to 1. Not of moving: a biped that has to do it on straight legs
    /// does not find a quick stride.
    fn tallness(&self, now: &Snapshot) -> f64 {
        let of = |tall: f64| half_at((f64::from(now.torso().y) / tall - BENT) / (TALL - BENT));
        self.tall.map_or(1.0, of)
    }

    /// How far the torso is turned from its start, rad; 0 for a body without legs.
    fn tilt(&self) -> f64 {
        if self.feet.is_empty() { 0.0 } else { f64::from(self.turn.angle).abs() }
    }

    /// How upright the torso is, 0 to 1; 1 for a body without legs.
    fn uprightness(&self) -> f64 {
        if self.feet.is_empty() { 1.0 } else { self.turn.uprightness().into() }
    }

    /// How near the speed is to the commanded one, 0 to 1.
    fn near(&self) -> f64 {
        (1.0 - self.error() / (1.0 + f64::from(self.command.speed).abs())).max(0.0)
    }

    /// What counts of a jump at this speed, 0.2 to 1.
    fn onwards(&self) -> f64 {
        ONWARDS + (1.0 - ONWARDS) * (self.near() / NEAR_ENOUGH).min(1.0)
    }

    /// How far off the commanded speed is, body lengths/s.
    fn error(&self) -> f64 {
        (self.speed / self.body_length - f64::from(self.command.speed)).abs()
    }

    /// The jump that is due if the button was pressed at this moment.
    fn pressed(&self) -> Option<Jump> {
        let jump = Jump { pressed: self.time, flight: None, worth: 0.0, spoilt: false, upright: 1.0, landed: false };
        (self.command.since_press == 0.0).then_some(jump)
    }

    fn stillness(&self, now: &Snapshot) -> f64 {
        let square = |vx: f32, vy: f32| f64::from(vx) * f64::from(vx) + f64::from(vy) * f64::from(vy);
        let fastest = now.parts.iter().map(|part| square(part.vx, part.vy)).fold(0.0, f64::max);
        let restless = RESTLESS * self.body_length;
        1.0 / (1.0 + fastest / (restless * restless))
    }

    /// Height of the centre of mass, m; of the torso where masses are not known.
    fn centre_of(&self, now: &Snapshot) -> f64 {
        let total: f64 = self.masses.iter().sum();
        if self.masses.len() != now.parts.len() || total <= 0.0 {
            return now.torso().y.into();
        }
        self.masses.iter().zip(&now.parts).map(|(mass, part)| mass * f64::from(part.y)).sum::<f64>() / total
    }

    /// `upwards`: the speed of the centre of mass, m/s.
    fn watch_jump(&mut self, now: &Snapshot, time: f64, upwards: f64) {
        let promised = upwards.max(0.0) * upwards.max(0.0) / (2.0 * self.gravity);
        let (risen, rising) = (self.centre - self.rest, self.centre - self.rest + promised);
        let first = self.left.iter().copied().fold(f64::INFINITY, f64::min);
        let (upright, onwards) = (self.uprightness(), self.onwards());
        let Some(jump) = &mut self.jump else { return };
        let is_early = |left: f64| left - jump.pressed < CROUCH;
        let late = time - jump.pressed > ANSWER;
        let (share, rise) = match now.aloft() {
            true => {
                let apart = if first.is_finite() { time - first } else { 0.0 };
                let flight = || match late {
                    _ if is_early(first.min(time)) => 0.0,
                    true => LATE,
                    false => PROMISED + (1.0 - PROMISED) * ((APART - apart) / (APART - TOGETHER)).clamp(0.0, 1.0),
                };
                (*jump.flight.get_or_insert_with(flight), risen)
            }
            false => {
                jump.landed |= jump.flight.is_some();
                jump.flight = None;
                let promised = if late { LATE } else { PROMISED };
                (if is_early(time) { 0.0 } else { promised }, rising)
            }
        };
        jump.worth = jump.worth.max(onwards * share * (rise / self.enough).clamp(0.0, 1.0));
        jump.upright = jump.upright.min(upright);
        jump.spoilt |= self.others.iter().any(|&part| now.parts[part].touching);
        if time - jump.pressed >= JUMP_SECONDS {
            let spoilt = if jump.spoilt { SPOILT } else { 1.0 };
            let upright = SPOILT + (1.0 - SPOILT) * jump.upright;
            self.jumped += self.jump_worth * jump.worth * upright * spoilt;
            self.jump = None;
        }
    }
}

/// Half at 0, all at 1.
fn half_at(place: f64) -> f64 {
    0.5 + 0.5 * place.clamp(0.0, 1.0)
}

impl Movement for Playing {
    fn name(&self) -> &str {
        "playing"
    }

    fn unit(&self) -> &str {
        "s"
    }

    fn bind(&mut self, body: &Body) {
        self.body_length = body.body_length.into();
        self.masses = body.parts.iter().map(|part| part.mass.into()).collect();
        self.feet = if body.legless { Vec::new() } else { body.feet().collect() };
        self.others = if body.legless { Vec::new() } else { body.parts_without_feet() };
        let height = f64::from(body.start_height);
        self.tall = (!body.legless && !body.uneven_ground && height > 0.0).then_some(height);
        self.left = vec![f64::INFINITY; self.feet.len()];
        let enough = match body.legless {
            true => ENOUGH_LEGLESS * self.body_length,
            false => ENOUGH * f64::from(body.start_height),
        };
        self.enough = enough.max(LEAST_RISE);
        self.gravity = f64::from(body.pull()).max(0.1);
    }

    fn begin(&mut self, start: &Snapshot) {
        self.rest = self.centre_of(start);
        self.centre = self.rest;
        (self.time, self.speed, self.command) = (start.time.into(), 0.0, start.command);
        (self.followed, self.jumped) = (0.0, 0.0);
        self.turn = Turn::from(start.torso());
        self.jump = self.pressed();
        self.left.fill(f64::INFINITY);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let time = f64::from(now.time);
        let step = time - self.time;
        self.time = time;
        self.speed += (f64::from(now.torso().vx) - self.speed) * (step / SMOOTH).clamp(0.0, 1.0);
        for (left, &foot) in self.left.iter_mut().zip(&self.feet) {
            if now.parts[foot].touching {
                *left = f64::INFINITY;
            } else if left.is_infinite() {
                *left = time;
            }
        }
        self.turn.follow(now.torso());
        let before = self.centre;
        self.centre = self.centre_of(now);
        let upwards = if step > 0.0 { (self.centre - before) / step } else { 0.0 };
        if self.jump.is_none_or(|jump| jump.landed) {
            self.followed += step * self.follows(now);
        }
        self.watch_jump(now, time, upwards);
        self.command = now.command;
        self.jump = self.pressed().or(self.jump);
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.followed + self.jumped
    }

    fn measurements(&self, tell: &mut dyn FnMut(&str, f64)) {
        tell("playing", self.value());
        tell("followed", self.followed);
        tell("jumped", self.jumped);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PartState;

    const STEP: f32 = 0.02;

    /// What a body of one part does that moves at this speed and this height above its start, told this, at each step.
    fn played(seconds: f32, at: impl FnMut(f32) -> (f32, f32, Command)) -> f64 {
        played_by(Playing::default(), seconds, at)
    }

    fn played_by(mut movement: Playing, seconds: f32, mut at: impl FnMut(f32) -> (f32, f32, Command)) -> f64 {
        let mut x = 0.0;
        let mut snapshot = |step: u32| {
            let time = step as f32 * STEP;
            let (speed, height, command) = at(time);
            x += speed * STEP;
            let part =
                PartState { x, y: 1.0 + height, cos: 1.0, vx: speed, touching: height <= 0.0, ..PartState::default() };
            Snapshot { time, parts: vec![part], command, ..Snapshot::default() }
        };
        movement.begin(&snapshot(0));
        for step in 1..=(seconds / STEP) as u32 {
            assert_eq!(movement.observe(&snapshot(step)), Verdict::GoOn);
        }
        movement.value()
    }

    fn told(speed: f32) -> Command {
        Command { speed, ..Command::default() }
    }

    #[test]
    fn what_does_as_it_is_told_gets_all_its_time() {
        let stands = played(10.0, |_| (0.0, 0.0, told(0.0)));
        let runs = played(10.0, |time| (if time > 0.0 { 1.0 } else { 0.0 }, 0.0, told(1.0)));
        assert!((9.9..=10.001).contains(&stands), "{stands}");
        assert!((9.0..=10.0).contains(&runs), "{runs}");
    }

    #[test]
    fn nearer_to_the_commanded_speed_is_worth_more() {
        for wanted in [-1.0_f32, 0.0, 0.5, 2.0] {
            let of = |error: f32| played(5.0, |_| (wanted + error, 0.0, told(wanted)));
            let worths: Vec<f64> = [0.0, 0.05, 0.1, 0.3, 0.6, 1.0].map(of).to_vec();
            assert!(worths.is_sorted_by(|one, other| one > other), "{wanted}: {worths:?}");
        }
    }

    #[test]
    fn a_tilted_body_counts_half() {
        let stands = |degrees: f32, legless: bool| {
            let mut movement = Playing::default();
            let parts = vec![crate::BodyPart::default()];
            movement.bind(&Body { body_length: 1.0, parts, legs: vec![vec![0]], legless, ..Body::default() });
            let snapshot = |step: u32, degrees: f32| {
                let (sin, cos) = degrees.to_radians().sin_cos();
                let part = PartState { y: 1.0, cos, sin, touching: true, ..PartState::default() };
                Snapshot { time: step as f32 * STEP, parts: vec![part], ..Snapshot::default() }
            };
            movement.begin(&snapshot(0, 0.0));
            (1..=250).for_each(|step| assert_eq!(movement.observe(&snapshot(step, degrees)), Verdict::GoOn));
            movement.value()
        };
        let worths = [0.0, 20.0, 32.5, -45.0, 90.0].map(|degrees| stands(degrees, false) / stands(0.0, false));
        for (worth, wanted) in worths.iter().zip([1.0, 1.0, 0.75, 0.5, 0.5]) {
            assert!((worth - wanted).abs() < 1e-3, "{worths:?}");
        }
        assert_eq!(stands(90.0, true), stands(0.0, true), "what has no legs may roll");
    }

    /// On flat ground, by a body that starts at a height of 1 m.
    #[test]
    fn a_body_on_bent_legs_counts_half() {
        let stands = |at: f32, body: &Body| {
            let mut movement = Playing::default();
            movement.bind(body);
            played_by(movement, 5.0, |_| (0.0, at - 1.0, told(0.0)))
        };
        let body = Body { body_length: 1.0, start_height: 1.0, ..Body::default() };
        let worths = [1.0, 0.85, 0.725, 0.6, 0.3].map(|at| stands(at, &body) / stands(1.0, &body));
        for (worth, wanted) in worths.iter().zip([1.0, 1.0, 0.75, 0.5, 0.5]) {
            assert!((worth - wanted).abs() < 1e-3, "{worths:?}");
        }
        assert_eq!(stands(1.0, &Body { start_height: 0.0, ..body.clone() }), stands(1.0, &body), "no height is known");
        for other in [Body { uneven_ground: true, ..body.clone() }, Body { legless: true, ..body.clone() }] {
            assert_eq!(stands(0.5, &other), stands(1.0, &other));
        }
    }

    /// Told to jump at 1 s, by a body of a torso and two feet, each of which leaves the ground at its time.
    fn leaps(left: [f32; 2]) -> f64 {
        leaps_tilted(left, 0.0)
    }

    /// The same by a body whose torso is tilted by so many degrees while it is in the air.
    fn leaps_tilted(left: [f32; 2], degrees: f32) -> f64 {
        leaps_and(left, degrees, false)
    }

    /// The same; `brushes`: the torso touches the ground once it has landed.
    fn leaps_and(left: [f32; 2], degrees: f32, brushes: bool) -> f64 {
        let mut movement = Playing::default();
        let parts = vec![crate::BodyPart::default(); 3];
        let legs = vec![vec![1], vec![2]];
        movement.bind(&Body { body_length: 1.0, start_height: 1.0, parts, legs, ..Body::default() });
        let snapshot = |step: u32| {
            let time = step as f32 * STEP;
            let aloft = left.iter().all(|&left| time >= left) && time < 1.8;
            let height = if aloft { 1.5 } else { 1.0 };
            let foot =
                |left: f32| PartState { cos: 1.0, touching: !(left..1.8).contains(&time), ..PartState::default() };
            let (sin, cos) = if aloft { degrees.to_radians().sin_cos() } else { (0.0, 1.0) };
            let touching = brushes && time >= 1.8;
            let torso = PartState { y: height, cos, sin, touching, ..PartState::default() };
            let since_press = if time < 1.0 { f32::INFINITY } else { time - 1.0 };
            let command = Command { speed: 0.0, jump: false, since_press, ..Command::default() };
            Snapshot { time, parts: vec![torso, foot(left[0]), foot(left[1])], command, ..Snapshot::default() }
        };
        movement.begin(&snapshot(0));
        (1..=150).for_each(|step| assert_eq!(movement.observe(&snapshot(step)), Verdict::GoOn));
        movement.jumped
    }

    #[test]
    fn a_jump_counts_less_the_farther_the_torso_tilts() {
        let worths = [0.0, 15.0, 30.0, 45.0, -45.0, 120.0]
            .map(|degrees| leaps_tilted([1.31, 1.31], degrees) / leaps([1.31, 1.31]));
        let wanted = [1.0, 1.0 - 0.6 / 9.0, 1.0 - 0.6 * 4.0 / 9.0, 0.4, 0.4, 0.4];
        for (worth, wanted) in worths.iter().zip(wanted) {
            assert!((worth - wanted).abs() < 1e-3, "{worths:?}");
        }
    }

    #[test]
    fn a_jump_in_which_the_torso_touches_the_ground_counts_less() {
        let feet = [1.31, 1.31];
        let share = |degrees| leaps_and(feet, degrees, true) / leaps_tilted(feet, degrees);
        assert!([0.0, 30.0].map(share).iter().all(|share| (share - 0.4).abs() < 1e-9), "{:?}", [0.0, 30.0].map(share));
    }

    #[test]
    fn no_leg_may_leave_the_ground_before_there_was_time_to_crouch() {
        assert!(
            leaps([1.31, 1.31]) > 1.4 && leaps([1.25, 1.33]) > 1.4,
            "{} {}",
            leaps([1.31, 1.31]),
            leaps([1.25, 1.33])
        );
        assert_eq!(leaps([1.15, 1.24]), 0.0, "one leg is early");
        assert_eq!(leaps([1.11, 1.11]), 0.0);
    }

    /// Pressed at 1 s; in the air from `from` to `to`, m at the peak.
    fn jumps(from: f32, to: f32, peak: f32) -> f64 {
        let mut before = f32::INFINITY;
        let value = played(4.0, |time| {
            let jump = (1.0..1.2).contains(&time);
            before = if jump && before.is_infinite() { 0.0 } else { before + STEP };
            let place = (time - from) / (to - from);
            let height = if (0.0..1.0).contains(&place) { peak * 4.0 * place * (1.0 - place) } else { 0.0 };
            (0.0, height, Command { speed: 0.0, jump, since_press: before, ..Command::default() })
        });
        value - played(2.5, |_| (0.0, 0.0, told(0.0)))
    }

    #[test]
    fn a_jump_counts_if_it_answers_a_press() {
        let [whole, half, late, none] =
            [jumps(1.3, 1.9, 0.5), jumps(1.3, 1.9, 0.17), jumps(1.8, 2.4, 0.5), jumps(9.0, 9.1, 0.0)];
        let early = jumps(1.1, 1.9, 0.5);
        // 1.5 s for the jump, and 0.6 s from the landing on.
        assert!((2.0..2.2).contains(&whole), "{whole}");
        assert!((1.1..1.6).contains(&half), "{half}");
        // 0.15 of its 1.5 s, and 0.1 s more from the landing on than the time that does not count.
        assert!((0.2..0.45).contains(&late), "{late}");
        // The time from the landing on alone.
        assert!((0.5..0.75).contains(&early), "{early}");
        assert!(none.abs() < 0.1, "{none}");
    }

    /// Told to run at 1 body length a second, and in the air from 0.2 to 0.8 s.
    #[test]
    fn a_jump_that_goes_on_counts_more() {
        let flies = |speed: f32| {
            played(1.5, |time| {
                let place = (time - 0.2) / 0.6;
                let aloft = (0.0..1.0).contains(&place);
                let height = if aloft { 2.0 * place * (1.0 - place) } else { 0.0 };
                let speed = if time > 0.9 { 1.0 } else { speed };
                (speed, height, Command { speed: 1.0, jump: time < 0.2, since_press: time, ..Command::default() })
            })
        };
        let worths = [1.0, -0.3, -1.5].map(flies);
        assert!(worths.is_sorted_by(|one, other| one > other), "{worths:?}");
        // 0.8 of its 1.5 s are for the speed.
        assert!(worths[0] - worths[2] > 1.0, "{worths:?}");
    }

    /// Of a jump at a commanded speed of 1 body length a second.
    #[test]
    fn a_jump_out_of_a_run_may_cost_some_speed() {
        let counts = |speed: f64| {
            Playing { speed, command: Command { speed: 1.0, ..Command::default() }, ..Playing::default() }.onwards()
        };
        assert_eq!([1.0, 0.25, 1.75].map(counts), [1.0; 3]);
        assert!((counts(0.0) - (0.2 + 0.8 * 0.5 / 0.6)).abs() < 1e-9);
        assert_eq!([counts(-1.0), counts(-3.0)], [0.2, 0.2]);
    }

    #[test]
    fn a_press_at_the_very_start_is_one() {
        let value = |peak: f32| {
            played(1.6, |time| {
                let place = (time - 0.2) / 0.6;
                let height = if (0.0..1.0).contains(&place) { peak * 4.0 * place * (1.0 - place) } else { 0.0 };
                (0.0, height, Command { speed: 0.0, jump: time < 0.2, since_press: time, ..Command::default() })
            })
        };
        assert!(value(0.5) > value(0.0) + 1.4 + 0.6, "{} {}", value(0.5), value(0.0));
    }

    #[test]
    fn what_a_jump_is_worth_is_a_setting() {
        for jump in [-1.0, 101.0, f64::NAN] {
            let error = Playing::new(PlayingSettings { jump }).expect_err("out of range").to_string();
            assert!(error.contains("jump") && error.contains("from 0 to 100"), "{error}");
        }
        assert!(Playing::new(PlayingSettings { jump: 0.0 }).is_ok());
    }
}
