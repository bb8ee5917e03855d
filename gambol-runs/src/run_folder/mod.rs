//! The folder of a run: which file is what, and how each is written.

pub(crate) mod lines;
mod new_folder;
mod occupation;

pub use new_folder::NewFolder;
pub use occupation::FolderLock;

use crate::{
    config::{CONFIG_FORMAT, CONFIG_VERSION, RunConfig},
    run_folder::lines::read_lines,
};
use ne_core::{
    CHECKPOINT_FORMAT, CHECKPOINT_VERSION, Fitness, GenerationReport, Progress, Seed,
    archive::{self, ArchiveError, Layout},
    promotion::Decision,
};
use ne_net::Network;
use serde::{Deserialize, Serialize};
use std::{
    io,
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
/// | `front.json` | the compromises found so far, with strategies that search for several objectives |
/// | `report.html` | to look at |
/// | `stages/` | of a run with stages: the folder of each, in their order; the run itself has no log and no checkpoint |
/// | `.lock` | empty; locked while a process works in the folder |
///
/// Each line of a `.jsonl` file ends with a field `digest`, over the file up to there.
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
        "{} already exists{}; choose another folder with --out{}", path.display(),
        if path.is_dir() { " and is not empty" } else { " and is no folder" },
        if path.join("config.json").is_file() { format!(", or go on with: {} resume {}", crate::program_name(), crate::texts::shell_word(path)) } else { String::new() }
    )]
    Exists {
        /// The folder.
        path: PathBuf,
    },
    /// Another process trains in it; nothing was touched.
    #[error("another {} is at work in {}; wait until it has ended, or stop it", crate::program_name(), path.display())]
    Busy {
        /// The folder.
        path: PathBuf,
    },
    /// It is not the folder any more in which the run began to work.
    #[error("{} was moved, removed or replaced while its run was at work; the run has ended, and nothing more was written", path.display())]
    Replaced {
        /// Where it was.
        path: PathBuf,
    },
    /// Its checkpoint is of another run.
    #[error("{} is not the checkpoint of this run: it differs from config.json in {what}", path.display())]
    Foreign {
        /// The checkpoint.
        path: PathBuf,
        /// What differs.
        what: &'static str,
    },
    /// Its log is of another run.
    #[error("{} is not the log of this run: generation {generation} ended otherwise than the checkpoint says", path.display())]
    ForeignLog {
        /// The log.
        path: PathBuf,
        /// The last generation before the checkpoint.
        generation: u64,
    },
    /// It is of another run than the one that has its place.
    #[error(
        "{} is the folder of another run: its config.json has another \"{what}\" than the run that is to be there; move it away, and \
         that run is done", path.display()
    )]
    AnotherRun {
        /// The folder.
        path: PathBuf,
        /// What differs.
        what: String,
    },
    /// Its champion is of another run.
    #[error("{} is not the champion of this run: it differs from config.json in {what}", path.display())]
    ForeignChampion {
        /// The champion file.
        path: PathBuf,
        /// What differs.
        what: &'static str,
    },
    /// Its champion is one that its run has done better than.
    #[error(
        "{} is older than its run: it is of generation {found}, and the checkpoint has a champion of generation {expected}; \
         resume the run to have it written again", path.display()
    )]
    OldChampion {
        /// The champion file.
        path: PathBuf,
        /// The generation of the champion in the file.
        found: u64,
        /// The generation of that in the checkpoint.
        expected: u64,
    },
    /// The champion of its checkpoint is not worth what it says; nothing was touched.
    #[error(
        "{}: its champion has fitness {recorded}, and played again it has {found}; the file was changed, or written by another Gambol: \
         use the one that wrote it", path.display()
    )]
    Unrepeatable {
        /// The checkpoint.
        path: PathBuf,
        /// The fitness in the checkpoint.
        recorded: Fitness,
        /// What it is worth when it is played again.
        found: String,
    },
    /// The folder cannot be made.
    #[error("cannot create the folder {}: {source}", path.display())]
    Create {
        /// The folder.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// It cannot be moved aside.
    #[error("cannot move the folder {} to {}: {source}", from.display(), to.display())]
    Move {
        /// The folder.
        from: PathBuf,
        /// Its new place.
        to: PathBuf,
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

/// Where a run stands, whichever strategy it has.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct RunStanding {
    /// The seed of the run.
    pub seed: Seed,
    /// The [label](RunConfig::label) of its settings.
    #[serde(default)]
    pub label: String,
    /// What it has used up.
    pub progress: Progress,
    /// What the rules of its stage have decided after the last generation.
    #[serde(default)]
    pub decision: Decision,
    /// Its champion.
    pub champion: Option<ChampionStanding>,
}

/// Where the champion of a run stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
pub struct ChampionStanding {
    /// Its fitness.
    pub fitness: Fitness,
    /// Its [tier](ne_core::champion_selection::ReEvaluation::tiers).
    #[serde(default)]
    pub tier: u8,
    /// The generation it was found in.
    pub generation: u64,
}

/// A line of `gallery.jsonl`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct GalleryEntry {
    /// The generation, from 1.
    pub generation: u64,
    /// Why it is kept.
    pub kind: GalleryKind,
    /// A champion alone, or a population in its order: all of it or, of more than 1000, as many, evenly from the best to the
    /// worst.
    pub members: Vec<GalleryMember>,
}

