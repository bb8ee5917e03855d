//! Terrains: trained on, kept by the champion, measured, verified, drawn.

use crate::{
    damage::json,
    program::{assert_says, fail, gambol, run, small_run_of, succeed, text},
};
use serde_json::Value;
use std::fs;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn a_run_on_a_terrain_keeps_it_and_its_champion_is_identical() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let sensors = "sensors=[\"joint-angles\",\"height-above-ground\",\"foot-slip\",{\"next-gap\":{\"length\":3}}]";
    let settings = ["--set", sensors, "--set", "variation.terrain=true", "--set", "controller.modular=null"];
    let mut train = small_run_of("tetrapod-2", "running", &path, 3);
    succeed(train.args(["--terrain", "mixture:0.3"]).args(settings));
    for file in ["config.json", "champion.json"] {
        let content = json(&path.join(file))["content"].take();
        assert_eq!(content["terrain"]["difficulty"].to_string(), "0.3", "{file}");
        assert_eq!(content["terrain"]["obstacles"].as_array().map(Vec::len), Some(5), "{file}");
    }
    let champion = path.join("champion.json");
    assert!(succeed(gambol("verify").arg(&champion)).contains("identical"));
    // Usable or not, it is measured.
    let told = run(gambol("gait").arg(&path)).stdout;
    assert!(told.contains("gaps crossed") && told.contains("rough stretches passed"), "{told}");
    let measured: Value = serde_json::from_str(&run(gambol("gait").arg(&path).arg("--json")).stdout)?;
    assert_eq!(measured["obstacles"][0]["kind"], "gaps");
    assert!(measured["obstacles"][0]["of"].as_u64() > Some(0), "{measured}");
    let robust = succeed(gambol("robust").arg(&path).args(["--perturbations", "3"]));
    assert!(robust.contains("another terrain") && !robust.contains("bumps"), "{robust}");
    succeed(gambol("report").arg(&path));
    let page = fs::read_to_string(path.join("report.html"))?;
    assert!(page.contains("\"ground\":{\"floor\":-"), "the page holds no ground");
    succeed(gambol("check").arg(text(&path.join("config.json"))));
    succeed(gambol("resume").arg(&path).args(["--generations", "4", "--no-report"]));
    Ok(())
}

#[test]
fn on_flat_ground_nothing_is_said_of_terrains() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [plain, flat] = ["plain", "flat"].map(|name| folder.path().join(name));
    succeed(&mut small_run_of("biped-1", "running", &plain, 2));
    succeed(small_run_of("biped-1", "running", &flat, 2).args(["--terrain", "flat:0.7"]));
    for file in ["config.json", "champion.json", "log.jsonl"] {
        let text = fs::read_to_string(plain.join(file))?;
        assert!(!text.contains("obstacles"), "{file}");
        assert_eq!(text, fs::read_to_string(flat.join(file))?, "{file}");
    }
    assert!(!run(gambol("gait").arg(&plain)).stdout.contains("crossed"));
    Ok(())
}

#[test]
fn terrains_are_listed() -> Outcome {
    let list = succeed(&mut gambol("terrains"));
    for name in ["flat", "gaps", "hurdles", "stairs-up", "slopes", "rough", "mixture"] {
        assert!(list.contains(name), "{list}");
    }
    let rows: Value = serde_json::from_str(&succeed(gambol("terrains").arg("--json")))?;
    assert_eq!(rows[1]["terrain"]["obstacles"][0], serde_json::json!({ "gaps": {} }));
    Ok(())
}

#[test]
fn a_movement_that_goes_backwards_has_no_terrain() {
    let message =
        fail(gambol("train").args(["tetrapod-1", "backwards", "--terrain", "gaps:0.3", "--generations", "1"]));
    assert_says(&message, &["terrain = a terrain: must be flat for a movement that goes backwards"]);
}
