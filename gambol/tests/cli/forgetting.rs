//! Going on with fewer senses: refused, unless it is said that they may be forgotten.

use crate::{
    damage::json,
    program::{assert_says, fail, gambol, succeed},
};
use serde_json::json;
use std::{path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn train(strategy: &str, sensors: &str, out: &Path) -> Command {
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--strategy", strategy, "--generations", "4", "--population", "12"]);
    train.args(["--set", "movement.steps=40", "--set", "controller.modular=null", "--no-report", "--quiet"]);
    train.args(["--set", &format!("sensors={sensors}")]).arg("--out").arg(out);
    train
}

#[test]
fn senses_are_given_up_if_that_is_said() -> Outcome {
    for (strategy, next) in [("neat", "neat"), ("neat", "cma-es"), ("ga", "ga"), ("cma-es", "open-es")] {
        let folder = tempfile::tempdir()?;
        let [first, second] = ["first", "second"].map(|name| folder.path().join(name));
        succeed(&mut train(strategy, r#"["torso-rotation","torso-spin","joint-angles","torso-height"]"#, &first));
        // One is missing, and the others are in another order.
        let mut goes_on = train(next, r#"["joint-angles","torso-spin","torso-rotation"]"#, &second);
        goes_on.arg("--from").arg(&first);
        assert_says(&fail(&mut goes_on), &["what was learned with it would be lost", "--allow-loss"]);
        assert!(!second.exists());
        succeed(goes_on.arg("--allow-loss"));
        let origin = json(&second.join("config.json"))["content"]["origin"].clone();
        assert_eq!(origin["lost"].as_array().map(Vec::len), Some(1), "{strategy}: {origin}");
        assert_ne!(origin["transferred"], json!("nothing"));
        assert_eq!(json(&second.join("champion.json"))["content"]["inputs"].as_array().map(Vec::len), Some(4));
        assert_says(&succeed(gambol("verify").arg(&second)), &["identical: "]);
    }
    Ok(())
}
