//! The movements beyond running and jumping, on a puppet whose every move is written by hand: what is meant is worth most,
//! and what only looks like it is worth less.

use proptest::prelude::*;
use tasks::{
    Backwards, Body, BodyPart, Carrying, Climbing, Cruising, CruisingSettings, GettingUp, GettingUpSettings, Headway,
    HeadwaySettings, Hopping, LongJump, Movement, PartState, Snapshot, Standing, StandingSettings, Swimming, Verdict,
    Walking, WalkingSettings,
};

const TIME_STEP: f32 = 0.02;
/// m/s².
const GRAVITY: f32 = 9.81;

/// A torso 0.4 m wide with its centre 0.5 m high, on two legs 0.4 m long, each its own foot. One metre long, it says.
fn puppet() -> Body {
    let part = |name: &str, [x, y]: [f32; 2]| BodyPart {
        name: name.into(),
        mass: 1.0,
        inertia: 0.01,
        buoyancy: 0.0,
        corners: vec![[-x, -y], [x, -y], [x, y], [-x, y]],
        radius: 0.0,
    };
    Body {
        body_length: 1.0,
        start_height: 0.5,
        gravity: GRAVITY,
        parts: vec![part("torso", [0.2, 0.1]), part("back leg", [0.0, 0.2]), part("front leg", [0.0, 0.2])],
        legs: vec![vec![1], vec![2]],
        ..Body::default()
    }
}

/// The puppet at one moment.
#[derive(Clone, Copy, Debug, Default)]
struct Pose {
    /// The torso's way forward and its height above the start, m; its turn, rad.
    x: f32,
    rise: f32,
    turn: f32,
    /// Speed of the torso up and of a leg, m/s.
    up: f32,
    kick: f32,
    /// Heights of the ground below the legs, m.
    ground: [f32; 2],
    aloft: bool,
    torso_touches: bool,
    /// Of the motors since the start, J.
    work: f64,
}

impl Pose {
    fn snapshot(&self, time: f32) -> Snapshot {
        let (sin, cos) = libm::sincosf(self.turn);
        let torso = PartState {
            x: self.x,
            y: 0.5 + self.rise,
            cos,
            sin,
            vy: self.up,
            touching: self.torso_touches,
            ..PartState::default()
        };
        let leg = |index: usize| PartState {
            x: self.x + [-0.2, 0.2][index],
            y: 0.2 + self.ground[index] + if self.aloft { self.rise.max(0.1) } else { 0.0 },
            cos: 1.0,
            vx: self.kick,
            touching: !self.aloft && !self.torso_touches,
            ..PartState::default()
        };
        Snapshot { time, parts: vec![torso, leg(0), leg(1)], motor_work: self.work, ..Snapshot::default() }
    }
}

/// Shows a movement that has met the puppet what it does for so many seconds. It never ends the episode, and is worth the
/// same when it is shown the same again.
fn value(mut movement: impl Movement, seconds: f32, pose: impl Fn(f32) -> Pose) -> f64 {
    movement.bind(&puppet());
    let steps = (seconds / TIME_STEP).round() as u16;
    let script: Vec<Snapshot> =
        (0..=steps).map(|step| f32::from(step) * TIME_STEP).map(|time| pose(time).snapshot(time)).collect();
    let mut show = || {
        movement.begin(&script[0]);
        assert!(script[1..].iter().all(|now| movement.observe(now) == Verdict::GoOn));
        movement.value()
    };
    let value = show();
    assert_eq!(show().to_bits(), value.to_bits());
    value
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 0.02 * expected.abs().max(1.0), "{found}, expected {expected}");
}

#[track_caller]
fn assert_ranked(best_first: &[(&str, f64)]) {
    for pair in best_first.windows(2) {
        assert!(pair[0].1 > pair[1].1, "{:?} must be worth more than {:?}", pair[0], pair[1]);
    }
}

/// Hops so high, m, one each second, and gets so far, m, in each flight.
fn hops(height: f32, length: f32) -> impl Fn(f32) -> Pose {
    let flight = 2.0 * libm::sqrtf(2.0 * height / GRAVITY);
    move |time| {
        let since = time % 1.0 - 0.3;
        let aloft = since > 0.0 && since < flight;
        let rise = if aloft { 0.5 * GRAVITY * since * (flight - since) } else { 0.0 };
        let share = (since / flight).clamp(0.0, 1.0);
        Pose { x: length * (time.floor() + share), rise, aloft, ..Pose::default() }
    }
}

