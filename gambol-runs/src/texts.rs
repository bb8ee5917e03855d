//! Texts for other programs: what a shell and a spreadsheet make of a name that somebody else chose.

use std::{borrow::Cow, path::Path};

/// A path as a word of a command line for a POSIX shell: quoted where it must be, and never taken for an option.
pub fn shell_word(path: &Path) -> String {
    let text = path.display().to_string();
    let text = if text.starts_with('-') { format!("./{text}") } else { text };
    // A path has no zero byte, the one thing that cannot be quoted.
    shlex::try_quote(&text).map(Cow::into_owned).unwrap_or_default()
}

/// A text as a cell of CSV: quoted where it must be, and never a formula.
pub fn csv_cell(text: &str) -> String {
    let text = literal(text);
    if text.contains([',', '"', '\n', '\r']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.into_owned() }
}

/// A text that spreadsheets take for one: they compute what begins with `=`, `+`, `-` or `@`, unless an apostrophe is before
/// it.
pub(crate) fn literal(text: &str) -> Cow<'_, str> {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r']) {
        Cow::Owned(format!("'{text}"))
    } else {
        Cow::Borrowed(text)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_shell_sees_one_word() {
        assert_eq!(shell_word(Path::new("runs/biped-1-running")), "runs/biped-1-running");
        assert_eq!(shell_word(Path::new("my runs")), "'my runs'");
        assert_eq!(shell_word(Path::new("-rf")), "./-rf");
        for path in ["$(touch x)", "a'b", "a\"b`c`", "a;b", "a\nb", "*"] {
            assert_eq!(shlex::split(&shell_word(Path::new(path))), Some(vec![path.to_owned()]));
        }
    }

    #[test]
    fn a_spreadsheet_computes_nothing() {
        assert_eq!(csv_cell("leg"), "leg");
        assert_eq!(csv_cell("=1+1"), "'=1+1");
        assert_eq!(csv_cell("=HYPERLINK(\"x\",1)"), "\"'=HYPERLINK(\"\"x\"\",1)\"");
        assert_eq!(csv_cell("a,b"), "\"a,b\"");
    }
}
