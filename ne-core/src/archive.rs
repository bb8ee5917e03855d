//! Files that are written whole or not at all, and say what they are.
//!
//! Every file a run leaves behind for later (checkpoints, champions) is one JSON object:
//!
//! ```json
//! { "format": "gambol checkpoint", "version": 1, "digest": "…16 hex digits…", "content": { } }
//! ```
//!
//! The digest is over the content's values, so white space may change and nothing else. A file is written to a
//! temporary file beside it, flushed to the disk and renamed: whatever happens meanwhile, the old or the new file is
//! there, whole.

use crate::{
    bounded_read::{self, LARGEST_DATA},
    digest::Digest,
};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use serde_json::Value;
use std::{
    io::{self, Write},
    path::{Path, PathBuf},
};

/// What can be wrong with a file. Every variant names the file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ArchiveError {
    /// The operating system would not let us read it.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The operating system would not let us write it; what was there before still is.
    #[error("cannot write {}: {source}", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// It is not JSON: truncated, or something else altogether.
    #[error("{} is damaged or not a file of Gambol: line {line}, column {column}: {message}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// Line of the first error, from 1.
        line: usize,
        /// Column of the first error, from 1.
        column: usize,
        /// What the parser says.
        message: String,
    },
    /// It is another kind of file.
    #[error("{} is a \"{found}\" file, expected a \"{expected}\" file", path.display())]
    Format {
        /// The file.
        path: PathBuf,
        /// The format it says it has.
        found: String,
        /// The format wanted.
        expected: String,
    },
    /// It was written by another version.
    #[error(
        "{} has version {found}, this Gambol reads version {supported}; {}", path.display(),
        if found > supported { "use a newer Gambol" } else { "use the Gambol that wrote it" }
    )]
    Version {
        /// The file.
        path: PathBuf,
        /// The version it says it has.
        found: u32,
        /// The version this code reads.
        supported: u32,
    },
    /// The content is not what was written.
    #[error("{} was changed after it was written: field \"content\" has digest {found}, \"digest\" says {expected}", path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// The digest in the file.
        expected: String,
        /// The digest of the content.
        found: String,
    },
    /// A field of the content is not as it should be.
    #[error("{}: {message}", path.display())]
    Content {
        /// The file.
        path: PathBuf,
        /// Which field, and what is wrong.
        message: String,
    },
}

/// How the content is laid out in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// No white space.
    Compact,
    /// One value a line, for files that people look into.
    Pretty,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Envelope<C> {
    format: String,
    version: u32,
    digest: String,
    content: C,
}

/// Writes `content` to `path`, whole or not at all.
///
/// # Errors
/// [`ArchiveError::Write`] if the folder does not exist, is not writable, or the disk is full.
pub fn write(
    path: &Path,
    format: &str,
    version: u32,
    content: &impl Serialize,
    layout: Layout,
) -> Result<(), ArchiveError> {
    // Through text, because a reader will see the numbers as text has them: an f32 as its shortest decimal.
    let failed = |source: serde_json::Error| ArchiveError::Write { path: path.into(), source: source.into() };
    let content: Value = serde_json::from_str(&serde_json::to_string(content).map_err(failed)?).map_err(failed)?;
    let digest = Digest::of_json(&content).to_string();
    let envelope = Envelope { format: format.into(), version, digest, content };
    let mut text = match layout {
        Layout::Compact => serde_json::to_string(&envelope),
        Layout::Pretty => serde_json::to_string_pretty(&envelope),
    }
    .map_err(failed)?;
    text.push('\n');
    write_whole(path, text.as_bytes()).map_err(|source| ArchiveError::Write { path: path.into(), source })
}

/// Reads the content of the file at `path`.
///
/// # Errors
/// Any variant but `Write`; see [`ArchiveError`].
pub fn read<C: DeserializeOwned>(path: &Path, format: &str, version: u32) -> Result<C, ArchiveError> {
    let (value, digests) = read_unverified(path, format, version)?;
    let Digests { expected, found } = digests;
    if expected != found {
        return Err(ArchiveError::Damaged { path: path.into(), expected, found });
    }
    content(path, value)
}

/// The digest a file carries and the one its content has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Digests {
    /// What the file says.
    pub expected: String,
    /// What the content has.
    pub found: String,
}

/// Reads a file whose content may have been changed by hand, for tools that want to look at it all the same.
///
/// # Errors
/// As [`read`], without `Damaged`; `Content` only if a field around the content is missing or wrong.
pub fn read_unverified(path: &Path, format: &str, version: u32) -> Result<(Value, Digests), ArchiveError> {
    // As bytes: should they not be UTF-8, the parser says where.
    let bytes =
        bounded_read::read(path, LARGEST_DATA).map_err(|source| ArchiveError::Read { path: path.into(), source })?;
    let value: Value = serde_json::from_slice(&bytes).map_err(|error| malformed(path, &error))?;
    let header = |field: &str| value.get(field);
    let found_format = header("format").and_then(Value::as_str).unwrap_or("unknown").to_owned();
    if found_format != format {
        return Err(ArchiveError::Format { path: path.into(), found: found_format, expected: format.into() });
    }
    // The version comes before the rest: a future version may look quite different.
    if let Some(found) = header("version").and_then(Value::as_u64)
        && found != u64::from(version)
    {
        let found = u32::try_from(found).unwrap_or(u32::MAX);
        return Err(ArchiveError::Version { path: path.into(), found, supported: version });
    }
    let envelope: Envelope<Value> = content(path, value)?;
    let found = Digest::of_json(&envelope.content).to_string();
    Ok((envelope.content, Digests { expected: envelope.digest, found }))
}

/// Turns the content of the file at `path` into its type.
///
/// # Errors
/// [`ArchiveError::Content`], which names the field.
pub fn content<C: DeserializeOwned>(path: &Path, content: Value) -> Result<C, ArchiveError> {
    // Through text once more: a `Value` holds numbers as f64, and rounding twice, to f64 and then to f32, is not always
    // rounding once (7.038531e-26 is the one f32 whose shortest decimal tells the difference).
    let text = content.to_string();
    let mut reader = serde_json::Deserializer::from_str(&text);
    serde_path_to_error::deserialize(&mut reader).map_err(|error| {
        let field = match error.path().to_string() {
            top if top == "." => "content".to_owned(),
            field => field,
        };
        // Line and column are those of our text, not of the file: the field says where.
        ArchiveError::Content { path: path.into(), message: format!("field {field}: {}", without_place(error.inner())) }
    })
}

fn malformed(path: &Path, error: &serde_json::Error) -> ArchiveError {
    let (line, column) = (error.line(), error.column());
    ArchiveError::Malformed { path: path.into(), line, column, message: without_place(error) }
}

/// What the parser says, without its "at line 1 column 2".
fn without_place(error: &serde_json::Error) -> String {
    let full = error.to_string();
    full.rsplit_once(" at line ").map_or(full.as_str(), |(message, _)| message).to_owned()
}

/// Writes bytes to a temporary file beside `path`, flushes it to the disk and renames it to `path`.
///
/// # Errors
/// Whatever the operating system says; the file at `path` is then as it was.
pub fn write_whole(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() => parent,
        _ => Path::new("."),
    };
    let mut builder = tempfile::Builder::new();
    builder.prefix(".gambol-").suffix(".tmp");
    // Temporary files are private by default; a result has the usual permissions (the umask still counts).
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    let mut file = builder.tempfile_in(folder)?;
    file.write_all(bytes)?;
    file.as_file().sync_all()?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}
