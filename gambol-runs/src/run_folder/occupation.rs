//! Who may work in a folder, and what must not lie in it.

use super::{FolderError, RunFolder};
use ne_core::{
    archive::{self, ArchiveError},
    write_points::{WritePoint, reach},
};
use std::{
    ffi::OsString,
    fs::{self, File, TryLockError},
    io,
    path::Path,
};

/// The file that is locked while a process works in a folder; it stays, empty.
const LOCK: &str = ".lock";

/// The right to work in a [`RunFolder`], held by one process at a time.
#[derive(Debug)]
pub struct FolderLock {
    /// Locked until it is closed.
    _file: File,
    /// The folder itself, locked too where that can be done: the file can be deleted under a run.
    folder: Option<File>,
}

impl FolderLock {
    /// Checks that the folder at this path is still the one that is locked.
    ///
    /// # Errors
    /// If it was moved, removed or replaced under the run.
    pub(crate) fn check(&self, path: &Path) -> Result<(), FolderError> {
        match self.folder.as_ref().is_none_or(|folder| is_same(folder, path)) {
            true => Ok(()),
            false => Err(FolderError::Replaced { path: path.into() }),
        }
    }
}

#[cfg(unix)]
fn is_same(folder: &File, path: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let identity = |data: fs::Metadata| (data.dev(), data.ino());
    match (folder.metadata(), fs::metadata(path)) {
        (Ok(held), Ok(there)) => identity(held) == identity(there),
        // What cannot be looked at is not known to be another; what is not there is.
        (Err(_), _) => true,
        (_, Err(error)) => error.kind() != io::ErrorKind::NotFound,
    }
}

/// Elsewhere a folder cannot be moved while files in it are open.
#[cfg(not(unix))]
fn is_same(_: &File, _: &Path) -> bool {
    true
}

impl RunFolder {
    /// Keeps other processes from working in the folder until the lock is dropped, or this process ends in whatever
    /// way.
    ///
    /// # Errors
    /// If another process has it.
    pub fn lock(&self) -> Result<FolderLock, FolderError> {
        let path = self.path.join(LOCK);
        let failed = |source| ArchiveError::Write { path: path.clone(), source };
        let file = File::options().create(true).append(true).open(&path).map_err(failed)?;
        let busy = || FolderError::Busy { path: self.path.clone() };
        match file.try_lock() {
            Ok(()) => {}
            Err(TryLockError::WouldBlock) => return Err(busy()),
            // In a browser there is one process, and nothing to lock.
            Err(TryLockError::Error(_)) if cfg!(target_family = "wasm") => {}
            Err(TryLockError::Error(source)) => return Err(failed(source).into()),
        }
        // Not every system lets a folder be opened, and not every file system locks one.
        let folder = File::open(&self.path).ok();
        match folder.as_ref().map(File::try_lock) {
            Some(Err(TryLockError::WouldBlock)) => Err(busy()),
            _ => Ok(FolderLock { _file: file, folder }),
        }
    }

    /// Whether a run may begin here: there is no folder, or nothing in it but what a process left that was killed before
    /// its run had begun.
    pub(super) fn is_free(&self) -> Result<bool, FolderError> {
        let failed = |source| FolderError::Create { path: self.path.clone(), source };
        let names = match names_in(&self.path) {
            Ok(names) => names,
            // Below a file it cannot be made, and that is then said.
            Err(error) if matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => {
                return Ok(fs::symlink_metadata(&self.path).is_err());
            }
            Err(source) => return Err(failed(source)),
        };
        Ok(names.iter().all(|name| self.is_left_over(name)))
    }

    fn is_left_over(&self, name: &OsString) -> bool {
        // A first checkpoint without the configuration, which is written after it, is of no use.
        let is_first = || self.read_standing().is_ok_and(|standing| standing.progress.generations == 0);
        let is_checkpoint = || self.path.join(name) == self.checkpoint() && !self.config().exists();
        name == LOCK || archive::is_temporary(name) || (is_checkpoint() && is_first())
    }

    /// Makes room for a run that begins at this path: moves a folder that is not free aside, to a name that begins with
    /// `old-`, whatever lies in it but a run that can be gone on with. `false`: there is one, or a process is at work there.
    ///
    /// # Errors
    /// If it cannot be read or moved.
    pub fn set_aside(path: &Path) -> Result<bool, FolderError> {
        Self::set_aside_if(path, |folder| !folder.is_begun())
    }

    /// As [`set_aside`](Self::set_aside), for a run that cannot be gone on with: one that is there is moved as well.
    ///
    /// # Errors
    /// If it cannot be read or moved.
    pub fn set_aside_with_runs(path: &Path) -> Result<bool, FolderError> {
        Self::set_aside_if(path, |_| true)
    }

    fn set_aside_if(path: &Path, may_move: impl Fn(&Self) -> bool) -> Result<bool, FolderError> {
        let folder = Self::at(path);
        if !path.is_dir() || folder.is_free()? {
            return Ok(true);
        }
        let _lock = match folder.lock() {
            Ok(lock) => lock,
            Err(FolderError::Busy { .. }) => return Ok(false),
            Err(error) => return Err(error),
        };
        // Another process may have begun a run since the caller looked.
        if !may_move(&folder) {
            return Ok(false);
        }
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let numbered = (2..).map(|number| format!("old-{name}-{number}"));
        let mut places = std::iter::once(format!("old-{name}")).chain(numbered).map(|name| path.with_file_name(name));
        let place = places.find(|place| fs::symlink_metadata(place).is_err()).unwrap_or_default();
        reach(WritePoint::Move(path));
        fs::rename(path, &place).map_err(|source| FolderError::Move {
            from: path.into(),
            to: place.clone(),
            source,
        })?;
        tracing::warn!(from = %path.display(), to = %place.display(), "a folder that no run can go on from was moved aside");
        Ok(true)
    }
}

fn names_in(folder: &Path) -> io::Result<Vec<OsString>> {
    fs::read_dir(folder)?.map(|entry| Ok(entry?.file_name())).collect()
}
