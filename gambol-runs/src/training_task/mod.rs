//! What a population is evaluated on.

mod several;

pub(crate) use several::SeveralBodies;

use crate::config::EngineChoice;
use envs_lanes::LaneEpisode;
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Phenotype, Seed, Task, Threads};
use tasks::Episode;

/// What a population is evaluated on: the same episodes in either engine, with the same results.
#[derive(Clone)]
pub enum TrainingTask {
    /// One creature at a time.
    Rapier(Box<Episode<RapierEnvironment>>),
    /// Many creatures at once.
    Lanes(Box<LaneEpisode>),
    /// In several bodies.
    Several(Box<SeveralBodies>),
}

impl TrainingTask {
    /// The engine it is played in.
    pub fn engine(&self) -> EngineChoice {
        match self {
            Self::Rapier(_) => EngineChoice::Rapier,
            Self::Lanes(_) => EngineChoice::Lanes,
            Self::Several(several) => several.bodies()[0].engine(),
        }
    }

    /// The same episodes, lasting at most `steps` steps, and at least 1.
    #[must_use]
    pub fn shortened(&self, steps: u32) -> Self {
        match self {
            Self::Rapier(episode) => Self::Rapier(Box::new(episode.shortened(steps))),
            Self::Lanes(episode) => Self::Lanes(Box::new(episode.shortened(steps))),
            Self::Several(several) => Self::Several(Box::new(several.map(|task| task.shortened(steps)))),
        }
    }

    /// The same episodes, with the first `count` trials of an evaluation alone, and at least 1.
    #[must_use]
    pub fn with_fewer_trials(&self, count: u32) -> Self {
        match self {
            Self::Rapier(episode) => Self::Rapier(Box::new(episode.with_fewer_trials(count))),
            Self::Lanes(episode) => Self::Lanes(Box::new(episode.with_fewer_trials(count))),
            Self::Several(several) => Self::Several(Box::new(several.map(|task| task.with_fewer_trials(count)))),
        }
    }

    /// The longest an episode lasts, in steps.
    pub fn steps(&self) -> u32 {
        match self {
            Self::Rapier(episode) => episode.steps(),
            Self::Lanes(episode) => episode.steps(),
            Self::Several(several) => several.bodies()[0].steps(),
        }
    }

    fn task(&self) -> &dyn Task {
        match self {
            Self::Rapier(episode) => &**episode,
            Self::Lanes(episode) => &**episode,
            Self::Several(several) => &**several,
        }
    }
}

impl Task for TrainingTask {
    fn inputs(&self) -> usize {
        self.task().inputs()
    }

    fn outputs(&self) -> usize {
        self.task().outputs()
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        self.task().evaluate(phenotype, seed)
    }

    fn evaluate_batch(&self, phenotypes: &mut [&mut dyn Phenotype], seed: Seed) -> Vec<Evaluation> {
        self.task().evaluate_batch(phenotypes, seed)
    }

    fn evaluate_spread(
        &self,
        phenotypes: &mut [&mut dyn Phenotype],
        seed: Seed,
        threads: &dyn Threads,
    ) -> Vec<Evaluation> {
        self.task().evaluate_spread(phenotypes, seed, threads)
    }

    fn batch_size(&self) -> usize {
        self.task().batch_size()
    }
}
