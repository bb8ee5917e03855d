//! Swimming: the movement brings its water and its engine along.

use crate::{
    damage::json,
    folder::read,
    program::{assert_says, fail, gambol, succeed, text},
};
use std::{path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn swim(creature: &str, folder: &Path, flags: &[&str]) -> Command {
    let mut train = gambol("train");
    train.args([creature, "swimming", "--population", "6", "--generations", "2", "--quiet"]);
    train.args(["--set", "movement.steps=40"]).args(flags).arg("--out").arg(folder);
    train
}

#[test]
fn a_swimmer_is_trained_in_water_and_in_rapier_and_its_champion_verified() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (name, creature, flags) in
        [("apod", "apod", &["--set", "training_steps=20"][..]), ("plain", "biped-1", &["--preset", "thesis"])]
    {
        let run = folder.path().join(name);
        succeed(&mut swim(creature, &run, flags));
        let config = json(&run.join("config.json"))["content"].take();
        assert_eq!((&config["engine"], &config["physics"]["water"]["drag"]), (&"rapier".into(), &1.0.into()));
        let champion = run.join("champion.json");
        assert_eq!(json(&champion)["content"]["physics"]["water"], config["physics"]["water"]);
        assert_says(&succeed(gambol("verify").arg(&champion)), &["identical: "]);
        let report = String::from_utf8(read(&run.join("report.html")))?;
        assert!(report.contains(r#""ground":{"floor":null,"shapes":[],"water":true}"#));
        let said = gambol("gait").arg(&run).output()?;
        assert_says(&String::from_utf8(said.stdout)?, &["swimming: ", "off the ground     100 %"]);
    }
    Ok(())
}

#[test]
fn what_is_wrong_with_water_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    let refusals: [(&[&str], &str); 6] = [
        (
            &["--engine", "lanes"],
            "engine: lanes cannot simulate this creature: it is in water (physics.water); train it with --engine rapier",
        ),
        (&["--set", "physics.water.drag=11"], "physics.water.drag = 11: must be from 0 to 10"),
        (&["--set", "physics.water.density=0"], "physics.water.density = 0: must be from 0.01 to 100000"),
        (&["--set", "physics.water=null"], "physics.water = null: must be water, which swimming is done in"),
        (&["--set", "physics.water.depth=3"], "unknown field `depth`"),
        (&["--terrain", "gaps"], "physics.water = water: must be null on ground that is not flat: water has no ground"),
    ];
    for (flags, refusal) in refusals {
        assert_says(&fail(&mut swim("apod", &run, flags)), &[refusal]);
        assert!(!run.exists(), "nothing was begun: {}", text(&run));
    }
    Ok(())
}
