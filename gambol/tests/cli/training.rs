use crate::{
    folder::LASTING,
    program::{WITHOUT_SELECTION, assert_says, fail, gambol, run, small_run, small_run_of, succeed, text},
};
use serde_json::Value;
use std::{collections::BTreeSet, fs};

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn a_run_leaves_every_file_it_promises_and_no_other() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("deep/below/run");
    let mut train = gambol("train");
    train.args([
        "biped-1",
        "running",
        "--set",
        "movement.steps=60",
        "--population",
        "8",
        "--generations",
        "4",
        "--out",
    ]);
    succeed(train.arg(&run));
    let found = fs::read_dir(&run)?.map(|entry| Ok(entry?.file_name().into_string().expect("plain names")));
    let promised = LASTING.iter().chain(&["timing.jsonl", "report.html", ".lock"]).map(ToString::to_string);
    assert_eq!(found.collect::<Result<BTreeSet<_>, std::io::Error>>()?, promised.collect());
    for name in ["log.jsonl", "timing.jsonl"] {
        assert_eq!(fs::read_to_string(run.join(name))?.lines().count(), 4, "{name} has a line a generation");
    }
    Ok(())
}

#[test]
fn quiet_prints_nothing() -> Outcome {
    let folder = tempfile::tempdir()?;
    let ended = run(small_run(&folder.path().join("run"), 2).arg("--quiet"));
    assert_eq!((ended.code, ended.stdout.as_str(), ended.stderr.as_str()), (Some(0), "", ""));
    Ok(())
}

#[test]
fn json_is_a_line_for_each_generation_and_one_for_the_result() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let ended = run(small_run(&path, 5).args(["--json", "--engine", "rapier"]).args(WITHOUT_SELECTION));
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""));
    let lines = ended.stdout.lines().map(serde_json::from_str).collect::<Result<Vec<Value>, _>>()?;
    let (result, generations) = lines.split_last().expect("six lines");
    let numbers = generations.iter().map(|line| line["generation"]["generation"].as_u64());
    assert!(numbers.eq((1..=5).map(Some)), "{}", ended.stdout);
    let result = &result["result"];
    assert_eq!(result["folder"], text(&path));
    assert_eq!(result["reason"], "generations");
    assert_eq!(result["progress"]["evaluations"], 40);
    assert_eq!(result["fitness"], generations[4]["generation"]["best_so_far"]);
    assert_eq!(result["trained"], Value::Null, "its fitness is that of training");
    Ok(())
}

/// What two generations have learned is no gait: the run says so, and what `gambol gait` says against it.
#[test]
fn a_run_that_finds_nothing_usable_says_so_and_why() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let told = succeed(&mut small_run(&path, 2));
    let judged = run(gambol("gait").arg(&path));
    assert_eq!(judged.code, Some(3));
    let reasons: Vec<&str> = judged.stdout.lines().skip(1).map_while(|line| line.strip_prefix("  ")).collect();
    assert!(!reasons.is_empty(), "{}", judged.stdout);
    assert_says(&told, &[&format!("\ngait      not usable: {}\n", reasons.join("; "))]);
    let json = |arguments: &mut std::process::Command| -> Result<Value, serde_json::Error> {
        let ended = run(arguments);
        let line: Value = serde_json::from_str(ended.stdout.lines().last().expect("a result"))?;
        Ok(line["result"]["verdict"].clone())
    };
    let report: Value = serde_json::from_str(&run(gambol("gait").arg(&path).arg("--json")).stdout)?;
    assert_eq!(report["verdict"]["usable"], false);
    let again = folder.path().join("again");
    assert_eq!(json(small_run(&again, 2).arg("--json"))?, report["verdict"]);
    // More generations, and what came of them.
    let resumed = json(gambol("resume").arg(&again).args(["--json", "--no-report", "--generations", "3"]))?;
    assert!(resumed["usable"].is_boolean(), "{resumed}");
    let standing = folder.path().join("standing");
    let mut train = small_run_of("biped-1", "standing", &standing, 2);
    assert_eq!(json(train.arg("--json"))?, Value::Null, "standing is not judged");
    Ok(())
}

#[test]
fn a_run_until_usable_that_finds_nothing_usable_ends_with_exit_code_3() -> Outcome {
    let folder = tempfile::tempdir()?;
    for flag in ["--quiet", "--json"] {
        let path = folder.path().join(flag);
        let ended = run(small_run(&path, 2).args(["--until", "usable", flag]));
        assert_eq!(ended.code, Some(3), "{flag}: {}{}", ended.stdout, ended.stderr);
        assert_eq!(ended.stderr, "");
        // The run has been saved, and goes on.
        let mut resume = gambol("resume");
        resume.arg(&path).args(["--quiet", "--no-report", "--until", "usable", "--generations", "3"]);
        assert_eq!(run(&mut resume).code, Some(3));
    }
    Ok(())
}

