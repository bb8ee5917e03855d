//! The terms that steer a search to usable gaits, on a puppet with two legs whose every move is written by hand.

mod jumps;

use std::f32::consts::TAU;
use tasks::{
    Alternation, Body, BodyHinge, BodyMotor, BodyPart, Command, Footfalls, Haste, Headway, Idleness, Landing, Leap,
    Movement, MovementCatalogue, MovementSpec, NoExploits, NoExploitsSettings, PartState, Posture, Rhythm,
    RhythmSettings, Running, Slip, Snapshot, Sum, TermSpec, Upright, Verdict, Vibration, conformance::check_movement,
};

const TIME_STEP: f32 = 0.02;
/// The hinges turn this far either way, rad.
const LIMIT: f32 = 1.0;
/// Hips of the left and of the right leg in the frame of the torso, m.
const HIPS: [[f32; 2]; 2] = [[-0.2, -0.1], [0.2, -0.1]];

/// A torso 0.4 m wide, its centre 0.5 m high at first, with two legs 0.4 m long.
fn puppet() -> Body {
    let part = |name: &str, corners: &[[f32; 2]]| BodyPart {
        name: name.into(),
        mass: 1.0,
        inertia: 0.01,
        buoyancy: 0.0,
        corners: corners.to_vec(),
        radius: 0.0,
    };
    let leg = |name| part(name, &[[0.0, -0.2], [0.0, 0.2]]);
    let hinge = |(index, parent_anchor): (usize, [f32; 2])| BodyHinge {
        parent: 0,
        child: index + 1,
        parent_anchor,
        child_anchor: [0.0, 0.2],
        start_angle: 0.0,
        limits: [-LIMIT, LIMIT],
        motor: Some(BodyMotor { top_speed: 10.0, top_torque: 10.0 }),
    };
    Body {
        body_length: 1.0,
        start_height: 0.5,
        start_angle: 0.0,
        gravity: 9.81,
        parts: vec![part("torso", &[[-0.2, -0.1], [0.2, 0.1]]), leg("left leg"), leg("right leg")],
        hinges: HIPS.into_iter().enumerate().map(hinge).collect(),
        legs: vec![vec![1], vec![2]],
        legless: false,
        uneven_ground: false,
    }
}

/// The puppet at one moment.
#[derive(Clone, Copy, Default)]
struct Pose {
    /// The torso's way forward and above its start, m, and its turn, rad.
    x: f32,
    rise: f32,
    turn: f32,
    /// The angles of the hips, rad.
    hips: [f32; 2],
    /// How high each foot is held above where the leg would reach, m; a leg that is held up touches nothing.
    lifted: [f32; 2],
    /// Of the torso, rad/s.
    spin: f32,
    torso_touches: bool,
}

impl Pose {
    fn snapshot(&self, time: f32) -> Snapshot {
        let (sin, cos) = libm::sincosf(self.turn);
        let torso = PartState {
            x: self.x,
            y: 0.5 + self.rise,
            cos,
            sin,
            spin: self.spin,
            touching: self.torso_touches,
            ..PartState::default()
        };
        let leg = |index: usize| {
            let [hip_x, hip_y] = HIPS[index];
            let (sin, cos) = libm::sincosf(self.turn + self.hips[index]);
            let x = torso.x + torso.cos * hip_x - torso.sin * hip_y + 0.2 * sin;
            let y = torso.y + torso.sin * hip_x + torso.cos * hip_y - 0.2 * cos + self.lifted[index];
            PartState { x, y, cos, sin, touching: self.lifted[index] == 0.0, ..PartState::default() }
        };
        Snapshot { time, parts: vec![torso, leg(0), leg(1)], motor_work: 0.0, ..Snapshot::default() }
    }
}

