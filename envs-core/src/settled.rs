use crate::{Conditions, Engine, Landscape, PhysicsSettings, PushSchedule, RestPose};
use creatures::Blueprint;
use ne_core::Failure;
use std::sync::Arc;
use tasks::{Body, CommandSchedule, PartState, Snapshot};

/// A creature at rest in its start pose (but for the torso's spin, if the conditions give it one), the clock at zero: what every trial begins with.
#[derive(Clone)]
pub struct Settled<E> {
    /// The engine after settling, its motors asked for speed 0.
    pub engine: E,
    /// What the sensors compare with.
    pub rest: Arc<RestPose>,
    /// The gaps of the ground: from and to, m, from left to right.
    pub gaps: Arc<[[f32; 2]]>,
    /// When the torso is pushed in this trial.
    pub pushes: PushSchedule,
    /// What the creature is made of in this trial.
    pub body: Arc<Body>,
    /// What the body is told to do in this trial.
    pub commands: CommandSchedule,
    /// Where every part is; time and motor work are 0.
    pub snapshot: Snapshot,
    /// Seconds a step of this trial lasts.
    pub time_step: f32,
}

/// At rest: slower than this (m/s, and rad/s)...
const REST_SPEED: f32 = 0.005;
/// ...for so many steps.
const REST_STEPS: u32 = 10;

/// Steps in which the joints are turned into the start pose of the trial.
const TURNING_STEPS: u32 = 10;

impl<E: Engine> Settled<E> {
    /// Turns the joints as the conditions say, and lets the creature come to rest. `settings` and `body`: those of the trial.
    pub(crate) fn new(
        mut engine: E,
        blueprint: &Blueprint,
        settings: &PhysicsSettings,
        conditions: &Conditions,
        landscape: &Landscape,
        body: Arc<Body>,
    ) -> Result<Self, Failure> {
        let mut parts = vec![PartState::default(); blueprint.parts().len()];
        engine.look(&mut parts);
        turn(&mut engine, &mut parts, blueprint, settings, &conditions.turns)?;
        let (mut steps, mut still) = (0.0, 0);
        // In water there is nothing to come to rest on.
        let settle_time = if settings.water.is_some() { 0.0 } else { settings.settle_time };
        while steps * settings.time_step < settle_time && still < REST_STEPS {
            advance(&mut engine, &mut parts, settings.unstable_speed, 0.0)?;
            let rests = |part: &PartState| part.vx.abs().max(part.vy.abs()).max(part.spin.abs()) < REST_SPEED;
            still = if parts.iter().all(rests) { still + 1 } else { 0 };
            steps += 1.0;
        }
        let mut snapshot = Snapshot { parts, ..Snapshot::default() };
        if settle_time > 0.0 && snapshot.aloft() {
            let what = format!("it is still in the air after settling for {settle_time} s");
            return Err(Failure::Other { what });
        }
        let rest = Arc::new(RestPose::new(blueprint, &snapshot));
        if conditions.torso_spin != 0.0 {
            engine.nudge(0, [0.0, 0.0], conditions.torso_spin);
            engine.look(&mut snapshot.parts);
        }
        let gaps = landscape.gaps().collect();
        let pushes = PushSchedule::new(&conditions.pushes, blueprint, conditions.mass);
        let commands = CommandSchedule::default();
        Ok(Self { engine, rest, gaps, pushes, body, commands, snapshot, time_step: settings.time_step })
    }

    /// The same creature, told to do this.
    #[must_use]
    pub(crate) fn commanded(mut self, commands: CommandSchedule) -> Self {
        self.snapshot.command = commands.first();
        Self { commands, ..self }
    }
}

/// Turns each actuated joint by its own motor, as far as motor and ground let it. Without a turn no time passes.
fn turn<E: Engine>(
    engine: &mut E,
    parts: &mut [PartState],
    blueprint: &Blueprint,
    settings: &PhysicsSettings,
    turns: &[f32],
) -> Result<(), Failure> {
    if turns.iter().all(|&turn| turn == 0.0) {
        return Ok(());
    }
    let seconds = TURNING_STEPS as f32 * settings.time_step;
    for (&hinge, turn) in blueprint.actuated().iter().zip(turns) {
        engine.set_motor_speed(hinge, turn / seconds);
    }
    for _ in 0..TURNING_STEPS {
        advance(engine, parts, settings.unstable_speed, 0.0)?;
    }
    for &hinge in blueprint.actuated() {
        engine.set_motor_speed(hinge, 0.0);
    }
    Ok(())
}

/// One step of the engine, and a look at where every part is. `clock`: the time before the step, s, for the failure's
/// text.
pub(crate) fn advance<E: Engine>(
    engine: &mut E,
    parts: &mut [PartState],
    unstable_speed: f32,
    clock: f32,
) -> Result<(), Failure> {
    if !engine.step() {
        return Err(Failure::NonFinite { what: format!("position or speed of a part after {clock} s") });
    }
    engine.look(parts);
    let speed = |part: &PartState| part.vx.abs().max(part.vy.abs());
    let fastest = parts.iter().map(speed).fold(0.0, f32::max);
    if fastest > unstable_speed {
        return Err(Failure::Unstable { what: format!("a part moves at {fastest} m/s") });
    }
    Ok(())
}
