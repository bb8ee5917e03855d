//! Outlines as polygons, counter-clockwise, in the frame of a part, m.

use creatures::Shape;
use std::f32::consts::FRAC_PI_2;

/// A quarter of a circle is so many straight lines.
const QUARTER: usize = 6;

/// The outline of a part's shape.
pub(crate) fn of_shape(shape: Shape, corner_radius: f32) -> Vec<[f32; 2]> {
    match shape {
        Shape::Box { width, height } => rounded([width, height], corner_radius),
        Shape::Circle { radius } => rounded([2.0 * radius; 2], radius),
        Shape::Capsule { length, radius } => rounded([2.0 * radius, length + 2.0 * radius], radius),
    }
}

/// A rectangle around the origin, its corners rounded by at most half its shorter side.
pub(crate) fn rounded([width, height]: [f32; 2], radius: f32) -> Vec<[f32; 2]> {
    let (x, y) = (0.5 * width, 0.5 * height);
    let radius = radius.min(x).min(y);
    if radius <= 0.0 {
        return vec![[-x, -y], [x, -y], [x, y], [-x, y]];
    }
    let (u, v) = (x - radius, y - radius);
    let corners = [([u, v], 0), ([-u, v], 1), ([-u, -v], 2), ([u, -v], 3)];
    let arc = |([centre_x, centre_y], quarter): ([f32; 2], usize)| {
        (0..=QUARTER).map(move |step| {
            let [x, y] = direction(quarter, step);
            [centre_x + radius * x, centre_y + radius * y]
        })
    };
    let mut points: Vec<[f32; 2]> = corners.into_iter().flat_map(arc).collect();
    // Where a side has no length, two arcs share a point.
    points.dedup();
    if points.first() == points.last() {
        points.pop();
    }
    points
}

/// An ellipse around the origin, by half its width and half its height.
pub(crate) fn ellipse([wide, high]: [f32; 2]) -> Vec<[f32; 2]> {
    rounded([2.0; 2], 1.0).into_iter().map(|[x, y]| [wide * x, high * y]).collect()
}

/// Exact at the ends of a quarter, so that neighbours meet.
fn direction(quarter: usize, step: usize) -> [f32; 2] {
    let (sin, cos) = match step {
        QUARTER => (1.0, 0.0),
        _ => libm::sincosf(step as f32 / QUARTER as f32 * FRAC_PI_2),
    };
    match quarter {
        0 => [cos, sin],
        1 => [-sin, cos],
        2 => [-cos, -sin],
        _ => [sin, -cos],
    }
}

/// Turned by an angle, rad, and then moved.
pub(crate) fn placed(points: Vec<[f32; 2]>, angle: f32, [left, up]: [f32; 2]) -> Vec<[f32; 2]> {
    let (sin, cos) = libm::sincosf(angle);
    points.into_iter().map(|[x, y]| [left + cos * x - sin * y, up + sin * x + cos * y]).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[[f32; 2]]) -> f32 {
        let ends = points.iter().zip(points.iter().cycle().skip(1));
        0.5 * ends.map(|([ax, ay], [bx, by])| ax * by - ay * bx).sum::<f32>()
    }

    #[test]
    fn outlines_are_counter_clockwise_and_as_large_as_their_shapes() {
        for (shape, points) in [
            (Shape::Box { width: 0.4, height: 0.2 }, 4),
            (Shape::Circle { radius: 0.3 }, 4 * QUARTER),
            (Shape::Capsule { length: 0.5, radius: 0.1 }, 4 * QUARTER + 2),
        ] {
            let outline = of_shape(shape, 0.0);
            assert_eq!(outline.len(), points, "{shape:?}: {outline:?}");
            assert!((area(&outline) / shape.area() - 1.0).abs() < 0.02, "{shape:?}");
            let is_inside = |point: &[f32; 2]| shape.distance_to(*point) < 1e-6;
            assert!(outline.iter().all(is_inside), "{shape:?}");
        }
        assert_eq!(of_shape(Shape::Box { width: 0.4, height: 0.2 }, 0.05).len(), 4 * (QUARTER + 1));
        assert!((area(&ellipse([2.0, 0.5])) / std::f32::consts::PI - 1.0).abs() < 0.02);
    }
}