/// Snapshots of so many seconds, a time step apart.
fn script(seconds: f32, pose: impl Fn(f32) -> Pose) -> Vec<Snapshot> {
    let steps = (seconds / TIME_STEP).round() as u16;
    let time = |step: u16| f32::from(step) * TIME_STEP;
    (0..=steps).map(|step| pose(time(step)).snapshot(time(step))).collect()
}

/// What a movement said.
#[derive(Debug, PartialEq)]
struct Seen {
    value: f64,
    /// When it ended the episode, s, and how.
    end: Option<(f32, Verdict)>,
}

/// Shows a movement that has met this body the script, until it has seen enough. Its value must stay the same on a
/// second showing.
fn watch(mut movement: impl Movement, body: &Body, script: &[Snapshot]) -> Seen {
    movement.bind(body);
    let mut show = || {
        movement.begin(&script[0]);
        let mut verdicts = script[1..].iter().map(|now| (now.time, movement.observe(now)));
        let end = verdicts.find(|&(_, verdict)| verdict != Verdict::GoOn);
        Seen { value: movement.value(), end }
    };
    let seen = show();
    assert_eq!(show(), seen, "the second time it is another");
    seen
}

/// The value of a movement that never ends the episode.
fn value(movement: impl Movement, body: &Body, script: &[Snapshot]) -> f64 {
    let Seen { value, end } = watch(movement, body, script);
    assert_eq!(end, None);
    value
}

/// The value of a movement that ends the episode at this time.
#[track_caller]
fn assert_ends(seen: Seen, at: f32, value: f64) {
    let (time, verdict) = seen.end.expect("it ends the episode");
    assert_eq!((verdict, seen.value), (Verdict::End, value));
    assert!((time - at).abs() < 1.5 * TIME_STEP, "ends at {time} s, expected {at} s");
}

fn sine(frequency: f32, time: f32) -> f32 {
    libm::sinf(TAU * frequency * time)
}

#[test]
fn each_passes_the_check_of_movements_before_and_after_it_has_met_a_body() {
    let torso = BodyPart { corners: vec![[0.0, 0.0]], ..BodyPart::default() };
    let motor = Some(BodyMotor::default());
    // All that fits every body the check shows: one part, that is its own leg.
    let hinge = BodyHinge { limits: [-1.0, 1.0], motor, ..BodyHinge::default() };
    let simple = Body { parts: vec![torso], hinges: vec![hinge], legs: vec![vec![0]], ..Body::default() };
    let movements: [Box<dyn Movement>; 13] = [
        Box::new(Upright::default()),
        Box::new(Footfalls::default()),
        Box::new(Alternation::default()),
        Box::new(Headway::default()),
        Box::new(Vibration::default()),
        Box::new(Idleness::default()),
        Box::new(Leap::default()),
        Box::new(NoExploits::default()),
        Box::new(Posture::default()),
        Box::new(Haste::default()),
        Box::new(Slip::default()),
        Box::new(Rhythm::default()),
        Box::new(Landing::default()),
    ];
    let catalogue = MovementCatalogue::default();
    for mut movement in movements {
        let name = movement.name().to_owned();
        assert_eq!(check_movement(&*movement), Ok(()), "{name}, unmet");
        movement.bind(&simple);
        assert_eq!(check_movement(&*movement), Ok(()), "{name}, met");
        let spec = MovementSpec { steps: Some(10), ..MovementSpec::new(&name) };
        assert_eq!(catalogue.build(&spec).expect("it is in the catalogue").name(), name);
    }
}

#[test]
fn upright_ends_an_episode_beyond_60_degrees_from_the_start() {
    let degrees = |speed: f32, from: f32| {
        script(2.0, move |time| Pose { turn: (from + speed * time).to_radians(), ..Pose::default() })
    };
    let body = puppet();
    assert_eq!(value(Upright::default(), &body, &degrees(29.0, 0.0)), 0.0);
    assert_eq!(value(Upright::default(), &body, &degrees(-29.0, 80.0)), 0.0, "what counts is the turn since the start");
    assert_ends(watch(Upright::default(), &body, &degrees(60.0, 0.0)), 1.0, 1.0);
    assert_ends(watch(Upright::default(), &body, &degrees(-60.0, 0.0)), 1.0, 1.0);
    // A whole turn is not where it began.
    assert_ends(watch(Upright::within(1.75 * TAU), &body, &degrees(360.0, 0.0)), 1.75, 1.0);
    assert_eq!(value(Upright::within(2.1 * TAU), &body, &degrees(-360.0, 0.0)), 0.0);
}

