use crate::{
    PhysicsSettings, Variation,
    body::{Body, RestPose},
    variation::Factors,
    world::World,
};
use creatures::{Blueprint, CreatureError, Motors, Senses, Sensor};
use ne_core::{Failure, Seed, SettingError};
use std::sync::Arc;
use tasks::{Environment, PartState, Snapshot};

/// A creature on flat ground in rapier2d.
#[derive(Clone)]
pub struct RapierEnvironment {
    plan: Arc<Plan>,
    state: State,
}

/// What all copies of an environment share.
struct Plan {
    blueprint: Blueprint,
    senses: Senses,
    motors: Motors,
    settings: PhysicsSettings,
    variation: Variation,
    /// For each motor: its hinge, and the hinge's parent and child.
    actuated: Vec<(usize, usize, usize)>,
    /// The settled creature in the world without variation.
    settled: State,
}

/// What changes from step to step.
#[derive(Clone)]
struct State {
    world: World,
    snapshot: Snapshot,
    rest: Arc<RestPose>,
    steps: u32,
    /// What each motor was last asked for, rad/s.
    speeds: Vec<f32>,
    wanted: Vec<f32>,
}

/// Why an environment cannot be built.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// The sensors do not suit the creature.
    #[error(transparent)]
    Creature(#[from] CreatureError),
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The creature starts inside the ground, which would throw it up.
    #[error("the creature \"{creature}\" starts {depth} m below the ground: its lowest point must be near y = 0")]
    BelowGround {
        /// Its name.
        creature: String,
        /// How deep its lowest point is, m.
        depth: f32,
    },
    /// The creature explodes in its start pose, or has not reached the ground when it should have settled.
    #[error("the creature \"{creature}\" does not survive settling in its start pose: {failure}")]
    Settling {
        /// Its name.
        creature: String,
        /// What happened.
        failure: Failure,
    },
}

/// The deepest a creature may start in the ground, m.
const DEEPEST_START: f32 = 0.1;

/// At rest: slower than this (m/s, and rad/s)...
const REST_SPEED: f32 = 0.005;
/// ...for so many steps.
const REST_STEPS: u32 = 10;

impl RapierEnvironment {
    /// Builds the creature, and lets it settle for at most [`PhysicsSettings::settle_time`] with its motors holding
    /// still. `input_range`: sensors are scaled to ± this.
    ///
    /// # Errors
    /// If a setting or sensor is out of range, or the creature starts more than 0.1 m below the ground, explodes while
    /// it settles or is still in the air afterwards. With a settle time of 0 it may start in the air.
    pub fn new(
        blueprint: Blueprint,
        sensors: &[Sensor],
        input_range: f32,
        settings: PhysicsSettings,
        variation: Variation,
    ) -> Result<Self, EnvironmentError> {
        settings.validate().map_err(|error| error.within("physics"))?;
        variation.validate().map_err(|error| error.within("variation"))?;
        let senses = Senses::new(&blueprint, sensors, input_range)?;
        let motors = Motors::new(&blueprint);
        let hinges = blueprint.hinges();
        let actuated =
            blueprint.actuated().iter().map(|&hinge| (hinge, hinges[hinge].parent, hinges[hinge].child)).collect();
        let depth = -blueprint.bounding_box()[1];
        if depth > DEEPEST_START {
            return Err(EnvironmentError::BelowGround { creature: blueprint.name().into(), depth });
        }
        let settled = State::settled(&blueprint, &settings, Factors::NOMINAL)
            .map_err(|failure| EnvironmentError::Settling { creature: blueprint.name().into(), failure })?;
        let state = settled.clone();
        Ok(Self { plan: Arc::new(Plan { blueprint, senses, motors, settings, variation, actuated, settled }), state })
    }

    /// The creature.
    pub fn blueprint(&self) -> &Blueprint {
        &self.plan.blueprint
    }

    /// What each input of the controller is.
    pub fn senses(&self) -> &Senses {
        &self.plan.senses
    }

    /// What each output of the controller does.
    pub fn motors(&self) -> &Motors {
        &self.plan.motors
    }

    /// The physics settings.
    pub fn settings(&self) -> &PhysicsSettings {
        &self.plan.settings
    }

    /// The torque each motor gave at the end of the last step, N·m, in order of the outputs.
    pub fn motor_torques(&self) -> impl Iterator<Item = f32> + '_ {
        self.plan.actuated.iter().map(|&(hinge, ..)| self.state.world.motor_torque(hinge))
    }
}

impl Environment for RapierEnvironment {
    fn inputs(&self) -> usize {
        self.plan.senses.len()
    }

    fn outputs(&self) -> usize {
        self.plan.motors.len()
    }

