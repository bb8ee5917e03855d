//! Scripted gaits with known answers, and trajectories of any kind.

use super::{
    CheatKind, GaitError, GaitReport, JumpingRules, NearWorlds, Reason, Rules, RunningRules, SwimmingRules, Trajectory,
    synthetic::{Pose, STANCE, STRIDE, TIME_STEP, body, film},
};
use crate::{Body, PartState, Snapshot};
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

const RUNNING: &dyn Rules = &RunningRules { backwards: false };
const BACKWARDS: &dyn Rules = &RunningRules { backwards: true };
const JUMPING: &dyn Rules = &JumpingRules;
const SWIMMING: &dyn Rules = &SwimmingRules;

fn report(seconds: f64, rules: &dyn Rules, script: impl Fn(usize) -> Pose) -> GaitReport {
    GaitReport::measure(&body(), &film(seconds, script), Some(rules)).expect("a script can be measured")
}

fn reasons(report: &GaitReport) -> Vec<String> {
    report.verdict.iter().flat_map(|verdict| &verdict.reasons).map(ToString::to_string).collect()
}

fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "found {found}, expected {expected}");
}

#[test]
fn a_walker_is_measured_and_usable() {
    let report = report(60.0, RUNNING, Pose::walking);
    assert_eq!(reasons(&report), Vec::<String>::new());
    assert!(report.verdict.as_ref().is_some_and(|verdict| verdict.usable));
    near(report.travel.distance, 60.0, 1e-4);
    near(report.travel.speed, 1.0, 1e-6);
    near(report.travel.second_half_relative_speed, 1.0, 1e-6);
    report.travel.quarters.iter().for_each(|&progress| near(progress, 15.0, 1e-4));
    // 60 W at 1 m/s and 12 kg.
    near(report.travel.cost_of_transport.expect("work is known"), 60.0 / (12.0 * 9.81), 1e-5);
    near(report.torso.largest_tilt, 0.0, 1e-9);
    for leg in &report.legs {
        near(leg.duty_factor, STANCE as f64 / STRIDE as f64, 0.01);
        near(leg.longest_without_touchdown, STRIDE as f64 * TIME_STEP, 1e-6);
        near(leg.joints[0].range, 2.0 * libm::asin(0.14 / 0.6), 0.01);
        assert!(leg.clearance.is_some_and(|clearance| clearance > 0.02 && clearance < 0.045), "{:?}", leg.clearance);
        assert!(leg.slip_per_distance.is_some_and(|slip| slip < 0.15), "{:?}", leg.slip_per_distance);
        assert!((119..=120).contains(&leg.footfalls), "{}", leg.footfalls);
        near(leg.stances[1].seconds(), STANCE as f64 * TIME_STEP, 1e-6);
    }
    for joint in &report.joints {
        near(joint.dominant_frequency, 2.0, 0.01);
        near(joint.reversals, 4.0, 0.11);
        near(joint.range, 2.0 * libm::asin(0.14 / 0.6).to_degrees(), 0.5);
    }
    near(report.rhythm.stride_time.expect("a rhythm"), 0.5, 1e-6);
    assert!(report.rhythm.strength > 0.99);
    near(report.rhythm.strides, 60.0, 1e-6);
    near(report.rhythm.progress_per_stride.expect("a rhythm"), 0.5, 1e-6);
}

#[test]
fn a_jumper_is_measured_and_usable() {
    let report = report(5.0, JUMPING, Pose::jumping);
    assert_eq!(reasons(&report), Vec::<String>::new());
    let flight = report.best_flight().expect("a flight");
    near(flight.interval.from, 1.0, 1e-6);
    near(flight.interval.seconds(), 0.6, 0.02);
    near(flight.rise, 9.0 / (2.0 * 9.81), 1e-3);
    assert_eq!(flight.push_off_spread(), Some(0.0));
    near(report.aloft.share, flight.interval.seconds() / 5.0, 1e-9);
}