#[test]
fn headway_ends_an_episode_after_a_second_with_too_little_of_it() {
    let at = |speed: f32, until: f32| script(5.0, move |time| Pose { x: speed * time.min(until), ..Pose::default() });
    let body = puppet();
    assert_eq!(value(Headway::default(), &body, &at(0.25, 5.0)), 0.0);
    assert_ends(watch(Headway::default(), &body, &at(0.15, 5.0)), 1.0, 1.0);
    assert_ends(watch(Headway::default(), &body, &at(0.0, 5.0)), 1.0, 1.0);
    assert_ends(watch(Headway::default(), &body, &at(-3.0, 5.0)), 1.0, 1.0);
    assert_ends(watch(Headway::default(), &body, &at(1.0, 2.5)), 4.0, 1.0);
    // What is much for a small body is little for a large one.
    let large = Body { body_length: 2.0, ..puppet() };
    assert_ends(watch(Headway::default(), &large, &at(0.25, 5.0)), 1.0, 1.0);
}

#[test]
fn footfalls_ends_an_episode_when_half_of_the_legs_rest_or_hang() {
    /// Lifts its foot so high, m, in every second 0.4 s, from `phase` seconds on.
    fn steps(height: f32, phase: f32) -> impl Fn(f32) -> f32 {
        move |time| if (time + phase) % 0.8 < 0.4 { 0.0 } else { height }
    }
    let walk = |left: &dyn Fn(f32) -> f32, right: &dyn Fn(f32) -> f32| {
        script(6.0, |time| Pose { lifted: [left(time), right(time)], ..Pose::default() })
    };
    let (good, other, rests, hangs) = (steps(0.05, 0.0), steps(0.05, 0.4), |_: f32| 0.0, |_: f32| 0.05);
    let body = puppet();
    let footfalls =
        |left: &dyn Fn(f32) -> f32, right: &dyn Fn(f32) -> f32| watch(Footfalls::default(), &body, &walk(left, right));
    assert_eq!(footfalls(&good, &other), Seen { value: 0.0, end: None });
    assert_ends(footfalls(&good, &rests), 0.9, 0.0);
    assert_ends(footfalls(&hangs, &good), 0.9, 0.0);
    assert_ends(footfalls(&rests, &hangs), 0.9, 0.0);
    // From 2 s on it drags its foot: it was last down at 1.6 s, and never more than 2 cm up since 1.2 s.
    let drags = |time: f32| if time < 2.0 { good(time) } else { steps(0.02, 0.0)(time) };
    assert_ends(footfalls(&drags, &good), 2.12, 0.0);
    assert_ends(footfalls(&good, &|time| if time < 3.2 { good(time) } else { 0.0 }), 3.72, 0.0);
    // Below height 0 no foot is ever 3 cm above it; on ground that may be there it is lifted all the same.
    let below = script(6.0, |time| Pose { lifted: [good(time), other(time)], rise: -1.0, ..Pose::default() });
    assert_ends(watch(Footfalls::default(), &body, &below), 0.9, 0.0);
    let uneven = Body { uneven_ground: true, ..puppet() };
    assert_eq!(watch(Footfalls::default(), &uneven, &below), Seen { value: 0.0, end: None });
    assert_ends(watch(Footfalls::default(), &uneven, &walk(&good, &rests)), 0.9, 0.0);
    // A body without legs cannot rest them.
    let legless = Body { legless: true, ..puppet() };
    assert_eq!(value(Footfalls::default(), &legless, &walk(&rests, &rests)), 0.0);
}

