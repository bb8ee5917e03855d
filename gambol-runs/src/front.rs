//! The front file: the compromises between objectives a run has found, each with its net.

use crate::{
    champion::Champion,
    config::RunConfig,
    setup::{Objective, Setup},
};
use ne_core::{
    Fitness, FrontPoint, Genome, Seed, Task,
    archive::{self, ArchiveError, Layout},
};
use ne_net::Network;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The format of a front file.
pub const FRONT_FORMAT: &str = "gambol front";

/// The version of the front file this Gambol writes and reads.
pub const FRONT_VERSION: u32 = 2;

/// What a strategy that searches for several objectives had found by its last checkpoint: no individual in it is better
/// than another in one objective without being worse in another.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Front {
    /// The generations done by then.
    pub generation: u64,
    /// What was searched for.
    pub objectives: Vec<Objective>,
    /// From the best in the first objective to the worst.
    pub points: Vec<SavedPoint>,
}

/// One of the compromises.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SavedPoint {
    /// The generation it was evaluated in, from 1: in the worlds of that one the task of training gives its numbers
    /// again.
    pub generation: u64,
    /// Its fitness.
    pub fitness: Fitness,
    /// What it came to in each objective, weighed, all maximised.
    pub objectives: Vec<Fitness>,
    /// The controller.
    pub network: Network,
}

impl Front {
    /// What a strategy has found.
    pub fn new<G: Genome<Phenotype: Into<Network>>>(
        generation: u64,
        objectives: &[Objective],
        points: &[FrontPoint<'_, G>],
    ) -> Self {
        let saved = |point: &FrontPoint<'_, G>| SavedPoint {
            generation: point.generation,
            fitness: point.fitness,
            objectives: point.objectives.to_vec(),
            network: point.genome.express().into(),
        };
        Self { generation, objectives: objectives.to_vec(), points: points.iter().map(saved).collect() }
    }

    /// Reads a front file.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or is of another format or version; the error names file and field.
    pub fn read(path: &Path) -> Result<Self, ArchiveError> {
        let front: Self = archive::read(path, FRONT_FORMAT, FRONT_VERSION)?;
        let count = front.objectives.len();
        match front.points.iter().position(|point| point.objectives.len() != count) {
            None => Ok(front),
            Some(index) => {
                let found = front.points[index].objectives.len();
                let message = format!("field points[{index}].objectives: found {found} numbers, expected {count}");
                Err(ArchiveError::Content { path: path.into(), message })
            }
        }
    }

    /// Writes the front file, whole or not at all.
    ///
    /// # Errors
    /// If it cannot be written; an older file is then still there.
    pub fn write(&self, path: &Path) -> Result<(), ArchiveError> {
        archive::write(path, FRONT_FORMAT, FRONT_VERSION, self, Layout::Compact)
    }
}

impl SavedPoint {
    /// The point as a champion, with all that is needed to move and to verify it. Where a champion selection chooses the
    /// champion, it is one in the world, the episode and the body champions are judged in.
    pub fn champion(&self, config: &RunConfig, setup: &Setup) -> Champion {
        let (seed, judged) = match &setup.reference {
            Some(reference) => {
                (reference.seed, reference.task.evaluate(&mut self.network.clone(), reference.seed).fitness())
            }
            None => (Seed::of_run(config.seed).generation(self.generation), None),
        };
        let found = ne_core::Champion {
            genome: Fixed(self.network.clone()),
            fitness: judged.unwrap_or(self.fitness),
            generation: self.generation,
            seed,
            trained: setup.reference.as_ref().map(|_| self.fitness),
            diverged: false,
            tier: 0,
        };
        Champion::new(config, setup, config.strategy.name(), &found)
    }
}

/// A net in place of the genome that built it.
#[derive(Clone, Serialize, Deserialize)]
struct Fixed(Network);

impl Genome for Fixed {
    type Phenotype = Network;

    fn express(&self) -> Network {
        self.0.clone()
    }
}
