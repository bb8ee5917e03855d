//! Everything that can be wrong with the form of a creature file is told: where, what was found, what is expected.

mod common;

use common::small;
use creatures::{Blueprint, Creature, CreatureError, UnknownName};
use serde_json::{Value, json};

/// Spoils the small creature.
type Spoil = fn(&mut Value);

/// The error of the small creature after spoiling it.
fn error_of(spoil: impl FnOnce(&mut Value)) -> CreatureError {
    let mut file = small();
    spoil(&mut file);
    Blueprint::from_json(&file.to_string()).expect_err("it was spoilt")
}

#[test]
fn malformed_json_gives_line_and_column() {
    let error = Creature::from_json("{\n  \"format\": \"gambol creature\",\n  \"version\" 1\n}").expect_err("no colon");
    assert!(matches!(error, CreatureError::Syntax { line: 3, column: 13, .. }), "{error:?}");
    assert_eq!(error.to_string(), "line 3, column 13: not valid JSON: expected `:`");
    for text in ["", "{", "[1, 2", "nonsense", "{} {}"] {
        let error = Creature::from_json(text).expect_err("no JSON");
        assert!(matches!(error, CreatureError::Syntax { .. }), "{text}: {error:?}");
    }
}

#[test]
fn deep_nesting_is_an_error() {
    let error = Creature::from_json(&"[".repeat(1_000_000)).expect_err("no JSON");
    assert!(matches!(error, CreatureError::Syntax { .. } | CreatureError::Field { .. }));
}

#[test]
fn other_files_are_told_apart() {
    let error = error_of(|file| file["format"] = json!("gambol champion"));
    assert_eq!(
        error.to_string(),
        "not a creature file: `format` must be \"gambol creature\", found \"gambol champion\""
    );
    let error = Creature::from_json("{}").expect_err("empty");
    assert!(error.to_string().ends_with("found none"));
    let error = Creature::from_json("[]").expect_err("a list");
    assert!(matches!(error, CreatureError::Field { .. } | CreatureError::NotACreature { .. }), "{error}");
    let error = Creature::from_json("7").expect_err("a number");
    assert_eq!(error.to_string(), "the file (line 1, column 1): invalid type: integer `7`, expected an object");
}

#[test]
fn later_versions_are_told_before_their_new_fields() {
    let error = error_of(|file| {
        file["version"] = json!(2);
        file["wings"] = json!(4);
    });
    let expected = "version: this creature file is of version 2, written by a newer Gambol; this one reads version 1";
    assert_eq!(error.to_string(), expected);
    for version in [json!(0), json!("1"), json!(1.5), json!(-1), Value::Null] {
        let error = error_of(|file| file["version"] = version);
        assert!(matches!(error, CreatureError::Version { .. }), "{error:?}");
        assert!(error.to_string().starts_with("version: must be 1, found "), "{error}");
    }
}

#[test]
fn a_changed_header_is_caught_without_a_file() {
    let mut creature = Creature::from_json(&small().to_string()).expect("valid");
    creature.version = 9;
    assert!(matches!(Blueprint::new(creature.clone()), Err(CreatureError::Version { .. })));
    creature.format = "x".to_owned();
    assert!(matches!(Blueprint::new(creature), Err(CreatureError::NotACreature { .. })));
}

#[test]
fn wrong_types_give_the_path_of_the_field() {
    let error = error_of(|file| file["parts"][2]["shape"]["box"]["width"] = json!("wide"));
    assert!(matches!(&error, CreatureError::Field { path, .. } if path == "parts[2].shape.box.width"), "{error:?}");
    assert!(error.to_string().ends_with("invalid type: string \"wide\", expected a number"), "{error}");

    let error = error_of(|file| file["parts"][1]["position"] = json!([1]));
    assert!(matches!(&error, CreatureError::Field { path, .. } if path.starts_with("parts[1].position")), "{error:?}");

    let error = error_of(|file| drop(file["parts"][1].as_object_mut().map(|part| part.remove("density"))));
    assert!(error.to_string().starts_with("parts[1] (line 1, "), "{error}");
    assert!(error.to_string().ends_with("missing field `density`"), "{error}");
}

