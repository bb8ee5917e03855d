//! Raw values in, scaled values out.

mod common;

use std::{
    f32::consts::{FRAC_PI_2, PI},
    sync::Arc,
};

use common::small;
use creatures::{Actuation, Blueprint, BodyView, Channel, CreatureError, CustomSensor, Motors, Sense, Senses, Sensor};

/// A body that tells made-up values.
#[derive(Default)]
struct Body {
    rotation: f32,
    spin: f32,
    angles: [f32; 2],
    speeds: [f32; 2],
    velocity: [f32; 2],
    height: f32,
    contacts: [bool; 3],
    slips: [f32; 3],
    gap: [f32; 2],
    distance: f32,
    time: f32,
    stride_began: f32,
    told: (f32, bool, f32),
}

impl BodyView for Body {
    fn torso_rotation(&self) -> f32 {
        self.rotation
    }
    fn torso_spin(&self) -> f32 {
        self.spin
    }
    fn joint_angle(&self, hinge: usize) -> f32 {
        self.angles[hinge]
    }
    fn joint_speed(&self, hinge: usize) -> f32 {
        self.speeds[hinge]
    }
    fn torso_velocity(&self) -> [f32; 2] {
        self.velocity
    }
    fn torso_height(&self) -> f32 {
        self.height
    }
    fn touches_ground(&self, part: usize) -> bool {
        self.contacts[part]
    }
    fn slip(&self, part: usize) -> f32 {
        self.slips[part]
    }
    fn next_gap(&self, _: f32) -> [f32; 2] {
        self.gap
    }
    fn distance_along_ray(&self, angle: f32, length: f32) -> f32 {
        // Downward rays see the ground.
        if angle < 0.0 { self.distance } else { length }
    }
    fn time(&self) -> f32 {
        self.time
    }

    fn time_since_landing(&self) -> f32 {
        self.time - 2.0
    }

    fn commanded_speed(&self) -> f32 {
        self.told.0
    }

    fn is_told_to_jump(&self) -> bool {
        self.told.1
    }

    fn time_since_press(&self) -> f32 {
        self.told.2
    }

    fn stride_time(&self) -> f32 {
        self.time - self.stride_began
    }
}

fn all_sensors() -> Vec<Sensor> {
    vec![
        Sensor::TorsoRotation,
        Sensor::JointAngles,
        Sensor::JointSpeeds,
        Sensor::TorsoVelocity,
        Sensor::TorsoHeight,
        Sensor::FootContacts,
        Sensor::Rangefinder { angles: vec![-30.0, 0.0], length: 4.0 },
        Sensor::Clock { period: 2.0 },
        Sensor::TorsoSpin,
        Sensor::HeightAboveGround,
        Sensor::FootSlip,
        Sensor::NextGap { length: 4.0 },
    ]
}

fn blueprint() -> Blueprint {
    Blueprint::from_json(&small().to_string()).expect("valid")
}

fn senses(sensors: &[Sensor], range: f32) -> Senses {
    Senses::new(&blueprint(), sensors, range).expect("valid")
}

fn read(senses: &Senses, body: &Body) -> Vec<f32> {
    let mut inputs = vec![0.0; senses.len()];
    senses.read(body, &mut inputs);
    inputs
}

#[test]
fn no_two_channels_have_one_name() {
    let ray = |length| Sensor::Rangefinder { angles: vec![0.0], length };
    let senses =
        senses(&[ray(1.0), Sensor::NextGap { length: 4.0 }, ray(2.0), Sensor::NextGap { length: 2.0 }, ray(3.0)], 3.0);
    let names: Vec<&str> = senses.channels().iter().map(|channel| channel.name.as_str()).collect();
    let expected = [
        "distance at 0°",
        "distance to next gap",
        "width of next gap",
        "distance at 0° (2)",
        "distance to next gap (2)",
        "width of next gap (2)",
        "distance at 0° (3)",
    ];
    assert_eq!(names, expected);
}

