use crate::{controllers::Controllers, engine::LaneEngine};
use envs_core::Settled;
use ne_core::Failure;
use std::{
    ops::Range,
    sync::atomic::{AtomicU32, AtomicU64, AtomicUsize, Ordering::Relaxed},
};

/// What a trial begins with, if it can begin.
pub(crate) type Start = Result<Settled<LaneEngine>, Failure>;

/// What is to be played, and how much of it has been handed out.
pub(crate) struct Workload<'a, 'b> {
    pub(crate) controllers: &'a Controllers<'b>,
    pub(crate) starts: &'a [Start],
    pub(crate) trials: Vec<u32>,
    pub(crate) jobs: Vec<Job>,
    next: AtomicUsize,
    /// Threads that play it.
    pub(crate) players: AtomicUsize,
    /// For each individual the first trial that failed, after which no other counts.
    pub(crate) failed: Vec<AtomicU32>,
    /// Steps of lanes, and those of lanes that played.
    pub(crate) stepped: AtomicU64,
    pub(crate) played: AtomicU64,
}

/// Trials of an individual that are played one after the other, by their place among the trials of the workload.
pub(crate) struct Job {
    pub(crate) individual: usize,
    pub(crate) trials: Range<usize>,
}

impl<'a, 'b> Workload<'a, 'b> {
    pub(crate) fn new(controllers: &'a Controllers<'b>, starts: &'a [Start], fit: &[usize], trials: Vec<u32>) -> Self {
        let job = |trials: Range<usize>| fit.iter().map(move |&individual| Job { individual, trials: trials.clone() });
        let jobs = match controllers {
            // The first trial of all comes first: of those that fail in it no other is played.
            Controllers::Nets { .. } => (0..trials.len()).flat_map(|trial| job(trial..trial + 1)).collect(),
            Controllers::Others(_) => job(0..trials.len()).collect(),
        };
        let individuals = fit.last().map_or(0, |last| last + 1);
        let failed = (0..individuals).map(|_| AtomicU32::new(u32::MAX)).collect();
        let [stepped, played] = [AtomicU64::new(0), AtomicU64::new(0)];
        let [next, players] = [AtomicUsize::new(0), AtomicUsize::new(0)];
        Self { controllers, starts, trials, jobs, next, players, failed, stepped, played }
    }

    /// How many jobs have not been handed out.
    fn left(&self) -> usize {
        self.jobs.len().saturating_sub(self.next.load(Relaxed))
    }

    /// The next job that is worth doing.
    pub(crate) fn next(&self) -> Option<&Job> {
        loop {
            let job = self.jobs.get(self.next.fetch_add(1, Relaxed))?;
            let first = self.trials[job.trials.start];
            if self.failed[job.individual].load(Relaxed) > first {
                return Some(job);
            }
        }
    }

    /// The share of the lanes that were busy.
    pub(crate) fn occupancy(&self) -> f64 {
        self.played.load(Relaxed) as f64 / (self.stepped.load(Relaxed) as f64).max(1.0)
    }
}

/// The trials that can be stepped together: level ground and any other cannot.
pub(crate) fn alike(starts: &[Start]) -> Vec<Vec<u32>> {
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

/// Of these, the workload with the most jobs left for each thread that plays it, and one more; `None` if none is left.
pub(crate) fn with_most_left<'p, 'a, 'b>(workloads: &'p [Workload<'a, 'b>]) -> Option<&'p Workload<'a, 'b>> {
    let waiting = workloads.iter().filter(|workload| workload.left() > 0);
    waiting.max_by_key(|workload| workload.left() / (workload.players.load(Relaxed) + 1))
}
