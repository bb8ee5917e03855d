//! Whether a creature stays in its start pose while it settles.

use creatures::{Blueprint, DEFAULT_INPUT_RANGE, Sensor};
use envs_rapier::{PhysicsSettings, RapierEnvironment, Variation};
use std::f32::consts::{PI, TAU};
use tasks::{Body, Environment, PartState};

/// A torso that turns farther while it settles has toppled, degrees.
const MOST_TILT: f32 = 5.0;
/// A torso that loses more of its height while it settles has sunk.
const MOST_SINKING: f32 = 0.15;
/// What is no higher above the lowest point stands on the ground, m.
const STANDING: f32 = 0.01;

/// What is wrong with how a creature settles, in sentences; empty if it stands as its file draws it.
pub(super) fn warnings(blueprint: &Blueprint) -> Vec<String> {
    let (physics, variation) = (PhysicsSettings::default(), Variation::default());
    let environment =
        RapierEnvironment::new(blueprint.clone(), &[Sensor::TorsoRotation], DEFAULT_INPUT_RANGE, physics, variation);
    let environment = match environment {
        Ok(environment) => environment,
        Err(error) => return vec![format!("it cannot be trained: {error}")],
    };
    match environment.body() {
        Some(body) => of(body, blueprint, environment.snapshot().torso()),
        None => Vec::new(),
    }
}

/// The same, of a torso that has settled.
fn of(body: &Body, blueprint: &Blueprint, settled: &PartState) -> Vec<String> {
    let turn = settled.angle() - body.start_angle;
    let tilt = (turn - TAU * libm::floorf((turn + PI) / TAU)).to_degrees();
    let sinking = body.start_height - settled.y;
    let lower = 100.0 * sinking / body.start_height;
    let sinks = sinking > MOST_SINKING * body.start_height;
    if tilt.abs() > MOST_TILT {
        let way = if tilt > 0.0 { "backwards" } else { "forwards" };
        let lower = if sinks { format!(", its torso {lower:.0} % lower") } else { String::new() };
        let (tilt, remedy) = (tilt.abs(), remedy(body, blueprint));
        return vec![format!("it settles tilted by {tilt:.0}° {way}{lower}: it starts out of balance; {remedy}")];
    }
    if sinks {
        return vec![format!(
            "its torso sinks by {lower:.0} % while it settles, from {:.2} m to {:.2} m: it does not stand as its file draws \
             it; straighten its legs, or give its joints stronger motors",
            body.start_height, settled.y
        )];
    }
    Vec::new()
}

/// What is to be moved.
fn remedy(body: &Body, blueprint: &Blueprint) -> String {
    let [from, to] = support(body, blueprint);
    let parts = blueprint.parts();
    let centre = parts.iter().map(|part| part.mass() * part.x).sum::<f32>() / blueprint.mass();
    let (beyond, side, feet, mass) = match centre {
        _ if centre > to => (centre - to, "ahead of", "forwards", "backwards"),
        _ if centre < from => (from - centre, "behind", "backwards", "forwards"),
        _ => {
            return format!(
                "its motors hold still, not in place, and creep under load: move its mass (centre at x = {centre:.2} m) right \
                 above its joints, or its feet apart (they reach from x = {from:.2} to {to:.2} m)"
            );
        }
    };
    format!(
        "move what it stands on {feet} or its mass {mass}: the centre of mass is {beyond:.2} m {side} the points on the \
         ground (x = {from:.2} to {to:.2} m)"
    )
}

/// From where to where it stands on the ground in the start pose, x in m.
fn support(body: &Body, blueprint: &Blueprint) -> [f32; 2] {
    let ground = blueprint.bounding_box()[1] + STANDING;
    let parts = body.parts.iter().zip(blueprint.parts());
    let points = parts.flat_map(|(shape, part)| {
        let (cos, sin) = (libm::cosf(part.angle), libm::sinf(part.angle));
        let place = move |&[x, y]: &[f32; 2]| [part.x + cos * x - sin * y, part.y + sin * x + cos * y - shape.radius];
        shape.corners.iter().map(place)
    });
    let standing = points.filter(|&[_, y]| y <= ground).map(|[x, _]| x);
    standing.fold([f32::INFINITY, f32::NEG_INFINITY], |[from, to], x| [from.min(x), to.max(x)])
}
