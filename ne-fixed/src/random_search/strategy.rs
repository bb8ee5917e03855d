use super::{RandomSearchSettings, state::State};
use crate::WeightVector;
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
    pub(super) topology: Topology,
    /// The generation last asked. Once told, what stands here is memory to be used again.
    pub(super) population: Vec<WeightVector>,
    /// Whether `population` was asked and not told yet.
    pub(super) asked: bool,
}

impl RandomSearch {
    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range.
    pub fn new(settings: RandomSearchSettings, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        let topology = topology.into();
        settings.validate()?;
        topology.validate().map_err(|error| error.within("topology"))?;
        Ok(Self { settings, topology, population: Vec::new(), asked: false })
    }

    /// The settings.
    pub fn settings(&self) -> &RandomSearchSettings {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.topology
    }
}

impl Strategy for RandomSearch {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "random-search"
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        self.population.resize_with(self.settings.population, || WeightVector::zero(self.topology.clone()));
        for (index, net) in self.population.iter_mut().enumerate() {
            self.settings.initialization.draw(net, &mut seed.individual(index as u64).stream(DRAW));
        }
        self.asked = true;
        &self.population
    }

    fn tell(&mut self, evaluations: &[Evaluation], _seed: Seed) {
        debug_assert_eq!(evaluations.len(), self.population.len());
        self.asked = false;
    }

    fn statistics(&self) -> Vec<Statistic> {
        Vec::new()
    }
}
