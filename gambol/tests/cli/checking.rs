//! `check`, `creatures` and `movements`.

use crate::program::{assert_says, fail, gambol, small_run, succeed, text};
use serde_json::Value;
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
    let catalogue = tasks::MovementCatalogue::default();
    assert_eq!(listed.len(), catalogue.entries().len());
    for (entry, row) in catalogue.entries().iter().zip(&listed) {
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
        assert_says(&printed, &[text(&path), "a valid creature", "\n  in   ", "\n  out  "]);
    }
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
        &["there is no creature `tetrapd-2`", "did you mean `tetrapod-2`?"],
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
