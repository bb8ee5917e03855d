//! Small trajectories, as no engine would make them, that movements are shown.

use crate::{Body, BodyHinge, BodyMotor, BodyPart, Command, PartState, Snapshot};

const STEPS: usize = 150;
pub(super) const TIME_STEP: f32 = 1.0 / 60.0;

/// Snapshots of one episode; the first is the start.
pub(super) struct Story {
    pub(super) name: String,
    pub(super) snapshots: Vec<Snapshot>,
}

/// How the torso goes, in terms of seconds; the other parts follow.
struct Path {
    name: &'static str,
    parts: usize,
    x: fn(f32) -> f32,
    y: fn(f32) -> f32,
    angle: fn(f32) -> f32,
    work: fn(f32) -> f64,
}

/// Standing, moving, jumping, spinning and falling bodies, of one to four parts.
pub(super) fn stories() -> Vec<Story> {
    paths().iter().map(|path| path.story(STEPS)).collect()
}

/// The same, all of one body, with a name for it.
pub(super) fn stories_of(body: &Body, name: &str) -> Vec<Story> {
    longer_stories_of(body, name, STEPS).collect()
}

/// The same, of so many steps.
pub(super) fn longer_stories_of(body: &Body, name: &str, steps: usize) -> impl Iterator<Item = Story> {
    let parts = body.parts.len();
    paths().into_iter().map(move |path| {
        let Story { name: path, snapshots } = Path { parts, ..path }.story(steps);
        Story { name: format!("{path}, having met {name}"), snapshots }
    })
}

/// The same story, of a body that is told to stand, to move and to jump by turns, for a second each.
pub(super) fn told(mut story: Story) -> Story {
    let mut command = Command::default();
    for (step, snapshot) in story.snapshots.iter_mut().enumerate() {
        let second = step / 60;
        let speed = if second % 3 == 0 { 0.0 } else { 1.0 };
        command = command.then(speed, second % 3 == 2, snapshot.time, TIME_STEP);
        snapshot.command = command;
    }
    Story { name: format!("{}, told what to do", story.name), ..story }
}

/// Bodies to meet: a lonely torso, one that crawls, and one on a leg with a knee and a leg without, with names.
pub(super) fn bodies() -> [(&'static str, Body); 3] {
    let part = |index: usize| BodyPart {
        name: format!("part {index}"),
        mass: 1.0,
        inertia: 0.01,
        buoyancy: 0.0,
        corners: vec![[-0.1, -0.2], [0.1, -0.2], [0.1, 0.2], [-0.1, 0.2]],
        radius: 0.0,
    };
    let hinge = |(parent, child): (usize, usize)| BodyHinge {
        parent,
        child,
        parent_anchor: [0.0, -0.2],
        child_anchor: [0.0, 0.2],
        start_angle: 0.0,
        limits: [-1.0, 1.0],
        motor: Some(BodyMotor { top_speed: 10.0, top_torque: 10.0 }),
    };
    let body = |parts: usize, hinges: &[(usize, usize)], legs: &[&[usize]]| Body {
        body_length: 1.0,
        start_height: 1.0,
        start_angle: 0.0,
        gravity: 9.81,
        parts: (0..parts).map(part).collect(),
        hinges: hinges.iter().copied().map(hinge).collect(),
        legs: legs.iter().map(|leg| leg.to_vec()).collect(),
        legless: false,
        uneven_ground: false,
    };
    let crawling = Body { legless: true, ..body(3, &[(0, 1), (1, 2)], &[&[1, 2]]) };
    [
        ("a torso without limbs", body(1, &[], &[])),
        ("a body without legs", crawling),
        ("a body with legs", body(4, &[(0, 1), (1, 2), (0, 3)], &[&[1, 2], &[3]])),
    ]
}

fn paths() -> [Path; 9] {
    const NOTHING: fn(f32) -> f32 = |_| 0.0;
    let still = Path { name: "standing", parts: 3, x: NOTHING, y: |_| 1.0, angle: NOTHING, work: |_| 0.0 };
    let tireless = |time: f32| 5.0 * f64::from(time);
    [
        Path { name: "walking", x: |time| 0.8 * time, work: tireless, ..still },
        Path { name: "going backwards", parts: 1, x: |time| 7.0 - 30.0 * time, ..still },
        Path { name: "jumping", parts: 4, y: |time| 1.0 + (libm::sinf(6.0 * time)).max(0.0), work: tireless, ..still },
        Path { name: "spinning", parts: 1, angle: |time| 9.0 * time, ..still },
        Path { name: "spinning back", angle: |time| 2.0 - 20.0 * time, work: tireless, ..still },
        Path { name: "rocking", angle: |time| 3.0 * libm::sinf(4.0 * time), ..still },
        Path { name: "falling", parts: 2, y: |time| (1.0 - time).max(0.0), angle: |time| time.min(1.5), ..still },
        Path { name: "flying away", x: |time| 1e4 * time, y: |time| 2.0 + 1e4 * time, ..still },
        still,
    ]
}

impl Path {
    fn story(&self, steps: usize) -> Story {
        Story {
            name: self.name.into(),
            snapshots: (0..=steps).map(|step| self.snapshot(step as f32 * TIME_STEP)).collect(),
        }
    }

    fn snapshot(&self, time: f32) -> Snapshot {
        let speed = |of: fn(f32) -> f32| (of(time) - of(time - TIME_STEP)) / TIME_STEP;
        let angle = (self.angle)(time);
        let part = |index: usize| {
            let below = 0.4 * index as f32;
            let y = ((self.y)(time) - below).max(0.0);
            PartState {
                x: (self.x)(time) + 0.1 * index as f32,
                y,
                cos: libm::cosf(angle),
                sin: libm::sinf(angle),
                vx: speed(self.x),
                vy: speed(self.y),
                spin: speed(self.angle),
                touching: y <= 0.21,
            }
        };
        Snapshot {
            time,
            parts: (0..self.parts).map(part).collect(),
            motor_work: (self.work)(time),
            ..Snapshot::default()
        }
    }
}
