//! Types are read as `serde_json` reads them, faults are told in its words, and have the path that `serde_path_to_error` finds.

use field_path::{from_slice, from_str, without_place};
use proptest::prelude::*;
use serde::Deserialize;
use serde_json::{Value, json};
use std::collections::BTreeMap;

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[derive(Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
struct Whole {
    name: String,
    count: u32,
    small: i8,
    share: f32,
    exact: f64,
    is_on: bool,
    letter: char,
    nothing: (),
    maybe: Option<f32>,
    pair: [f32; 2],
    both: (u8, String),
    wrapped: Wrapped,
    kinds: Vec<Kind>,
    tagged: Tagged,
    either: Either,
    by_number: BTreeMap<u8, bool>,
    by_kind: BTreeMap<Plain, i64>,
    positive: Positive,
    any: Value,
    #[serde(default)]
    rest: Vec<Flattened>,
}

#[derive(Debug, PartialEq, Deserialize)]
struct Wrapped(f32);

#[derive(Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
enum Plain {
    One,
    Other,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
enum Kind {
    Unit,
    New(f32),
    Tuple(u8, u8),
    Struct { width: f32, deep: Option<Box<Kind>> },
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(tag = "is")]
enum Tagged {
    Round { radius: f32 },
    Flat,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(untagged)]
enum Either {
    Number(f32),
    Text(String),
}

#[derive(Debug, PartialEq, Deserialize)]
struct Flattened {
    own: u8,
    #[serde(flatten)]
    others: BTreeMap<String, u8>,
}

#[derive(Debug, PartialEq, Deserialize)]
#[serde(try_from = "f32")]
struct Positive(f32);

impl TryFrom<f32> for Positive {
    type Error = String;

    fn try_from(number: f32) -> Result<Self, String> {
        if number > 0.0 { Ok(Self(number)) } else { Err(format!("{number} is not positive")) }
    }
}

fn whole() -> Value {
    json!({
        "name": "a \"b\" \u{e9}\n", "count": 7, "small": -3, "share": 0.1, "exact": 0.1, "is_on": true, "letter": "x", "nothing": null,
        "maybe": null, "pair": [1, 2.5], "both": [1, "two"], "wrapped": 3, "positive": 2,
        "kinds": ["unit", { "unit": null }, { "new": 1 }, { "tuple": [1, 2] }, { "struct": { "width": 1, "deep": { "new": 2 } } }],
        "tagged": { "is": "Round", "radius": 1.5 }, "either": "text", "by_number": { "1": true, "2": false },
        "by_kind": { "One": -1, "Other": 1 }, "any": { "list": [1, -1, 1.5, null, "x", { "deep": [] }] },
        "rest": [{ "own": 1, "a": 2, "b": 3 }],
    })
}

/// What `serde_json` reads, or its message and the path.
fn by_serde_json(text: &str) -> Result<Whole, (String, String)> {
    let mut reader = serde_json::Deserializer::from_str(text);
    serde_path_to_error::deserialize(&mut reader)
        .map_err(|error| (error.path().to_string(), plainer(without_place(&error.inner().to_string()))))
}

/// What it says of a number that is too large for an `f32` is said in other words.
fn plainer(message: &str) -> String {
    message.replace(
        "number out of range",
        "expected a number that fits single precision (at most 3.4e38), found a larger one",
    )
}

fn of_a_value(text: &str) -> Option<String> {
    Some(serde_json::from_value::<Whole>(serde_json::from_str(text).ok()?).err()?.to_string())
}

fn check(text: &str) -> Result<(), TestCaseError> {
    let theirs = by_serde_json(text);
    let ours = from_str::<Whole>(text);
    if ours.as_ref().is_err_and(|error| error.message.starts_with("invalid type: sequence, expected struct")) {
        // It reads the fields of an object from a list, if there are enough.
        return Ok(());
    }
    // A key that is no text has no name there.
    let is_named = !theirs.as_ref().is_err_and(|(path, _)| path.ends_with('?'));
    // What it says of a value says more of what is no variant, and of a list that is too long.
    let says_more = ["expected string or map", "expected map with a single key", "expected fewer elements in array"];
    let theirs = match (&ours, theirs) {
        (Err(error), Err((path, _))) if says_more.iter().any(|end| error.message.ends_with(end)) => {
            Err((path, of_a_value(text).unwrap_or_default()))
        }
        (_, theirs) => theirs,
    };
    let path = |path: String| match path.rsplit_once('.') {
        Some((around, _)) if !is_named => format!("{around}.?"),
        _ => path,
    };
    let ours = ours.map_err(|error| (path(error.path), error.message));
    prop_assert_eq!(&ours, &theirs, "{}", text);
    Ok(())
}

/// Each place in a value: a pointer of RFC 6901.
fn places(value: &Value, place: &str, found: &mut Vec<String>) {
    found.push(place.to_owned());
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(key, value)| places(value, &format!("{place}/{key}"), found));
        }
        Value::Array(items) => {
            items.iter().enumerate().for_each(|(i, value)| places(value, &format!("{place}/{i}"), found));
        }
        _ => {}
    }
}

