//! Runs in stages, and runs that go on from others.

use crate::{
    damage::json,
    folder::{contents, read},
    program::{assert_says, fail, gambol, run, small_run, succeed, text},
};
use gambol::{Registry, run::Run, training::Resources};
use ne_core::StopSignal;
use serde_json::{Value, json};
use std::{
    fs,
    io::{BufRead, BufReader},
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Three stages of a few tiny generations: running, with more senses, jumping.
pub(crate) fn three_stages() -> Value {
    json!({
        "creature": "biped-1",
        "movement": { "name": "running", "steps": 60 },
        "strategy": { "cma-es": { "population": 8 } },
        "stop": { "generations": 40 },
        "record": { "checkpoint_every": 3 },
        "stages": [
            { "name": "run", "promotion": { "generations": 14 } },
            { "name": "feel", "add_sensors": ["joint-speeds"], "promotion": { "generations": 13 } },
            { "name": "jump", "changes": { "movement": { "name": "jumping", "steps": 40 } } }
        ]
    })
}

pub(crate) fn write(folder: &Path, config: &Value) -> PathBuf {
    let path = folder.join("stages.json");
    fs::write(&path, config.to_string()).expect("a temporary folder");
    path
}

pub(crate) fn train(config: &Path, out: &Path) -> Command {
    let mut train = gambol("train");
    train.arg("--config").arg(config).arg("--out").arg(out).arg("--no-report");
    train
}

/// All files of a run that are a function of its configuration, by their paths within it.
pub(crate) fn lasting(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let of_clock = |path: &Path| path.ends_with("timing.jsonl") || path.ends_with(".lock");
    let files = contents(folder).into_iter().filter(|(path, _)| path.is_file() && !of_clock(path));
    files.map(|(path, bytes)| (path.strip_prefix(folder).expect("within").to_owned(), bytes)).collect()
}

pub(crate) fn legs(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder.join("stages")).expect("stages");
    let mut names: Vec<String> =
        entries.map(|entry| entry.expect("readable").file_name().to_string_lossy().into_owned()).collect();
    names.sort();
    names
}

#[test]
fn every_shipped_story_is_valid() -> Outcome {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shaping");
    let stories = fs::read_dir(folder)?.collect::<Result<Vec<_>, _>>()?;
    assert!(stories.len() >= 2, "{stories:?}");
    for story in stories {
        let printed = succeed(gambol("check").arg(story.path()));
        assert_says(&printed, &["a valid configuration", "until the run ends"]);
    }
    Ok(())
}

#[test]
fn stages_follow_each_other_and_their_champions_are_kept() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (config, run_folder) = (write(folder.path(), &three_stages()), folder.path().join("run"));
    let ended = run(train(&config, &run_folder).args(["--threads", "1"]));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert_says(
        &ended.stderr,
        &[
            "stage 1 of 3, run\n",
            "stage 2 of 3, feel: goes on with the population of 01-run (generation 14); ",
            "new inputs: speed of ",
            "stage 3 of 3, jump: goes on with the population of 02-feel (generation 13); all ",
        ],
    );
    assert_says(&ended.stdout, &["the generations were done"]);
    assert_eq!(legs(&run_folder), ["01-run", "02-feel", "03-jump"]);
    let generations = |leg: &str| {
        json(&run_folder.join("stages").join(leg).join("checkpoint"))["content"]["progress"]["generations"].clone()
    };
    assert_eq!(["01-run", "02-feel", "03-jump"].map(generations), [json!(14), json!(13), json!(13)]);
    // The run's champion is that of the last stage, and each stage's is proved like any other.
    let champion = |path: &Path| json(&path.join("champion.json"))["content"].clone();
    assert_eq!(champion(&run_folder), champion(&run_folder.join("stages/03-jump")));
    for leg in ["", "stages/01-run", "stages/02-feel"] {
        assert_says(&succeed(gambol("verify").arg(run_folder.join(leg).join("champion.json"))), &["identical: "]);
    }
    // A stage is a run: its report can be made, and the run's own shows all stages.
    succeed(gambol("report").arg(run_folder.join("stages/02-feel")));
    succeed(gambol("report").arg(&run_folder));
    let page = fs::read_to_string(run_folder.join("report.html"))?;
    assert_says(
        &page,
        &[
            "\"stages\":[{\"number\":1,\"name\":\"run\",\"first_generation\":1,\"last_generation\":14",
            "\"first_generation\":15,\"last_generation\":27",
        ],
    );
    // A stage does not go on alone; with more generations the last one of the run does.
    let message = fail(gambol("resume").arg(run_folder.join("stages/02-feel")).args(["--generations", "99"]));
    let whole = [" is a stage of the run in ", ", which goes on as a whole: gambol resume "];
    assert_says(&message, &whole);
    // Nor for a program that does one generation at a time.
    let resources = Resources { threads: 1, registry: Registry::default(), signal: StopSignal::default() };
    let refused = Run::resume(&run_folder.join("stages/02-feel"), None, resources).err().expect("a stage");
    assert_says(&refused.to_string(), &whole);
    succeed(gambol("resume").arg(&run_folder).args(["--generations", "45", "--no-report", "--quiet"]));
    assert_eq!(generations("03-jump"), json!(18));
    Ok(())
}

