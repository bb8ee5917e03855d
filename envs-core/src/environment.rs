use crate::{
    Conditions, Engine, EnvironmentError, Ground, Landscape, PhysicsSettings, PushSchedule, RestPose, Settled,
    Variation, anatomy::body_in, body::Body, settled::advance,
};
use creatures::{Actuation, Blueprint, Landings, Motors, Senses, Sensor, Source, Terrain, TerrainError};
use ne_core::{Failure, Seed, SettingError};
use std::{borrow::Cow, sync::Arc};
use tasks::{CommandSchedule, Commands, Environment, Snapshot};

/// A creature on its ground in a physics engine.
#[derive(Clone)]
pub struct CreatureEnvironment<E: Engine> {
    plan: Arc<Plan<E>>,
    state: State<E>,
}

/// A hinge that an output of the controller moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ActuatedHinge {
    /// Index of the hinge.
    pub hinge: usize,
    /// Index of its parent part.
    pub parent: usize,
    /// Index of its child part.
    pub child: usize,
}

/// What all copies of an environment share.
#[derive(Clone)]
struct Plan<E> {
    blueprint: Blueprint,
    senses: Senses,
    motors: Motors,
    settings: PhysicsSettings,
    variation: Variation,
    /// Whether bumps are behind the start, and not in front of it.
    backwards: bool,
    landscape: Landscape,
    /// What the landscape was laid out from, if trials may have others; else flat.
    terrain: Terrain,
    /// What the body is told to do, and whether trials are lessons; `None`: nothing.
    commands: Option<(Commands, bool)>,
    /// One for each motor.
    actuated: Vec<ActuatedHinge>,
    /// The settled creature in the world without variation.
    settled: Settled<E>,
}

/// What changes from step to step, and what changes from trial to trial.
#[derive(Clone)]
struct State<E> {
    engine: E,
    rest: Arc<RestPose>,
    gaps: Arc<[[f32; 2]]>,
    pushes: PushSchedule,
    anatomy: Arc<tasks::Body>,
    commands: CommandSchedule,
    snapshot: Snapshot,
    landings: Landings,
    /// Seconds a step of this trial lasts.
    time_step: f32,
    steps: u32,
    /// What each motor was last asked for, rad/s.
    speeds: Vec<f32>,
    wanted: Vec<f32>,
}

/// The deepest a creature may start in the ground, m.
const DEEPEST_START: f32 = 0.1;

/// Checks that a creature does not start inside the ground.
///
/// # Errors
/// [`EnvironmentError::BelowGround`].
pub fn check_start(blueprint: &Blueprint) -> Result<(), EnvironmentError> {
    let depth = -blueprint.bounding_box()[1];
    match depth > DEEPEST_START {
        true => Err(EnvironmentError::BelowGround { creature: blueprint.name().into(), depth }),
        false => Ok(()),
    }
}

impl<E: Engine> CreatureEnvironment<E> {
    /// On flat ground: see [`on_ground`](Self::on_ground).
    ///
    /// # Errors
    /// If a setting or sensor is out of range, the engine cannot simulate the creature, or the creature starts more
    /// than 0.1 m below the ground, explodes while it settles or is still in the air afterwards. With a settle time of
    /// 0 it may start in the air.
    pub fn new(
        blueprint: Blueprint,
        sensors: &[Sensor],
        input_range: f32,
        settings: PhysicsSettings,
        variation: Variation,
    ) -> Result<Self, EnvironmentError> {
        Self::on_ground(blueprint, sensors, input_range, settings, variation, Ground::flat())
    }

    /// Builds the creature, and lets it settle for at most [`PhysicsSettings::settle_time`] with its motors holding
    /// still. `input_range`: sensors are scaled to ± this. In [water](PhysicsSettings::water) there is no ground, and it does
    /// not settle.
    ///
    /// The creature starts where its file says: its lowest point must be near y = 0 or above, and clear of the shapes
    /// of the ground. Only the former is checked.
    ///
    /// # Errors
    /// As [`new`](Self::new), and if the ground is not valid, or not flat though there is water.
    pub fn on_ground(
        blueprint: Blueprint,
        sensors: &[Sensor],
        input_range: f32,
        settings: PhysicsSettings,
        variation: Variation,
        ground: Ground,
    ) -> Result<Self, EnvironmentError> {
        Self::on_landscape(blueprint, sensors, input_range, settings, variation, ground.into(), Terrain::default())
    }