#[test]
fn channels_have_names_units_and_ranges() {
    let senses = senses(&all_sensors(), 3.0);
    let sixty = 60f32.to_radians();
    let expected: [(&str, &str, [f32; 2]); 20] = [
        ("rotation of torso", "rad", [-PI, PI]),
        ("angle of left leg", "rad", [-sixty, sixty]),
        ("angle of right leg", "rad", [-sixty, sixty]),
        ("speed of left leg", "rad/s", [-20.0, 20.0]),
        ("speed of right leg", "rad/s", [-20.0, 20.0]),
        ("forward velocity of torso", "m/s", [-5.0, 5.0]),
        ("upward velocity of torso", "m/s", [-5.0, 5.0]),
        ("height of torso above start", "m", [-0.8, 0.8]),
        ("contact of left leg", "", [0.0, 1.0]),
        ("contact of right leg", "", [0.0, 1.0]),
        ("distance at -30°", "m", [0.0, 4.0]),
        ("distance at 0°", "m", [0.0, 4.0]),
        ("sine of 2 s clock", "", [-1.0, 1.0]),
        ("cosine of 2 s clock", "", [-1.0, 1.0]),
        ("spin of torso", "rad/s", [-10.0, 10.0]),
        ("height of torso above ground", "m", [0.0, 1.6]),
        ("slip of left leg", "m/s", [-2.0, 2.0]),
        ("slip of right leg", "m/s", [-2.0, 2.0]),
        ("distance to next gap", "m", [0.0, 4.0]),
        ("width of next gap", "m", [0.0, 4.0]),
    ];
    assert_eq!(senses.len(), expected.len());
    for (channel, (name, unit, range)) in senses.channels().iter().zip(expected) {
        assert_eq!((channel.name.as_str(), channel.unit), (name, unit));
        assert!((channel.range[0] - range[0]).abs() + (channel.range[1] - range[1]).abs() < 1e-5, "{channel:?}");
    }
}

#[test]
fn ends_of_the_ranges_become_the_input_range() {
    for range in [1.0, 3.0] {
        let senses = senses(&all_sensors(), range);
        for (end, contact, quarter) in [(0, false, 1.5), (1, true, 0.5)] {
            let raw = |channel: usize| senses.channels()[channel].range[end];
            let body = Body {
                rotation: raw(0),
                spin: raw(14),
                angles: [raw(1), raw(2)],
                speeds: [raw(3), raw(4)],
                velocity: [raw(5), raw(6)],
                height: raw(7),
                contacts: [contact; 3],
                slips: [0.0, raw(16), raw(17)],
                gap: [raw(18), raw(19)],
                distance: raw(10),
                time: quarter,
                stride_began: 0.0,
                told: (0.0, false, 0.0),
            };
            let expected = if end == 0 { -range } else { range };
            let inputs = read(&senses, &body);
            for (channel, input) in inputs.iter().enumerate() {
                let expected = match channel {
                    11 => range, // this ray never hits anything
                    13 => 0.0,   // the cosine, when the sine is at its end
                    _ => expected,
                };
                assert!((input - expected).abs() < 1e-5, "channel {channel}: {input}, expected {expected}");
            }
        }
    }
}

#[test]
fn the_middle_becomes_zero_and_values_beyond_are_clamped() {
    let senses = senses(&all_sensors(), 3.0);
    let middle = read(&senses, &Body { distance: 2.0, ..Body::default() });
    for channel in (0..8).chain([10, 12, 14, 16, 17]) {
        assert_eq!(middle[channel], 0.0, "channel {channel}");
    }
    let beyond = Body { rotation: 99.0, angles: [-99.0, f32::INFINITY], height: -99.0, ..Body::default() };
    let inputs = read(&senses, &beyond);
    assert_eq!([inputs[0], inputs[1], inputs[2], inputs[7]], [3.0, -3.0, 3.0, -3.0]);
}

#[test]
fn the_thesis_scaling_is_linear() {
    let senses = senses(&Sensor::defaults(), 3.0);
    let inputs = read(&senses, &Body { rotation: FRAC_PI_2, ..Body::default() });
    assert!((inputs[0] - 1.5).abs() < 1e-6);
}

