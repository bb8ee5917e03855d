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
    tidy_schema(&mut schema);
    format!("{schema:#}\n")
}

/// Makes a schema readable that was derived from Rust: descriptions that were written for its documentation, and numbers
/// that were single precision, as short as they were.
pub fn tidy_schema(schema: &mut Value) {
    match schema {
        Value::Object(map) => {
            for (key, inner) in map.iter_mut() {
                match inner {
                    Value::String(text) if key == "description" => *text = plain(text),
                    _ => tidy_schema(inner),
                }
            }
        }
        Value::Array(list) => list.iter_mut().for_each(tidy_schema),
        Value::Number(number) if number.is_f64() => {
            let single =
                number.as_f64().map(|wide| (wide, wide as f32)).filter(|&(wide, short)| f64::from(short) == wide);
            if let Some(short) = single.and_then(|(_, short)| short.to_string().parse::<f64>().ok()) {
                *schema = Value::from(short);
            }
        }
        _ => {}
    }
}

/// The text without links, without examples in Rust and without line breaks inside its paragraphs.
fn plain(text: &str) -> String {
    let mut paragraphs: Vec<String> = Vec::new();
    let mut begins = true;
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if let Some(language) = line.strip_prefix("```") {
            let block: Vec<&str> = lines.by_ref().take_while(|line| !line.starts_with("```")).collect();
            if !language.is_empty() {
                paragraphs.push(block.join("\n"));
            }
            begins = true;
        } else if line.trim().is_empty() {
            begins = true;
        } else if let Some(heading) = line.strip_prefix("# ") {
            paragraphs.push(without_links(heading));
            begins = true;
        } else {
            match paragraphs.last_mut().filter(|_| !begins) {
                None => paragraphs.push(line.trim().to_owned()),
                // An item of a list stays on a line of its own.
                Some(paragraph) if line.starts_with("- ") => *paragraph = format!("{paragraph}\n{line}"),
                Some(paragraph) => *paragraph = format!("{paragraph} {}", line.trim()),
            }
            begins = false;
        }
    }
    without_links(&paragraphs.join("\n\n"))
}

/// The text with what links show in their place: `[text](target)` is `text`, and ``[`name`]`` is `` `name` ``.
fn without_links(text: &str) -> String {
    let mut pieces = text.split("](");
    let mut plain = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        // The link's text ends `plain`, its target starts `piece`.
        if let Some(bracket) = plain.rfind('[') {
            plain.remove(bracket);
        }
        plain.push_str(end_of_target(piece).map_or(piece, |end| &piece[end..]));
    }
    let mut pieces = plain.split("[`");
    let mut named = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        named.push('`');
        match piece.split_once('`').filter(|(_, rest)| rest.starts_with(']')) {
            Some((name, rest)) => named.extend([name, "`", &rest[1..]]),
            None => {
                named.insert(named.len() - 1, '[');
                named.push_str(piece);
            }
        }
    }
    named
}

/// Behind the parenthesis that closes the one before this text.
fn end_of_target(text: &str) -> Option<usize> {
    let mut open = 1;
    for (index, letter) in text.char_indices() {
        match letter {
            '(' => open += 1,
            ')' => open -= 1,
            _ => {}
        }
        if open == 0 {
            return Some(index + 1);
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn descriptions_are_read_without_rust() {
        for (written, read) in [
            ("One\nline.\n\nAnother.", "One line.\n\nAnother."),
            (
                "A [`Look`], a [`name`](Self::name) and the [bumps](crate::bumps()) on it.",
                "A `Look`, a `name` and the bumps on it.",
            ),
            ("In [`minimum`, `maximum`], or [0, 1].", "In [`minimum`, `maximum`], or [0, 1]."),
            ("Of two kinds:\n- one\n  and more\n- two", "Of two kinds:\n- one and more\n- two"),
            (
                "# Order\nThis.\n\n```\nlet a = 1;\n\nlet b = 2;\n```\nAnd:\n```json\n{\n}\n```",
                "Order\n\nThis.\n\nAnd:\n\n{\n}",
            ),
        ] {
            assert_eq!(plain(written), read);
        }
    }

    #[test]
    fn single_precision_is_short() {
        let mut schema = serde_json::json!({ "default": [f64::from(0.1_f32), 0.1, 3], "minimum": 1e-9 });
        tidy_schema(&mut schema);
        assert_eq!(schema.to_string(), r#"{"default":[0.1,0.1,3],"minimum":1e-9}"#);
    }
}
