//! Outlines of the shapes that ground is made of.

use envs_core::{Ground, GroundShape};

/// Corners a circle is drawn with.
const ROUND: u16 = 96;

/// Each shape of ground as it is seen: its corners, m; the height of one that has none. Slanted ground is a slab, but there is ground
/// below it.
pub(crate) fn outlines(ground: &Ground) -> impl Iterator<Item = Result<Vec<[f32; 2]>, f32>> + '_ {
    let heights = ground.shapes.iter().filter_map(|shape| corners(shape).err());
    let floor = heights.reduce(f32::max);
    ground.shapes.iter().map(move |shape| {
        let corners = corners(shape)?;
        Ok(match (shape, floor, &corners[..]) {
            (GroundShape::Slab { .. }, Some(floor), &[_, _, right, left]) => {
                vec![left, right, [right[0], floor.min(right[1])], [left[0], floor.min(left[1])]]
            }
            _ => corners,
        })
    })
}

/// The corners of a shape, m; the height of one that has none.
fn corners(shape: &GroundShape) -> Result<Vec<[f32; 2]>, f32> {
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
