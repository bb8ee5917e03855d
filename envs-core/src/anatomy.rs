use crate::{Hull, PhysicsSettings, inertia::inertia_per_mass};
use creatures::{Blueprint, BodyPart, Hinge, Shape};
use tasks::{Body, BodyHinge, BodyMotor};

/// m/s².
const STANDARD_GRAVITY: f32 = 9.81;

/// What the judges of movements need to know of a creature, on flat ground on Earth.
pub fn body_of(blueprint: &Blueprint) -> Body {
    let parts = blueprint.parts();
    Body {
        body_length: blueprint.body_length(),
        start_height: blueprint.start_height(),
        start_angle: parts[0].angle,
        gravity: STANDARD_GRAVITY,
        parts: parts.iter().map(part).collect(),
        hinges: blueprint.hinges().iter().map(|hinge_| hinge(hinge_, parts)).collect(),
        legs: blueprint.legs().to_vec(),
        legless: blueprint.is_legless(),
        uneven_ground: false,
    }
}

/// The same as [`body_of`], in a world with these settings, whose creature's densities are multiplied with a factor.
pub(crate) fn body_in(
    blueprint: &Blueprint,
    settings: &PhysicsSettings,
    mass_factor: f32,
    uneven_ground: bool,
) -> Body {
    let mut body = Body { gravity: settings.gravity, uneven_ground, ..body_of(blueprint) };
    let water = settings.water.map(|water| (water, water.density_around(blueprint, mass_factor)));
    for (part, shaped) in body.parts.iter_mut().zip(blueprint.parts()) {
        part.mass *= mass_factor;
        part.inertia *= mass_factor;
        part.buoyancy =
            water.map_or(0.0, |(water, density)| 1.0 - Hull::new(shaped, &water, density, mass_factor).weight_left());
    }
    body
}

fn part(part: &BodyPart) -> tasks::BodyPart {
    let mass = part.mass();
    let (corners, radius) = match part.shape {
        Shape::Box { width, height } => {
            let (x, y) = (0.5 * width, 0.5 * height);
            (vec![[-x, -y], [x, -y], [x, y], [-x, y]], 0.0)
        }
        Shape::Circle { radius } => (vec![[0.0, 0.0]], radius),
        Shape::Capsule { length, radius } => {
            let y = 0.5 * length;
            (vec![[0.0, -y], [0.0, y]], radius)
        }
    };
    tasks::BodyPart {
        name: part.name.clone(),
        mass,
        inertia: mass * inertia_per_mass(&part.shape),
        buoyancy: 0.0,
        corners,
        radius,
    }
}

fn hinge(hinge: &Hinge, parts: &[BodyPart]) -> BodyHinge {
    let motor = hinge.motor.filter(|_| hinge.actuated);
    BodyHinge {
        parent: hinge.parent,
        child: hinge.child,
        parent_anchor: hinge.parent_anchor,
        child_anchor: hinge.child_anchor,
        start_angle: parts[hinge.child].angle - parts[hinge.parent].angle,
        limits: hinge.limits,
        motor: motor.map(|motor| BodyMotor { top_speed: motor.top_speed, top_torque: motor.top_torque }),
    }
}
