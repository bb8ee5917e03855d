//! Files of lines: a JSON object a line, appended while a run goes on.
//!
//! The last field of every line, `digest`, is that of the file up to there. So a flipped bit, a line lost in the middle and
//! a line out of place are found, and the first line that is wrong is named. That lines are missing at the end only a
//! checkpoint can tell; resuming asks it.

use crate::run_folder::FolderError;
use ne_core::{
    archive::{self, ArchiveError},
    bounded_read,
    digest::Digest,
    field_path,
    write_points::{WritePoint, reach},
};
use serde::{Serialize, de::DeserializeOwned};
use std::{
    fs::{File, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
};

/// Reads a file of lines; one that does not exist has none. A last line without its end is still being written, or its
/// writer was killed: it is left out.
///
/// # Errors
/// If a line is not as it was written; the error names file and line.
pub(crate) fn read_lines<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, FolderError> {
    let bytes = contents(path)?;
    let mut digest = Digest::default();
    let lines = bytes.split_inclusive(|&byte| byte == b'\n').filter(|line| line.ends_with(b"\n"));
    lines.enumerate().map(|(index, line)| parsed(path, index, line, &mut digest)).collect()
}

/// The lines of a file as far as a checkpoint goes: checked, and nothing changed on the disk yet.
pub(crate) struct Kept {
    path: PathBuf,
    bytes: Vec<u8>,
    length: usize,
    digest: Digest,
}

impl Kept {
    /// Checks the first `count` lines of a file, and reads them.
    ///
    /// # Errors
    /// If one of them is damaged or missing.
    pub(crate) fn check<T: DeserializeOwned>(path: &Path, count: usize) -> Result<(Self, Vec<T>), FolderError> {
        let bytes = contents(path)?;
        let mut digest = Digest::default();
        let mut length = 0;
        let mut found = Vec::with_capacity(count.min(bytes.len()));
        for line in bytes.split_inclusive(|&byte| byte == b'\n').take(count) {
            found.push(parsed(path, found.len(), line, &mut digest)?);
            length += line.len();
        }
        if found.len() < count {
            let message = format!("it is missing; the checkpoint is from after line {count}");
            return Err(FolderError::Line { path: path.into(), line: found.len() + 1, message });
        }
        Ok((Self { path: path.into(), bytes, length, digest }, found))
    }

    /// Drops what comes after these lines (a killed run wrote it after its last checkpoint, the last line perhaps in
    /// half), and opens the file to go on.
    pub(crate) fn open(self) -> Result<LineFile, ArchiveError> {
        let Self { path, bytes, length, digest } = self;
        let failed = |source| ArchiveError::Write { path: path.clone(), source };
        if length < bytes.len() {
            archive::write_whole(&path, &bytes[..length]).map_err(failed)?;
        }
        let file = OpenOptions::new().create(true).append(true).open(&path).map_err(failed)?;
        Ok(LineFile { file, path, digest })
    }
}

/// A file of lines that is appended to.
#[derive(Debug)]
pub(crate) struct LineFile {
    path: PathBuf,
    file: File,
    digest: Digest,
}

impl LineFile {
    /// Appends a line: an object of at least one field.
    pub(crate) fn write(&mut self, line: &impl Serialize) -> Result<(), ArchiveError> {
        let text = serde_json::to_string(line).map_err(|source| self.failed(source.into()))?;
        let fields = text.strip_suffix('}').unwrap_or(&text);
        self.digest.add(fields.as_bytes());
        // In one piece: another process may be reading.
        let line = format!("{fields}{}\n", seal(self.digest));
        reach(WritePoint::Append { path: &self.path, file: &self.file, line: line.as_bytes() });
        self.file.write_all(line.as_bytes()).map_err(|source| self.failed(source))
    }

    /// Brings everything to the disk.
    pub(crate) fn sync(&mut self) -> Result<(), ArchiveError> {
        self.file.sync_data().map_err(|source| self.failed(source))
    }

    fn failed(&self, source: io::Error) -> ArchiveError {
        ArchiveError::Write { path: self.path.clone(), source }
    }
}

/// What stands at the end of a line.
fn seal(digest: Digest) -> String {
    format!(",\"digest\":\"{digest}\"}}")
}

/// A line without its digest, which has to fit.
fn parsed<T: DeserializeOwned>(path: &Path, index: usize, line: &[u8], digest: &mut Digest) -> Result<T, FolderError> {
    let failed = |message| FolderError::Line { path: path.into(), line: index + 1, message };
    let line = line.strip_suffix(b"\n").ok_or_else(|| failed("it is cut off".into()))?;
    let fields = &line[..line.len().saturating_sub(seal(*digest).len())];
    digest.add(fields);
    if line.strip_prefix(fields) != Some(seal(*digest).as_bytes()) {
        return Err(failed("it was changed after it was written: its digest does not fit".into()));
    }
    field_path::from_slice(&[fields, b"}"].concat()).map_err(|error| failed(error.to_string()))
}

fn contents(path: &Path) -> Result<Vec<u8>, ArchiveError> {
    match bounded_read::read(path, bounded_read::LARGEST_DATA) {
        Ok(bytes) => Ok(bytes),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(Vec::new()),
        Err(source) => Err(ArchiveError::Read { path: path.into(), source }),
    }
}