/// Kills the program once it has told of so many lines.
pub(crate) fn kill_after(command: &mut Command, lines: usize) {
    let mut child = command.arg("--json").stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("it starts");
    let output = BufReader::new(child.stdout.take().expect("a pipe"));
    assert_eq!(output.lines().take(lines).filter(Result::is_ok).count(), lines);
    child.kill().expect("it can be killed");
    child.wait().expect("it was started");
}

#[test]
fn a_run_killed_in_any_stage_and_resumed_gives_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let config = write(folder.path(), &three_stages());
    let whole = folder.path().join("whole");
    succeed(train(&config, &whole).args(["--threads", "1", "--quiet"]));
    let expected = lasting(&whole);
    assert!(expected.iter().any(|(path, _)| path.ends_with("03-jump/checkpoint")));
    // In each stage, at its first generation and where it ends.
    for lines in [2, 9, 14, 15, 16, 17, 24, 29, 30, 31, 36] {
        let path = folder.path().join(format!("killed-after-{lines}"));
        kill_after(train(&config, &path).args(["--threads", "2"]), lines);
        succeed(gambol("resume").arg(&path).args(["--no-report", "--quiet"]));
        let found = lasting(&path);
        assert_eq!(found.len(), expected.len(), "after {lines} lines");
        for ((name, found), (_, expected)) in found.iter().zip(&expected) {
            assert!(found == expected, "{} differs after {lines} lines", name.display());
        }
    }
    Ok(())
}

#[test]
fn populations_are_sent_back() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut config = three_stages();
    config["stages"] = json!([
        { "name": "run", "promotion": { "generations": 4 } },
        { "name": "feel", "changes": { "trials": { "count": 2 } }, "promotion": { "fitness": 1e9 }, "demotion": { "generations": 3 } }
    ]);
    config["stop"] = json!({ "generations": 12 });
    let (config, run_folder) = (write(folder.path(), &config), folder.path().join("run"));
    let ended = run(&mut train(&config, &run_folder));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert_eq!(legs(&run_folder), ["01-run", "02-feel", "03-run", "04-feel"]);
    assert_says(&ended.stderr, &["stage 1 of 2, run: goes on with the population of 02-feel (generation 3); all "]);
    Ok(())
}

