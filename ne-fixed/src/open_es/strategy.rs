use super::{OpenEsSettings, adam::AdamMemory, state::State};
use crate::{
    WeightVector,
    mirrored::{centre_length, drawn_centre},
    nets::{Nets, check_growth},
    ranking::best_first,
};
use ne_core::{Evaluation, Fitness, Purpose, Seed, SettingError, Statistic, Strategy};
use ne_net::{Topology, TopologyMap};
use serde::{Deserialize, Serialize};

const CENTRE: Purpose = Purpose::new("open-es centre");
const NOISE: Purpose = Purpose::new("open-es noise");

/// The evolution strategy of OpenAI: a centre climbs the gradient of the expected fitness of its noisy copies, which it
/// estimates from their ranks.
///
/// A generation consists of the centre θ, which is evaluated as a possible champion and takes no part in the estimate,
/// and of pairs θ + σε, θ − σε (antithetic sampling), each with its own ε ~ N(0, I). Once evaluated,
/// 1. each sample has its centred rank u, from −½ for the worst to ½ for the best;
/// 2. the gradient is Σ u ε / (λσ) for λ samples, less the weight decay times θ;
/// 3. [`Adam`](crate::Adam) moves θ along it;
/// 4. σ decays, if it is told to.
///
/// Failed evaluations rank below every fitness; equals share the mean of their ranks, so that where all are equal or all
/// fail there is no gradient but the weight decay's.
///
/// # Statistics
/// - `deviation`: σ, in units of the weights;
/// - `gradient_length`: of the last estimate, weight decay included;
/// - `centre_length`: the root mean square of the centre's weights.
///
/// Source: Salimans, Ho, Chen, Sidor & Sutskever, *Evolution Strategies as a Scalable Alternative to Reinforcement
/// Learning*, arXiv 1703.03864, algorithm 1 and section 2.1.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "State", try_from = "State")]
pub struct OpenEs {
    pub(super) settings: OpenEsSettings,
    pub(super) nets: Nets,
    /// θ; empty before the first generation.
    pub(super) centre: Vec<f64>,
    pub(super) deviation: f64,
    pub(super) adam: AdamMemory,
    pub(super) gradient_length: f64,
}

impl OpenEs {
    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range.
    pub fn new(settings: OpenEsSettings, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        settings.validate()?;
        let nets = Nets::new(topology)?;
        Ok(Self {
            deviation: settings.deviation,
            adam: AdamMemory::new(nets.topology.weight_count()),
            settings,
            nets,
            centre: Vec::new(),
            gradient_length: 0.0,
        })
    }

    /// The same search, whose centre begins at these weights, those of the best net of several: a champion to be made
    /// better, or moved to another task. Without effect once a generation was asked.
    ///
    /// # Errors
    /// If they are not weights of this search's topology; the error names the net: `start[0]`.
    pub fn with_start(mut self, start: &[Vec<f32>]) -> Result<Self, SettingError> {
        let start = self.nets.given_centre(start)?;
        if let (true, Some(centre)) = (self.centre.is_empty(), start) {
            self.centre = centre;
        }
        Ok(self)
    }

    /// Goes on with other settings, on another task, or with nets that have grown: with its centre, in which new weights
    /// are 0, with what [`Adam`](crate::Adam) remembers (of a new weight the mean square of the others, so that its first steps are
    /// no longer than theirs), and with its deviation, as far as the settings allow it.
    ///
    /// # Errors
    /// If a setting is out of range, or the growth is not from this topology to that one.
    pub fn remapped(
        self,
        settings: OpenEsSettings,
        topology: impl Into<Topology>,
        growth: &TopologyMap,
    ) -> Result<Self, SettingError> {
        let next = Self::new(settings, topology)?;
        check_growth(growth, &self.nets.topology, &next.nets.topology)?;
        let centre = if self.centre.is_empty() { Vec::new() } else { growth.transfer(&self.centre, 0.0) };
        let squares = &self.adam.squares;
        let mean_square = squares.iter().sum::<f64>() / squares.len().max(1) as f64;
        let adam = AdamMemory {
            steps: self.adam.steps,
            means: growth.transfer(&self.adam.means, 0.0),
            squares: growth.transfer(&self.adam.squares, mean_square),
        };
        let deviation = self.deviation.max(next.settings.least_deviation).min(next.settings.deviation);
        Ok(Self { centre, adam, deviation, ..next })
    }

