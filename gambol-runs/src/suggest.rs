//! "Did you mean ...?"

use ne_core::field_path;

/// The candidate most like `name`, if any is like it at all.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    candidates
        .into_iter()
        .map(|candidate| (strsim::jaro_winkler(&name.to_lowercase(), &candidate.to_lowercase()), candidate))
        .filter(|(likeness, _)| *likeness > 0.75)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, candidate)| candidate)
}

/// A list of names with the nearest one first said: `there is no creature "bipde-1"; did you mean "biped-1"?`
pub fn unknown(kind: &str, name: &str, known: &[&str]) -> String {
    let hint = nearest(name, known.iter().copied())
        .map_or_else(String::new, |nearest| format!("; did you mean \"{nearest}\"?"));
    let known = if known.is_empty() { "none".into() } else { known.join(", ") };
    format!("there is no {kind} \"{name}\"{hint} (there are: {known})")
}

/// Adds the nearest valid name to serde's "unknown field `x`, expected one of `a`, `b`".
pub(crate) fn explain(message: &str) -> String {
    let message = field_path::without_place(message);
    let mut quoted = message.split('`').skip(1).step_by(2);
    match quoted.next() {
        Some(name) if message.starts_with("unknown") => match nearest(name, quoted) {
            Some(nearest) => format!("{message}; did you mean `{nearest}`?"),
            None => message.to_owned(),
        },
        _ => message.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_nearest_name_and_none_for_nonsense() {
        assert_eq!(nearest("bipde-1", ["apod", "biped-1", "tetrapod-1"]), Some("biped-1"));
        assert_eq!(nearest("qqq", ["apod", "biped-1"]), None);
        assert_eq!(
            explain("unknown field `popultion`, expected one of `population`, `elites`"),
            "unknown field `popultion`, expected one of `population`, `elites`; did you mean `population`?"
        );
    }
}
