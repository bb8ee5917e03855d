use super::{
    body::Body,
    joint::Joint,
    level::LevelContact,
    mass::InverseMass,
    softness::Softness,
    uneven::{self, UnevenContact},
};
use crate::{
    engine::ENGINE,
    lanes::{Lanes, Mask},
    profile::{Laps, Part},
};
use creatures::Blueprint;
use envs_core::{Conditions, EnvironmentError, Ground, GroundShape, PhysicsSettings};
use std::f32::consts::FRAC_PI_4;
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
    /// For each hinge of the blueprint, its place among the joints.
    joint_of: Vec<usize>,
}

/// The contacts of each part with the ground.
#[derive(Clone, Debug)]
enum Contacts<const W: usize> {
    /// A single half-space.
    Level(Vec<LevelContact<W>>),
    /// Anything else.
    Uneven(Vec<UnevenContact<W>>),
}

/// What all lanes share.
#[derive(Debug)]
struct Plan {
    blueprint: Blueprint,
    settings: PhysicsSettings,
    ground: Ground,
    /// The hinges in the order their joints are solved in.
    order: Vec<usize>,
}

/// The numbers a step needs that follow from a lane's time step.
#[derive(Clone, Debug)]
pub(super) struct Pace<const W: usize> {
    /// s.
    pub(super) time_step: Lanes<W>,
    pub(super) substep: Lanes<W>,
    pub(super) substeps_per_second: Lanes<W>,
    pub(super) joint_correction: Lanes<W>,
    pub(super) joint_compliance: Lanes<W>,
    pub(super) contact_correction: Lanes<W>,
    pub(super) contact_factor: Lanes<W>,
    /// The fastest an error is corrected, m/s and rad/s.
    pub(super) top_correction: Lanes<W>,
    /// The fastest a body may turn, rad/s: an eighth of a turn in a time step.
    pub(super) top_spin: Lanes<W>,
}

impl<const W: usize> LaneWorld<W> {
    /// Worlds with nobody in them yet: see [`reset`](Self::reset) and [`copy_lane`](Self::copy_lane).
    ///
    /// # Errors
    /// If lanes cannot do what is asked for.
    pub(crate) fn new(
        blueprint: &Blueprint,
        settings: &PhysicsSettings,
        ground: &Ground,
    ) -> Result<Self, EnvironmentError> {
        refuse_what_lanes_cannot_do(blueprint, settings)?;
        Ok(Self::empty(Arc::new(Plan {
            blueprint: blueprint.clone(),
            settings: *settings,
            ground: ground.clone(),
            order: solving_order(blueprint)?,
        })))
    }

    /// Worlds of the same kind with another number of lanes, with nobody in them yet.
    pub(crate) fn widened<const V: usize>(&self) -> LaneWorld<V> {
        LaneWorld::empty(self.plan.clone())
    }

    fn empty(plan: Arc<Plan>) -> Self {
        let Plan { blueprint, settings, ground, order } = &*plan;
        let mut joint_of = vec![0; order.len()];
        for (place, &hinge) in order.iter().enumerate() {
            joint_of[hinge] = place;
        }
        let zero = Lanes::ZERO;
        let pace = Pace {
            time_step: zero,
            substep: zero,
            substeps_per_second: zero,
            joint_correction: zero,
            joint_compliance: zero,
            contact_correction: zero,
            contact_factor: zero,
            top_correction: Lanes::splat(settings.corrective_speed),
            top_spin: zero,
        };
        Self {
            bodies: vec![Body::at_rest(); blueprint.parts().len()],
            joints: order.iter().map(|&hinge| Joint::new(blueprint, &blueprint.hinges()[hinge])).collect(),
            contacts: Contacts::new(blueprint, ground),
            pace,
            joint_of,
            plan,
        }
    }

