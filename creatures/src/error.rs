//! What can be wrong with a creature file as a whole.

use crate::Problem;
use crate::format::{FORMAT, VERSION};
use crate::names::did_you_mean;

/// Why a creature could not be read or used. Each message is whole and names the place; the file's name is the
/// caller's to add.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CreatureError {
    /// The text is not JSON.
    #[error("line {line}, column {column}: not valid JSON: {message}")]
    Syntax {
        /// Line of the fault, from 1.
        line: usize,
        /// Column of the fault, from 1; 0 at the end of a line before.
        column: usize,
        /// What the parser found.
        message: String,
    },
    /// It is JSON, but not a creature file.
    #[error("not a creature file: `format` must be \"{FORMAT}\", found {found}")]
    NotACreature {
        /// What stands there instead, shortened.
        found: String,
    },
    /// A version of the format that this crate does not know.
    #[error("{}", version_message(.found))]
    Version {
        /// The version the file claims, as written.
        found: String,
    },
    /// A field of the wrong kind, or one that is missing.
    #[error("{path} (line {line}, column {column}): {message}")]
    Field {
        /// Path of the field, such as `parts[2].shape.box.width`; of what it is missing from if it is missing.
        path: String,
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// What was found and what was expected.
        message: String,
    },
    /// A field, sensor, shape or form of decoration that does not exist.
    #[error(transparent)]
    UnknownName(Box<UnknownName>),
    /// The file is well formed, but the creature makes no sense. All problems found, never empty.
    #[error("{}", lines(.0))]
    Invalid(Vec<Problem>),
    /// A range to scale inputs to that is none.
    #[error("the input range must be from 0.001 to 1000, found {found}")]
    InputRange {
        /// The range asked for.
        found: f32,
    },
}

/// A name in a creature file that means nothing there.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{path} (line {line}, column {column}): unknown {what} `{found}`{} (valid: {})",
    did_you_mean(.nearest), .valid.join(", ")
)]
pub struct UnknownName {
    /// Path of the field.
    pub path: String,
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// What is named there: `field`, `sensor`, `shape` or `form`.
    pub what: &'static str,
    /// The unknown name, shortened.
    pub found: String,
    /// The valid name most like it.
    pub nearest: Option<String>,
    /// All valid names.
    pub valid: Vec<String>,
}

fn version_message(found: &str) -> String {
    match found.parse::<u64>() {
        Ok(version) if version > u64::from(VERSION) => format!(
            "version: this creature file is of version {version}, written by a newer Gambol; this one reads version \
             {VERSION}"
        ),
        _ => format!("version: must be {VERSION}, found {found}"),
    }
}

fn lines(problems: &[Problem]) -> String {
    let lines: Vec<String> = problems.iter().map(Problem::to_string).collect();
    lines.join("\n")
}