#[test]
fn alternation_is_the_way_made_by_steps_that_do_not_take_turns() {
    /// Lifts its foot in every second 0.4 s, from `phase` seconds on.
    fn steps(phase: f32) -> impl Fn(f32) -> f32 {
        move |time| if (time + phase) % 0.8 < 0.4 { 0.05 } else { 0.0 }
    }
    let run = |left: &dyn Fn(f32) -> f32, right: &dyn Fn(f32) -> f32| {
        script(4.01, |time| Pose { x: time, lifted: [left(time), right(time)], ..Pose::default() })
    };
    let way = |body: &Body, run: &[Snapshot]| (value(Alternation::default(), body, run) * 100.0).round() / 100.0;
    let body = puppet();
    assert_eq!(way(&body, &run(&steps(0.0), &steps(0.4))), 0.0, "half a turn apart");
    assert_eq!(way(&body, &run(&steps(0.0), &steps(0.12))), 0.0, "one right after the other");
    // The first of five strides has no foot that came down before.
    let hops = run(&steps(0.0), &steps(0.0));
    assert_eq!(way(&body, &hops), 3.2, "both at once");
    assert_eq!(way(&body, &run(&steps(0.0), &|_| 0.0)), 3.2, "one leg alone");
    assert_eq!(way(&body, &run(&steps(0.0), &steps(0.05))), 3.2, "both within 0.1 s");
    let back = script(4.01, |time| Pose { x: -time, lifted: [steps(0.0)(time); 2], ..Pose::default() });
    assert_eq!(way(&body, &back), 3.2, "both at once, backwards");
    // After a hop on both feet either may come down next.
    let then = |phase: f32| move |time: f32| steps(if time < 1.0 { 0.0 } else { phase })(time);
    for (left, right) in [(0.0, 0.4), (0.4, 0.0)] {
        assert_eq!(way(&body, &run(&then(left), &then(right))), 0.0, "one hop, then in turn");
    }
    // A foot that bounces costs the way since it came down, and not that to a landing that took its turn.
    let bounces = |time: f32| if (2.03..2.07).contains(&time) { 0.05 } else { steps(0.0)(time) };
    assert_eq!(way(&body, &run(&bounces, &steps(0.4))), 0.06, "a bounce");
    // What leaves the ground by less than 3 cm has not stepped.
    let shivers = |time: f32| if time % 0.2 < 0.1 { 0.02 } else { 0.0 };
    assert_eq!(way(&body, &run(&steps(0.0), &shivers)), 3.2);
    // A jump may leave and land as it likes, for 1.5 s: of four hops one still counts.
    let mut jump = hops.clone();
    for now in &mut jump {
        now.command = Command { since_press: now.time - 1.0, ..Command::default() };
        if now.time < 1.0 {
            now.command = Command::default();
        }
    }
    assert_eq!(way(&body, &jump), 0.8);
    for other in [Body { legs: vec![vec![1]; 3], ..puppet() }, Body { legless: true, ..puppet() }] {
        assert_eq!(way(&other, &hops), 0.0, "not of two legs");
    }
}

#[test]
fn footfalls_is_the_way_made_on_idle_legs() {
    // Steps for 2 s; then a leg rests, which is idle 0.9 s after its foot was last up, at 1.6 s.
    let steps = |time: f32| if time % 0.8 < 0.4 { 0.0 } else { 0.05 };
    let rests = |time: f32| if time < 2.0 { steps(time) } else { 0.0 };
    let run = script(6.0, |time| Pose { x: 2.0 * time, lifted: [steps(time), rests(time)], ..Pose::default() });
    let last_up = 1.2;
    let idle = 6.0 - last_up - 0.9;
    let way = |legs: &[usize]| {
        let legs = legs.iter().map(|&leg| vec![leg]).collect();
        value(Footfalls::default(), &Body { legs, ..puppet() }, &run)
    };
    assert_eq!(way(&[1, 1, 1]), 0.0, "all legs step");
    // Of ten legs one is idle: three tenths of the way are charged for; of four one: three quarters; of three: all.
    for (legs, share) in [(10, 0.3), (4, 0.75), (3, 1.0)] {
        let found = way(&[&vec![1; legs - 1][..], &[2]].concat());
        let expected = share * 2.0 * idle;
        assert!((found - expected).abs() < 0.15, "{legs} legs: {found} m, expected {expected} m");
    }
}

