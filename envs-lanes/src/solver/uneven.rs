use super::{
    body::Body,
    floor::Floor,
    ledges::{Ledge, LedgeShape, Ledges},
    normal::Slanted,
    pace::Pace,
    rows::{Point, Rows},
};
use crate::lanes::{Lanes, Mask};
use creatures::Shape;
use parry2d::{
    math::{Pose, Rotation, Vector},
    query::{
        ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher,
        details::{contact_manifold_ball_ball, contact_manifold_convex_ball},
    },
    shape::{Ball, Cuboid, SharedShape},
};
use std::sync::Arc;

/// The contacts of the same part of `W` creatures with ground made of several shapes, each creature on ground of its own.
///
/// Where and which way a part touches a shape is found lane by lane, by parry: the geometry of rapier, with its contact
/// tracking, so that nothing can differ. It is asked only for shapes that are close; a half-space below them all is found
/// in lanes. The rows are solved in lanes.
#[derive(Clone, Debug)]
pub(super) struct UnevenContact<const W: usize> {
    part: Part,
    lanes: Vec<Lane>,
    /// The half-space, in lanes that have it as their first shape.
    floor: Floor<W>,
    /// Friction coefficient of part and ground together.
    friction: Lanes<W>,
    /// In a lane, each holds the contact with one shape at most. As many as were ever needed at once; the last is solved
    /// first.
    rows: Vec<Rows<Slanted<W>, W>>,
    /// Which of the rows' points are near the ground in this step.
    active: Vec<[Mask<W>; 2]>,
}

/// The shape of the part.
#[derive(Clone, Debug)]
struct Part {
    shape: PartShape,
    /// No point of it is further from its centre, m.
    radius: f32,
}

/// The shapes that are met often are known by their type, which spares parry the question.
#[derive(Clone, Debug)]
enum PartShape {
    Box(Cuboid),
    Circle(Ball),
    Other(SharedShape),
}

/// A lane's ground.
#[derive(Clone, Debug)]
struct Lane {
    ledges: Arc<Ledges>,
    /// The shapes that may come within reach while the part is where `stay` says, in the order of the ground; without
    /// the floor.
    nearby: Vec<usize>,
    /// From where to where the part's centre may move before `nearby` must be looked up again, m.
    stay: [f32; 2],
    /// The shapes that are within reach, in the order of the ground.
    contacts: Vec<Contact>,
}

/// A part on a shape of the ground.
#[derive(Clone, Debug)]
struct Contact {
    /// Index of the shape.
    ledge: usize,
    manifold: ContactManifold<(), Impulses>,
    /// The place among the rows that its contact has, from when it begins until it ends.
    row: Option<usize>,
    /// For each point of the rows, which point of the manifold it is.
    points: [Option<usize>; 2],
}

/// What a point of contact pressed with in the last step.
#[derive(Clone, Copy, Debug, Default)]
struct Impulses {
    normal: f32,
    friction: f32,
}

/// How far a part moves before what is near it is looked up again, m.
const STAY: f32 = 0.2;

/// What finding contacts needs to know of a body in a lane.
struct Placed {
    pose: Pose,
    velocity: Vector,
    spin: f32,
}

impl PartShape {
    fn as_shape(&self) -> &dyn parry2d::shape::Shape {
        match self {
            Self::Box(shape) => shape,
            Self::Circle(shape) => shape,
            Self::Other(shape) => &**shape,
        }
    }
}

impl Part {
    fn new(shape: Shape) -> Self {
        match shape {
            Shape::Box { width, height } => Self {
                shape: PartShape::Box(Cuboid::new(Vector::new(width * 0.5, height * 0.5))),
                radius: (width * width + height * height).sqrt() * 0.5,
            },
            Shape::Circle { radius } => Self { shape: PartShape::Circle(Ball::new(radius)), radius },
            Shape::Capsule { length, radius } => Self {
                shape: PartShape::Other(SharedShape::capsule_y(length * 0.5, radius)),
                radius: length * 0.5 + radius,
            },
        }
    }

