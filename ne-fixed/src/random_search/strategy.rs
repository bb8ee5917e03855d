use super::{RandomSearchSettings, state::State};
use crate::{WeightVector, nets::Nets};
use ne_core::{Evaluation, Purpose, Seed, SettingError, Statistic, Strategy};
use ne_net::Topology;
use serde::{Deserialize, Serialize};

const DRAW: Purpose = Purpose::new("random-search draw");

/// Random search, also called random weight guessing: every net of every generation is drawn anew, and nothing is learnt
/// from what came before. The best of all is the champion.
///
/// It tells how much of a result is owed to the net and the task, and how much to a search.
///
/// # Statistics
/// None.
///
/// Source: Schmidhuber, Hochreiter & Bengio, *Evaluating Benchmark Problems by Random Guessing*, in *A Field Guide to
/// Dynamical Recurrent Neural Networks*, 2001.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "State", try_from = "State")]
pub struct RandomSearch {
    pub(super) settings: RandomSearchSettings,
    pub(super) nets: Nets,
}

impl RandomSearch {
    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range.
    pub fn new(settings: RandomSearchSettings, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, nets: Nets::new(topology)? })
    }

    /// The settings.
    pub fn settings(&self) -> &RandomSearchSettings {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.nets.topology
    }
}

impl Strategy for RandomSearch {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "random-search"
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let mut population = self.nets.make_room(self.settings.population);
        for (index, net) in population.iter_mut().enumerate() {
            self.settings.initialization.draw(net, &mut seed.individual(index as u64).stream(DRAW));
        }
        self.nets.ask(population)
    }

    fn tell(&mut self, evaluations: &[Evaluation], _seed: Seed) {
        debug_assert_eq!(evaluations.len(), self.nets.population.len());
        self.nets.asked = false;
    }

    fn statistics(&self) -> Vec<Statistic> {
        Vec::new()
    }
}