#[test]
fn posture_is_the_way_made_out_of_it() {
    let body = puppet();
    let at = |degrees: f32| {
        script(3.0, move |time| Pose {
            x: time,
            turn: if time > 0.0 { degrees.to_radians() } else { 0.0 },
            ..Pose::default()
        })
    };
    let way = |degrees: f32| value(Posture::default(), &body, &at(degrees));
    for (degrees, share) in [(0.0, 0.0), (20.0, 0.25), (-20.0, 0.25), (30.0, 0.5625), (50.0, 1.0)] {
        assert!((way(degrees) - 3.0 * share).abs() < 0.01, "{degrees}°: {}", way(degrees));
    }
    assert!(watch(Posture::default(), &body, &at(61.0)).end.is_some(), "fallen");
    // The torso is down to half of its start height, and ends it where it would lie.
    let low = |share: f32| {
        script(3.0, move |time| Pose {
            x: time,
            rise: if time > 0.0 { (share - 1.0) * 0.5 } else { 0.0 },
            ..Pose::default()
        })
    };
    assert!((value(Posture::default(), &body, &low(0.6)) - 3.0).abs() < 0.01);
    assert_eq!(value(Posture::default(), &body, &low(0.7)), 0.0);
    assert!(watch(Posture::default(), &body, &low(0.45)).end.is_some(), "lies");
    let legless = Body { legless: true, ..puppet() };
    assert_eq!(value(Posture::default(), &legless, &at(90.0)), 0.0);
}

#[test]
fn haste_is_the_way_beyond_a_wanted_speed() {
    let at = |speed: f32| script(3.0, move |time| Pose { x: speed * time, ..Pose::default() });
    let beyond = |speed: f32| value(Haste::default(), &puppet(), &at(speed));
    assert_eq!((beyond(1.0), beyond(1.99)), (0.0, 0.0));
    assert!((beyond(3.0) - 3.0).abs() < 0.01, "{}", beyond(3.0));
    let large = Body { body_length: 2.0, ..puppet() };
    assert_eq!(value(Haste::default(), &large, &at(3.0)), 0.0);
}

