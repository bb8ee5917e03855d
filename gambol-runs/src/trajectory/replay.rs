use super::{TrajectoryDigest, TrajectoryDigester};
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Seed, Task};
use ne_net::Network;
use rayon::prelude::*;
use tasks::{Episode, Tally, Trial, Trials};

/// Plays a controller: what it does in the first trial, and what it is worth. One of another shape does nothing. Trials are played on the
/// threads of the current pool; outside of one on the calling thread.
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
        let (mut network, mut digester) = (network.clone(), TrajectoryDigester::default());
        let seed = seed.trial(trial);
        let played = match trial {
            0 => episode.play(&mut network, seed, &mut digester),
            _ => episode.play(&mut network, seed, &mut ()),
        };
        (digester, Trial::new(played.outcome, &*played.movement))
    };
    let mut tally = Tally::new(trials);
    let played: Vec<(TrajectoryDigester, Trial)> = match rayon::current_thread_index() {
        Some(_) => (0..trials.count).into_par_iter().map(play).collect(),
        None => Vec::new(),
    };
    let mut played = played.into_iter();
    let mut digest = None;
    loop {
        let (digester, trial) = played.next().unwrap_or_else(|| play(tally.next_trial()));
        digest.get_or_insert_with(|| digester.finish());
        if let Some(evaluation) = tally.add(&trial) {
            return (digest.unwrap_or_default(), evaluation);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Registry, champion::Champion, robustness_check::tests::champion};
    use ne_core::StopConditions;

    /// What an evaluation finds, whatever plays the trials, and however many there are.
    #[test]
    fn a_replay_is_worth_what_an_evaluation_is() {
        let stop = StopConditions { generations: Some(3), ..StopConditions::default() };
        let champion = champion("tetrapod-1", "running", 1, stop);
        for count in [1, 5] {
            let trials = Trials { count, ..champion.trials };
            let champion = Champion { trials, variation: envs_rapier::Variation::light(), ..champion.clone() };
            let episode = champion.episode(&Registry::default()).expect("valid");
            let alone = replay(&episode, trials, &champion.network, champion.seed);
            let expected = episode.evaluate(&mut champion.network.clone(), champion.seed);
            assert_eq!(alone.1, expected, "{count} trials");
            for threads in [1, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads start");
                let inside = pool.install(|| replay(&episode, trials, &champion.network, champion.seed));
                assert_eq!(inside, alone);
            }
        }
    }
}
