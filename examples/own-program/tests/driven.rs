//! A user's program has every command for the user's movement: driven as a user would.

use std::{
    fs,
    path::Path,
    process::{Command, Output, Stdio},
    thread,
    time::Duration,
};

fn program(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_own-program"));
    command.args(arguments).current_dir(folder);
    command
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    program(folder, arguments).output().expect("the program runs")
}

/// What it printed; it must have ended with this code.
fn said(folder: &Path, code: i32, arguments: &[&str]) -> String {
    let output = run(folder, arguments);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert_eq!(output.status.code(), Some(code), "{arguments:?}: {}", text(&output.stderr));
    text(&output.stdout) + &text(&output.stderr)
}

#[test]
fn every_command_knows_the_movement_and_its_verdict() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    assert!(said(here, 0, &["movements"]).contains("high-kick"));
    let help = said(here, 0, &["resume", "--help"]);
    assert!(help.contains("own-program resume runs/") && !help.contains("gambol resume"), "{help}");

    let train = ["train", "biped-2", "high-kick", "--generations", "40", "--seed", "3"];
    said(here, 0, &[&train[..], &["--out", "whole"]].concat());
    let judged: serde_json::Value = serde_json::from_str(&run_json(here, &["gait", "whole", "--json"])).expect("JSON");
    assert_eq!(judged["judged_as"], "high-kick");
    assert_eq!(judged["view"]["goal"], "height");
    assert!(said(here, 0, &["verify", "whole/champion.json"]).contains("identical"));
    said(here, 0, &["check", "whole/champion.json"]);
    said(here, 0, &["report", "whole"]);
    said(here, 0, &["replay", "whole/champion.json", "--html", "replay.html", "--trajectory", "kick.csv"]);
    let of_trajectory = run(here, &["gait", "kick.csv", "--creature", "biped-2", "--movement", "high-kick", "--json"]);
    let of_trajectory: serde_json::Value = serde_json::from_slice(&of_trajectory.stdout).expect("JSON");
    assert_eq!(of_trajectory["judged_as"], "high-kick");
    assert!(said(here, 0, &["robust", "whole", "--perturbations", "10"]).contains("rise of the torso"));

    // Killed, and resumed.
    let broken = [&train[..], &["--out", "broken", "--quiet"]].concat();
    let mut child = program(here, &broken).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts");
    while !here.join("broken/config.json").exists() && child.try_wait().expect("a process").is_none() {
        thread::sleep(Duration::from_millis(2));
    }
    child.kill().and_then(|()| child.wait()).expect("it can be killed");
    assert!(!here.join("broken/report.html").exists(), "it was killed before its end");
    said(here, 0, &["resume", "broken", "--quiet"]);
    let bytes = |name: &str| fs::read(here.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(bytes("whole/champion.json"), bytes("broken/champion.json"));
    assert_eq!(bytes("whole/log.jsonl"), bytes("broken/log.jsonl"));

    let compare = ["compare", "--strategies", "ga,cma-es", "--creatures", "biped-2", "--movements", "high-kick"];
    let small = ["--seeds", "2", "--evaluations", "200", "--out", "comparison"];
    said(here, 0, &[&compare[..], &small].concat());
}

#[test]
fn a_run_ends_as_soon_as_the_verdict_is_met_and_its_reasons_are_told() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    let until = ["train", "biped-2", "high-kick", "--until", "usable", "--generations", "400", "--seed", "4"];
    assert!(said(here, 0, &[&until[..], &["--out", "usable"]].concat()).contains("usable"));
    said(here, 0, &["gait", "usable"]);
    // One generation of random nets is no kick.
    said(here, 0, &["train", "biped-2", "high-kick", "--generations", "1", "--out", "random", "--quiet"]);
    let reasons = said(here, 3, &["gait", "random"]);
    assert!(reasons.contains("required") || reasons.contains("allowed"), "{reasons}");
}

