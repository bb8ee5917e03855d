//! Names and files that somebody else chose: what a terminal, a shell and a spreadsheet see of them.

use crate::{
    bad_creatures,
    damage::json,
    program::{assert_says, fail, gambol, run, small_run, succeed, text},
    reporting::data,
};
use serde_json::{Value, json};
use std::{fs, path::Path};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Clears the screen, renames the window, and a control character of one byte of Latin-1.
const ESCAPES: &str = "\u{1b}[2J\u{1b}]0;x\u{7}\u{9b}2J";

fn creature_with_part(folder: &Path, name: &str) -> Result<std::path::PathBuf, Box<dyn std::error::Error>> {
    let mut creature = bad_creatures::creature();
    let old = creature["parts"][1]["name"].clone();
    creature["parts"][1]["name"] = name.into();
    for joint in creature["joints"].as_array_mut().expect("a list") {
        for end in ["parent", "child"] {
            if joint[end] == old {
                joint[end] = name.into();
            }
        }
    }
    let path = folder.join("creature.json");
    fs::write(&path, creature.to_string())?;
    Ok(path)
}

#[test]
fn control_characters_of_a_file_do_not_reach_the_terminal() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = creature_with_part(folder.path(), &format!("leg{ESCAPES}"))?;
    let message = fail(gambol("check").arg(&path));
    assert_says(&message, &["characters without line breaks", "leg\\u{1b}[2J"]);
    assert!(!message.contains(|c: char| c.is_control() && c != '\n'), "{message:?}");
    let path = creature_with_part(folder.path(), "leg")?;
    let mut creature = json(&path);
    creature["parts"][1]["density"] = (-1).into();
    creature["joints"][0]["parent"] = ESCAPES.into();
    fs::write(&path, creature.to_string())?;
    let message = fail(gambol("check").arg(&path));
    assert!(!message.contains(|c: char| c.is_control() && c != '\n'), "{message:?}");
    let message = fail(gambol("train").arg(ESCAPES).arg("running"));
    assert!(!message.contains(|c: char| c.is_control() && c != '\n'), "{message:?}");
    Ok(())
}

#[test]
fn commands_that_are_told_can_be_pasted() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("my run; $(touch x)");
    succeed(small_run(&path, 2).arg("--quiet"));
    succeed(gambol("report").arg(&path));
    let page = fs::read_to_string(path.join("report.html"))?;
    let data = data(&page).to_string();
    let word = format!("resume '{}'", text(&path));
    assert_says(&data, &[&word]);
    let message = fail(&mut small_run(&path, 2));
    assert_says(&message, &["already exists", &word]);
    Ok(())
}

#[test]
fn a_spreadsheet_computes_nothing_and_the_trajectory_is_read_again() -> Outcome {
    let folder = tempfile::tempdir()?;
    let creature = creature_with_part(folder.path(), "=1+1")?;
    let path = folder.path().join("run");
    let mut train = gambol("train");
    train.arg(&creature).args(["running", "--population", "8", "--generations", "1", "--quiet", "--no-report"]);
    succeed(train.args(["--set", "movement.steps=60", "--out"]).arg(&path));
    let csv = folder.path().join("gait.csv");
    succeed(gambol("replay").arg(&path).arg("--trajectory").arg(&csv).args(["--seconds", "2"]));
    let rows = fs::read_to_string(&csv)?;
    assert!(rows.contains(",'=1+1,") && !rows.contains(",=1+1"), "{rows}");
    let measured = run(gambol("gait").arg(&csv).arg("--creature").arg(&creature));
    assert!([Some(0), Some(3)].contains(&measured.code), "{}", measured.stderr);
    Ok(())
}

#[test]
fn a_file_without_an_end_is_refused() -> Outcome {
    let zero = Path::new("/dev/zero");
    if zero.exists() {
        for command in [&["check"][..], &["verify"], &["train", "biped-1", "running", "--config"]] {
            let message = fail(gambol(command[0]).args(&command[1..]).arg(zero));
            assert_says(&message, &["/dev/zero", "the most such a file may have"]);
        }
    }
    let folder = tempfile::tempdir()?;
    let huge = folder.path().join("huge.json");
    // Sparse: it takes no room.
    fs::File::create(&huge)?.set_len(9 << 20)?;
    let message = fail(gambol("train").arg(&huge).arg("running"));
    assert_says(&message, &[text(&huge), "it has more than 8 MiB, the most such a file may have"]);
    Ok(())
}

#[test]
fn an_edited_copy_of_a_configuration_is_used_and_said() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(small_run(&path, 1).arg("--quiet"));
    let copy = folder.path().join("copy.json");
    let mut config = json(&path.join("config.json"));
    fs::write(&copy, config.to_string())?;
    assert_eq!(run(gambol("check").arg(&copy)).stderr, "");
    config["content"]["seed"] = 77.into();
    fs::write(&copy, config.to_string())?;
    let said = [text(&copy), "was changed after a run wrote it"];
    let checked = run(gambol("check").arg(&copy));
    assert_eq!(checked.code, Some(0));
    assert_says(&checked.stderr, &said);
    let again = folder.path().join("again");
    let trained = run(gambol("train").arg("--config").arg(&copy).arg("--out").arg(&again).arg("--no-report"));
    assert_eq!(trained.code, Some(0));
    assert_says(&trained.stderr, &said);
    assert_eq!(json(&again.join("config.json"))["content"]["seed"], 77);
    Ok(())
}

#[test]
fn a_movement_that_is_no_name_is_said() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("config.json");
    for (config, field, found) in [
        (json!({ "creature": "biped-1", "movement": { "name": 7 } }), "movement.name: must be a name", "found 7"),
        (json!({ "creature": "biped-1", "movement": 7 }), "movement: must be", "found 7"),
    ] {
        fs::write(&file, config.to_string())?;
        assert_says(&fail(gambol("train").arg("--config").arg(&file)), &[text(&file), field, found, "running"]);
    }
    Ok(())
}

#[test]
fn two_outputs_of_a_replay_are_two_files() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(small_run(&path, 1).arg("--quiet"));
    let mut replay = gambol("replay");
    replay.arg(&path).args(["--html", "./q", "--trajectory", "q"]).current_dir(folder.path());
    assert_says(&fail(&mut replay), &["cannot be both the page and the trajectory"]);
    assert!(!folder.path().join("q").exists());
    Ok(())
}

#[cfg(unix)]
#[test]
fn a_folder_whose_name_is_no_text_is_a_folder() -> Outcome {
    use std::os::unix::ffi::OsStrExt;
    let folder = tempfile::tempdir()?;
    let path = folder.path().join(std::ffi::OsStr::from_bytes(b"run-\xff"));
    let printed = succeed(small_run(&path, 2).arg("--json"));
    let result: Value = serde_json::from_str(printed.lines().last().expect("a result"))?;
    assert!(result["result"]["folder"].as_str().is_some_and(|name| name.ends_with("run-\u{fffd}")), "{result}");
    assert!(path.join("champion.json").is_file());
    Ok(())
}
