//! Whatever a file says, reading it never panics; and what is valid survives a round trip.

mod common;

use common::small;
use creatures::{Blueprint, Creature, Motors, Senses};
use proptest::prelude::*;
use serde_json::{Value, json};

/// Reads a file as far as it goes.
fn try_everything(text: &str) {
    match Blueprint::from_json(text) {
        Ok(blueprint) => {
            let again = Creature::from_json(&blueprint.creature().to_json());
            assert_eq!(again.as_ref(), Ok(blueprint.creature()));
            let senses = Senses::new(&blueprint, &blueprint.creature().sensors, 3.0).expect("checked with the file");
            assert!(senses.channels().iter().all(|channel| channel.range[0] < channel.range[1]));
            assert!(!Motors::new(&blueprint).is_empty());
            assert!(blueprint.body_length() > 0.0 && blueprint.start_height() > 0.0 && blueprint.mass() > 0.0);
            assert_eq!(blueprint.hinges().len() + 1, blueprint.parts().len());
            assert!(blueprint.hinges().iter().all(|hinge| hinge.parent < hinge.child));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// All places in a JSON value, as JSON pointers.
fn places(value: &Value, here: String, found: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(index, inner)| places(inner, format!("{here}/{index}"), found));
        }
        Value::Object(map) => map.iter().for_each(|(key, inner)| places(inner, format!("{here}/{key}"), found)),
        _ => {}
    }
    found.push(here);
}

fn values() -> impl Strategy<Value = Value> {
    let texts = ["torso", "left leg", "right leg", "leg", "clock", "", "é#12", "#ff00ff"];
    let shapes = vec![
        json!({ "circle": { "radius": 0.2 } }),
        json!({ "capsule": { "length": 0.2, "radius": 0.1 } }),
        json!({ "rangefinder": { "angles": [0, -45.5], "length": 2 } }),
        json!({ "clock": { "period": 0.5 } }),
        json!({ "colour": "#123456", "layer": 3, "opacity": 0.5 }),
        json!([]),
        json!({}),
        json!(null),
        json!(true),
    ];
    prop_oneof![
        any::<f64>().prop_map(|number| json!(number)),
        (-2.0..2.0f32).prop_map(|number| json!(number)),
        any::<i64>().prop_map(|number| json!(number)),
        (0..12i32).prop_map(|number| json!(number)),
        proptest::sample::select(texts.to_vec()).prop_map(|text| json!(text)),
        proptest::sample::select(shapes),
        ".{0,12}".prop_map(|text| json!(text)),
    ]
}

/// Replaces, removes or doubles what stands at a place.
fn mutate(file: &mut Value, place: &str, how: u8, value: Value) {
    let (parent, key) = place.rsplit_once('/').unwrap_or(("", ""));
    match (how, file.pointer_mut(parent)) {
        (0, Some(Value::Object(map))) => drop(map.remove(key)),
        (1, Some(Value::Array(list))) if !list.is_empty() => {
            let index = key.parse::<usize>().unwrap_or(0).min(list.len() - 1);
            let copy = list[index].clone();
            list.push(copy);
        }
        (2, Some(Value::Array(list))) if !list.is_empty() => drop(list.pop()),
        (3, Some(Value::Array(list))) => list.reverse(),
        (4, Some(Value::Object(map))) => drop(map.insert("surprise".to_owned(), value)),
        _ => {
            if let Some(target) = file.pointer_mut(place) {
                *target = value;
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(1000) })]

    #[test]
    fn mutated_files_never_panic(
        mutations in proptest::collection::vec((any::<proptest::sample::Index>(), 0u8..12, values()), 1..4)
    ) {
        let mut file = small();
        for (index, how, value) in mutations {
            let mut found = Vec::new();
            places(&file, String::new(), &mut found);
            let place = index.get(&found).clone();
            mutate(&mut file, &place, how, value);
        }
        try_everything(&file.to_string());
    }

    #[test]
    fn garbled_text_never_panics(at in any::<proptest::sample::Index>(), byte in any::<char>(), cut in any::<bool>()) {
        let text: Vec<char> = small().to_string().chars().collect();
        let at = at.index(text.len());
        let mut garbled: String = text[..at].iter().collect();
        if !cut {
            garbled.push(byte);
            garbled.extend(&text[at + 1..]);
        }
        try_everything(&garbled);
    }

    #[test]
    fn arbitrary_text_never_panics(text in ".{0,200}") {
        try_everything(&text);
    }

    #[test]
    fn numbers_survive_a_round_trip(
        position in prop::array::uniform2(-100.0..100.0f32),
        density in 0.1..10_000.0f32,
        angle in -360.0..360.0f32,
        opacity in 0.0..1.0f32,
    ) {
        let mut creature = Creature::from_json(&small().to_string()).expect("valid");
        let part = &mut creature.parts[0];
        (part.position, part.density, part.angle, part.look.opacity) = (position, density, angle, opacity);
        let again = Creature::from_json(&creature.to_json());
        prop_assert_eq!(again.as_ref(), Ok(&creature));
    }
}
