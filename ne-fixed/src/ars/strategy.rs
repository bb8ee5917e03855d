use super::{ArsSettings, state::State};
use crate::{
    WeightVector,
    mirrored::{centre_length, drawn_centre},
    nets::{Nets, check_growth},
};
use ne_core::{Evaluation, Fitness, Purpose, Seed, SettingError, Statistic, Strategy};
use ne_net::{Topology, TopologyMap};
use serde::{Deserialize, Serialize};

const CENTRE: Purpose = Purpose::new("ars centre");
const DIRECTIONS: Purpose = Purpose::new("ars directions");

/// Augmented random search, version V1-t: a centre moves along the directions in which its noisy copies did best.
///
/// A generation consists of the centre M, which is evaluated as a possible champion and takes no part in the step, and of
/// pairs M + νδ, M − νδ, each with its own direction δ ~ N(0, I). The paper gives its algorithm in numbered steps, not in
/// equations; of algorithm 1 these are
/// - step 4: the directions are drawn;
/// - step 5: both policies of each are evaluated;
/// - step 6: the directions are put in order by the better of their two rewards, and the best b are kept (the "t" of the
///   name);
/// - step 7: M moves by α / (b σ) Σ (r⁺ − r⁻) δ, where σ is the standard deviation of the 2b rewards used.
///
/// What is not the paper's: its V2 scales the senses by what was seen of them, which a strategy cannot (here senses are
/// scaled by their known ranges). Its policies are linear and begin at 0; nets with hidden neurons have a saddle there,
/// so the first centre is drawn, unless `initial_centre` says `{"uniform": {"limit": 0}}`. A failed evaluation counts as
/// the worst reward of its generation, and where all are equal or fail the centre rests.
///
/// # Statistics
/// - `reward_deviation`: σ of the last step;
/// - `step_length`: how far the centre moved last;
/// - `centre_length`: the root mean square of the centre's weights.
///
/// Source: Mania, Guy & Recht, *Simple Random Search of Static Linear Policies is Competitive for Reinforcement
/// Learning*, NeurIPS 2018 (arXiv 1803.07055), algorithm 1.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "State", try_from = "State")]
pub struct Ars {
    pub(super) settings: ArsSettings,
    pub(super) nets: Nets,
    /// M; empty before the first generation.
    pub(super) centre: Vec<f64>,
    pub(super) reward_deviation: f64,
    pub(super) step_length: f64,
}

impl Ars {
    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range.
    pub fn new(settings: ArsSettings, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        settings.validate()?;
        let nets = Nets::new(topology)?;
        Ok(Self { settings, nets, centre: Vec::new(), reward_deviation: 0.0, step_length: 0.0 })
    }

    /// The same search, whose centre begins at these weights, those of the best net of several. Without effect once a
    /// generation was asked.
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
    /// are 0.
    ///
    /// # Errors
    /// If a setting is out of range, or the growth is not from this topology to that one.
    pub fn remapped(
        self,
        settings: ArsSettings,
        topology: impl Into<Topology>,
        growth: &TopologyMap,
    ) -> Result<Self, SettingError> {
        let next = Self::new(settings, topology)?;
        check_growth(growth, &self.nets.topology, &next.nets.topology)?;
        let centre = if self.centre.is_empty() { Vec::new() } else { growth.transfer(&self.centre, 0.0) };
        Ok(Self { centre, ..next })
    }

    /// The settings.
    pub fn settings(&self) -> &ArsSettings {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.nets.topology
    }

    /// Steps 6 and 7 for the rewards of the samples, two for each direction.
    fn step(&mut self, rewards: &[f64]) {
        let pairs: Vec<[f64; 2]> = rewards.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
        let top = best_directions(&pairs, self.settings.top());
        let used: Vec<f64> = top.iter().flat_map(|&index| pairs[index]).collect();
        self.reward_deviation = deviation(&used);
        self.step_length = 0.0;
        // Equal rewards point nowhere.
        if self.reward_deviation == 0.0 {
            return;
        }
        let mut step = vec![0.0; self.centre.len()];
        for &index in &top {
            let [plus, minus] = [1, 2].map(|place| self.nets.population[2 * index + place].weights());
            // Divided first: a difference of huge rewards may be too large for a number.
            let difference = pairs[index][0] / self.reward_deviation - pairs[index][1] / self.reward_deviation;
            let scale = self.settings.step_size * difference / (top.len() as f64 * 2.0 * self.settings.noise);
            // νδ, as it was rounded: half of the difference of the two.
            for (step, (plus, minus)) in step.iter_mut().zip(plus.iter().zip(minus)) {
                *step += scale * (f64::from(*plus) - f64::from(*minus));
            }
        }
        self.centre.iter_mut().zip(&step).for_each(|(x, step)| *x += step);
        self.step_length = step.iter().map(|step| step * step).sum::<f64>().sqrt();
    }
}