#[test]
fn a_long_jump_is_the_longest_single_flight() {
    let jump = LongJump::default;
    let one = value(jump(), 1.0, hops(0.3, 0.8));
    // The clock has steps of 0.02 s, and the flight lasts 0.49 s.
    assert!(one > 0.75 && one <= 0.801, "{one}");
    let many = value(jump(), 50.0, hops(0.3, 0.8));
    assert!((many - one).abs() < 0.04, "more of them are worth no more: {many}, {one}");
    let run = |time: f32| Pose { x: 5.0 * time, ..Pose::default() };
    let slide_of_the_torso = |time: f32| Pose { torso_touches: true, ..run(time) };
    for (cheat, worth) in [
        ("running", value(jump(), 5.0, run)),
        ("sliding", value(jump(), 5.0, slide_of_the_torso)),
        ("leaping back", value(jump(), 5.0, hops(0.3, -0.8))),
        ("leaping up", value(jump(), 5.0, hops(0.3, 0.0))),
        ("beginning in the air", value(jump(), 5.0, |time| Pose { aloft: true, ..run(time) })),
        (
            "being thrown by the torso",
            value(jump(), 5.0, |time| Pose { aloft: time > 1.0, torso_touches: time <= 1.0, ..run(time) }),
        ),
    ] {
        assert_eq!(worth, 0.0, "{cheat}");
    }
}

#[test]
fn hopping_adds_up_heights_of_hops_on_the_spot() {
    let hopping = Hopping::default;
    assert_near(value(hopping(), 10.0, hops(0.3, 0.0)), 3.0);
    let rearing = |time: f32| Pose { rise: 0.4, aloft: time % 0.2 > 0.05, ..Pose::default() };
    assert_ranked(&[
        ("high", value(hopping(), 10.0, hops(0.3, 0.0))),
        ("low", value(hopping(), 10.0, hops(0.1, 0.0))),
        ("drifting", value(hopping(), 10.0, hops(0.1, 0.05))),
        ("standing", value(hopping(), 10.0, |_| Pose::default())),
    ]);
    // Where it is a body length from the start no hop counts: eternal drifting earns no more than the first hops of it.
    assert_eq!(value(hopping(), 10.0, hops(0.3, 0.2)), value(hopping(), 100.0, hops(0.3, 0.2)));
    assert_eq!(value(hopping(), 10.0, hops(0.3, -2.0)), 0.0);
    let trembling = |time: f32| Pose { rise: 0.1, aloft: time % 0.1 > 0.04, ..Pose::default() };
    assert_eq!(value(hopping(), 10.0, trembling), 0.0);
    assert_eq!(value(hopping(), 10.0, rearing), 0.0, "a body that is high up has yet to hop");
}

#[test]
fn walking_is_worth_most_at_the_target_speed_and_on_the_ground() {
    let at = |speed: f32| move |time: f32| Pose { x: speed * time, ..Pose::default() };
    /// Off the ground in so many of five steps.
    fn aloft(steps: u16) -> impl Fn(f32) -> Pose {
        move |time| Pose { x: time, aloft: (time / TIME_STEP).round() as u16 % 5 < steps, ..Pose::default() }
    }
    let by_starts = |time: f32| Pose { x: time.floor() + (2.0 * (time % 1.0)).min(1.0), ..Pose::default() };
    let worth = |pose: &dyn Fn(f32) -> Pose| value(Walking::default(), 10.0, pose);
    assert_near(worth(&at(1.0)), 10.0);
    assert_ranked(&[
        ("the target", worth(&at(1.0))),
        ("a little slow", worth(&at(0.9))),
        ("with some flight", worth(&aloft(1))),
        ("slow", worth(&at(0.3))),
        ("running", worth(&aloft(2))),
        ("standing", worth(&at(0.0))),
        ("backwards", worth(&at(-0.5))),
    ]);
    assert_near(worth(&at(1.5)), 5.0);
    assert_near(worth(&at(2.0)), 0.0);
    assert_near(worth(&by_starts), 0.0);
    assert_near(worth(&aloft(3)), 0.0);
    let leisurely = Walking::new(WalkingSettings { speed: 0.3 }).expect("a speed");
    assert_near(value(leisurely.clone(), 10.0, at(0.3)), 3.0);
    assert_near(value(leisurely, 10.0, at(1.0)), -4.0);
}