#[test]
fn every_command_knows_the_strategy() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    assert!(said(here, 0, &["strategies"]).contains("simulated annealing"));
    let train = ["train", "biped-1", "running", "--strategy", "annealing", "--set", "movement.steps=150"];

    // Its own settings are checked by name, type and range.
    for (setting, says) in [
        ("cooling=2", "strategy.annealing.cooling = 2: must be from 0.5 to 1"),
        ("coling=0.9", "strategy.annealing.coling: unknown field `coling`"),
        ("population=many", "strategy.annealing.population: invalid type: string \"many\""),
    ] {
        let wrong = format!("strategy.annealing.{setting}");
        let message = said(here, 1, &[&train[..], &["--set", &wrong, "--out", "wrong"]].concat());
        assert!(message.contains(says), "{message}");
    }
    assert!(
        said(here, 1, &["train", "apod", "running", "--strategy", "anealing"]).contains("did you mean \"annealing\"?")
    );

    let short = [&train[..], &["--population", "16", "--generations", "5", "--quiet"]].concat();
    let train = [&train[..], &["--population", "16", "--generations", "12", "--quiet"]].concat();
    said(here, 0, &[&train[..], &["--out", "whole"]].concat());
    said(here, 0, &["verify", "whole/champion.json"]);
    let report = fs::read_to_string(here.join("whole/report.html")).expect("a report");
    assert!(report.contains("annealing"), "the report names it");
    let config = fs::read_to_string(here.join("whole/config.json")).expect("a configuration");
    let config: serde_json::Value = serde_json::from_str(&config).expect("JSON");
    assert_eq!(
        config["content"]["strategy"],
        serde_json::json!({ "annealing": { "population": 16, "cooling": 0.95 } })
    );

    // On from where it was, by a file, and in parts.
    said(here, 0, &[&short[..], &["--out", "parts"]].concat());
    said(here, 0, &["resume", "parts", "--generations", "12", "--quiet"]);
    let bytes = |name: &str| fs::read(here.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    assert_eq!(bytes("whole/champion.json"), bytes("parts/champion.json"));
    assert_eq!(bytes("whole/log.jsonl"), bytes("parts/log.jsonl"));
    said(here, 0, &["train", "--config", "whole/config.json", "--out", "again", "--quiet"]);
    assert_eq!(bytes("whole/champion.json"), bytes("again/champion.json"));

    // Another run goes on from it, and so does a stage.
    let on = ["--from", "whole", "--seed", "2", "--out", "on"];
    said(here, 0, &[&train[..], &on].concat());
    // What had been found is not lost.
    let fitness = |run: &str| {
        let champion: serde_json::Value =
            serde_json::from_slice(&bytes(&format!("{run}/champion.json"))).expect("JSON");
        champion["content"]["fitness"].as_f64().expect("a number")
    };
    assert!(fitness("on") >= fitness("whole"), "{} after {}", fitness("on"), fitness("whole"));
    let stages = serde_json::json!({ "stages": [
        { "name": "short", "changes": { "movement": { "steps": 100 } }, "promotion": { "generations": 3 } },
        { "name": "long", "changes": { "movement": { "steps": 150 } } },
        ] });
    fs::write(here.join("stages.json"), stages.to_string()).expect("a file");
    said(here, 0, &[&short[..], &["--config", "stages.json", "--out", "staged"]].concat());
    assert!(here.join("staged/stages/02-long/champion.json").is_file());

    let compare = ["compare", "--strategies", "ga,annealing", "--creatures", "biped-1", "--set", "movement.steps=150"];
    let small = ["--seeds", "2", "--evaluations", "100", "--out", "comparison"];
    assert!(said(here, 0, &[&compare[..], &small].concat()).contains("annealing"));
    let scores = fs::read_to_string(here.join("comparison/scores.csv")).expect("raw data");
    assert!(scores.contains("annealing"), "{scores}");
}