#[test]
fn a_population_that_is_sent_back_gives_up_what_the_stage_had_added() -> Outcome {
    let folder = tempfile::tempdir()?;
    let feel = json!({
        "name": "feel", "add_sensors": ["joint-speeds"], "promotion": { "fitness": 1e9 }, "demotion": { "generations": 3 }
    });
    let mut config = three_stages();
    config["stages"] = json!([{ "name": "run", "promotion": { "generations": 4 } }, feel]);
    config["stop"] = json!({ "generations": 12 });
    let run_folder = folder.path().join("run");
    let ended = run(&mut train(&write(folder.path(), &config), &run_folder));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert_eq!(legs(&run_folder), ["01-run", "02-feel", "03-run", "04-feel"]);
    assert_says(
        &ended.stderr,
        &["stage 1 of 2, run: goes on with the population of 02-feel (generation 3); ", "; given up: input speed of "],
    );
    succeed(gambol("verify").arg(run_folder.join("stages/03-run/champion.json")));
    // So does a topology that NEAT has found; but NEAT itself takes no population back.
    config["strategy"] = json!({ "neat": { "population": 12 } });
    let weights = json!({
        "name": "weights", "changes": { "strategy": { "cma-es": { "population": 8 } } }, "promotion": { "generations": 3 }
    });
    config["stages"] = json!([{ "name": "topology", "promotion": { "generations": 3 } }, weights, feel]);
    let run_folder = folder.path().join("with-neat");
    succeed(train(&write(folder.path(), &config), &run_folder).arg("--quiet"));
    assert_eq!(legs(&run_folder), ["01-topology", "02-weights", "03-feel", "04-weights"]);
    let inputs = |leg: &str| {
        let config = json(&run_folder.join("stages").join(leg).join("config.json"))["content"].clone();
        config["topology"]["inputs"].clone()
    };
    assert!(inputs("04-weights") == inputs("02-weights") && inputs("03-feel") != inputs("02-weights"));
    config["stages"][1]["demotion"] = json!({ "generations": 3 });
    let config = write(folder.path(), &config);
    let refused = ["stages[1] (\"weights\"): demotion: neat goes on from a population of its own"];
    assert_says(&fail(gambol("check").arg(&config)), &refused);
    assert_says(&fail(&mut train(&config, &folder.path().join("refused"))), &refused);
    assert!(!folder.path().join("refused").exists());
    Ok(())
}

/// Trains `three_stages` with a last stage that is passed, which takes no time worth speaking of.
fn short_stages(folder: &Path) -> PathBuf {
    let mut config = three_stages();
    config["stages"][0]["promotion"] = json!({ "generations": 2 });
    config["stages"][1]["promotion"] = json!({ "generations": 3 });
    config["stages"][2]["promotion"] = json!({ "generations": 2 });
    let run_folder = folder.join("run");
    succeed(train(&write(folder, &config), &run_folder).arg("--quiet"));
    run_folder
}

#[test]
fn a_run_killed_before_it_kept_its_champion_keeps_it_when_resumed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run_folder = short_stages(folder.path());
    let (kept, last) = (run_folder.join("champion.json"), run_folder.join("stages/03-jump/champion.json"));
    let expected = read(&last);
    let resume = |code: i32| {
        let ended = run(gambol("resume").arg(&run_folder).args(["--no-report", "--quiet"]));
        assert_eq!((ended.code, read(&kept) == expected), (Some(code), true), "{}", ended.stderr);
        ended.stderr
    };
    fs::remove_file(&kept)?;
    resume(0);
    fs::copy(run_folder.join("stages/01-run/champion.json"), &kept)?;
    resume(0);
    // Of a stage that goes on until the run ends, too.
    let mut config = three_stages();
    config["stages"] = json!([config["stages"][0], { "name": "jump" }]);
    config["stages"][0]["promotion"] = json!({ "generations": 2 });
    config["stop"] = json!({ "generations": 5 });
    let run_folder = folder.path().join("limited");
    succeed(train(&write(folder.path(), &config), &run_folder).arg("--quiet"));
    let (kept, last) = (run_folder.join("champion.json"), run_folder.join("stages/02-jump/champion.json"));
    fs::copy(run_folder.join("stages/01-run/champion.json"), &kept)?;
    let message = fail(gambol("resume").arg(&run_folder).args(["--no-report", "--quiet"]));
    assert_eq!(read(&kept), read(&last));
    // What is said is said of the run.
    let said = format!("the run in {} has ended: ", text(&run_folder));
    assert_says(&message, &[&said, "(generation 5)", "--generations 105"]);
    Ok(())
}

/// Trains two stages, of two generations and of three.
fn two_stages(folder: &Path) -> PathBuf {
    let mut config = three_stages();
    config["stages"] = json!([config["stages"][0], { "name": "jump" }]);
    config["stages"][0]["promotion"] = json!({ "generations": 2 });
    config["stop"] = json!({ "generations": 5 });
    let run_folder = folder.join("run");
    succeed(train(&write(folder, &config), &run_folder).arg("--quiet"));
    run_folder
}

