use crate::{
    engine::LaneEnvironment,
    instructions::{Instructions, work},
    lanes::Lanes,
    net::LaneNet,
    senses::{Clocks, LaneSenses},
    solver::LaneWorld,
    stopwatch::{Laps, Part},
};
use creatures::{Actuation, Landings, Motors};
use envs_core::{ActuatedHinge, PushSchedule, Settled};
use ne_core::Failure;
use ne_net::{Network, Topology};
use std::sync::Arc;
use tasks::{Command, CommandSchedule, Snapshot};

/// Creatures of one body, side by side, each in a trial of its own: sensing, thinking, acting and stepping them all takes
/// hardly longer than one.
///
/// A lane is a creature only between [`begin`](Self::begin) and the end of its trial; what is left in it afterwards goes
/// on moving, and is ignored.
#[derive(Clone)]
pub(crate) struct Batch<const W: usize> {
    instructions: Instructions,
    world: LaneWorld<W>,
    senses: LaneSenses,
    actuated: Vec<ActuatedHinge>,
    motors: Motors,
    unstable_speed: f32,
    /// The nets, if they all have one topology.
    net: Option<LaneNet<W>>,
    inputs: Vec<Lanes<W>>,
    outputs: Vec<Lanes<W>>,
    /// What one lane senses, and what its controller wants.
    of_one: (Vec<f32>, Vec<f32>),
    /// For each lane, an output in this step that is no finite number: it ends the trial.
    unusable: [Option<usize>; W],
    steps: [u32; W],
    time_step: Lanes<W>,
    time: Lanes<W>,
    /// The landings of each lane, if a sense needs them.
    landings: Option<[Landings; W]>,
    since_landing: Lanes<W>,
    rest_height: Lanes<W>,
    gaps: [Arc<[[f32; 2]]>; W],
    pushes: [PushSchedule; W],
    /// What pushes have given so far, J.
    push_work: [f64; W],
    /// When each lane is pushed next, s from the start of its trial.
    next_push: Lanes<W>,
    commands: [CommandSchedule; W],
    /// What each lane is told to do.
    command: [Command; W],
    /// Whether any lane is told anything.
    commanded: bool,
    /// Of the last step: the power of all motors, W.
    power: Lanes<W>,
    /// Of the last step: the fastest part's larger velocity component, m/s; NaN where a number is not finite.
    fastest: Lanes<W>,
}

impl<const W: usize> Batch<W> {
    /// A batch of the creature of this environment. `topology`: that of the nets that think in lanes, if any do.
    pub(crate) fn new(
        environment: &LaneEnvironment,
        settled: &Settled<crate::LaneEngine>,
        topology: Option<&Topology>,
        instructions: Instructions,
    ) -> Self {
        let mut world = settled.engine.widened();
        // No lane is ever without a body: an empty world is full of divisions by zero.
        for lane in 0..W {
            world.copy_lane(lane, settled.engine.world());
        }
        let zeros = |count| vec![Lanes::ZERO; count];
        let senses = LaneSenses::new(environment.senses(), &settled.rest);
        Self {
            instructions,
            world,
            landings: senses.hears_landings().then(|| [Landings::default(); W]),
            since_landing: Lanes::ZERO,
            senses,
            actuated: environment.actuated().to_vec(),
            motors: environment.motors().clone(),
            unstable_speed: environment.settings().unstable_speed,
            net: topology.and_then(LaneNet::new),
            inputs: zeros(environment.senses().len()),
            outputs: zeros(environment.motors().len()),
            of_one: (vec![0.0; environment.senses().len()], vec![0.0; environment.motors().len()]),
            unusable: [None; W],
            steps: [0; W],
            time_step: Lanes::ZERO,
            time: Lanes::ZERO,
            rest_height: Lanes::ZERO,
            gaps: std::array::from_fn(|_| settled.gaps.clone()),
            pushes: std::array::from_fn(|_| settled.pushes.clone()),
            push_work: [0.0; W],
            next_push: Lanes::splat(f32::INFINITY),
            commands: std::array::from_fn(|_| CommandSchedule::default()),
            command: [Command::default(); W],
            commanded: false,
            power: Lanes::ZERO,
            fastest: Lanes::ZERO,
        }
    }

