//! Evaluations that come from elsewhere: from another worker of a browser, another process, another machine.

use crate::{Registry, config::RunConfig, episode_parts::SetupError, setup::Setup};
use ne_core::{
    Evaluation, Evaluator, Genome, Phenotype, Seed, StopReason, Task, evaluate_phenotypes, successive_halving::Rung,
};
use ne_net::Network;
use serde::{Deserialize, Serialize};
use std::{
    cell::{Cell, RefCell},
    ptr,
};

/// Nets that are to be evaluated for a run: a generation, or those of it that have come to a rung. It may be divided: each net is
/// evaluated by itself.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Batch {
    /// On the task of which rung, from 0; `None`: on the task of training.
    pub rung: Option<usize>,
    /// The controllers.
    pub networks: Vec<Network>,
    /// The generation's.
    pub seed: Seed,
}

/// Evaluates batches of a run, without the run.
pub struct BatchEvaluator {
    setup: Setup,
    rungs: Vec<Rung>,
}

impl BatchEvaluator {
    /// `config`: that of the run, or of its stage.
    ///
    /// # Errors
    /// Names the field that is wrong.
    pub fn new(config: &RunConfig, registry: &Registry) -> Result<Self, SetupError> {
        let setup = Setup::new(config, registry)?;
        Ok(Self { rungs: setup.rungs(), setup })
    }

    /// One evaluation for each net, on the calling thread; empty if there is no such rung.
    pub fn evaluate(&self, mut batch: Batch) -> Vec<Evaluation> {
        let task: &dyn Task = match batch.rung {
            None => &self.setup.task,
            Some(rung) => match self.rungs.get(rung) {
                Some(rung) => &*rung.task,
                None => return Vec::new(),
            },
        };
        evaluate_phenotypes(task, &mut batch.networks, batch.seed, &())
    }
}

/// What has become of a generation whose evaluations come from elsewhere.
#[derive(Debug)]
pub enum Step {
    /// It is done.
    Done,
    /// These are to be evaluated; the evaluations are [given](Answers::give), and then it goes on.
    Wants(Batch),
    /// The run is over.
    Over(StopReason),
}

/// The evaluations of a generation so far, batch after batch.
#[derive(Debug, Default)]
pub struct Answers(Vec<Vec<Evaluation>>);

impl Answers {
    /// The evaluations of the batch that was wanted last, in its order.
    pub fn give(&mut self, evaluations: Vec<Evaluation>) {
        self.0.push(evaluations);
    }

    /// Whether a generation has begun, and is not done.
    pub fn are_there(&self) -> bool {
        !self.0.is_empty()
    }

    /// Forgets all: the generation is done.
    pub(super) fn clear(&mut self) {
        self.0.clear();
    }
}

/// Evaluates from memory. The same batches are asked for in the same order each time; the first that has no answer is wanted.
pub(super) struct Remembering<'a> {
    pub(super) answers: &'a Answers,
    pub(super) rungs: &'a [Rung],
    pub(super) asked: Cell<usize>,
    pub(super) wanted: RefCell<Option<Batch>>,
}

impl Evaluator for Remembering<'_> {
    fn evaluate<G: Genome>(&self, task: &dyn Task, genomes: &[G], seed: Seed) -> Vec<Evaluation> {
        let number = self.asked.replace(self.asked.get() + 1);
        if let Some(known) = self.answers.0.get(number) {
            return known.clone();
        }
        // A rung is known by its task, of which there is one.
        let rung = self.rungs.iter().position(|rung| ptr::addr_eq(&raw const *rung.task, ptr::from_ref(task)));
        let network = |genome: &G| Network::of(&genome.express() as &dyn Phenotype).map(std::borrow::Cow::into_owned);
        let networks: Option<Vec<Network>> = genomes.iter().map(network).collect();
        *self.wanted.borrow_mut() = networks.map(|networks| Batch { rung, networks, seed });
        Vec::new()
    }
}