#[test]
fn not_a_number_stays_so() {
    let senses = senses(&all_sensors(), 3.0);
    let nan = f32::NAN;
    let body = Body {
        rotation: nan,
        spin: nan,
        angles: [nan; 2],
        speeds: [nan; 2],
        velocity: [nan; 2],
        height: nan,
        contacts: [false; 3],
        slips: [nan; 3],
        gap: [nan; 2],
        distance: nan,
        time: nan,
        stride_began: 0.0,
        told: (0.0, false, 0.0),
    };
    let inputs = read(&senses, &body);
    let finite: Vec<usize> = (0..inputs.len()).filter(|&channel| !inputs[channel].is_nan()).collect();
    assert_eq!(finite, [8, 9, 11]);

    let motors = Motors::new(&blueprint());
    let mut speeds = [0.0; 2];
    motors.speeds(&body, &[nan, 1.0], &mut speeds);
    assert!(speeds[0].is_nan());
    assert_eq!(speeds[1], 10.0);
}

#[test]
fn motors_scale_and_clamp() {
    let motors = Motors::new(&blueprint());
    let mut speeds = [0.0; 2];
    motors.speeds(&Body::default(), &[-0.5, 7.0], &mut speeds);
    assert_eq!(speeds, [-5.0, 10.0]);
    motors.speeds(&Body::default(), &[f32::NEG_INFINITY, 0.0], &mut speeds);
    assert_eq!(speeds, [-10.0, 0.0]);
}

#[test]
fn motors_can_be_asked_for_angles() {
    let motors = Motors::with_actuation(&blueprint(), Actuation::Angle { gain: 8.0 });
    let sixty = 60f32.to_radians();
    assert_eq!((motors.channels()[0].name.as_str(), motors.channels()[0].unit), ("angle of left leg", "rad"));
    assert_eq!(motors.channels()[0].range, [-sixty, sixty]);
    let asked = |outputs: [f32; 2], angles: [f32; 2]| {
        let mut speeds = [0.0; 2];
        motors.speeds(&Body { angles, ..Body::default() }, &outputs, &mut speeds);
        speeds
    };
    let [near, there] = asked([0.5, 0.5], [0.5 * sixty - 0.25, 0.5 * sixty]);
    assert!((near - 2.0).abs() < 1e-5 && there == 0.0, "{near}, {there}");
    assert_eq!(asked([1.0, -1.0], [-1.0, 1.0]), [10.0, -10.0], "never more than the top speed");
    assert_eq!(asked([7.0, 0.0], [sixty, 0.0]), [0.0, 0.0], "never beyond the limits");
    assert!(asked([f32::NAN, 0.0], [0.0; 2])[0].is_nan());
}

#[test]
fn a_clock_goes_round() {
    let senses = senses(&[Sensor::Clock { period: 2.0 }], 1.0);
    let at = |time| read(&senses, &Body { time, ..Body::default() });
    assert_eq!(at(0.0), [0.0, 1.0]);
    assert_eq!(at(0.5)[0], 1.0);
    assert!((at(1.0)[1] + 1.0).abs() < 1e-6);
    assert_eq!(at(2000.5), at(0.5));
}

#[test]
fn a_landing_clock_begins_anew_at_every_landing() {
    let [clock, landing] = [Sensor::Clock { period: 2.0 }, Sensor::LandingClock { period: 2.0 }];
    let [clock, landing] = [senses(&[clock], 1.0), senses(&[landing], 1.0)];
    // It landed at 2 s.
    let at = |senses, time| read(senses, &Body { time, ..Body::default() });
    assert_eq!(at(&landing, 2.3), at(&clock, 2.3 - 2.0));
    assert_eq!(landing.channels()[0].name, "sine of 2 s clock from landing");
}

#[test]
fn commands_are_channels_like_any_other() {
    let senses = senses(&[Sensor::CommandedSpeed { top: 2.0 }, Sensor::JumpCommand], 3.0);
    let named: Vec<_> = senses.channels().iter().map(|channel| (channel.name.as_str(), channel.unit)).collect();
    assert_eq!(named, [("commanded speed", "body lengths/s"), ("jump command", "")]);
    let told = |speed, jump| read(&senses, &Body { told: (speed, jump, 0.0), ..Body::default() });
    assert_eq!(told(0.0, false), [0.0, -3.0]);
    assert_eq!(told(-1.0, true), [-1.5, 3.0]);
    assert_eq!(told(9.0, true), [3.0, 3.0]);
}