    /// Puts a settled creature into a lane, its clock at zero.
    pub(crate) fn begin(&mut self, lane: usize, settled: &Settled<crate::LaneEngine>) {
        self.world.copy_lane(lane, settled.engine.world());
        self.steps[lane] = 0;
        self.unusable[lane] = None;
        self.time_step.0[lane] = settled.time_step;
        self.time.0[lane] = 0.0;
        self.since_landing.0[lane] = 0.0;
        if let Some(landings) = &mut self.landings {
            landings[lane] = Landings::default();
        }
        self.rest_height.0[lane] = settled.rest.height();
        self.gaps[lane] = settled.gaps.clone();
        self.pushes[lane] = settled.pushes.clone();
        self.push_work[lane] = 0.0;
        self.next_push.0[lane] = settled.pushes.next_time();
        self.commands[lane] = settled.commands.clone();
        self.commanded |= !settled.commands.is_empty();
        self.command[lane] = settled.commands.first();
        if let Some(net) = &mut self.net {
            net.forget(lane);
        }
    }

    /// Whether the nets think in lanes; else each thinks for itself in [`think`](Self::think).
    pub(crate) fn thinks(&self) -> bool {
        self.net.is_some()
    }

    /// Gives a lane its net, if nets think in lanes.
    pub(crate) fn load(&mut self, lane: usize, network: &Network) {
        if let Some(net) = &mut self.net {
            net.load(lane, network);
        }
    }

    /// What each lane senses; with nets in lanes also what they want.
    pub(crate) fn sense(&mut self) {
        work!(self.instructions, Batch, self, sense_and_think);
    }

    /// Everyone senses and decides. `activate`: what the controller of a lane wants when it senses this; only asked where
    /// nets do not think in lanes, and of every lane, whether it plays or not.
    pub(crate) fn think(&mut self, mut activate: impl FnMut(usize, &[f32], &mut [f32])) {
        self.sense();
        if self.net.is_none() {
            let Self { inputs, outputs, of_one: (sensed, wanted), .. } = self;
            for lane in 0..W {
                sensed.iter_mut().zip(&*inputs).for_each(|(input, lanes)| *input = lanes.0[lane]);
                wanted.fill(0.0);
                activate(lane, sensed, wanted);
                outputs.iter_mut().zip(&*wanted).for_each(|(lanes, output)| lanes.0[lane] = *output);
            }
        }
        if self.outputs.iter().any(|output| output.0.iter().any(|value| !value.is_finite())) {
            for lane in 0..W {
                self.unusable[lane] = self.outputs.iter().position(|output| !output.0[lane].is_finite());
                if self.unusable[lane].is_some() {
                    self.outputs.iter_mut().for_each(|output| output.0[lane] = 0.0);
                }
            }
        }
    }

    /// What the creature in a lane is to do, decided elsewhere.
    pub(crate) fn drive(&mut self, lane: usize, outputs: &[f32]) {
        assert_eq!(outputs.len(), self.outputs.len(), "one action for each motor");
        self.unusable[lane] = outputs.iter().position(|output| !output.is_finite());
        for (lanes, &output) in self.outputs.iter_mut().zip(outputs) {
            lanes.0[lane] = if self.unusable[lane].is_some() { 0.0 } else { output };
        }
    }

    /// What the creature in a lane has last sensed.
    pub(crate) fn read(&self, lane: usize, inputs: &mut [f32]) {
        assert_eq!(inputs.len(), self.inputs.len(), "a place for each input");
        inputs.iter_mut().zip(&self.inputs).for_each(|(input, lanes)| *input = lanes.0[lane]);
    }

    /// One time step of all lanes.
    pub(crate) fn step(&mut self) {
        self.step_timed(None);
    }

