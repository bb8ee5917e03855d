//! What the program writes to the terminal. Texts from files are in it, so control characters are shown and not sent:
//! a creature's name cannot clear a screen or rename its window.

use std::{
    fmt::{self, Write as _},
    io::{self, Write as _},
};

/// Prints a line; a reader that went away (`| head`) is an error for `main`, not a panic.
macro_rules! say {
    ($($text:tt)*) => { $crate::commands::terminal::to_stdout(format_args!($($text)*)) };
}

/// Prints a line on standard error; one that cannot be written (`2>&1 | head -1`, a full disk) is lost, and ends nothing.
macro_rules! tell {
    ($($text:tt)*) => { $crate::commands::terminal::to_stderr(format_args!($($text)*)) };
}

pub(super) fn to_stdout(text: fmt::Arguments<'_>) -> io::Result<()> {
    let written = io::stdout().lock().write_all(line(text).as_bytes());
    written.map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => error,
        kind => io::Error::new(kind, format!("cannot write to standard output: {error}")),
    })
}

pub(super) fn to_stderr(text: fmt::Arguments<'_>) {
    let _ = io::stderr().lock().write_all(line(text).as_bytes());
}

/// A text without control characters, but for the ends of its lines: `\u001b` stands for an escape, as in JSON.
pub(super) fn printable(text: &str) -> String {
    let mut clean = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '\n' | '\t' => clean.push(character),
            _ if character.is_control() || overrides_direction(character) => {
                // Writing to a string cannot fail.
                let _ = write!(clean, "\\u{:04x}", u32::from(character));
            }
            _ => clean.push(character),
        }
    }
    clean
}

fn line(text: fmt::Arguments<'_>) -> String {
    let mut line = printable(&text.to_string());
    line.push('\n');
    line
}

/// Characters that make a terminal show a text in another order than it has.
fn overrides_direction(character: char) -> bool {
    matches!(character, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::printable;

    #[test]
    fn control_characters_are_shown_and_lines_are_kept() {
        assert_eq!(printable("a\u{1b}[2Jb\r\u{9b}\u{7f}\n\tü"), "a\\u001b[2Jb\\u000d\\u009b\\u007f\n\tü");
        assert_eq!(printable("a\u{202e}b"), "a\\u202eb");
    }

    #[test]
    fn a_line_of_json_stays_json() -> Result<(), serde_json::Error> {
        let text = "\u{1b}]0;title\u{7}\u{9b}2J\u{202e}".to_owned();
        let printed = printable(&serde_json::to_string(&text)?);
        assert!(!printed.contains(char::is_control));
        assert_eq!(serde_json::from_str::<String>(&printed)?, text);
        Ok(())
    }
}
