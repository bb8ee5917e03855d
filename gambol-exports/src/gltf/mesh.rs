//! What is painted of a part, as triangles.

use crate::outline;
use creatures::{Colour, Decoration, Form, Part};

/// An area of one colour.
pub(crate) struct Paint {
    pub(crate) colour: [u8; 3],
    /// In the frame of the part, m.
    pub(crate) points: Vec<[f32; 2]>,
    /// Counter-clockwise.
    pub(crate) triangles: Vec<[usize; 3]>,
}

/// The points of a round joint of a stroke.
const ROUND: usize = 8;
/// Where a line bends by less, as the cosine, its sides are simply drawn on to where they meet.
const SMOOTH: f32 = 0.7;

/// All that is painted of a part by the [rules of drawing](creatures::Look), from the back to the front.
pub(crate) fn paints(part: &Part) -> Vec<Paint> {
    let look = &part.look;
    let shape = filled(outline::of_shape(part.shape, look.corner_radius), &look.colour);
    std::iter::once(shape).chain(look.decorations.iter().flat_map(decoration)).collect()
}

fn decoration(decoration: &Decoration) -> Vec<Paint> {
    let (points, is_closed) = match &decoration.form {
        Form::Ellipse { centre, radii, angle } => {
            (outline::placed(outline::ellipse(*radii), angle.to_radians(), *centre), true)
        }
        Form::Rectangle { centre, size, corner_radius, angle } => {
            (outline::placed(outline::rounded(*size, *corner_radius), angle.to_radians(), *centre), true)
        }
        Form::Polygon { points } => (points.clone(), true),
        Form::Line { points } => (points.clone(), false),
    };
    let stroke = decoration.stroke.as_ref().map(|colour| stroked(&points, is_closed, decoration.width, colour));
    let fill = decoration.fill.as_ref().filter(|_| is_closed).map(|colour| filled(points, colour));
    fill.into_iter().chain(stroke).collect()
}

fn rgb(colour: &Colour) -> [u8; 3] {
    // Colours of a blueprint are well formed.
    colour.rgb().or_else(|| Colour::default().rgb()).unwrap_or_default()
}

fn filled(points: Vec<[f32; 2]>, colour: &Colour) -> Paint {
    Paint { colour: rgb(colour), triangles: triangulated(&points), points }
}

/// Cuts ears off a polygon, until nothing is left. Where it crosses itself there may be no ear: then any corner is cut
/// off.
fn triangulated(points: &[[f32; 2]]) -> Vec<[usize; 3]> {
    let mut rest: Vec<usize> = (0..points.len()).collect();
    let corner = |[a, b, c]: [usize; 3]| cross(points[a], points[b], points[c]);
    let area: f32 = (1..points.len().saturating_sub(1)).map(|index| corner([0, index, index + 1])).sum();
    if area < 0.0 {
        rest.reverse();
    }
    let mut triangles = Vec::new();
    while rest.len() >= 3 {
        let at = |place: usize| {
            let count = rest.len();
            [rest[(place + count - 1) % count], rest[place], rest[(place + 1) % count]]
        };
        let is_empty = |[a, b, c]: [usize; 3]| {
            let is_within = |&point: &usize| {
                let is_corner = [a, b, c].iter().any(|&corner| points[corner] == points[point]);
                !is_corner && [[a, b, point], [b, c, point], [c, a, point]].into_iter().all(|side| corner(side) >= 0.0)
            };
            !rest.iter().any(is_within)
        };
        let ear = (0..rest.len()).find(|&place| corner(at(place)) > 0.0 && is_empty(at(place)));
        let straight = || (0..rest.len()).find(|&place| corner(at(place)) == 0.0);
        let place = ear.or_else(straight).unwrap_or(0);
        triangles.extend(Some(at(place)).filter(|&triangle| corner(triangle) > 0.0));
        rest.remove(place);
    }
    triangles
}

/// Twice the area of a triangle; positive if it is counter-clockwise.
fn cross([ax, ay]: [f32; 2], [bx, by]: [f32; 2], [cx, cy]: [f32; 2]) -> f32 {
    (bx - ax) * (cy - ay) - (by - ay) * (cx - ax)
}

