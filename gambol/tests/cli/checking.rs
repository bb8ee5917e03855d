//! `check`, `creatures` and `movements`.

use crate::{
    bad_creatures,
    program::{assert_says, fail, gambol, small_run, succeed, text},
};
use serde_json::{Value, json};
use std::fs;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn every_shipped_creature_is_listed_with_its_numbers() -> Outcome {
    let plain = succeed(&mut gambol("creatures"));
    let listed: Vec<Value> = serde_json::from_str(&succeed(gambol("creatures").arg("--json")))?;
    assert_eq!(listed.len(), creatures::shipped().len());
    for (shipped, row) in creatures::shipped().iter().zip(&listed) {
        assert_says(&plain, &[&format!("\n{} ", shipped.name)]);
        assert_eq!(row["name"], shipped.name);
        let number = |field: &str| row[field].as_u64().expect("a number");
        assert_eq!(number("joints"), number("parts") - 1, "{row}");
        assert!(number("inputs") > 0 && number("outputs") > 0, "{row}");
    }
    Ok(())
}

#[test]
fn every_movement_and_term_is_listed() -> Outcome {
    let plain = succeed(&mut gambol("movements"));
    let listed: Vec<Value> = serde_json::from_str(&succeed(gambol("movements").arg("--json")))?;
    let registry = gambol::Registry::default();
    assert_eq!(listed.len(), registry.movements.entries().len());
    for (entry, row) in registry.movements.entries().iter().zip(&listed) {
        assert_says(&plain, &[&format!("\n  {} ", entry.name), &entry.description]);
        assert_eq!((row["name"].as_str(), row["unit"].as_str()), (Some(&*entry.name), Some(&*entry.unit)));
    }
    Ok(())
}

#[test]
fn every_shipped_creature_is_valid() -> Outcome {
    let folder = tempfile::tempdir()?;
    for shipped in creatures::shipped() {
        let path = folder.path().join(shipped.name).with_extension("json");
        fs::write(&path, shipped.json)?;
        let printed = succeed(gambol("check").arg(&path));
        assert_says(
            &printed,
            &[text(&path), "a valid creature", "looks the same from both sides", "\n  in   ", "\n  out  "],
        );
        assert!(!printed.contains("warning"), "{printed}");
    }
    Ok(())
}

#[test]
fn a_sensor_that_is_not_known_is_named_with_its_file() -> Outcome {
    let mut creature = bad_creatures::creature();
    creature["sensors"] = json!([{ "custom": { "name": "lift" } }]);
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("stroller.json");
    fs::write(&path, creature.to_string())?;
    assert_says(&fail(gambol("check").arg(&path)), &[text(&path), "sensors[0].custom.name", "\"lift\""]);
    Ok(())
}

#[test]
fn a_leg_that_ends_in_a_passive_part_is_warned_of() -> Outcome {
    let mut creature = bad_creatures::creature();
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("stroller.json");
    let checked = |creature: &Value| -> Result<String, Box<dyn std::error::Error>> {
        fs::write(&path, creature.to_string())?;
        Ok(succeed(gambol("check").arg(&path)))
    };
    let warning = "foot is not actuated and hangs on thigh, so that thigh is no foot and its chain no leg";
    assert!(!checked(&creature)?.contains(warning));
    creature["parts"][3]["tag"] = "toe".into();
    assert_says(&checked(&creature)?, &[warning]);
    creature["parts"][2]["leg"] = false.into();
    assert!(!checked(&creature)?.contains(warning), "it is said to be none");
    Ok(())
}

/// This shipped creature with something changed, checked: what is printed. It stays valid.
fn checked(name: &str, change: impl FnOnce(&mut creatures::Creature)) -> Result<String, Box<dyn std::error::Error>> {
    let mut creature = creatures::find(name)?;
    change(&mut creature);
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("changed.json");
    fs::write(&path, creature.to_json())?;
    Ok(succeed(gambol("check").arg(&path)))
}

/// A body that topples before the clock starts would else be judged from where it lies.
#[test]
fn a_creature_that_starts_out_of_balance_is_warned_of() -> Outcome {
    for (x, way, side) in [(2.0, "forwards", "ahead of"), (-2.0, "backwards", "behind")] {
        let printed = checked("biped-1", |creature| {
            let mut weight = creature.parts[0].clone();
            (weight.name, weight.tag, weight.position[0]) = ("weight".into(), "weight".into(), 0.25 * x);
            weight.density = 500.0;
            let anchor = [0.1 * x, weight.position[1]];
            let joint = creatures::Joint {
                parent: creature.parts[0].name.clone(),
                child: "weight".into(),
                anchor,
                limits: [0.0, 0.0],
                motor: None,
            };
            creature.parts.push(weight);
            creature.joints.push(joint);
        })?;
        assert_says(
            &printed,
            &[
                "a valid creature",
                "warning: it settles tilted by ",
                &format!("° {way}, its torso "),
                " % lower: it starts out of balance; move what it stands on ",
            ],
        );
        assert_says(&printed, &[&format!(" m {side} the points on the ground (x = ")]);
    }
    Ok(())
}