#[test]
fn rhythm_is_the_way_made_out_of_the_rhythm_of_the_clock() {
    let swing = |frequency: f32, direction: f32| {
        script(6.0, move |time| Pose {
            x: direction * time,
            hips: [0.4 * sine(frequency, time), 0.4 * sine(2.0 * frequency, time)],
            ..Pose::default()
        })
    };
    let rhythm = |script: &[Snapshot]| value(Rhythm::default(), &puppet(), script);
    // The stride of the clock is 0.5 s.
    assert!(rhythm(&swing(2.0, 1.0)) < 0.01, "in time");
    assert!(rhythm(&swing(4.0, -1.0)) < 0.01, "two strides repeat as well");
    assert_eq!(rhythm(&swing(0.0, 1.0)), 0.0, "legs that keep still have no rhythm to lose");
    assert!((rhythm(&swing(1.0, -1.0)) - 6.0).abs() < 0.1, "one leg is where the other one belongs");
    let one =
        script(6.0, |time| Pose { x: time, hips: [0.4 * sine(2.0, time), 0.4 * sine(2.5, time)], ..Pose::default() });
    assert!((rhythm(&one) - 3.0).abs() < 0.1, "one leg of two keeps time: {}", rhythm(&one));
    assert_eq!(rhythm(&script(0.48, |time| Pose { x: time, ..Pose::default() })), 0.0, "shorter than a stride");
    let slow = Rhythm::new(RhythmSettings { period: 1.0 }).expect("in range");
    assert!(value(slow, &puppet(), &swing(1.0, 1.0)) < 0.01);
    // Three short steps in place of one: the same swing, looked at as often.
    let fine: Vec<Snapshot> = (0..=1800_u16)
        .map(|step| f32::from(step) / 300.0)
        .map(|time| {
            Pose { x: time, hips: [0.4 * sine(2.0, time), 0.2 * sine(2.5, time)], ..Pose::default() }.snapshot(time)
        })
        .collect();
    let coarse =
        script(6.0, |time| Pose { x: time, hips: [0.4 * sine(2.0, time), 0.2 * sine(2.5, time)], ..Pose::default() });
    assert!((rhythm(&fine) - rhythm(&coarse)).abs() < 0.05, "{} {}", rhythm(&fine), rhythm(&coarse));
    for period in [0.0, 0.04, 5.1, f32::NAN] {
        let error = Rhythm::new(RhythmSettings { period }).expect_err("out of range").to_string();
        assert!(error.starts_with("period = ") && error.ends_with("must be from 0.05 to 5"), "{error}");
    }
}

#[test]
fn vibration_is_the_reversals_a_second_beyond_8() {
    let swing = |[left, right]: [f32; 2], amplitude: f32| {
        script(4.0, move |time| Pose {
            hips: [amplitude * sine(left, time), amplitude * sine(right, time)],
            turn: 0.3 * sine(0.5, time),
            ..Pose::default()
        })
    };
    let (body, vibration) = (puppet(), |body: &Body, script: &[Snapshot]| value(Vibration::default(), body, script));
    assert_eq!(vibration(&body, &swing([0.0, 0.0], 0.4)), 0.0);
    assert_eq!(vibration(&body, &swing([3.5, 1.0], 0.4)), 0.0);
    // 12 reversals a second in one of two joints: 4 too many; the first and the last may be cut off.
    let one = vibration(&body, &swing([6.0, 1.0], 0.4));
    assert!((one - 2.0).abs() < 0.3, "{one}");
    let both = vibration(&body, &swing([6.0, 6.0], 0.4));
    assert!((both - 2.0 * one).abs() < 1e-9, "{both}");
    let degree = TAU / 360.0;
    assert_eq!(vibration(&body, &swing([6.0, 6.0], 0.9 * degree)), 0.0, "it shivers by less than 2°");
    let mut passive = puppet();
    passive.hinges.iter_mut().for_each(|hinge| hinge.motor = None);
    assert_eq!(vibration(&passive, &swing([6.0, 6.0], 0.4)), 0.0);
}

#[test]
fn idleness_is_the_share_of_motion_left_out_since_the_first_second() {
    let swing = |left: f32, right: f32, from: f32, until: f32| {
        script(4.0, move |time| {
            let moved = if time < from || time > until { 0.0 } else { sine(1.0, time) };
            Pose { hips: [left.to_radians() * moved, right.to_radians() * moved], turn: time, ..Pose::default() }
        })
    };
    let body = puppet();
    let assert_idle = |script: &[Snapshot], expected: f64| {
        let found = value(Idleness::default(), &body, script);
        assert!((found - expected).abs() < 0.01, "{found}, expected {expected}");
    };
    assert_idle(&swing(0.0, 0.0, 0.0, 4.0), 1.0);
    assert_idle(&swing(15.5, 40.0, 0.0, 4.0), 0.0);
    assert_idle(&swing(40.0, 0.0, 0.0, 4.0), 0.5);
    assert_idle(&swing(7.5, 7.5, 0.0, 4.0), 0.5);
    assert_idle(&swing(40.0, 40.0, 0.0, 0.98), 1.0);
    // What is more than half a turn apart looks closer again.
    for tenths in 21..40 {
        let steps = swing(95.0, 170.0, 0.0, 4.0).into_iter().take_while(|now| now.time < tenths as f32 / 10.0);
        assert_idle(&steps.collect::<Vec<_>>(), 0.0);
    }
    assert_eq!(value(Idleness::default(), &body, &swing(40.0, 40.0, 0.0, 4.0)[..40]), 1.0, "over within a second");
    assert_eq!(value(Idleness::default(), &Body::default(), &swing(0.0, 0.0, 0.0, 4.0)), 0.0, "nothing is expected");
}

