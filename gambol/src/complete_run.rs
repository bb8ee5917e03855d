//! A lesson: a movement learnt from the first generation to the proof, in one call.

use crate::Registry;
use crate::{
    champion::{Champion, Verification},
    config::RunConfig,
    episode_parts::SetupError,
    report::{ReportError, write_report},
    run_folder::FolderError,
    shaping::why_all_failed,
    training::{TrainError, TrainOptions, train},
};
use std::path::Path;

/// Why a lesson came to nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CompleteRunError {
    /// The run could not be started, or broke off.
    #[error(transparent)]
    Train(#[from] TrainError),
    /// The report could not be written.
    #[error(transparent)]
    Report(#[from] ReportError),
    /// The champion's task cannot be built again.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// There is no champion.
    #[error("every evaluation failed: {reason}")]
    NoChampion {
        /// The commonest reason in the last generation.
        reason: String,
    },
    /// The log could not be read again.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The champion does not repeat itself, as a movement that is not deterministic makes it.
    #[error("the champion does not repeat itself: {0:?}")]
    NotRepeated(Box<Verification>),
}

/// Trains a configuration on all cores, writes the report into the run's folder, and verifies the champion: what `gambol
/// train` and `gambol verify` do, for a program with movements of its own.
///
/// # Errors
/// As [`train`] and [`write_report`]; and if every evaluation failed, or the champion does not do the same again.
pub fn train_and_verify(config: &RunConfig, folder: &Path, registry: &Registry) -> Result<Champion, CompleteRunError> {
    let options =
        TrainOptions { threads: 0, registry: registry.clone(), signal: Default::default(), on_generation: &mut |_| {} };
    let outcome = train(config, folder, options)?;
    write_report(&outcome.folder, registry, Some(outcome.reason))?;
    let Some(champion) = outcome.champion else {
        let reason = why_all_failed(&outcome.folder)?.unwrap_or_else(|| "no generation was done".into());
        return Err(CompleteRunError::NoChampion { reason });
    };
    match champion.verify(registry)? {
        verification if verification.is_identical() => Ok(champion),
        verification => Err(CompleteRunError::NotRepeated(Box::new(verification))),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU32, Ordering};
    use tasks::{Movement, Snapshot, Verdict};

    /// A movement with a flaw, which is its name.
    #[derive(Clone, Default)]
    struct Flawed<const FAILS: bool>;

    static BEGUN: AtomicU32 = AtomicU32::new(0);

    impl<const FAILS: bool> Movement for Flawed<FAILS> {
        fn name(&self) -> &str {
            if FAILS { "failing" } else { "counting" }
        }
        fn unit(&self) -> &str {
            "1"
        }
        fn begin(&mut self, _: &Snapshot) {
            BEGUN.fetch_add(1, Ordering::Relaxed);
        }
        fn observe(&mut self, _: &Snapshot) -> Verdict {
            if FAILS { Verdict::Fail("on purpose") } else { Verdict::GoOn }
        }
        fn value(&self) -> f64 {
            BEGUN.load(Ordering::Relaxed).into()
        }
    }

    #[test]
    fn a_lesson_tells_why_it_came_to_nothing() -> Result<(), Box<dyn std::error::Error>> {
        let mut registry = Registry::default();
        registry.movements.add::<Flawed<true>>(Some(10), "fails");
        registry.movements.add::<Flawed<false>>(Some(10), "counts its episodes");
        let folder = tempfile::tempdir()?;
        for (movement, says) in [
            ("failing", "every evaluation failed: on purpose"),
            ("counting", "the champion does not repeat itself: Verification"),
            ("nothing", "movement.name: there is no movement or term \"nothing\""),
        ] {
            let mut config = registry.config("thesis", creatures::find("biped-1")?, movement)?;
            config.stop.generations = Some(1);
            let message =
                train_and_verify(&config, &folder.path().join(movement), &registry).map(|_| ()).expect_err(movement);
            assert!(message.to_string().starts_with(says), "{message}");
        }
        assert!(folder.path().join("failing/report.html").is_file());
        Ok(())
    }
}
