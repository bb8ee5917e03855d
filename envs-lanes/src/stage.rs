//! A generation on stage: its trials in the lanes of as many threads as there are.
//!
//! Trials are handed out one by one from a queue, so that lanes and threads stay busy until hardly any are left. Which
//! trial is played in which lane is chance, and changes no result: a lane knows nothing of its neighbours, and the
//! trials of an individual are added up in their order once all have been played.

use crate::{LANES, batch::Batch, engine::LaneEngine, episode::LaneEpisode};
use envs_core::Settled;
use ne_core::{Evaluation, Failure, Phenotype, Seed, Task, Threads};
use ne_net::{DenseNet, GraphNet, Network, Topology};
use std::{
    any::Any,
    borrow::Cow,
    ops::Range,
    sync::atomic::{AtomicU32, AtomicU64, AtomicUsize, Ordering::Relaxed},
    sync::{Mutex, PoisonError},
};
use tasks::{Environment, Movement, Outcome, Snapshot, Tally, Trial, Verdict};

/// So many individuals that in most of a batch all lanes are busy.
const BATCH: usize = 256;

impl Task for LaneEpisode {
    fn inputs(&self) -> usize {
        self.environment().inputs()
    }

    fn outputs(&self) -> usize {
        self.environment().outputs()
    }

    /// As [`tasks::Episode`] does.
    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        let mut evaluations = self.evaluate_batch(&mut [phenotype], seed);
        evaluations.remove(0)
    }

    fn evaluate_batch(&self, phenotypes: &mut [&mut dyn Phenotype], seed: Seed) -> Vec<Evaluation> {
        self.evaluate_spread(phenotypes, seed, &())
    }

    fn evaluate_spread(
        &self,
        phenotypes: &mut [&mut dyn Phenotype],
        seed: Seed,
        threads: &dyn Threads,
    ) -> Vec<Evaluation> {
        evaluate(self, phenotypes, seed, threads)
    }

    fn batch_size(&self) -> usize {
        BATCH
    }
}

/// Evaluates these controllers.
fn evaluate(
    episode: &LaneEpisode,
    phenotypes: &mut [&mut dyn Phenotype],
    seed: Seed,
    threads: &dyn Threads,
) -> Vec<Evaluation> {
    let unfit: Vec<Option<Failure>> =
        phenotypes.iter().map(|phenotype| episode.check_shape(&**phenotype).err()).collect();
    let fit: Vec<usize> = (0..unfit.len()).filter(|&individual| unfit[individual].is_none()).collect();
    let count = episode.trials.count;
    let starts = spread(threads, count as usize, |trial| episode.environment().settled(seed.trial(trial as u32)));
    let cast = Cast::of(phenotypes);
    let done: Mutex<Vec<(usize, u32, Trial)>> = Mutex::default();
    let programmes: Vec<_> =
        alike(&starts).into_iter().map(|trials| Programme::new(&cast, &starts, &fit, trials)).collect();
    // Copies of a net can be in several programmes at once.
    let at_once = if matches!(cast, Cast::Nets { .. }) { programmes.len() } else { 1 };
    for programmes in programmes.chunks(at_once.max(1)) {
        threads.each(&|| {
            while let Some(programme) = neediest(programmes) {
                let played = Stage::play(episode, programme);
                done.lock().unwrap_or_else(PoisonError::into_inner).extend(played);
            }
        });
    }
    for programme in &programmes {
        tracing::debug!(
            trials = programme.jobs.len(),
            occupancy = programme.occupancy(),
            "a generation has been played in lanes"
        );
    }
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_unstable_by_key(|&(individual, trial, _)| (individual, trial));
    let mut done = done.into_iter().peekable();
    let mut evaluations = Vec::new();
    for (individual, unfit) in unfit.into_iter().enumerate() {
        if let Some(failure) = unfit {
            evaluations.push(Evaluation::failed(failure));
            continue;
        }
        let mut tally = Tally::new(episode.trials);
        let mut evaluation = None;
        for trial in 0..count {
            let played = match &starts[trial as usize] {
                Ok(_) => {
                    done.next_if(|&(of, number, _)| (of, number) == (individual, trial)).map(|(_, _, trial)| trial)
                }
                Err(failure) => {
                    let time_step = episode.environment().settings().time_step;
                    let outcome = Outcome { steps: 0, time_step, failure: Some(failure.clone()) };
                    Some(Trial::new(outcome, &*episode.movement))
                }
            };
            // What comes after the end of an evaluation was played in vain, if it was played.
            if evaluation.is_none() {
                evaluation = played.and_then(|played| tally.add(&played));
            }
        }
        let unplayed = || Evaluation::failed(Failure::Other { what: "it was never played".into() });
        evaluations.push(evaluation.unwrap_or_else(unplayed));
    }
    evaluations
}