#[test]
fn legs_that_push_off_far_apart_do_not_jump_together() {
    let late = |step: usize| {
        let mut pose = Pose::jumping(step);
        pose.touching[1] &= !(30..=80).contains(&step);
        pose
    };
    let report = report(5.0, JUMPING, late);
    assert_eq!(reasons(&report), ["jump at 1.0 s: the legs pushed off 0.42 s apart, at most 0.15 s allowed"]);
}

#[test]
fn a_hop_in_one_flight_and_height_in_another_are_no_jump() {
    // High with the feet down, then off the ground without height.
    let script = |step: usize| {
        let mut pose = Pose::jumping(step);
        let hop = (150..170).contains(&step);
        pose.touching = [false, !hop, !hop];
        pose
    };
    let report = report(5.0, JUMPING, script);
    assert_eq!(reasons(&report), ["jump at 3.0 s: centre of mass rose 0.00 m, at least 0.24 m required"]);
}

#[test]
fn a_body_that_stays_on_the_ground_does_not_jump() {
    let report = report(5.0, JUMPING, |_| Pose::standing());
    assert_eq!(reasons(&report), ["some part always touched the ground"]);
}

#[test]
fn a_leg_that_never_comes_down_is_named() {
    let hopping = |step: usize| {
        let mut pose = Pose::walking(step);
        if step >= 2900 {
            pose.touching[1] = false;
            pose.lift[0] = 0.05;
        }
        pose
    };
    let report = report(60.0, RUNNING, hopping);
    let expected = [
        "left leg: no touchdown for 2.5 s, at most 1 s allowed",
        "left leg: did not leave the ground for 2.2 s, at most 1 s allowed",
    ];
    assert_eq!(reasons(&report), expected);
}

#[test]
fn a_foot_that_steps_to_within_1_percent_of_the_body_length_of_the_ground_has_come_down() {
    // The left leg is a little shorter than the right one, and bears nothing. The puppet's soles are 5 cm above 0.
    let short = |missing: f64| {
        walk(move |_, pose| {
            pose.y -= 0.05;
            pose.touching[1] = false;
            pose.lift[0] += missing;
        })
    };
    // A standing leg turns on its hip: its foot is up to 1 cm higher at both ends of the stance.
    assert_eq!(short(0.004), NOTHING);
    let said = short(0.02);
    assert!(said[0].starts_with("left leg: no touchdown for 60.0 s"), "{said:?}");
}

#[test]
fn a_dragged_foot_that_chatters_does_not_walk() {
    let dragging = |step: usize| {
        let mut pose = Pose::walking(step);
        pose.touching[1] = !step.is_multiple_of(10);
        pose
    };
    let report = report(60.0, RUNNING, dragging);
    assert!(reasons(&report).iter().any(|reason| reason.starts_with("left leg: no touchdown for")));
}

/// Whatever the tilt and the angle at the start: what is lost at any moment is not usable, and what has begun to fall is lost.
#[test]
fn a_runner_that_is_lost_is_never_usable() {
    let mut lost = 0;
    for degrees in [-200.0, -90.0, -46.5, -45.5, -44.0, 0.0, 44.0, 45.5, 46.5, 135.0, 400.0_f64] {
        for start in [-2.0, 0.0, 3.0_f64] {
            let body = Body { start_angle: start as f32, ..body() };
            let lean = |step: usize| degrees.to_radians() * (step as f64 / 50.0).min(1.0);
            let film = film(60.0, |step| Pose { tilt: start + lean(step), ..Pose::walking(step) });
            let is_lost = film.iter().any(|now| RUNNING.is_lost(&body, now));
            let report = GaitReport::measure(&body, &film, Some(RUNNING)).expect("a script can be measured");
            let usable = report.verdict.is_some_and(|verdict| verdict.usable);
            assert!(!(is_lost && usable), "{degrees}° from {start} rad");
            assert_eq!(is_lost, degrees.abs() > 46.0, "{degrees}° from {start} rad");
            lost += usize::from(is_lost);
            let legless = Body { legless: true, ..body };
            assert!(!film.iter().any(|now| RUNNING.is_lost(&legless, now)), "it may lie as it likes");
        }
    }
    assert_eq!(lost, 18);
}

