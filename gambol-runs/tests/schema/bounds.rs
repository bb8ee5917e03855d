//! Every range of the schema is that of the library: a number just outside is refused, the bound itself is accepted.

use crate::samples::{LISTS, Sample, check_config, samples};
use gambol_runs::{Registry, schema::json_schema};
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet};

/// The ends of a range, as a schema has them.
const ENDS: [&str; 4] = ["minimum", "maximum", "exclusiveMinimum", "exclusiveMaximum"];

/// Numbers without a range of their own, by definition: any will do, or what will do depends on others.
const WITHOUT_RANGE: &[&str] = &[
    // Any: an even larger fitness is refused nowhere, and weights of terms have any sign.
    "/$defs/MeasurementBound/properties/at_least",
    "/$defs/MeasurementBound/properties/at_most",
    "/$defs/PopulationShare/properties/fitness",
    "/$defs/PromotionRule/oneOf/fitness",
    "/$defs/StopConditions/properties/target",
    "/$defs/TermSpec/properties/weight",
    // Parts of nets that runs fill in: any finite number.
    "/$defs/CopySense/properties/constant",
    "/$defs/CopySense/properties/sources/items/prefixItems/1",
    "/$defs/GeneRecord/properties/held",
    "/$defs/SharedWeight/oneOf/affine/properties/constant",
    "/$defs/SharedWeight/oneOf/affine/properties/terms/items/prefixItems/1",
    "/$defs/SharedWeight/oneOf/sum/items/prefixItems/1",
    "/$defs/Turn/properties/factor",
    "/$defs/Turn/properties/phase",
    "/$defs/Turn/properties/phase_genes/items/prefixItems/1",
    // One of two.
    "/$defs/NetCopy/properties/sign",
];

/// Where a number or a number's bound stands in the schema, from its definition on; a choice by the name of what is chosen.
type Place = String;

/// A place of the schema that a place of a value falls under.
struct Found<'a> {
    /// JSON pointer into the value.
    at: String,
    place: Place,
    schema: &'a Map<String, Value>,
}

fn resolved<'a>(root: &'a Value, place: &str, schema: &'a Value) -> (Place, &'a Value) {
    match schema["$ref"].as_str() {
        Some(target) => {
            let pointer = target.trim_start_matches('#');
            (pointer.into(), root.pointer(pointer).expect("a definition"))
        }
        None => (place.into(), schema),
    }
}

/// The parts of a schema: how each is reached, and what of a value falls under it.
fn parts<'a>(place: &str, schema: &'a Value) -> Vec<(Place, Reach, &'a Value)> {
    let mut parts = Vec::new();
    for (field, schema) in schema["properties"].as_object().into_iter().flatten() {
        parts.push((format!("{place}/properties/{field}"), Reach::Field(field.clone()), schema));
    }
    if schema["items"].is_object() {
        parts.push((format!("{place}/items"), Reach::Items, &schema["items"]));
    }
    for (index, schema) in schema["prefixItems"].as_array().into_iter().flatten().enumerate() {
        parts.push((format!("{place}/prefixItems/{index}"), Reach::Item(index), schema));
    }
    for (index, choice) in schema["oneOf"].as_array().into_iter().flatten().enumerate() {
        // What is chosen stands in an object by its name: left out of the place, and so its position.
        match choice["properties"]
            .as_object()
            .filter(|fields| fields.len() == 1)
            .and_then(|fields| fields.iter().next())
        {
            Some((name, schema)) => {
                parts.push((format!("{place}/oneOf/{name}"), Reach::Field(name.clone()), schema));
            }
            None => parts.push((format!("{place}/oneOf/{index}"), Reach::Itself, choice)),
        }
    }
    for (index, choice) in schema["anyOf"].as_array().into_iter().flatten().enumerate() {
        parts.push((format!("{place}/anyOf/{index}"), Reach::Itself, choice));
    }
    parts
}

enum Reach {
    Itself,
    Field(String),
    Item(usize),
    Items,
}

/// Whether a value is of the kind that a schema is for.
fn is_for(root: &Value, schema: &Value, value: &Value) -> bool {
    let (_, schema) = resolved(root, "", schema);
    let kind = match value {
        Value::Null => "null",
        Value::Bool(_) => "boolean",
        Value::Number(_) => "number",
        Value::String(_) => "string",
        Value::Array(_) => "array",
        Value::Object(_) => "object",
    };
    let is_kind = |name: &Value| name == kind || (name == "integer" && kind == "number");
    let kind_fits = match &schema["type"] {
        Value::Null => true,
        Value::Array(names) => names.iter().any(is_kind),
        name => is_kind(name),
    };
    kind_fits && schema.get("const").is_none_or(|only| only == value)
}

/// Everything in a value that falls under a schema.
fn find<'a>(root: &'a Value, place: &str, schema: &'a Value, at: &str, value: &Value, found: &mut Vec<Found<'a>>) {
    let (place, schema) = resolved(root, place, schema);
    if !is_for(root, schema, value) {
        return;
    }
    if let Some(schema) = schema.as_object() {
        found.push(Found { at: at.into(), place: place.clone(), schema });
    }
    for (place, reach, part) in parts(&place, schema) {
        match reach {
            Reach::Itself => find(root, &place, part, at, value, found),
            Reach::Field(field) => {
                if let Some(inner) = value.get(&field) {
                    find(root, &place, part, &format!("{at}/{field}"), inner, found);
                }
            }
            Reach::Item(index) => {
                if let Some(inner) = value.get(index) {
                    find(root, &place, part, &format!("{at}/{index}"), inner, found);
                }
            }
            Reach::Items => {
                for (index, inner) in value.as_array().into_iter().flatten().enumerate() {
                    find(root, &place, part, &format!("{at}/{index}"), inner, found);
                }
            }
        }
    }
}

