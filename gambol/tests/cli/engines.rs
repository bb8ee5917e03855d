//! `--engine`: lanes or rapier, with the same results; what lanes cannot do is refused, and rapier does it.

use crate::{
    damage::{edit_and_seal, json},
    folder::{assert_same_run, read},
    program::{WITHOUT_SELECTION, assert_says, fail, gambol, small_run, succeed, text},
};
use serde_json::Value;
use std::fs;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn lanes_are_the_default_and_rapier_finds_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    for variation in ["none", "light"] {
        let [plain, lanes, rapier] = ["plain", "lanes", "rapier"].map(|it| folder.path().join(variation).join(it));
        let varies: &[&str] = if variation == "none" { &WITHOUT_SELECTION } else { &["--variation", variation] };
        let run = |path, flags: &[&str]| succeed(small_run(path, 12).args(varies).args(flags));
        run(&plain, &[]);
        run(&lanes, &["--engine", "lanes", "--threads", "1"]);
        run(&rapier, &["--engine", "rapier", "--threads", "3"]);
        assert_same_run(&plain, &lanes);
        for file in ["log.jsonl", "gallery.jsonl", "checkpoint"] {
            assert_eq!(read(&lanes.join(file)), read(&rapier.join(file)), "{file}, variation {variation}");
        }
        let champion = |path: &std::path::Path| {
            let mut content = json(&path.join("champion.json"))["content"].take();
            let trained = content["trained"].take();
            content.as_object_mut().expect("an object").remove("trained");
            (content, trained["engine"].clone())
        };
        let ((in_lanes, lanes_name), (in_rapier, rapier_name)) = (champion(&lanes), champion(&rapier));
        assert_eq!(in_lanes, in_rapier, "variation {variation}");
        // Without variation a champion trained in rapier is what it was in training.
        let said = if variation == "none" { Value::Null } else { "rapier".into() };
        assert_eq!((lanes_name, rapier_name), ("lanes".into(), said));
        for path in [&lanes, &rapier] {
            assert_says(&succeed(gambol("verify").arg(path.join("champion.json"))), &["identical: "]);
        }
    }
    Ok(())
}

#[test]
fn a_creature_that_lanes_cannot_simulate_is_refused_and_rapier_trains_it() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (creature, run) = (folder.path().join("clumsy.json"), folder.path().join("run"));
    let shipped = creatures::shipped().iter().find(|shipped| shipped.name == "biped-1").ok_or("it is shipped")?;
    fs::write(&creature, shipped.json.replace(r#""self_collision": false"#, r#""self_collision": true"#))?;
    let said = succeed(gambol("check").arg(&creature));
    let note = "note: lanes cannot simulate this creature: its parts collide with each other (self_collision); the default \
                preset trains it in rapier, for others say --engine rapier";
    assert!(said.contains(note), "{said}");
    let train = |flags: &[&str]| {
        let mut train = gambol("train");
        train.args([text(&creature), "running", "--population", "4", "--set", "movement.steps=20", "--quiet"]);
        train.args(["--generations", "1", "--no-report", "--out", text(&run)]).args(flags);
        train
    };
    let refusal = "engine: lanes cannot simulate this creature: its parts collide with each other (self_collision); \
                   train it with --engine rapier";
    for flags in [&["--engine", "lanes"][..], &["--preset", "thesis"]] {
        assert_says(&fail(&mut train(flags)), &[refusal]);
        assert!(!run.exists(), "nothing was begun");
    }
    succeed(&mut train(&["--engine", "rapier", "--preset", "thesis"]));
    fs::remove_dir_all(&run)?;
    // The default preset knows.
    succeed(&mut train(&[]));
    assert_eq!(json(&run.join("config.json"))["content"]["engine"], "rapier");
    assert_says(&succeed(gambol("verify").arg(run.join("champion.json"))), &["identical: "]);

    let config = folder.path().join("config.json");
    fs::write(
        &config,
        format!(r#"{{"preset": "thesis", "creature": "{}", "movement": {{"name": "running"}}}}"#, text(&creature)),
    )?;
    assert_says(&fail(gambol("check").arg(&config)), &[text(&config), refusal]);
    let mut compare = gambol("compare");
    compare.args(["--strategies", "ga", "--creatures", text(&creature), "--evaluations", "10", "--out", text(&config)]);
    compare.args(["--engine", "lanes"]);
    assert_says(&fail(&mut compare), &["ga on ", refusal]);
    Ok(())
}

/// A configuration from before there was a choice was one for rapier.
#[test]
fn an_old_run_goes_on_in_rapier() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, old) = (folder.path().join("whole"), folder.path().join("old"));
    for (path, generations) in [(&whole, 6), (&old, 3)] {
        succeed(small_run(path, generations).args(["--engine", "rapier", "--variation", "none"]));
    }
    edit_and_seal(&old.join("config.json"), |content| {
        let content = content.as_object_mut().expect("an object");
        content.remove("engine");
        content["record"].as_object_mut().expect("an object").remove("candidates");
    });
    succeed(gambol("resume").arg(&old).args(["--generations", "6", "--no-report"]));
    assert_same_run(&whole, &old);
    assert_eq!(json(&old.join("config.json"))["content"]["engine"], "rapier");
    Ok(())
}