    /// Whether nothing of a shape of the ground is within `reach` m of the part.
    #[inline(always)]
    fn is_far_from(&self, ledge: &Ledge, placed: &Placed, reach: f32) -> bool {
        if ledge.is_out_of_reach(placed.pose.translation, self.radius + reach) {
            return true;
        }
        let (PartShape::Box(part), LedgeShape::Circle(circle)) = (&self.shape, &ledge.shape) else { return false };
        // From the circle's centre to the nearest point of the box, on the safe side of rounding.
        let centre = placed.pose.inverse_transform_point(ledge.place.translation);
        let (x, y) = (centre.x.abs() - part.half_extents.x, centre.y.abs() - part.half_extents.y);
        let (x, y) = (x.max(0.0), y.max(0.0));
        let apart = 1.0001 * circle.radius + (reach + 0.001);
        x * x + y * y > apart * apart
    }
}

impl<const W: usize> UnevenContact<W> {
    pub(super) fn new(shape: Shape, ledges: Arc<Ledges>) -> Self {
        let floor = Floor::new(shape, ledges.has_floor());
        let lane = Lane { ledges, nearby: Vec::new(), stay: [f32::INFINITY; 2], contacts: Vec::new() };
        let (lanes, friction) = (vec![lane; W], Lanes::ZERO);
        Self { part: Part::new(shape), lanes, floor, friction, rows: Vec::new(), active: Vec::new() }
    }

    /// Forgets what a lane's part stood on.
    pub(super) fn reset(&mut self, lane: usize, friction: f32) {
        self.friction.0[lane] = friction;
        self.lanes[lane].contacts.clear();
        self.floor.reset(lane);
        for rows in &mut self.rows {
            rows.reset(lane, friction);
        }
    }