    /// On a terrain laid out for the creature: see [`Landscape::new`] and [`on_ground`](Self::on_ground). With
    /// [`Variation::terrain`] each trial has one of its own seed.
    ///
    /// # Errors
    /// As [`new`](Self::new), if the terrain is not valid, and if it is not flat though there is water.
    pub fn on_terrain(
        blueprint: Blueprint,
        sensors: &[Sensor],
        input_range: f32,
        settings: PhysicsSettings,
        variation: Variation,
        terrain: Terrain,
    ) -> Result<Self, EnvironmentError> {
        if let Err(TerrainError { field, found, allowed }) = terrain.validate() {
            return Err(SettingError::new(field, found, allowed).within("terrain").into());
        }
        let landscape = Landscape::new(&terrain, terrain.seed, &blueprint);
        Self::on_landscape(blueprint, sensors, input_range, settings, variation, landscape, terrain)
    }

    /// The ground must be valid.
    fn on_landscape(
        blueprint: Blueprint,
        sensors: &[Sensor],
        input_range: f32,
        settings: PhysicsSettings,
        variation: Variation,
        landscape: Landscape,
        terrain: Terrain,
    ) -> Result<Self, EnvironmentError> {
        settings.validate().map_err(|error| error.within("physics"))?;
        variation.validate().map_err(|error| error.within("variation"))?;
        let landscape = around(&settings, landscape)?;
        let senses = Senses::new(&blueprint, sensors, input_range)?;
        let motors = Motors::new(&blueprint);
        let hinges = blueprint.hinges();
        let actuated =
            |&hinge: &usize| ActuatedHinge { hinge, parent: hinges[hinge].parent, child: hinges[hinge].child };
        let actuated = blueprint.actuated().iter().map(actuated).collect();
        check_start(&blueprint)?;
        let reference = Conditions::reference(motors.len());
        let engine = E::new(&blueprint, &settings, &landscape.ground, &reference)?;
        let body = Arc::new(body_in(&blueprint, &settings, reference.mass, landscape.ground != Ground::flat()));
        let settled = Settled::new(engine, &blueprint, &settings, &reference, &landscape, body)
            .map_err(|failure| EnvironmentError::Settling { creature: blueprint.name().into(), failure })?;
        let state = State::new(settled.clone(), motors.len());
        let plan = Plan {
            blueprint,
            senses,
            motors,
            settings,
            variation,
            landscape,
            terrain,
            backwards: false,
            commands: None,
            actuated,
            settled,
        };
        Ok(Self { plan: Arc::new(plan), state })
    }

    /// The same environment, in which the body is told what to do: each trial draws its commands from its own seed. `lessons`:
    /// see [`Trials::lessons`](tasks::Trials::lessons).
    ///
    /// # Errors
    /// If a number of the commands is out of range.
    pub fn with_commands(mut self, commands: Option<Commands>, lessons: bool) -> Result<Self, EnvironmentError> {
        if let Some(commands) = &commands {
            commands.validate().map_err(|error| error.within("commands"))?;
        }
        Arc::make_mut(&mut self.plan).commands = commands.map(|commands| (commands, lessons));
        Ok(self)
    }

    /// The same environment, whose controller's outputs mean something else.
    ///
    /// # Errors
    /// If the actuation's gain is out of range.
    pub fn with_actuation(mut self, actuation: Actuation) -> Result<Self, EnvironmentError> {
        if let Actuation::Angle { gain } = actuation {
            let [low, high] = Actuation::GAINS;
            SettingError::check_range("gain", gain, low.into(), high.into())
                .map_err(|error| error.within("actuation.angle"))?;
        }
        let plan = Arc::make_mut(&mut self.plan);
        plan.motors = Motors::with_actuation(&plan.blueprint, actuation);
        Ok(self)
    }

    /// The same environment for a movement that goes backwards: the [bumps](Variation::bumps) of its trials are there.
    #[must_use]
    pub fn going_backwards(mut self, backwards: bool) -> Self {
        Arc::make_mut(&mut self.plan).backwards = backwards;
        self
    }

    /// Whether it is for a movement that goes backwards.
    pub fn goes_backwards(&self) -> bool {
        self.plan.backwards
    }

    /// The same environment in one world alone: every trial has these conditions, on this ground, and nothing varies.
    /// The settings are then those of that world's trials, its time step and gravity in them, and so are the masses and the
    /// gravity of [`body`](Environment::body).
    ///
    /// # Errors
    /// If a condition is out of range, the ground is not valid, the engine cannot build it, or the creature does not
    /// come to rest there.
    pub fn under(&self, conditions: &Conditions, landscape: impl Into<Landscape>) -> Result<Self, EnvironmentError> {
        conditions.validate(self.plan.motors.len()).map_err(|error| error.within("conditions"))?;
        conditions.settings(&self.plan.settings).validate().map_err(|error| error.within("physics"))?;
        self.under_varied(conditions, landscape)
    }

