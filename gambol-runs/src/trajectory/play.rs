//! A controller played without a movement: nothing ends it early.

use super::Recording;
use envs_rapier::RapierEnvironment;
use ne_core::{Failure, Phenotype, Seed};
use ne_net::Network;
use tasks::Environment;

impl Recording {
    /// What a controller does in so many steps, in the world with the seed of run 0: one without variation has no other. Each
    /// snapshot is that which an episode shows; there is no movement, so no term ends it. With it what went wrong, if anything
    /// did: the recording then ends with the step before.
    pub fn play(environment: &RapierEnvironment, network: &Network, steps: u32) -> (Self, Option<Failure>) {
        let mut recording = Self::default();
        let played = recording.go_through(environment.clone(), network.clone(), steps);
        (recording, played.err())
    }

    fn go_through(&mut self, mut world: RapierEnvironment, mut network: Network, steps: u32) -> Result<(), Failure> {
        let (inputs, outputs) = (world.inputs(), world.outputs());
        let (found_inputs, found_outputs) = (network.inputs(), network.outputs());
        if (found_inputs, found_outputs) != (inputs, outputs) {
            return Err(Failure::ShapeMismatch { found_inputs, found_outputs, inputs, outputs });
        }
        let (mut sensed, mut wanted) = (vec![0.0; inputs], vec![0.0; outputs]);
        network.reset();
        world.reset(Seed::of_run(0))?;
        self.note(&world, &network);
        for _ in 0..steps {
            world.sense(&mut sensed);
            network.activate(&sensed, &mut wanted);
            if let Some(failure) = Failure::of_decision(&sensed, &wanted) {
                return Err(failure);
            }
            world.act(&wanted);
            world.step()?;
            self.note(&world, &network);
        }
        Ok(())
    }

    fn note(&mut self, world: &RapierEnvironment, network: &Network) {
        self.snapshots.push(world.snapshot().clone());
        self.torques.push(world.motor_torques().collect());
        self.activations.push(network.activations());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::perturbation::tests::judge;
    use ne_net::{DenseNet, DenseShape};

    fn network(inputs: usize, outputs: usize) -> Network {
        let weights: Vec<f32> = (0..(inputs + 1) * outputs).map(|index| (index % 7) as f32 * 0.3 - 0.8).collect();
        DenseNet::new(DenseShape::new(inputs, vec![], outputs), &weights).expect("a net").into()
    }

    #[test]
    fn what_is_played_is_what_an_episode_shows() {
        let judge = judge("tetrapod-1", "jumping");
        let world = judge.environment();
        let network = network(world.inputs(), world.outputs());
        let (played, failure) = Recording::play(world, &network, judge.steps());
        let watched = judge.record(&network);
        assert_eq!((failure, played.snapshots.len()), (None, judge.steps() as usize + 1));
        assert_eq!(played.snapshots, watched.snapshots);
        assert_eq!(played.activations, watched.activations);
        assert!(watched.torques.is_empty());
        assert!(played.torques.iter().all(|torques| torques.len() == world.outputs()));
    }

    #[test]
    fn a_controller_of_another_shape_does_nothing() {
        let judge = judge("tetrapod-1", "jumping");
        let (recording, failure) = Recording::play(judge.environment(), &network(1, 1), 5);
        assert!(recording.snapshots.is_empty() && matches!(failure, Some(Failure::ShapeMismatch { .. })));
    }
}