#[test]
fn standing_is_to_be_still_and_upright_and_up() {
    let worth = |pose: &dyn Fn(f32) -> Pose| value(Standing::default(), 10.0, pose);
    // 8 of 10 s, whatever is done in the first two.
    assert_near(worth(&|_| Pose::default()), 8.0);
    let stops =
        |time: f32| Pose { x: 3.0 * time.min(2.0), kick: if time < 2.0 { 5.0 } else { 0.0 }, ..Pose::default() };
    assert_near(worth(&stops), 8.0);
    assert_ranked(&[
        ("still", worth(&|_| Pose::default())),
        ("swaying", worth(&|_| Pose { kick: 0.05, ..Pose::default() })),
        ("leaning", worth(&|time| Pose { turn: if time > 0.0 { 0.6 } else { 0.0 }, ..Pose::default() })),
        ("kicking", worth(&|_| Pose { kick: 1.0, ..Pose::default() })),
    ]);
    let lying = |time: f32| Pose { rise: if time > 1.0 { -0.4 } else { 0.0 }, ..Pose::default() };
    assert_eq!(worth(&lying), 0.0, "on its belly, on splayed legs");
    let tilted = |time: f32| Pose { turn: if time > 1.0 { 1.5 } else { 0.0 }, ..Pose::default() };
    assert_eq!(worth(&tilted), 0.0, "on its side");
    let sitting = |time: f32| Pose { torso_touches: time > 1.0, ..Pose::default() };
    assert_eq!(worth(&sitting), 0.0);
    let at_once = Standing::new(StandingSettings { after: 0.0 }).expect("a time");
    assert_near(value(at_once, 10.0, |_| Pose::default()), 10.0);
}

#[test]
fn climbing_is_the_height_the_feet_have_reached() {
    // A stair of 0.2 m each metre, the front leg ahead by 0.4 m.
    let stairs = |time: f32| {
        let step = |x: f32| 0.2 * x.floor().max(0.0);
        let ground = [step(time - 0.2), step(time + 0.2)];
        Pose { x: time, rise: 0.5 * (ground[0] + ground[1]), ground, ..Pose::default() }
    };
    let worth = |pose: &dyn Fn(f32) -> Pose| value(Climbing::default(), 10.5, pose);
    assert_near(worth(&stairs), 2.0 + 2.1);
    let flat = |time: f32| Pose { x: time, ..Pose::default() };
    assert_near(worth(&flat), 2.1);
    let rearing_up = |time: f32| Pose { rise: 0.1 * time, turn: 0.1 * time, ..Pose::default() };
    assert_eq!(worth(&rearing_up), 0.0);
    let leaping_at_the_end = |time: f32| Pose { rise: (time - 9.0).max(0.0), aloft: time > 9.0, ..Pose::default() };
    assert_eq!(worth(&leaping_at_the_end), 0.0);
    let down = |time: f32| Pose { ground: [-0.1 * time; 2], rise: -0.1 * time, x: time, ..Pose::default() };
    assert!(worth(&down) > 1.0 && worth(&down) < 1.1, "down is negative");
}

