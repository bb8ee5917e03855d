//! Measuring instruments for the tests, which use nothing but snapshots and the blueprint.

use creatures::Blueprint;
use envs_rapier::{PhysicsSettings, RapierEnvironment, Variation};
use ne_core::{Purpose, Seed};
use rand::RngExt;
use tasks::{Environment, PartState, Snapshot};

pub(crate) fn blueprint(name: &str) -> Blueprint {
    Blueprint::new(creatures::find(name).expect("shipped")).expect("valid")
}

/// A shipped creature, so much higher above the ground, m.
pub(crate) fn raised(name: &str, height: f32) -> Blueprint {
    let mut creature = creatures::find(name).expect("shipped");
    for part in &mut creature.parts {
        part.position[1] += height;
    }
    for joint in &mut creature.joints {
        joint.anchor[1] += height;
    }
    Blueprint::new(creature).expect("valid")
}

pub(crate) fn environment(blueprint: Blueprint, settings: PhysicsSettings) -> RapierEnvironment {
    let sensors = blueprint.creature().sensors.clone();
    RapierEnvironment::new(blueprint, &sensors, 3.0, settings, Variation::default()).expect("builds")
}

pub(crate) fn shipped(name: &str, settings: PhysicsSettings) -> RapierEnvironment {
    environment(blueprint(name), settings)
}

/// Full speed one way or the other, each motor changing its mind about three times a second.
pub(crate) fn restless(seed: u64, motors: usize, steps: u32) -> Vec<Vec<f32>> {
    let mut stream = Seed::of_run(seed).stream(Purpose::new("restless motors"));
    let mut program = vec![vec![1.0_f32; motors]];
    for _ in 1..steps {
        let mut next = program[program.len() - 1].clone();
        for output in &mut next {
            if stream.random::<f32>() < 0.06 {
                *output = -*output;
            }
        }
        program.push(next);
    }
    program
}

/// Runs a motor program from the start pose and looks at the body after each step.
pub(crate) fn run(environment: &mut RapierEnvironment, program: &[Vec<f32>], mut look: impl FnMut(&RapierEnvironment)) {
    environment.reset(Seed::of_run(1)).expect("settles");
    for outputs in program {
        environment.act(outputs);
        environment.step().expect("stable");
        look(environment);
    }
}

fn world_point(part: &PartState, [x, y]: [f32; 2]) -> [f32; 2] {
    [part.x + part.cos * x - part.sin * y, part.y + part.sin * x + part.cos * y]
}

/// The largest distance between the two anchors of a joint, m.
pub(crate) fn joint_error(blueprint: &Blueprint, snapshot: &Snapshot) -> f32 {
    let error = |hinge: &creatures::Hinge| {
        let [x1, y1] = world_point(&snapshot.parts[hinge.parent], hinge.parent_anchor);
        let [x2, y2] = world_point(&snapshot.parts[hinge.child], hinge.child_anchor);
        (x1 - x2).hypot(y1 - y2)
    };
    blueprint.hinges().iter().map(error).fold(0.0, f32::max)
}

/// The furthest a joint is beyond its limits, rad; negative inside.
pub(crate) fn limit_overshoot(blueprint: &Blueprint, snapshot: &Snapshot) -> f32 {
    let overshoot = |hinge: &creatures::Hinge| {
        let (parent, child) = (&snapshot.parts[hinge.parent], &snapshot.parts[hinge.child]);
        let rest = blueprint.parts()[hinge.child].angle - blueprint.parts()[hinge.parent].angle;
        let angle = (child.angle() - parent.angle() - rest).sin().atan2((child.angle() - parent.angle() - rest).cos());
        (angle - hinge.limits[1]).max(hinge.limits[0] - angle)
    };
    blueprint.hinges().iter().map(overshoot).fold(f32::NEG_INFINITY, f32::max)
}

/// How deep the deepest part is in the ground, m; negative above it.
pub(crate) fn penetration(blueprint: &Blueprint, snapshot: &Snapshot) -> f32 {
    let depth =
        |(part, state): (&creatures::BodyPart, &PartState)| -(state.y + part.shape.lowest_point(state.cos, state.sin));
    blueprint.parts().iter().zip(&snapshot.parts).map(depth).fold(f32::NEG_INFINITY, f32::max)
}

/// Kinetic and potential energy of the body, J.
pub(crate) fn energy(blueprint: &Blueprint, snapshot: &Snapshot, gravity: f32) -> f64 {
    let of_part = |(part, state): (&creatures::BodyPart, &PartState)| {
        let mass = f64::from(part.mass());
        let (width, height) = match part.shape {
            creatures::Shape::Box { width, height } => (width, height),
            _ => unreachable!("the test creatures are made of boxes"),
        };
        let inertia = mass * f64::from(width * width + height * height) / 12.0;
        let square = |value: f32| f64::from(value) * f64::from(value);
        0.5 * mass * (square(state.vx) + square(state.vy))
            + 0.5 * inertia * square(state.spin)
            + mass * f64::from(gravity) * f64::from(state.y)
    };
    blueprint.parts().iter().zip(&snapshot.parts).map(of_part).sum()
}
