//! One net for several bodies: what is trained in all of them, and judged in one.

use crate::{
    damage::json,
    folder::{assert_same_run, read},
    killed::kill_after,
    program::{WITHOUT_SELECTION, assert_says, fail, gambol, long_run, run, small_run, succeed, text},
};
use serde_json::{Value, json};
use std::{
    fs,
    path::{Path, PathBuf},
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A file with a biped that weighs so many times as much.
fn heavier(folder: &Path, times: f32) -> PathBuf {
    let mut creature = creatures::find("biped-1").expect("shipped");
    creature.name = format!("biped-x{times}");
    creature.parts.iter_mut().for_each(|part| part.density *= times);
    let path = folder.join(&creature.name).with_extension("json");
    fs::write(&path, creature.to_json()).expect("a temporary folder");
    path
}

/// As flags, two of them.
fn further_bodies(folder: &Path) -> Vec<String> {
    let flags = [0.6, 1.7].map(|times| ["--further-body".to_owned(), text(&heavier(folder, times)).to_owned()]);
    flags.concat()
}

fn log(run: &Path) -> Vec<Value> {
    let text = fs::read_to_string(run.join("log.jsonl")).expect("a log");
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

#[test]
fn threads_and_engines_give_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let further_bodies = further_bodies(folder.path());
    let rungs = ["--set", "trials.count=2", "--set", r#"rungs=[{"steps":20,"trials":1,"share":0.5}]"#];
    for (name, flags) in [("plain", &WITHOUT_SELECTION[..]), ("varied", &[]), ("in-rungs", &rungs)] {
        let train = |run: &str, more: &[&str]| {
            let path = folder.path().join(name).join(run);
            succeed(small_run(&path, 12).args(flags).args(&further_bodies).args(more));
            path
        };
        let one = train("one", &["--threads", "1"]);
        assert_same_run(&one, &train("two", &["--threads", "2"]));
        let rapier = train("rapier", &["--threads", "2", "--engine", "rapier"]);
        for file in ["log.jsonl", "gallery.jsonl", "checkpoint"] {
            assert_eq!(read(&one.join(file)), read(&rapier.join(file)), "{file}, {name}");
        }
        // The configuration of a run repeats it.
        let again = folder.path().join(name).join("again");
        let config = one.join("config.json");
        succeed(gambol("train").args(["--config", text(&config), "--no-report", "--out", text(&again)]));
        assert_same_run(&one, &again);
        for run in [&one, &rapier] {
            assert_says(&succeed(gambol("verify").arg(run.join("champion.json"))), &["identical: "]);
        }
    }
    Ok(())
}

#[test]
fn a_run_is_trained_in_all_bodies_and_its_champion_judged_in_the_creature() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [with, without] = ["with", "without"].map(|name| folder.path().join(name));
    let further_bodies = further_bodies(folder.path());
    // Nothing ends an episode early, so that steps can be told beforehand.
    let plain = [&WITHOUT_SELECTION[..], &["--set", "movement.terms=[]", "--set", "trials.count=1"]].concat();
    let ended = run(small_run(&with, 10).args(&plain).args(&further_bodies));
    assert_says(&ended.stderr, &["biped-1 learns running in 3 bodies: population 8", " m in rapier, "]);
    succeed(small_run(&without, 10).args(&plain));
    let (three, one) = (log(&with), log(&without));
    assert_eq!((&three[9]["steps"], &one[9]["steps"]), (&(10 * 8 * 60 * 3).into(), &(10 * 8 * 60).into()));
    assert_eq!(three[9]["evaluations"], one[9]["evaluations"]);
    assert_ne!(three[0]["fitness"], one[0]["fitness"]);
    assert!(three[9]["re_evaluation"].is_object() && one[9]["re_evaluation"].is_null());
    let champion = &json(&with.join("champion.json"))["content"];
    assert_eq!((&champion["creature"]["name"], &champion["fitness"]), (&"biped-1".into(), &three[9]["best_so_far"]));
    assert_eq!(champion["trained"]["bodies"], 3);
    let verified = succeed(gambol("verify").arg(with.join("champion.json")));
    assert_says(&verified, &["training: fitness ", " without variation in 3 bodies\n", "identical: "]);
    succeed(gambol("report").arg(&with));
    assert_says(
        &fs::read_to_string(with.join("report.html"))?,
        &["further_bodies in training", "biped-x0.6, biped-x1.7"],
    );
    // A run without further bodies says nothing of them, as before there were any.
    assert_eq!(json(&without.join("champion.json"))["content"]["trained"].get("bodies"), None);
    let of = |run: &Path| json(&run.join("config.json"))["content"].get("further_bodies").cloned();
    assert_eq!((of(&without), of(&with).is_some()), (None, true));
    Ok(())
}

#[test]
fn a_run_that_is_killed_and_resumed_gives_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let further_bodies = further_bodies(folder.path());
    let [whole, killed] = ["whole", "killed"].map(|run| folder.path().join(run));
    let train = |path: &Path| {
        let mut train = long_run(path);
        train
            .args(["--threads", "1", "--set", "record.checkpoint_every=7"])
            .args(WITHOUT_SELECTION)
            .args(&further_bodies);
        train
    };
    succeed(train(&whole).arg("--quiet"));
    kill_after(&mut train(&killed), &killed, 12);
    succeed(gambol("resume").arg(&killed).args(["--threads", "2", "--no-report"]));
    assert_same_run(&whole, &killed);
    Ok(())
}

