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

pub use crate::whole_file::{
    check_replaceable, is_temporary, make_folder, write_whole, write_whole_together, write_whole_with,
};
use crate::{
    bounded_read::{self, LARGEST_DATA},
    digest::JsonDigest,
    field_path::without_place,
};
use serde::{
    Deserialize, Deserializer, Serialize,
    de::{DeserializeOwned, IgnoredAny, MapAccess, SeqAccess, Visitor},
};
use serde_json::Value;
use std::{
    fmt,
    io::{self, BufReader, BufWriter, Read, Seek, SeekFrom, Write},
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

/// What stands in the place of the digest until it is known.
const NO_DIGEST: &str = "................";

/// Writes `content` to `path`, whole or not at all. The memory it takes does not grow with the content.
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
    let envelope = Envelope { format: format.into(), version, digest: NO_DIGEST.into(), content };
    write_whole_with(path, |file| {
        let mut text = BufWriter::new(&mut *file);
        match layout {
            Layout::Compact => serde_json::to_writer(&mut text, &envelope),
            Layout::Pretty => serde_json::to_writer_pretty(&mut text, &envelope),
        }?;
        text.write_all(b"\n")?;
        text.flush()?;
        drop(text);
        if file.stream_position()? > LARGEST_DATA {
            let message = "it would have more than 4096 MiB, and could not be read again";
            return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
        }
        // The digest is that of what a reader will see: an f32 as its shortest decimal.
        file.rewind()?;
        let header = read_header(&mut serde_json::Deserializer::from_reader(BufReader::new(&mut *file)))?;
        let mut beginning = [0; 256];
        file.rewind()?;
        let length = file.read(&mut beginning)?;
        let place = beginning[..length].windows(NO_DIGEST.len()).position(|bytes| bytes == NO_DIGEST.as_bytes());
        let missing = || io::Error::other("the name of a format is too long");
        let (place, digest) = place.zip(header.found).ok_or_else(missing)?;
        file.seek(SeekFrom::Start(place as u64))?;
        file.write_all(digest.as_bytes())
    })
    .map_err(|source| ArchiveError::Write { path: path.into(), source })
}

/// Reads the content of the file at `path`.
///
/// # Errors
/// Any variant but `Write`; see [`ArchiveError`].
pub fn read<C: DeserializeOwned>(path: &Path, format: &str, version: u32) -> Result<C, ArchiveError> {
    parse(path, &bytes_of(path)?, format, version)
}

/// Reads what a file has in it, from memory. `path`: what the file is called in an error.
///
/// # Errors
/// Any variant but `Read` and `Write`; see [`ArchiveError`].
pub fn parse<C: DeserializeOwned>(path: &Path, bytes: &[u8], format: &str, version: u32) -> Result<C, ArchiveError> {
    let (content, digests) = parse_content(path, bytes, format, version)?;
    content.and_then(|content| match digests.expected == digests.found {
        true => Ok(content),
        false => Err(digests.damaged(path)),
    })
}

/// The digest a file carries and the one its content has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Digests {
    /// What the file says.
    pub expected: String,
    /// What the content has.
    pub found: String,
}

impl Digests {
    fn damaged(self, path: &Path) -> ArchiveError {
        ArchiveError::Damaged { path: path.into(), expected: self.expected, found: self.found }
    }
}

/// Reads a file whose content may have been changed by hand, for tools that want to look at it all the same.
///
/// # Errors
/// As [`read`], without `Damaged`; `Content` only if a field around the content is missing or wrong.
pub fn read_unverified(path: &Path, format: &str, version: u32) -> Result<(Value, Digests), ArchiveError> {
    let (content, digests) = parse_content(path, &bytes_of(path)?, format, version)?;
    Ok((content?, digests))
}

/// As bytes: should they not be UTF-8, the parser says where.
fn bytes_of(path: &Path) -> Result<Vec<u8>, ArchiveError> {
    bounded_read::read(path, LARGEST_DATA).map_err(|source| ArchiveError::Read { path: path.into(), source })
}

