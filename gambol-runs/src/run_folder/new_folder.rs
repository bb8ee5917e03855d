//! A folder for a new run, by its name.

use super::FolderError;
use crate::config::RunConfig;
use ne_core::archive;
use std::{
    fs, io,
    path::{Path, PathBuf},
};

/// A folder that was made for a run, and goes again if the run does not begin.
#[derive(Debug)]
pub struct NewFolder(PathBuf);

impl NewFolder {
    /// `biped-1-running` in the folder of all runs, or with a number behind it if that is taken. To make a folder is to have it: another
    /// process that starts at the same time takes the next number.
    ///
    /// # Errors
    /// If a folder cannot be made.
    pub fn make(runs: &Path, config: &RunConfig) -> Result<Self, FolderError> {
        let name = format!("{}-{}", config.creature.name, config.movement.name);
        let failed = |path: &Path, source| FolderError::Create { path: path.into(), source };
        archive::make_folder(runs).map_err(|source| failed(runs, source))?;
        for number in 1_u64.. {
            let path = runs.join(if number == 1 { name.clone() } else { format!("{name}-{number}") });
            match fs::create_dir(&path) {
                Ok(()) => return Ok(Self(path)),
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(source) => return Err(failed(&path, source)),
            }
        }
        Err(failed(runs, io::ErrorKind::AlreadyExists.into()))
    }

    /// Where it is.
    pub fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for NewFolder {
    fn drop(&mut self) {
        // One with anything in it stays.
        let _ = fs::remove_dir(&self.0);
    }
}
