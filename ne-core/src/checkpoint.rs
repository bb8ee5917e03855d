use crate::{
    Candidate, Champion, Progress, Seed, Strategy, archive, archive::ArchiveError, promotion::Decision, shared_fields,
};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use std::path::Path;

/// The kind of file a checkpoint is.
pub const CHECKPOINT_FORMAT: &str = "gambol checkpoint";

/// The version of the checkpoint file this crate writes, and the only one it reads.
pub const CHECKPOINT_VERSION: u32 = 2;

/// Everything an [`Evolution`](crate::Evolution) needs to go on exactly where it stopped, between two generations.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "S: Strategy", deserialize = "S: Strategy<Genome: DeserializeOwned> + DeserializeOwned")
)]
pub struct Checkpoint<S: Strategy> {
    /// The run's seed.
    pub seed: Seed,
    /// What [`with_label`](crate::Evolution::with_label) was told; empty without.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub label: String,
    /// Budgets used.
    pub progress: Progress,
    /// The best so far.
    pub champion: Option<Champion<S::Genome>>,
    /// The candidates that wait for the next re-evaluation, if a champion selection chooses the champion.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty", with = "shared_fields")]
    pub candidates: Vec<Candidate<S::Genome>>,
    /// What a [`Promotion`](crate::promotion::Promotion) has decided after the last generation.
    #[serde(default, skip_serializing_if = "Decision::is_stay")]
    pub decision: Decision,
    /// Whether it was [the last](crate::Evolution::write_last_checkpoint) of its process: all that is made at the end of a
    /// run is there.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub last: bool,
    /// The strategy with all its state.
    pub strategy: S,
}

impl<S: Strategy<Genome: DeserializeOwned> + DeserializeOwned> Checkpoint<S> {
    /// Reads a checkpoint.
    ///
    /// # Errors
    /// If the file cannot be read, is damaged, or is of another format or version; the error names the file.
    pub fn read(path: &Path) -> Result<Self, ArchiveError> {
        archive::read(path, CHECKPOINT_FORMAT, CHECKPOINT_VERSION)
    }
}

impl<S: Strategy> Checkpoint<S> {
    /// Writes the checkpoint, whole or not at all.
    ///
    /// # Errors
    /// If the file cannot be written; an older file at `path` is then still there.
    pub fn write(&self, path: &Path) -> Result<(), ArchiveError> {
        write_parts(path, self)
    }
}

/// A checkpoint of borrowed parts, so that writing one clones neither candidates nor champion.
#[derive(Serialize)]
#[serde(bound = "S: Strategy")]
pub(crate) struct CheckpointRef<'a, S: Strategy> {
    pub(crate) seed: Seed,
    #[serde(skip_serializing_if = "str::is_empty")]
    pub(crate) label: &'a str,
    pub(crate) progress: Progress,
    pub(crate) champion: Option<&'a Champion<S::Genome>>,
    #[serde(skip_serializing_if = "<[_]>::is_empty", serialize_with = "shared_fields::serialize")]
    pub(crate) candidates: &'a [Candidate<S::Genome>],
    #[serde(skip_serializing_if = "Decision::is_stay")]
    pub(crate) decision: Decision,
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub(crate) last: bool,
    pub(crate) strategy: &'a S,
}

pub(crate) fn write_parts(path: &Path, content: &impl Serialize) -> Result<(), ArchiveError> {
    archive::write(path, CHECKPOINT_FORMAT, CHECKPOINT_VERSION, content, archive::Layout::Compact)
}
