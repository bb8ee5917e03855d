//! Creature files that make no sense: `check` and `train` name the file and the field.

use crate::program::{assert_says, fail, gambol, succeed, text};
use serde_json::{Value, json};
use std::{fs, path::Path};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A body on two legs, the second with a foot; valid as it is.
pub(crate) fn creature() -> Value {
    let part = |name: &str, tag: &str, size: [f32; 2], position: [f32; 2]| {
        json!({
            "name": name, "tag": tag, "shape": {"box": {"width": size[0], "height": size[1]}},
            "density": 30, "friction": 1, "position": position,
        })
    };
    let joint = |parent: &str, child: &str, anchor: [f32; 2]| {
        json!({
            "parent": parent, "child": child, "anchor": anchor, "limits": [-60, 60],
            "motor": {"top_speed": 10, "top_torque": 50},
        })
    };
    json!({
        "format": "gambol creature", "version": 1, "name": "stroller",
        "parts": [
            part("body", "torso", [0.4, 0.3], [0.0, 0.75]),
            part("leg", "leg", [0.1, 0.6], [-0.1, 0.3]),
            part("thigh", "leg", [0.1, 0.3], [0.1, 0.45]),
            part("foot", "leg", [0.1, 0.3], [0.1, 0.15]),
        ],
        "joints": [
            joint("body", "leg", [-0.1, 0.6]),
            joint("body", "thigh", [0.1, 0.6]),
            joint("thigh", "foot", [0.1, 0.3]),
        ],
    })
}

type Change = fn(&mut Value);

/// What is done to the creature, and what the message must say.
#[rustfmt::skip]
const CHANGES: &[(Change, &[&str])] = &[
    // Parts.
    (|c| c["parts"] = json!([]),                        &["parts: a creature needs parts; the first one is its torso"]),
    (|c| c["parts"][1]["name"] = "body".into(),         &["parts[1].name: `body` is already the name of parts[0]"]),
    (|c| c["parts"][1]["name"] = "".into(),             &["parts[1].name: expected 1 to"]),
    (|c| c["parts"][1]["shape"]["box"]["width"] = 0.into(),      &["parts[1].shape.box.width: expected", "found 0"]),
    (|c| c["parts"][1]["shape"]["box"]["height"] = (-1).into(),  &["parts[1].shape.box.height: expected", "found -1"]),
    (|c| c["parts"][2]["density"] = 0.into(),           &["parts[2].density: expected", "found 0"]),
    (|c| c["parts"][2]["density"] = (-3).into(),        &["parts[2].density: expected", "found -3"]),
    (|c| c["parts"][2]["friction"] = (-1).into(),       &["parts[2].friction: expected", "found -1"]),
    (|c| c["parts"][0]["position"] = json!([0, 1e9]),   &["parts[0].position[1]: expected"]),
    (|c| c["parts"][0]["shape"] = json!({"bx": {}}),    &["parts[0].shape", "unknown shape `bx`", "box"]),
    (|c| c["parts"][0]["densty"] = 1.into(),            &["parts[0].densty", "unknown field `densty`", "`density`"]),
    (|c| { c["parts"][3].as_object_mut().map(|part| part.remove("position")); }, &["parts[3]", "missing field `position`"]),
    (|c| c["parts"][0]["density"] = "heavy".into(),     &["parts[0].density", "expected a number"]),
    (|c| c["parts"][0]["look"] = json!({"colour": "red"}), &["parts[0].look.colour: expected a colour as \"#rrggbb\""]),
    // Joints.
    (|c| c["joints"][0]["parent"] = "bdy".into(),       &["joints[0].parent: there is no part `bdy`", "`body`"]),
    (|c| c["joints"][0]["child"] = "arm".into(),        &["joints[0].child: there is no part `arm`"]),
    (|c| c["joints"][1]["parent"] = "foot".into(),      &["joints[1]", "hang on each other in a circle", "thigh", "foot"]),
    (|c| c["joints"][0]["parent"] = "foot".into(),      &["joints[0]", "must stand earlier in `parts`"]),
    (|c| c["joints"][0]["parent"] = "leg".into(),       &["joints[0]", "circle: leg hangs on leg"]),
    (|c| { c["joints"].as_array_mut().map(|joints| joints.remove(0)); }, &["parts[1]", "`leg` hangs on no part"]),
    (|c| c["joints"][2]["child"] = "thigh".into(),      &["joints[2].child: `thigh` is already the child of joints[1]"]),
    (|c| c["joints"][0]["child"] = "body".into(),       &["joints[0]"]),
    (|c| c["joints"][0]["limits"] = json!([60, -60]),   &["joints[0].limits: expected the smaller limit first, found [60, -60]"]),
    (|c| c["joints"][0]["limits"] = json!([10, 60]),    &["joints[0].limits: limits are relative to the start pose"]),
    (|c| c["joints"][0]["limits"] = json!([0, 0]),      &["joints[0].limits: a joint with a motor needs room to turn"]),
    (|c| c["joints"][0]["limits"] = json!([-60]),       &["joints[0].limits"]),
    (|c| c["joints"][0]["motor"]["top_torque"] = 0.into(),    &["joints[0].motor.top_torque: expected", "found 0"]),
    (|c| c["joints"][0]["motor"]["top_torque"] = (-9).into(), &["joints[0].motor.top_torque: expected", "found -9"]),
    (|c| c["joints"][0]["motor"]["top_speed"] = 0.into(),     &["joints[0].motor.top_speed: expected", "found 0"]),
    (|c| c["joints"][0]["anchor"] = json!([5, 5]),      &["joints[0].anchor: the anchor lies"]),
    (|c| for joint in c["joints"].as_array_mut().into_iter().flatten() { joint["motor"] = Value::Null }, &["joints: nothing can move"]),
    (|c| c["actuated_tags"] = json!(["wing"]),          &["joints: nothing can move", "wing", "leg"]),
    // The rest.
    (|c| c["name"] = "../../etc".into(),                &["name: expected 1 to"]),
    (|c| c["name"] = "--out".into(),                    &["name: expected 1 to"]),
    (|c| c["sensors"] = json!(["torso-rotaton"]),       &["sensors[0]", "`torso-rotaton`", "`torso-rotation`"]),
    (|c| c["sensors"] = json!([]),                      &["sensors: expected 1 to"]),
    (|c| c["sensors"] = json!([{"clock": {"period": 0}}]), &["sensors[0].clock.period: expected"]),
    (|c| c["format"] = "gambol create".into(),          &["`format` must be \"gambol creature\""]),
    (|c| c["version"] = 2.into(),                       &["version"]),
];

