//! The folder of a run: which file is what, and how each is written.

use crate::config::{CONFIG_FORMAT, CONFIG_VERSION, RunConfig};
use ne_core::{
    Fitness,
    archive::{self, ArchiveError, Layout},
};
use ne_net::Network;
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::{
    fs::{self, File, OpenOptions},
    io::{self, BufRead, BufReader, BufWriter, Write},
    path::{Path, PathBuf},
};

/// The folder of a run.
///
/// | file | what it is |
/// |---|---|
/// | `config.json` | everything needed to repeat the run |
/// | `log.jsonl` | a line for each generation |
/// | `gallery.jsonl` | each new champion, and whole populations at chosen generations |
/// | `timing.jsonl` | seconds of wall clock for each generation: the one file that differs between equal runs |
/// | `checkpoint` | to resume from |
/// | `champion.json` | the best so far |
/// | `report.html` | to look at |
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RunFolder {
    path: PathBuf,
}

/// What can be wrong with a run folder.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum FolderError {
    /// There is something already; nothing was touched.
    #[error(
        "{} already exists and is not empty; choose another folder with --out, or go on with: gambol resume {}",
        path.display(), path.display()
    )]
    Exists {
        /// The folder.
        path: PathBuf,
    },
    /// The folder cannot be made.
    #[error("cannot create the folder {}: {source}", path.display())]
    Create {
        /// The folder.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// It is no folder of a run.
    #[error("{} is not the folder of a run: it has no {missing}", path.display())]
    NotARun {
        /// The folder.
        path: PathBuf,
        /// The file that is missing.
        missing: String,
    },
    /// A file cannot be read or written, or is damaged.
    #[error(transparent)]
    File(#[from] ArchiveError),
    /// A line of a `.jsonl` file is not as it should be.
    #[error("{}, line {line}: {message}", path.display())]
    Line {
        /// The file.
        path: PathBuf,
        /// From 1.
        line: usize,
        /// What is wrong.
        message: String,
    },
}

/// A line of `gallery.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GalleryEntry {
    /// The generation, from 1.
    pub generation: u64,
    /// Why it is kept.
    pub kind: GalleryKind,
    /// A champion alone, or a whole population in its order.
    pub members: Vec<GalleryMember>,
}

/// Why a line of the gallery is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GalleryKind {
    /// A new best.
    Champion,
    /// Everybody.
    Population,
}

/// An individual in the gallery.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GalleryMember {
    /// Its fitness, unless its evaluation failed.
    pub fitness: Option<Fitness>,
    /// Its controller.
    pub network: Network,
}

/// A line of `timing.jsonl`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Timing {
    /// The generation, from 1.
    pub generation: u64,
    /// Seconds it took, everything included.
    pub seconds: f64,
}

impl RunFolder {
    /// Makes a new folder and writes the configuration into it.
    ///
    /// # Errors
    /// If there is a folder that is not empty (nothing is touched then), or it cannot be made or written.
    pub fn create(path: &Path, config: &RunConfig) -> Result<Self, FolderError> {
        let occupied = match fs::read_dir(path) {
            Ok(mut entries) => entries.next().is_some(),
            Err(error) => error.kind() == io::ErrorKind::NotADirectory || path.is_file(),
        };
        if occupied {
            return Err(FolderError::Exists { path: path.into() });
        }
        fs::create_dir_all(path).map_err(|source| FolderError::Create { path: path.into(), source })?;
        let folder = Self { path: path.into() };
        folder.write_config(config)?;
        Ok(folder)
    }

    /// The folder of an earlier run.
    ///
    /// # Errors
    /// If it has no configuration.
    pub fn open(path: &Path) -> Result<Self, FolderError> {
        let folder = Self { path: path.into() };
        if folder.config().is_file() {
            Ok(folder)
        } else {
            Err(FolderError::NotARun { path: path.into(), missing: "config.json".into() })
        }
    }

    /// The folder itself.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Path of the configuration.
    pub fn config(&self) -> PathBuf {
        self.path.join("config.json")
    }

    /// Path of the log.
    pub fn log(&self) -> PathBuf {
        self.path.join("log.jsonl")
    }

    /// Path of the gallery.
    pub fn gallery(&self) -> PathBuf {
        self.path.join("gallery.jsonl")
    }

