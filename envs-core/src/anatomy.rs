use creatures::{Blueprint, BodyPart, Hinge, Shape};
use std::f32::consts::PI;
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
    tasks::BodyPart { name: part.name.clone(), mass, inertia: mass * inertia_per_mass(&part.shape), corners, radius }
}

/// Moment of inertia about the centre over mass, m².
pub(crate) fn inertia_per_mass(shape: &Shape) -> f32 {
    match *shape {
        Shape::Box { width, height } => (width * width + height * height) / 12.0,
        Shape::Circle { radius } => 0.5 * radius * radius,
        Shape::Capsule { length, radius } => capsule_inertia(length, radius) / shape.area(),
    }
}

/// The second moment of area about the centre, m⁴: a rectangle and two half discs, each moved out from its own centroid.
fn capsule_inertia(length: f32, radius: f32) -> f32 {
    let rectangle = 2.0 * radius * length * (4.0 * radius * radius + length * length) / 12.0;
    let disc = PI * radius * radius;
    let centroid = 4.0 * radius / (3.0 * PI);
    let out = 0.5 * length + centroid;
    rectangle + disc * (0.5 * radius * radius - centroid * centroid + out * out)
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