/// Its centre of mass is above its feet, but motors that are asked for speed 0 let an ankle creep.
#[test]
fn a_creature_whose_joints_creep_is_warned_of() -> Outcome {
    let mut creature: Value = serde_json::from_str(&fs::read_to_string(example("biped-with-feet"))?)?;
    for part in creature["parts"].as_array_mut().expect("parts") {
        // The feet in front of the ankles.
        if part["name"].as_str().is_some_and(|name| name.ends_with("foot")) {
            part["position"][0] = (part["position"][0].as_f64().expect("a place") + 0.06).into();
        }
    }
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("changed.json");
    fs::write(&path, creature.to_string())?;
    let printed = succeed(gambol("check").arg(&path));
    assert_says(
        &printed,
        &["warning: it settles tilted by ", " % lower: it starts out of balance", "creep under load"],
    );
    Ok(())
}

fn example(name: &str) -> String {
    format!("{}/../examples/creatures/{name}.json", env!("CARGO_MANIFEST_DIR"))
}

#[test]
fn the_bodies_to_try_start_in_balance() {
    for name in ["biped-with-feet", "hexapod", "hopper", "long-apod", "tripod"] {
        let printed = succeed(gambol("check").arg(example(name)));
        assert!(printed.contains("a valid creature") && !printed.contains("warning"), "{printed}");
        let turns_round = !["long-apod", "tripod"].contains(&name);
        assert_eq!(printed.contains("looks the same from both sides"), turns_round, "{printed}");
    }
}

#[test]
fn a_creature_that_sinks_or_cannot_settle_is_warned_of() -> Outcome {
    let printed = checked("tetrapod-2", |creature| {
        creature
            .joints
            .iter_mut()
            .for_each(|joint| joint.motor = joint.motor.map(|motor| creatures::Motor { top_torque: 0.01, ..motor }));
        let shins = creature.parts.iter_mut().filter(|part| part.name.contains("shin"));
        shins.for_each(|shin| shin.position[0] += 0.15);
    })?;
    assert_says(&printed, &["warning: its torso sinks by ", " % while it settles, from ", "straighten its legs"]);
    let printed = checked("biped-1", |creature| {
        creature.parts.iter_mut().for_each(|part| part.position[1] += 30.0);
        creature.joints.iter_mut().for_each(|joint| joint.anchor[1] += 30.0);
    })?;
    assert_says(&printed, &["warning: it cannot be trained: ", "still in the air after settling for 1 s"]);
    Ok(())
}

#[test]
fn a_creature_too_small_for_steps_of_the_world_is_told_how_to_be_trained() -> Outcome {
    let shrunk = |factor: f32| {
        checked("biped-1", |creature| {
            for part in &mut creature.parts {
                part.position = part.position.map(|place| factor * place);
                part.look = creatures::Look::default();
                if let creatures::Shape::Box { width, height } = &mut part.shape {
                    (*width, *height) = (factor * *width, factor * *height);
                }
            }
            creature.joints.iter_mut().for_each(|joint| joint.anchor = joint.anchor.map(|place| factor * place));
        })
    };
    let says = "note: it is so small that it falls over within 0.09 s, and the world has steps of 0.02 s: train it with \
                --set physics.time_step=0.006, and with 3 times as many steps";
    assert_says(&shrunk(0.1)?, &[says]);
    assert!(!shrunk(0.3)?.contains("so small"));
    Ok(())
}

#[test]
fn a_shipped_creature_is_checked_by_its_name() {
    let printed = succeed(gambol("check").arg("tetrapod-2"));
    assert_says(
        &printed,
        &["tetrapod-2: a valid creature, \"tetrapod-2\": 9 parts, 8 joints", "\n  in   ", "\n  out  "],
    );
    assert_says(
        &fail(gambol("check").arg("tetrapd-2")),
        &["there is no creature \"tetrapd-2\"", "did you mean \"tetrapod-2\"?"],
    );
    // What can only be a file is sought as one.
    for file in ["tetrapod-2.json", "./tetrapod-2"] {
        assert_says(&fail(gambol("check").arg(file)), &[&format!("cannot read {file}: ")]);
    }
}

#[test]
fn every_shipped_configuration_is_valid() -> Outcome {
    for entry in fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../shaping"))? {
        let printed = succeed(gambol("check").arg(entry?.path()));
        assert_says(&printed, &["a valid configuration", "\n  stage 1 ", "\n  stage 2 "]);
    }
    Ok(())
}

#[test]
fn the_files_of_a_run_are_valid() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(small_run(&path, 2).arg("--quiet"));
    let check = |name: &str| succeed(gambol("check").arg(path.join(name)));
    assert_says(&check("config.json"), &["a valid configuration"]);
    assert_says(&check("champion.json"), &["a valid champion", "gambol verify"]);
    // What it holds is known only with the strategy that wrote it.
    assert_says(&fail(gambol("check").arg(path.join("checkpoint"))), &["gambol resume"]);
    Ok(())
}

/// A file that is laid over a preset need not say everything.
#[test]
fn a_part_of_a_configuration_is_valid() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("part.json");
    for part in ["{}", r#"{"seed": 4}"#, r#"{"creature": "apod", "movement": {"name": "jumping", "steps": 90}}"#] {
        fs::write(&path, part)?;
        assert_says(&succeed(gambol("check").arg(&path)), &["a valid configuration"]);
    }
    Ok(())
}
