//! Simulated annealing: a walk through the weights of a net that gets ever more careful.
//!
//! Source: Kirkpatrick, Gelatt & Vecchi, *Optimization by Simulated Annealing*, Science 220, 1983.

use gambol::strategies::{NetStrategy, Transfer, weights_of};
use ne_core::{Evaluation, Fitness, Purpose, Seed, SettingError, Strategy};
use ne_fixed::WeightVector;
use ne_net::Topology;
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// What a configuration says of it: `{"annealing": {"population": 30, "cooling": 0.9}}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub(crate) struct Settings {
    /// Neighbours a generation, from 1 to 10000.
    population: usize,
    /// What the temperature is multiplied by each generation, from 0.5 to 1.
    cooling: f64,
}

impl Default for Settings {
    fn default() -> Self {
        Self { population: 20, cooling: 0.95 }
    }
}

/// Some neighbours a generation; a worse one is accepted too, the more rarely the worse it is and the colder it gets.
#[derive(Clone, Serialize, Deserialize)]
pub(crate) struct Annealing {
    settings: Settings,
    current: WeightVector,
    fitness: Option<Fitness>,
    temperature: f64,
    neighbours: Vec<WeightVector>,
}

impl Strategy for Annealing {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        Self::NAME
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let neighbour = |index| {
            let mut stream = seed.individual(index).stream(Purpose::new("annealing neighbour"));
            let weights = self.current.weights().iter().map(|weight| weight + stream.random_range(-0.5..0.5_f32));
            let neighbour = WeightVector::new(self.current.topology().clone(), weights.collect(), 0.0);
            neighbour.unwrap_or_else(|_| self.current.clone())
        };
        self.neighbours = (0..self.settings.population as u64).map(neighbour).collect();
        &self.neighbours
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        let mut stream = seed.stream(Purpose::new("annealing acceptance"));
        for (neighbour, evaluation) in self.neighbours.iter().zip(evaluations) {
            let chance: f64 = stream.random();
            let Some(fitness) = evaluation.fitness() else { continue };
            let loss = self.fitness.map_or(0.0, |current| current.get() - fitness.get());
            if loss <= 0.0 || chance < libm::exp(-loss / self.temperature) {
                (self.current, self.fitness) = (neighbour.clone(), Some(fitness));
            }
        }
        self.temperature *= self.settings.cooling;
    }
}

impl NetStrategy for Annealing {
    const NAME: &'static str = "annealing";
    type Settings = Settings;

    fn build(settings: &Settings, topology: &Topology) -> Result<Self, SettingError> {
        Self::begin_at(settings, topology, &vec![0.0; topology.weight_count()])
    }

    fn settings(&self) -> &Settings {
        &self.settings
    }

    /// The champion of another search is a candidate of this one.
    fn genome(topology: &Topology, weights: &[f32]) -> Option<WeightVector> {
        WeightVector::new(topology.clone(), weights.to_vec(), 0.0).ok()
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }

    fn begin_at(settings: &Settings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        SettingError::check_range("population", settings.population as f64, 1.0, 10_000.0)?;
        SettingError::check_range("cooling", settings.cooling, 0.5, 1.0)?;
        let current = WeightVector::new(topology.clone(), weights.to_vec(), 0.0)
            .map_err(|error| SettingError::new("weights", error, "weights of the net"))?;
        Ok(Self { settings: settings.clone(), current, fitness: None, temperature: 1.0, neighbours: Vec::new() })
    }

    /// It walks on from where it was, as warm as when it began: what it had come to counts on another task no more.
    fn transfer(self, settings: &Settings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::begin_at(settings, to.topology, &to.genes.transfer(self.current.weights(), 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use gambol::strategies::conformance::check_net_strategy;

    #[test]
    fn annealing_keeps_its_promises() -> Result<(), ne_core::conformance::Violation> {
        check_net_strategy::<Annealing>(&Settings { population: 5, ..Settings::default() }, &Default::default())
    }
}