    /// Takes over what another lane's part stands on, and the ground it is on.
    pub(super) fn copy_lane(&mut self, lane: usize, from: &UnevenContact<1>) {
        self.reset(lane, from.friction.0[0]);
        self.lanes[lane].clone_from(&from.lanes[0]);
        while self.rows.len() < from.rows.len() {
            self.add_row();
        }
        self.floor.copy_lane(lane, &from.floor);
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

    /// The ground of a lane.
    pub(super) fn ledges(&self, lane: usize) -> &Ledges {
        &self.lanes[lane].ledges
    }

    /// Finds the points that are within `reach` m of the ground, or will be after a step of this many seconds.
    #[inline(always)]
    pub(super) fn find(&mut self, body: &Body<W>, reach: f32, time_step: &Lanes<W>) {
        self.active.fill([Mask::NONE; 2]);
        let begun = self.floor.find(body, reach, &self.rows);
        self.look_for_points(body, reach, time_step, begun);
        self.floor.fill(&mut self.rows, &mut self.active);
        for (rows, &active) in self.rows.iter_mut().zip(&self.active) {
            if active[0].or(active[1]).any() {
                rows.begin(body, active);
            } else if rows.near {
                rows.rest();
            }
        }
    }

    // Not inlined, unlike all else in a step: it goes lane by lane, and wide instructions are of no use to it.

    /// Finds the points on all but the floor, and gives rows to contacts; `floor_begun`: in these lanes that with the floor
    /// has begun as well.
    #[inline(never)]
    fn look_for_points(&mut self, body: &Body<W>, reach: f32, time_step: &Lanes<W>, floor_begun: Mask<W>) {
        self.remember();
        for lane in 0..W {
            self.find_in_lane(lane, body, reach, time_step.0[lane]);
            if floor_begun.lane(lane) {
                let row = self.free_row(lane);
                self.floor.begin(row, lane);
            }
            if self.lanes[lane].contacts.is_empty() {
                continue;
            }
            self.assign_rows(lane);
            let Lane { ledges, contacts, .. } = &self.lanes[lane];
            let placed = Placed::new(body, lane);
            for contact in contacts {
                if let Some(row) = contact.row {
                    let ground = ledges.ledge(contact.ledge).place;
                    contact.fill(&mut self.rows[row], &mut self.active[row], lane, &placed, &ground);
                }
            }
        }
    }

    /// Finds the contacts of a lane's part with the shapes around it.
    #[inline(always)]
    fn find_in_lane(&mut self, lane: usize, body: &Body<W>, reach: f32, time_step: f32) {
        let Self { part, lanes, floor, .. } = self;
        let around = part.radius + reach;
        if lanes[lane].ledges.are_below(body.y.0[lane], around) {
            lanes[lane].contacts.clear();
            return;
        }
        lanes[lane].look_around(body.x.0[lane], around, floor.is_there(lane));
        let Lane { ledges, nearby, contacts, .. } = &mut lanes[lane];
        if nearby.is_empty() {
            contacts.clear();
            return;
        }
        let placed = Placed::new(body, lane);
        let mut next = 0;
        for &index in nearby.iter() {
            let ledge = ledges.ledge(index);
            if part.is_far_from(ledge, &placed, reach) {
                continue;
            }
            // What is known and stands before it in the order is out of reach by now.
            while contacts.get(next).is_some_and(|contact| contact.ledge < index) {
                contacts.remove(next);
            }
            if contacts.get(next).is_none_or(|contact| contact.ledge != index) {
                contacts.insert(next, Contact::new(index));
            }
            contacts[next].update(&part.shape, ledge, &placed, reach, time_step);
            next += 1;
        }
        contacts.truncate(next);
    }

    #[inline(always)]
    pub(super) fn prepare(&mut self, body: &mut Body<W>, pace: &Pace<W>) {
        for rows in self.rows.iter_mut().rev() {
            rows.prepare(body, pace);
        }
    }

    #[inline(always)]
    pub(super) fn solve(&mut self, body: &mut Body<W>) {
        for rows in self.rows.iter_mut().rev() {
            rows.solve(body);
        }
    }

    #[inline(always)]
    pub(super) fn relax(&mut self, body: &mut Body<W>, pace: &Pace<W>) {
        for rows in self.rows.iter_mut().rev() {
            rows.relax(body, pace);
        }
    }

    pub(super) fn keep(&mut self, lanes: Mask<W>) {
        self.rows.iter_mut().for_each(|rows| rows.keep(lanes));
    }

    pub(super) fn put_back(&mut self, lanes: Mask<W>) {
        self.rows.iter_mut().for_each(|rows| rows.put_back(lanes));
    }

    /// Brings the impulses of the last step from the rows to the points they belong to.
    fn remember(&mut self) {
        for (lane, Lane { contacts, .. }) in self.lanes.iter_mut().enumerate() {
            for Contact { manifold, row, points, .. } in contacts {
                let Some(rows) = row.map(|row| &self.rows[row]) else { continue };
                for (point, index) in rows.points.iter().zip(points) {
                    let Some(known) = index.and_then(|index| manifold.points.get_mut(index)) else { continue };
                    known.data.normal = point.normal_impulse.0[lane];
                    known.data.friction = point.friction_impulse.0[lane];
                }
            }
        }
    }

    /// Gives rows to contacts that have begun, that with the floor, the first shape, first of all. rapier gives a contact
    /// with fixed ground the last of its colours that the part does not use, once all contacts that ended have given
    /// theirs back, and solves the first colours first. The last colour is the first of the rows here.
    fn assign_rows(&mut self, lane: usize) {
        for begun in 0..self.lanes[lane].contacts.len() {
            let contact = &self.lanes[lane].contacts[begun];
            if contact.row.is_none() && contact.points[0].is_some() {
                self.lanes[lane].contacts[begun].row = Some(self.free_row(lane));
            }
        }
    }

    /// The first of the rows that no contact has in a lane.
    fn free_row(&mut self, lane: usize) -> usize {
        let (floor, contacts) = (&self.floor, &self.lanes[lane].contacts);
        let taken = |row| floor.has(row, lane) || contacts.iter().any(|contact| contact.row == Some(row));
        let free = (0..self.rows.len()).find(|&row| !taken(row));
        free.unwrap_or_else(|| {
            self.add_row();
            self.rows.len() - 1
        })
    }

    fn add_row(&mut self) {
        let mut rows = Rows::new(Slanted { x: Lanes::ZERO, y: Lanes::ONE });
        rows.friction = self.friction;
        self.rows.push(rows);
        self.active.push([Mask::NONE; 2]);
        self.floor.add_row();
    }
}

impl Lane {
    /// Looks up the shapes around x again, if the part has left the place it did so last.
    #[inline(always)]
    fn look_around(&mut self, x: f32, around: f32, has_floor: bool) {
        let [from, to] = self.stay;
        if from <= x && x <= to {
            return;
        }
        self.ledges.find_near(x, around + STAY, &mut self.nearby);
        if has_floor {
            self.nearby.retain(|&index| index != 0);
        }
        self.stay = [x - STAY, x + STAY];
    }
}

impl Placed {
    #[inline(always)]
    fn new<const W: usize>(body: &Body<W>, lane: usize) -> Self {
        Self {
            pose: Pose {
                rotation: Rotation::from_cos_sin_unchecked(body.cos.0[lane], body.sin.0[lane]),
                translation: Vector::new(body.x.0[lane], body.y.0[lane]),
            },
            velocity: Vector::new(body.velocity_x.0[lane], body.velocity_y.0[lane]),
            spin: body.spin.0[lane],
        }
    }
}

impl Contact {
    fn new(index: usize) -> Self {
        Self { ledge: index, manifold: ContactManifold::default(), row: None, points: [None; 2] }
    }

