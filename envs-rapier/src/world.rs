use creatures::{Blueprint, BodyPart, Hinge, Shape};
use envs_core::{Conditions, Engine, EnvironmentError, Ground, GroundShape, Hull, PhysicsSettings, last_substep_share};
use ne_core::SettingError;
use rapier2d::prelude::*;
use tasks::PartState;

/// rapier's own index of a collider, small and dense in a world where nothing is ever removed.
type ColliderIndex = usize;

/// The bit by which rapier marks a contact that has just begun, in what is else the index of a point.
const NEW_CONTACT: u32 = 1 << 31;

/// A rapier world with ground and one creature in it.
pub struct RapierWorld {
    /// rapier's sets and settings: 6 kB, in a box, so that what holds a world can be moved about.
    physics: Box<PhysicsWorld>,
    /// The body of each part.
    bodies: Vec<RigidBodyHandle>,
    /// The joint of each hinge.
    joints: Vec<ImpulseJointHandle>,
    /// The collider of each shape of the ground.
    ground: Vec<ColliderHandle>,
    /// The part a collider belongs to, by rapier's index of the collider.
    part_of: Vec<Option<usize>>,
    /// The motor of each hinge.
    motors: Vec<Motor>,
    /// Of the motors, N·m per rad/s.
    motor_gain: f32,
    /// How water feels each part; none out of the water.
    hulls: Vec<Hull>,
}

impl Clone for RapierWorld {
    /// A copy that goes on as the original would. rapier's workspaces, which hold nothing between steps, start empty.
    fn clone(&self) -> Self {
        let from = &self.physics;
        let physics = Box::new(PhysicsWorld {
            gravity: from.gravity,
            integration_parameters: from.integration_parameters,
            islands: from.islands.clone(),
            broad_phase: from.broad_phase.clone(),
            narrow_phase: from.narrow_phase.clone(),
            bodies: from.bodies.clone(),
            colliders: from.colliders.clone(),
            impulse_joints: from.impulse_joints.clone(),
            ..PhysicsWorld::new()
        });
        Self {
            physics,
            bodies: self.bodies.clone(),
            joints: self.joints.clone(),
            ground: self.ground.clone(),
            part_of: self.part_of.clone(),
            motors: self.motors.clone(),
            motor_gain: self.motor_gain,
            hulls: self.hulls.clone(),
        }
    }
}

/// What is asked of the motor of a hinge, and how it moved before the last step.
#[derive(Clone, Copy, Debug)]
struct Motor {
    parent: RigidBodyHandle,
    child: RigidBodyHandle,
    /// N·m; 0 of a hinge without one.
    top_torque: f32,
    /// rad/s.
    wanted: f32,
    /// rad/s.
    before: f32,
}

impl Motor {
    /// How fast the hinge turns now, rad/s.
    fn speed(&self, physics: &PhysicsWorld) -> f32 {
        let spin = |body: RigidBodyHandle| physics.bodies[body].angvel();
        spin(self.child) - spin(self.parent)
    }
}

const GROUND: Group = Group::GROUP_1;
const CREATURE: Group = Group::GROUP_2;

impl RapierWorld {
    /// Another gravity from now on, m/s².
    pub fn set_gravity(&mut self, [x, y]: [f32; 2]) {
        self.physics.gravity = Vector::new(x, y);
    }

    /// Another piece of ground, with this friction.
    ///
    /// # Errors
    /// If the shape is not valid.
    pub fn add_obstacle(&mut self, shape: &GroundShape, friction: f32) -> Result<(), SettingError> {
        Ground { shapes: vec![*shape] }.validate()?;
        SettingError::check_range("friction", friction, 0.0, 10.0)?;
        self.add_ground(shape, friction);
        Ok(())
    }