#[test]
fn misplaced_values_are_told_in_plain_words() {
    let cases: [(Spoil, &str, &str); 6] = [
        (|f| f["sensors"] = json!([5]), "sensors[0]", "expected a name, or an object with one name in it"),
        (|f| f["sensors"] = json!(["clock"]), "sensors[0].clock", "a name alone, expected an object with its settings"),
        (
            |f| f["sensors"] = json!([{ "torso-height": 1 }]),
            "sensors[0].torso-height",
            "invalid type: integer `1`, expected no settings: the name alone",
        ),
        (|f| f["parts"][0]["shape"] = json!({}), "parts[0].shape", "expected a name, or an object with one name in it"),
        (|f| f["parts"][0]["position"] = json!([1, 2, 3]), "parts[0].position", "too many values in the list"),
        (
            |f| f["joints"][0]["limits"] = json!({}),
            "joints[0].limits",
            "invalid type: an object, expected a list of 2 numbers",
        ),
    ];
    for (spoil, path, message) in cases {
        let error = error_of(spoil).to_string();
        assert!(error.starts_with(&format!("{path} (line 1, ")), "{error}");
        assert!(error.ends_with(message), "{error}");
    }
}

#[test]
fn unknown_fields_name_the_nearest() {
    let error = error_of(|file| file["parts"][0]["frction"] = json!(1));
    let CreatureError::UnknownName(unknown) = &error else { panic!("{error:?}") };
    let UnknownName { path, what, found, nearest, valid, .. } = unknown.as_ref();
    assert_eq!((path.as_str(), *what, found.as_str()), ("parts[0].frction", "field", "frction"));
    assert_eq!(nearest.as_deref(), Some("friction"));
    assert_eq!(valid.len(), 9);
    assert!(error.to_string().contains("unknown field `frction`; did you mean `friction`?"), "{error}");

    let error = error_of(|file| file["parts"][0]["shape"]["box"]["heigth"] = json!(1));
    assert!(error.to_string().contains("did you mean `height`?"), "{error}");
    let error = error_of(|file| file["joints"][0]["motor"]["zzz"] = json!(1));
    assert!(error.to_string().contains("unknown field `zzz` (valid: top_speed, top_torque)"), "{error}");
}

#[test]
fn unknown_sensors_shapes_and_forms_name_the_nearest() {
    let cases: [(Spoil, &str, &str); 4] = [
        (|file| file["sensors"] = json!(["clock", "joint-angels"]), "sensors[0]", ""),
        (
            |file| file["sensors"] = json!(["torso-rotation", "joint-angels"]),
            "sensors[1]",
            "unknown sensor `joint-angels`; did you mean `joint-angles`?",
        ),
        (
            |file| file["parts"][0]["shape"] = json!({ "circel": { "radius": 1 } }),
            "parts[0].shape",
            "unknown shape `circel`; did you mean `circle`?",
        ),
        (
            |file| file["parts"][0]["look"] = json!({ "decorations": [{ "form": { "elipse": {} } }] }),
            "parts[0].look.decorations[0].form",
            "unknown form `elipse`; did you mean `ellipse`?",
        ),
    ];
    for (spoil, path, message) in cases {
        let error = error_of(spoil).to_string();
        assert!(error.starts_with(path), "{error}");
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn unknown_creatures_name_the_nearest() {
    let error = creatures::find("bipd-1").expect_err("mistyped");
    assert_eq!(
        error.to_string(),
        "there is no creature `bipd-1`; did you mean `biped-1`? (valid: apod, biped-1, biped-2, tetrapod-1, tetrapod-2, \
         decapod-1, decapod-2)"
    );
    assert!(creatures::find("zzzzzz").expect_err("no such").nearest.is_none());
}
