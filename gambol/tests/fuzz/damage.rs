//! Damaging inputs: as bytes, as JSON, as lines with digests.

use ne_core::{RandomStream, digest::Digest};
use rand::RngExt;
use serde_json::{Map, Value, json};

/// No input is longer.
const LONGEST: usize = 256 * 1024;

/// An input made of `whole`, with pieces of `other`.
pub(crate) fn damaged(whole: &[u8], other: &[u8], has_lines: bool, chance: &mut RandomStream) -> Vec<u8> {
    let mut bytes = match has_lines {
        true if chance.random_bool(0.6) => damaged_lines(whole, other, chance),
        false if chance.random_bool(0.6) => damaged_json(whole, other, chance).unwrap_or_else(|| whole.to_vec()),
        _ => whole.to_vec(),
    };
    if bytes == whole || chance.random_bool(0.2) {
        for _ in 0..1 << chance.random_range(0..5) {
            damage_bytes(&mut bytes, other, chance);
        }
    }
    bytes.truncate(LONGEST);
    bytes
}

/// What parsers trip over.
const PIECES: [&str; 20] = [
    "\0", "\"", "\\u0000", "\\ud800", "{", "[", "}", "]", ",", ":", "null", "NaN", "-", "1e999", "-0", "\n", "\r\n",
    "\u{feff}", "=", "\"\"\"\"",
];

fn damage_bytes(bytes: &mut Vec<u8>, other: &[u8], chance: &mut RandomStream) {
    let at = chance.random_range(0..=bytes.len());
    let length = 1 << chance.random_range(0..10);
    let end = (at + chance.random_range(0..length)).min(bytes.len());
    match chance.random_range(0..8) {
        0 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte ^= 1 << chance.random_range(0..8)),
        1 => bytes.iter_mut().skip(at).take(1).for_each(|byte| *byte = chance.random()),
        2 => drop(bytes.drain(at..end)),
        3 => bytes.truncate(at),
        4 => {
            let copy = bytes[at..end].to_vec();
            let place = chance.random_range(0..=bytes.len());
            bytes.splice(place..place, copy);
        }
        5 => {
            let piece = PIECES[chance.random_range(0..PIECES.len())];
            bytes.splice(at..at, piece.bytes());
        }
        6 => {
            let from = chance.random_range(0..=other.len());
            let to = (from + length).min(other.len());
            bytes.splice(at..end, other[from..to].iter().copied());
        }
        _ => {
            // Numbers become other numbers.
            let digits =
                bytes.iter().enumerate().skip(at).find(|(_, byte)| byte.is_ascii_digit()).map(|(place, _)| place);
            digits.into_iter().for_each(|place| bytes[place] = b'0' + chance.random_range(0..10));
        }
    }
}

fn damaged_json(whole: &[u8], other: &[u8], chance: &mut RandomStream) -> Option<Vec<u8>> {
    let mut value: Value = serde_json::from_slice(whole).ok()?;
    let donor = serde_json::from_slice(other).unwrap_or_default();
    for _ in 0..1 << chance.random_range(0..4) {
        damage_value(&mut value, &donor, chance);
    }
    if chance.random_bool(0.9) {
        seal(&mut value);
    }
    Some(value.to_string().into_bytes())
}

/// Makes the digest of a file's envelope fit.
fn seal(value: &mut Value) {
    let Some(fields) = value.as_object_mut() else { return };
    if let Some(content) = fields.get("content") {
        let digest = Digest::of_json(content).to_string();
        fields.insert("digest".into(), digest.into());
    }
}

/// Changes something, deep in the value more often than not.
fn damage_value(value: &mut Value, donor: &Value, chance: &mut RandomStream) {
    let children = match &*value {
        Value::Array(items) => items.len(),
        Value::Object(fields) => fields.len(),
        _ => 0,
    };
    if children > 0 && chance.random_bool(0.85) {
        let which = chance.random_range(0..children);
        let child = match value {
            Value::Array(items) => items.get_mut(which),
            Value::Object(fields) => fields.values_mut().nth(which),
            _ => None,
        };
        return child.into_iter().for_each(|child| damage_value(child, donor, chance));
    }
    match value {
        Value::Array(items) if !items.is_empty() && chance.random_bool(0.8) => damage_list(items, chance),
        Value::Object(fields) if !fields.is_empty() && chance.random_bool(0.8) => damage_fields(fields, chance),
        _ if chance.random_bool(0.3) => *value = part_of(donor, chance),
        Value::Number(number) => *value = other_number(number.as_f64().unwrap_or(0.0), chance),
        _ => *value = anything(chance),
    }
}

