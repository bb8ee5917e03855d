//! Runs that go on from others: which settings they have, and what is said of those that go through stages.

use crate::{
    damage::json,
    program::{assert_says, fail, gambol, run, small_run, succeed},
};
use serde_json::{Value, json};
use std::{fs, path::Path};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn config(run: &Path) -> Value {
    json(&run.join("config.json"))["content"].take()
}

/// A setting of the controller, or of the sensors, takes the place of that one alone.
#[test]
fn what_is_set_is_changed_in_what_was_learned_with_and_nothing_else() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    let learned = ["controller.modular=null", "controller.hidden=[5]", "controller.actuation=speed"];
    let sensors = r#"sensors=["joint-angles","foot-contacts"]"#;
    let mut first = small_run(&path("first"), 2);
    succeed(first.arg("--quiet").args(learned.iter().chain(&[sensors]).flat_map(|set| ["--set", set])));
    let go_on = |name: &str, source: &str, more: &[&str]| {
        let mut train = small_run(&path(name), 1);
        succeed(train.arg("--quiet").arg("--from").arg(path(source)).args(more));
        config(&path(name))
    };
    let before = config(&path("first"));
    let set = ["--set", "controller.input_range=2", "--set", "controller.hidden_scale=0.5"];
    let after = go_on("second", "first", &set);
    let mut expected = before["controller"].clone();
    (expected["input_range"], expected["hidden_scale"]) = (json!(2.0), json!(0.5));
    assert_eq!((&after["controller"], &after["sensors"]), (&expected, &before["sensors"]));
    assert_eq!(after["origin"]["transferred"], "population");
    // With nothing set everything is as it was, and a list that is set is the whole list.
    assert_eq!(go_on("third", "first", &[])["controller"], before["controller"]);
    let fewer = go_on("fourth", "first", &["--allow-loss", "--set", r#"sensors=["joint-angles"]"#]);
    assert_eq!((&fewer["controller"], fewer["sensors"].as_array().map(Vec::len)), (&before["controller"], Some(1)));
    // Of a champion it is what a champion file has of the controller.
    let after = go_on("fifth", "first/champion.json", &["--set", "controller.input_range=2"]);
    assert_eq!(
        (&after["controller"]["actuation"], &after["controller"]["input_range"], &after["sensors"]),
        (&before["controller"]["actuation"], &json!(2.0), &before["sensors"])
    );
    let wrong = ["--set", "controller.hiden=[3]", "--out"];
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--from"]).arg(path("first")).args(wrong).arg(path("sixth"));
    assert_says(&fail(&mut train), &["--set controller.hiden=[3]: ", "did you mean `hidden`?"]);
    assert!(!path("sixth").exists());
    Ok(())
}

/// Steps so wide that all it samples is worse.
#[test]
fn of_what_stays_best_it_is_said_that_it_was_found_before() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    succeed(small_run(&path("first"), 4).arg("--quiet"));
    let mut train = small_run(&path("second"), 1);
    train.arg("--from").arg(path("first")).args(["--transfer", "champion", "--set", "strategy.cma-es.step_size=50"]);
    assert_says(&succeed(&mut train), &["found before this run; "]);
    let [first, second] = ["first", "second"].map(|run| json(&path(run).join("champion.json"))["content"].take());
    assert_eq!(first["network"], second["network"]);
    assert!(succeed(gambol("verify").arg(path("first"))).contains("training: fitness"));
    assert!(!succeed(gambol("verify").arg(path("second"))).contains("training:"), "it was nothing in this training");
    succeed(gambol("replay").arg(path("second/champion.json")).arg("--html").arg(path("page.html")));
    assert!(fs::read_to_string(path("page.html"))?.contains("before its run"));
    Ok(())
}

/// Each stage's figures are in its movement's unit, and its generations are not counted against those of the run.
#[test]
fn what_is_said_of_a_stage_is_in_its_unit() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (file, out) = (folder.path().join("stages.json"), folder.path().join("run"));
    let stages = json!({
        "creature": "biped-1",
        "movement": { "name": "running", "steps": 60 },
        "strategy": { "cma-es": { "population": 8 } },
        "stop": { "generations": 20 },
        "stages": [
            { "name": "run", "promotion": { "generations": 4 } },
            {
                "name": "stand",
                "changes": { "movement": { "name": "standing", "steps": 60, "settings": { "after": 0 } } },
                "promotion": { "generations": 12 }
            }
        ]
    });
    fs::write(&file, stages.to_string())?;
    let ended = run(gambol("train").arg("--config").arg(&file).arg("--out").arg(&out).arg("--no-report"));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let (first, last) = ended.stderr.split_once("stage 2 of 2, stand").ok_or("there are two stages")?;
    assert_says(first, &["generation 1: best ", " m in training, "]);
    assert_says(last, &["generation 1: best ", " s in training, "]);
    assert!(!last.contains(" m in "), "{last}");
    assert_says(&ended.stdout, &[" s in rapier (", " s in training), found in generation ", " of its stage; "]);
    // Where all stages were passed before, none is begun.
    let again = run(gambol("resume").arg(&out).arg("--no-report"));
    assert_says(&again.stdout, &[" s in rapier (", " of its stage; "]);
    Ok(())
}