#[test]
fn honest_fails_what_lives_on_errors_of_the_physics() {
    let body = puppet();
    // The flaw is there from 1 s on; it is seen within three steps.
    let honest = |flaw: &dyn Fn(&mut Pose, &mut Vec<PartState>)| {
        let snapshots = script(2.0, |_| Pose::default()).into_iter().map(|snapshot| {
            if snapshot.time < 0.99 {
                return snapshot;
            }
            let mut pose = Pose::default();
            flaw(&mut pose, &mut Vec::new());
            let mut flawed = pose.snapshot(snapshot.time);
            flaw(&mut pose, &mut flawed.parts);
            flawed
        });
        let snapshots: Vec<_> = snapshots.collect();
        let seen = watch(NoExploits::default(), &body, &snapshots);
        assert_eq!(seen.value, 0.0);
        // Told to, it ends the episode at the same time in place of failing it.
        let ending = NoExploits::new(NoExploitsSettings { ends: true }).expect("in range");
        let ended = watch(ending, &body, &snapshots);
        assert_eq!(ended.value, f64::from(u8::from(seen.end.is_some())));
        assert_eq!(ended.end, seen.end.map(|(time, _)| (time, Verdict::End)));
        seen.end.map(|(time, verdict)| {
            assert!((0.99..1.05).contains(&time), "{time}");
            verdict
        })
    };
    let leg_apart = |by: f32| {
        move |_: &mut Pose, parts: &mut Vec<PartState>| {
            if let Some(leg) = parts.get_mut(2) {
                leg.x += by;
            }
        }
    };
    assert_eq!(honest(&leg_apart(0.055)), None);
    assert_eq!(honest(&leg_apart(-0.065)), Some(Verdict::Fail("a joint comes apart")));
    let bent = |angle: f32| {
        move |pose: &mut Pose, _: &mut Vec<PartState>| {
            pose.hips[0] = angle;
            pose.rise = 0.2;
        }
    };
    let degree = TAU / 360.0;
    assert_eq!(honest(&bent(LIMIT + 17.0 * degree)), None);
    assert_eq!(honest(&bent(-LIMIT - 17.0 * degree)), None);
    let beyond = Some(Verdict::Fail("a joint is turned beyond its limits"));
    assert_eq!((honest(&bent(LIMIT + 19.0 * degree)), honest(&bent(-LIMIT - 19.0 * degree))), (beyond, beyond));
    let spinning = |spin: f32| move |pose: &mut Pose, _: &mut Vec<PartState>| pose.spin = spin;
    assert_eq!(honest(&spinning(34.0)), None);
    assert_eq!(honest(&spinning(-36.0)), Some(Verdict::Fail("a part turns faster than the engine can follow")));
    let sunk = |by: f32| move |pose: &mut Pose, _: &mut Vec<PartState>| pose.rise = -by;
    assert_eq!(honest(&sunk(0.055)), None);
    assert_eq!(honest(&sunk(0.065)), Some(Verdict::Fail("a part sinks into the ground")));
    let uneven = Body { uneven_ground: true, ..puppet() };
    let below = script(2.0, |_| Pose { rise: -0.065, ..Pose::default() });
    assert_eq!(watch(NoExploits::default(), &uneven, &below).end, None, "the ground may be there");
}