type Start = Result<Settled<LaneEngine>, Failure>;

/// The trials that can be stepped together: level ground and any other cannot.
fn alike(starts: &[Start]) -> Vec<Vec<u32>> {
    let mut groups: Vec<(&LaneEngine, Vec<u32>)> = Vec::new();
    for (trial, start) in (0..).zip(starts) {
        let Ok(Settled { engine, .. }) = start else { continue };
        match groups.iter_mut().find(|(first, _)| first.is_like(engine)) {
            Some((_, group)) => group.push(trial),
            None => groups.push((engine, vec![trial])),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Of these, the programme with the most jobs left for each thread that plays it, and one more; `None` if none is left.
fn neediest<'p, 'a, 'b>(programmes: &'p [Programme<'a, 'b>]) -> Option<&'p Programme<'a, 'b>> {
    let waiting = programmes.iter().filter(|programme| programme.left() > 0);
    waiting.max_by_key(|programme| programme.left() / (programme.players.load(Relaxed) + 1))
}

/// Does `count` things on these threads; their results in order.
fn spread<R: Send>(threads: &dyn Threads, count: usize, work: impl Fn(usize) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let done: Mutex<Vec<(usize, R)>> = Mutex::default();
    threads.each(&|| {
        loop {
            let index = next.fetch_add(1, Relaxed);
            if index >= count {
                return;
            }
            let result = work(index);
            done.lock().unwrap_or_else(PoisonError::into_inner).push((index, result));
        }
    });
    let mut done = done.into_inner().unwrap_or_else(PoisonError::into_inner);
    done.sort_unstable_by_key(|&(index, _)| index);
    done.into_iter().map(|(_, result)| result).collect()
}

/// The controllers.
enum Cast<'a> {
    /// Nets, of which there can be copies.
    Nets {
        nets: Vec<Cow<'a, Network>>,
        /// What they all have; then they think in lanes.
        topology: Option<Topology>,
    },
    /// Others, each of which can be in one place at a time.
    Others(Vec<Mutex<Option<&'a mut dyn Phenotype>>>),
}

impl<'a> Cast<'a> {
    fn of(phenotypes: &'a mut [&mut dyn Phenotype]) -> Self {
        if phenotypes.iter().any(|phenotype| network(&**phenotype).is_none()) {
            return Self::Others(phenotypes.iter_mut().map(|phenotype| Mutex::new(Some(&mut **phenotype))).collect());
        }
        let nets: Vec<_> = phenotypes.iter().filter_map(|phenotype| network(&**phenotype)).collect();
        let topology = nets.first().map(|net| net.topology());
        let topology = topology.filter(|common| nets.iter().all(|net| net.topology() == *common));
        Self::Nets { nets, topology }
    }

    fn topology(&self) -> Option<&Topology> {
        match self {
            Self::Nets { topology, .. } => topology.as_ref(),
            Self::Others(_) => None,
        }
    }
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

/// What is to be played, and how much of it has been handed out.
struct Programme<'a, 'b> {
    cast: &'a Cast<'b>,
    starts: &'a [Start],
    trials: Vec<u32>,
    jobs: Vec<Job>,
    next: AtomicUsize,
    /// Threads that play it.
    players: AtomicUsize,
    /// For each individual the first trial that failed, after which no other counts.
    failed: Vec<AtomicU32>,
    /// Steps of lanes, and those of lanes that played.
    stepped: AtomicU64,
    played: AtomicU64,
}

/// Trials of an individual that are played one after the other, by their place among the trials of the programme.
struct Job {
    individual: usize,
    trials: Range<usize>,
}

impl<'a, 'b> Programme<'a, 'b> {
    fn new(cast: &'a Cast<'b>, starts: &'a [Start], fit: &[usize], trials: Vec<u32>) -> Self {
        let job = |trials: Range<usize>| fit.iter().map(move |&individual| Job { individual, trials: trials.clone() });
        let jobs = match cast {
            // The first trial of all comes first: of those that fail in it no other is played.
            Cast::Nets { .. } => (0..trials.len()).flat_map(|trial| job(trial..trial + 1)).collect(),
            Cast::Others(_) => job(0..trials.len()).collect(),
        };
        let individuals = fit.last().map_or(0, |last| last + 1);
        let failed = (0..individuals).map(|_| AtomicU32::new(u32::MAX)).collect();
        let [stepped, played] = [AtomicU64::new(0), AtomicU64::new(0)];
        let [next, players] = [AtomicUsize::new(0), AtomicUsize::new(0)];
        Self { cast, starts, trials, jobs, next, players, failed, stepped, played }
    }

    /// How many jobs have not been handed out.
    fn left(&self) -> usize {
        self.jobs.len().saturating_sub(self.next.load(Relaxed))
    }

    /// The next job that is worth doing.
    fn next(&self) -> Option<&Job> {
        loop {
            let job = self.jobs.get(self.next.fetch_add(1, Relaxed))?;
            let first = self.trials[job.trials.start];
            if self.failed[job.individual].load(Relaxed) > first {
                return Some(job);
            }
        }
    }

    /// The share of the lanes that were busy.
    fn occupancy(&self) -> f64 {
        self.played.load(Relaxed) as f64 / (self.stepped.load(Relaxed) as f64).max(1.0)
    }
}

/// The lanes of a thread.
struct Stage<'a, 'b> {
    episode: &'a LaneEpisode,
    programme: &'a Programme<'a, 'b>,
    batch: Batch<LANES>,
    slots: Vec<Slot<'b>>,
    done: Vec<(usize, u32, Trial)>,
}

/// A lane.
struct Slot<'b> {
    /// What is played in it.
    playing: Option<Playing<'b>>,
    movement: Box<dyn Movement>,
    snapshot: Snapshot,
}

struct Playing<'b> {
    individual: usize,
    /// The trial under way and those that follow.
    trials: Range<usize>,
    mind: Mind<'b>,
}

