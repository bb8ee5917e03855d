//! Names that are allowed, and guessing which name was meant.

use crate::bounds::LONGEST_NAME;

/// Names less alike than this are not offered.
const LEAST_LIKENESS: f64 = 0.45;

/// Whether nothing in a name can be read as a path or an option: 1 to 64 letters, digits, spaces, `-`, `_` or `.`, a letter or digit
/// first. Names of creatures are such names.
pub fn is_file_name(name: &str) -> bool {
    let first_fits = name.chars().next().is_some_and(char::is_alphanumeric);
    let all_fit = name.chars().all(|c| c.is_alphanumeric() || " -_.".contains(c));
    first_fits && all_fit && name.chars().count() <= LONGEST_NAME
}

/// The candidate most like `name`, if any is like it at all; of equals the first. Case does not count.
pub(crate) fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let name = shortened(name).to_lowercase();
    let mut best: Option<(f64, &str)> = None;
    for candidate in candidates {
        let likeness = strsim::normalized_damerau_levenshtein(&name, &shortened(candidate).to_lowercase());
        if likeness >= LEAST_LIKENESS && best.is_none_or(|(most, _)| likeness > most) {
            best = Some((likeness, candidate));
        }
    }
    best.map(|(_, candidate)| candidate.to_owned())
}

/// The guess as the end of a sentence, or nothing.
pub(crate) fn did_you_mean(nearest: &Option<String>) -> String {
    nearest.as_ref().map(|name| format!("; did you mean `{name}`?")).unwrap_or_default()
}

/// The start of a text that came from a file: enough to recognise it.
pub(crate) fn shortened(text: &str) -> String {
    const LONGEST: usize = 80;
    let mut short: String = text.chars().take(LONGEST).collect();
    if short.len() < text.len() {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_the_likeliest_or_none() {
        let names = ["joint-angles", "joint-speeds", "clock"];
        assert_eq!(nearest("joint-angels", names), Some("joint-angles".to_owned()));
        assert_eq!(nearest("Clok", names), Some("clock".to_owned()));
        assert_eq!(nearest("xyz", names), None);
    }

    #[test]
    fn copes_with_very_long_names() {
        assert_eq!(nearest(&"é".repeat(100_000), ["clock"]), None);
    }
}
