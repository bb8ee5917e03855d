use super::*;
use crate::drawing::canvas::CONTACT;
use tasks::PartState;
use tasks::gait::{JumpingRules, Rules, RunningRules, Trajectory};

/// A biped that hops on the spot: half a second on the ground, half a second above it.
fn hops(blueprint: &Blueprint, seconds: u16) -> Vec<Snapshot> {
    let start = blueprint.creature().parts.iter();
    let pose: Vec<_> = start.map(|part| (part.name.contains("leg"), part.position, part.angle.to_radians())).collect();
    let snapshot = |step: u16| {
        let aloft = step % 50 >= 25;
        let part = |&(is_leg, [x, y], angle): &(bool, [f32; 2], f32)| PartState {
            x,
            y: y + if aloft { 0.2 } else { 0.0 },
            cos: libm::cosf(angle),
            sin: libm::sinf(angle),
            touching: is_leg && !aloft,
            ..PartState::default()
        };
        Snapshot {
            time: f32::from(step) * 0.02,
            parts: pose.iter().map(part).collect(),
            motor_work: 0.0,
            ..Snapshot::default()
        }
    };
    (0..=50 * seconds).map(snapshot).collect()
}

fn biped() -> Blueprint {
    Blueprint::new(creatures::find("biped-1").expect("shipped")).expect("valid")
}

fn report(blueprint: &Blueprint, snapshots: &[Snapshot], rules: Option<&dyn Rules>) -> GaitReport {
    let body = envs_core::body_of(blueprint);
    GaitReport::of(&Trajectory::from_positions(&body, snapshots).expect("a script"), rules)
}

/// Width and height as the PNG's header has them.
fn size(png: &[u8]) -> [u32; 2] {
    assert_eq!(png[..8], *b"\x89PNG\r\n\x1a\n");
    [16, 20].map(|at| u32::from_be_bytes(png[at..at + 4].try_into().expect("four bytes")))
}

#[test]
fn a_sheet_is_an_image_of_its_width_and_always_the_same() {
    let blueprint = biped();
    let ground = Ground::flat();
    let (running, jumping): (&dyn Rules, &dyn Rules) = (&RunningRules::default(), &JumpingRules);
    for (rules, movement, seconds) in
        [(Some(running), "running", 20), (Some(jumping), "jumping", 5), (None, "standing", 1)]
    {
        let snapshots = hops(&blueprint, seconds);
        let report = report(&blueprint, &snapshots, rules);
        let subject = Subject {
            blueprint: &blueprint,
            movement: Some(movement),
            ground: &ground,
            snapshots: &snapshots,
            report: &report,
        };
        let png = draw(&subject).expect("a sheet");
        let [width, height] = size(&png);
        assert_eq!(width, WIDTH);
        assert!((600..1600).contains(&height), "{height}");
        assert_eq!(draw(&subject).expect("a sheet"), png);
    }
}

/// A recording of a movement that is not known.
fn subject<'a>(
    blueprint: &'a Blueprint,
    ground: &'a Ground,
    snapshots: &'a [Snapshot],
    report: &'a GaitReport,
) -> Subject<'a> {
    Subject { blueprint, movement: None, ground, snapshots, report }
}

/// Every pixel of a frame.
fn has(canvas: &Canvas, ink: crate::drawing::canvas::Ink) -> bool {
    let (width, height) = (canvas.width() as u32, canvas.height() as u32);
    (0..height).any(|y| (0..width).any(|x| canvas.pixel(x, y) == Some(ink)))
}

#[test]
fn frames_mark_what_touches_the_ground() {
    let blueprint = biped();
    let snapshots = hops(&blueprint, 5);
    let report = report(&blueprint, &snapshots, Some(&JumpingRules));
    let ground = Ground::flat();
    let subject = subject(&blueprint, &ground, &snapshots, &report);
    let moments = Moments::choose(&subject);
    let frames = Frames::new(&subject, &moments);
    let marked = |step: usize| has(&frames.frame(0, step).expect("a frame"), CONTACT);
    let marks: Vec<bool> = moments.steps.iter().map(|&step| marked(step)).collect();
    let touches: Vec<bool> = moments.steps.iter().map(|&step| !snapshots[step].aloft()).collect();
    assert_eq!(marks, touches);
    assert!(touches.contains(&true) && touches.contains(&false), "{touches:?}");
}

#[test]
fn a_jump_is_shown_from_before_take_off_until_after_landing() {
    let blueprint = biped();
    let snapshots = hops(&blueprint, 5);
    let report = report(&blueprint, &snapshots, Some(&JumpingRules));
    let ground = Ground::flat();
    let subject = subject(&blueprint, &ground, &snapshots, &report);
    let moments = Moments::choose(&subject);
    assert_eq!(moments.steps.len(), FRAMES);
    assert!(!moments.lies_at_end);
    let flight = report.best_flight().or(report.aloft.flights.last()).expect("it hops");
    assert!((moments.span[0] - (flight.interval.from - 0.3)).abs() < 1e-6, "{:?}", moments.span);
    assert!((moments.span[1] - (flight.interval.to + 0.5).min(5.0)).abs() < 1e-6, "{:?}", moments.span);
}

#[test]
fn a_body_that_lies_at_the_end_is_shown_there() {
    let blueprint = biped();
    let mut snapshots = hops(&blueprint, 5);
    let last = snapshots.len() - 1;
    let torso = &mut snapshots[last].parts[0];
    (torso.cos, torso.sin) = (0.0, 1.0);
    let report = report(&blueprint, &snapshots, Some(&JumpingRules));
    let ground = Ground::flat();
    let subject = subject(&blueprint, &ground, &snapshots, &report);
    let moments = Moments::choose(&subject);
    assert!(moments.lies_at_end);
    assert_eq!((moments.steps.len(), moments.steps.last()), (FRAMES, Some(&last)));
}

#[test]
fn recordings_that_are_not_of_the_creature_are_refused() {
    let blueprint = biped();
    let good = hops(&blueprint, 1);
    let report = report(&blueprint, &good, None);
    let ground = Ground::flat();
    let refusal = |snapshots: &[Snapshot]| {
        let subject = subject(&blueprint, &ground, snapshots, &report);
        draw(&subject).expect_err("not a recording").to_string()
    };
    assert_eq!(refusal(&good[..1]), "a picture of a gait needs at least 2 snapshots, there are 1");
    let mut snapshots = good.clone();
    snapshots[3].parts.pop();
    assert_eq!(refusal(&snapshots), "snapshot 3 has 2 parts, the creature has 3");
    let mut snapshots = good.clone();
    snapshots[4].parts[0].y = f32::NAN;
    assert_eq!(refusal(&snapshots), "snapshot 4: the place of torso is not a finite number");
}

#[test]
fn a_body_that_flew_apart_can_be_drawn() {
    let blueprint = biped();
    let mut snapshots = hops(&blueprint, 1);
    for (factor, snapshot) in [1.0, 1e4, 1e9, 1e20].into_iter().cycle().zip(&mut snapshots) {
        snapshot.parts[1].x *= factor;
        snapshot.parts[2].y *= -factor;
    }
    let report = report(&blueprint, &hops(&blueprint, 1), None);
    let ground = Ground::flat();
    let subject = subject(&blueprint, &ground, &snapshots, &report);
    assert_eq!(size(&draw(&subject).expect("a sheet"))[0], WIDTH);
}
