use super::{
    body::Body,
    contacts::Contacts,
    joint::Joint,
    mass::InverseMass,
    order::{refuse_what_lanes_cannot_do, solving_order},
    pace::Pace,
};
use crate::{
    instructions::{Worker, work},
    lanes::{Lanes, Mask},
    stopwatch::{Laps, Part},
};
use creatures::Blueprint;
use envs_core::{Conditions, EnvironmentError, Ground, PhysicsSettings};
use std::sync::Arc;
use tasks::PartState;

/// `W` creatures of the same body, each in a world of its own.
#[derive(Clone, Debug)]
pub(crate) struct LaneWorld<const W: usize> {
    plan: Arc<Plan>,
    bodies: Vec<Body<W>>,
    /// In the order they are solved in.
    joints: Vec<Joint<W>>,
    contacts: Contacts<W>,
    pace: Pace<W>,
    kept: Kept<W>,
    /// For each hinge of the blueprint, its place among the joints.
    joint_of: Vec<usize>,
}

/// What lanes with fewer substeps than others were like when their step was over: until all are done, they go on with the
/// others, to no effect.
#[derive(Clone, Debug)]
struct Kept<const W: usize> {
    bodies: Vec<Body<W>>,
    /// Of the motor of each joint.
    motor_impulses: Vec<Lanes<W>>,
}

/// What all lanes share, but for what a lane's own trial has in its place.
#[derive(Debug)]
struct Plan {
    blueprint: Blueprint,
    settings: PhysicsSettings,
    ground: Ground,
    /// The hinges in the order their joints are solved in.
    order: Vec<usize>,
}

impl<const W: usize> LaneWorld<W> {
    /// Worlds with no creature in them yet: see [`reset`](Self::reset) and [`copy_lane`](Self::copy_lane).
    ///
    /// # Errors
    /// If lanes cannot do what is asked for.
    pub(crate) fn new(
        blueprint: &Blueprint,
        settings: &PhysicsSettings,
        ground: &Ground,
    ) -> Result<Self, EnvironmentError> {
        refuse_what_lanes_cannot_do(blueprint, settings, ground)?;
        Ok(Self::empty(Arc::new(Plan {
            blueprint: blueprint.clone(),
            settings: *settings,
            ground: ground.clone(),
            order: solving_order(blueprint)?,
        })))
    }

    /// Worlds of the same kind with another number of lanes, with no creature in them yet.
    pub(crate) fn widened<const V: usize>(&self) -> LaneWorld<V> {
        LaneWorld::empty(self.plan.clone())
    }

    fn empty(plan: Arc<Plan>) -> Self {
        let Plan { blueprint, settings, ground, order } = &*plan;
        let mut joint_of = vec![0; order.len()];
        for (place, &hinge) in order.iter().enumerate() {
            joint_of[hinge] = place;
        }
        Self {
            bodies: vec![Body::at_rest(); blueprint.parts().len()],
            joints: order.iter().map(|&hinge| Joint::new(blueprint, &blueprint.hinges()[hinge])).collect(),
            contacts: Contacts::new(blueprint, ground),
            pace: Pace::new(settings),
            kept: Kept {
                bodies: vec![Body::at_rest(); blueprint.parts().len()],
                motor_impulses: vec![Lanes::ZERO; order.len()],
            },
            joint_of,
            plan,
        }
    }

    /// Puts a creature in its start pose into a lane.
    pub(crate) fn reset(&mut self, lane: usize, conditions: &Conditions) {
        let Plan { blueprint, settings, .. } = &*self.plan;
        self.pace.set_lane(lane, settings);
        let substep = self.pace.substep.0[lane];
        for (index, (part, body)) in blueprint.parts().iter().zip(&mut self.bodies).enumerate() {
            let mass = InverseMass::of(part, conditions.mass);
            let weight = -settings.gravity * (1.0 / mass.linear);
            let (sin, cos) = libm::sincosf(part.angle);
            body.x.0[lane] = part.x;
            body.y.0[lane] = part.y;
            body.cos.0[lane] = cos;
            body.sin.0[lane] = sin;
            body.velocity_x.0[lane] = 0.0;
            body.velocity_y.0[lane] = 0.0;
            body.spin.0[lane] = 0.0;
            body.inverse_mass.0[lane] = mass.linear;
            body.inverse_inertia.0[lane] = mass.angular;
            body.fall.0[lane] = weight * mass.linear * substep;
            let friction = part.friction * (settings.ground_friction * conditions.friction);
            self.contacts.reset(index, lane, friction);
        }
        for (hinge, &place) in blueprint.hinges().iter().zip(&self.joint_of) {
            let torque = hinge.motor.map_or(0.0, |motor| motor.top_torque * conditions.torque);
            self.joints[place].reset_motor(lane, torque, settings.motor_gain, substep, &self.bodies);
        }
    }