/// Fewer generations than were done leave nothing to do, and nothing may be undone.
#[test]
fn a_run_resumed_with_a_lower_limit_keeps_its_latest_champion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run_folder = two_stages(folder.path());
    let champion = read(&run_folder.join("champion.json"));
    assert_ne!(champion, read(&run_folder.join("stages/01-run/champion.json")));
    run(gambol("resume").arg(&run_folder).args(["--generations", "1", "--no-report"]));
    assert_eq!(read(&run_folder.join("champion.json")), champion);
    Ok(())
}

/// Nor does a target that an earlier stage had reached: what was begun after it stays.
#[test]
fn a_run_resumed_with_a_target_that_it_has_reached_keeps_its_latest_champion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run_folder = two_stages(folder.path());
    let champion = read(&run_folder.join("champion.json"));
    assert_eq!(champion, read(&run_folder.join("stages/02-jump/champion.json")));
    assert_ne!(champion, read(&run_folder.join("stages/01-run/champion.json")));
    run(gambol("resume").arg(&run_folder).args(["--generations", "9", "--target=-1e9", "--no-report"]));
    assert_eq!(read(&run_folder.join("champion.json")), read(&run_folder.join("stages/02-jump/champion.json")));
    Ok(())
}

#[test]
fn legs_are_in_the_order_of_their_numbers() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run_folder = short_stages(folder.path());
    for (old, new) in [("01-run", "9-run"), ("02-feel", "11-feel"), ("03-jump", "100-jump")] {
        fs::rename(run_folder.join("stages").join(old), run_folder.join("stages").join(new))?;
    }
    fs::create_dir(run_folder.join("stages/notes-of-mine"))?;
    let legs = gambol::shaping::stage_runs(&gambol::run_folder::RunFolder::open(&run_folder)?)?;
    let found: Vec<_> = legs.iter().map(|leg| (leg.number, leg.stage, leg.name.as_str())).collect();
    assert_eq!(found, [(9, 0, "run"), (11, 1, "feel"), (100, 2, "jump")]);
    Ok(())
}

#[test]
fn a_stage_has_a_creature_by_its_name_or_its_file() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut config = three_stages();
    config["stop"] = json!({ "generations": 4 });
    config["stages"] = json!([
        { "name": "biped", "promotion": { "generations": 2 } },
        { "name": "other", "transfer": "nothing", "changes": { "creature": "tetrapod-1" }, "promotion": { "generations": 1 } },
        { "name": "mine", "transfer": "nothing", "changes": { "creature": "mine.json" } }
    ]);
    let mut mine = serde_json::to_value(creatures::find("biped-1").expect("shipped"))?;
    mine["name"] = json!("mine");
    fs::write(folder.path().join("mine.json"), mine.to_string())?;
    let run_folder = folder.path().join("run");
    succeed(train(&write(folder.path(), &config), &run_folder).arg("--quiet"));
    let name = |leg: &str| {
        json(&run_folder.join("stages").join(leg).join("config.json"))["content"]["creature"]["name"].clone()
    };
    assert_eq!(["01-biped", "02-other", "03-mine"].map(name), [json!("biped-1"), json!("tetrapod-1"), json!("mine")]);
    config["stages"][1]["changes"]["creature"] = json!("tetrapot-1");
    let message = fail(gambol("check").arg(write(folder.path(), &config)));
    assert_says(&message, &["stages[1].changes.creature: ", "did you mean \"tetrapod-1\"?"]);
    Ok(())
}

