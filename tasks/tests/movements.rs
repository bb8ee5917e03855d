//! Movements on snapshots by hand, with answers known beforehand.

mod common;

use common::{TIME_STEP, part};
use tasks::{Energy, FallEnds, Jumping, Movement, PartState, Rollovers, Running, Snapshot, Sum, TimeAloft, Verdict};

/// Shows a movement the snapshots; the first is the start. Returns its value and at which step it ended the episode.
fn watch(movement: &mut dyn Movement, snapshots: &[Snapshot]) -> (f64, Option<usize>) {
    movement.begin(&snapshots[0]);
    let end = snapshots[1..].iter().position(|snapshot| movement.observe(snapshot) != Verdict::GoOn);
    (movement.value(), end.map(|at| at + 1))
}

fn value(mut movement: impl Movement, snapshots: &[Snapshot]) -> f64 {
    watch(&mut movement, snapshots).0
}

/// Snapshots of one part, one time step apart.
fn of_parts(parts: impl IntoIterator<Item = PartState>) -> Vec<Snapshot> {
    let snapshot = |(step, part)| Snapshot {
        time: step as f32 * TIME_STEP,
        parts: vec![part],
        motor_work: 0.0,
        ..Snapshot::default()
    };
    parts.into_iter().enumerate().map(snapshot).collect()
}

/// A part turned to each of these angles in turn, in degrees.
fn turned(degrees: impl IntoIterator<Item = f64>) -> Vec<Snapshot> {
    let turned = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        PartState { cos: cos as f32, sin: sin as f32, ..part(0.0, 0.0) }
    };
    of_parts(degrees.into_iter().map(turned))
}

/// Angles from one to another, by a few degrees a step.
fn sweep(from: i32, to: i32) -> Vec<f64> {
    let steps = (to - from).abs() / 5;
    (0..=steps).map(|step| f64::from(from + 5 * step * (to - from).signum())).collect()
}

#[test]
fn running_is_the_way_forward() {
    assert_eq!(value(Running::default(), &of_parts([part(2.0, 0.0), part(9.0, 5.0), part(3.5, 1.0)])), 1.5);
    assert_eq!(value(Running::default(), &of_parts([part(2.0, 0.0), part(-1.0, 0.0)])), -3.0);
    assert_eq!(value(Running::default(), &of_parts([part(2.0, 0.0)])), 0.0);
}

#[test]
fn jumping_is_the_highest_point_above_the_start() {
    let heights = [1.0, 0.5, 2.25, 1.5];
    assert_eq!(value(Jumping::default(), &of_parts(heights.map(|y| part(0.0, y)))), 1.25);
    assert_eq!(value(Jumping::default(), &of_parts([part(0.0, 1.0), part(0.0, 0.0)])), 0.0);
}

#[test]
fn energy_is_the_work_since_the_start() {
    let mut snapshots = of_parts([part(0.0, 0.0); 3]);
    (snapshots[0].motor_work, snapshots[1].motor_work, snapshots[2].motor_work) = (4.0, 5.5, 9.0);
    assert_eq!(value(Energy::default(), &snapshots), 5.0);
}

#[test]
fn rollovers_count_how_often_it_was_upside_down() {
    let rollovers = |degrees: Vec<f64>| value(Rollovers::default(), &turned(degrees));
    assert_eq!(rollovers(sweep(0, 175)), 0.0);
    assert_eq!(rollovers(sweep(0, 185)), 1.0);
    assert_eq!(rollovers(sweep(0, 535)), 1.0);
    assert_eq!(rollovers(sweep(0, 545)), 2.0);
    assert_eq!(rollovers(sweep(0, 3600)), 10.0);
    assert_eq!(rollovers(sweep(0, -185)), 1.0);
    assert_eq!(rollovers(sweep(0, -3605)), 10.0);
}

#[test]
fn rollovers_are_counted_from_the_start_pose_across_the_wrap_of_angles() {
    let rollovers = |degrees: Vec<f64>| value(Rollovers::default(), &turned(degrees));
    // Starts at 170 degrees: 180, where angles wrap, is ten degrees on and no rollover; 355 is one.
    assert_eq!(rollovers(sweep(170, 345)), 0.0);
    assert_eq!(rollovers(sweep(170, 355)), 1.0);
    assert_eq!(rollovers(sweep(-170, -345)), 0.0);
    assert_eq!(rollovers(sweep(-170, -355)), 1.0);
}

#[test]
fn rocking_counts_once_and_turning_back_gives_nothing_back() {
    let rollovers = |ways: &[Vec<f64>]| value(Rollovers::default(), &turned(ways.concat()));
    let rocking: Vec<Vec<f64>> = (0..20).flat_map(|_| [sweep(0, 170), sweep(170, -170), sweep(-170, 0)]).collect();
    assert_eq!(rollovers(&rocking), 0.0);
    let over: Vec<Vec<f64>> = (0..20).flat_map(|_| [sweep(0, 190), sweep(190, 0)]).collect();
    assert_eq!(rollovers(&over), 1.0);
    assert_eq!(rollovers(&[sweep(0, 720), sweep(720, 0)]), 2.0);
}

#[test]
fn time_aloft_is_the_time_in_which_nothing_touches() {
    let touching = |on: bool| PartState { touching: on, ..part(0.0, 0.0) };
    let flight = [true, false, false, true, false, true].map(touching);
    assert_eq!(value(TimeAloft::default(), &of_parts(flight)), 3.0 * f64::from(TIME_STEP));
    // One foot on the ground is enough not to fly.
    let mut snapshots = of_parts([touching(false); 4]);
    snapshots[2].parts.push(touching(true));
    assert_eq!(value(TimeAloft::default(), &snapshots), 2.0 * f64::from(TIME_STEP));
}

#[test]
fn a_fall_ends_the_episode() {
    let touching = |on: bool| PartState { touching: on, ..part(0.0, 0.0) };
    let fall = of_parts([false, false, false, true, false].map(touching));
    assert_eq!(watch(&mut FallEnds::default(), &fall), (1.0, Some(3)));
    assert_eq!(watch(&mut FallEnds::default(), &fall[..3]), (0.0, None));
    // A foot may touch.
    let mut walk = of_parts([touching(false); 3]);
    walk.iter_mut().for_each(|snapshot| snapshot.parts.push(touching(true)));
    assert_eq!(watch(&mut FallEnds::default(), &walk), (0.0, None));
}

#[test]
fn a_sum_weighs_ends_and_measures_its_terms() {
    let mut snapshots = of_parts([part(1.0, 0.0), part(2.0, 0.0), PartState { touching: true, ..part(4.0, 0.0) }]);
    snapshots[2].motor_work = 10.0;
    let mut sum = Sum::of(Running::default()).plus(-0.25, Energy::default()).plus(-2.0, FallEnds::default());
    assert_eq!((sum.name(), sum.unit()), ("running", "m"));
    assert_eq!(watch(&mut sum, &snapshots), (3.0 - 2.5 - 2.0, Some(2)));
    let mut told = Vec::new();
    sum.measurements(&mut |name, value| told.push((name.to_owned(), value)));
    assert_eq!(told, [("running".into(), 3.0), ("energy".into(), 10.0), ("fall-ends".into(), 1.0)]);
    // The next episode begins from nothing, in every term.
    assert_eq!(watch(&mut sum, &snapshots[..2]), (1.0, None));
}