#[test]
fn a_whole_value_is_read() -> Outcome {
    let read: Whole = from_str(&whole().to_string())?;
    assert_eq!(read, serde_json::from_value(whole())?);
    assert_eq!(from_slice::<Whole>(serde_json::to_string_pretty(&whole())?.as_bytes())?, read);
    assert_eq!(field_path::from_value::<Whole>(&whole())?, read);
    Ok(())
}

/// What is put in the place of each part of the whole.
fn wrongs() -> Vec<Value> {
    vec![
        json!(null),
        json!(true),
        json!(-1),
        json!(300),
        json!(2.5),
        json!(1e39),
        json!("text"),
        json!("unit"),
        json!("struct"),
        json!([]),
        json!([1, 2, 3]),
        json!({}),
        json!({ "new": 1 }),
        json!({ "new": "x" }),
        json!({ "new": 1, "unit": null }),
        json!({ "tuple": [1, 2, 3] }),
        json!({ "struct": { "width": "wide" } }),
        json!({ "unknown": 1 }),
        json!({ "is": "Flat" }),
        json!({ "is": "Round", "radius": [] }),
        json!({ "own": 1, "a": 300 }),
    ]
}

#[test]
fn each_place_with_each_wrong_value_gives_the_same() -> Result<(), TestCaseError> {
    let whole = whole();
    let mut all = Vec::new();
    places(&whole, "", &mut all);
    for place in &all {
        for wrong in wrongs() {
            let mut spoilt = whole.clone();
            *spoilt.pointer_mut(place).expect("it is one of its places") = wrong;
            check(&spoilt.to_string())?;
        }
    }
    for field in whole.as_object().expect("an object").keys() {
        let mut spoilt = whole.clone();
        spoilt.as_object_mut().expect("an object").remove(field);
        check(&spoilt.to_string())?;
        spoilt["unheard-of"] = json!(1);
        check(&spoilt.to_string())?;
        // Twice the same key.
        let text = whole.to_string();
        check(&format!("{{\"{field}\":{},{}", whole[field], &text[1..]))?;
    }
    Ok(())
}

proptest! {
    #[test]
    fn numbers_are_rounded_as_serde_json_rounds_them(bits in any::<u64>(), single in any::<u32>(), whole_number in any::<i64>()) {
        let texts = [f64::from_bits(bits).to_string(), f32::from_bits(single).to_string(), whole_number.to_string()];
        for text in texts.iter().map(String::as_str).chain(["-0", "-0.0", "1e400", "7.038531e-26", "18446744073709551616", "1E3"]) {
            let bits = |value: Result<f32, String>| value.map(f32::to_bits);
            let ours = from_str::<f32>(text).map_err(|error| error.message);
            let theirs = serde_json::from_str::<f32>(text).map_err(|error| plainer(without_place(&error.to_string())));
            prop_assert_eq!(bits(ours), bits(theirs), "{}", text);
            let ours = from_str::<f64>(text).map_err(|error| error.message).map(f64::to_bits);
            let theirs = serde_json::from_str::<f64>(text).map_err(|error| without_place(&error.to_string()).to_owned());
            prop_assert_eq!(ours, theirs.map(f64::to_bits), "{}", text);
            let ours = from_str::<i64>(text).map_err(|error| error.message);
            let theirs = serde_json::from_str::<i64>(text).map_err(|error| without_place(&error.to_string()).to_owned());
            prop_assert_eq!(ours, theirs, "{}", text);
        }
    }

    #[test]
    fn no_text_makes_it_panic(text in "[\\[\\]{}\":,0-9a-z\\\\. -]{0,40}", bytes in prop::collection::vec(any::<u8>(), 0..40)) {
        prop_assert_eq!(from_str::<Value>(&text).is_ok(), serde_json::from_str::<Value>(&text).is_ok(), "{}", text);
        prop_assert_eq!(from_slice::<Value>(&bytes).is_ok(), serde_json::from_slice::<Value>(&bytes).is_ok());
    }
}

#[test]
fn a_fault_has_the_line_and_column_of_its_value() {
    let text = "{\n  \"name\": \"x\",\n  \"maybe\":   \"far\"\n}";
    let error = from_str::<Whole>(text).expect_err("a text is no number");
    assert_eq!((error.path.as_str(), error.line, error.column, error.is_syntax), ("maybe", 3, 14, false));
    let error = from_str::<Whole>("{\n  \"name\": \"x\",\n  \"oops\" 1 }").expect_err("no colon");
    assert_eq!((error.line, error.column, error.is_syntax), (3, 10, true));
    assert_eq!(error.message, "expected `:`");
    let error = from_str::<Whole>(" \n 7").expect_err("a number");
    assert_eq!((error.path.as_str(), error.line, error.column), (".", 2, 2));
    let error = from_slice::<Whole>(b"{\"name\": \"\xff\"}").expect_err("no UTF-8");
    assert!(error.is_syntax && error.message.contains("unicode"), "{error}");
}

#[test]
fn what_is_nested_too_deep_is_an_error() {
    for deep in [127, 128, 129, 100_000] {
        let text = format!("{}{}", "[".repeat(deep), "]".repeat(deep));
        assert_eq!(from_str::<Value>(&text).is_ok(), serde_json::from_str::<Value>(&text).is_ok(), "{deep} deep");
    }
}