/// A line with round corners and ends.
fn stroked(points: &[[f32; 2]], is_closed: bool, width: f32, colour: &Colour) -> Paint {
    let mut paint = Paint { colour: rgb(colour), points: Vec::new(), triangles: Vec::new() };
    let half = 0.5 * width;
    let mut line = points.to_vec();
    line.dedup();
    if is_closed {
        line.extend(line.first().copied());
        line.dedup();
    }
    let directions: Vec<[f32; 2]> = line.windows(2).map(|ends| unit(ends[0], ends[1])).collect();
    let sides = directions.len();
    // The sides before and after each end of a side; none at the end of a line.
    let neighbours = |end: usize| match (end, is_closed && sides > 1) {
        (0, true) => Some((sides - 1, 0)),
        (end, true) if end == sides => Some((sides - 1, 0)),
        (end, _) if (1..sides).contains(&end) => Some((end - 1, end)),
        _ => None,
    };
    let smooth = |end: usize| {
        let (before, after) = neighbours(end)?;
        let ([ax, ay], [bx, by]) = (directions[before], directions[after]);
        let bend = ax * bx + ay * by;
        // Across the middle of both directions, so long that it reaches where the sides meet.
        (bend > SMOOTH).then(|| [-(ay + by) / (1.0 + bend), (ax + bx) / (1.0 + bend)])
    };
    for (side, &[x, y]) in directions.iter().enumerate() {
        let first = paint.points.len();
        for end in [side, side + 1] {
            let [across_x, across_y] = smooth(end).unwrap_or([-y, x]);
            let [at_x, at_y] = line[end];
            let moved = |by: f32| [at_x + by * across_x, at_y + by * across_y];
            paint.points.extend([moved(-half), moved(half)]);
        }
        paint.triangles.extend([[first, first + 2, first + 3], [first, first + 3, first + 1]]);
    }
    // A closed line ends where it begins.
    let ends = if is_closed && sides > 1 { 0..sides } else { 0..line.len() };
    for end in ends.filter(|&end| smooth(end).is_none()) {
        paint.disc(line[end], half);
    }
    paint
}

fn unit([ax, ay]: [f32; 2], [bx, by]: [f32; 2]) -> [f32; 2] {
    let (x, y) = (bx - ax, by - ay);
    let length = libm::hypotf(x, y).max(f32::MIN_POSITIVE);
    [x / length, y / length]
}

impl Paint {
    fn disc(&mut self, [x, y]: [f32; 2], radius: f32) {
        let first = self.points.len();
        for step in 0..ROUND {
            let (sin, cos) = libm::sincosf(step as f32 / ROUND as f32 * std::f32::consts::TAU);
            self.points.push([x + radius * cos, y + radius * sin]);
        }
        self.triangles.extend((1..ROUND - 1).map(|step| [first, first + step, first + step + 1]));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(paint: &Paint) -> f32 {
        let triangle = |&[a, b, c]: &[usize; 3]| 0.5 * cross(paint.points[a], paint.points[b], paint.points[c]);
        assert!(paint.triangles.iter().all(|each| triangle(each) >= 0.0), "counter-clockwise");
        paint.triangles.iter().map(triangle).sum()
    }

    #[test]
    fn triangles_cover_a_polygon_whichever_way_it_goes() {
        // An arrow head, with a corner that points inwards.
        let mut arrow = vec![[0.0, 0.0], [2.0, 1.0], [0.0, 2.0], [1.0, 1.0]];
        for _ in 0..2 {
            let paint = filled(arrow.clone(), &Colour::default());
            assert_eq!((paint.triangles.len(), area(&paint)), (2, 1.0));
            arrow.reverse();
        }
        // One that crosses itself is drawn somehow.
        assert!(filled(vec![[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]], &Colour::default()).triangles.len() <= 2);
    }

    #[test]
    fn strokes_are_as_wide_as_they_are_told() {
        let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let stroke = |closed| stroked(&square, closed, 0.1, &Colour::default());
        // Four sides, or three, and a disc at each corner.
        let disc = 2.0 * std::f32::consts::SQRT_2 * 0.05 * 0.05;
        assert!((area(&stroke(true)) - 0.4 - 4.0 * disc).abs() < 1e-6);
        assert!((area(&stroke(false)) - 0.3 - 4.0 * disc).abs() < 1e-6);
        let ring = stroked(&outline::ellipse([1.0, 1.0]), true, 0.1, &Colour::default());
        assert!((area(&ring) / (0.1 * std::f32::consts::TAU) - 1.0).abs() < 0.02);
    }
}
