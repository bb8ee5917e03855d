use crate::{
    LANES,
    batch::Batch,
    engine::{LaneEngine, LaneEnvironment},
    episode::LaneEpisode,
    instructions::Instructions,
};
use envs_core::Settled;
use ne_core::Failure;
use tasks::{Environment, Movement, Snapshot, Verdict, failure_of_value};

/// [`LANES`] creatures whose actions come from outside, one step at a time, each in an episode of its own: for callers whose
/// controllers are no nets of `ne-net`, such as reinforcement learning.
///
/// A lane is empty until [`begin`](Self::begin) puts a creature into it. From then on, again and again: [`act`](Self::act) for
/// every lane, [`step`](Self::step) for all of them, [`sense`](Self::sense), and [`read`](Self::read) for every lane. With the
/// outputs of a net as actions an episode has the bits that [`LaneEpisode`] gives it, and the rewards of its steps add up to
/// its fitness. None of these calls but `begin` allocates memory.
#[derive(Clone)]
pub struct DrivenLanes {
    environment: LaneEnvironment,
    instructions: Instructions,
    steps: u32,
    /// Those on level ground, and those on any other: the two are not stepped together.
    batches: [Option<Batch<LANES>>; 2],
    lanes: Vec<Lane>,
}

/// A creature, or none.
#[derive(Clone)]
struct Lane {
    /// Which of the batches it is in.
    batch: usize,
    movement: Box<dyn Movement>,
    snapshot: Snapshot,
    /// The movement's value after the last step; before the first 0, so that what it begins with is in the first reward.
    value: f64,
    /// Whether an episode is under way.
    plays: bool,
}

/// What a step has brought a creature.
#[derive(Clone, Debug, PartialEq)]
pub struct DrivenStep {
    /// By how much the movement's value has grown, in its unit. The rewards of an episode that does not fail add up to its
    /// fitness, but for rounding (`f64`). Where the movement is no sum over steps, such as the greatest height, the reward is
    /// what this step has changed of the fitness so far. 0 in the step of a failure.
    pub reward: f64,
    /// Whether the episode ends with this step, and why.
    pub end: Option<DrivenEnd>,
}

/// Why an episode has ended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum DrivenEnd {
    /// It has lasted as long as episodes last.
    OutOfTime,
    /// The movement calls for it: the creature fell, say.
    Ended,
    /// It is not to be scored.
    Failed(Failure),
}

impl DrivenLanes {
    /// Empty lanes for such episodes: their body, senses, motors, movement and length. Trials do not count here: which
    /// episodes are played, [`begin`](Self::begin) says.
    pub fn new(episode: &LaneEpisode) -> Self {
        let lane = Lane {
            batch: 0,
            movement: episode.movement.clone(),
            snapshot: Snapshot::default(),
            value: 0.0,
            plays: false,
        };
        Self {
            environment: episode.environment().clone(),
            instructions: episode.instructions(),
            steps: episode.steps(),
            batches: [None, None],
            lanes: vec![lane; LANES],
        }
    }

    /// Begins an episode in a lane, whatever was in it, with the creature at rest in its world; it must be one of the
    /// episode's [environment](LaneEpisode::environment).
    ///
    /// # Panics
    /// If there is no such lane: they count from 0 to [`LANES`] − 1.
    pub fn begin(&mut self, lane: usize, start: &Settled<LaneEngine>) {
        let index = usize::from(!start.engine.world().is_level());
        let batch =
            self.batches[index].get_or_insert_with(|| Batch::new(&self.environment, start, None, self.instructions));
        batch.begin(lane, start);
        let lane = &mut self.lanes[lane];
        lane.batch = index;
        lane.value = 0.0;
        lane.plays = true;
        lane.snapshot.clone_from(&start.snapshot);
        lane.movement.bind(&start.body);
        lane.movement.begin(&lane.snapshot);
    }

    /// What the creature in a lane is to do in the steps to come, as its controller's outputs say it: one number from −1 to 1
    /// for each [motor](envs_core::CreatureEnvironment::motors). What is beyond is clamped, and what is no finite number ends
    /// the episode in the next step. Without effect on an empty lane.
    ///
    /// # Panics
    /// If there is no such lane, or the number of actions is not that of the motors.
    pub fn act(&mut self, lane: usize, actions: &[f32]) {
        if let Some(batch) = &mut self.batches[self.lanes[lane].batch] {
            batch.drive(lane, actions);
        }
    }