/// All places of a schema, and what it says there.
fn all_places<'a>(place: &str, schema: &'a Value, places: &mut BTreeMap<Place, &'a Map<String, Value>>) {
    if let Some(object) = schema.as_object() {
        places.insert(place.into(), object);
    }
    for (place, _, part) in parts(place, schema) {
        all_places(&place, part, places);
    }
    for (name, definition) in schema["$defs"].as_object().into_iter().flatten() {
        all_places(&format!("/$defs/{name}"), definition, places);
    }
}

/// The numbers next to a bound, as the field that has it rounds them: the one below it, itself, and the one above.
fn neighbours(place: &str, schema: &Map<String, Value>, bound: &Value) -> [Value; 3] {
    let wide = bound.as_f64().expect("a number");
    if place.starts_with("/$defs/Variation/") && place.ends_with("/anyOf/1") {
        // A share, which is read as 1 - share and 1 + share: as fine as numbers next to 1 are.
        return [wide - f64::from(f32::EPSILON), wide, wide + f64::from(f32::EPSILON)].map(Value::from);
    }
    match schema["format"].as_str().expect("numbers have a format") {
        "float" => {
            let single = wide as f32;
            [json!(f64::from(single.next_down())), bound.clone(), json!(f64::from(single.next_up()))]
        }
        "double" => [json!(wide.next_down()), bound.clone(), json!(wide.next_up())],
        _ => {
            let whole = wide as i64;
            [json!(whole - 1), json!(whole), json!(whole + 1)]
        }
    }
}

/// What must be refused and what must be accepted for the sake of an end of a range.
fn cases(place: &str, end: &str, schema: &Map<String, Value>) -> (Vec<Value>, Value) {
    let [below, bound, above] = neighbours(place, schema, &schema[end]);
    match end {
        "minimum" => (vec![below], bound),
        "maximum" => (vec![above], bound),
        "exclusiveMinimum" => (vec![below, bound], above),
        _ => (vec![above, bound], below),
    }
}

#[test]
fn ranges_are_those_of_the_library() {
    let registry = Registry::default();
    let root = json_schema(&registry);
    let mut places = BTreeMap::new();
    all_places("", &root, &mut places);
    let ends =
        |schema: &Map<String, Value>| ENDS.into_iter().filter(|&end| schema.contains_key(end)).collect::<Vec<_>>();
    let mut unproved: BTreeSet<(Place, &str)> =
        places.iter().flat_map(|(place, schema)| ends(schema).into_iter().map(|end| (place.clone(), end))).collect();
    assert!(unproved.len() > 300, "{} ends of ranges", unproved.len());
    let mut wrong = Vec::new();
    for Sample { name, value, definition, check } in samples(&registry) {
        if let Err(error) = check(&value) {
            wrong.push(format!("{name}: {error}"));
            continue;
        }
        let mut found = Vec::new();
        find(&root, definition, root.pointer(definition).expect("a definition"), "", &value, &mut found);
        for Found { at, place, schema } in found {
            for end in ends(schema) {
                let key = (place.clone(), end);
                let is_fine = |number: &Value| {
                    let mut changed = value.clone();
                    *changed.pointer_mut(&at).expect("it was found there") = number.clone();
                    check(&changed).is_ok()
                };
                let (outside, inside) = cases(&place, end, schema);
                // Where other fields do not allow it, nothing is said of this one.
                if !unproved.contains(&key) || !is_fine(&inside) {
                    continue;
                }
                unproved.remove(&key);
                for number in outside.iter().filter(|number| is_fine(number)) {
                    wrong.push(format!("{name}: {at} = {number} is accepted, the schema has {end} {}", schema[end]));
                }
            }
        }
    }
    wrong.extend(unproved.iter().map(|(place, end)| format!("{place}: its {end} is fine in no sample")));
    assert!(wrong.is_empty(), "{} faults:\n{}", wrong.len(), wrong.join("\n"));
}

#[test]
fn lists_have_the_lengths_of_the_library() {
    let root = json_schema(&Registry::default());
    let mut places = BTreeMap::new();
    all_places("", &root, &mut places);
    for (place, list) in LISTS {
        let fewest = places[*place].get("minItems").and_then(Value::as_u64);
        let most = places[*place].get("maxItems").and_then(Value::as_u64);
        assert!(fewest.is_some() || most.is_some(), "{place}");
        let is_fine = |count: u64| check_config(&list(count as usize)).is_ok();
        if let Some(fewest) = fewest.filter(|&fewest| fewest > 0) {
            assert_eq!((is_fine(fewest), is_fine(fewest - 1)), (true, false), "{place}, from {fewest}");
        }
        if let Some(most) = most {
            assert_eq!((is_fine(most), is_fine(most + 1)), (true, false), "{place}, to {most}");
        }
    }
}

#[test]
fn numbers_have_ranges_but_these() {
    let root = json_schema(&Registry::default());
    let mut places = BTreeMap::new();
    all_places("", &root, &mut places);
    let is_float =
        |schema: &Map<String, Value>| matches!(schema.get("format").and_then(Value::as_str), Some("float" | "double"));
    let without =
        places.iter().filter(|(_, schema)| is_float(schema) && !ENDS.iter().any(|&end| schema.contains_key(end)));
    let without: Vec<&str> = without.map(|(place, _)| place.as_str()).collect();
    let mut expected = WITHOUT_RANGE.to_vec();
    expected.sort_unstable();
    assert_eq!(without, expected);
}
