//! The JSON Schema of the creature file.

use serde_json::Value;

use crate::Creature;

/// The JSON Schema (draft 2020-12) of the creature file, derived from [`Creature`]. The same text is kept as
/// `schema/creature.schema.json`, for editors that complete and check creature files while they are written.
///
/// It says what a file may look like; what only makes sense as a whole (names that joints refer to, limits in order)
/// is for [`Blueprint::new`](crate::Blueprint::new) to check.
pub fn json_schema() -> String {
    let mut schema = schemars::schema_for!(Creature).to_value();
    tidy(&mut schema);
    format!("{schema:#}\n")
}

/// Makes descriptions that were written for Rust's documentation readable in an editor, and numbers that were single
/// precision as short as they were.
fn tidy(value: &mut Value) {
    match value {
        Value::Object(map) => {
            for (key, inner) in map.iter_mut() {
                match inner {
                    Value::String(text) if key == "description" => *text = plain(text),
                    Value::Number(number) if key == "default" => {
                        let short = number.as_f64().and_then(|wide| (wide as f32).to_string().parse::<f64>().ok());
                        *inner = short.map_or(Value::Null, Value::from);
                    }
                    _ => tidy(inner),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(tidy),
        _ => {}
    }
}

/// The text without links and without line breaks inside its paragraphs.
fn plain(text: &str) -> String {
    let paragraphs: Vec<String> = text.split("\n\n").map(|paragraph| paragraph.replace('\n', " ")).collect();
    let text = paragraphs.join("\n\n");
    let mut pieces = text.split("](");
    let mut plain = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        // The link's text ends `plain`, its target starts `piece`.
        if let Some(bracket) = plain.rfind('[') {
            plain.remove(bracket);
        }
        plain.push_str(piece.split_once(')').map_or(piece, |(_, rest)| rest));
    }
    plain
}
