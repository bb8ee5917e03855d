//! The world of the champion selection.

use crate::{
    judge::Judge,
    robustness_check::RobustnessCheck,
    training_task::TrainingTask,
    trajectory::{TrajectoryDigest, replay},
};
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Seed};
use ne_net::Network;
use std::sync::{Arc, Mutex};
use tasks::{Episode, Trials};

/// One trial of the creature, or several of one that is told random commands, whole and in the world as the configuration has it, where training varies the world, shortens
/// the episode or has further bodies.
#[derive(Clone)]
pub struct ReferenceEpisode {
    /// In the engine of training.
    pub task: TrainingTask,
    /// In rapier.
    pub episode: Episode<RapierEnvironment>,
    /// Its trials.
    pub trials: Trials,
    /// The seed of its trials.
    pub seed: Seed,
    /// The varied worlds of training, always the same few, in which a champion must keep its fitness; `None` if training
    /// does not vary the world.
    pub proof: Option<TrainingTask>,
    /// Where gaits are judged, if those of this movement are.
    pub judge: Option<Judge>,
    /// Where candidates are tried in perturbed worlds, if training varies the world and gaits are judged.
    pub robustness_check: Option<RobustnessCheck>,
    /// What was replayed last: the champion selection has a champion played in rapier just before its file is written.
    last: Arc<Mutex<Option<Replay>>>,
}

/// A controller's trial in rapier.
struct Replay {
    network: Network,
    seed: Seed,
    result: (TrajectoryDigest, Evaluation),
}

impl ReferenceEpisode {
    pub(crate) fn new(
        task: TrainingTask,
        (episode, trials): (Episode<RapierEnvironment>, Trials),
        proof: Option<TrainingTask>,
        judge: Judge,
        seed: Seed,
    ) -> Self {
        let judge = Some(judge).filter(|judge| judge.rules().is_some());
        let tried = judge.clone().filter(|_| proof.is_some());
        let robustness_check = tried.map(|judge| RobustnessCheck::new(judge, seed));
        Self { task, episode, trials, seed, proof, judge, robustness_check, last: Arc::default() }
    }

    /// What a controller does in rapier, and what it is worth there.
    pub(crate) fn replay(&self, network: &Network, seed: Seed) -> (TrajectoryDigest, Evaluation) {
        let known = self.last.lock().ok().and_then(|last| {
            let known = last.as_ref().filter(|known| known.seed == seed && known.network == *network);
            known.map(|known| known.result.clone())
        });
        known.unwrap_or_else(|| {
            let result = replay(&self.episode, self.trials, network, seed);
            if let Ok(mut last) = self.last.lock() {
                *last = Some(Replay { network: network.clone(), seed, result: result.clone() });
            }
            result
        })
    }
}
