//! The evaluation of a generation: its trials in the lanes of as many threads as there are.
//!
//! Trials are handed out one by one from a queue, so that lanes and threads stay busy until hardly any are left. Which
//! trial is played in which lane is chance, and changes no result: a lane knows nothing of its neighbours, and the
//! trials of an individual are added up in their order once all have been played.

use crate::{
    controllers::Controllers,
    episode::LaneEpisode,
    lane_player::LanePlayer,
    workload::{Workload, alike, with_most_left},
};
use ne_core::{Evaluation, Failure, Phenotype, Seed, Task, Threads};
use std::sync::{
    Mutex, PoisonError,
    atomic::{AtomicUsize, Ordering::Relaxed},
};
use tasks::{Environment, Outcome, Tally, Trial};

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
    let controllers = Controllers::of(phenotypes);
    let done: Mutex<Vec<(usize, u32, Trial)>> = Mutex::default();
    let workloads: Vec<_> =
        alike(&starts).into_iter().map(|trials| Workload::new(&controllers, &starts, &fit, trials)).collect();
    // Copies of a net can be in several workloads at once.
    let at_once = if matches!(controllers, Controllers::Nets { .. }) { workloads.len() } else { 1 };
    for workloads in workloads.chunks(at_once.max(1)) {
        threads.each(&|| {
            while let Some(workload) = with_most_left(workloads) {
                let played = LanePlayer::play(episode, workload);
                done.lock().unwrap_or_else(PoisonError::into_inner).extend(played);
            }
        });
    }
    for workload in &workloads {
        tracing::debug!(
            trials = workload.jobs.len(),
            occupancy = workload.occupancy(),
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