    /// Path of the timing.
    pub fn timing(&self) -> PathBuf {
        self.path.join("timing.jsonl")
    }

    /// Path of the checkpoint.
    pub fn checkpoint(&self) -> PathBuf {
        self.path.join("checkpoint")
    }

    /// Path of the champion.
    pub fn champion(&self) -> PathBuf {
        self.path.join("champion.json")
    }

    /// Path of the report.
    pub fn report(&self) -> PathBuf {
        self.path.join("report.html")
    }

    /// Writes the configuration.
    ///
    /// # Errors
    /// If it cannot be written.
    pub fn write_config(&self, config: &RunConfig) -> Result<(), FolderError> {
        Ok(archive::write(&self.config(), CONFIG_FORMAT, CONFIG_VERSION, config, Layout::Pretty)?)
    }

    /// Reads the configuration.
    ///
    /// # Errors
    /// If it cannot be read, is damaged or of another version.
    pub fn read_config(&self) -> Result<RunConfig, FolderError> {
        Ok(archive::read(&self.config(), CONFIG_FORMAT, CONFIG_VERSION)?)
    }
}

/// Reads a `.jsonl` file; one that does not exist has no lines.
///
/// # Errors
/// If a line is not as it should be; the error names file and line.
pub fn read_lines<T: DeserializeOwned>(path: &Path) -> Result<Vec<T>, FolderError> {
    let file = match File::open(path) {
        Ok(file) => file,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Vec::new()),
        Err(source) => return Err(ArchiveError::Read { path: path.into(), source }.into()),
    };
    let read = |(index, line): (usize, io::Result<String>)| {
        let failed = |message: String| FolderError::Line { path: path.into(), line: index + 1, message };
        let line = line.map_err(|error| failed(error.to_string()))?;
        serde_json::from_str(&line).map_err(|error| failed(error.to_string()))
    };
    BufReader::new(file).lines().enumerate().map(read).collect()
}

/// A `.jsonl` file that is appended to.
#[derive(Debug)]
pub(crate) struct LineFile {
    path: PathBuf,
    file: BufWriter<File>,
}

impl LineFile {
    /// Opens the file, keeping only the lines before the first that `keep` rejects: what a killed run wrote after its
    /// last checkpoint goes, a half-written line included. If fewer than `least` lines remain the file is damaged, and
    /// stays as it is.
    pub(crate) fn open(path: &Path, least: u64, keep: impl Fn(&str) -> bool) -> Result<Self, ArchiveError> {
        let failed = |source| ArchiveError::Write { path: path.into(), source };
        let text = match fs::read_to_string(path) {
            Ok(text) => text,
            Err(error) if error.kind() == io::ErrorKind::NotFound => String::new(),
            Err(source) => return Err(ArchiveError::Read { path: path.into(), source }),
        };
        let good = text.split_inclusive('\n').take_while(|line| line.ends_with('\n') && keep(line));
        let (lines, kept) = good.fold((0, 0), |(lines, bytes), line| (lines + 1, bytes + line.len()));
        if lines < least {
            let message = format!("line {} is damaged or missing; the checkpoint is from after {least}", lines + 1);
            return Err(ArchiveError::Content { path: path.into(), message });
        }
        if kept < text.len() {
            archive::write_whole(path, &text.as_bytes()[..kept]).map_err(failed)?;
        }
        let file = OpenOptions::new().create(true).append(true).open(path).map_err(failed)?;
        Ok(Self { path: path.into(), file: BufWriter::new(file) })
    }

    /// Appends a line.
    pub(crate) fn write(&mut self, line: &impl Serialize) -> Result<(), ArchiveError> {
        let written = serde_json::to_writer(&mut self.file, line).map_err(io::Error::from);
        written.and_then(|()| self.file.write_all(b"\n")).map_err(|source| self.failed(source))
    }

    /// Brings everything to the disk.
    pub(crate) fn sync(&mut self) -> Result<(), ArchiveError> {
        let synced = self.file.flush().and_then(|()| self.file.get_ref().sync_data());
        synced.map_err(|source| self.failed(source))
    }

    fn failed(&self, source: io::Error) -> ArchiveError {
        ArchiveError::Write { path: self.path.clone(), source }
    }
}