    /// The same, for conditions that a variation has drawn: they may lead settings beyond the end of their range, as in trials.
    ///
    /// # Errors
    /// As [`under`](Self::under), but for the settings.
    pub fn under_varied(
        &self,
        conditions: &Conditions,
        landscape: impl Into<Landscape>,
    ) -> Result<Self, EnvironmentError> {
        let landscape = landscape.into();
        conditions.validate(self.plan.motors.len()).map_err(|error| error.within("conditions"))?;
        let settings = conditions.settings(&self.plan.settings);
        let landscape = around(&settings, landscape)?;
        let blueprint = &self.plan.blueprint;
        let engine = E::new(blueprint, &settings, &landscape.ground, conditions)?;
        let body = Arc::new(body_in(blueprint, &settings, conditions.mass, landscape.ground != Ground::flat()));
        let settled = Settled::new(engine, blueprint, &settings, conditions, &landscape, body)
            .map_err(|failure| EnvironmentError::Settling { creature: blueprint.name().into(), failure })?;
        let state = State::new(settled.clone(), self.plan.motors.len());
        let variation = Variation::default();
        let terrain = Terrain::default();
        let plan = Plan { settings, variation, landscape, terrain, settled, ..(*self.plan).clone() };
        Ok(Self { plan: Arc::new(plan), state })
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

    /// The hinge of each motor, in order of the outputs.
    pub fn actuated(&self) -> &[ActuatedHinge] {
        &self.plan.actuated
    }

    /// The physics settings, before variation.
    pub fn settings(&self) -> &PhysicsSettings {
        &self.plan.settings
    }

    /// How much the world differs from trial to trial.
    pub fn variation(&self) -> &Variation {
        &self.plan.variation
    }

    /// What the creature moves on.
    pub fn ground(&self) -> &Ground {
        &self.plan.landscape.ground
    }

    /// The same, and where its obstacles are; without variation between trials.
    pub fn landscape(&self) -> &Landscape {
        &self.plan.landscape
    }

    /// What the landscape was laid out from; flat if it was given as ground.
    pub fn terrain(&self) -> &Terrain {
        &self.plan.terrain
    }

    /// The torque each motor gave at the end of the last step, N·m, in order of the outputs: positive where it turns the child
    /// part counter-clockwise. (Solvers give the impulse on the parent.)
    pub fn motor_torques(&self) -> impl Iterator<Item = f32> + '_ {
        self.plan.actuated.iter().map(|actuated| -self.state.engine.motor_torque(actuated.hinge))
    }

    /// From the next step on the body is told this, in place of what its trial drew.
    pub fn tell(&mut self, commands: CommandSchedule) {
        self.state.commands = commands;
    }

    /// The physics of the present trial, for playing with a creature: a push, another gravity, a stone in its way. An environment that
    /// was meddled with repeats nothing; the next reset begins anew.
    pub fn engine_mut(&mut self) -> &mut E {
        &mut self.state.engine
    }

    /// The speed each motor was last asked for, rad/s, in order of the outputs.
    pub fn asked_speeds(&self) -> &[f32] {
        &self.state.wanted
    }

    /// The raw value of a source now; NaN for a sensor of another crate.
    pub fn measure(&self, source: Source) -> f32 {
        source.read(&self.state.body())
    }

    /// Where the commands of a trial come from; `None`: the body is told nothing.
    pub fn commands(&self) -> Option<&Commands> {
        self.plan.commands.as_ref().map(|(commands, _)| commands)
    }

    /// What the creature moves on in the trial with this seed.
    pub fn landscape_of(&self, seed: Seed) -> Cow<'_, Landscape> {
        self.landscape_under(&self.plan.variation, seed)
    }

    /// The same if the world differed from trial to trial as this variation has it.
    pub fn landscape_under(&self, variation: &Variation, seed: Seed) -> Cow<'_, Landscape> {
        let Plan { blueprint, settings, landscape, terrain, backwards, .. } = &*self.plan;
        if settings.water.is_some() {
            return Cow::Borrowed(landscape);
        }
        if !terrain.is_flat() {
            return match variation.draw_terrain(seed) {
                Some(seed) => Cow::Owned(Landscape::new(terrain, seed, blueprint)),
                None => Cow::Borrowed(landscape),
            };
        }
        let [left, _, right, _] = blueprint.bounding_box();
        let bumps = variation.draw_bumps(seed, [left, right], blueprint.body_length(), *backwards);
        if bumps.is_empty() {
            return Cow::Borrowed(landscape);
        }
        let shapes = landscape.ground.shapes.iter().copied().chain(bumps).collect();
        Cow::Owned(Ground { shapes }.into())
    }

    /// What the trial with this seed begins with, and what `reset` puts in place; for callers that step many creatures
    /// at once by themselves.
    ///
    /// # Errors
    /// If the creature cannot come to rest in the world of this trial.
    pub fn settled(&self, seed: Seed) -> Result<Settled<E>, Failure> {
        let settled = self.settled_untold(seed)?;
        Ok(match &self.plan.commands {
            Some((commands, lessons)) => settled.commanded(commands.draw(seed, *lessons)),
            None => settled,
        })
    }

    /// The same, without commands.
    fn settled_untold(&self, seed: Seed) -> Result<Settled<E>, Failure> {
        let Plan { blueprint, motors, settings, variation, settled, .. } = &*self.plan;
        if variation.is_none() {
            return Ok(settled.clone());
        }
        let conditions = variation.draw(seed, motors.len());
        let settings = conditions.settings(settings);
        let landscape = self.landscape_of(seed);
        let engine = E::new(blueprint, &settings, &landscape.ground, &conditions)
            .map_err(|error| Failure::Other { what: error.to_string() })?;
        // Small bumps in the way of a trial leave the ground as even as it is for judges.
        let body = Arc::new(body_in(blueprint, &settings, conditions.mass, settled.body.uneven_ground));
        Settled::new(engine, blueprint, &settings, &conditions, &landscape, body)
    }
}

