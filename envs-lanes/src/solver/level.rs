use super::{
    body::Body,
    normal::Up,
    rows::{Point, Rows},
};
use crate::lanes::{Lanes, Mask};
use creatures::Shape;

/// The contact of the same part of `W` creatures with level ground.
#[derive(Clone, Debug)]
pub(super) struct LevelContact<const W: usize> {
    underside: Underside<W>,
    pub(super) rows: Rows<Up, W>,
}

/// Where the same part of `W` creatures may touch level ground.
#[derive(Clone, Debug)]
pub(super) struct Underside<const W: usize> {
    outline: Outline,
    /// Which corners of the shape the points of contact are, in the body's own frame: by it, an impulse is known again in
    /// the next step.
    corners: [(Lanes<W>, Lanes<W>); 2],
}

/// What of a shape can touch level ground.
#[derive(Clone, Copy, Debug)]
enum Outline {
    /// The edge that looks down most.
    Box { half_width: f32, half_height: f32 },
    /// The ends of a segment, rounded.
    Capsule { half_length: f32, radius: f32 },
    /// One point.
    Circle { radius: f32 },
}

impl<const W: usize> LevelContact<W> {
    pub(super) fn new(shape: Shape) -> Self {
        Self { underside: Underside::new(shape), rows: Rows::new(Up) }
    }

    /// Takes over what another lane's part presses on the ground with.
    pub(super) fn copy_lane(&mut self, lane: usize, from: &LevelContact<1>) {
        self.rows.copy_lane(lane, &from.rows);
        self.underside.copy_lane(lane, &from.underside);
    }

    /// Finds the points that are within `reach` m of the ground. Points that were there in the last step keep their
    /// impulses.
    #[inline(always)]
    pub(super) fn find(&mut self, body: &Body<W>, reach: f32) {
        let reach = Lanes::splat(reach);
        if !self.underside.near(body, reach).any() {
            self.rows.rest();
            return;
        }
        let active = self.underside.find(body, reach, &mut self.rows.points);
        self.rows.begin(body, active);
    }
}

impl<const W: usize> Underside<W> {
    pub(super) fn new(shape: Shape) -> Self {
        let outline = match shape {
            Shape::Box { width, height } => Outline::Box { half_width: width * 0.5, half_height: height * 0.5 },
            Shape::Circle { radius } => Outline::Circle { radius },
            Shape::Capsule { length, radius } => Outline::Capsule { half_length: length * 0.5, radius },
        };
        // No point has had a corner yet, and the second of a circle never will: NaN equals no number.
        let none = Lanes::splat(f32::NAN);
        Self { outline, corners: [(none, none); 2] }
    }

    /// Takes over which corners another lane's points are.
    pub(super) fn copy_lane(&mut self, lane: usize, from: &Underside<1>) {
        for (corner, from) in self.corners.iter_mut().zip(&from.corners) {
            corner.0.0[lane] = from.0.0[0];
            corner.1.0[lane] = from.1.0[0];
        }
    }

    /// The lanes in which a point may be within `reach` m of the ground.
    #[inline(always)]
    pub(super) fn near(&self, body: &Body<W>, reach: Lanes<W>) -> Mask<W> {
        self.lowest(body).less(reach)
    }

    /// Sets the points from where the body is; returns which of them are within `reach` m of the ground. Impulses of the
    /// last step go with the corners that had them.
    #[inline(always)]
    pub(super) fn find(&mut self, body: &Body<W>, reach: Lanes<W>, points: &mut [Point<W>; 2]) -> [Mask<W>; 2] {
        let corners = self.corners(body);
        let before = self.corners;
        let old = points.map(|point| (point.normal_impulse, point.friction_impulse));
        let mut active = [Mask::NONE; 2];
        for (index, corner) in corners.into_iter().enumerate() {
            let Some((x, y)) = corner else { continue };
            let point = &mut points[index];
            active[index] = place(point, self.outline, (x, y), body).less(reach);
            let [mut normal, mut friction] = [Lanes::ZERO; 2];
            for (corner, old) in before.iter().zip(&old) {
                let same = x.equal(corner.0).and(y.equal(corner.1));
                normal = same.select(old.0, normal);
                friction = same.select(old.1, friction);
            }
            (point.normal_impulse, point.friction_impulse) = (normal, friction);
            self.corners[index] = (x, y);
        }
        active
    }