/// The content, or what is wrong with it, and the digests; an error if there is something wrong around it.
fn parse_content<C: DeserializeOwned>(
    path: &Path,
    bytes: &[u8],
    format: &str,
    version: u32,
) -> Result<(Result<C, ArchiveError>, Digests), ArchiveError> {
    let mut reader = serde_json::Deserializer::from_slice(bytes);
    let header = read_header(&mut reader).and_then(|header| reader.end().map(|()| header));
    let header = header.map_err(|error| malformed(path, &error))?;
    if header.format.as_str() != Some(format) {
        let found = header.format.as_str().unwrap_or("unknown").to_owned();
        return Err(ArchiveError::Format { path: path.into(), found, expected: format.into() });
    }
    // The version comes before the rest: a future version may look quite different.
    if let Some(found) = header.version.as_u64().filter(|&found| found != u64::from(version)) {
        let found = u32::try_from(found).unwrap_or(u32::MAX);
        return Err(ArchiveError::Version { path: path.into(), found, supported: version });
    }
    let envelope: Envelope<IgnoredAny> = parsed(path, bytes)?;
    let digests = Digests { expected: envelope.digest, found: header.found.unwrap_or_default() };
    if digests.expected != digests.found {
        // What was changed is more telling than what it was changed to.
        let content = parsed::<Envelope<C>>(path, bytes).map(|envelope| envelope.content);
        return Ok((content.map_err(|_| digests.clone().damaged(path)), digests));
    }
    Ok((parsed::<Envelope<C>>(path, bytes).map(|envelope| envelope.content), digests))
}

/// What can be known of a file before its content is understood.
#[derive(Default)]
struct Header {
    format: Value,
    version: Value,
    /// The digest that the content has.
    found: Option<String>,
}

fn read_header<'de>(reader: impl Deserializer<'de, Error = serde_json::Error>) -> Result<Header, serde_json::Error> {
    struct Fields;
    impl<'de> Visitor<'de> for Fields {
        type Value = Header;

        fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
            f.write_str("an object")
        }

        fn visit_map<A: MapAccess<'de>>(self, mut fields: A) -> Result<Header, A::Error> {
            let mut header = Header::default();
            while let Some(name) = fields.next_key::<String>()? {
                match name.as_str() {
                    "format" => header.format = fields.next_value()?,
                    "version" => header.version = fields.next_value()?,
                    "content" => header.found = Some(fields.next_value_seed(JsonDigest)?.to_string()),
                    _ => drop(fields.next_value::<IgnoredAny>()?),
                }
            }
            Ok(header)
        }

        fn visit_seq<A: SeqAccess<'de>>(self, mut items: A) -> Result<Header, A::Error> {
            while items.next_element::<IgnoredAny>()?.is_some() {}
            Ok(Header::default())
        }
    }
    reader.deserialize_any(Fields)
}

/// Turns the content of the file at `path` into its type.
///
/// # Errors
/// [`ArchiveError::Content`], which names the field.
pub fn content<C: DeserializeOwned>(path: &Path, content: Value) -> Result<C, ArchiveError> {
    // Through text once more: a `Value` holds numbers as f64, and rounding twice, to f64 and then to f32, is not always
    // rounding once (7.038531e-26 is the one f32 whose shortest decimal tells the difference).
    parsed(path, content.to_string().as_bytes())
}

fn parsed<T: DeserializeOwned>(path: &Path, text: &[u8]) -> Result<T, ArchiveError> {
    field_path::from_slice(text).map_err(|error| {
        let field = match error.path.as_str() {
            "." => "content",
            field => field.strip_prefix("content.").unwrap_or(field),
        };
        // The field says where, in whatever layout.
        let message = format!("field {field}: {}", error.message);
        ArchiveError::Content { path: path.into(), message }
    })
}

fn malformed(path: &Path, error: &serde_json::Error) -> ArchiveError {
    let (line, column) = (error.line(), error.column());
    ArchiveError::Malformed { path: path.into(), line, column, message: without_place(&error.to_string()).to_owned() }
}