/// Where a controller thinks.
enum Mind<'b> {
    InLanes,
    OfItsOwn(Box<Network>),
    Other(&'b mut dyn Phenotype),
}

impl<'a, 'b> Stage<'a, 'b> {
    /// Plays until nothing is left to be handed out and all lanes are empty; the trials it has played.
    fn play(episode: &'a LaneEpisode, programme: &'a Programme<'a, 'b>) -> Vec<(usize, u32, Trial)> {
        let Some(Ok(settled)) = programme.trials.first().map(|&first| &programme.starts[first as usize]) else {
            return Vec::new();
        };
        programme.players.fetch_add(1, Relaxed);
        let batch = Batch::new(episode.environment(), settled, programme.cast.topology(), episode.instructions());
        let slot = || Slot { playing: None, movement: episode.movement.clone(), snapshot: Snapshot::default() };
        let slots = (0..LANES).map(|_| slot()).collect();
        let mut stage = Self { episode, programme, batch, slots, done: Vec::new() };
        for lane in 0..LANES {
            stage.slot_next(lane);
        }
        let (mut stepped, mut played) = (0, 0);
        loop {
            let busy = stage.slots.iter().filter(|slot| slot.playing.is_some()).count();
            if busy == 0 {
                break;
            }
            stepped += LANES as u64;
            played += busy as u64;
            stage.step();
            for lane in 0..LANES {
                if let Some(outcome) = stage.judge(lane) {
                    stage.end_trial(lane, outcome);
                }
            }
        }
        programme.players.fetch_sub(1, Relaxed);
        programme.stepped.fetch_add(stepped, Relaxed);
        programme.played.fetch_add(played, Relaxed);
        stage.done
    }

