//! Rungs: fewer physics steps for as many individuals, and everything a run promises as before.

use crate::{
    damage::json,
    folder::{assert_same_run, read},
    killed::kill_after,
    program::{WITHOUT_SELECTION, assert_says, gambol, long_run, small_run, succeed, text},
};
use serde_json::Value;
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A third of the steps in one trial, then all steps in two of the three trials.
const HEATS: [&str; 4] =
    ["--set", "trials.count=3", "--set", r#"rungs=[{"steps":20,"trials":1,"share":0.5},{"trials":2,"share":0.5}]"#];

fn train(folder: &Path, flags: &[&str]) -> Command {
    let mut train = small_run(folder, 12);
    train.args(HEATS).args(flags);
    train
}

/// The last line of the log.
fn last_line(run: &Path) -> Result<Value, Box<dyn std::error::Error>> {
    let log = fs::read_to_string(run.join("log.jsonl"))?;
    Ok(serde_json::from_str(log.lines().last().ok_or("a line")?)?)
}

fn verify(run: &Path) {
    assert_says(&succeed(gambol("verify").arg(run.join("champion.json"))), &["identical: "]);
}

#[test]
fn rungs_save_steps_and_the_champion_is_one_that_was_evaluated_whole() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (name, champion_selection) in
        [("with-champion_selection", &["--variation", "light"][..]), ("without", &WITHOUT_SELECTION)]
    {
        let [rungs, whole] = ["rungs", "whole"].map(|run| folder.path().join(name).join(run));
        // Nothing ends an episode early, so that steps can be told beforehand.
        let plain = [champion_selection, &["--set", "movement.terms=[]"]].concat();
        succeed(&mut train(&rungs, &plain));
        succeed(train(&whole, &plain).args(["--set", "rungs=[]"]));
        verify(&rungs);
        // Of 8 all run 20 steps, 4 run two trials of 60 as well, 2 of these three.
        let (fewer, all) = (last_line(&rungs)?, last_line(&whole)?);
        assert_eq!(fewer["steps"], 12 * (8 * 20 + 4 * 2 * 60 + 2 * 3 * 60), "{name}");
        assert_eq!((&all["steps"], &all["evaluations"]), (&(12 * 8 * 3 * 60).into(), &fewer["evaluations"]), "{name}");
        // A run without rungs says nothing of them, as before there were any.
        let rungs_of = |run: &Path| json(&run.join("config.json"))["content"].get("rungs").cloned();
        assert_eq!((rungs_of(&whole), rungs_of(&rungs).is_some()), (None, true));
    }
    Ok(())
}

#[test]
fn threads_and_engines_give_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (name, champion_selection) in
        [("with-champion_selection", &["--variation", "light"][..]), ("without", &WITHOUT_SELECTION)]
    {
        let run = |run: &str, flags: &[&str]| {
            let path = folder.path().join(name).join(run);
            succeed(train(&path, champion_selection).args(flags));
            path
        };
        let one = run("one", &["--threads", "1"]);
        let two = run("two", &["--threads", "2"]);
        assert_same_run(&one, &two);
        let rapier = run("rapier", &["--threads", "2", "--engine", "rapier"]);
        for file in ["log.jsonl", "gallery.jsonl", "checkpoint"] {
            assert_eq!(read(&one.join(file)), read(&rapier.join(file)), "{file}, {name}");
        }
        // The configuration of a run repeats it.
        let again = folder.path().join(name).join("again");
        let mut repeat = gambol("train");
        repeat.args(["--config", text(&one.join("config.json")), "--no-report", "--out", text(&again)]);
        succeed(&mut repeat);
        assert_same_run(&one, &again);
        verify(&two);
        verify(&rapier);
    }
    Ok(())
}

/// Each strategy is told what those left behind are worth, and goes on.
#[test]
fn every_strategy_can_be_told_of_rungs() -> Outcome {
    let folder = tempfile::tempdir()?;
    for strategy in ["cma-es", "conventional", "neat", "open-es", "cosyne"] {
        let path = folder.path().join(strategy);
        let mut train = train(&path, &[&WITHOUT_SELECTION[..], &["--strategy", strategy]].concat());
        if strategy == "neat" {
            // With so few species as a small population has.
            train.args(["--set", "strategy.neat.speciation.target.species=2"]);
        }
        succeed(&mut train);
        verify(&path);
    }
    Ok(())
}

#[test]
fn a_run_in_rungs_that_is_killed_and_resumed_gives_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (name, champion_selection) in
        [("with-champion_selection", &["--variation", "light"][..]), ("without", &WITHOUT_SELECTION)]
    {
        let [whole, killed] = ["whole", "killed"].map(|run| folder.path().join(name).join(run));
        let train = |path: &Path| {
            let mut train = long_run(path);
            train.args(["--threads", "1", "--set", "record.checkpoint_every=7"]).args(champion_selection);
            train.args(["--set", r#"rungs=[{"steps":5,"share":0.7},{"steps":10,"share":0.4}]"#]);
            train
        };
        succeed(train(&whole).arg("--quiet"));
        kill_after(&mut train(&killed), &killed, 12);
        succeed(gambol("resume").arg(&killed).args(["--threads", "2", "--no-report"]));
        assert_same_run(&whole, &killed);
    }
    Ok(())
}