#[test]
fn neat_finds_a_topology_and_another_strategy_its_weights() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut config = three_stages();
    config["strategy"] = json!({ "neat": { "population": 12 } });
    config["stages"] = json!([
        { "name": "topology", "promotion": { "generations": 8 } },
        { "name": "weights", "changes": { "strategy": { "cma-es": { "population": 8 } } }, "promotion": { "generations": 6 } },
        { "name": "feel", "add_sensors": ["joint-speeds"], "promotion": { "generations": 4 } }
    ]);
    let (config, run_folder) = (write(folder.path(), &config), folder.path().join("run"));
    let ended = run(&mut train(&config, &run_folder));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert_says(
        &ended.stderr,
        &[
            "stage 2 of 3, weights: goes on with the net of the champion of 01-topology (generation ",
            "stage 3 of 3, feel: goes on with the population of 02-weights (generation 6); ",
        ],
    );
    assert_says(&ended.stdout, &["the stage was passed"]);
    let topology =
        |leg: &str| json(&run_folder.join("stages").join(leg).join("config.json"))["content"]["topology"].clone();
    assert_eq!(topology("01-topology"), Value::Null);
    assert!(topology("02-weights").is_object() && topology("03-feel") != topology("02-weights"));
    Ok(())
}

#[test]
fn a_run_goes_on_from_another_run_or_a_champion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    succeed(small_run(&path("first"), 6).arg("--quiet"));
    let from = |source: &str, out: &str| {
        let mut train = gambol("train");
        train.args(["biped-1", "jumping", "--population", "8", "--set", "movement.steps=40", "--no-report"]);
        train.args(["--generations", "4", "--from"]).arg(path(source)).arg("--out").arg(path(out));
        train
    };
    succeed(from("first", "second").arg("--quiet"));
    assert_says(&succeed(gambol("verify").arg(path("second/champion.json"))), &["identical: "]);
    let origin = json(&path("second/config.json"))["content"]["origin"].clone();
    assert_eq!(
        (&origin["transferred"], &origin["generation"], &origin["weights_new"]),
        (&json!("population"), &json!(6), &json!(0))
    );
    // The same again from the same source, and another way from the champion.
    succeed(from("first", "again").args(["--quiet", "--threads", "1"]));
    assert_eq!(read(&path("second/checkpoint")), read(&path("again/checkpoint")));
    for transferred in ["champion", "topology"] {
        succeed(from("first", transferred).args(["--transfer", transferred, "--quiet"]));
        assert_eq!(
            json(&path(transferred).join("config.json"))["content"]["origin"]["transferred"],
            json!(transferred)
        );
    }
    succeed(from("first/champion.json", "of-a-champion").arg("--quiet"));
    assert_eq!(json(&path("of-a-champion/config.json"))["content"]["origin"]["transferred"], json!("topology"));
    // A configuration that went on from somewhere says so.
    let mut repeat = gambol("train");
    repeat
        .arg("--config")
        .arg(path("second/config.json"))
        .arg("--out")
        .arg(path("repeated"))
        .args(["--no-report", "--quiet"]);
    assert_says(&fail(&mut repeat), &["the configuration goes on from ", "--from "]);
    succeed(repeat.arg("--from").arg(path("first")));
    assert_eq!(read(&path("second/checkpoint")), read(&path("repeated/checkpoint")));
    Ok(())
}

/// The weights a CMA-ES that was transferred begins at.
fn start_of(run: &Path) -> Value {
    json(&run.join("checkpoint"))["content"]["strategy"]["start"].clone()
}

/// The weights of the champion in the file.
fn champion_weights(run: &Path) -> Value {
    json(&run.join("champion.json"))["content"]["network"]["weights"].clone()
}

#[test]
fn the_champion_that_goes_on_is_the_one_in_the_file() -> Outcome {
    // It was found since the last re-evaluation: the checkpoint has it among the candidates for the next, or it is what the
    // strategy recommends.
    for (seed, waits) in [("24", true), ("1", false)] {
        let folder = tempfile::tempdir()?;
        let path = |name: &str| folder.path().join(name);
        succeed(small_run(&path("first"), 22).args(["--seed", seed, "--quiet"]));
        let (file, heard) = (json(&path("first/champion.json")), json(&path("first/checkpoint")));
        let generation = file["content"]["generation"].clone();
        assert!(generation.as_u64() > heard["content"]["champion"]["generation"].as_u64());
        assert!(heard["content"]["champion"].is_object());
        let candidates = heard["content"]["candidates"]["each"].as_array().ok_or("an array")?;
        let weights = champion_weights(&path("first"));
        let is_it = |candidate: &Value| candidate["genome"]["weights"] == weights;
        assert_eq!(candidates.iter().any(is_it), waits, "seed {seed}");
        let mut train = gambol("train");
        train.args(["biped-1", "jumping", "--population", "8", "--set", "movement.steps=40", "--no-report", "--quiet"]);
        train.args(["--generations", "1", "--transfer", "topology", "--from"]).arg(path("first"));
        succeed(train.arg("--out").arg(path("second")));
        assert_eq!(json(&path("second/config.json"))["content"]["origin"]["generation"], generation);
        assert_eq!(start_of(&path("second")), weights);
    }
    Ok(())
}