    /// The settings.
    pub fn settings(&self) -> &OpenEsSettings {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.nets.topology
    }

    /// The estimate of the gradient from the centred ranks of the samples.
    fn gradient(&self, ranks: &[f64]) -> Vec<f64> {
        let mut gradient = vec![0.0; self.centre.len()];
        for (pair, ranks) in self.nets.population[1..].chunks_exact(2).zip(ranks.chunks_exact(2)) {
            // σε, as it was rounded: half of the difference of the two.
            let scale =
                0.5 * (ranks[0] - ranks[1]) / (self.settings.population as f64 * self.deviation * self.deviation);
            for (gradient, (plus, minus)) in gradient.iter_mut().zip(pair[0].weights().iter().zip(pair[1].weights())) {
                *gradient += scale * (f64::from(*plus) - f64::from(*minus));
            }
        }
        gradient.iter_mut().zip(&self.centre).for_each(|(slope, x)| *slope -= self.settings.weight_decay * x);
        gradient
    }
}

impl Strategy for OpenEs {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "open-es"
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        if self.centre.is_empty() {
            self.centre = drawn_centre(&self.settings.initial_centre, &self.nets.topology, (seed, CENTRE));
        }
        self.nets.ask_mirrored(&self.centre, (self.settings.population, self.deviation), (seed, NOISE))
    }

    fn tell(&mut self, evaluations: &[Evaluation], _seed: Seed) {
        debug_assert_eq!(evaluations.len(), self.nets.population.len());
        self.nets.asked = false;
        let scores: Vec<_> = evaluations[1..].iter().map(Evaluation::fitness).collect();
        let gradient = self.gradient(&centred_ranks(&scores));
        self.gradient_length = gradient.iter().map(|slope| slope * slope).sum::<f64>().sqrt();
        self.settings.adam.step(&mut self.adam, &gradient, &mut self.centre);
        let decayed = self.deviation * self.settings.deviation_decay;
        self.deviation = decayed.max(self.settings.least_deviation);
    }

    fn recommendation(&self) -> Option<WeightVector> {
        self.nets.at(&self.centre)
    }

    fn statistics(&self) -> Vec<Statistic> {
        vec![
            Statistic::new("deviation", self.deviation),
            Statistic::new("gradient_length", self.gradient_length),
            Statistic::new("centre_length", centre_length(&self.centre)),
        ]
    }
}

/// For each score its rank, from −½ for the worst to ½ for the best; equals share the mean of theirs.
fn centred_ranks(scores: &[Option<Fitness>]) -> Vec<f64> {
    let order = best_first(scores);
    let mut ranks = vec![0.0; scores.len()];
    let mut better = 0;
    for equals in order.chunk_by(|&one, &other| scores[one] == scores[other]) {
        let mean = better as f64 + 0.5 * (equals.len() - 1) as f64;
        equals.iter().for_each(|&index| ranks[index] = 0.5 - mean / (scores.len() - 1) as f64);
        better += equals.len();
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ranks(scores: &[Option<f64>]) -> Vec<f64> {
        let scores: Vec<_> = scores.iter().map(|score| score.and_then(|score| Fitness::new(score).ok())).collect();
        centred_ranks(&scores)
    }

    #[test]
    fn ranks_are_those_found_by_hand() {
        assert_eq!(ranks(&[Some(3.0), Some(-7.0)]), [0.5, -0.5]);
        assert_eq!(ranks(&[Some(3.0), Some(1e9), Some(-7.0), Some(4.0), Some(5.0)]), [-0.25, 0.5, -0.5, 0.0, 0.25]);
        // Equals share: ranks 1 and 2 of 0 to 3, from the best.
        assert_eq!(ranks(&[Some(1.0), Some(2.0), Some(1.0), Some(0.0)]), [0.0, 0.5, 0.0, -0.5]);
        // Failures share the last places.
        assert_eq!(ranks(&[None, Some(-1e300), None, Some(0.0), Some(1.0)]), [-0.375, 0.0, -0.375, 0.25, 0.5]);
        assert_eq!(ranks(&[None, None, None, None]), [0.0; 4]);
    }
}