    fn add_ground(&mut self, shape: &GroundShape, friction: f32) {
        let collider = match *shape {
            GroundShape::HalfSpace => ColliderBuilder::new(SharedShape::halfspace(Vector::Y)),
            GroundShape::Floor { y } => {
                ColliderBuilder::new(SharedShape::halfspace(Vector::Y)).translation(Vector::new(0.0, y))
            }
            GroundShape::Box { x, y, width, height } => {
                ColliderBuilder::cuboid(width * 0.5, height * 0.5).translation(Vector::new(x, y))
            }
            GroundShape::Slab { x, y, width, height, angle } => {
                let (sin, cos) = libm::sincosf(angle);
                let rotation = Rotation::from_cos_sin_unchecked(cos, sin);
                ColliderBuilder::cuboid(width * 0.5, height * 0.5)
                    .position(Pose { rotation, translation: Vector::new(x, y) })
            }
            GroundShape::Circle { x, y, radius } => ColliderBuilder::ball(radius).translation(Vector::new(x, y)),
        };
        let collider = collider
            .friction(friction)
            .friction_combine_rule(CoefficientCombineRule::Multiply)
            .collision_groups(groups(GROUND, CREATURE));
        // On a body of its own: where a part meets several shapes in one step, rapier goes by the order of the bodies, and
        // without them by an order that comes of where everything has been.
        let (_, collider) = self.physics.insert(RigidBodyBuilder::fixed(), collider);
        self.ground.push(collider);
    }

    fn add_part(&mut self, part: &BodyPart, self_collision: bool, mass_factor: f32, hull: Option<Hull>) {
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(part.x, part.y))
            .rotation(part.angle)
            .gravity_scale(hull.map_or(1.0, |hull| hull.weight_left()))
            // A sleeping body ignores its motors.
            .can_sleep(false);
        let meets = if self_collision { GROUND | CREATURE } else { GROUND };
        let collider = ColliderBuilder::new(shape(part.shape))
            .density(part.density * mass_factor)
            .friction(part.friction)
            .friction_combine_rule(CoefficientCombineRule::Multiply)
            .collision_groups(groups(CREATURE, meets));
        let part_index = self.bodies.len();
        let (body, collider) = self.physics.insert(body, collider);
        self.bodies.push(body);
        self.hulls.extend(hull);
        self.part_of.resize(index_of(collider) + 1, None);
        self.part_of[index_of(collider)] = Some(part_index);
    }

    fn add_hinge(&mut self, blueprint: &Blueprint, hinge: &Hinge, settings: &PhysicsSettings, torque_factor: f32) {
        let (parent, child) = (&blueprint.parts()[hinge.parent], &blueprint.parts()[hinge.child]);
        // The child's frame is turned so that the joint's angle is zero in the middle of its range. rapier would take the
        // sine of another middle from the standard library, whose bits depend on the platform.
        let [low, high] = hinge.limits;
        let (middle, half_range) = ((low + high) * 0.5, (high - low) * 0.5);
        let at = |[x, y]: [f32; 2], angle| Pose::new(Vector::new(x, y), angle);
        let mut joint = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
            .local_frame1(at(hinge.parent_anchor, 0.0))
            .local_frame2(at(hinge.child_anchor, parent.angle - child.angle - middle))
            .contacts_enabled(false)
            .limits(JointAxis::AngX, [-half_range, half_range])
            .softness(SpringCoefficients::new(settings.joint_frequency, settings.joint_damping_ratio));
        if let Some(motor) = hinge.motor {
            joint = joint
                .motor_model(JointAxis::AngX, MotorModel::ForceBased)
                .motor_velocity(JointAxis::AngX, 0.0, settings.motor_gain)
                .motor_max_force(JointAxis::AngX, motor.top_torque * torque_factor);
        }
        let (parent, child) = (self.bodies[hinge.parent], self.bodies[hinge.child]);
        let top_torque = hinge.motor.map_or(0.0, |motor| motor.top_torque * torque_factor);
        self.motors.push(Motor { parent, child, top_torque, wanted: 0.0, before: 0.0 });
        self.joints.push(self.physics.insert_impulse_joint(parent, child, joint));
    }

    /// What water takes of the parts' velocities in a step. Before the step, so that the joints have the last word.
    fn drag(&mut self) {
        let seconds = self.physics.integration_parameters.dt;
        for (hull, &body) in self.hulls.iter().zip(&self.bodies) {
            let body = &mut self.physics.bodies[body];
            let (velocity, rotation) = (body.linvel(), body.rotation());
            let now = ([velocity.x, velocity.y], body.angvel());
            let ([x, y], spin) = hull.slowed(now, [rotation.re, rotation.im], seconds);
            body.set_linvel(Vector::new(x, y), false);
            body.set_angvel(spin, false);
        }
    }

    /// The parts that press on a shape of the ground.
    fn touching(&self, ground: ColliderHandle) -> impl Iterator<Item = usize> + '_ {
        self.physics.narrow_phase.contact_pairs_with(ground).filter_map(move |pair| {
            let other = if pair.collider1 == ground { pair.collider2 } else { pair.collider1 };
            self.part_of.get(index_of(other)).copied().flatten().filter(|_| pair.solver_manifolds().iter().any(presses))
        })
    }
}