    /// Puts a creature in its start pose into a lane.
    pub(crate) fn reset(&mut self, lane: usize, time_step: f32, conditions: &Conditions) {
        let Plan { blueprint, settings, .. } = &*self.plan;
        let substep = time_step / settings.solver_iterations as f32;
        let joint = Softness::new(settings.joint_frequency, settings.joint_damping_ratio, substep);
        let contact = Softness::of_ground_contacts(substep);
        self.pace.time_step.0[lane] = time_step;
        self.pace.substep.0[lane] = substep;
        self.pace.substeps_per_second.0[lane] = 1.0 / substep;
        self.pace.joint_correction.0[lane] = joint.correction_rate;
        self.pace.joint_compliance.0[lane] = joint.compliance;
        self.pace.contact_correction.0[lane] = contact.correction_rate;
        self.pace.contact_factor.0[lane] = contact.impulse_factor;
        self.pace.top_spin.0[lane] = FRAC_PI_4 * (1.0 / time_step);
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

    /// The torque the motor of a hinge gave at the end of the last step, N·m.
    #[inline(always)]
    pub(crate) fn motor_torques(&self, hinge: usize) -> Lanes<W> {
        self.joints[self.joint_of[hinge]].motor_impulse() / self.pace.substep
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
        if matches!(self.contacts, Contacts::Uneven(_)) {
            let ground = &self.plan.ground;
            let from = |lane: usize| [x.0[lane], y.0[lane]];
            return Lanes(std::array::from_fn(|lane| uneven::distance_along_ray(ground, from(lane), angle, length)));
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
    #[inline(always)]
    pub(crate) fn step(&mut self, mut stopwatch: Option<&mut Laps>) {
        let Self { plan, bodies, joints, contacts, pace, .. } = self;
        contacts.find(bodies, plan.settings.prediction_distance, pace);
        lap(&mut stopwatch, Part::FindContacts);
        for _ in 0..plan.settings.solver_iterations {
            for body in bodies.iter_mut() {
                body.velocity_y += body.fall;
            }
            lap(&mut stopwatch, Part::Fall);
            for joint in joints.iter_mut() {
                joint.prepare(bodies, pace);
            }
            lap(&mut stopwatch, Part::PrepareJoints);
            contacts.prepare(bodies, pace);
            lap(&mut stopwatch, Part::PrepareContacts);
            for _ in 0..plan.settings.internal_iterations {
                for joint in joints.iter_mut() {
                    joint.solve::<false>(bodies);
                }
                lap(&mut stopwatch, Part::SolveJoints);
                contacts.solve(bodies);
                lap(&mut stopwatch, Part::SolveContacts);
            }
            for body in bodies.iter_mut() {
                body.advance(pace.substep, pace.top_spin);
            }
            lap(&mut stopwatch, Part::Move);
            for joint in joints.iter_mut() {
                joint.solve::<true>(bodies);
            }
            lap(&mut stopwatch, Part::RelaxJoints);
            contacts.relax(bodies, pace);
            lap(&mut stopwatch, Part::RelaxContacts);
        }
    }
}

#[inline(always)]
fn lap(stopwatch: &mut Option<&mut Laps>, part: Part) {
    if let Some(stopwatch) = stopwatch {
        stopwatch.lap(part);
    }
}

impl<const W: usize> Contacts<W> {
    fn new(blueprint: &Blueprint, ground: &Ground) -> Self {
        let shapes = blueprint.parts().iter().map(|part| part.shape);
        if ground.shapes == [GroundShape::HalfSpace] {
            Self::Level(shapes.map(LevelContact::new).collect())
        } else {
            Self::Uneven(shapes.map(|shape| UnevenContact::new(shape, ground)).collect())
        }
    }

    fn reset(&mut self, part: usize, lane: usize, friction: f32) {
        match self {
            Self::Level(contacts) => contacts[part].rows.reset(lane, friction),
            Self::Uneven(contacts) => contacts[part].reset(lane, friction),
        }
    }

    fn copy_lane(&mut self, lane: usize, from: &Contacts<1>) {
        match (self, from) {
            (Self::Level(mine), Contacts::Level(theirs)) => {
                mine.iter_mut().zip(theirs).for_each(|(mine, theirs)| mine.copy_lane(lane, theirs));
            }
            (Self::Uneven(mine), Contacts::Uneven(theirs)) => {
                mine.iter_mut().zip(theirs).for_each(|(mine, theirs)| mine.copy_lane(lane, theirs));
            }
            // Worlds of one kind have one ground.
            (Self::Level(_), Contacts::Uneven(_)) | (Self::Uneven(_), Contacts::Level(_)) => {}
        }
    }

    #[inline(always)]
    fn pressing(&self, part: usize) -> Mask<W> {
        match self {
            Self::Level(contacts) => contacts[part].rows.pressing,
            Self::Uneven(contacts) => contacts[part].pressing(),
        }
    }

    #[inline(always)]
    fn find(&mut self, bodies: &[Body<W>], reach: f32, pace: &Pace<W>) {
        match self {
            Self::Level(contacts) => {
                for (body, contact) in bodies.iter().zip(contacts) {
                    contact.find(body, reach);
                }
            }
            Self::Uneven(contacts) => {
                for (body, contact) in bodies.iter().zip(contacts) {
                    contact.find(body, reach, &pace.time_step);
                }
            }
        }
    }

    #[inline(always)]
    fn prepare(&mut self, bodies: &mut [Body<W>], pace: &Pace<W>) {
        match self {
            Self::Level(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.rows.prepare(body, pace);
                }
            }
            Self::Uneven(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.prepare(body, pace);
                }
            }
        }
    }

    #[inline(always)]
    fn solve(&mut self, bodies: &mut [Body<W>]) {
        match self {
            Self::Level(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.rows.solve(body);
                }
            }
            Self::Uneven(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.solve(body);
                }
            }
        }
    }

    #[inline(always)]
    fn relax(&mut self, bodies: &mut [Body<W>], pace: &Pace<W>) {
        match self {
            Self::Level(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.rows.relax(body, pace);
                }
            }
            Self::Uneven(contacts) => {
                for (body, contact) in bodies.iter_mut().zip(contacts) {
                    contact.relax(body, pace);
                }
            }
        }
    }
}

