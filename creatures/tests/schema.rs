//! The published JSON Schema is the derived one, and every shipped file keeps to it.
//!
//! After a change of the format, write it anew:
//! `GAMBOL_WRITE_SCHEMA=1 cargo test -p gambol-creatures --features schema --test schema`
#![cfg(feature = "schema")]

use serde_json::{Value, json};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/schema/creature.schema.json");

fn validator() -> jsonschema::Validator {
    let schema: Value = serde_json::from_str(&creatures::json_schema()).expect("the schema is JSON");
    jsonschema::validator_for(&schema).expect("the schema is one")
}

#[test]
fn published_schema_is_the_derived_one() {
    let derived = creatures::json_schema();
    if std::env::var_os("GAMBOL_WRITE_SCHEMA").is_some() {
        std::fs::write(PATH, &derived).expect("the schema can be written");
    }
    let published = std::fs::read_to_string(PATH).unwrap_or_default();
    assert!(published == derived, "schema/creature.schema.json is out of date: see the top of this test");
}

#[test]
fn shipped_files_keep_to_the_schema() {
    let validator = validator();
    for file in creatures::shipped() {
        let value: Value = serde_json::from_str(file.json).expect("JSON");
        let errors: Vec<String> =
            validator.iter_errors(&value).map(|error| format!("{}: {error}", error.instance_path())).collect();
        assert!(errors.is_empty(), "{}: {errors:?}", file.name);
    }
}

#[test]
fn written_files_keep_to_the_schema() {
    let validator = validator();
    for file in creatures::shipped() {
        let creature = creatures::find(file.name).expect("shipped");
        let value: Value = serde_json::from_str(&creature.to_json()).expect("JSON");
        assert!(validator.is_valid(&value), "{}", file.name);
    }
}

#[test]
fn the_schema_catches_slips() {
    let validator = validator();
    let slips: [fn(&mut Value); 6] = [
        |file| file["wings"] = json!(2),
        |file| file["version"] = json!(2),
        |file| file["parts"][0]["density"] = json!(-1),
        |file| file["parts"][0]["look"]["colour"] = json!("red"),
        |file| file["parts"][0]["shape"] = json!({ "circle": { "radius": 0 } }),
        |file| file["sensors"] = json!(["joint-angels"]),
    ];
    for (index, slip) in slips.iter().enumerate() {
        let mut file: Value = serde_json::from_str(creatures::shipped()[1].json).expect("JSON");
        assert!(validator.is_valid(&file));
        slip(&mut file);
        assert!(!validator.is_valid(&file), "slip {index}");
    }
}
