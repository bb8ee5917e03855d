//! `verify`: a champion does again what it did, or the first step at which it does not is named.

use crate::{
    damage::{edit, edit_and_seal, flip, json, places, raise_version, truncate, write},
    folder::{assert_untouched, contents, read},
    program::{assert_says, fail, gambol, run, small_run, small_run_of, succeed, text},
};
use serde_json::Value;
use std::{
    fs,
    path::{Path, PathBuf},
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const DIVERGED: Option<i32> = Some(3);

/// Verifies, and sees that nothing in the file's folder changes.
fn verify(champion: &Path, arguments: &[&str]) -> crate::program::Ended {
    let folder = champion.parent().expect("a folder");
    let before = contents(folder);
    let ended = run(gambol("verify").arg(champion).args(arguments));
    assert_untouched(folder, &before);
    ended
}

fn trained(folder: &tempfile::TempDir) -> PathBuf {
    let path = folder.path().join("run");
    succeed(small_run(&path, 4).arg("--quiet"));
    path.join("champion.json")
}

fn change_weight(content: &mut Value) {
    let weight = &mut content["network"]["weights"][3];
    *weight = (weight.as_f64().expect("a weight") + 0.5).into();
}

#[test]
fn every_trained_champion_is_identical() -> Outcome {
    let folder = tempfile::tempdir()?;
    let creatures = ["apod", "biped-1", "biped-2", "tetrapod-1", "tetrapod-2", "decapod-1", "decapod-2"];
    for (index, creature) in creatures.into_iter().enumerate() {
        let path = folder.path().join(creature);
        succeed(small_run_of(creature, ["running", "jumping"][index % 2], &path, 2).arg("--quiet"));
        let ended = verify(&path.join("champion.json"), &[]);
        assert_eq!(ended.code, Some(0), "{creature}: {}{}", ended.stdout, ended.stderr);
        assert_says(&ended.stdout, &["identical: fitness ", " steps, to the bit"]);
    }
    Ok(())
}

#[test]
fn the_folder_of_a_run_stands_for_its_champion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = trained(&folder);
    let run = run.parent().expect("a folder");
    for command in ["verify", "replay"] {
        let [of_run, of_file] = [run, &run.join("champion.json")].map(|path| succeed(gambol(command).arg(path)));
        assert_eq!(of_run, of_file);
    }
    let itself = fail(gambol("replay").arg(run).arg("--force").arg("--html").arg(run.join("champion.json")));
    assert_says(&itself, &["champion.json is the champion itself"]);
    assert_says(&fail(gambol("verify").arg(folder.path())), &["is not the folder of a run"]);
    Ok(())
}

#[test]
fn a_champion_of_several_varied_trials_is_identical() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let mut train = small_run(&path, 3);
    train.args(["--set", "trials.count=3", "--set", "trials.combine=worst", "--set", "variation.mass=0.2"]);
    succeed(train.args(["--set", r#"movement.terms=[{"term":"fall-ends","weight":-1}]"#]));
    assert_eq!(verify(&path.join("champion.json"), &[]).code, Some(0));
    Ok(())
}

#[test]
fn json_says_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    let said = |code: i32| {
        let ended = verify(&champion, &["--json"]);
        assert_eq!(ended.code, Some(code), "{}", ended.stderr);
        serde_json::from_str::<Value>(&ended.stdout)
    };
    let result = said(0)?;
    assert_eq!((&result["identical"], &result["unchanged"]), (&true.into(), &true.into()));
    assert_eq!(result["fitness"], json(&champion)["content"]["fitness"]);
    edit(&champion, change_weight);
    let result = said(3)?;
    assert_eq!((&result["identical"], &result["unchanged"]), (&false.into(), &false.into()));
    assert!(result["diverges_at_step"].is_u64());
    Ok(())
}

/// The step that is named is the first whose row in the two trajectories is another.
#[test]
fn edited_weights_are_named_by_the_first_step_that_differs() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    let trajectory = |name: &str| -> Result<String, std::io::Error> {
        let csv = folder.path().join(name);
        succeed(gambol("replay").arg(&champion).arg("--trajectory").arg(&csv));
        fs::read_to_string(csv)
    };
    let before = trajectory("before.csv")?;
    edit_and_seal(&champion, change_weight);
    let after = trajectory("after.csv")?;
    let rows = before.lines().zip(after.lines()).find(|(one, other)| one != other);
    let step = rows.and_then(|(row, _)| row.split(',').next()).expect("they differ");
    assert_ne!(step, "0", "both start in the same pose");

    let ended = verify(&champion, &[]);
    assert_eq!(ended.code, DIVERGED);
    assert_says(&ended.stdout, &[&format!("the trajectory diverges at step {step} ("), "recorded"]);
    assert!(!ended.stdout.contains("changed:"), "its digest fits: {}", ended.stdout);
    Ok(())
}

#[test]
fn weights_edited_by_hand_are_replayed_and_the_edit_is_told() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    edit(&champion, change_weight);
    let ended = verify(&champion, &[]);
    assert_eq!(ended.code, DIVERGED);
    assert_says(&ended.stdout, &["changed: the file was edited", "the trajectory diverges at step "]);
    Ok(())
}

#[test]
fn a_flattered_fitness_is_told() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    edit_and_seal(&champion, |content| content["fitness"] = 1000.0.into());
    let ended = verify(&champion, &[]);
    assert_eq!(ended.code, DIVERGED);
    assert_says(&ended.stdout, &["differs: the same trajectory, but fitness ", "recorded 1000"]);
    Ok(())
}