/// Whether a point of contact was solved in the last step and pressed. One that was left out, as it is too far away by now, still has
/// the impulse of an earlier step.
fn presses(manifold: &ContactManifold) -> bool {
    let mut solved = manifold.data.solver_contacts.iter().flat_map(|contact| contact.contact_id);
    let point = |id| manifold.points.get((id & !NEW_CONTACT) as usize);
    solved.any(|id| point(id).is_some_and(|point| point.data.impulse > 0.0))
}

impl Engine for RapierWorld {
    fn new(
        blueprint: &Blueprint,
        settings: &PhysicsSettings,
        ground: &Ground,
        conditions: &Conditions,
    ) -> Result<Self, EnvironmentError> {
        let mut physics = Box::new(PhysicsWorld::new());
        physics.gravity = Vector::new(0.0, -settings.gravity);
        physics.integration_parameters = integration_parameters(settings);
        let mut world = Self {
            physics,
            bodies: Vec::new(),
            joints: Vec::new(),
            ground: Vec::new(),
            part_of: Vec::new(),
            motors: Vec::new(),
            motor_gain: settings.motor_gain,
            hulls: Vec::new(),
        };
        for shape in &ground.shapes {
            world.add_ground(shape, settings.ground_friction * conditions.friction);
        }
        let water = settings.water.map(|water| (water, water.density_around(blueprint, conditions.mass)));
        for part in blueprint.parts() {
            let hull = water.map(|(water, density)| Hull::new(part, &water, density, conditions.mass));
            world.add_part(part, blueprint.self_collision(), conditions.mass, hull);
        }
        for hinge in blueprint.hinges() {
            world.add_hinge(blueprint, hinge, settings, conditions.torque);
        }
        Ok(world)
    }

    /// Fetching a joint mutably makes rapier assemble it anew, so ask only when the speed changes.
    fn set_motor_speed(&mut self, hinge: usize, speed: f32) {
        self.motors[hinge].wanted = speed;
        if let Some(joint) = self.physics.impulse_joints.get_mut(self.joints[hinge], false) {
            joint.data.set_motor_velocity(JointAxis::AngX, speed, self.motor_gain);
        }
    }

    fn nudge(&mut self, part: usize, [x, y]: [f32; 2], spin: f32) {
        let body = &mut self.physics.bodies[self.bodies[part]];
        let (velocity, turning) = (body.linvel() + Vector::new(x, y), body.angvel() + spin);
        body.set_linvel(velocity, false);
        body.set_angvel(turning, false);
    }

    /// `false` if rapier met a body that is not finite and disabled it.
    fn step(&mut self) -> bool {
        self.drag();
        for motor in &mut self.motors {
            motor.before = motor.speed(&self.physics);
        }
        self.physics.step();
        self.physics.quarantine().is_empty()
    }