/// Texts put in the place of the first density, that no JSON value can hold.
#[rustfmt::skip]
const TEXTS: &[(&str, &[&str])] = &[
    ("NaN",       &["line ", "column ", "not valid JSON"]),
    ("-Infinity", &["line ", "column ", "not valid JSON"]),
    ("1e999",     &["parts[0].density", "line ", "a number that fits single precision"]),
    ("1e39",      &["parts[0].density"]),
    ("30,,",      &["line ", "column ", "not valid JSON"]),
    ("30, \"density\": 31", &["parts[0]", "duplicate field `density`"]),
];

/// Both commands refuse the file with the same words.
#[track_caller]
fn assert_refused(file: &Path, says: &[&str]) {
    let says = [&[text(file)], says].concat();
    assert_says(&fail(gambol("check").arg(file)), &says);
    assert_says(&fail(gambol("train").arg(file).arg("running").current_dir(file.parent().expect("a folder"))), &says);
}

#[test]
fn the_creature_is_valid_before_it_is_changed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("stroller.json");
    fs::write(&file, creature().to_string())?;
    assert_says(&succeed(gambol("check").arg(&file)), &["a valid creature", "4 parts, 3 joints, 4 inputs, 3 outputs"]);
    let mut train = gambol("train");
    train.arg(&file).args(["jumping", "--population", "4", "--generations", "1", "--set", "movement.steps=10"]);
    succeed(train.current_dir(folder.path()));
    assert!(folder.path().join("runs/stroller-jumping/champion.json").is_file());
    Ok(())
}

#[test]
fn every_fault_is_named_with_file_and_field() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("stroller.json");
    for (change, says) in CHANGES {
        let mut creature = creature();
        change(&mut creature);
        fs::write(&file, serde_json::to_string_pretty(&creature)?)?;
        assert_refused(&file, says);
    }
    Ok(())
}

#[test]
fn numbers_that_are_none_are_named_with_their_place() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("stroller.json");
    let valid = serde_json::to_string_pretty(&creature())?;
    for (number, says) in TEXTS {
        fs::write(&file, valid.replacen("\"density\": 30", &format!("\"density\": {number}"), 1))?;
        assert_refused(&file, says);
    }
    Ok(())
}

/// All faults at once, so that they can be mended at once.
#[test]
fn several_faults_are_told_together() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("stroller.json");
    let mut creature = creature();
    creature["parts"][0]["density"] = 0.into();
    creature["joints"][2]["motor"]["top_torque"] = (-1).into();
    fs::write(&file, creature.to_string())?;
    assert_refused(&file, &["parts[0].density", "joints[2].motor.top_torque"]);
    Ok(())
}