#[test]
fn tilt_counts_whole_turns() {
    let somersaults = |step: usize| Pose { tilt: -TAU * step as f64 / 1500.0, ..Pose::walking(step) };
    let report = report(60.0, RUNNING, somersaults);
    near(report.torso.largest_tilt, 720.0, 1e-3);
    near(report.torso.rollovers, 2.0, 0.0);
    assert!(reasons(&report).contains(&"torso: tilted by 720° at 60.0 s, at most 45° allowed".to_string()));
}

/// A walk in which one thing is changed, and what is said of it.
fn walk(change: impl Fn(usize, &mut Pose)) -> Vec<String> {
    let script = |step: usize| {
        let mut pose = Pose::walking(step);
        change(step, &mut pose);
        // Legs swing as before, however the torso leans.
        pose.hips = pose.hips.map(|hip| hip - pose.tilt);
        pose
    };
    reasons(&report(60.0, RUNNING, script))
}

const NOTHING: Vec<String> = Vec::new();

#[test]
fn a_torso_may_lean_by_45_degrees_and_sway_by_12() {
    let lean = |degrees: f64| walk(move |step, pose| pose.tilt = degrees.to_radians() * (step as f64 / 50.0).min(1.0));
    assert_eq!(lean(-44.5), NOTHING);
    assert_eq!(lean(-45.5), ["torso: tilted by 46° at 1.0 s, at most 45° allowed"]);
    // A sine of this amplitude has a standard deviation of its 0.707.
    let sway = |degrees: f64| {
        walk(move |step, pose| pose.tilt = degrees.to_radians() * libm::sin(TAU * step as f64 / STRIDE as f64))
    };
    assert_eq!(sway(16.5), NOTHING);
    assert_eq!(sway(17.5), ["torso: sways by 12.4° (standard deviation), at most 12° allowed"]);
}

#[test]
fn a_torso_may_sink_to_0_6_of_its_start_height() {
    // Down and up again within 4 s. The puppet's legs cannot bend, so that other things are said as well.
    let sink = |height: f64| {
        walk(move |step, pose| {
            pose.y = 0.8 - 0.8 * (1.0 - height) * (1.0 - (step as f64 - 700.0).abs() / 100.0).max(0.0)
        })
    };
    let crouching = "torso: at 0.59 of its start height at 14.0 s, at least 0.6 required".to_string();
    assert!(sink(0.59).contains(&crouching), "{:?}", sink(0.59));
    assert!(!sink(0.61).iter().any(|reason| reason.contains("start height")), "{:?}", sink(0.61));
}

#[test]
fn nothing_but_feet_touches_the_ground_for_more_than_1_percent_of_the_time() {
    let touch = |steps: usize| walk(move |step, pose| pose.touching[0] = (100..100 + steps).contains(&step));
    assert_eq!(touch(29), NOTHING);
    assert_eq!(
        touch(33),
        ["parts that are no feet touch the ground 1.1 % of the time, torso most; at most 1 % allowed"]
    );
}

#[test]
fn feet_rise_by_2_percent_of_the_body_length() {
    let lifted = |share: f64| walk(move |_, pose| pose.lift[1] *= share);
    assert_eq!(lifted(0.9), NOTHING);
    let said = lifted(0.3);
    assert!(said.len() == 1 && said[0].starts_with("right leg: rises by 0.0"), "{said:?}");
    assert!(said[0].ends_with("in a step, at least 0.020 m required"), "{said:?}");
}

#[test]
fn feet_may_slip_by_0_3_m_a_metre() {
    // Standing feet are carried along by a share of the way.
    let skating = |share: f64| {
        walk(move |step, pose| {
            let way = (0.6 * libm::sin(pose.hips[0]), 0.6 * libm::sin(pose.hips[1]));
            pose.hips = [way.0, way.1].map(|way| libm::asin(way * (1.0 - share) / 0.6));
            let _ = step;
        })
    };
    assert_eq!(skating(0.2), NOTHING);
    let mut said = skating(0.7);
    // What is carried along hardly swings its legs.
    said.retain(|reason| !reason.contains("joints of its leg"));
    assert!(said.len() == 1 && said[0].starts_with("feet slip by 0."), "{said:?}");
    assert!(said[0].ends_with("m for each metre, at most 0.3 m allowed"), "{said:?}");
}

