//! Stages that hold what was learned and search for what is new, and stages after them that search for all of it again.

use crate::{
    damage::json,
    program::{assert_says, fail, gambol, small_run, succeed},
};
use serde_json::{Value, json};
use std::{fs, path::Path};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Running; with more senses, the runner held; all of it.
fn stages(strategy: &Value) -> Value {
    json!({
        "creature": "tetrapod-2",
        "movement": { "name": "running", "steps": 60 },
        "strategy": strategy,
        "stop": { "generations": 12 },
        "record": { "checkpoint_every": 4 },
        "stages": [
            { "name": "run", "promotion": { "generations": 4 } },
            { "name": "feel", "add_sensors": ["joint-speeds"], "transfer": "held", "promotion": { "generations": 4 } },
            { "name": "polish", "transfer": "champion" }
        ]
    })
}

fn train(folder: &Path, config: &Value, out: &str) -> Result<(), Box<dyn std::error::Error>> {
    let path = folder.join("stages.json");
    fs::write(&path, config.to_string())?;
    let mut train = gambol("train");
    train.arg("--config").arg(path).arg("--out").arg(folder.join(out)).args(["--no-report", "--quiet"]);
    succeed(&mut train);
    Ok(())
}

fn content(path: &Path) -> Value {
    json(path)["content"].take()
}

#[test]
fn what_is_held_stays_and_is_searched_again_later() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (name, strategy) in
        [("es", json!({ "cma-es": { "population": 8 } })), ("ga", json!({ "conventional": { "population": 8 } }))]
    {
        train(folder.path(), &stages(&strategy), name)?;
        let stage = |stage: &str| folder.path().join(name).join("stages").join(stage);
        let [held, polished] =
            ["02-feel", "03-polish"].map(|stage_name| content(&stage(stage_name).join("config.json")));
        let genes = held["topology"]["genes"].as_array().ok_or("the whole net's genes")?;
        let free = genes.iter().filter(|gene| gene.get("held").is_none()).count();
        assert!(free > 0 && free < genes.len(), "{name}: {free} of {}", genes.len());
        assert!(
            genes
                .iter()
                .filter(|gene| gene.get("held").is_none())
                .all(|gene| { gene["name"].as_str().is_some_and(|name| name.contains("speed")) })
        );
        let origin = |config: &Value| config["origin"].clone();
        assert_eq!(origin(&held)["transferred"], "held");
        assert_eq!(origin(&held)["weights_new"], free);
        assert_eq!(
            (&origin(&polished)["transferred"], &origin(&polished)["weights_new"]),
            (&json!("champion"), &json!(0))
        );
        assert_eq!(origin(&polished)["weights_kept"], genes.len());
        assert_eq!(polished["topology"], Value::Null, "all of the net is searched again");
        for stage_name in ["02-feel", "03-polish"] {
            assert_says(&succeed(gambol("verify").arg(stage(stage_name).join("champion.json"))), &["identical: "]);
        }
        // A run goes on from a stage that holds, and still does.
        let mut further = gambol("train");
        further.args(["--generations", "2", "--no-report", "--quiet", "tetrapod-2", "running"]);
        further.args(["--strategy", if name == "es" { "cma-es" } else { "ga" }, "--population", "8"]);
        further.arg("--from").arg(stage("02-feel")).arg("--out").arg(folder.path().join(format!("{name}-further")));
        succeed(&mut further);
        let further = content(&folder.path().join(format!("{name}-further/config.json")));
        assert_eq!(further["topology"]["genes"], held["topology"]["genes"]);
    }
    Ok(())
}

#[test]
fn there_must_be_something_new_to_search_for() -> Outcome {
    let folder = tempfile::tempdir()?;
    let first = folder.path().join("first");
    succeed(small_run(&first, 3).arg("--quiet"));
    let mut again = gambol("train");
    again.args(["biped-1", "running", "--transfer", "held", "--no-report", "--from"]).arg(&first);
    again.arg("--out").arg(folder.path().join("second"));
    assert_says(&fail(&mut again), &["the champion is held", "add a sensor, or transfer the champion"]);
    assert!(!folder.path().join("second").exists());
    let mut config = stages(&json!({ "cma-es": { "population": 8 } }));
    config["stages"][1]["add_sensors"] = json!([]);
    let path = folder.path().join("stages.json");
    fs::write(&path, config.to_string())?;
    assert_says(&fail(gambol("check").arg(&path)), &["feel", "the champion is held"]);
    Ok(())
}
