//! The solid shapes parts are made of.

use core::f32::consts::PI;

#[cfg(feature = "files")]
use serde::{Deserialize, Serialize};

/// The solid shape of a part, centred on the part's origin. Full sizes, in metres, each from 0.005 to 50.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "files", derive(Serialize, Deserialize), serde(rename_all = "snake_case", deny_unknown_fields))]
pub enum Shape {
    /// A rectangle.
    Box {
        /// Full width along the part's x axis, m, 0.005 to 50.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.005, max = 50.0)))]
        width: f32,
        /// Full height along the part's y axis, m, 0.005 to 50.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.005, max = 50.0)))]
        height: f32,
    },
    /// A disc.
    Circle {
        /// Radius, m, 0.005 to 50.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.005, max = 50.0)))]
        radius: f32,
    },
    /// A rectangle with a half disc at either end, upright in the part's own frame.
    Capsule {
        /// Distance between the centres of the two half discs, along the part's y axis, m, 0.005 to 50.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.005, max = 50.0)))]
        length: f32,
        /// Radius of the half discs, m, 0.005 to 50.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.005, max = 50.0)))]
        radius: f32,
    },
}

impl Shape {
    /// Area in m².
    pub fn area(&self) -> f32 {
        match *self {
            Self::Box { width, height } => width * height,
            Self::Circle { radius } => PI * radius * radius,
            Self::Capsule { length, radius } => 2.0 * radius * length + PI * radius * radius,
        }
    }

    /// Half the width and half the height, in m, of the upright box around the shape when it is turned by the angle
    /// whose cosine and sine are given. The shapes are symmetric, so the box is centred on the part's origin.
    pub fn half_extents(&self, cos: f32, sin: f32) -> [f32; 2] {
        let (c, s) = (cos.abs(), sin.abs());
        match *self {
            Self::Box { width, height } => [0.5 * (c * width + s * height), 0.5 * (s * width + c * height)],
            Self::Circle { radius } => [radius, radius],
            Self::Capsule { length, radius } => [0.5 * s * length + radius, 0.5 * c * length + radius],
        }
    }

    /// Height of the shape's lowest point above its centre, in m (so never positive), when it is turned by the angle
    /// whose cosine and sine are given.
    pub fn lowest_point(&self, cos: f32, sin: f32) -> f32 {
        -self.half_extents(cos, sin)[1]
    }

    /// Radius of the smallest circle around the origin that holds the shape, in m.
    pub fn bounding_radius(&self) -> f32 {
        match *self {
            Self::Box { width, height } => 0.5 * libm::hypotf(width, height),
            Self::Circle { radius } => radius,
            Self::Capsule { length, radius } => 0.5 * length + radius,
        }
    }

    /// Its sizes in m, each with the path of its field.
    #[cfg(feature = "files")]
    pub(crate) fn sizes(&self) -> Vec<(&'static str, f32)> {
        match *self {
            Self::Box { width, height } => vec![("box.width", width), ("box.height", height)],
            Self::Circle { radius } => vec![("circle.radius", radius)],
            Self::Capsule { length, radius } => vec![("capsule.length", length), ("capsule.radius", radius)],
        }
    }

    /// Distance in m from a point, given in the part's own frame, to the shape; 0 inside.
    pub fn distance_to(&self, point: [f32; 2]) -> f32 {
        let [x, y] = point.map(f32::abs);
        match *self {
            Self::Box { width, height } => libm::hypotf((x - 0.5 * width).max(0.0), (y - 0.5 * height).max(0.0)),
            Self::Circle { radius } => (libm::hypotf(x, y) - radius).max(0.0),
            Self::Capsule { length, radius } => (libm::hypotf(x, (y - 0.5 * length).max(0.0)) - radius).max(0.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SHAPES: [Shape; 3] = [
        Shape::Box { width: 0.4, height: 0.2 },
        Shape::Circle { radius: 0.3 },
        Shape::Capsule { length: 0.5, radius: 0.1 },
    ];

    fn close(a: f32, b: f32) -> bool {
        (a - b).abs() < 1e-6
    }

    #[test]
    fn areas() {
        let expected = [0.08, 0.09 * PI, 0.1 + 0.01 * PI];
        for (shape, area) in SHAPES.iter().zip(expected) {
            assert!(close(shape.area(), area), "{shape:?}");
        }
    }

    #[test]
    fn lowest_point_of_upright_and_lying_shapes() {
        let expected = [(-0.1, -0.2), (-0.3, -0.3), (-0.35, -0.1)];
        for (shape, (upright, lying)) in SHAPES.iter().zip(expected) {
            assert!(close(shape.lowest_point(1.0, 0.0), upright), "{shape:?}");
            assert!(close(shape.lowest_point(0.0, -1.0), lying), "{shape:?}");
        }
    }

    #[test]
    fn distance_is_zero_inside_and_grows_outside() {
        let expected = [0.3, 0.2, 0.4];
        for (shape, distance) in SHAPES.iter().zip(expected) {
            assert_eq!(shape.distance_to([0.05, -0.05]), 0.0, "{shape:?}");
            assert!(close(shape.distance_to([-0.5, 0.0]), distance), "{shape:?}");
        }
    }

    #[test]
    fn bounding_radius_holds_every_turned_box() {
        for shape in SHAPES {
            for degrees in 0..90 {
                let angle = (degrees as f32).to_radians();
                let extents = shape.half_extents(libm::cosf(angle), libm::sinf(angle));
                assert!(extents.iter().all(|e| *e <= shape.bounding_radius() + 1e-6), "{shape:?}");
            }
        }
    }
}