#[test]
fn strides_repeat_themselves() {
    // Every stride takes another time to swing, and another reach.
    let stumbling = |much: f64| {
        walk(move |step, pose| {
            let stride = (step / STRIDE) as u64;
            let chance =
                ((stride * stride).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as f64 / f64::from(1 << 24) - 0.5;
            pose.hips = pose.hips.map(|hip| hip + much * chance);
        })
    };
    let irregular = |reason: &String| reason.starts_with("strides repeat themselves with a regularity of 0.");
    assert!(!stumbling(0.1).iter().any(irregular), "{:?}", stumbling(0.1));
    assert!(stumbling(1.0).iter().any(irregular), "{:?}", stumbling(1.0));
}

/// A jump in which one thing is changed from its take-off on, and what is said of it.
fn jump(change: impl Fn(f64, &mut Pose)) -> Vec<String> {
    let script = |step: usize| {
        let mut pose = Pose::jumping(step);
        change(step as f64 * TIME_STEP, &mut pose);
        pose
    };
    reasons(&report(5.0, JUMPING, script))
}

#[test]
fn a_jump_lands_on_its_feet() {
    let knee = |from: f64| jump(move |time, pose| pose.touching[0] = (from..from + 0.03).contains(&time));
    assert_eq!(knee(0.5), NOTHING, "before the jump it may kneel");
    assert_eq!(knee(2.0), ["torso: touches the ground at 2.0 s, after the jump; only feet may"]);
    let tilted = |degrees: f64| {
        let swing = |time: f64| libm::sin(0.5 * TAU * ((time - 1.0) / 0.6).clamp(0.0, 1.0));
        jump(move |time, pose| pose.tilt = degrees.to_radians() * swing(time))
    };
    assert_eq!(tilted(44.0), NOTHING);
    assert_eq!(tilted(46.0), ["torso: tilted by 46° at 1.3 s, at most 45° allowed"]);
}

#[test]
fn a_jump_ends_standing_or_goes_on() {
    let end = |tilt: f64, y: f64, speed: f64| {
        jump(move |time, pose| {
            let share = ((time - 3.0) / 0.5).clamp(0.0, 1.0);
            (pose.tilt, pose.y, pose.x) =
                (share * tilt.to_radians(), pose.y + share * y, speed * (time - 3.5).max(0.0));
            // Legs are drawn up a little, lest they sink in.
            pose.lift = [-share * 0.4 * y; 2];
        })
    };
    assert_eq!(end(19.0, 0.0, 0.0), NOTHING);
    assert_eq!(end(0.0, -0.11, 0.19), NOTHING);
    for said in [end(21.0, 0.0, 0.0), end(0.0, -0.13, 0.0), end(0.0, 0.0, 0.21)] {
        assert!(
            said.len() == 1 && said[0].starts_with("last second: neither stands nor jumps on: tilted by"),
            "{said:?}"
        );
    }
    // A jump every 1.2 s: in the air or crouching in the last second.
    let on = |step: usize| {
        let again = Pose::jumping(50 + step % 60);
        let work = 100.0 * (step / 60) as f64 + again.work;
        Pose { touching: if step < 5 { [false, true, true] } else { again.touching }, work, ..again }
    };
    assert_eq!(reasons(&report(5.0, JUMPING, on)), NOTHING);
}

#[test]
fn a_jump_takes_0_2_s_and_lifts_the_centre_of_mass() {
    let flight = |seconds: f64| {
        jump(move |time, pose| {
            let aloft = time > 1.01 && time < 1.01 + seconds;
            pose.touching = [false, !aloft, !aloft];
        })
    };
    assert_eq!(flight(0.21), NOTHING);
    let said = flight(0.15);
    assert!(
        said[0].starts_with("jump at 1.0 s: 0.1") && said[0].ends_with("s off the ground, at least 0.2 s required"),
        "{said:?}"
    );
}

#[test]
fn a_gait_that_is_brittle_in_near_worlds_is_not_usable() {
    let verdict = report(60.0, RUNNING, Pose::walking).verdict.expect("judged");
    assert_eq!(verdict.near_worlds, None, "a bare trajectory is judged alone");
    let near = |usable| verdict.clone().with_near_worlds(NearWorlds { usable, worlds: 8 });
    assert!(near(7).usable && near(7).near_worlds == Some(NearWorlds { usable: 7, worlds: 8 }));
    assert!(!near(6).usable);
    assert_eq!(near(6).reasons[0].to_string(), "usable in 6 of 8 near worlds, at least 7 required");
}

#[test]
fn a_pause_of_a_quarter_is_no_running() {
    let pausing =
        |step: usize| Pose { x: 0.02 * step.min(1500).max(step.max(2250) - 750) as f64, ..Pose::walking(step) };
    let reasons = reasons(&report(60.0, RUNNING, pausing));
    assert!(
        reasons.contains(&"quarter 3 of the episode: 0.00 m, some way forward required".to_string()),
        "{reasons:?}"
    );
}

#[test]
fn short_and_slow_is_said() {
    let slow = |step: usize| Pose { x: 0.004 * step as f64, ..Pose::walking(step) };
    let expected = [
        "the episode lasted 10.0 s, shorter than the 60 s to be judged",
        "second half: 0.20 body lengths/s, at least 0.5 required",
    ];
    assert_eq!(reasons(&report(10.0, RUNNING, slow))[..2], expected);
}

#[test]
fn a_fast_joint_is_not_usable() {
    let buzzing = |step: usize| {
        let swing = 0.1 * libm::sin(TAU * 6.0 * step as f64 * TIME_STEP);
        Pose { hips: [swing, Pose::walking(step).hips[1]], ..Pose::walking(step) }
    };
    let report = report(60.0, RUNNING, buzzing);
    assert!(reasons(&report).contains(&"left leg: its joint swings at 6.0 Hz, at most 4 Hz allowed".to_string()));
}

#[test]
fn a_legless_body_jumps_by_a_quarter_of_its_length() {
    let body = Body { legless: true, ..body() };
    let said = |share: f64| {
        let low = |step: usize| {
            let pose = Pose::jumping(step);
            Pose { y: 0.8 + share * (pose.y - 0.8), ..pose }
        };
        let report = GaitReport::measure(&body, &film(5.0, low), Some(JUMPING));
        reasons(&report.expect("a script can be measured"))
    };
    // All of it is 0.46 m.
    assert_eq!(said(0.57), NOTHING);
    assert!(said(0.52)[0].contains("0.25 m required"), "{:?}", said(0.52));
}

#[test]
fn a_legless_body_does_not_land_on_its_back() {
    let body = Body { legless: true, ..body() };
    let said = |degrees: f64| {
        let turning = |step: usize| {
            let share = ((step as f64 * TIME_STEP - 1.0) / 0.3).clamp(0.0, 1.0);
            let back = ((step as f64 * TIME_STEP - 1.4) / 0.2).clamp(0.0, 1.0);
            Pose { tilt: (share - back) * degrees.to_radians(), ..Pose::jumping(step) }
        };
        let report = GaitReport::measure(&body, &film(5.0, turning), Some(JUMPING));
        reasons(&report.expect("a script can be measured"))
    };
    assert_eq!(said(89.0), NOTHING);
    assert_eq!(said(91.0), ["torso: tilted by 91° at 1.4 s, at most 90° allowed"]);
}

#[test]
fn every_leg_of_a_runner_moves() {
    let stiff = |degrees: f64| {
        let swing = |step: usize| 0.5 * degrees.to_radians() * libm::sin(TAU * 2.0 * step as f64 * TIME_STEP);
        let walk = move |step: usize| Pose { hips: [Pose::walking(step).hips[0], swing(step)], ..Pose::walking(step) };
        let mut said = reasons(&report(60.0, RUNNING, walk));
        said.retain(|reason| reason.contains("joints of its leg"));
        said
    };
    assert_eq!(stiff(20.2), NOTHING);
    assert_eq!(
        stiff(19.0),
        ["right leg: the joints of its leg move by 19° in all in the second half, at least 20° required"]
    );
}

#[test]
fn uneven_steps_that_come_again_after_10_s_are_no_strides() {
    let uneven = |step: usize| {
        let chance = (((step % 500 / STRIDE) as u64).wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 40) as f64;
        let reach = chance / f64::from(1 << 24) - 0.5;
        let pose = Pose::walking(step);
        Pose { hips: pose.hips.map(|hip| hip + reach), ..pose }
    };
    let said = reasons(&report(60.0, RUNNING, uneven));
    assert!(said.iter().any(|reason| reason.starts_with("strides repeat themselves")), "{said:?}");
}

#[test]
fn a_legless_body_must_move_every_joint() {
    let body = Body { legless: true, ..body() };
    let lazy = film(60.0, |step| Pose { hips: [Pose::walking(step).hips[0], 0.0], ..Pose::walking(step) });
    let report = GaitReport::measure(&body, &lazy, Some(RUNNING)).expect("a script can be measured");
    assert_eq!(reasons(&report), ["right leg: its joint moves by 0° in the second half, at least 20° required"]);
}

#[test]
fn a_standing_foot_that_is_dragged_slips_and_one_that_turns_on_its_toe_does_not() {
    let dragged = film(1.0, |step| Pose { x: 0.02 * step as f64, ..Pose::standing() });
    let report = GaitReport::measure(&body(), &dragged, None).expect("a script can be measured");
    near(report.legs[0].slip, 1.0, 1e-4);
    near(report.legs[0].slip_per_distance.expect("a distance"), 1.0, 1e-4);

    let mut wheel = body();
    wheel.parts[0] = crate::BodyPart { corners: vec![[0.0, 0.0]], radius: 0.5, ..wheel.parts[0].clone() };
    wheel.legs = vec![vec![0]];
    let rolling = film(1.0, |step| {
        let x = 0.02 * step as f64;
        Pose { x, y: 0.5, tilt: -x / 0.5, touching: [true, false, false], ..Pose::standing() }
    });
    let report = GaitReport::measure(&wheel, &rolling, None).expect("a script can be measured");
    near(report.legs[0].slip, 0.0, 1e-5);
}

#[test]
fn positions_alone_give_no_cost() {
    let walk = film(60.0, Pose::walking);
    let body = body();
    let trajectory = Trajectory::from_positions(&body, &walk).expect("positions");
    let report = GaitReport::of(&trajectory, Some(RUNNING));
    assert_eq!(report.travel.cost_of_transport, None);
    assert!(report.verdict.is_some_and(|verdict| verdict.usable));
}

#[test]
fn a_cheat_speaks_against_a_gait() {
    let torn = |step: usize| Pose { gap: if step > 500 { 0.2 } else { 0.0 }, ..Pose::walking(step) };
    let report = report(60.0, RUNNING, torn);
    let cheats: Vec<_> = report.cheats.iter().map(|cheat| cheat.kind).collect();
    assert_eq!(cheats, [CheatKind::JointSeparation]);
    assert!(report.verdict.is_some_and(|verdict| matches!(&verdict.reasons[..], [Reason::Cheat(_)])));
}

#[test]
fn a_report_survives_a_file() {
    let report = report(5.0, JUMPING, Pose::jumping);
    let text = serde_json::to_string(&report).expect("it can be written");
    assert!(text.contains("\"distance_m\"") && text.contains("\"dominant_frequency_hz\""), "{text}");
    assert_eq!(serde_json::from_str::<GaitReport>(&text).expect("it can be read"), report);
}

/// Off the ground, which is not there, all the time.
fn swimming(step: usize) -> Pose {
    let walking = Pose::walking(step);
    // Slowly down, below height 0, and round.
    Pose { y: 0.8 - 0.001 * step as f64, tilt: 0.004 * step as f64, touching: [false; 3], ..walking }
}

#[test]
fn a_swimmer_needs_neither_ground_nor_footfalls_but_has_to_get_ahead() {
    let swum = report(20.0, SWIMMING, swimming);
    assert_eq!(reasons(&swum), Vec::<String>::new());
    assert!((swum.travel.second_half_relative_speed - 1.0).abs() < 0.1, "{}", swum.travel.second_half_relative_speed);
    assert!(reasons(&report(60.0, RUNNING, swimming)).len() > 3, "it is no run");
    let slow = |step: usize| Pose { x: 0.3 * Pose::walking(step).x, ..swimming(step) };
    let said = reasons(&report(20.0, SWIMMING, slow));
    assert!(said.len() == 1 && said[0].contains("body lengths/s, at least 0.5 required"), "{said:?}");
    let short = reasons(&report(10.0, SWIMMING, swimming));
    assert!(short.len() == 1 && short[0].contains("shorter than the 20 s"), "{short:?}");
    let buzzing = |step: usize| {
        let angle = 0.3 * libm::sin(std::f64::consts::TAU * 6.0 * step as f64 * 0.02);
        Pose { hips: [angle, angle], ..swimming(step) }
    };
    let said = reasons(&report(20.0, SWIMMING, buzzing));
    assert!(said.iter().any(|reason| reason.contains("Hz")), "{said:?}");
}

#[test]
fn a_walker_backwards_is_judged_as_one_forwards() {
    let backwards = |step: usize| {
        let walking = Pose::walking(step);
        Pose { x: -walking.x, hips: walking.hips.map(|hip| -hip), ..walking }
    };
    let report_of_a_run = report(60.0, RUNNING, Pose::walking);
    let report_of_a_retreat = report(60.0, BACKWARDS, backwards);
    assert_eq!(reasons(&report_of_a_retreat), Vec::<String>::new());
    assert_eq!(report_of_a_retreat.travel, report_of_a_run.travel);
    assert_eq!(report_of_a_retreat.judged_as.as_deref(), Some("backwards"));
    // Forwards is the wrong way, and so is backwards for a run.
    for wrong in [report(60.0, BACKWARDS, Pose::walking), report(60.0, RUNNING, backwards)] {
        let reasons = reasons(&wrong);
        assert!(reasons[0].starts_with("second half: -1.00 body lengths/s") && reasons.len() >= 9, "{reasons:?}");
    }
    // A slide is one in either direction.
    let sliding = |step: usize| Pose { touching: [false, true, true], ..backwards(step) };
    let cheats = report(60.0, BACKWARDS, sliding).cheats;
    assert_eq!(cheats.iter().map(|cheat| cheat.kind.name()).collect::<Vec<_>>(), ["friction-ratchet"]);
}

#[test]
fn what_is_no_trajectory_is_refused() {
    let refused = |body: &Body, snapshots: &[Snapshot]| {
        GaitReport::measure(body, snapshots, None).expect_err("it is refused").to_string()
    };
    let walk = film(1.0, Pose::walking);
    let changed = |change: fn(&mut Snapshot)| {
        let mut walk = walk.clone();
        change(&mut walk[7]);
        walk
    };
    assert_eq!(refused(&body(), &walk[..1]), "a gait needs at least 2 snapshots, there are 1");
    let fewer = changed(|snapshot| snapshot.parts.truncate(2));
    assert_eq!(refused(&body(), &fewer), "snapshot 7 has 2 parts, the body has 3");
    let unreal = changed(|snapshot| snapshot.parts[1].vy = f32::NAN);
    assert_eq!(refused(&body(), &unreal), "snapshot 7: place or speed of left leg is not a finite number");
    let unreal = changed(|snapshot| snapshot.motor_work = f64::INFINITY);
    assert_eq!(refused(&body(), &unreal), "snapshot 7: the motors' work is not a finite number");
    let uneven = changed(|snapshot| snapshot.time += 0.01);
    assert!(matches!(GaitReport::measure(&body(), &uneven, None), Err(GaitError::Clock { snapshot: 7, .. })));
    let footless = Body { legs: vec![vec![]], ..body() };
    assert_eq!(refused(&footless, &walk), "the body's legs must be made of parts that exist");
}

/// Every number in a report.
fn all_finite(value: &serde_json::Value) -> bool {
    // JSON has no infinity: serde writes null, which an `Option` writes too; those are looked at by reading it back.
    match value {
        serde_json::Value::Number(number) => number.as_f64().is_some_and(f64::is_finite),
        serde_json::Value::Array(values) => values.iter().all(all_finite),
        serde_json::Value::Object(fields) => fields.values().all(all_finite),
        _ => true,
    }
}

fn number() -> impl Strategy<Value = f32> {
    prop_oneof![4 => -2.0f32..2.0, 1 => -1e3f32..1e3, 1 => -1e30f32..1e30, 1 => Just(0.0f32), 1 => Just(f32::MAX)]
}

fn state() -> impl Strategy<Value = PartState> {
    let turn = prop_oneof![4 => -PI..PI, 1 => Just(0.0)];
    (number(), number(), turn, number(), number(), number(), any::<bool>()).prop_map(
        |(x, y, angle, vx, vy, spin, touching)| {
            let (cos, sin) = (libm::cos(angle) as f32, libm::sin(angle) as f32);
            PartState { x, y, cos, sin, vx, vy, spin, touching }
        },
    )
}

fn trajectory() -> impl Strategy<Value = Vec<Snapshot>> {
    let parts = prop::collection::vec(state(), 3);
    let snapshots = prop::collection::vec((parts, -1e9f64..1e9), 2..40);
    (snapshots, 0.001f64..0.05, any::<bool>()).prop_map(|(snapshots, time_step, constant)| {
        let first = snapshots[0].clone();
        let still = |(parts, motor_work)| if constant { first.clone() } else { (parts, motor_work) };
        let snapshot = |(step, (parts, motor_work))| Snapshot {
            time: (step as f64 * time_step) as f32,
            parts,
            motor_work,
            ..Snapshot::default()
        };
        snapshots.into_iter().map(still).enumerate().map(snapshot).collect()
    })
}

proptest! {
    #[test]
    fn any_finite_trajectory_gives_finite_numbers(snapshots in trajectory(), legless: bool, rules in 0..3) {
        let body = Body { legless, ..body() };
        let rules = [Some(RUNNING), Some(JUMPING), None][rules as usize];
        let report = GaitReport::measure(&body, &snapshots, rules).expect("it can be measured");
        let json = serde_json::to_value(&report).expect("it can be written");
        prop_assert!(all_finite(&json));
        let back: GaitReport = serde_json::from_value(json).expect("no number is null");
        prop_assert_eq!(back, report);
        if let Ok(trajectory) = Trajectory::from_positions(&body, &snapshots) {
            let report = GaitReport::of(&trajectory, rules);
            let json = serde_json::to_value(&report).expect("it can be written");
            let back: GaitReport = serde_json::from_value(json).expect("no number is null");
            prop_assert_eq!(back, report);
        }
    }

    #[test]
    fn a_number_that_is_not_finite_is_refused(mut snapshots in trajectory(), place in 0..1000usize, field in 0..7) {
        let snapshot = place % snapshots.len();
        let part = &mut snapshots[snapshot].parts[place % 3];
        let PartState { x, y, cos, sin, vx, vy, spin, .. } = part;
        *[x, y, cos, sin, vx, vy, spin][field as usize] = f32::NAN;
        let error = GaitReport::measure(&body(), &snapshots, None);
        prop_assert!(matches!(error, Err(GaitError::NotFinite { .. })), "{:?}", error);
    }
}

/// A sum of nothing is written as 0.
#[test]
fn what_never_happens_has_no_sign() {
    let still = film(3.0, |_| Pose::standing());
    let report = GaitReport::measure(&body(), &still, None).expect("a script");
    assert!(report.aloft.share.is_sign_positive(), "{}", report.aloft.share);
    let floating = film(3.0, |_| Pose { touching: [false; 3], ..Pose::standing() });
    let report = GaitReport::measure(&body(), &floating, None).expect("a script");
    for leg in &report.legs {
        assert!(leg.duty_factor.is_sign_positive() && leg.slip.is_sign_positive(), "{leg:?}");
    }
}
