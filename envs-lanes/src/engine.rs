use crate::{instructions::Inline, solver::LaneWorld};
use creatures::Blueprint;
use envs_core::{Conditions, CreatureEnvironment, Engine, EnvironmentError, Ground, PhysicsSettings};
use tasks::PartState;

/// The lane solver with a single lane: one creature on its ground.
///
/// For callers that want one creature at a time, in the place of rapier; a [`LaneEpisode`](crate::LaneEpisode) steps
/// many.
#[derive(Clone, Debug)]
pub struct LaneEngine {
    world: LaneWorld<1>,
}

/// A creature in the lane solver, alone.
pub type LaneEnvironment = CreatureEnvironment<LaneEngine>;

impl LaneEngine {
    pub(crate) fn world(&self) -> &LaneWorld<1> {
        &self.world
    }

    /// Whether another creature's world is of the same kind: only then can one batch have both.
    pub(crate) fn is_like(&self, other: &Self) -> bool {
        self.world.is_level() == other.world.is_level()
    }

    /// Worlds of the same kind for more creatures, with no creature in them yet.
    pub(crate) fn widened<const W: usize>(&self) -> LaneWorld<W> {
        self.world.widened()
    }
}

impl Engine for LaneEngine {
    fn new(
        blueprint: &Blueprint,
        settings: &PhysicsSettings,
        ground: &Ground,
        conditions: &Conditions,
    ) -> Result<Self, EnvironmentError> {
        let mut world = LaneWorld::new(blueprint, settings, ground)?;
        world.reset(0, conditions);
        Ok(Self { world })
    }

    fn set_motor_speed(&mut self, hinge: usize, speed: f32) {
        self.world.set_motor_speed(0, hinge, speed);
    }

    fn nudge(&mut self, part: usize, velocity: [f32; 2], spin: f32) {
        self.world.nudge(0, part, velocity, spin);
    }

    fn step(&mut self) -> bool {
        self.world.step(Inline, None);
        !self.world.fastest().0[0].is_nan()
    }

    fn look(&self, parts: &mut [PartState]) {
        self.world.look(0, parts);
    }

    fn motor_torque(&self, hinge: usize) -> f32 {
        self.world.motor_torques(hinge).0[0]
    }

    fn motor_power(&self, hinge: usize) -> f32 {
        self.world.motor_powers(hinge).0[0]
    }

    fn distance_to_ground(&self, [x, y]: [f32; 2], angle: f32, length: f32) -> f32 {
        use crate::lanes::Lanes;
        self.world.distance_to_ground((Lanes([x]), Lanes([y])), angle, length).0[0]
    }
}