/// What is for programs (where the result is) goes to standard output, what passes by to standard error.
#[test]
fn without_a_terminal_progress_is_plain_lines_on_standard_error() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let ended = run(&mut small_run(&path, 3));
    assert_eq!(ended.code, Some(0));
    assert_says(&ended.stderr, &["biped-1 learns running: population 8, seed 1\n", "generation 3/3: best "]);
    assert_says(&ended.stdout, &["best ", "of 3; the generations were done", text(&path.join("champion.json"))]);
    for stream in [&ended.stdout, &ended.stderr] {
        assert!(!stream.contains(['\r', '\u{1b}']), "terminal codes in {stream:?}");
    }
    Ok(())
}

#[test]
fn a_run_without_a_folder_gets_one_named_after_what_it_learns() -> Outcome {
    let folder = tempfile::tempdir()?;
    for expected in ["runs/biped-1-running", "runs/biped-1-running-2", "runs/biped-1-running-3"] {
        let mut train = gambol("train");
        train.args(["biped-1", "running", "--set", "movement.steps=20", "--population", "4", "--generations", "1"]);
        succeed(train.args(["--no-report", "--quiet"]).current_dir(folder.path()));
        assert!(folder.path().join(expected).join("champion.json").is_file(), "{expected}");
    }
    Ok(())
}

/// Flags, single settings, a file and a preset: what is said more directly wins.
#[test]
fn flags_win_over_settings_and_settings_over_the_file() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("mine.json");
    fs::write(
        &file,
        r#"{"preset": "thesis", "seed": 5, "movement": {"steps": 40},
            "strategy": {"conventional": {"population": 30, "selection": {"tournament": {"size": 2}}}},
            "stop": {"generations": 9}}"#,
    )?;
    let path = folder.path().join("run");
    let mut train = gambol("train");
    train.args(["biped-1", "jumping", "--quiet", "--no-report", "--config", text(&file), "--out", text(&path)]);
    train.args(["--set", "movement.steps=30", "--set", "strategy.conventional.population=20"]);
    succeed(train.args(["--population", "4", "--generations", "1"]));
    let config = &crate::damage::json(&path.join("config.json"))["content"];
    assert_eq!(config["preset"], "thesis");
    assert_eq!(config["seed"], 5);
    assert_eq!(config["movement"], serde_json::json!({"name": "jumping", "steps": 30}));
    assert_eq!(config["stop"]["generations"], 1);
    let strategy = &config["strategy"]["conventional"];
    assert_eq!(strategy["population"], 4);
    assert_eq!(strategy["selection"], serde_json::json!({"tournament": {"size": 2}}), "a choice replaces the preset's");
    assert_eq!(strategy["elites"], 0, "the rest is the preset's");
    Ok(())
}

/// Parts that are a hundred thousand times as heavy as those they stand on sink through them.
#[test]
fn a_run_in_which_every_evaluation_fails_says_why() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut creature = serde_json::to_value(creatures::find("biped-1")?)?;
    let parts = creature["parts"].as_array_mut().expect("a list");
    parts[0]["density"] = 10_000.into();
    parts[1..].iter_mut().for_each(|part| part["density"] = serde_json::json!(0.1));
    let file = folder.path().join("heavy.json");
    fs::write(&file, creature.to_string())?;
    let path = folder.path().join("run");
    let mut train = gambol("train");
    train.arg(&file).args(["running", "--quiet", "--generations", "2", "--population", "4", "--threads", "1", "--out"]);
    let message = fail(train.arg(&path));
    let says = "run has no champion: in its last generation every evaluation failed, most often for this reason: a joint comes apart";
    assert_says(&message, &["error: ", says]);
    assert!(path.join("report.html").is_file());
    for command in ["gait", "robust", "replay", "verify"] {
        assert_says(&fail(gambol(command).arg(&path)), &[says]);
    }
    let mut compare = gambol("compare");
    compare.args(["--strategies", "ga", "--movements", "running", "--seeds", "1", "--evaluations", "60"]);
    let told = run(compare.arg("--creatures").arg(&file).arg("--out").arg(folder.path().join("compared"))).stderr;
    assert_says(&told, &["seed 1: every evaluation failed, most often for this reason: a joint comes apart"]);
    Ok(())
}

#[test]
fn a_run_whose_champion_was_removed_says_how_it_comes_back() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut small_run(&path, 2));
    fs::remove_file(path.join("champion.json"))?;
    let says = format!("none was chosen so far, or it was removed; `gambol resume {}` goes on", text(&path));
    assert_says(&fail(gambol("gait").arg(&path)), &[&says]);
    succeed(gambol("resume").arg(&path).arg("--no-report"));
    assert!(path.join("champion.json").is_file());
    Ok(())
}