fn damage_list(items: &mut Vec<Value>, chance: &mut RandomStream) {
    let (at, to) = (chance.random_range(0..items.len()), chance.random_range(0..items.len()));
    match chance.random_range(0..5) {
        0 => drop(items.remove(at)),
        1 => items.swap(at, to),
        2 => items.insert(to, items[at].clone()),
        3 => items.truncate(at),
        _ => {
            let copies = vec![items[at].clone(); chance.random_range(1..200)];
            if items[at].to_string().len() * copies.len() < LONGEST {
                items.extend(copies);
            }
        }
    }
}

fn damage_fields(fields: &mut Map<String, Value>, chance: &mut RandomStream) {
    let names: Vec<String> = fields.keys().cloned().collect();
    let (name, other) = (&names[chance.random_range(0..names.len())], &names[chance.random_range(0..names.len())]);
    match chance.random_range(0..4) {
        0 => drop(fields.remove(name)),
        1 => drop(fields.insert(format!("{name}s"), anything(chance))),
        2 => {
            let value = fields.remove(name).unwrap_or_default();
            fields.insert(other.clone(), value);
        }
        _ => drop(fields.insert(other.clone(), fields[name].clone())),
    }
}

/// A value from anywhere in another file.
fn part_of(donor: &Value, chance: &mut RandomStream) -> Value {
    let child = match donor {
        Value::Array(items) if !items.is_empty() => items.get(chance.random_range(0..items.len())),
        Value::Object(fields) if !fields.is_empty() => fields.values().nth(chance.random_range(0..fields.len())),
        _ => None,
    };
    match child {
        Some(child) if chance.random_bool(0.8) => part_of(child, chance),
        _ => donor.clone(),
    }
}

fn other_number(number: f64, chance: &mut RandomStream) -> Value {
    match chance.random_range(0..6) {
        0 => json!(-number),
        1 => json!(number + 1.0),
        2 => json!(number * 1e6),
        3 => json!((number as i64).saturating_add(1)),
        4 => json!((number as i64).saturating_sub(1)),
        _ => anything(chance),
    }
}

fn anything(chance: &mut RandomStream) -> Value {
    match chance.random_range(0..20) {
        0 => Value::Null,
        1 => json!(true),
        2 => json!(0),
        3 => json!(-1),
        4 => json!(u64::MAX),
        5 => json!(i64::MIN),
        6 => json!(f64::MAX),
        7 => json!(f64::MIN_POSITIVE),
        8 => json!(-0.0),
        9 => json!(1e39),
        10 => json!(u32::MAX),
        11 => json!(4096),
        12 => json!(1_000_000),
        13 => json!(""),
        14 => json!("\u{1b}[2J\0\u{202e}"),
        15 => json!("x".repeat(10_000)),
        16 => json!([]),
        17 => json!({}),
        18 => (0..120).fold(Value::Null, |inner, _| json!([inner])),
        _ => json!(chance.random_range(-1e3..1e3)),
    }
}

/// Lines that are damaged, moved and doubled, most of them with digests that fit.
fn damaged_lines(whole: &[u8], other: &[u8], chance: &mut RandomStream) -> Vec<u8> {
    let text = String::from_utf8_lossy(whole);
    let mut lines: Vec<Value> = text.lines().filter_map(|line| serde_json::from_str(line).ok()).collect();
    let donor = String::from_utf8_lossy(other);
    let donor = donor.lines().next().and_then(|line| serde_json::from_str(line).ok()).unwrap_or_default();
    if lines.is_empty() {
        return whole.to_vec();
    }
    for _ in 0..1 << chance.random_range(0..3) {
        let at = chance.random_range(0..lines.len());
        damage_value(&mut lines[at], &donor, chance);
    }
    if chance.random_bool(0.2) {
        damage_list(&mut lines, chance);
    }
    sealed(&lines)
}

/// Lines with their digests, as a run writes them.
fn sealed(lines: &[Value]) -> Vec<u8> {
    let (mut digest, mut text) = (Digest::default(), String::new());
    for line in lines {
        let mut line = line.clone();
        if let Some(fields) = line.as_object_mut() {
            fields.remove("digest");
        }
        let line = line.to_string();
        let fields = line.strip_suffix('}').unwrap_or(&line);
        digest.add(fields.as_bytes());
        text.push_str(&format!("{fields},\"digest\":\"{digest}\"}}\n"));
    }
    text.into_bytes()
}