/// NEAT in a class of bodies, then the weights in the one that counts.
#[test]
fn a_stage_may_have_further_bodies_by_name_and_the_next_drop_them() -> Outcome {
    let folder = tempfile::tempdir()?;
    heavier(folder.path(), 2.0);
    let config = json!({
        "creature": "biped-1",
        "movement": { "name": "running", "steps": 60 },
        "strategy": { "neat": { "population": 12 } },
        "stop": { "generations": 20 },
        "stages": [
            {
                "name": "topology",
                "changes": { "further_bodies": ["biped-1", "biped-x2.json"] },
                "add_sensors": ["joint-speeds"],
                "promotion": { "generations": 8 }
            },
            { "name": "weights", "changes": { "further_bodies": [], "strategy": { "cma-es": { "population": 8 } } } }
        ]
    });
    let path = folder.path().join("stages.json");
    fs::write(&path, config.to_string())?;
    let says =
        ["stage 1 topology: running in 3 bodies, until 8 generations", "stage 2 weights: running, until the run ends"];
    assert_says(&succeed(gambol("check").arg(&path)), &says);
    let out = folder.path().join("run");
    succeed(gambol("train").arg("--config").arg(&path).arg("--out").arg(&out).args(["--no-report", "--quiet"]));
    let further_bodies = |stage_run: &str| {
        json(&out.join("stages").join(stage_run).join("config.json"))["content"]["further_bodies"].take()
    };
    assert_eq!(further_bodies("01-topology")[1]["name"], "biped-x2");
    assert_eq!(further_bodies("02-weights"), Value::Null);

    // What is wrong is named with its place.
    let wrong = |place: &str, further_body: Value| {
        let mut config = config.clone();
        *config.pointer_mut(place).expect("it is there") = further_body;
        fs::write(&path, config.to_string()).expect("a temporary folder");
        fail(gambol("check").arg(&path))
    };
    let second = "/stages/0/changes/further_bodies/1";
    assert_says(
        &wrong(second, json!("bipde-1")),
        &[
            text(&path),
            "stages[0].changes.further_bodies[1]: there is no creature \"bipde-1\"",
            "did you mean \"biped-1\"?",
        ],
    );
    assert_says(
        &wrong(second, json!("biped-2")),
        &[text(&path), "stages[0] (\"topology\"): further_bodies[1] (\"biped-2\"): one net cannot move it"],
    );
    assert_says(&wrong(second, json!({ "name": 3 })), &["stages[0].changes.further_bodies[1]: "]);
    assert_says(
        &wrong("/stages/0/changes/further_bodies", json!("biped-1")),
        &["changes.further_bodies: invalid type"],
    );
    Ok(())
}

#[test]
fn flags_and_files_name_further_bodies() -> Outcome {
    let folder = tempfile::tempdir()?;
    heavier(folder.path(), 2.0);
    let path = folder.path().join("mine.json");
    let check = |further_bodies: Value| {
        let config =
            json!({ "creature": "biped-1", "movement": { "name": "running" }, "further_bodies": further_bodies });
        fs::write(&path, config.to_string()).expect("a temporary folder");
        let ended = run(gambol("check").arg(&path));
        ended.stdout + &ended.stderr
    };
    assert_says(&check(json!(["biped-1", "biped-x2.json"])), &["a valid configuration in 3 bodies"]);
    assert_says(&check(json!(["biped-2"])), &[text(&path), "further_bodies[0] (\"biped-2\"): one net cannot move it"]);
    assert_says(&check(json!(["biped-x3.json"])), &["further_bodies[0]: ", "biped-x3.json"]);
    // A flag takes the place of the file's.
    check(json!(["biped-x2.json"]));
    let out = folder.path().join("run");
    let mut train = gambol("train");
    train.args(["--config", text(&path), "--further-body", "biped-1", "--generations", "1", "--population", "4"]);
    succeed(train.args(["--set", "movement.steps=20", "--no-report", "--quiet", "--out", text(&out)]));
    let further_bodies = json(&out.join("config.json"))["content"]["further_bodies"].take();
    assert_eq!((further_bodies.as_array().map(Vec::len), &further_bodies[0]["name"]), (Some(1), &json!("biped-1")));
    let refused =
        |further_body: &str| fail(gambol("train").args(["biped-1", "running", "--further-body", further_body]));
    assert_says(&refused("bipde-1"), &["there is no creature \"bipde-1\"", "did you mean \"biped-1\"?"]);
    assert_says(
        &refused("apod"),
        &["error: further_bodies[0] (\"apod\"): one net cannot move it and the creature: it has "],
    );
    Ok(())
}