    /// Puts what is in a lane of other worlds of the same kind into a lane of these.
    pub(crate) fn copy_lane(&mut self, lane: usize, from: &LaneWorld<1>) {
        self.pace.copy_lane(lane, &from.pace);
        for (mine, theirs) in self.bodies.iter_mut().zip(&from.bodies) {
            mine.copy_lane(lane, theirs);
        }
        for (mine, theirs) in self.joints.iter_mut().zip(&from.joints) {
            mine.copy_lane(lane, theirs);
        }
        self.contacts.copy_lane(lane, &from.contacts);
    }

    /// Whether the ground is a single half-space; its contacts are of another kind then.
    pub(crate) fn is_level(&self) -> bool {
        self.contacts.is_level()
    }

    /// A part of all creatures.
    #[inline(always)]
    pub(crate) fn body(&self, part: usize) -> &Body<W> {
        &self.bodies[part]
    }

    /// Which creatures press on the ground with a part.
    #[inline(always)]
    pub(crate) fn pressing(&self, part: usize) -> Mask<W> {
        self.contacts.pressing(part)
    }

    /// 1 in the lanes in which any part presses on the ground, 0 in the others.
    pub(crate) fn touching(&self) -> Lanes<W> {
        let pressing = (0..self.bodies.len()).map(|part| self.pressing(part));
        pressing.reduce(Mask::or).unwrap_or(Mask::NONE).select(Lanes::ONE, Lanes::ZERO)
    }

    /// The torque the motor of a hinge gave at the end of the last step, N·m.
    pub(crate) fn motor_torques(&self, hinge: usize) -> Lanes<W> {
        self.joints[self.joint_of[hinge]].motor_impulse() / self.pace.substep
    }

    /// The mean power of the motor of a hinge in the last step, W.
    #[inline(always)]
    pub(crate) fn motor_powers(&self, hinge: usize) -> Lanes<W> {
        self.joints[self.joint_of[hinge]].motor_power(&self.bodies, &self.pace)
    }

    /// The larger velocity component of the part for which it is largest, m/s; NaN if a number is not finite.
    #[inline(always)]
    pub(crate) fn fastest(&self) -> Lanes<W> {
        let (mut fastest, mut zero) = (Lanes::ZERO, Lanes::ZERO);
        for body in &self.bodies {
            fastest = fastest.max(body.velocity_x.abs()).max(body.velocity_y.abs());
            // Zero as long as all is finite.
            let sum = body.x + body.y + body.cos + body.sin + body.velocity_x + body.velocity_y + body.spin;
            zero += sum * Lanes::ZERO;
        }
        fastest + zero
    }

    /// The distance from a point to the ground along a ray at `angle` (rad, in the world), m; `length` if it is further.
    #[inline(always)]
    pub(crate) fn distance_to_ground(&self, (x, y): (Lanes<W>, Lanes<W>), angle: f32, length: f32) -> Lanes<W> {
        if let Contacts::Uneven(contacts) = &self.contacts {
            let from = |lane: usize| [x.0[lane], y.0[lane]];
            let distance = |lane| contacts[0].ledges(lane).distance_along_ray(from(lane), angle, length);
            return Lanes(std::array::from_fn(distance));
        }
        let down = libm::sinf(angle);
        y.map(|y| {
            let distance = -y / down;
            let hit = distance >= 0.0 && distance <= length;
            if y < 0.0 {
                0.0
            } else if hit {
                distance
            } else {
                length
            }
        })
    }

    /// Asks the motor of a hinge for a speed in each lane, rad/s.
    #[inline(always)]
    pub(crate) fn set_motor_speeds(&mut self, hinge: usize, speeds: Lanes<W>) {
        if let Some(wanted) = self.joints[self.joint_of[hinge]].wanted_speed() {
            *wanted = speeds;
        }
    }

    /// Asks the motor of a lane's hinge for a speed, rad/s.
    pub(crate) fn set_motor_speed(&mut self, lane: usize, hinge: usize, speed: f32) {
        if let Some(wanted) = self.joints[self.joint_of[hinge]].wanted_speed() {
            wanted.0[lane] = speed;
        }
    }

    /// The velocity of a lane's part along the ground, m/s.
    pub(crate) fn velocity_x(&self, lane: usize, part: usize) -> f32 {
        self.bodies[part].velocity_x.0[lane]
    }

    /// Adds to the velocity of a lane's part, m/s, and to its spin, rad/s.
    pub(crate) fn nudge(&mut self, lane: usize, part: usize, [x, y]: [f32; 2], spin: f32) {
        let body = &mut self.bodies[part];
        body.velocity_x.0[lane] += x;
        body.velocity_y.0[lane] += y;
        body.spin.0[lane] += spin;
    }