    /// One time step of all creatures. `report` is told what it has brought each whose episode was under way, in the order of
    /// the lanes; a creature whose episode is over is stepped along and not reported.
    pub fn step(&mut self, report: &mut dyn FnMut(usize, DrivenStep)) {
        for (index, batch) in self.batches.iter_mut().enumerate() {
            if let Some(batch) = batch
                && self.lanes.iter().any(|lane| lane.plays && lane.batch == index)
            {
                batch.step();
            }
        }
        for (index, lane) in self.lanes.iter_mut().enumerate().filter(|(_, lane)| lane.plays) {
            let Some(batch) = &self.batches[lane.batch] else { continue };
            let step = lane.observe(batch, index, self.steps);
            lane.plays = step.end.is_none();
            report(index, step);
        }
    }

    /// Has all creatures sense where they are now, for [`read`](Self::read).
    pub fn sense(&mut self) {
        self.batches.iter_mut().flatten().for_each(Batch::sense);
    }

    /// What the creature in a lane has last sensed: one number for each of its
    /// [senses](envs_core::CreatureEnvironment::senses), scaled as controllers want them, within ± the input range. After a
    /// failure they may be NaN. Of an empty lane they mean nothing.
    ///
    /// # Panics
    /// If there is no such lane, or the number of inputs is not that of the senses.
    pub fn read(&self, lane: usize, inputs: &mut [f32]) {
        if let Some(batch) = &self.batches[self.lanes[lane].batch] {
            batch.read(lane, inputs);
        }
    }

    /// Whether an episode is under way in a lane.
    ///
    /// # Panics
    /// If there is no such lane.
    pub fn plays(&self, lane: usize) -> bool {
        self.lanes[lane].plays
    }

    /// What the movement in a lane is worth so far, in its unit; 0 before the first step.
    ///
    /// # Panics
    /// If there is no such lane.
    pub fn value(&self, lane: usize) -> f64 {
        self.lanes[lane].value
    }

    /// Where the parts of the creature in a lane are: at the start, and after each step that did not fail.
    ///
    /// # Panics
    /// If there is no such lane.
    pub fn snapshot(&self, lane: usize) -> &Snapshot {
        &self.lanes[lane].snapshot
    }

    /// How many numbers a creature senses.
    pub fn inputs(&self) -> usize {
        self.environment.inputs()
    }

    /// How many motors a creature has.
    pub fn outputs(&self) -> usize {
        self.environment.outputs()
    }
}

impl DrivenStep {
    /// A step that failed.
    pub fn failed(failure: Failure) -> Self {
        Self { reward: 0.0, end: Some(DrivenEnd::Failed(failure)) }
    }

    /// What a step has brought by a movement, for an environment of any kind. `value`: the movement's before the step, and after it
    /// that after it. `is_last`: whether episodes last no longer.
    pub fn judged(movement: &mut dyn Movement, snapshot: &Snapshot, value: &mut f64, is_last: bool) -> Self {
        let end = match movement.observe(snapshot) {
            Verdict::Fail(reason) => return Self::failed(Failure::Other { what: reason.into() }),
            Verdict::End => Some(DrivenEnd::Ended),
            Verdict::GoOn => is_last.then_some(DrivenEnd::OutOfTime),
        };
        let now = movement.value();
        if !now.is_finite() {
            return Self::failed(failure_of_value(movement));
        }
        let reward = now - std::mem::replace(value, now);
        Self { reward, end }
    }
}

impl Lane {
    /// Looks at the creature after a step, as [`LaneEpisode`] does.
    fn observe(&mut self, batch: &Batch<LANES>, lane: usize, steps: u32) -> DrivenStep {
        if let Err(failure) = batch.show(lane, &mut self.snapshot) {
            return DrivenStep::failed(failure);
        }
        DrivenStep::judged(&mut *self.movement, &self.snapshot, &mut self.value, batch.steps(lane) >= steps)
    }
}