    /// Finds the points of contact with a shape of the ground, by the function that parry would choose.
    fn update(&mut self, part: &PartShape, ledge: &Ledge, placed: &Placed, reach: f32, time_step: f32) {
        self.points = [None; 2];
        let ground = ledge.place;
        let relative = ground.inv_mul(&placed.pose);
        let manifold = &mut self.manifold;
        match (&ledge.shape, part) {
            (LedgeShape::Circle(ledge), PartShape::Box(part)) => {
                contact_manifold_convex_ball(&relative.inverse(), part, ledge, None, None, reach, manifold, true);
            }
            (LedgeShape::Circle(ledge), PartShape::Circle(part)) => {
                contact_manifold_ball_ball(&relative, ledge, part, reach, manifold);
            }
            (ledge, part) => {
                // It knows all the pairs of shapes there are here.
                let (ledge, part) = (ledge.as_shape(), part.as_shape());
                let _ = DefaultQueryDispatcher
                    .contact_manifold_convex_convex(&relative, ledge, part, None, None, reach, manifold);
            }
        }
        let normal = ground.rotation * self.manifold.local_n1;
        let mut found = 0;
        for (index, point) in self.manifold.points.iter().take(2).enumerate() {
            let arm = placed.pose * point.local_p2 - placed.pose.translation;
            let velocity = placed.velocity + Vector::new(-arm.y * placed.spin, arm.x * placed.spin);
            let soon = point.dist + velocity.dot(normal) * time_step;
            if point.dist < reach || soon < reach {
                self.points[found] = Some(index);
                found += 1;
            }
        }
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
        ground: &Pose,
    ) {
        let normal = ground.rotation * self.manifold.local_n1;
        rows.normal.x.0[lane] = normal.x;
        rows.normal.y.0[lane] = normal.y;
        for ((index, point), active) in self.points.iter().zip(&mut rows.points).zip(active) {
            let Some(contact) = index.and_then(|index| self.manifold.points.get(index)) else { continue };
            active.set_lane(lane, true);
            let (on_ground, on_part) = (ground * contact.local_p1, placed.pose * contact.local_p2);
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
