use crate::{
    config::RunConfig,
    run_folder::RunFolder,
    setup::Setup,
    training::{self, Outcome, TrainError, TrainOptions},
};
use ne_core::{Genome, SettingError, Strategy};
use ne_net::Network;
use std::{marker::PhantomData, path::Path};

/// Does the runs of a method.
pub trait Runner: Send + Sync {
    /// Starts a run in a new folder.
    ///
    /// # Errors
    /// As [`training::train`].
    fn train(&self, config: &RunConfig, folder: &Path, options: TrainOptions<'_>) -> Result<Outcome, TrainError>;

    /// Goes on with a run.
    ///
    /// # Errors
    /// As [`training::resume`].
    fn resume(&self, folder: &Path, options: TrainOptions<'_>) -> Result<Outcome, TrainError>;
}

/// Who does the runs of which method: Gambol's own strategies, and those of another program that were added.
#[derive(Default)]
pub struct Runners {
    foreign: Vec<(String, Box<dyn Runner>)>,
}

impl Runners {
    /// Adds the runner of a method.
    #[must_use]
    pub fn with(mut self, method: &str, runner: impl Runner + 'static) -> Self {
        self.foreign.push((method.into(), Box::new(runner)));
        self
    }

    pub(super) fn of(&self, method: &str) -> &dyn Runner {
        self.foreign.iter().find(|(name, _)| name == method).map_or(&Own, |(_, runner)| runner.as_ref())
    }
}

/// The strategies that a configuration can name.
struct Own;

impl Runner for Own {
    fn train(&self, config: &RunConfig, folder: &Path, options: TrainOptions<'_>) -> Result<Outcome, TrainError> {
        training::train(config, folder, options)
    }

    fn resume(&self, folder: &Path, options: TrainOptions<'_>) -> Result<Outcome, TrainError> {
        training::resume(folder, None, options)
    }
}

/// Runs of a strategy of your own, built by a function from what it is to search.
pub struct ForeignRunner<S, F> {
    build: F,
    strategy: PhantomData<fn() -> S>,
}

impl<S: Strategy, F: Fn(&Setup) -> Result<S, SettingError>> ForeignRunner<S, F> {
    /// A runner that builds its strategy with this function.
    pub fn new(build: F) -> Self {
        Self { build, strategy: PhantomData }
    }
}

impl<S, F> Runner for ForeignRunner<S, F>
where
    S: Strategy<Genome: Genome<Phenotype: Into<Network>>>,
    F: Fn(&Setup) -> Result<S, SettingError> + Send + Sync,
{
    fn train(&self, config: &RunConfig, folder: &Path, options: TrainOptions<'_>) -> Result<Outcome, TrainError> {
        let setup = Setup::new(config, &options.catalogue)?;
        training::train_with((self.build)(&setup)?, config, &setup, folder, options)
    }

    fn resume(&self, folder: &Path, options: TrainOptions<'_>) -> Result<Outcome, TrainError> {
        let folder = RunFolder::open(folder)?;
        let config = folder.read_config()?;
        training::resume_with::<S>(folder, config, None, options)
    }
}