impl<E: Engine> Environment for CreatureEnvironment<E> {
    fn inputs(&self) -> usize {
        self.plan.senses.len()
    }

    fn outputs(&self) -> usize {
        self.plan.motors.len()
    }

    fn time_step(&self) -> f32 {
        self.state.time_step
    }

    fn body(&self) -> Option<&tasks::Body> {
        Some(&self.state.anatomy)
    }

    fn reset(&mut self, seed: Seed) -> Result<(), Failure> {
        self.state = State::new(self.settled(seed)?, self.outputs());
        Ok(())
    }

    fn sense(&self, inputs: &mut [f32]) {
        self.plan.senses.read(&self.state.body(), inputs);
    }

    fn act(&mut self, outputs: &[f32]) {
        let State { engine, wanted, speeds, snapshot, rest, gaps, landings, .. } = &mut self.state;
        let body = Body { engine, snapshot, rest, gaps, landings: *landings };
        self.plan.motors.speeds(&body, outputs, wanted);
        for ((actuated, &wanted), speed) in self.plan.actuated.iter().zip(&*wanted).zip(speeds) {
            // A speed that is no number stays out of the engine; `step` reports it.
            if wanted != *speed && !wanted.is_nan() {
                engine.set_motor_speed(actuated.hinge, wanted);
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

/// What is around a creature: the landscape, or in water nothing.
fn around(settings: &PhysicsSettings, landscape: Landscape) -> Result<Landscape, SettingError> {
    match settings.water {
        None => {
            landscape.ground.validate().map_err(|error| error.within("ground"))?;
            Ok(landscape)
        }
        Some(_) if landscape.ground == Ground::flat() || landscape.ground == Ground::none() => {
            Ok(Ground::none().into())
        }
        Some(_) => {
            Err(SettingError::new("physics.water", "water", "null on ground that is not flat: water has no ground"))
        }
    }
}

impl<E: Engine> State<E> {
    /// The beginning of a trial.
    fn new(settled: Settled<E>, motors: usize) -> Self {
        let Settled { engine, rest, gaps, pushes, body: anatomy, commands, snapshot, time_step } = settled;
        let still = vec![0.0; motors];
        let landings = Landings::default();
        Self {
            engine,
            rest,
            gaps,
            pushes,
            anatomy,
            commands,
            snapshot,
            landings,
            time_step,
            steps: 0,
            speeds: still.clone(),
            wanted: still,
        }
    }

    /// The creature as its sensors see it.
    fn body(&self) -> Body<'_, E> {
        let Self { engine, snapshot, rest, gaps, landings, .. } = self;
        Body { engine, snapshot, rest, gaps, landings: *landings }
    }

    /// One step, with everything that is measured after it.
    fn advance(&mut self, plan: &Plan<E>) -> Result<(), Failure> {
        let clock = self.steps as f32 * self.time_step;
        let mut torso = self.snapshot.torso().vx;
        while let Some(velocity) = self.pushes.take(clock) {
            self.engine.nudge(0, [velocity, 0.0], 0.0);
            self.snapshot.push_work += self.pushes.work(torso, velocity);
            torso += velocity;
        }
        advance(&mut self.engine, &mut self.snapshot.parts, plan.settings.unstable_speed, clock)?;
        self.steps += 1;
        self.snapshot.time = self.steps as f32 * self.time_step;
        self.snapshot.command = self.commands.at(self.snapshot.time, &self.snapshot.command, self.time_step);
        let parts = &self.snapshot.parts;
        self.landings.observe(parts.iter().any(|part| part.touching), self.snapshot.time);
        let power: f32 = plan.actuated.iter().map(|actuated| self.engine.motor_power(actuated.hinge)).sum();
        self.snapshot.motor_work += f64::from(power) * f64::from(self.time_step);
        Ok(())
    }
}