impl Strategy for Ars {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "ars"
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        if self.centre.is_empty() {
            self.centre = drawn_centre(&self.settings.initial_centre, &self.nets.topology, (seed, CENTRE));
        }
        self.nets.ask_mirrored(&self.centre, (self.settings.population, self.settings.noise), (seed, DIRECTIONS))
    }

    fn tell(&mut self, evaluations: &[Evaluation], _seed: Seed) {
        debug_assert_eq!(evaluations.len(), self.nets.population.len());
        self.nets.asked = false;
        self.step(&rewards(&evaluations[1..]));
    }

    fn recommendation(&self) -> Option<WeightVector> {
        self.nets.at(&self.centre)
    }

    fn statistics(&self) -> Vec<Statistic> {
        vec![
            Statistic::new("reward_deviation", self.reward_deviation),
            Statistic::new("step_length", self.step_length),
            Statistic::new("centre_length", centre_length(&self.centre)),
        ]
    }
}

/// What each came to, failures with the worst of all that did not fail.
fn rewards(evaluations: &[Evaluation]) -> Vec<f64> {
    let fitnesses = || evaluations.iter().map(|evaluation| evaluation.fitness().map(Fitness::get));
    let worst = fitnesses().flatten().reduce(f64::min).unwrap_or_default();
    fitnesses().map(|fitness| fitness.unwrap_or(worst)).collect()
}

/// The places of the `count` best directions, by the better of two rewards; of equals those with the lower place.
fn best_directions(pairs: &[[f64; 2]], count: usize) -> Vec<usize> {
    let better = |index: usize| pairs[index][0].max(pairs[index][1]);
    let mut order: Vec<usize> = (0..pairs.len()).collect();
    order.sort_by(|&one, &other| better(other).total_cmp(&better(one)));
    order.truncate(count);
    order
}

fn square(number: f64) -> f64 {
    number * number
}

/// The standard deviation of rewards: of the population, as numpy's `std` has it.
fn deviation(rewards: &[f64]) -> f64 {
    // In units of the largest, so that squares of huge rewards are numbers.
    let largest = rewards.iter().fold(0.0, |largest: f64, reward| largest.max(reward.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    let count = rewards.len() as f64;
    let mean = rewards.iter().map(|reward| reward / largest).sum::<f64>() / count;
    let variance = rewards.iter().map(|reward| square(reward / largest - mean)).sum::<f64>() / count;
    variance.sqrt() * largest
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_best_directions_are_those_found_by_hand() {
        let pairs = [[1.0, 2.0], [9.0, -5.0], [3.0, 3.0], [2.0, 0.0]];
        assert_eq!(best_directions(&pairs, 2), [1, 2]);
        assert_eq!(best_directions(&pairs, 4), [1, 2, 0, 3]);
    }

    #[test]
    fn the_deviation_is_that_found_by_hand_and_stands_huge_rewards() {
        assert_eq!(deviation(&[1.0, 3.0]), 1.0);
        assert_eq!(deviation(&[5.0, 5.0, 5.0]), 0.0);
        assert_eq!(deviation(&[0.0, 0.0]), 0.0);
        assert_eq!(deviation(&[-1e308, 1e308]), 1e308);
    }

    #[test]
    fn a_failure_counts_as_the_worst() {
        let failed = Evaluation::failed(ne_core::Failure::Other { what: "test".into() });
        let evaluations = [Evaluation::new(3.0), failed.clone(), Evaluation::new(-2.0)];
        assert_eq!(rewards(&evaluations), [3.0, -2.0, -2.0]);
        assert_eq!(rewards(&[failed.clone(), failed]), [0.0, 0.0]);
    }
}