#[test]
fn a_stride_clock_swings_with_the_commanded_speed() {
    let period = 2.0;
    let [clock, stride] = [Sensor::Clock { period }, Sensor::StrideClock { period, top: 2.0 }];
    let [clock, stride] = [senses(&[clock], 1.0), senses(&[stride], 1.0)];
    let at = |senses, speed| read(senses, &Body { time: 0.3, told: (speed, false, 0.0), ..Body::default() });
    let whole = at(&clock, 0.0);
    for (speed, swing) in [(0.0, 0.0), (1.0, 0.5), (2.0, 1.0), (5.0, 1.0), (-1.0, -0.5)] {
        let swung: Vec<f32> = whole.iter().map(|value| swing * value).collect();
        assert_eq!(at(&stride, speed), swung, "at {speed}");
    }
    let later = Body { time: 5.5, stride_began: 5.25, told: (2.0, false, 0.0), ..Body::default() };
    assert_eq!(read(&stride, &later), read(&clock, &Body { time: 0.25, ..Body::default() }), "since it began");
    assert_eq!(stride.channels()[0].name, "sine of 2 s stride clock");
}

#[test]
fn a_jump_clock_turns_once_after_a_press() {
    let senses = senses(&[Sensor::JumpClock { period: 0.8 }], 1.0);
    let at = |since| read(&senses, &Body { told: (0.0, false, since), ..Body::default() });
    let near = |found: Vec<f32>, wanted: [f32; 2]| {
        assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-6), "{found:?}, {wanted:?}");
    };
    near(at(0.0), [0.0, 0.0]);
    near(at(0.2), [1.0, 0.5]);
    near(at(0.4), [0.0, 1.0]);
    near(at(0.6), [-1.0, 0.5]);
    near(at(0.8), [0.0, 0.0]);
    near(at(f32::INFINITY), [0.0, 0.0]);
}

#[test]
fn passive_parts_are_not_sensed() {
    let mut file = small();
    file["parts"][1]["tag"] = "hat".into();
    let blueprint = Blueprint::from_json(&file.to_string()).expect("valid");
    let senses = Senses::new(&blueprint, &Sensor::defaults(), 3.0).expect("valid");
    assert_eq!(senses.len(), 2);
    assert_eq!(senses.channels()[1].name, "angle of right leg");
    assert_eq!(blueprint.actuated(), [1]);
    assert_eq!(blueprint.feet(), [2]);
    assert_eq!(Motors::new(&blueprint).len(), 1);
    assert!(blueprint.hinges()[0].motor.is_some() && !blueprint.hinges()[0].actuated);
}

#[test]
fn bad_ranges_and_sensors_are_errors() {
    for range in [0.0, -3.0, f32::NAN, f32::INFINITY, 1e9] {
        let error = Senses::new(&blueprint(), &Sensor::defaults(), range).expect_err("bad range");
        assert!(matches!(error, CreatureError::InputRange { .. }));
        assert!(error.to_string().starts_with("the input range must be from 0.001 to 1000, found "), "{error}");
    }
    for sensors in [vec![], vec![Sensor::Clock { period: -1.0 }], vec![Sensor::TorsoHeight; 2]] {
        let error = Senses::new(&blueprint(), &sensors, 3.0).expect_err("bad sensors");
        assert!(matches!(error, CreatureError::Invalid(_)), "{error:?}");
    }
}