impl<const W: usize> Pace<W> {
    fn copy_lane(&mut self, lane: usize, from: &Pace<1>) {
        self.time_step.0[lane] = from.time_step.0[0];
        self.substep.0[lane] = from.substep.0[0];
        self.substeps_per_second.0[lane] = from.substeps_per_second.0[0];
        self.joint_correction.0[lane] = from.joint_correction.0[0];
        self.joint_compliance.0[lane] = from.joint_compliance.0[0];
        self.contact_correction.0[lane] = from.contact_correction.0[0];
        self.contact_factor.0[lane] = from.contact_factor.0[0];
        self.top_spin.0[lane] = from.top_spin.0[0];
    }
}

fn refuse(what: impl Into<String>) -> EnvironmentError {
    EnvironmentError::Unsupported { engine: ENGINE, what: what.into() }
}

fn refuse_what_lanes_cannot_do(blueprint: &Blueprint, settings: &PhysicsSettings) -> Result<(), EnvironmentError> {
    if blueprint.self_collision() {
        return Err(refuse("its parts collide with each other (self_collision)"));
    }
    if settings.continuous_collision_substeps > 0 {
        return Err(refuse("it is to have continuous collision detection (physics.continuous_collision_substeps)"));
    }
    Ok(())
}

/// The hinges in the order rapier solves their joints in: it colours them greedily so that joints of a colour share no
/// part, and goes from colour to colour; large colours, which it solves several joints at a time, come first.
fn solving_order(blueprint: &Blueprint) -> Result<Vec<usize>, EnvironmentError> {
    let mut colours_at = vec![0_u128; blueprint.parts().len()];
    let mut colours = Vec::with_capacity(blueprint.hinges().len());
    for hinge in blueprint.hinges() {
        let taken = colours_at[hinge.parent] | colours_at[hinge.child];
        let colour = (!taken).trailing_zeros();
        if colour >= MOST_COLOURS {
            let part = &blueprint.parts()[hinge.parent].name;
            return Err(refuse(format!("more than {MOST_COLOURS} parts hang together at \"{part}\"")));
        }
        colours_at[hinge.parent] |= 1 << colour;
        colours_at[hinge.child] |= 1 << colour;
        colours.push(colour);
    }
    let size = |colour: u32| colours.iter().filter(|&&other| other == colour).count();
    let mut order: Vec<usize> = (0..colours.len()).collect();
    order.sort_by_key(|&hinge| (size(colours[hinge]) < LARGE_COLOUR, colours[hinge]));
    Ok(order)
}

/// With more, rapier solves in another order.
const MOST_COLOURS: u32 = 100;

/// Joints from which on rapier solves a colour several at a time.
const LARGE_COLOUR: usize = 64;
