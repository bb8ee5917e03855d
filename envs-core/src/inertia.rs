//! Moments of inertia of shapes.

use creatures::Shape;
use std::f32::consts::PI;

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
