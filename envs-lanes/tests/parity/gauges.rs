//! Measuring instruments, which use nothing but snapshots and the blueprint.

use creatures::{Blueprint, BodyPart, Hinge, Shape};
use std::f64::consts::PI;
use tasks::{PartState, Snapshot};

fn world_point(part: &PartState, [x, y]: [f32; 2]) -> [f32; 2] {
    [part.x + part.cos * x - part.sin * y, part.y + part.sin * x + part.cos * y]
}

/// The largest distance between the two anchors of a joint, m.
pub(crate) fn joint_error(blueprint: &Blueprint, snapshot: &Snapshot) -> f32 {
    let error = |hinge: &Hinge| {
        let [x1, y1] = world_point(&snapshot.parts[hinge.parent], hinge.parent_anchor);
        let [x2, y2] = world_point(&snapshot.parts[hinge.child], hinge.child_anchor);
        (x1 - x2).hypot(y1 - y2)
    };
    blueprint.hinges().iter().map(error).fold(0.0, f32::max)
}

/// The angle of a joint against the start pose, rad.
pub(crate) fn joint_angle(blueprint: &Blueprint, snapshot: &Snapshot, hinge: usize) -> f32 {
    let hinge = &blueprint.hinges()[hinge];
    let angle = |part: usize| snapshot.parts[part].angle() - blueprint.parts()[part].angle;
    let turned = angle(hinge.child) - angle(hinge.parent);
    turned.sin().atan2(turned.cos())
}

/// The furthest a joint is beyond its limits, rad; negative inside.
pub(crate) fn limit_overshoot(blueprint: &Blueprint, snapshot: &Snapshot) -> f32 {
    let overshoot = |(index, hinge): (usize, &Hinge)| {
        let angle = joint_angle(blueprint, snapshot, index);
        (angle - hinge.limits[1]).max(hinge.limits[0] - angle)
    };
    blueprint.hinges().iter().enumerate().map(overshoot).fold(f32::NEG_INFINITY, f32::max)
}

/// How deep the deepest part is in the ground, m; negative above it.
pub(crate) fn penetration(blueprint: &Blueprint, snapshot: &Snapshot) -> f32 {
    let depth = |(part, state): (&BodyPart, &PartState)| -(state.y + part.shape.lowest_point(state.cos, state.sin));
    blueprint.parts().iter().zip(&snapshot.parts).map(depth).fold(f32::NEG_INFINITY, f32::max)
}

/// The moment of inertia of a part about its centre, kg m².
pub(crate) fn inertia(part: &BodyPart) -> f64 {
    let mass = f64::from(part.mass());
    match part.shape {
        Shape::Box { width, height } => mass * (f64::from(width).powi(2) + f64::from(height).powi(2)) / 12.0,
        Shape::Circle { radius } => mass * f64::from(radius).powi(2) / 2.0,
        Shape::Capsule { length, radius } => {
            let (length, radius, density) = (f64::from(length), f64::from(radius), f64::from(part.density));
            let middle = 2.0 * radius * length * density * (length.powi(2) + 4.0 * radius.powi(2)) / 12.0;
            // Both half discs, about the capsule's centre: Steiner's theorem twice, as a half disc's centre of mass lies
            // 4 r / 3π beyond its straight side.
            let discs = PI * radius.powi(2) * density;
            let to_centre = 4.0 * radius / (3.0 * PI);
            let own = discs * (radius.powi(2) / 2.0 - to_centre.powi(2));
            middle + own + discs * (length / 2.0 + to_centre).powi(2)
        }
    }
}

/// Kinetic and potential energy of the body, J.
pub(crate) fn energy(blueprint: &Blueprint, snapshot: &Snapshot, gravity: f32) -> f64 {
    let of_part = |(part, state): (&BodyPart, &PartState)| {
        let mass = f64::from(part.mass());
        let square = |value: f32| f64::from(value) * f64::from(value);
        0.5 * mass * (square(state.vx) + square(state.vy))
            + 0.5 * inertia(part) * square(state.spin)
            + mass * f64::from(gravity) * f64::from(state.y)
    };
    blueprint.parts().iter().zip(&snapshot.parts).map(of_part).sum()
}
