use super::{TrajectoryDigest, TrajectoryDigester};
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Seed, Task};
use ne_net::Network;
use tasks::{Episode, Trials};

/// Plays a controller: what it does in the first trial, and what it is worth. One of another shape does nothing.
pub(crate) fn replay(
    episode: &Episode<RapierEnvironment>,
    trials: Trials,
    network: &Network,
    seed: Seed,
) -> (TrajectoryDigest, Evaluation) {
    let mut network = network.clone();
    if let Err(failure) = episode.check_shape(&network) {
        return (TrajectoryDigest::default(), Evaluation::failed(failure));
    }
    let mut digester = TrajectoryDigester::default();
    let played = episode.play(&mut network, seed.trial(0), &mut digester);
    // Of a single trial nothing more can be learned.
    let evaluation = match played.failure {
        _ if trials.count > 1 => episode.evaluate(&mut network, seed),
        Some(failure) => Evaluation::failed(failure),
        None => Evaluation::new(played.movement.value()),
    };
    (digester.finish(), evaluation)
}
