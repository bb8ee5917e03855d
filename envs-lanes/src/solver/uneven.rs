use super::{
    body::Body,
    normal::Slanted,
    pace::Pace,
    rows::{Point, Rows},
};
use crate::lanes::{Lanes, Mask};
use creatures::Shape;
use envs_core::{Ground, GroundShape};
use parry2d::{
    math::{Pose, Rotation, Vector},
    query::{ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher, Ray},
    shape::SharedShape,
};
use std::sync::Arc;

/// The contacts of the same part of `W` creatures with ground made of several shapes.
///
/// Where and which way a part touches a box is found lane by lane, by parry: the geometry of rapier, with its contact
/// tracking, so that nothing can differ. It is asked only for shapes that are close. The rows are solved in lanes.
#[derive(Clone, Debug)]
pub(super) struct UnevenContact<const W: usize> {
    plan: Arc<Plan>,
    /// For each lane and each shape of the ground, what is known of it from the last step.
    footings: Vec<Vec<Footing>>,
    /// In the order rapier solves them in. In a lane, each holds the contact with one shape at most.
    rows: Vec<Rows<Slanted<W>, W>>,
    /// Which of the rows' points are near the ground in this step.
    active: Vec<[Mask<W>; 2]>,
}

/// What all lanes share.
#[derive(Debug)]
struct Plan {
    part: SharedShape,
    /// No point of the part is further from its centre, m.
    radius: f32,
    shapes: Vec<Ledge>,
}

/// A shape of the ground.
#[derive(Debug)]
struct Ledge {
    shape: SharedShape,
    /// Centre, m.
    centre: [f32; 2],
    /// Half its width and height, m; infinite but upwards for a half-space.
    half: [f32; 2],
}

/// A part on a shape of the ground.
#[derive(Clone, Debug, Default)]
struct Footing {
    manifold: ContactManifold<(), Impulses>,
    /// The place among the rows that its contact has, from when it begins until it ends.
    row: Option<usize>,
    /// For each point of the rows, which point of the manifold it is.
    points: [Option<usize>; 2],
    /// Where the shape is, m.
    place: Vector,
}

/// What a point of contact pressed with in the last step.
#[derive(Clone, Copy, Debug, Default)]
struct Impulses {
    normal: f32,
    friction: f32,
}

/// What finding contacts needs to know of a body in a lane.
struct Placed {
    pose: Pose,
    velocity: Vector,
    spin: f32,
}

impl<const W: usize> UnevenContact<W> {
    pub(super) fn new(shape: Shape, ground: &Ground) -> Self {
        let (part, radius) = match shape {
            Shape::Box { width, height } => {
                (SharedShape::cuboid(width * 0.5, height * 0.5), (width * width + height * height).sqrt() * 0.5)
            }
            Shape::Circle { radius } => (SharedShape::ball(radius), radius),
            Shape::Capsule { length, radius } => (SharedShape::capsule_y(length * 0.5, radius), length * 0.5 + radius),
        };
        let shapes: Vec<Ledge> = ground.shapes.iter().map(Ledge::new).collect();
        let normal = Slanted { x: Lanes::ZERO, y: Lanes::ONE };
        Self {
            footings: vec![vec![Footing::default(); shapes.len()]; W],
            rows: vec![Rows::new(normal); shapes.len()],
            active: vec![[Mask::NONE; 2]; shapes.len()],
            plan: Arc::new(Plan { part, radius, shapes }),
        }
    }

    /// Forgets what a lane's part stood on.
    pub(super) fn reset(&mut self, lane: usize, friction: f32) {
        self.footings[lane].fill(Footing::default());
        for rows in &mut self.rows {
            rows.reset(lane, friction);
        }
    }

    /// Takes over what another lane's part stands on.
    pub(super) fn copy_lane(&mut self, lane: usize, from: &UnevenContact<1>) {
        self.footings[lane].clone_from(&from.footings[0]);
        for (rows, from) in self.rows.iter_mut().zip(&from.rows) {
            rows.copy_lane(lane, from);
        }
    }

    /// Which creatures have pressed on the ground with this part in the last step.
    #[inline(always)]
    pub(super) fn pressing(&self) -> Mask<W> {
        let mut pressing = Mask::NONE;
        for rows in &self.rows {
            pressing = pressing.or(rows.pressing);
        }
        pressing
    }