    fn look(&self, parts: &mut [PartState]) {
        for (part, &body) in parts.iter_mut().zip(&self.bodies) {
            let body = &self.physics.bodies[body];
            let (position, rotation, velocity) = (body.translation(), body.rotation(), body.linvel());
            *part = PartState {
                x: position.x,
                y: position.y,
                cos: rotation.re,
                sin: rotation.im,
                vx: velocity.x,
                vy: velocity.y,
                spin: body.angvel(),
                touching: false,
            };
        }
        for part in self.ground.iter().flat_map(|&ground| self.touching(ground)) {
            parts[part].touching = true;
        }
    }

    fn motor_torque(&self, hinge: usize) -> f32 {
        let parameters = &self.physics.integration_parameters;
        let substep = parameters.dt / parameters.num_solver_iterations as f32;
        self.physics
            .impulse_joints
            .get(self.joints[hinge])
            .map_or(0.0, |joint| joint.data.motors[JointAxis::AngX as usize].impulse / substep)
    }

    fn motor_power(&self, hinge: usize) -> f32 {
        let (last, motor) = (self.motor_torque(hinge), &self.motors[hinge]);
        let after = motor.speed(&self.physics);
        let speed = 0.5 * (motor.before + after);
        let rest = ((speed - motor.wanted) * self.motor_gain).clamp(-motor.top_torque, motor.top_torque);
        let share = last_substep_share(self.physics.integration_parameters.num_solver_iterations as u32);
        let mean = last * share + rest * (1.0 - share);
        (last * after).abs() + (mean.abs() - last.abs()).max(0.0) * speed.abs()
    }

    /// Asks the shapes themselves: rapier's own search knows of none before the first step.
    fn distance_to_ground(&self, [x, y]: [f32; 2], angle: f32, length: f32) -> f32 {
        let ray = Ray::new(Vector::new(x, y), Vector::new(libm::cosf(angle), libm::sinf(angle)));
        let distance = |&ground: &ColliderHandle| {
            let ground = &self.physics.colliders[ground];
            ground.shape().cast_ray(ground.position(), &ray, length, true)
        };
        self.ground.iter().filter_map(distance).fold(length, f32::min)
    }
}

/// How much softer rapier's contacts between two moving bodies are than those with fixed ground, in frequency.
const MOVING_CONTACTS: f32 = 0.5;

fn integration_parameters(settings: &PhysicsSettings) -> IntegrationParameters {
    let contacts = |frequency| SpringCoefficients::new(frequency, settings.contact_damping_ratio);
    IntegrationParameters {
        dt: settings.time_step,
        num_solver_iterations: settings.solver_iterations as usize,
        num_internal_pgs_iterations: settings.internal_iterations as usize,
        max_ccd_substeps: settings.continuous_collision_substeps as usize,
        normalized_prediction_distance: settings.prediction_distance,
        normalized_max_corrective_velocity: settings.corrective_speed,
        contact_softness: contacts(settings.contact_frequency * MOVING_CONTACTS),
        static_contact_softness: contacts(settings.contact_frequency),
        // A recycled contact keeps its lever arms over several steps, though the foot has moved. On a half-space rapier
        // recycles none, because its extent is infinite; so boxes are ground like any other.
        contact_recycling: false,
        ..IntegrationParameters::default()
    }
}

fn groups(member_of: Group, meets: Group) -> InteractionGroups {
    InteractionGroups::new(member_of, meets, InteractionTestMode::And)
}

fn shape(shape: Shape) -> SharedShape {
    match shape {
        Shape::Box { width, height } => SharedShape::cuboid(width * 0.5, height * 0.5),
        Shape::Circle { radius } => SharedShape::ball(radius),
        Shape::Capsule { length, radius } => SharedShape::capsule_y(length * 0.5, radius),
    }
}

fn index_of(collider: ColliderHandle) -> ColliderIndex {
    collider.into_raw_parts().0 as usize
}
