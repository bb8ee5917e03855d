use super::Outcome;
use crate::{Registry, report, run_folder::RunFolder};
use clap::Args;
use std::{path::PathBuf, process::ExitCode};

#[derive(Args)]
#[command(after_help = "Example:\n  gambol report runs/biped-1-running")]
pub(crate) struct Report {
    /// The folder of the run
    folder: PathBuf,
}

impl Report {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let folder = RunFolder::open(&self.folder)?;
        report::write_report(&folder, registry, None)?;
        say!("{}", folder.report().display())?;
        Ok(ExitCode::SUCCESS)
    }
}