#[test]
fn creatures_sensors_terrains_and_variations_are_known_by_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let here = folder.path();
    for (list, name) in [
        ("creatures", "kicker"),
        ("terrains", "kerbs"),
        ("variations", "icy"),
        ("creatures", "apod"),
        ("presets", "thesis"),
        ("sensors", r#"{"custom":{"name":"lift"}}"#),
    ] {
        assert!(said(here, 0, &[list]).contains(name), "{list} has {name}");
    }
    let variations: serde_json::Value = serde_json::from_str(&said(here, 0, &["variations", "--json"])).expect("JSON");
    let icy = variations.as_array().and_then(|rows| rows.last()).expect("a list");
    assert_eq!((&icy["name"], icy["variation"]["mass"].as_f64()), (&"icy".into(), Some(0.0)));
    assert!(said(here, 0, &["check", "kicker"]).contains("in   lift of fore leg: 0 to 1"));

    let kicker = ["train", "kicker", "running", "--set", "movement.steps=150", "--generations", "4", "--seed", "1"];
    let named = ["--terrain", "kerbs", "--variation", "icy", "--quiet"];
    let kicker = [&kicker[..], &named].concat();
    let refused = said(here, 1, &[&kicker[..], &["--out", "lanes"]].concat());
    assert!(refused.contains("lanes cannot ask \"lift\"") && refused.contains("--engine rapier"), "{refused}");
    let kicker = [&kicker[..], &["--engine", "rapier"]].concat();
    said(here, 0, &[&kicker[..], &["--out", "whole"]].concat());
    let config = fs::read_to_string(here.join("whole/config.json")).expect("a configuration");
    let config: serde_json::Value = serde_json::from_str(&config).expect("JSON");
    let (creature, terrain) = (&config["content"]["creature"], &config["content"]["terrain"]);
    assert_eq!((&creature["name"], &terrain["obstacles"][0]["hurdles"]["height"]), (&"kicker".into(), &0.05.into()));
    assert!(fs::read_to_string(here.join("whole/report.html")).expect("a report").contains("\"icy\""), "by its name");
    assert!(said(here, 0, &["verify", "whole/champion.json"]).contains("identical"));
    said(here, 0, &["resume", "whole", "--generations", "5", "--quiet"]);

    // In a file, and in the changes of a stage.
    let stages = serde_json::json!({ "creature": "kicker", "movement": { "name": "running", "steps": 100 },
        "terrain": "kerbs", "variation": "icy", "engine": "rapier", "stages": [
            { "name": "flat", "changes": { "terrain": "flat" }, "promotion": { "generations": 2 } },
            { "name": "kerbs", "changes": { "terrain": "kerbs:0.5", "variation": "none" } },
        ] });
    fs::write(here.join("stages.json"), stages.to_string()).expect("a file");
    assert!(said(here, 0, &["check", "stages.json"]).contains("a valid configuration"));

    let compare = ["compare", "--strategies", "ga,cma-es", "--creatures", "kicker", "--set", "movement.steps=100"];
    let small = ["--seeds", "1", "--evaluations", "100", "--engine", "rapier", "--out", "comparison"];
    said(here, 0, &[&compare[..], &small].concat());

    // What is wrong with a sensor is said by its name.
    for (sensor, says) in [
        (
            r#"{"custom":{"name":"lfit"}}"#,
            "sensors[0].custom.name: there is no custom sensor \"lfit\"; did you mean \"lift\"?",
        ),
        (
            r#"{"custom":{"name":"lift","settings":{"mots":3}}}"#,
            "sensors[0].custom.settings.mots: unknown field `mots`",
        ),
    ] {
        let wrong = format!("sensors=[{sensor}]");
        let message = said(here, 1, &[&kicker[..], &["--set", &wrong, "--out", "wrong"]].concat());
        assert!(message.contains(says), "{message}");
    }
}

/// What it printed, whatever its code says of the gait.
fn run_json(folder: &Path, arguments: &[&str]) -> String {
    String::from_utf8(run(folder, arguments).stdout).expect("text")
}
