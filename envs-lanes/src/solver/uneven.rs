use super::{
    body::Body,
    ledges::{Ledge, Ledges},
    normal::Slanted,
    pace::Pace,
    rows::{Point, Rows},
};
use crate::lanes::{Lanes, Mask};
use creatures::Shape;
use parry2d::{
    math::{Pose, Rotation, Vector},
    query::{ContactManifold, DefaultQueryDispatcher, PersistentQueryDispatcher},
    shape::SharedShape,
};
use std::sync::Arc;

/// The contacts of the same part of `W` creatures with ground made of several shapes, each creature on ground of its own.
///
/// Where and which way a part touches a shape is found lane by lane, by parry: the geometry of rapier, with its contact
/// tracking, so that nothing can differ. It is asked only for shapes that are close. The rows are solved in lanes.
#[derive(Clone, Debug)]
pub(super) struct UnevenContact<const W: usize> {
    part: SharedShape,
    /// No point of the part is further from its centre, m.
    radius: f32,
    lanes: Vec<Lane>,
    /// Friction coefficient of part and ground together.
    friction: Lanes<W>,
    /// In a lane, each holds the contact with one shape at most. As many as were ever needed at once; the last is solved
    /// first.
    rows: Vec<Rows<Slanted<W>, W>>,
    /// Which of the rows' points are near the ground in this step.
    active: Vec<[Mask<W>; 2]>,
}

/// A lane's ground.
#[derive(Clone, Debug)]
struct Lane {
    ledges: Arc<Ledges>,
    /// The shapes that may come within reach while the part is where `stay` says, in the order of the ground.
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

impl<const W: usize> UnevenContact<W> {
    pub(super) fn new(shape: Shape, ledges: Arc<Ledges>) -> Self {
        let (part, radius) = match shape {
            Shape::Box { width, height } => {
                (SharedShape::cuboid(width * 0.5, height * 0.5), (width * width + height * height).sqrt() * 0.5)
            }
            Shape::Circle { radius } => (SharedShape::ball(radius), radius),
            Shape::Capsule { length, radius } => (SharedShape::capsule_y(length * 0.5, radius), length * 0.5 + radius),
        };
        let lane = Lane { ledges, nearby: Vec::new(), stay: [f32::INFINITY; 2], contacts: Vec::new() };
        let (lanes, friction) = (vec![lane; W], Lanes::ZERO);
        Self { part, radius, lanes, friction, rows: Vec::new(), active: Vec::new() }
    }

    /// Forgets what a lane's part stood on.
    pub(super) fn reset(&mut self, lane: usize, friction: f32) {
        self.friction.0[lane] = friction;
        self.lanes[lane].contacts.clear();
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
        self.look_for_points(body, reach, time_step);
        for (rows, &active) in self.rows.iter_mut().zip(&self.active) {
            if active[0].or(active[1]).any() {
                rows.begin(body, active);
            } else if rows.near {
                rows.rest();
            }
        }
    }

    // Not inlined, unlike all else in a step: it goes lane by lane, and wide instructions are of no use to it.

    #[inline(never)]
    fn look_for_points(&mut self, body: &Body<W>, reach: f32, time_step: &Lanes<W>) {
        self.remember();
        self.active.fill([Mask::NONE; 2]);
        let around = self.radius + reach;
        for lane in 0..W {
            let placed = Placed {
                pose: Pose {
                    rotation: Rotation::from_cos_sin_unchecked(body.cos.0[lane], body.sin.0[lane]),
                    translation: Vector::new(body.x.0[lane], body.y.0[lane]),
                },
                velocity: Vector::new(body.velocity_x.0[lane], body.velocity_y.0[lane]),
                spin: body.spin.0[lane],
            };
            if self.lanes[lane].ledges.are_below(placed.pose.translation.y, around) {
                self.lanes[lane].contacts.clear();
                continue;
            }
            self.lanes[lane].look_around(placed.pose.translation.x, around);
            let Lane { ledges, nearby, contacts, .. } = &mut self.lanes[lane];
            let mut next = 0;
            for &index in nearby.iter() {
                let ledge = ledges.ledge(index);
                if ledge.is_out_of_reach(placed.pose.translation, around) {
                    continue;
                }
                // What is known and stands before it in the order is out of reach by now.
                while contacts.get(next).is_some_and(|contact| contact.ledge < index) {
                    contacts.remove(next);
                }
                if contacts.get(next).is_none_or(|contact| contact.ledge != index) {
                    contacts.insert(next, Contact::new(index));
                }
                contacts[next].update(&*self.part, ledge, &placed, reach, time_step.0[lane]);
                next += 1;
            }
            contacts.truncate(next);
            self.assign_rows(lane);
            let Lane { ledges, contacts, .. } = &self.lanes[lane];
            for contact in contacts {
                if let Some(row) = contact.row {
                    let ground = ledges.ledge(contact.ledge).place;
                    contact.fill(&mut self.rows[row], &mut self.active[row], lane, &placed, &ground);
                }
            }
        }
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

    /// Gives rows to contacts that have begun. rapier gives a contact with fixed ground the last of its colours that the
    /// part does not use, once all contacts that ended have given theirs back, and solves the first colours first. The
    /// last colour is the first of the rows here.
    fn assign_rows(&mut self, lane: usize) {
        for begun in 0..self.lanes[lane].contacts.len() {
            let contacts = &mut self.lanes[lane].contacts;
            if contacts[begun].row.is_some() || contacts[begun].points[0].is_none() {
                continue;
            }
            let taken = |row: usize| contacts.iter().any(|contact| contact.row == Some(row));
            let free = (0..).find(|&row| !taken(row));
            contacts[begun].row = free;
            while free.is_some_and(|row| row >= self.rows.len()) {
                self.add_row();
            }
        }
    }

    fn add_row(&mut self) {
        let mut rows = Rows::new(Slanted { x: Lanes::ZERO, y: Lanes::ONE });
        rows.friction = self.friction;
        self.rows.push(rows);
        self.active.push([Mask::NONE; 2]);
    }
}

impl Lane {
    /// Looks up the shapes around x again, if the part has left the place it did so last.
    #[inline(always)]
    fn look_around(&mut self, x: f32, around: f32) {
        let [from, to] = self.stay;
        if from <= x && x <= to {
            return;
        }
        self.nearby.clear();
        self.nearby.extend(self.ledges.near(x, around + STAY));
        self.stay = [x - STAY, x + STAY];
    }
}

impl Contact {
    fn new(index: usize) -> Self {
        Self { ledge: index, manifold: ContactManifold::default(), row: None, points: [None; 2] }
    }

    /// Finds the points of contact with a shape of the ground.
    fn update(&mut self, part: &dyn parry2d::shape::Shape, ledge: &Ledge, placed: &Placed, reach: f32, time_step: f32) {
        self.points = [None; 2];
        let ground = ledge.place;
        // It knows all the pairs of shapes there are here.
        let _ = DefaultQueryDispatcher.contact_manifold_convex_convex(
            &ground.inv_mul(&placed.pose),
            &*ledge.shape,
            part,
            None,
            None,
            reach,
            &mut self.manifold,
        );
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