#[test]
fn a_run_goes_on_from_the_last_stage_of_another() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run_folder = short_stages(folder.path());
    let from = |source: &Path, out: &str| {
        let mut train = gambol("train");
        train.args(["biped-1", "running", "--population", "8", "--set", "movement.steps=40", "--no-report", "--quiet"]);
        train.args(["--generations", "2", "--from"]).arg(source).arg("--out").arg(folder.path().join(out));
        succeed(&mut train);
        json(&folder.path().join(out).join("config.json"))["content"].clone()
    };
    let last = run_folder.join("stages/03-jump");
    let config = from(&run_folder, "second");
    assert_eq!(config["origin"]["source"], json!(text(&last)));
    // It feels what the last stage had added.
    assert_eq!(config["sensors"], json(&last.join("config.json"))["content"]["sensors"]);
    assert_eq!(config, from(&last, "third"));
    assert_eq!(read(&folder.path().join("second/checkpoint")), read(&folder.path().join("third/checkpoint")));
    Ok(())
}

#[test]
fn a_search_that_has_begun_anew_goes_on_from_its_champion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    // It cannot get any finer, so every generation is followed by a restart. The genes of a net without limbs are its weights.
    let one_start = ["--set", "strategy.cma-es.starts=1"];
    let coarse = ["--quiet", "--set", "strategy.cma-es.least_deviation=0.5", "--set", "controller.modular=null"];
    succeed(small_run(&path("first"), 3).args(coarse).args(one_start));
    let from = |out: &str, more: &[&str]| {
        let mut train = gambol("train");
        train.args(["biped-1", "jumping", "--population", "8", "--set", "movement.steps=40", "--no-report", "--quiet"]);
        train.args(["--generations", "2", "--from"]).arg(path("first")).arg("--out").arg(path(out)).args(more);
        train
    };
    let transferred = |run: &Path| json(&run.join("config.json"))["content"]["origin"]["transferred"].clone();
    succeed(&mut from("second", &[]));
    assert_eq!(transferred(&path("second")), json!("champion"));
    assert_eq!(start_of(&path("second")), champion_weights(&path("first")));
    // The distribution is gone: nothing of it can be transferred.
    let message = fail(&mut from("third", &["--transfer", "population"]));
    assert_says(
        &message,
        &["the search of ", " has just begun anew and has nothing to transfer: transfer the champion"],
    );
    assert!(!path("third").exists());
    // A run in stages does not end there.
    let mut config = three_stages();
    config["controller"] = json!({ "modular": null });
    config["strategy"]["cma-es"]["least_deviation"] = json!(0.5);
    config["strategy"]["cma-es"]["starts"] = json!(1);
    config["stop"] = json!({ "generations": 4 });
    config["stages"] = json!([
        { "name": "run", "promotion": { "generations": 3 } },
        { "name": "jump", "transfer": "population", "changes": { "movement": { "name": "jumping", "steps": 40 } } }
    ]);
    succeed(train(&write(folder.path(), &config), &path("stages-of-it")).arg("--quiet"));
    let leg = |name: &str| path("stages-of-it").join("stages").join(name);
    assert_eq!(transferred(&leg("02-jump")), json!("champion"));
    assert_eq!(start_of(&leg("02-jump")), champion_weights(&leg("01-run")));
    Ok(())
}

