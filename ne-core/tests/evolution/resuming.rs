use crate::{TASK, common::Climber, evolution, state};
use ne_core::{
    Checkpoint, Evolution, Generation, Observer, ObserverError, Parallel, Seed, Serial, StopConditions,
    archive::ArchiveError,
};
use std::{fs, path::PathBuf};

const GENERATIONS: u64 = 10;

fn stop(generations: u64) -> StopConditions {
    StopConditions { generations: Some(generations), ..Default::default() }
}

#[test]
fn a_run_resumed_at_any_generation_ends_the_same() -> Result<(), Box<dyn std::error::Error>> {
    let mut whole = evolution(GENERATIONS);
    whole.run(&TASK, &Serial, &mut [])?;
    let (folder, threads) = (tempfile::tempdir()?, Parallel::new(3)?);
    let path = folder.path().join("checkpoint");
    for until in 0..=GENERATIONS {
        let mut first = evolution(until);
        if until > 0 {
            first.run(&TASK, &Serial, &mut [])?;
        }
        first.write_checkpoint(&path)?;
        let checkpoint = Checkpoint::<Climber>::read(&path)?;
        let mut second = Evolution::resume(checkpoint, stop(GENERATIONS));
        assert_eq!(state(&second), state(&first), "as read after generation {until}");
        assert_eq!(second.seed(), Seed::of_run(5));
        second.run(&TASK, &threads, &mut [])?;
        assert_eq!(state(&second), state(&whole), "resumed after generation {until}");
    }
    Ok(())
}

/// Writes a checkpoint a generation, each into a file of its own.
struct Keeper(PathBuf);

impl Observer<Climber> for Keeper {
    fn generation(&mut self, generation: &Generation<'_, Climber>) -> Result<(), ObserverError> {
        generation.write_checkpoint(&self.0.join(generation.report.generation.to_string()))?;
        Ok(())
    }
}

#[test]
fn an_observers_checkpoint_is_the_evolutions() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    evolution(3).run(&TASK, &Serial, &mut [Box::new(Keeper(folder.path().into()))])?;
    for generation in 1..=3 {
        let mut plain = evolution(generation);
        plain.run(&TASK, &Serial, &mut [])?;
        let path = folder.path().join("plain");
        plain.write_checkpoint(&path)?;
        assert_eq!(fs::read(folder.path().join(generation.to_string()))?, fs::read(&path)?, "generation {generation}");
        // What is read and written again is the same file.
        Checkpoint::<Climber>::read(&path)?.write(&folder.path().join("again"))?;
        assert_eq!(fs::read(folder.path().join("again"))?, fs::read(&path)?);
    }
    Ok(())
}

#[test]
fn a_checkpoint_of_another_strategy_names_the_field() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("checkpoint");
    let scripted = crate::scripted::Script::evolution(&[&[1.0]], stop(1));
    scripted.write_checkpoint(&path)?;
    let error = Checkpoint::<Climber>::read(&path).expect_err("it is not a climber's");
    assert!(matches!(error, ArchiveError::Content { .. }), "{error}");
    assert!(error.to_string().contains("checkpoint: field strategy"), "{error}");
    Ok(())
}
