//! What a search begins about where all that was learned before is held.

use ne_core::{Fitness, Phenotype, Purpose, Seed, Task};
use rand::Rng;

/// Draws the worlds and commands of the evaluations.
const GUESSES: Purpose = Purpose::new("guesses of a held search");

/// So many evaluations of each guess, of all its trials.
const EVALUATIONS: u64 = 4;

/// These weights, made by hand, or their mirror image where that is worth more in a task: of two legs that go apart in a jump the one
/// that is in front in the stride has to go to the front, and a search finds by chance which leg that is (docs/playing-experiments.md).
/// The weights themselves where both are worth the same, or there is no net of them. No progress counts these evaluations.
pub(super) fn better_guess<P: Phenotype>(
    weights: &[f32],
    express: impl Fn(&[f32]) -> Option<P>,
    task: &dyn Task,
    seed: Seed,
) -> Vec<f32> {
    let mirrored: Vec<f32> = weights.iter().map(|weight| -weight).collect();
    let worth = |weights: &[f32]| {
        let mut net = express(weights)?;
        let seeds = (0..EVALUATIONS).map(|index| Seed::of_run(seed.individual(index).stream(GUESSES).next_u64()));
        Some(seeds.map(|seed| task.evaluate(&mut net, seed).fitness().map_or(f64::NEG_INFINITY, Fitness::get)).sum())
    };
    let [by_hand, mirror]: [Option<f64>; 2] = [worth(weights), worth(&mirrored)];
    tracing::debug!(by_hand, mirror, "what the guess and its mirror image are worth");
    if mirror > by_hand { mirrored } else { weights.to_vec() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Evaluation, Failure};
    use ne_net::{DenseNet, DenseShape, Network};

    /// A net is worth what it puts out, times this; above 1 it fails.
    struct Output(f64);

    impl Task for Output {
        fn inputs(&self) -> usize {
            1
        }

        fn outputs(&self) -> usize {
            1
        }

        fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
            let mut outputs = [0.0];
            phenotype.activate(&[1.0], &mut outputs);
            let worth = f64::from(outputs[0]) * self.0;
            if worth > 1.0 {
                Evaluation::failed(Failure::Unstable { what: "speed".into() })
            } else {
                Evaluation::new(worth)
            }
        }
    }

    fn guess(factor: f64, weights: &[f32]) -> Vec<f32> {
        let shape = DenseShape::new(1, vec![], 1);
        let express = |weights: &[f32]| Some(Network::from(DenseNet::new(shape.clone(), weights).ok()?));
        better_guess(weights, express, &Output(factor), Seed::of_run(1))
    }

    #[test]
    fn is_the_mirror_image_where_that_is_worth_more() {
        assert_eq!(guess(1.0, &[0.5, 0.2]), [0.5, 0.2]);
        assert_eq!(guess(1.0, &[-0.5, -0.2]), [0.5, 0.2]);
        assert_eq!(guess(0.0, &[-0.5, -0.2]), [-0.5, -0.2], "both are worth the same");
        // What fails is worth less than anything.
        assert_eq!(guess(100.0, &[0.5, 0.2]), [-0.5, -0.2]);
        assert_eq!(guess(1.0, &[0.5]), [0.5], "there is no such net");
    }
}
