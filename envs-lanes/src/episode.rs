use crate::{LANES, engine::LaneEngine, engine::LaneEnvironment, herd::Herd, instructions::Instructions};
use envs_core::Settled;
use ne_core::{Evaluation, Failure, Phenotype, Seed, SettingError, Task};
use ne_net::{DenseNet, GraphNet, Network, Topology};
use std::{any::Any, borrow::Cow};
use tasks::{Environment, Movement, Outcome, Snapshot, Tally, Trials, Verdict};

/// A creature, a movement and trials, for a whole population at once: the task that [`tasks::Episode`] is for one
/// creature at a time, with the same results.
///
/// Each lane plays the trials of one individual, one after the other; when it is done the next individual takes the
/// lane, so that no lane waits for another whose creature has not fallen yet. Nets of one topology think in lanes as
/// well; where topologies differ, as in NEAT, and for controllers of other kinds each thinks for itself.
#[derive(Clone)]
pub struct LaneEpisode {
    environment: LaneEnvironment,
    movement: Box<dyn Movement>,
    steps: u32,
    trials: Trials,
    instructions: Instructions,
}

/// So many individuals that in most of a batch all lanes are busy.
const BATCH: usize = 256;

impl LaneEpisode {
    /// Episodes of `steps` steps (at least 1).
    ///
    /// # Errors
    /// If steps or trials are out of range.
    pub fn new(
        environment: LaneEnvironment,
        mut movement: Box<dyn Movement>,
        steps: u32,
        trials: Trials,
    ) -> Result<Self, SettingError> {
        SettingError::check_at_least("steps", steps as usize, 1)?;
        trials.validate().map_err(|error| error.within("trials"))?;
        if let Some(body) = environment.body() {
            movement.meet(body);
        }
        Ok(Self { environment, movement, steps, trials, instructions: Instructions::best() })
    }

    /// The same episodes, stepped with other instructions of the processor: the same results at another speed.
    #[must_use]
    pub fn with_instructions(self, instructions: Instructions) -> Self {
        Self { instructions, ..self }
    }

    /// The instructions it is stepped with.
    pub fn instructions(&self) -> Instructions {
        self.instructions
    }

    /// The environment episodes start from.
    pub fn environment(&self) -> &LaneEnvironment {
        &self.environment
    }

    /// The longest an episode lasts, in steps.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// The same episodes, lasting at most `steps` steps, and at least 1.
    #[must_use]
    pub fn shortened(&self, steps: u32) -> Self {
        Self { steps: self.steps.min(steps).max(1), ..self.clone() }
    }

    /// The same episodes, with the first `count` trials of an evaluation alone, and at least 1.
    #[must_use]
    pub fn with_fewer_trials(&self, count: u32) -> Self {
        let trials = Trials { count: self.trials.count.min(count).max(1), ..self.trials };
        Self { trials, ..self.clone() }
    }
}

impl Task for LaneEpisode {
    fn inputs(&self) -> usize {
        self.environment.inputs()
    }

    fn outputs(&self) -> usize {
        self.environment.outputs()
    }

    /// As [`tasks::Episode`] does.
    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        let mut evaluations = self.evaluate_batch(&mut [phenotype], seed);
        evaluations.remove(0)
    }

    fn evaluate_batch(&self, phenotypes: &mut [&mut dyn Phenotype], seed: Seed) -> Vec<Evaluation> {
        let mut evaluations: Vec<Option<Evaluation>> =
            phenotypes.iter().map(|phenotype| self.check_shape(&**phenotype).err().map(Evaluation::failed)).collect();
        let waiting = (0..phenotypes.len()).filter(|&individual| evaluations[individual].is_none()).collect();
        let starts = (0..self.trials.count).map(|trial| self.environment.settled(seed.trial(trial))).collect();
        let topology = common_topology(phenotypes);
        let mut stage = Stage::new(self, phenotypes, topology.as_ref(), starts, waiting);
        stage.play(|individual, evaluation| evaluations[individual] = Some(evaluation));
        let unplayed = || Evaluation::failed(Failure::Other { what: "it was never played".into() });
        evaluations.into_iter().map(|evaluation| evaluation.unwrap_or_else(unplayed)).collect()
    }

    fn batch_size(&self) -> usize {
        BATCH
    }
}

/// A batch being played.
struct Stage<'a, 'b> {
    episode: &'a LaneEpisode,
    phenotypes: &'a mut [&'b mut dyn Phenotype],
    /// What each trial begins with.
    starts: Vec<Result<Settled<LaneEngine>, Failure>>,
    waiting: std::vec::IntoIter<usize>,
    herd: Option<Herd<LANES>>,
    seats: Vec<Option<Seat>>,
}

/// An individual in a lane.
struct Seat {
    individual: usize,
    tally: Tally,
    movement: Box<dyn Movement>,
    snapshot: Snapshot,
}

