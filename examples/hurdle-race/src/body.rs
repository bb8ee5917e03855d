//! A character in rapier: what a game has to do to have one.

use player::{Character, Command, FileError, Part, PartState, Player, Shape};
use rapier2d::prelude::*;
use std::sync::Arc;

/// All that is not a character.
pub(crate) const GROUND: Group = Group::GROUP_1;

/// A character in the physics of the game, and the player that moves it.
pub struct Body {
    player: Player,
    bodies: Vec<RigidBodyHandle>,
    colliders: Vec<ColliderHandle>,
    joints: Vec<ImpulseJointHandle>,
    /// As the player wants to know them.
    parts: Vec<PartState>,
}

impl Body {
    /// Builds it so that its torso is above `x`, m. `lane`: characters of other lanes do not touch it; 0 to 29.
    ///
    /// # Errors
    /// If the character is not valid. One from a file is.
    pub fn new(physics: &mut PhysicsWorld, character: Arc<Character>, x: f32, lane: u32) -> Result<Self, FileError> {
        let player = Player::new(character)?;
        let character = player.character();
        let shift = x - character.parts[0].x;
        let own = Group::from_bits_truncate(2 << lane);
        let meets = if character.world.self_collision { GROUND | own } else { GROUND };
        let (mut bodies, mut colliders) = (Vec::new(), Vec::new());
        for part in &character.parts {
            let shape = match part.shape {
                Shape::Box { width, height } => ColliderBuilder::cuboid(width / 2.0, height / 2.0),
                Shape::Circle { radius } => ColliderBuilder::ball(radius),
                Shape::Capsule { length, radius } => ColliderBuilder::capsule_y(length / 2.0, radius),
            };
            let shape = shape
                .density(part.density)
                .friction(part.friction * character.world.ground_friction)
                .friction_combine_rule(CoefficientCombineRule::Multiply)
                .collision_groups(InteractionGroups::new(own, meets, InteractionTestMode::And));
            // A body that sleeps does not hear its motors.
            let at = Vector::new(part.x + shift, part.y);
            let body = RigidBodyBuilder::dynamic().translation(at).rotation(part.angle).can_sleep(false);
            let (body, collider) = physics.insert(body, shape);
            bodies.push(body);
            colliders.push(collider);
        }
        let mut joints = Vec::new();
        for hinge in &character.hinges {
            let [parent, child] = [hinge.parent, hinge.child].map(usize::from);
            let turned = character.parts[parent].angle - character.parts[child].angle;
            let at = |[x, y]: [f32; 2], angle| Pose::new(Vector::new(x, y), angle);
            let mut joint = GenericJointBuilder::new(JointAxesMask::LOCKED_REVOLUTE_AXES)
                .local_frame1(at(hinge.parent_anchor, 0.0))
                .local_frame2(at(hinge.child_anchor, turned))
                .contacts_enabled(false)
                .limits(JointAxis::AngX, hinge.limits)
                .softness(SpringCoefficients::new(60.0, 1.0));
            if let Some(motor) = hinge.motor {
                joint = joint
                    .motor_model(JointAxis::AngX, MotorModel::ForceBased)
                    .motor_velocity(JointAxis::AngX, 0.0, character.world.motor_gain)
                    .motor_max_force(JointAxis::AngX, motor.top_torque);
            }
            joints.push(physics.insert_impulse_joint(bodies[parent], bodies[child], joint));
        }
        let parts = character.start_pose().collect();
        Ok(Self { player, bodies, colliders, joints, parts })
    }

    /// A frame, before the physics is stepped: looks where the parts are, and sets the motors.
    pub fn tick(&mut self, physics: &mut PhysicsWorld, command: Command, seconds: f32) {
        for ((part, &body), &collider) in self.parts.iter_mut().zip(&self.bodies).zip(&self.colliders) {
            let touching = presses(&physics.narrow_phase, collider).into();
            let body = &physics.bodies[body];
            let (at, turned, velocity) = (body.translation(), body.rotation(), body.linvel());
            *part = PartState {
                x: at.x,
                y: at.y,
                cos: turned.re,
                sin: turned.im,
                vx: velocity.x,
                vy: velocity.y,
                spin: body.angvel(),
                touching,
            };
        }
        // On an error, a body that is not finite, the motors are asked for speed 0; there is nothing to add.
        let _ = self.player.tick(&self.parts, &[], command, seconds);
        let character = Arc::clone(self.player.character());
        for (&hinge, &speed) in character.outputs.iter().zip(self.player.speeds()) {
            if let Some(joint) = physics.impulse_joints.get_mut(self.joints[usize::from(hinge)], false) {
                joint.data.set_motor_velocity(JointAxis::AngX, speed, character.world.motor_gain);
            }
        }
    }

    /// Puts it back into its start pose, its torso above `x`, m.
    pub fn put(&mut self, physics: &mut PhysicsWorld, x: f32) {
        self.player.reset();
        let character = self.player.character();
        let shift = x - character.parts[0].x;
        for (part, &body) in character.parts.iter().zip(&self.bodies) {
            let body = &mut physics.bodies[body];
            body.set_position(Pose::new(Vector::new(part.x + shift, part.y), part.angle), true);
            body.set_linvel(Vector::ZERO, true);
            body.set_angvel(0.0, true);
        }
    }

    /// What is played.
    pub fn character(&self) -> &Character {
        self.player.character()
    }

    /// The parts as they were in the last frame; the first is the torso.
    pub fn parts(&self) -> &[PartState] {
        &self.parts
    }

    /// How far its foremost point is, m.
    pub fn front(&self) -> f32 {
        let front = |(state, part): (&PartState, &Part)| state.x + part.shape.half_extents(state.cos, state.sin)[0];
        self.parts.iter().zip(&self.character().parts).map(front).fold(f32::NEG_INFINITY, f32::max)
    }
}

/// Whether something presses on it. Bodies of a character that do not collide with each other are pressed by the ground alone.
fn presses(narrow_phase: &NarrowPhase, collider: ColliderHandle) -> bool {
    let mut pairs = narrow_phase.contact_pairs_with(collider).flat_map(|pair| pair.manifolds());
    pairs.any(|manifold| manifold.points.iter().any(|point| point.data.impulse > 0.0))
}
