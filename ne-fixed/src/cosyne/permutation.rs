use ne_core::{Fitness, RandomStream};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Which weights [`Cosyne`](crate::Cosyne) marks to change places with others of their subpopulation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Permutation {
    /// All of them: no net survives a generation, and only the subpopulations evolve.
    All,
    /// Those of worse nets rather than those of better ones: with probability 1 − ((f − f_min) / (f_max − f_min))^(1/n)
    /// for n weights, so that a net stays whole with probability (f − f_min) / (f_max − f_min); the best always does,
    /// and so do nets just bred. The default.
    #[default]
    ByFitness,
}

impl Permutation {
    /// The probability to be marked, from 0 to 1, for the weights of each net that was evaluated, with `weights` weights
    /// in a net. Failed nets are marked as a whole; where all are equally good, all are.
    pub(super) fn probabilities(self, scores: &[Option<Fitness>], weights: usize) -> Vec<f64> {
        let values = || scores.iter().flatten().map(|fitness| fitness.get());
        // Halves, since a difference of two doubles may be too large for one.
        let best = values().fold(f64::MIN, f64::max) * 0.5;
        let worst = values().fold(f64::MAX, f64::min) * 0.5;
        let probability = |score: &Option<Fitness>| match (self, score) {
            (Self::ByFitness, Some(fitness)) if best > worst => {
                let share = (fitness.get() * 0.5 - worst) / (best - worst);
                1.0 - libm::pow(share, 1.0 / weights as f64)
            }
            _ => 1.0,
        };
        scores.iter().map(probability).collect()
    }

    /// The probability to be marked for the weights of nets just bred.
    pub(super) fn of_children(self) -> f64 {
        match self {
            Self::All => 1.0,
            Self::ByFitness => 0.0,
        }
    }
}

/// The places of a subpopulation's members after those that are marked, each with its own probability, have been shuffled
/// among themselves: the member at place i comes from place `result[i]`.
pub(super) fn shuffle_marked(probabilities: &[f64], stream: &mut RandomStream) -> Vec<usize> {
    let mut places: Vec<usize> = (0..probabilities.len()).collect();
    let marked: Vec<usize> =
        places.iter().copied().filter(|&place| stream.random::<f64>() < probabilities[place]).collect();
    // Fisher and Yates: every order of the marked is equally likely.
    for last in (1..marked.len()).rev() {
        places.swap(marked[last], marked[stream.random_range(0..=last)]);
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Purpose, Seed};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn members_change_places_and_none_is_lost(
            probabilities in proptest::collection::vec(prop_oneof![Just(0.0), Just(1.0), 0.0..1.0], 1..60), seed: u64,
        ) {
            let mut places = shuffle_marked(&probabilities, &mut Seed::of_run(seed).stream(Purpose::new("test")));
            for (place, &from) in places.iter().enumerate() {
                prop_assert!(place == from || (probabilities[place] > 0.0 && probabilities[from] > 0.0));
            }
            places.sort_unstable();
            prop_assert!(places.into_iter().eq(0..probabilities.len()));
        }
    }

    #[test]
    fn every_order_is_equally_likely() {
        let mut counts = [0; 3];
        for seed in 0..6000 {
            let places = shuffle_marked(&[1.0; 3], &mut Seed::of_run(seed).stream(Purpose::new("test")));
            counts[places[0]] += 1;
        }
        assert!(counts.iter().all(|count| (1850..2150).contains(count)), "{counts:?}");
    }

    #[test]
    fn nets_stay_whole_by_their_fitness() {
        let score = |value: f64| Fitness::new(value).ok();
        let scores = [score(3.0), score(1.0), None, score(2.0)];
        let probabilities = Permutation::ByFitness.probabilities(&scores, 2);
        let expected = [0.0, 1.0, 1.0, 1.0 - 0.5_f64.sqrt()];
        assert!(probabilities.iter().zip(expected).all(|(p, q)| (p - q).abs() < 1e-12), "{probabilities:?}");
        assert_eq!(Permutation::All.probabilities(&scores, 2), [1.0; 4]);
        assert_eq!(Permutation::ByFitness.probabilities(&[score(1.0); 3], 2), [1.0; 3]);
        let extremes = Permutation::ByFitness.probabilities(&[score(f64::MAX), score(f64::MIN), score(0.0)], 1);
        assert_eq!(extremes, [0.0, 1.0, 0.5]);
    }
}