#[test]
fn honest_fails_what_gains_energy_from_nowhere() {
    let torso = BodyPart { mass: 8.0, ..puppet().parts[0].clone() };
    let body = Body { parts: vec![torso, puppet().parts[1].clone(), puppet().parts[2].clone()], ..puppet() };
    // From 1 s on it rises, 98 J for a metre; the motors work for so much of it. 7 J and 0.175 × 49 J may be gained.
    let rising = |share: f64, speed: f32| {
        let film = script(2.0, |time| Pose { rise: (time - 1.0).max(0.0) * speed, ..Pose::default() });
        let worked = film.into_iter().map(|snapshot| {
            let risen = f64::from(snapshot.parts[0].y - 0.5);
            Snapshot { motor_work: share * 98.1 * risen, ..snapshot }
        });
        watch(NoExploits::default(), &body, &worked.collect::<Vec<_>>()).end.map(|(_, verdict)| verdict)
    };
    let caught = Some(Verdict::Fail("it gains energy from nowhere"));
    assert_eq!((rising(1.0, 1.0), rising(0.0, 1.0)), (None, caught));
    // So slowly that it is less within half a second.
    assert_eq!((rising(0.0, 0.25), rising(0.8, 1.0)), (None, None));
    let still = Body { gravity: 0.0, ..body.clone() };
    let floating = script(2.0, |time| Pose { rise: time, ..Pose::default() });
    assert_eq!(watch(NoExploits::default(), &still, &floating).end, None, "nothing pulls it down");
}

/// Says what it is told to at one step.
#[derive(Clone)]
struct Says(Verdict, u32, u32);

impl Movement for Says {
    fn name(&self) -> &str {
        "says"
    }
    fn unit(&self) -> &str {
        "1"
    }
    fn begin(&mut self, _: &Snapshot) {
        self.2 = 0;
    }
    fn observe(&mut self, _: &Snapshot) -> Verdict {
        self.2 += 1;
        if self.2 == self.1 { self.0 } else { Verdict::GoOn }
    }
    fn value(&self) -> f64 {
        0.0
    }
}

#[test]
fn a_sum_passes_on_the_strictest_verdict() {
    let says = |verdict, at| Says(verdict, at, 0);
    let (fail, end) = (Verdict::Fail("first"), Verdict::End);
    let verdict = |terms: &[Says]| {
        let sum = terms.iter().fold(Sum::of(Running::default()), |sum, term| sum.plus(1.0, term.clone()));
        watch(sum, &puppet(), &script(1.0, |_| Pose::default())).end.map(|(_, verdict)| verdict)
    };
    assert_eq!(verdict(&[says(fail, 3)]), Some(fail));
    assert_eq!(verdict(&[says(end, 3), says(fail, 3)]), Some(fail));
    assert_eq!(verdict(&[says(fail, 3), says(end, 3)]), Some(fail));
    assert_eq!(verdict(&[says(fail, 3), says(Verdict::Fail("second"), 3)]), Some(fail));
    assert_eq!(verdict(&[says(end, 2), says(fail, 3)]), Some(end), "it was over before");
    assert_eq!(verdict(&[says(fail, 100)]), None);
}

/// A sum has all its terms meet the body; one that had not would find nothing wrong.
#[test]
fn terms_of_a_sum_meet_the_body() {
    let rests = script(3.0, |_| Pose::default());
    let spec = |term: &str| MovementSpec { terms: vec![TermSpec::new(term, -1.0)], ..MovementSpec::new("running") };
    let catalogue = MovementCatalogue::default();
    for (term, at) in [("footfalls", 0.9), ("headway", 1.0)] {
        let mut movement = catalogue.build(&spec(term)).expect("it is in the catalogue");
        movement.bind(&puppet());
        movement.begin(&rests[0]);
        let end = rests[1..].iter().find(|now| movement.observe(now) != Verdict::GoOn).expect("it ends");
        assert!((end.time - at).abs() < 1.5 * TIME_STEP, "{term}: {}", end.time);
    }
}