    /// The same, with an eye on the clock.
    pub(crate) fn step_timed(&mut self, mut stopwatch: Option<&mut Laps>) {
        if self.next_push.at_most(self.time).any() {
            self.push();
        }
        let instructions = self.instructions;
        work!(instructions, Batch, self, act);
        self.world.step(instructions, stopwatch.as_deref_mut());
        work!(instructions, Batch, self, measure);
        if let Some(laps) = stopwatch {
            laps.lap(Part::Measure);
        }
        for lane in 0..W {
            // A step the controller could not decide on does not count.
            self.steps[lane] += u32::from(self.unusable[lane].is_none());
            self.time.0[lane] = self.steps[lane] as f32 * self.time_step.0[lane];
        }
        if self.commanded {
            for lane in 0..W {
                let (time, time_step) = (self.time.0[lane], self.time_step.0[lane]);
                self.command[lane] = self.commands[lane].at(time, &self.command[lane], time_step);
            }
        }
        if let Some(landings) = &mut self.landings {
            let touching = self.world.touching();
            for (lane, landings) in landings.iter_mut().enumerate() {
                landings.observe(touching.0[lane] > 0.0, self.time.0[lane]);
                self.since_landing.0[lane] = landings.since(self.time.0[lane]);
            }
        }
    }

    /// Pushes the torsos of all lanes whose time has come.
    fn push(&mut self) {
        for lane in 0..W {
            while let Some(velocity) = self.pushes[lane].take(self.time.0[lane]) {
                self.push_work[lane] += self.pushes[lane].work(self.world.velocity_x(lane, 0), velocity);
                self.world.nudge(lane, 0, [velocity, 0.0], 0.0);
            }
            self.next_push.0[lane] = self.pushes[lane].next_time();
        }
    }

    /// Seconds a step of a lane's trial lasts.
    pub(crate) fn time_step(&self, lane: usize) -> f32 {
        self.time_step.0[lane]
    }

    /// Steps of a lane's trial so far.
    pub(crate) fn steps(&self, lane: usize) -> u32 {
        self.steps[lane]
    }

    /// Shows where a lane's creature is after a step.
    ///
    /// # Errors
    /// If the controller wanted what is no finite number, or the step ended with one, or with a part that is too fast to be
    /// true.
    pub(crate) fn show(&self, lane: usize, snapshot: &mut Snapshot) -> Result<(), Failure> {
        if let Some(index) = self.unusable[lane] {
            return Err(Failure::NonFinite { what: format!("output {index}") });
        }
        let fastest = self.fastest.0[lane];
        if fastest.is_nan() {
            let clock = (self.steps[lane] - 1) as f32 * self.time_step.0[lane];
            return Err(Failure::NonFinite { what: format!("position or speed of a part after {clock} s") });
        }
        if fastest > self.unstable_speed {
            return Err(Failure::Unstable { what: format!("a part moves at {fastest} m/s") });
        }
        self.world.look(lane, &mut snapshot.parts);
        snapshot.time = self.time.0[lane];
        snapshot.command = self.command[lane];
        snapshot.push_work = self.push_work[lane];
        snapshot.motor_work += f64::from(self.power.0[lane]) * f64::from(self.time_step.0[lane]);
        Ok(())
    }
}

/// What is compiled for every set of instructions.
impl<const W: usize> Batch<W> {
    #[inline(always)]
    fn sense_and_think(&mut self) {
        let Self { world, senses, net, inputs, outputs, time, since_landing, rest_height, gaps, command, .. } = self;
        let clocks = Clocks { time, since_landing, rest_height, gaps, command };
        senses.read(world, &clocks, inputs);
        if let Some(net) = net {
            net.activate(inputs, outputs);
        }
    }

    /// Asks the motors for what the outputs want.
    #[inline(always)]
    fn act(&mut self) {
        let Self { world, senses, motors, outputs, .. } = self;
        for (drive, output) in motors.drives().iter().zip(outputs) {
            let wanted = output.clamp(-Lanes::ONE, Lanes::ONE);
            let top = Lanes::splat(drive.top_speed);
            let speeds = match motors.actuation() {
                Actuation::Speed => wanted * top,
                Actuation::Angle { gain } => {
                    let [low, high] = drive.limits.map(Lanes::splat);
                    let target = (wanted * Lanes::splat(drive.reach())).clamp(low, high);
                    let lacking = target - senses.joint_angles(world, drive.hinge);
                    (lacking * Lanes::splat(gain)).clamp(-top, top)
                }
            };
            world.set_motor_speeds(drive.hinge, speeds);
        }
    }

    #[inline(always)]
    fn measure(&mut self) {
        let Self { world, actuated, power, fastest, .. } = self;
        *fastest = world.fastest();
        *power = Lanes::ZERO;
        for actuated in actuated.iter() {
            *power += world.motor_powers(actuated.hinge);
        }
    }
}
