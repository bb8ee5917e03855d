use super::{DIVERGED, Outcome, gait::champion_file};
use crate::{
    Registry,
    champion::{CHAMPION_FORMAT, CHAMPION_VERSION, Champion, Engine, Verification},
};
use clap::Args;
use ne_core::archive;
use serde_json::json;
use std::{io, path::PathBuf, process::ExitCode};

#[derive(Args)]
#[command(after_help = "\
Example:
  gambol verify runs/biped-1-running/champion.json

Exit code 0: identical. 3: the replay differs, or the file was changed after it was saved.")]
pub(crate) struct Verify {
    /// A champion file, or the folder of a run
    champion: PathBuf,
    /// Print the result as JSON
    #[arg(long)]
    json: bool,
}

impl Verify {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let path = &champion_file(&self.champion)?;
        // A file whose content was edited is replayed too: the user wants to know what the edit did.
        let (content, digests) = archive::read_unverified(path, CHAMPION_FORMAT, CHAMPION_VERSION)?;
        let champion: Champion = archive::content(path, content)?;
        let unchanged = digests.expected == digests.found;
        let verification = champion.verify(registry).map_err(|error| format!("{}: {error}", path.display()))?;
        let identical = verification.is_identical();
        if self.json {
            let Verification { evaluation, recorded, diverges_at } = &verification;
            say!(
                "{}",
                json!({
                    "identical": identical, "unchanged": unchanged, "diverges_at_step": diverges_at,
                    "recorded_fitness": recorded, "fitness": evaluation.fitness(), "trained": champion.trained,
                })
            )?;
        } else {
            explain(&champion, &verification, unchanged)?;
        }
        Ok(if identical && unchanged { ExitCode::SUCCESS } else { ExitCode::from(DIVERGED) })
    }
}

fn explain(champion: &Champion, verification: &Verification, unchanged: bool) -> io::Result<()> {
    let Verification { evaluation, recorded, diverges_at } = verification;
    if !unchanged {
        say!("changed: the file was edited or damaged after it was saved (its digest does not fit)")?;
    }
    let engine = Engine::current();
    if champion.engine != engine {
        let (was, is) = (&champion.engine, &engine);
        say!("note: saved with {} {}, replayed with {} {}", was.name, was.version, is.name, is.version)?;
    }
    if let Some((trained, fitness)) = champion.trained.as_ref().and_then(|trained| Some((trained, trained.fitness?))) {
        let worlds = if trained.variation.is_none() { "without variation" } else { "in worlds that vary" };
        let bodies = super::in_bodies(trained.bodies);
        say!("training: fitness {fitness} in {}, {worlds}{bodies}", trained.engine.name())?;
    }
    let again = match &evaluation.outcome {
        Ok(fitness) => format!("fitness {fitness}"),
        Err(failure) => format!("failed: {failure}"),
    };
    match diverges_at {
        Some(step) => {
            let seconds = f64::from(*step) * f64::from(champion.physics.time_step);
            say!("differs: the trajectory diverges at step {step} ({seconds:.2} s); {again}, recorded {recorded}")?;
        }
        None if evaluation.fitness() == Some(*recorded) => {
            say!("identical: {again}, {} steps, to the bit", champion.trajectory.steps)?;
        }
        None => say!("differs: the same trajectory, but {again}, recorded {recorded}")?,
    }
    Ok(())
}