#[test]
fn a_comparison_can_choose_engine_and_variation() -> Outcome {
    let folder = tempfile::tempdir()?;
    let scores = |name: &str, flags: &[&str]| -> Result<String, Box<dyn std::error::Error>> {
        let out = folder.path().join(name);
        let mut compare = gambol("compare");
        compare.args(["--strategies", "ga,cosyne", "--creatures", "biped-1", "--seeds", "2", "--evaluations", "200"]);
        // Nothing ends an episode early, so that all take as many steps.
        compare.args(["--set", "movement.steps=40", "--set", "movement.terms=[]", "--quiet", "--out", text(&out)]);
        succeed(compare.args(flags));
        let scores = fs::read_to_string(out.join("scores.csv"))?;
        // All but the seconds.
        Ok(scores.lines().filter_map(|line| Some(line.rsplit_once(',')?.0)).collect::<Vec<_>>().join("\n"))
    };
    let lanes = scores("lanes", &["--variation", "none"])?;
    assert_eq!(scores("rapier", &["--variation", "none", "--engine", "rapier"])?, lanes);
    let light = scores("light", &["--variation", "light"])?;
    assert_eq!(scores("default", &[])?, lanes, "a score at a budget is that of the moment");
    assert_ne!(light, lanes);
    assert!(!light.contains(",,"), "every run has a score:\n{light}");
    Ok(())
}

/// The variation a new run is configured with.
fn variation_of(arguments: &[&str], file: Option<&str>) -> serde_json::Value {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("run");
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--generations", "1", "--set", "movement.steps=20", "--no-report", "--quiet"]);
    if let Some(file) = file {
        let path = folder.path().join("some.json");
        fs::write(&path, file).expect("written");
        train.args(["--config", text(&path)]);
    }
    succeed(train.args(["--out", text(&out)]).args(arguments));
    json(&out.join("config.json"))["content"]["variation"].take()
}

#[test]
fn single_settings_come_after_options_and_files_say_all_that_varies() {
    let light = variation_of(&["--variation", "light"], None);
    assert_eq!(variation_of(&[], None), variation_of(&["--variation", "bumpy"], None), "of the default preset");
    assert!(light["friction"].as_f64() > Some(0.0));
    let mut rougher = variation_of(&["--set", "variation.friction=0.5", "--variation", "light"], None);
    assert_eq!(rougher["friction"].take(), 0.5);
    assert_eq!(rougher["start_pose"], light["start_pose"]);
    let file = variation_of(&[], Some(r#"{ "variation": { "friction": 0.45 } }"#));
    assert_eq!((&file["friction"], &file["mass"], &file["start_pose"]), (&0.45.into(), &0.0.into(), &0.0.into()));
    assert_eq!(variation_of(&["--variation", "light"], Some(r#"{ "variation": { "friction": 0.45 } }"#)), light);
    let strong = variation_of(&["--variation", "strong"], None);
    // A factor below 1 is the more the further below.
    let amount = |amount: &Value| match amount.as_array() {
        Some(factors) => factors[1].as_f64().zip(factors[0].as_f64()).map(|(most, least)| most / least),
        None => amount.as_f64(),
    };
    let none = variation_of(&["--variation", "none"], None);
    let numbers = light
        .as_object()
        .expect("an object")
        .iter()
        .filter(|(name, light)| !light.is_boolean() && none[*name] != **light);
    for (name, light) in numbers {
        assert!(amount(&strong[name]) >= amount(light), "{name}: strong is no less than light");
    }
    assert!(amount(&strong["friction"]) > amount(&light["friction"]) && strong["bumps"].as_f64() > Some(0.0));
    assert_eq!(variation_of(&[], Some(r#"{ "trials": { "count": 1 } }"#)), variation_of(&[], None));
}
