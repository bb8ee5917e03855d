//! The results of runs in a folder, so that no run is done twice: a file each, written whole or not at all. So a killed process
//! leaves nothing behind, and several can share a folder.

use super::GaitRun;
use envs_rapier::RAPIER_VERSION;
use gambol_runs::config::RunConfig;
use ne_core::{
    archive::{self, ArchiveError, Layout},
    digest::Digest,
};
use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
};

const FORMAT: &str = "gambol gait run";
const VERSION: u32 = 1;

/// Results by the digest of what decides them, and the folder they are kept in.
#[derive(Default)]
pub(super) struct Kept {
    runs: BTreeMap<u64, GaitRun>,
    folder: Option<PathBuf>,
}

impl Kept {
    /// Keeps results in a folder, which is made if it is not there.
    pub(super) fn open(folder: &Path) -> Result<Self, ArchiveError> {
        archive::make_folder(folder).map_err(|source| ArchiveError::Write { path: folder.into(), source })?;
        Ok(Self { runs: BTreeMap::new(), folder: Some(folder.into()) })
    }

    /// What came of the run with this digest, if it is known.
    pub(super) fn find(&mut self, digest: Digest) -> Result<Option<GaitRun>, ArchiveError> {
        if let Some(run) = self.runs.get(&digest.value()) {
            return Ok(Some(run.clone()));
        }
        let Some(path) = self.path(digest).filter(|path| path.exists()) else { return Ok(None) };
        let run: GaitRun = archive::read(&path, FORMAT, VERSION)?;
        self.runs.insert(digest.value(), run.clone());
        Ok(Some(run))
    }

    /// Remembers a result, and writes it.
    pub(super) fn add(&mut self, digest: Digest, run: GaitRun) -> Result<(), ArchiveError> {
        if let Some(path) = self.path(digest) {
            archive::write(&path, FORMAT, VERSION, &run, Layout::Pretty)?;
        }
        self.runs.insert(digest.value(), run);
        Ok(())
    }

    fn path(&self, digest: Digest) -> Option<PathBuf> {
        Some(file(self.folder.as_ref()?, digest))
    }
}

/// Where a result is kept.
pub(super) fn file(folder: &Path, digest: Digest) -> PathBuf {
    folder.join(format!("{digest}.json"))
}

/// A result in the text of a file.
pub(super) fn parse(path: &Path, text: &str) -> Result<GaitRun, ArchiveError> {
    archive::parse(path, text.as_bytes(), FORMAT, VERSION)
}

/// The digest of what decides what comes of a run: the configuration, whether it is perturbed, and the versions of Gambol and
/// rapier. A change of the code that has no version of its own is not seen.
pub(super) fn digest(config: &RunConfig, robust: bool) -> Result<Digest, serde_json::Error> {
    let decides = serde_json::to_value((config, robust, env!("CARGO_PKG_VERSION"), RAPIER_VERSION))?;
    Ok(Digest::of_json(&decides))
}

#[cfg(test)]
mod tests {
    use super::*;
    use gambol_runs::Registry;
    use std::fs;

    #[test]
    fn results_are_found_again_and_a_damaged_one_is_named() {
        let run = GaitRun {
            creature: "apod".into(),
            movement: "running".into(),
            seed: 7,
            usable: true,
            reasons: vec![],
            seconds_to_usable: Some(0.1),
            steps_to_usable: Some(7),
            seconds: 0.1 + 0.2,
            generations: 3,
            steps: 9,
            quality: Some(1.0 / 3.0),
            robust: None,
        };
        let config = Registry::default()
            .config("default", creatures::find("apod").expect("shipped"), "running")
            .expect("a configuration");
        let (mine, other) = (digest(&config, false).expect("plain data"), digest(&config, true).expect("plain data"));
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("kept");
        let mut kept = Kept::open(&path).expect("made");
        kept.add(mine, run.clone()).expect("written");
        // Another process shares the folder.
        let mut again = Kept::open(&path).expect("there");
        assert_eq!(again.find(mine).expect("readable"), Some(run));
        assert_eq!(again.find(other).expect("readable"), None);
        fs::write(path.join(format!("{other}.json")), "{").expect("written");
        let error = again.find(other).expect_err("damaged").to_string();
        assert!(error.contains(&format!("{other}.json")), "{error}");
    }
}