    /// At most the height of the lowest point.
    #[inline(always)]
    fn lowest(&self, body: &Body<W>) -> Lanes<W> {
        let margin = Lanes::splat(1e-3);
        let reach = match self.outline {
            Outline::Box { half_width, half_height } => {
                body.sin.abs() * Lanes::splat(half_width) + body.cos.abs() * Lanes::splat(half_height)
            }
            Outline::Capsule { half_length, radius } => {
                body.cos.abs() * Lanes::splat(half_length) + Lanes::splat(radius)
            }
            Outline::Circle { radius } => Lanes::splat(radius),
        };
        body.y - reach - margin
    }

    /// The corners that may touch, in the body's own frame.
    #[inline(always)]
    fn corners(&self, body: &Body<W>) -> [Option<(Lanes<W>, Lanes<W>)>; 2] {
        let zero = Lanes::ZERO;
        match self.outline {
            Outline::Box { half_width, half_height } => {
                let (width, height) = (Lanes::splat(half_width), Lanes::splat(half_height));
                // Downwards, seen from the body, is (-sin, -cos); the edge across the larger of the two looks down most.
                let level = body.sin.abs().at_most(body.cos.abs());
                let (side_x, side_y) = (width.with_sign_of(-body.sin), height.with_sign_of(-body.cos));
                let first = (level.select(width, side_x), level.select(side_y, height));
                let second = (level.select(-width, side_x), level.select(side_y, -height));
                [Some(first), Some(second)]
            }
            Outline::Capsule { half_length, .. } => {
                let half = Lanes::splat(half_length);
                [Some((zero, -half)), Some((zero, half))]
            }
            Outline::Circle { .. } => [Some((zero, zero)), None],
        }
    }
}

/// Sets lever and local point from the corner; returns the distance from the ground, m.
#[inline(always)]
fn place<const W: usize>(
    point: &mut Point<W>,
    outline: Outline,
    (x, y): (Lanes<W>, Lanes<W>),
    body: &Body<W>,
) -> Lanes<W> {
    let half = Lanes::splat(0.5);
    let (turned_x, turned_y) = body.turn(x, y);
    let (corner_x, corner_y) = (turned_x + body.x, turned_y + body.y);
    // The surface point and the one below it on the ground, and how far apart they are.
    let (surface, distance) = match outline {
        Outline::Box { .. } => ((corner_x, corner_y), corner_y),
        Outline::Capsule { radius, .. } => {
            let radius = Lanes::splat(radius);
            let (x, y) = body.turn(x - body.sin * radius, y - body.cos * radius);
            ((x + body.x, y + body.y), corner_y - radius)
        }
        Outline::Circle { radius } => {
            let radius = Lanes::splat(radius);
            let (x, y) = body.turn(-body.sin * radius, -body.cos * radius);
            ((x + body.x, y + body.y), body.y - radius)
        }
    };
    let ground_x = if matches!(outline, Outline::Circle { .. }) { body.x } else { corner_x };
    let ground_y = surface.1 - distance;
    // Halfway between the two; the lever stays as it is for the whole step.
    let (middle_x, middle_y) = ((ground_x + surface.0) * half, (ground_y + surface.1) * half);
    let lever = (middle_x - body.x, middle_y - body.y);
    point.lever = lever;
    point.local = body.turn_back((body.x + lever.0) - body.x, (body.y + lever.1) - body.y);
    // rapier carries the surface point through the body's own frame, which rounds it.
    let (local_x, local_y) = body.turn_back(surface.0 - body.x, surface.1 - body.y);
    let (_, height) = body.turn(local_x, local_y);
    let carried = (height + body.y) - ground_y;
    point.ground = (middle_x, middle_y);
    point.offset = carried + (middle_y - (body.y + lever.1));
    distance
}