impl<'a, 'b> Stage<'a, 'b> {
    fn new(
        episode: &'a LaneEpisode,
        phenotypes: &'a mut [&'b mut dyn Phenotype],
        topology: Option<&Topology>,
        starts: Vec<Result<Settled<LaneEngine>, Failure>>,
        waiting: Vec<usize>,
    ) -> Self {
        let anyone = starts.iter().find_map(|start| start.as_ref().ok());
        let herd = anyone.map(|settled| Herd::new(&episode.environment, settled, topology, episode.instructions));
        Self {
            episode,
            phenotypes,
            starts,
            waiting: waiting.into_iter(),
            herd,
            seats: (0..LANES).map(|_| None).collect(),
        }
    }

    /// Plays until nobody waits and all seats are empty; tells each evaluation with the index of its individual.
    fn play(&mut self, mut tell: impl FnMut(usize, Evaluation)) {
        for lane in 0..LANES {
            self.seat_next(lane, &mut tell);
        }
        while self.seats.iter().any(Option::is_some) {
            self.step();
            for lane in 0..LANES {
                if let Some(outcome) = self.judge(lane) {
                    self.end_trial(lane, outcome, &mut tell);
                }
            }
        }
    }

    fn step(&mut self) {
        let Self { herd: Some(herd), seats, phenotypes, .. } = self else { return };
        herd.think(|lane, inputs, outputs| {
            if let Some(seat) = &seats[lane] {
                phenotypes[seat.individual].activate(inputs, outputs);
            }
        });
        herd.step();
    }

    /// How a lane's trial has ended, if it has.
    fn judge(&mut self, lane: usize) -> Option<Outcome> {
        let (Some(herd), Some(seat)) = (&self.herd, &mut self.seats[lane]) else { return None };
        let (steps, time_step) = (herd.steps(lane), herd.time_step(lane));
        if let Err(failure) = herd.show(lane, &mut seat.snapshot) {
            return Some(Outcome { steps, time_step, failure: Some(failure) });
        }
        let failure = match seat.movement.observe(&seat.snapshot) {
            Verdict::Fail(reason) => Some(Failure::Unstable { what: reason.into() }),
            Verdict::GoOn if steps < self.episode.steps => return None,
            Verdict::GoOn | Verdict::End => None,
        };
        Some(Outcome { steps, time_step, failure })
    }

    /// Counts a trial, and begins the next, or seats the next individual.
    fn end_trial(&mut self, lane: usize, outcome: Outcome, tell: &mut impl FnMut(usize, Evaluation)) {
        let Some(seat) = &mut self.seats[lane] else { return };
        match seat.tally.add(outcome, &*seat.movement) {
            Some(evaluation) => {
                tell(seat.individual, evaluation);
                self.seat_next(lane, tell);
            }
            None => self.begin_trial(lane, tell),
        }
    }

    fn seat_next(&mut self, lane: usize, tell: &mut impl FnMut(usize, Evaluation)) {
        self.seats[lane] = None;
        let Some(individual) = self.waiting.next() else { return };
        if let Some(herd) = &mut self.herd
            && herd.thinks()
            && let Some(network) = network(&*self.phenotypes[individual])
        {
            herd.load(lane, &network);
        }
        self.seats[lane] = Some(Seat {
            individual,
            tally: Tally::new(self.episode.trials),
            movement: self.episode.movement.clone(),
            snapshot: Snapshot::default(),
        });
        self.begin_trial(lane, tell);
    }

    fn begin_trial(&mut self, lane: usize, tell: &mut impl FnMut(usize, Evaluation)) {
        let Some(seat) = &mut self.seats[lane] else { return };
        match &self.starts[seat.tally.next_trial() as usize] {
            Ok(settled) => {
                self.phenotypes[seat.individual].reset();
                if let Some(herd) = &mut self.herd {
                    herd.begin(lane, settled);
                }
                seat.snapshot.clone_from(&settled.snapshot);
                seat.movement.begin(&seat.snapshot);
            }
            Err(failure) => {
                let time_step = self.episode.environment.settings().time_step;
                let outcome = Outcome { steps: 0, time_step, failure: Some(failure.clone()) };
                self.end_trial(lane, outcome, tell);
            }
        }
    }
}

/// The topology of all these controllers, if they are nets and have one in common.
fn common_topology(phenotypes: &[&mut dyn Phenotype]) -> Option<Topology> {
    let (first, rest) = phenotypes.split_first()?;
    let topology = network(&**first)?.topology();
    rest.iter().all(|phenotype| network(&**phenotype).is_some_and(|net| net.topology() == topology)).then_some(topology)
}

/// The net that a controller is, if it is one.
fn network(phenotype: &dyn Phenotype) -> Option<Cow<'_, Network>> {
    let phenotype: &dyn Any = phenotype;
    if let Some(network) = phenotype.downcast_ref::<Network>() {
        return Some(Cow::Borrowed(network));
    }
    let dense = phenotype.downcast_ref::<DenseNet>().map(|net| Network::Dense(net.clone()));
    dense.or_else(|| phenotype.downcast_ref::<GraphNet>().map(|net| Network::Graph(net.clone()))).map(Cow::Owned)
}