/// An edit of a comment changes nothing the champion does; it is no longer the file that was saved all the same.
#[test]
fn an_edit_that_changes_no_step_is_told() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    edit(&champion, |content| content["creature"]["title"] = "The Lady".into());
    let ended = verify(&champion, &[]);
    assert_eq!(ended.code, DIVERGED);
    assert_says(&ended.stdout, &["changed: the file was edited", "identical: "]);
    Ok(())
}

#[test]
fn a_truncated_champion_is_an_error_with_line_and_column() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    let whole = read(&champion);
    for place in places(&champion, 12) {
        truncate(&champion, place);
        let ended = verify(&champion, &[]);
        assert_eq!(ended.code, Some(1), "{place} bytes: {}", ended.stdout);
        assert_says(&ended.stderr, &[text(&champion), "line ", "column "]);
        write(&champion, &whole);
    }
    Ok(())
}

#[test]
fn no_flipped_bit_makes_a_champion_look_whole() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    let (whole, value) = (read(&champion), json(&champion));
    for (bit, place) in places(&champion, 120).enumerate() {
        flip(&champion, place, bit);
        // The e of an exponent may become an E.
        if serde_json::from_slice::<Value>(&read(&champion)).ok().as_ref() != Some(&value) {
            let ended = verify(&champion, &[]);
            match ended.code {
                Some(1) => assert_says(&ended.stderr, &[text(&champion)]),
                DIVERGED => assert_says(&ended.stdout, &["changed: the file was edited or damaged"]),
                code => panic!("bit {} of byte {place}: {code:?} {}", bit % 8, ended.stdout),
            }
        }
        write(&champion, &whole);
    }
    Ok(())
}

#[test]
fn a_file_of_another_version_or_kind_is_told() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    let run = champion.parent().expect("a folder");
    raise_version(&champion);
    assert_says(&verify(&champion, &[]).stderr, &[text(&champion), "has version 3", "use a newer Gambol"]);
    for (other, kind) in [("config.json", "\"gambol run\""), ("checkpoint", "\"gambol checkpoint\"")] {
        let path = run.join(other);
        let message = fail(gambol("verify").arg(&path));
        assert_says(&message, &[text(&path), kind, "expected a \"gambol champion\" file"]);
    }
    assert_says(&fail(gambol("verify").arg(run)), &[text(&champion), "has version 3"]);
    let missing = run.join("no-such-file");
    assert_says(&fail(gambol("verify").arg(&missing)), &["cannot read", text(&missing)]);
    Ok(())
}

/// What fits together for the parser may still make no sense.
#[test]
fn a_champion_whose_parts_do_not_fit_is_an_error_that_names_the_field() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    let whole = read(&champion);
    type Change = fn(&mut Value);
    let changes: [(Change, &str); 6] = [
        (|content| content["movement"]["name"] = "runing".into(), "movement.name"),
        (|content| content["physics"]["time_step"] = 0.into(), "physics.time_step"),
        (|content| content["network"]["weights"] = Value::Array(vec![]), "field network: weights"),
        (|content| content["creature"]["parts"][1]["density"] = (-1).into(), "parts[1].density"),
        (|content| content["fitness"] = "high".into(), "fitness"),
        (|content| content["trials"]["count"] = 0.into(), "trials.count"),
    ];
    for (change, field) in changes {
        edit_and_seal(&champion, change);
        let ended = verify(&champion, &[]);
        assert_eq!(ended.code, Some(1), "{field}: {}", ended.stdout);
        assert_says(&ended.stderr, &[text(&champion), field]);
        write(&champion, &whole);
    }
    Ok(())
}

/// Marks are half of the digest: one trajectory in four thousand million has those of another. The whole counts as well.
#[test]
fn the_digest_of_the_whole_trajectory_is_compared_too() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    edit_and_seal(&champion, |content| {
        let digest = content["trajectory"]["digest"].as_str().expect("a text").to_owned();
        let first = if digest.starts_with('0') { "1" } else { "0" };
        content["trajectory"]["digest"] = format!("{first}{}", &digest[1..]).into();
    });
    let ended = verify(&champion, &[]);
    assert_eq!(ended.code, DIVERGED, "{}", ended.stdout);
    let steps = json(&champion)["content"]["trajectory"]["steps"].as_u64().ok_or("a number")?;
    assert_says(&ended.stdout, &[&format!("differs: the trajectory diverges at step {steps} ")]);
    Ok(())
}

/// A game connects inputs and outputs by their names: those in the file are those of the body.
#[test]
fn names_of_inputs_and_outputs_are_those_of_the_body() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(&folder);
    let whole = read(&champion);
    type Change = fn(&mut Value);
    let changes: [(Change, &[&str]); 4] = [
        (|content| content["inputs"][1]["name"] = "wheel".into(), &["inputs[1].name: \"wheel\", where ", " has \""]),
        (|content| content["outputs"][0]["unit"] = "mph".into(), &["outputs[0].unit: \"mph\", where "]),
        (
            |content| content["inputs"][0]["range"] = serde_json::json!([-7, 7]),
            &["inputs[0].range: [-7.0, 7.0], where "],
        ),
        (|content| drop(content["outputs"].as_array_mut().map(Vec::pop)), &["outputs: ", " of them, where "]),
    ];
    for (change, says) in changes {
        edit_and_seal(&champion, change);
        for command in ["verify", "replay", "check"] {
            let message = fail(gambol(command).arg(&champion));
            assert_says(&message, says);
            assert_says(&message, &[text(&champion)]);
        }
        write(&champion, &whole);
    }
    assert_eq!(verify(&champion, &[]).code, Some(0));
    Ok(())
}