#[test]
fn what_cannot_be_transferred_is_said_before_training() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    succeed(small_run(&path("first"), 3).arg("--quiet"));
    let from = |arguments: &[&str]| {
        let mut train = gambol("train");
        train.args(arguments).args(["--generations", "2", "--no-report", "--quiet", "--from"]).arg(path("first"));
        train.arg("--out").arg(path("second"));
        let message = fail(&mut train);
        assert!(!path("second").exists());
        message
    };
    assert_says(
        &from(&["apod", "running"]),
        &["what was learned with it would be lost; keep it, or allow it with --allow-loss"],
    );
    assert_says(&from(&["biped-1", "running", "--strategy", "neat"]), &["neat goes on from a population of its own"]);
    assert_says(
        &from(&["biped-1", "running", "--strategy", "ga", "--transfer", "population"]),
        &["a population of cma-es is none of conventional"],
    );
    assert_says(&from(&["biped-1", "running", "--transfer", "champoin"]), &["did you mean \"champion\"?"]);
    let mut missing = gambol("train");
    missing.args(["biped-1", "running", "--from"]).arg(path("nowhere")).arg("--out").arg(path("second"));
    assert_says(&fail(&mut missing), &[text(&path("nowhere"))]);
    // Stages are checked before anything is written, too, and on their own.
    let good = succeed(gambol("check").arg(write(folder.path(), &three_stages())));
    assert_says(
        &good,
        &[
            "a valid configuration",
            "stage 2 feel: running, until 13 generations",
            "stage 3 jump: jumping, until the run ends",
        ],
    );
    let mut config = three_stages();
    config["stages"][1]["promotion"] = json!({ "measurement": { "name": "joy", "at_least": 1 } });
    let config = write(folder.path(), &config);
    let message = fail(train(&config, &path("second")).arg("--quiet"));
    assert_says(&fail(gambol("check").arg(&config)), &["stages[1] (\"feel\"): promotion.measurement.name = \"joy\""]);
    assert_says(
        &message,
        &["stages[1] (\"feel\"): promotion.measurement.name = \"joy\": must be one of those there are: "],
    );
    assert!(!path("second").exists());
    Ok(())
}

/// A stage's folder without a checkpoint is not that of this run: it is moved aside, whatever lies in it.
#[test]
fn a_stages_folder_without_a_checkpoint_is_moved_aside_and_not_deleted() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, run_folder) = (folder.path().join("whole"), folder.path().join("run"));
    let mut config = three_stages();
    config["stages"] = json!([config["stages"][0], { "name": "jump" }]);
    config["stages"][0]["promotion"] = json!({ "generations": 2 });
    config["stop"] = json!({ "generations": 5 });
    let file = write(folder.path(), &config);
    succeed(train(&file, &whole).arg("--quiet"));
    succeed(train(&file, &run_folder).arg("--quiet"));
    let stage = run_folder.join("stages/02-jump");
    fs::remove_dir_all(&stage)?;
    fs::create_dir(&stage)?;
    fs::write(stage.join("thesis.tex"), "three months of work")?;
    succeed(gambol("resume").arg(&run_folder).args(["--no-report", "--quiet"]));
    let aside = run_folder.join("stages/old-02-jump/thesis.tex");
    assert_eq!(fs::read_to_string(&aside)?, "three months of work");
    fs::remove_dir_all(run_folder.join("stages/old-02-jump"))?;
    assert!(lasting(&run_folder) == lasting(&whole), "and the run ends as it would have");
    // What a process left that was killed at the very start is no hindrance.
    fs::remove_dir_all(&stage)?;
    fs::create_dir(&stage)?;
    fs::write(stage.join(".lock"), "")?;
    fs::write(stage.join(".gambol-half.tmp"), "{")?;
    succeed(gambol("resume").arg(&run_folder).args(["--no-report", "--quiet"]));
    assert_eq!(legs(&run_folder), ["01-run", "02-jump"]);
    assert!(lasting(&run_folder) == lasting(&whole));
    Ok(())
}

#[test]
fn a_limit_that_is_refused_leaves_a_run_with_stages_as_it_was() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("run");
    succeed(train(&write(folder.path(), &three_stages()), &out).args(["--generations", "5", "--quiet"]));
    let before = lasting(&out);
    let refused = fail(gambol("resume").arg(&out).args(["--generations", "0"]));
    assert_says(&refused, &["stop.generations", "at least 1"]);
    assert_eq!(lasting(&out), before);
    succeed(gambol("resume").arg(&out).args(["--generations", "6", "--no-report", "--quiet"]));
    Ok(())
}
