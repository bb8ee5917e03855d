use crate::{PhysicsSettings, variation::Factors};
use creatures::{Blueprint, BodyPart, Hinge, Shape};
use rapier2d::prelude::*;

/// rapier's own index of a collider, small and dense in a world where nothing is ever removed.
type ColliderIndex = usize;

/// A rapier world with flat ground and one creature in it.
pub(crate) struct World {
    /// rapier's sets and settings.
    pub(crate) physics: PhysicsWorld,
    /// The body of each part.
    pub(crate) bodies: Vec<RigidBodyHandle>,
    /// The joint of each hinge.
    pub(crate) joints: Vec<ImpulseJointHandle>,
    ground: ColliderHandle,
    /// The part a collider belongs to, by rapier's index of the collider.
    part_of: Vec<Option<usize>>,
}

impl Clone for World {
    /// A copy that goes on as the original would. rapier's workspaces, which hold nothing between steps, start empty.
    fn clone(&self) -> Self {
        let from = &self.physics;
        let physics = PhysicsWorld {
            gravity: from.gravity,
            integration_parameters: from.integration_parameters,
            islands: from.islands.clone(),
            broad_phase: from.broad_phase.clone(),
            narrow_phase: from.narrow_phase.clone(),
            bodies: from.bodies.clone(),
            colliders: from.colliders.clone(),
            impulse_joints: from.impulse_joints.clone(),
            ..PhysicsWorld::new()
        };
        Self {
            physics,
            bodies: self.bodies.clone(),
            joints: self.joints.clone(),
            ground: self.ground,
            part_of: self.part_of.clone(),
        }
    }
}

const GROUND: Group = Group::GROUP_1;
const CREATURE: Group = Group::GROUP_2;

impl World {
    /// Builds ground and creature in its start pose, not yet settled.
    pub(crate) fn new(blueprint: &Blueprint, settings: &PhysicsSettings, factors: Factors) -> Self {
        let mut physics = PhysicsWorld::new();
        physics.gravity = Vector::new(0.0, -settings.gravity);
        physics.integration_parameters = integration_parameters(settings);
        let ground = ColliderBuilder::new(SharedShape::halfspace(Vector::Y))
            .friction(settings.ground_friction * factors.friction)
            .friction_combine_rule(CoefficientCombineRule::Multiply)
            .collision_groups(groups(GROUND, CREATURE));
        let ground = physics.insert_collider(ground, None);
        let mut world =
            Self { physics, bodies: Vec::new(), joints: Vec::new(), ground, part_of: vec![None; index_of(ground) + 1] };
        for part in blueprint.parts() {
            world.add_part(part, blueprint.self_collision(), factors.mass);
        }
        for hinge in blueprint.hinges() {
            world.add_hinge(blueprint, hinge, settings, factors.torque);
        }
        world
    }

    fn add_part(&mut self, part: &BodyPart, self_collision: bool, mass_factor: f32) {
        let body = RigidBodyBuilder::dynamic()
            .translation(Vector::new(part.x, part.y))
            .rotation(part.angle)
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
        self.part_of.resize(index_of(collider) + 1, None);
        self.part_of[index_of(collider)] = Some(part_index);
    }

    fn add_hinge(&mut self, blueprint: &Blueprint, hinge: &Hinge, settings: &PhysicsSettings, torque_factor: f32) {
        let (parent, child) = (&blueprint.parts()[hinge.parent], &blueprint.parts()[hinge.child]);
        // The child's frame is turned so that the joint's angle is zero in the start pose.
        let at = |[x, y]: [f32; 2], angle| Pose::new(Vector::new(x, y), angle);
        let mut joint = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
            .local_frame1(at(hinge.parent_anchor, 0.0))
            .local_frame2(at(hinge.child_anchor, parent.angle - child.angle))
            .contacts_enabled(false)
            .limits(JointAxis::AngX, hinge.limits)
            .softness(SpringCoefficients::new(settings.joint_frequency, settings.joint_damping_ratio));
        if let Some(motor) = hinge.motor.filter(|_| hinge.actuated) {
            joint = joint
                .motor_model(JointAxis::AngX, MotorModel::ForceBased)
                .motor_velocity(JointAxis::AngX, 0.0, settings.motor_gain)
                .motor_max_force(JointAxis::AngX, motor.top_torque * torque_factor);
        }
        let (parent, child) = (self.bodies[hinge.parent], self.bodies[hinge.child]);
        self.joints.push(self.physics.insert_impulse_joint(parent, child, joint));
    }

    /// Advances by one time step. `false` if rapier met a body that is not finite and disabled it.
    pub(crate) fn step(&mut self) -> bool {
        self.physics.step();
        self.physics.quarantine().is_empty()
    }

    /// Asks a motor for a speed, rad/s. Fetching a joint mutably makes rapier assemble it anew, so ask only when the
    /// speed changes.
    pub(crate) fn set_motor_speed(&mut self, hinge: usize, speed: f32, gain: f32) {
        if let Some(joint) = self.physics.impulse_joints.get_mut(self.joints[hinge], false) {
            joint.data.set_motor_velocity(JointAxis::AngX, speed, gain);
        }
    }

    /// The torque the motor of a hinge gave at the end of the last step, N·m.
    pub(crate) fn motor_torque(&self, hinge: usize) -> f32 {
        let parameters = &self.physics.integration_parameters;
        let substep = parameters.dt / parameters.num_solver_iterations as f32;
        self.physics
            .impulse_joints
            .get(self.joints[hinge])
            .map_or(0.0, |joint| joint.data.motors[JointAxis::AngX as usize].impulse / substep)
    }

    /// Calls `touch` with each part that presses on the ground.
    pub(crate) fn touching(&self, mut touch: impl FnMut(usize)) {
        for pair in self.physics.narrow_phase.contact_pairs_with(self.ground) {
            let other = if pair.collider1 == self.ground { pair.collider2 } else { pair.collider1 };
            let presses =
                || pair.solver_manifolds().iter().any(|m| m.points.iter().any(|point| point.data.impulse > 0.0));
            if let Some(&Some(part)) = self.part_of.get(index_of(other))
                && presses()
            {
                touch(part);
            }
        }
    }

    /// The distance from a point to the ground along a ray, m; `length` if it is further.
    pub(crate) fn distance_to_ground(&self, from: Vector, angle: f32, length: f32) -> f32 {
        let direction = Vector::new(libm::cosf(angle), libm::sinf(angle));
        self.physics
            .cast_ray(&Ray::new(from, direction), length, true, QueryFilter::only_fixed())
            .map_or(length, |(_, distance)| distance)
    }
}

fn integration_parameters(settings: &PhysicsSettings) -> IntegrationParameters {
    IntegrationParameters {
        dt: settings.time_step,
        num_solver_iterations: settings.solver_iterations as usize,
        num_internal_pgs_iterations: settings.internal_iterations as usize,
        max_ccd_substeps: settings.continuous_collision_substeps as usize,
        normalized_prediction_distance: settings.prediction_distance,
        normalized_max_corrective_velocity: settings.corrective_speed,
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