#[test]
fn no_channel_of_another_crate_has_the_name_of_another() {
    let telling = |names: &[&str]| {
        let channel = |name: &&str| Channel { name: (*name).into(), unit: "", range: [0.0, 1.0] };
        Sensor::Custom(CustomSensor::new("off").telling(names.iter().map(channel).collect(), |_, _| 0.0))
    };
    let refused = |sensors: &[Sensor]| Senses::new(&blueprint(), sensors, 3.0).err().map(|error| error.to_string());
    let height = "height of torso above start";
    for (sensors, says) in [
        (
            [Sensor::TorsoHeight, telling(&["a", height])],
            "sensors[1]: its channel \"height of torso above start\" has the name of one of sensors[0]",
        ),
        (
            [telling(&[height]), Sensor::TorsoHeight],
            "sensors[1]: its channel \"height of torso above start\" has the name of one of sensors[0]",
        ),
        (
            [Sensor::TorsoHeight, telling(&["a", "b", "a"])],
            "sensors[1]: its channel \"a\" has the name of one of sensors[1]",
        ),
    ] {
        let error = refused(&sensors).expect("one name twice");
        assert!(error.contains(says), "{error}");
    }
    assert_eq!(refused(&[Sensor::TorsoHeight, telling(&["a", "b"])]), None);
}

#[test]
fn anchors_follow_turned_parts() {
    let mut file = small();
    // The leg lies on its side, its hip at the torso's lower edge.
    file["parts"][1]["angle"] = 90.into();
    file["parts"][1]["position"] = serde_json::json!([-0.25, 0.55]);
    let blueprint = Blueprint::from_json(&file.to_string()).expect("valid");
    let hinge = &blueprint.hinges()[0];
    let near = |a: [f32; 2], b: [f32; 2]| (a[0] - b[0]).abs() + (a[1] - b[1]).abs() < 1e-5;
    assert!(near(hinge.parent_anchor, [0.0, -0.25]), "{hinge:?}");
    assert!(near(hinge.child_anchor, [0.0, -0.25]), "{hinge:?}");
}

/// How far each joint is from another angle.
struct Off {
    by: f32,
    range: [f32; 2],
}

impl Sense for Off {
    fn channels(&self, blueprint: &Blueprint) -> Vec<Channel> {
        let channel = |&hinge: &usize| Channel { name: format!("hinge {hinge}, off"), unit: "rad", range: self.range };
        blueprint.actuated().iter().map(channel).collect()
    }

    fn read(&self, body: &dyn BodyView, channel: usize) -> f32 {
        body.joint_angle(channel) - self.by
    }
}

#[test]
fn sensors_of_other_crates_are_read_by_name() {
    let written = r#"{"custom":{"name":"off","settings":{"by":0.5}}}"#;
    let sensor: Sensor = serde_json::from_str(written).expect("a sensor");
    assert_eq!(serde_json::to_string(&sensor).expect("plain data"), written);
    let Sensor::Custom(custom) = &sensor else { panic!("{sensor:?}") };

    // A creature may have it, but no code can read it yet.
    let mut file = small();
    file["sensors"] = serde_json::json!(["torso-rotation", sensor]);
    Blueprint::from_json(&file.to_string()).expect("valid");
    let sensors = |custom: CustomSensor| [Sensor::TorsoRotation, Sensor::Custom(custom)];
    let refused = |custom| Senses::new(&blueprint(), &sensors(custom), 3.0).expect_err("refused").to_string();
    assert!(refused(custom.clone()).contains("sensors[1]: this program has no sensor `off`"));
    let telling = |range| custom.clone().sensing(Arc::new(Off { by: 0.5, range }), &blueprint());
    for (range, told) in [([1.0, 1.0], "1 to 1"), ([0.0, f32::INFINITY], "0 to inf")] {
        let says = format!("sensors[1]: channel \"hinge 0, off\" of `off` has the range {told}: must be two finite");
        assert!(refused(telling(range)).contains(&says), "{}", refused(telling(range)));
    }
    let silent = custom.clone().telling(Vec::new(), |_, _| 0.0);
    assert!(refused(silent).contains("sensors[1]: `off` must have channels"));

    let senses = senses(&sensors(telling([-1.0, 1.0])), 3.0);
    assert_eq!(senses.channels()[2].name, "hinge 1, off");
    let body = Body { angles: [1.0, 9.0], ..Body::default() };
    assert_eq!(read(&senses, &body), [0.0, 1.5, 3.0]);
}
