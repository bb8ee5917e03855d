//! Runs that go on from others: which settings they have.

use crate::{
    damage::json,
    program::{assert_says, fail, gambol, small_run, succeed},
};
use serde_json::{Value, json};
use std::path::Path;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn config(run: &Path) -> Value {
    json(&run.join("config.json"))["content"].take()
}

/// A setting of the controller, or of the sensors, takes the place of that one alone.
#[test]
fn what_is_set_is_changed_in_what_was_learned_with_and_nothing_else() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    let learned = ["controller.limbs=null", "controller.hidden=[5]", "controller.actuation=speed"];
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
    assert_eq!(after["origin"]["carried"], "population");
    // With nothing set everything is as it was, and a list that is set is the whole list.
    assert_eq!(go_on("third", "first", &[])["controller"], before["controller"]);
    let fewer = go_on("fourth", "first", &["--forget", "--set", r#"sensors=["joint-angles"]"#]);
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
