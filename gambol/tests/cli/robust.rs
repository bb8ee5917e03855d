//! `robust`: what is left of a champion in perturbed worlds.

use crate::{
    damage::edit_and_seal,
    program::{assert_says, fail, gambol, run, small_run_of, succeed, text},
};
use serde_json::Value;
use std::path::{Path, PathBuf};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn trained(folder: &Path, movement: &str) -> PathBuf {
    let path = folder.join(movement);
    succeed(small_run_of("biped-1", movement, &path, 2).args(["--preset", "thesis", "--quiet"]));
    path.join("champion.json")
}

fn robust(champion: &Path, perturbations: &str, arguments: &[&str]) -> String {
    succeed(gambol("robust").arg(champion).args(["--json", "--perturbations", perturbations]).args(arguments))
}

#[test]
fn worlds_come_from_the_seed_and_not_from_the_threads() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "jumping");
    let one = robust(&champion, "4", &["--threads", "1"]);
    assert_eq!(one, robust(&champion, "4", &["--threads", "3"]));
    assert_eq!(one, robust(&champion, "4", &["--seed", "1"]));
    let other = robust(&champion, "4", &["--seed", "2"]);
    assert_ne!(one, other);
    let one: Value = serde_json::from_str(&one)?;
    let trials = one["trials"].as_array().expect("a list");
    assert_eq!(trials.len(), 4);
    let causes: Vec<_> = trials.iter().map(|trial| trial["cause"].as_str().expect("a name")).collect();
    assert_eq!(causes, ["bumps", "pushes", "friction", "physics"], "they take turns");
    let more_than_none = |field: &str| trials.iter().map(|trial| trial[field].as_u64() > Some(0)).collect::<Vec<_>>();
    assert_eq!(more_than_none("bumps"), [true, false, false, false]);
    assert_eq!(more_than_none("pushes"), [false, true, false, false]);
    assert_ne!(trials[2]["friction"], 1.0);
    assert_ne!(trials[3]["time_step_s"], trials[0]["time_step_s"]);
    // More worlds begin with the same ones.
    let more: Value = serde_json::from_str(&robust(&champion, "5", &[]))?;
    assert_eq!(more["trials"].as_array().expect("a list")[..4], trials[..]);
    Ok(())
}

#[test]
fn worlds_can_be_those_of_a_variation() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "jumping");
    let result: Value = serde_json::from_str(&robust(&champion, "3", &["--variation", "bumpy"]))?;
    for trial in result["trials"].as_array().expect("a list") {
        assert_eq!(trial["cause"], "variation");
        assert!(trial["bumps"].as_u64() > Some(0) && trial["pushes"].as_u64() > Some(0), "{trial}");
    }
    assert_eq!(result["causes"][0]["worlds"], 3);
    let told = succeed(gambol("robust").arg(&champion).args(["--perturbations", "3", "--variation", "light"]));
    assert!(told.contains("as varied        0 % of 3"), "{told}");
    assert_says(&fail(gambol("robust").arg(&champion).args(["--variation", "lihgt"])), &["lihgt", "light"]);
    Ok(())
}

#[test]
fn a_champion_that_stands_still_is_usable_nowhere() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (movement, reason) in [("running", "slow"), ("jumping", "never-aloft")] {
        let champion = trained(folder.path(), movement);
        edit_and_seal(&champion, |content| {
            let weights = content["network"]["weights"].as_array_mut().expect("a list");
            weights.iter_mut().for_each(|weight| *weight = 0.into());
        });
        let result: Value = serde_json::from_str(&robust(&champion, "4", &[]))?;
        assert_eq!((&result["usable_share"], &result["usable_unperturbed"]), (&0.0.into(), &false.into()));
        let reasons = result["reasons"].as_array().expect("a list");
        let share = reasons.iter().find(|entry| entry["reason"] == reason).map(|entry| &entry["share"]);
        assert_eq!(share, Some(&1.0.into()), "{movement}: {reasons:?}");
        let told = succeed(gambol("robust").arg(&champion).args(["--perturbations", "2"]));
        let first = format!("biped-1 {movement}: usable in 0 % of 2 perturbed worlds");
        assert_says(&told, &[&first, "100 %", &reason.replace('-', " "), "unperturbed      not usable"]);
    }
    Ok(())
}

#[test]
fn wrong_settings_are_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "running");
    for number in ["0", "-3", "100001", "many"] {
        let ended = run(gambol("robust").arg(&champion).args(["--perturbations", number]));
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        assert_says(&ended.stderr, &["--perturbations", number]);
    }
    let ended = run(gambol("robust").arg(&champion).args(["--threads", "5000"]));
    assert_eq!(ended.code, Some(2));
    edit_and_seal(&champion, |content| content["physics"]["time_step"] = 0.into());
    assert_says(&fail(gambol("robust").arg(&champion)), &[text(&champion), "physics.time_step"]);
    Ok(())
}