/// Why a line of the gallery is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GalleryKind {
    /// A new best.
    Champion,
    /// One of a whole population.
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
    /// Makes a new folder and locks it. It is a run once it has a configuration, which is to be written after all that a
    /// run needs to be resumed. What a killed process left before that is no hindrance.
    ///
    /// # Errors
    /// If there is something else in the folder (nothing is touched then), or it cannot be made or locked.
    pub fn create(path: &Path) -> Result<(Self, FolderLock), FolderError> {
        let folder = Self { path: path.into() };
        let free = || if folder.is_free()? { Ok(()) } else { Err(FolderError::Exists { path: path.into() }) };
        free()?;
        archive::make_folder(path).map_err(|source| FolderError::Create { path: path.into(), source })?;
        let lock = folder.lock()?;
        // Another process may have been faster.
        free()?;
        Ok((folder, lock))
    }

    /// A folder, whatever is in it; nothing is looked at.
    pub fn at(path: &Path) -> Self {
        Self { path: path.into() }
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

    /// Whether it is a run that can be gone on with: it has a configuration and a checkpoint.
    pub fn is_begun(&self) -> bool {
        self.config().is_file() && self.checkpoint().is_file()
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

    /// Path of the front.
    pub fn front(&self) -> PathBuf {
        self.path.join("front.json")
    }

    /// Path of the report.
    pub fn report(&self) -> PathBuf {
        self.path.join("report.html")
    }

    /// Path of the folder that holds those of the stages.
    pub fn stages(&self) -> PathBuf {
        self.path.join("stages")
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

    /// Checks that its configuration is one of this run.
    ///
    /// # Errors
    /// If it is of another, or cannot be read.
    pub fn check_run(&self, config: &RunConfig) -> Result<(), FolderError> {
        match config.other_run(&self.read_config()?) {
            Some(what) => Err(FolderError::AnotherRun { path: self.path().into(), what }),
            None => Ok(()),
        }
    }

    /// Reads where the run stands, from its checkpoint.
    ///
    /// # Errors
    /// If it cannot be read, is damaged or of another version.
    pub fn read_standing(&self) -> Result<RunStanding, FolderError> {
        Ok(archive::read(&self.checkpoint(), CHECKPOINT_FORMAT, CHECKPOINT_VERSION)?)
    }

    /// Reads the log, of a run under way as well.
    ///
    /// # Errors
    /// If a line is not as it was written; the error names file and line.
    pub fn read_log(&self) -> Result<Vec<GenerationReport>, FolderError> {
        read_lines(&self.log())
    }

    /// Reads the timing, of a run under way as well.
    ///
    /// # Errors
    /// If a line is not as it was written; the error names file and line.
    pub fn read_timing(&self) -> Result<Vec<Timing>, FolderError> {
        read_lines(&self.timing())
    }

    /// Reads the gallery, of a run under way as well.
    ///
    /// # Errors
    /// If a line is not as it was written; the error names file and line.
    pub fn read_gallery(&self) -> Result<Vec<GalleryEntry>, FolderError> {
        read_lines(&self.gallery())
    }
}