    /// The distance from a point to the ground along a ray at `angle` (rad, in the world), m; `length` if it is further.
    pub(super) fn distance_along_ray(&self, [x, y]: [f32; 2], angle: f32, length: f32) -> f32 {
        let ray = Ray::new(Vector::new(x, y), Vector::new(libm::cosf(angle), libm::sinf(angle)));
        let distance = |ledge: &Ledge| {
            let place = Pose { rotation: Rotation::IDENTITY, translation: ledge.translation() };
            ledge.shape.cast_ray(&place, &ray, length, true)
        };
        self.plan.shapes.iter().filter_map(distance).fold(length, f32::min)
    }

    /// Finds the points that are within `reach` m of the ground, or will be after a step of this many seconds.
    #[inline(never)]
    pub(super) fn find(&mut self, body: &Body<W>, reach: f32, time_step: &Lanes<W>) {
        self.remember();
        self.active.fill([Mask::NONE; 2]);
        for lane in 0..W {
            let placed = Placed {
                pose: Pose {
                    rotation: Rotation::from_cos_sin_unchecked(body.cos.0[lane], body.sin.0[lane]),
                    translation: Vector::new(body.x.0[lane], body.y.0[lane]),
                },
                velocity: Vector::new(body.velocity_x.0[lane], body.velocity_y.0[lane]),
                spin: body.spin.0[lane],
            };
            for (ledge, footing) in self.plan.shapes.iter().zip(&mut self.footings[lane]) {
                footing.update(&self.plan, ledge, &placed, reach, time_step.0[lane]);
            }
            self.assign_rows(lane);
            for footing in &self.footings[lane] {
                if let Some(row) = footing.row {
                    footing.fill(&mut self.rows[row], &mut self.active[row], lane, &placed);
                }
            }
        }
        for (rows, &active) in self.rows.iter_mut().zip(&self.active) {
            rows.begin(body, active);
        }
    }

    // Not inlined, unlike all else in a step: finding contacts one by one is what takes the time here.

    #[inline(never)]
    pub(super) fn prepare(&mut self, body: &mut Body<W>, pace: &Pace<W>) {
        for rows in &mut self.rows {
            rows.prepare(body, pace);
        }
    }

    #[inline(never)]
    pub(super) fn solve(&mut self, body: &mut Body<W>) {
        for rows in &mut self.rows {
            rows.solve(body);
        }
    }

    #[inline(never)]
    pub(super) fn relax(&mut self, body: &mut Body<W>, pace: &Pace<W>) {
        for rows in &mut self.rows {
            rows.relax(body, pace);
        }
    }

    /// Brings the impulses of the last step from the rows to the points they belong to.
    fn remember(&mut self) {
        for (lane, footings) in self.footings.iter_mut().enumerate() {
            for Footing { manifold, row, points, .. } in footings {
                let Some(rows) = row.map(|row| &self.rows[row]) else { continue };
                for (point, index) in rows.points.iter().zip(points) {
                    let Some(known) = index.and_then(|index| manifold.points.get_mut(index)) else { continue };
                    known.data.normal = point.normal_impulse.0[lane];
                    known.data.friction = point.friction_impulse.0[lane];
                }
            }
        }
    }

    /// Gives rows to contacts that have begun. rapier gives a contact with fixed ground the last of its colours that the
    /// part does not use, once all contacts that ended have given theirs back, and solves the first colours first.
    fn assign_rows(&mut self, lane: usize) {
        let footings = &mut self.footings[lane];
        for shape in 0..footings.len() {
            let footing = &footings[shape];
            if footing.row.is_some() || footing.points[0].is_none() {
                continue;
            }
            let free = |row: &usize| footings.iter().all(|footing| footing.row != Some(*row));
            footings[shape].row = (0..footings.len()).rev().find(free);
        }
    }
}