#[test]
fn getting_up_is_to_be_turned_and_high_and_to_stay_so() {
    use std::f32::consts::PI;
    // It lies with its torso at 0.5, and its legs of 0.4 m lift it by 0.32 m.
    let by = |turn: f32, rise: f32, until: f32| {
        move |time: f32| {
            let share = if time > until { 0.0 } else { (time / 2.0).min(1.0) };
            Pose { turn: turn * share, rise: rise * share, ..Pose::default() }
        }
    };
    let worth = |pose: &dyn Fn(f32) -> Pose| value(GettingUp::default(), 10.0, pose);
    // But for the first two seconds, which count little.
    assert!((0.95..1.0).contains(&worth(&by(PI, 0.35, 99.0))));
    assert!((0.95..1.0).contains(&worth(&by(-PI, 0.35, 99.0))));
    let at_once = |_: f32| Pose { turn: PI, rise: 0.35, ..Pose::default() };
    let from_the_start = |time: f32| if time > 0.0 { at_once(time) } else { Pose::default() };
    assert_near(worth(&from_the_start), 1.0);
    let hopping = |time: f32| Pose { up: 1.0, ..by(PI, 0.35, 99.0)(time) };
    assert_ranked(&[
        ("up", worth(&by(PI, 0.35, 99.0))),
        ("half up", worth(&by(PI, 0.16, 99.0))),
        ("hopping", worth(&hopping)),
        ("on its belly", worth(&by(PI, 0.0, 99.0))),
        ("on its end", worth(&by(0.5 * PI, 0.4, 99.0))),
        ("on its end, low", worth(&by(0.5 * PI, 0.0, 99.0))),
        ("a leap", worth(&by(0.3, 0.4, 99.0))),
        ("as it lay", worth(&by(0.0, 0.0, 99.0))),
    ]);
    assert!(worth(&by(PI, 0.35, 4.0)) < 0.15, "what is not held is worth little");
    let late = |time: f32| if time > 9.0 { at_once(time) } else { Pose::default() };
    assert!(worth(&late) < 0.2, "a body that is up for the last tenth has a fifth");
    assert!(worth(&by(2.0 * PI, 0.0, 99.0)) < 0.01, "a somersault that lies again");
    // On its side: one way is up, the other upside down.
    let side = |turn| GettingUp::new(GettingUpSettings { turn }).expect("a turn");
    assert!(value(side(90.0), 10.0, by(0.5 * PI, 0.35, 99.0)) > 0.95);
    assert!(value(side(-90.0), 10.0, by(-0.5 * PI, 0.35, 99.0)) > 0.95);
    assert_eq!(value(side(90.0), 10.0, by(-0.5 * PI, 0.35, 99.0)), 0.0);
    assert_eq!(value(side(90.0), 10.0, by(0.0, 0.35, 99.0)), 0.0);
}

#[test]
fn carrying_is_to_run_level() {
    let worth = |pose: &dyn Fn(f32) -> Pose| value(Carrying::default(), 10.0, pose);
    let run = |time: f32| Pose { x: time, ..Pose::default() };
    assert_near(worth(&run), 10.0);
    assert_near(worth(&|time| Pose { turn: 10_f32.to_radians(), ..run(time) }), 10.0);
    let tilted =
        |degrees: f32| move |time: f32| Pose { turn: if time > 0.0 { degrees.to_radians() } else { 0.0 }, ..run(time) };
    assert_near(worth(&tilted(10.0)), 5.0);
    assert_near(worth(&|time| Pose { up: 0.25, ..run(time) }), 5.0);
    assert_ranked(&[
        ("level", worth(&run)),
        ("tilted a little", worth(&tilted(5.0))),
        ("tilted much, the other way", worth(&tilted(-20.0))),
        ("upside down", worth(&tilted(180.0))),
        ("back", worth(&|time| Pose { x: -time, ..Pose::default() })),
    ]);
    // Forwards level and backwards tilted gets nowhere.
    let rocking = |time: f32| match time % 1.0 {
        phase if phase < 0.5 => Pose { x: phase, ..Pose::default() },
        phase => Pose { x: 1.0 - phase, turn: 1.0, ..Pose::default() },
    };
    assert!(worth(&rocking) < 0.05);
}

/// Gets ahead at a speed, m/s, with the motors at a power, W.
fn powered(speed: f32, power: f32) -> impl Fn(f32) -> Pose {
    move |time| Pose { x: speed * time, work: f64::from(power * time), ..Pose::default() }
}

