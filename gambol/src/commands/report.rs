use super::Outcome;
use clap::Args;
use gambol::{report, run_folder::RunFolder};
use std::{path::PathBuf, process::ExitCode};
use tasks::MovementCatalogue;

#[derive(Args)]
#[command(after_help = "Example:\n  gambol report runs/biped-1-running")]
pub(crate) struct Report {
    /// The folder of the run
    folder: PathBuf,
}

impl Report {
    pub(crate) fn run(self) -> Outcome {
        let folder = RunFolder::open(&self.folder)?;
        report::write_report(&folder, &MovementCatalogue::default(), None)?;
        say!("{}", folder.report().display())?;
        Ok(ExitCode::SUCCESS)
    }
}
