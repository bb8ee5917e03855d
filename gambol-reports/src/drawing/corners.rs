//! Outlines of the shapes that ground is made of.

use envs_core::GroundShape;

/// Corners a circle is drawn with.
const ROUND: u16 = 96;

/// The corners of a shape, m; the height of one that has none.
pub(crate) fn corners(shape: &GroundShape) -> Result<Vec<[f32; 2]>, f32> {
    let turned = |[x, y]: [f32; 2], [width, height]: [f32; 2], angle: f32| {
        let (sin, cos) = libm::sincosf(angle);
        let corner = |[right, up]: [f32; 2]| {
            let (along, across) = (0.5 * width * right, 0.5 * height * up);
            [x + cos * along - sin * across, y + sin * along + cos * across]
        };
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(corner).to_vec()
    };
    match *shape {
        GroundShape::HalfSpace => Err(0.0),
        GroundShape::Floor { y } => Err(y),
        GroundShape::Box { x, y, width, height } => Ok(turned([x, y], [width, height], 0.0)),
        GroundShape::Slab { x, y, width, height, angle } => Ok(turned([x, y], [width, height], angle)),
        GroundShape::Circle { x, y, radius } => {
            let corner = |index: u16| {
                let angle = std::f32::consts::TAU * f32::from(index) / f32::from(ROUND);
                [x + radius * libm::cosf(angle), y + radius * libm::sinf(angle)]
            };
            Ok((0..ROUND).map(corner).collect())
        }
    }
}