impl Footing {
    /// Finds the points of contact with a shape of the ground.
    fn update(&mut self, plan: &Plan, ledge: &Ledge, placed: &Placed, reach: f32, time_step: f32) {
        self.points = [None; 2];
        if ledge.is_out_of_reach(placed, plan.radius + reach) {
            *self = Self::default();
            return;
        }
        let ground = Pose { rotation: Rotation::IDENTITY, translation: ledge.translation() };
        // It knows all the pairs of shapes there are here.
        let _ = DefaultQueryDispatcher.contact_manifold_convex_convex(
            &ground.inv_mul(&placed.pose),
            &*ledge.shape,
            &*plan.part,
            None,
            None,
            reach,
            &mut self.manifold,
        );
        let mut found = 0;
        for (index, point) in self.manifold.points.iter().take(2).enumerate() {
            let arm = placed.pose * point.local_p2 - placed.pose.translation;
            let velocity = placed.velocity + Vector::new(-arm.y * placed.spin, arm.x * placed.spin);
            let soon = point.dist + velocity.dot(self.manifold.local_n1) * time_step;
            if point.dist < reach || soon < reach {
                self.points[found] = Some(index);
                found += 1;
            }
        }
        self.place = ledge.translation();
        if found == 0 {
            self.row = None;
        }
    }

    /// Sets a lane of the rows.
    fn fill<const W: usize>(
        &self,
        rows: &mut Rows<Slanted<W>, W>,
        active: &mut [Mask<W>; 2],
        lane: usize,
        placed: &Placed,
    ) {
        // The ground is never turned.
        let normal = self.manifold.local_n1;
        rows.normal.x.0[lane] = normal.x;
        rows.normal.y.0[lane] = normal.y;
        for ((index, point), active) in self.points.iter().zip(&mut rows.points).zip(active) {
            let Some(contact) = index.and_then(|index| self.manifold.points.get(index)) else { continue };
            active.set_lane(lane, true);
            let (on_ground, on_part) = (contact.local_p1 + self.place, placed.pose * contact.local_p2);
            set_point(point, lane, placed, normal, (on_ground, on_part, contact.dist));
            point.normal_impulse.0[lane] = contact.data.normal;
            point.friction_impulse.0[lane] = contact.data.friction;
        }
    }
}

/// Sets a point of contact from where it is on the ground and on the part, and how far apart the surfaces are; rounded
/// as rapier rounds it.
fn set_point<const W: usize>(
    point: &mut Point<W>,
    lane: usize,
    placed: &Placed,
    normal: Vector,
    (on_ground, on_part, distance): (Vector, Vector, f32),
) {
    let centre = placed.pose.translation;
    let shift = (on_part - on_ground).dot(normal) - distance;
    let on_ground = on_ground + normal * shift;
    // Halfway between the two; the lever stays as it is for the whole step.
    let middle = (on_ground + on_part) * 0.5;
    let lever = middle - centre;
    // rapier carries the part's point through the body's own frame, which rounds it.
    let carried = placed.pose.transform_point(placed.pose.inverse_transform_point(on_part));
    let local = placed.pose.inverse_transform_point(centre + lever);
    let gap = |ground: Vector, part: Vector| (ground.x - part.x) * normal.x + (ground.y - part.y) * normal.y;
    point.lever.0.0[lane] = lever.x;
    point.lever.1.0[lane] = lever.y;
    point.local.0.0[lane] = local.x;
    point.local.1.0[lane] = local.y;
    point.ground.0.0[lane] = middle.x;
    point.ground.1.0[lane] = middle.y;
    point.offset.0[lane] = gap(middle, centre + lever) - gap(on_ground, carried);
}

impl Ledge {
    fn new(shape: &GroundShape) -> Self {
        match *shape {
            GroundShape::HalfSpace => {
                Self { shape: SharedShape::halfspace(Vector::Y), centre: [0.0, 0.0], half: [f32::INFINITY, 0.0] }
            }
            GroundShape::Box { x, y, width, height } => Self {
                shape: SharedShape::cuboid(width * 0.5, height * 0.5),
                centre: [x, y],
                half: [width * 0.5, height * 0.5],
            },
        }
    }

    fn translation(&self) -> Vector {
        Vector::new(self.centre[0], self.centre[1])
    }

    /// Whether nothing within `reach` of a body's centre is within the shape.
    fn is_out_of_reach(&self, placed: &Placed, reach: f32) -> bool {
        let [x, y] = self.centre;
        let [half_width, half_height] = self.half;
        let Vector { x: body_x, y: body_y } = placed.pose.translation;
        let margin = reach + 0.1;
        let below = half_width.is_finite() && y - body_y > half_height + margin;
        body_y - y > half_height + margin || below || (body_x - x).abs() > half_width + margin
    }
}
