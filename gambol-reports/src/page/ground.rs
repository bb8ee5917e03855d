//! Ground that is not flat, for the page.

use crate::drawing::corners::outlines;
use envs_core::Ground;
use serde::Serialize;

/// Shapes in whole millimetres.
#[derive(Clone, Debug, Serialize)]
pub struct GroundData {
    /// Everything below this height is ground.
    floor: Option<i32>,
    /// Convex outlines: x and y of each corner in turn.
    shapes: Vec<Vec<i32>>,
    /// Whether it is water, and there is no ground.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    water: bool,
}

impl GroundData {
    /// The shapes that come within a range of x, m; `None` for flat ground.
    pub fn new(ground: &Ground, [from, to]: [f32; 2]) -> Option<Self> {
        if *ground == Ground::flat() {
            return None;
        }
        let mut data = Self { floor: None, shapes: Vec::new(), water: *ground == Ground::none() };
        for outline in outlines(ground) {
            match outline {
                Ok(corners) => {
                    let ahead = corners.iter().all(|corner| corner[0] > to);
                    if !ahead && corners.iter().any(|corner| corner[0] > from) {
                        data.shapes.push(corners.iter().flatten().map(|&place| millimetres(place)).collect());
                    }
                }
                Err(height) => {
                    data.floor = Some(data.floor.map_or(millimetres(height), |y| y.max(millimetres(height))))
                }
            }
        }
        Some(data)
    }
}

fn millimetres(place: f32) -> i32 {
    (place * 1000.0).round() as i32
}

#[cfg(test)]
mod tests {
    use super::*;
    use envs_core::GroundShape;

    #[test]
    fn there_is_ground_below_slanted_ground() {
        let slab = GroundShape::Slab { x: 0.0, y: 0.0, width: 2.0, height: 1.0, angle: 0.5 };
        let data = GroundData::new(&Ground { shapes: vec![GroundShape::Floor { y: -3.0 }, slab] }, [-9.0, 9.0]);
        let data = data.expect("it is not flat");
        assert_eq!(data.shapes.len(), 1);
        let (low, high) = (data.shapes[0].iter().skip(1).step_by(2).min(), data.shapes[0][1]);
        assert!(low == Some(&-3000) && (-100..0).contains(&high), "{:?}", data.shapes);
    }

    #[test]
    fn water_is_told_from_ground() {
        let written =
            |ground: &Ground| serde_json::to_string(&GroundData::new(ground, [-1.0, 1.0])).expect("plain data");
        assert_eq!(written(&Ground::none()), r#"{"floor":null,"shapes":[],"water":true}"#);
        let pit = Ground { shapes: vec![GroundShape::Floor { y: -3.0 }] };
        assert_eq!(written(&pit), r#"{"floor":-3000,"shapes":[]}"#);
    }

    #[test]
    fn flat_ground_needs_no_drawing_and_shapes_out_of_sight_neither() {
        assert!(GroundData::new(&Ground::flat(), [-10.0, 10.0]).is_none());
        let block = |x| GroundShape::Box { x, y: -0.5, width: 2.0, height: 1.0 };
        let shapes = vec![GroundShape::Floor { y: -3.0 }, block(-20.0), block(1.0), block(20.0)];
        let data = GroundData::new(&Ground { shapes }, [-10.0, 10.0]).expect("not flat");
        assert_eq!(data.floor, Some(-3000));
        assert_eq!(data.shapes, [[0, -1000, 2000, -1000, 2000, 0, 0, 0]]);
    }

    #[test]
    fn slabs_are_drawn_turned() {
        let angle = std::f32::consts::FRAC_PI_2;
        let slab = GroundShape::Slab { x: 1.0, y: 2.0, width: 4.0, height: 2.0, angle };
        let data = GroundData::new(&Ground { shapes: vec![slab] }, [0.0, 1.0]).expect("not flat");
        assert_eq!(data.shapes, [[2000, 0, 2000, 4000, 0, 4000, 0, 0]]);
    }
}