    fn time_step(&self) -> f32 {
        self.plan.settings.time_step
    }

    fn reset(&mut self, seed: Seed) -> Result<(), Failure> {
        let Plan { blueprint, settings, variation, settled, .. } = &*self.plan;
        self.state = if variation.is_none() {
            settled.clone()
        } else {
            State::settled(blueprint, settings, variation.draw(seed))?
        };
        Ok(())
    }

    fn sense(&self, inputs: &mut [f32]) {
        let State { world, snapshot, rest, .. } = &self.state;
        self.plan.senses.read(&Body { world, snapshot, rest }, inputs);
    }

    fn act(&mut self, outputs: &[f32]) {
        self.plan.motors.speeds(outputs, &mut self.state.wanted);
        let gain = self.plan.settings.motor_gain;
        let State { world, wanted, speeds, .. } = &mut self.state;
        for ((&(hinge, ..), &wanted), speed) in self.plan.actuated.iter().zip(&*wanted).zip(speeds) {
            // A speed that is no number stays out of rapier; `step` reports it.
            if wanted != *speed && !wanted.is_nan() {
                world.set_motor_speed(hinge, wanted, gain);
                *speed = wanted;
            }
        }
    }

    fn step(&mut self) -> Result<(), Failure> {
        if let Some(output) = self.state.wanted.iter().position(|speed| speed.is_nan()) {
            return Err(Failure::NonFinite { what: format!("output {output} of the controller") });
        }
        self.state.advance(&self.plan)
    }

    fn snapshot(&self) -> &Snapshot {
        &self.state.snapshot
    }
}

impl State {
    /// A creature at rest in its start pose, the clock at zero.
    fn settled(blueprint: &Blueprint, settings: &PhysicsSettings, factors: Factors) -> Result<Self, Failure> {
        let parts = blueprint.parts().len();
        let motors = blueprint.actuated().len();
        let mut state = Self {
            world: World::new(blueprint, settings, factors),
            snapshot: Snapshot { parts: vec![PartState::default(); parts], ..Snapshot::default() },
            rest: Arc::new(RestPose::new(
                blueprint,
                &Snapshot { parts: vec![PartState::default()], ..Snapshot::default() },
            )),
            steps: 0,
            speeds: vec![0.0; motors],
            wanted: vec![0.0; motors],
        };
        state.look();
        let (mut steps, mut still) = (0.0, 0);
        while steps * settings.time_step < settings.settle_time && still < REST_STEPS {
            state.advance_world(settings)?;
            let rests = |part: &PartState| part.vx.abs().max(part.vy.abs()).max(part.spin.abs()) < REST_SPEED;
            still = if state.snapshot.parts.iter().all(rests) { still + 1 } else { 0 };
            steps += 1.0;
        }
        if settings.settle_time > 0.0 && state.snapshot.aloft() {
            let what = format!("it is still in the air after settling for {} s", settings.settle_time);
            return Err(Failure::Unstable { what });
        }
        state.rest = Arc::new(RestPose::new(blueprint, &state.snapshot));
        Ok(state)
    }

    /// One step, with everything that is measured after it.
    fn advance(&mut self, plan: &Plan) -> Result<(), Failure> {
        self.advance_world(&plan.settings)?;
        self.steps += 1;
        self.snapshot.time = self.steps as f32 * plan.settings.time_step;
        let parts = &self.snapshot.parts;
        let power: f32 = plan
            .actuated
            .iter()
            .map(|&(hinge, parent, child)| {
                (self.world.motor_torque(hinge) * (parts[child].spin - parts[parent].spin)).abs()
            })
            .sum();
        self.snapshot.motor_work += f64::from(power) * f64::from(plan.settings.time_step);
        Ok(())
    }

    /// One step of the world, and a look at where every part is.
    fn advance_world(&mut self, settings: &PhysicsSettings) -> Result<(), Failure> {
        if !self.world.step() {
            let seconds = self.steps as f32 * settings.time_step;
            return Err(Failure::NonFinite { what: format!("position or speed of a part after {seconds} s") });
        }
        self.look();
        let speed = |part: &PartState| part.vx.abs().max(part.vy.abs());
        let fastest = self.snapshot.parts.iter().map(speed).fold(0.0, f32::max);
        if fastest > settings.unstable_speed {
            return Err(Failure::Unstable { what: format!("a part moves at {fastest} m/s") });
        }
        Ok(())
    }

    /// Reads where every part is and which ones touch the ground.
    fn look(&mut self) {
        for (part, &body) in self.snapshot.parts.iter_mut().zip(&self.world.bodies) {
            let body = &self.world.physics.bodies[body];
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
        let parts = &mut self.snapshot.parts;
        self.world.touching(|part| parts[part].touching = true);
    }
}