#[test]
fn cruising_is_to_be_as_fast_as_wanted_and_cheap() {
    /// W, with which the puppet of 3 kg has a cost of transport of 1 at 2 m/s.
    const POWER: f32 = 2.0 * 3.0 * GRAVITY;
    let worth = |pose: &dyn Fn(f32) -> Pose| value(Cruising::default(), 10.0, pose);
    assert_near(worth(&powered(2.0, 0.0)), 20.0);
    assert_near(worth(&powered(2.0, POWER)), 10.0);
    assert_near(worth(&powered(1.0, POWER)), 10.0 / 3.0);
    assert_ranked(&[
        ("cheap", worth(&powered(2.0, 0.5 * POWER))),
        ("as fast as wanted", worth(&powered(2.0, POWER))),
        ("faster, for as much a metre", worth(&powered(5.0, 2.5 * POWER))),
        ("half as fast, for as much a metre", worth(&powered(1.0, 0.5 * POWER))),
        ("slow", worth(&powered(0.2, POWER))),
        ("kicking on the spot", worth(&powered(0.0, POWER))),
        ("backwards", worth(&powered(-1.0, POWER))),
    ]);
    assert_eq!(worth(&powered(5.0, POWER)), worth(&powered(2.0, POWER)), "more speed than is wanted earns nothing");
    assert_eq!(worth(&powered(0.0, 0.0)), 0.0, "still");
    assert_near(worth(&powered(-1.0, 0.0)), -10.0);
    assert_near(worth(&powered(-1.0, POWER)), -10.0);
    // Falls by 0.3 m, for nothing, and lies there.
    assert_near(worth(&|time| Pose { x: time.min(0.3), torso_touches: time > 0.3, ..Pose::default() }), 0.3);
    let leisurely = Cruising::new(CruisingSettings { speed: 0.5 }).expect("a speed");
    assert_near(value(leisurely, 10.0, powered(2.0, 0.0)), 5.0);
}

proptest! {
    /// It never pays to spend more, nor to get less far, and the value is never above the distance.
    #[test]
    fn cruising_pays_for_way_and_thrift(
        speed in -5.0..5.0_f32,
        more in 0.0..2.0_f32,
        power in 0.0..1000.0_f32,
        spared in 0.0..1.0_f32,
    ) {
        let worth = |speed: f32, power: f32| value(Cruising::default(), 2.0, powered(speed, power));
        let plain = worth(speed, power);
        prop_assert!(plain.is_finite() && plain <= 2.0 * f64::from(speed.abs()));
        prop_assert!((plain >= 0.0) == (speed >= 0.0));
        prop_assert!(worth(speed, spared * power) >= plain);
        prop_assert!(worth(speed + more, power) >= plain);
    }
}

#[test]
fn backwards_is_the_way_back_and_so_is_its_headway() {
    let back = |time: f32| Pose { x: -0.5 * time, ..Pose::default() };
    assert_near(value(Backwards::default(), 10.0, back), 5.0);
    assert_near(value(Backwards::default(), 10.0, |time| Pose { x: time, ..Pose::default() }), -10.0);
    let headway = Headway::new(HeadwaySettings { backwards: true }).expect("no limits");
    assert_eq!(value(headway.clone(), 10.0, back), 0.0);
    let mut movement = headway;
    movement.bind(&puppet());
    movement.begin(&Pose::default().snapshot(0.0));
    let ahead = |time: f32| Pose { x: time, ..Pose::default() }.snapshot(time);
    assert_eq!([0.5, 1.0].map(|time| movement.observe(&ahead(time))), [Verdict::GoOn, Verdict::End]);
}

#[test]
fn swimming_is_the_way_of_all_mass_and_not_of_a_part() {
    let ahead = |time: f32| Pose { x: 0.5 * time, rise: time, ..Pose::default() };
    assert_near(value(Swimming::default(), 10.0, ahead), 5.0);
    let rising = |time: f32| Pose { rise: time, ..Pose::default() };
    assert_near(value(Swimming::default(), 10.0, rising), 0.0);
    // The torso reaches out by 0.6 m, and is a quarter of the mass.
    let mut heavy = puppet();
    heavy.parts[1].mass = 2.0;
    let mut movement = Swimming::default();
    movement.bind(&heavy);
    let start = Pose::default().snapshot(0.0);
    movement.begin(&start);
    let mut reaching = start.clone();
    reaching.parts[0].x += 0.6;
    movement.observe(&reaching);
    assert_near(movement.value(), 0.15);
}
