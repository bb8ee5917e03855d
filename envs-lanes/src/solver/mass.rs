use creatures::{BodyPart, Shape};
use std::f32::consts::PI;

/// The inverse mass, 1/kg, and the inverse moment of inertia about the centre, 1/(kg m²), of a part.
#[derive(Clone, Copy, Debug)]
pub(super) struct InverseMass {
    pub(super) linear: f32,
    pub(super) angular: f32,
}

impl InverseMass {
    /// Of a part whose density is multiplied by `factor`. Rounded as parry's mass properties are.
    pub(super) fn of(part: &BodyPart, factor: f32) -> Self {
        let density = part.density * factor;
        let (mass, inertia) = match part.shape {
            Shape::Box { width, height } => {
                let (x, y) = (width * 0.5, height * 0.5);
                let mass = x * y * 4.0 * density;
                (mass, ((x * x) / 3.0 + (y * y) / 3.0) * mass)
            }
            Shape::Circle { radius } => {
                let mass = PI * radius * radius * density;
                (mass, (radius * radius / 2.0) * mass)
            }
            Shape::Capsule { length, radius } => capsule(length * 0.5, radius, density),
        };
        Self { linear: 1.0 / mass, angular: 1.0 / inertia }
    }
}

/// Mass and moment of inertia of a capsule: a box between two half discs.
fn capsule(half_length: f32, radius: f32, density: f32) -> (f32, f32) {
    // Half the distance of the ends, which rapier computes from the ends.
    let half = ((half_length + half_length) * (half_length + half_length)).sqrt() / 2.0;
    let box_area = half * radius * 4.0;
    let box_inertia = (half * half) / 3.0 + (radius * radius) / 3.0;
    let disc_area = PI * radius * radius;
    let disc_inertia = radius * radius / 2.0;
    let inertia = (box_inertia * box_area + disc_inertia * disc_area) * density;
    let length = half * 2.0;
    let shifted = (length * length * 0.25 + length * radius * 3.0 / 8.0) * disc_area * density;
    ((box_area + disc_area) * density, inertia + shifted)
}
