use super::{
    Outcome,
    train::{Limits, RunFlags, carry_out},
};
use crate::{Registry, run_folder::RunFolder, shaping, training};
use clap::Args;
use std::path::PathBuf;

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol resume runs/biped-1-running                      go on after Ctrl-C, a crash or a power cut
  gambol resume runs/biped-1-running --generations 600    go on with a run that has ended

The rest of the run is, to the bit, what it would have been without the interruption. \
Exit codes are those of train: 3 for a run until usable that ends without a usable champion.")]
pub(crate) struct Resume {
    /// The folder of the run
    folder: PathBuf,
    #[command(flatten)]
    limits: Limits,
    #[command(flatten)]
    flags: RunFlags,
}

impl Resume {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let mut config = RunFolder::open(&self.folder)?.read_config()?;
        shaping::check_whole(&self.folder)?;
        config.stop = self.limits.beyond(config.stop);
        self.limits.until(&mut config, registry);
        let stop = Some(config.stop);
        carry_out(&self.flags, &config, registry.clone(), |options, stage_progress| match config.stages.is_empty() {
            true => Ok(training::resume(&self.folder, stop, options)?),
            false => Ok(shaping::resume_stages(&self.folder, stop, stage_progress, options)?),
        })
    }
}
