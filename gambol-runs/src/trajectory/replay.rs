use super::{TrajectoryDigest, TrajectoryDigester};
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Failure, Seed, Task};
use ne_net::Network;
use rayon::prelude::*;
use tasks::{Episode, Tally, Trial, Trials};

/// Plays a controller: what it does in the first trial, and what it is worth. One of another shape does nothing. Trials are played on the
/// threads of the current pool.
pub(crate) fn replay(
    episode: &Episode<RapierEnvironment>,
    trials: Trials,
    network: &Network,
    seed: Seed,
) -> (TrajectoryDigest, Evaluation) {
    if let Err(failure) = episode.check_shape(network) {
        return (TrajectoryDigest::default(), Evaluation::failed(failure));
    }
    let play = |trial: u32| {
        let mut digester = TrajectoryDigester::default();
        let mut network = network.clone();
        let played = match trial {
            0 => episode.play(&mut network, seed.trial(trial), &mut digester),
            _ => episode.play(&mut network, seed.trial(trial), &mut ()),
        };
        (digester, Trial::new(played.outcome, &*played.movement))
    };
    let mut played: Vec<_> = (0..trials.count).into_par_iter().map(play).collect();
    let mut tally = Tally::new(trials);
    let evaluation = played.iter().find_map(|(_, trial)| tally.add(trial));
    let no_trial = || Evaluation::failed(Failure::Other { what: "no trial".into() });
    (played.swap_remove(0).0.finish(), evaluation.unwrap_or_else(no_trial))
}
