//! Settings of movements and terms: read from files, checked, and named where they are wrong.

use proptest::prelude::*;
use serde_json::json;
use tasks::{MovementCatalogue, MovementSpec, MovementSpecError, TermSpec, conformance::check_movement};

fn spec(value: serde_json::Value) -> MovementSpec {
    serde_json::from_value(value).expect("a spec")
}

fn error(value: serde_json::Value) -> String {
    let built = MovementCatalogue::default().build(&spec(value));
    built.err().map(|error: MovementSpecError| error.to_string()).expect("it is refused")
}

#[test]
fn wrong_settings_are_named_with_their_field() {
    for (settings, message) in [
        (json!({ "name": "walking", "settings": { "speed": -1 } }), "settings.speed = -1: must be from 0 to 100"),
        (json!({ "name": "walking", "settings": { "speed": 101 } }), "settings.speed = 101: must be from 0 to 100"),
        (
            json!({ "name": "walking", "settings": { "spede": 1 } }),
            "settings.spede: unknown field `spede`, expected `speed`",
        ),
        (
            json!({ "name": "walking", "settings": { "speed": "fast" } }),
            "settings.speed: invalid type: string \"fast\", expected f64",
        ),
        (
            json!({ "name": "walking", "settings": { "speed": null } }),
            "settings.speed: invalid type: null, expected f64",
        ),
        (
            json!({ "name": "cruising", "settings": { "speed": 100.5 } }),
            "settings.speed = 100.5: must be from 0 to 100",
        ),
        (json!({ "name": "standing", "settings": { "after": -0.5 } }), "settings.after = -0.5: must be from 0 to 1000"),
        (
            json!({ "name": "getting-up", "settings": { "turn": 5 } }),
            "settings.turn = 5: must be from 10 to 180, or from -180 to -10",
        ),
        (
            json!({ "name": "getting-up", "settings": { "turn": -181 } }),
            "settings.turn = -181: must be from 10 to 180, or from -180 to -10",
        ),
        (
            json!({ "name": "running", "settings": { "speed": 1 } }),
            "settings.speed: unknown field; \"running\" has no settings",
        ),
        (
            json!({ "name": "running", "terms": [{ "term": "energy" }, { "term": "walking", "settings": { "speed": -1 } }] }),
            "terms[1].settings.speed = -1: must be from 0 to 100",
        ),
        (
            json!({ "name": "running", "terms": [{ "term": "no-exploits", "settings": { "ends": 1 } }] }),
            "terms[0].settings.ends: invalid type: integer `1`, expected a boolean",
        ),
        (
            json!({ "name": "running", "terms": [{ "term": "headway", "settings": { "backwards": 1 } }] }),
            "terms[0].settings.backwards: invalid type: integer `1`, expected a boolean",
        ),
        (
            json!({ "name": "running", "terms": [{ "term": "energy", "settings": { "most": 1 } }] }),
            "terms[0].settings.most: unknown field; \"energy\" has no settings",
        ),
    ] {
        assert_eq!(error(settings), message);
    }
}

#[test]
fn settings_that_are_left_out_are_not_written() {
    let plain = MovementSpec { terms: vec![TermSpec::new("energy", -1.0)], ..MovementSpec::new("running") };
    let text = serde_json::to_string(&plain).expect("plain data");
    assert_eq!(text, r#"{"name":"running","terms":[{"term":"energy","weight":-1.0}]}"#);
    let text = r#"{"name":"walking","settings":{"speed":0.5},"terms":[{"term":"headway","weight":0.0,"settings":{"backwards":true}}]}"#;
    let spec: MovementSpec = serde_json::from_str(text).expect("a spec");
    assert_eq!(serde_json::to_string(&spec).expect("plain data"), text);
    assert!(MovementCatalogue::default().build(&spec).is_ok());
}

proptest! {
    /// What is in range makes a movement that keeps its promises, and what is not an error.
    #[test]
    fn every_setting_in_range_makes_a_sound_movement(speed in -20.0..120.0_f64, after in -100.0..1100.0_f64, turn in -200.0..200.0_f64) {
        let catalogue = MovementCatalogue::default();
        for (name, field, number, allowed) in [
            ("walking", "speed", speed, (0.0..=100.0).contains(&speed)),
            ("cruising", "speed", speed, (0.0..=100.0).contains(&speed)),
            ("standing", "after", after, (0.0..=1000.0).contains(&after)),
            ("getting-up", "turn", turn, (10.0..=180.0).contains(&turn.abs())),
        ] {
            let spec = spec(json!({ "name": name, "settings": { field: number } }));
            match catalogue.build(&spec) {
                Ok(movement) => {
                    prop_assert!(allowed, "{name} {field} {number}");
                    prop_assert_eq!(check_movement(&*movement), Ok(()));
                }
                Err(error) => prop_assert!(!allowed, "{error}"),
            }
        }
    }
}