    fn step(&mut self) {
        let Self { batch, slots, .. } = self;
        batch.think(|lane, inputs, outputs| match &mut slots[lane].playing {
            Some(Playing { mind: Mind::OfItsOwn(network), .. }) => network.activate(inputs, outputs),
            Some(Playing { mind: Mind::Other(phenotype), .. }) => phenotype.activate(inputs, outputs),
            Some(Playing { mind: Mind::InLanes, .. }) | None => {}
        });
        batch.step();
    }

    /// How a lane's trial has ended, if it has.
    fn judge(&mut self, lane: usize) -> Option<Outcome> {
        let (batch, slot) = (&self.batch, &mut self.slots[lane]);
        slot.playing.as_ref()?;
        let (steps, time_step) = (batch.steps(lane), batch.time_step(lane));
        if let Err(failure) = batch.show(lane, &mut slot.snapshot) {
            return Some(Outcome { steps, time_step, failure: Some(failure) });
        }
        let failure = match slot.movement.observe(&slot.snapshot) {
            Verdict::Fail(reason) => Some(Failure::Unstable { what: reason.into() }),
            Verdict::GoOn if steps < self.episode.steps() => return None,
            Verdict::GoOn | Verdict::End => None,
        };
        Some(Outcome { steps, time_step, failure })
    }

    /// Counts a trial, and begins the next.
    fn end_trial(&mut self, lane: usize, outcome: Outcome) {
        let programme = self.programme;
        let slot = &mut self.slots[lane];
        let Some(playing) = &mut slot.playing else { return };
        let (individual, trial) = (playing.individual, programme.trials[playing.trials.start]);
        let ended = Trial::new(outcome, &*slot.movement);
        playing.trials.start += 1;
        if ended.failed() {
            programme.failed[individual].fetch_min(trial, Relaxed);
            playing.trials.start = playing.trials.end;
        }
        self.done.push((individual, trial, ended));
        if playing.trials.is_empty() {
            self.slot_next(lane);
        } else {
            self.begin_trial(lane);
        }
    }

    fn slot_next(&mut self, lane: usize) {
        let programme = self.programme;
        if let Some(Playing { individual, mind: Mind::Other(phenotype), .. }) = self.slots[lane].playing.take()
            && let Cast::Others(others) = programme.cast
        {
            *others[individual].lock().unwrap_or_else(PoisonError::into_inner) = Some(phenotype);
        }
        let Some(&Job { individual, ref trials }) = programme.next() else { return };
        let mind = match programme.cast {
            Cast::Nets { nets, .. } if self.batch.thinks() => {
                self.batch.load(lane, &nets[individual]);
                Mind::InLanes
            }
            Cast::Nets { nets, .. } => Mind::OfItsOwn(Box::new(nets[individual].clone().into_owned())),
            Cast::Others(others) => {
                match others[individual].lock().unwrap_or_else(PoisonError::into_inner).take() {
                    Some(phenotype) => Mind::Other(phenotype),
                    // Each individual is in one job.
                    None => return,
                }
            }
        };
        self.slots[lane].playing = Some(Playing { individual, trials: trials.clone(), mind });
        self.begin_trial(lane);
    }

    fn begin_trial(&mut self, lane: usize) {
        let Slot { playing: Some(Playing { trials, mind, .. }), movement, snapshot } = &mut self.slots[lane] else {
            return;
        };
        match mind {
            Mind::InLanes => {}
            Mind::OfItsOwn(network) => network.reset(),
            Mind::Other(phenotype) => phenotype.reset(),
        }
        let Ok(settled) = &self.programme.starts[self.programme.trials[trials.start] as usize] else { return };
        self.batch.begin(lane, settled);
        snapshot.clone_from(&settled.snapshot);
        movement.begin(snapshot);
    }
}