    /// Writes where the parts of a lane are.
    pub(crate) fn look(&self, lane: usize, parts: &mut [PartState]) {
        for (index, (part, body)) in parts.iter_mut().zip(&self.bodies).enumerate() {
            *part = PartState {
                x: body.x.0[lane],
                y: body.y.0[lane],
                cos: body.cos.0[lane],
                sin: body.sin.0[lane],
                vx: body.velocity_x.0[lane],
                vy: body.velocity_y.0[lane],
                spin: body.spin.0[lane],
                touching: self.contacts.pressing(index).lane(lane),
            };
        }
    }

    /// One time step of all lanes.
    ///
    /// The worker is given one phase at a time: as one function, with every set of instructions, a step takes the compiler
    /// about twice as long, and is no faster.
    pub(crate) fn step(&mut self, worker: impl Worker, mut stopwatch: Option<&mut Laps>) {
        let stopwatch = &mut stopwatch;
        work!(worker, LaneWorld, self, begin);
        lap(stopwatch, Part::FindContacts);
        for done in 1..=self.pace.most_substeps {
            self.substep(worker, stopwatch);
            if self.pace.uneven && done < self.pace.most_substeps {
                self.keep(self.pace.with_substeps(done));
            }
        }
        if self.pace.uneven {
            self.put_back(self.pace.with_fewer_substeps());
        }
    }

    /// One substep of all lanes.
    fn substep(&mut self, worker: impl Worker, stopwatch: &mut Option<&mut Laps>) {
        work!(worker, LaneWorld, self, fall);
        lap(stopwatch, Part::Fall);
        work!(worker, LaneWorld, self, prepare_joints);
        lap(stopwatch, Part::PrepareJoints);
        work!(worker, LaneWorld, self, prepare_contacts);
        lap(stopwatch, Part::PrepareContacts);
        for _ in 0..self.plan.settings.internal_iterations {
            work!(worker, LaneWorld, self, solve_joints);
            lap(stopwatch, Part::SolveJoints);
            work!(worker, LaneWorld, self, solve_contacts);
            lap(stopwatch, Part::SolveContacts);
        }
        work!(worker, LaneWorld, self, advance);
        lap(stopwatch, Part::Move);
        work!(worker, LaneWorld, self, relax_joints);
        lap(stopwatch, Part::RelaxJoints);
        work!(worker, LaneWorld, self, relax_contacts);
        lap(stopwatch, Part::RelaxContacts);
    }

    #[inline(always)]
    fn begin(&mut self) {
        for joint in &mut self.joints {
            joint.begin(&self.bodies);
        }
        self.contacts.find(&self.bodies, self.plan.settings.prediction_distance, &self.pace);
    }

    #[inline(always)]
    fn fall(&mut self) {
        for body in &mut self.bodies {
            body.velocity_y += body.fall;
        }
    }

    #[inline(always)]
    fn prepare_joints(&mut self) {
        for joint in &mut self.joints {
            joint.prepare(&self.bodies, &self.pace);
        }
    }

    #[inline(always)]
    fn prepare_contacts(&mut self) {
        self.contacts.prepare(&mut self.bodies, &self.pace);
    }

    #[inline(always)]
    fn solve_joints(&mut self) {
        for joint in &mut self.joints {
            joint.solve::<false>(&mut self.bodies);
        }
    }

    #[inline(always)]
    fn solve_contacts(&mut self) {
        self.contacts.solve(&mut self.bodies);
    }

    #[inline(always)]
    fn advance(&mut self) {
        for body in &mut self.bodies {
            body.advance(self.pace.substep, self.pace.top_spin);
        }
    }

    #[inline(always)]
    fn relax_joints(&mut self) {
        for joint in &mut self.joints {
            joint.solve::<true>(&mut self.bodies);
        }
    }

    #[inline(always)]
    fn relax_contacts(&mut self) {
        self.contacts.relax(&mut self.bodies, &self.pace);
    }

    // Not inlined: lanes seldom differ in their substeps.

    /// Keeps what these lanes, whose step is over, are like.
    #[inline(never)]
    fn keep(&mut self, done: Mask<W>) {
        if !done.any() {
            return;
        }
        for (kept, body) in self.kept.bodies.iter_mut().zip(&self.bodies) {
            kept.copy_motion(done, body);
        }
        for (kept, joint) in self.kept.motor_impulses.iter_mut().zip(&self.joints) {
            *kept = done.select(joint.motor_impulse(), *kept);
        }
        self.contacts.keep(done);
    }

    /// Makes these lanes what they were when their step was over.
    #[inline(never)]
    fn put_back(&mut self, lanes: Mask<W>) {
        for (body, kept) in self.bodies.iter_mut().zip(&self.kept.bodies) {
            body.copy_motion(lanes, kept);
        }
        for (joint, &kept) in self.joints.iter_mut().zip(&self.kept.motor_impulses) {
            joint.set_motor_impulse(lanes, kept);
        }
        self.contacts.put_back(lanes);
    }
}

fn lap(stopwatch: &mut Option<&mut Laps>, part: Part) {
    if let Some(stopwatch) = stopwatch {
        stopwatch.lap(part);
    }
}
