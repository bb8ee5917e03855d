//! Playing: a body that is told what to do, its stages, its verdict, and what is wrong with commands.

use crate::{
    damage::json,
    folder::read,
    program::{assert_says, fail, gambol, succeed},
};
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn play(folder: &Path, flags: &[&str]) -> Command {
    let mut train = gambol("train");
    train.args(["tetrapod-2", "playing", "--population", "8", "--generations", "3", "--quiet"]);
    train.args(["--set", "training_steps=60"]).args(flags).arg("--out").arg(folder);
    train
}

#[test]
fn a_character_is_trained_in_stages_judged_by_commands_and_its_champion_verified() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(&mut play(&run, &[]));
    let config = json(&run.join("config.json"))["content"].take();
    assert_eq!(config["commands"]["random"]["jumps"], 0.0);
    let stages: Vec<_> = config["stages"].as_array().into_iter().flatten().map(|stage| &stage["name"]).collect();
    assert_eq!(stages, ["move", "follow", "jump", "polish", "harden"]);
    let champion = run.join("champion.json");
    let sensed = String::from_utf8(read(&champion))?;
    assert!(sensed.contains("commanded speed") && sensed.contains("stride clock"), "{sensed}");
    assert_says(&succeed(gambol("verify").arg(&champion)), &["identical: "]);
    let judged =
        |gait: &mut Command| String::from_utf8(gait.output()?.stdout).map_err(Box::<dyn std::error::Error>::from);
    let said = judged(gambol("gait").arg(&run))?;
    assert_says(&said, &["tetrapod-2 playing: not usable:", "body lengths/s", "allowed"]);
    let robust = succeed(gambol("robust").arg(&run).args(["--perturbations", "5"]));
    assert_says(&robust, &["keeps            – (each world has commands of its own)"]);
    // A recording has the commands too, and is judged alike; one that has none cannot be.
    let csv = folder.path().join("played.csv");
    succeed(gambol("replay").arg(&champion).arg("--trajectory").arg(&csv));
    let of_csv = |csv: &Path| {
        let mut gait = gambol("gait");
        gait.arg(csv).args(["--creature", "tetrapod-2", "--movement", "playing"]);
        gait
    };
    assert_eq!(judged(&mut of_csv(&csv))?.lines().nth(1), said.lines().nth(1));
    let untold =
        String::from_utf8(read(&csv))?.replace("told_to_jump", "x").replace("commanded_body_lengths_per_s", "y");
    fs::write(&csv, untold)?;
    let refusal =
        "playing is judged by what the body was told, in columns commanded_body_lengths_per_s and told_to_jump";
    assert_says(&fail(&mut of_csv(&csv)), &[refusal]);
    Ok(())
}

/// The same bytes from either engine, with lessons and jumps.
#[test]
fn lanes_and_rapier_tell_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let flags = ["--set", "trials.lessons=true", "--set", "commands.random.jumps=1", "--set", "stages=[]"];
    let sensors = r#"sensors=["joint-angles",{"stride-clock":{"period":0.5,"top":2}},{"jump-clock":{"period":0.6}},"jump-command"]"#;
    let champions = ["lanes", "rapier"].map(|engine| {
        let run = folder.path().join(engine);
        succeed(play(&run, &flags).args(["--set", sensors]).args(["--engine", engine]));
        json(&run.join("champion.json"))["content"].take()
    });
    assert_eq!(champions[0]["network"], champions[1]["network"]);
    assert_eq!(champions[0]["trajectory"], champions[1]["trajectory"]);
    Ok(())
}

#[test]
fn commands_can_be_given_in_a_file() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (run, file) = (folder.path().join("run"), folder.path().join("told.json"));
    let given = r#"{"commands":{"given":[{"time":0,"speed":1},{"time":4,"speed":1,"jump":true}]},"stages":[]}"#;
    fs::write(&file, given)?;
    succeed(play(&run, &[]).arg("--config").arg(&file));
    let told = json(&run.join("champion.json"))["content"]["commands"].take();
    assert_eq!(told["given"][1], serde_json::json!({ "time": 4.0, "speed": 1.0, "jump": true }));
    Ok(())
}

#[test]
fn what_is_wrong_with_commands_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    let refusals = [
        ("commands.random.hold=[5,2]", "commands.random.hold = [5, 2]: must be two numbers from 0.2 to 1000"),
        ("commands.random.standing=2", "commands.random.standing = 2: must be from 0 to 1"),
        ("commands.random.jups=1", "commands.random.jups: unknown field"),
        ("commands={\"given\":[]}", "commands.given = 0 changes: must be from 1 to 10000"),
        ("commands={\"given\":[{\"time\":1},{\"time\":0}]}", "commands.given[1].time = 0: must be from 1"),
        ("commands={\"given\":[{\"time\":1,\"speed\":99}]}", "commands.given[0].speed = 99: must be from -20 to 20"),
        ("movement.settings={\"jump\":-1}", "movement.settings.jump = -1: must be from 0 to 100"),
        ("sensors=[{\"stride-clock\":{\"period\":0.5,\"top\":0}}]", "sensors[0].stride-clock.top"),
        ("sensors=[{\"commanded-speed\":{\"top\":99}}]", "sensors[0].commanded-speed.top"),
        ("sensors=[{\"jump-clock\":{\"period\":0}}]", "sensors[0].jump-clock.period"),
        ("commands=null", "commands = null: must be commands, which playing is judged by"),
        ("trials.lessons=3", "trials.lessons: invalid type: integer `3`, expected a boolean"),
    ];
    for (setting, refusal) in refusals {
        assert_says(&fail(play(&run, &["--set", "stages=[]"]).args(["--set", setting])), &[refusal]);
        assert!(!run.exists(), "nothing was begun");
    }
    Ok(())
}
