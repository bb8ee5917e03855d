//! The results of runs in a file, so that no run is done twice.

use super::GaitRun;
use ne_core::digest::Digest;
use serde::{Deserialize, Serialize};
use std::{
    collections::BTreeMap,
    fs::{File, TryLockError},
    io::{self, Read, Seek, Write},
    path::{Path, PathBuf},
};

/// The most a file of results may hold, bytes: some 100,000 runs.
const MOST_BYTES: u64 = 100 << 20;

/// Results by the digest of their configuration, and the file they are kept in.
#[derive(Default)]
pub(super) struct Kept {
    runs: BTreeMap<u64, GaitRun>,
    file: Option<(PathBuf, File)>,
}

/// A file of results cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum KeptError {
    /// It cannot be read or written.
    #[error("{}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: io::Error,
    },
    /// Another process writes it.
    #[error("{} is written by another process; wait for it, or name another file", path.display())]
    Busy {
        /// The file.
        path: PathBuf,
    },
    /// It holds something else.
    #[error("{}, line {line}, is no result of a run ({source}); name another file", path.display())]
    Other {
        /// The file.
        path: PathBuf,
        /// Which line, from 1.
        line: usize,
        /// What is wrong.
        source: serde_json::Error,
    },
    /// It is too large.
    #[error("{} has {bytes} bytes; at most {MOST_BYTES} are read; name another file", path.display())]
    Large {
        /// The file.
        path: PathBuf,
        /// How many.
        bytes: u64,
    },
    /// It is a device, a pipe or a folder.
    #[error("{} is no regular file; name another", path.display())]
    Irregular {
        /// The path.
        path: PathBuf,
    },
}

/// A line of the file.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    /// Of the configuration.
    digest: String,
    run: GaitRun,
}

impl Kept {
    /// Reads what a file has, and will add to it.
    pub(super) fn open(path: &Path) -> Result<Self, KeptError> {
        let failed = |source| KeptError::Io { path: path.into(), source };
        if path.exists() && !path.is_file() {
            return Err(KeptError::Irregular { path: path.into() });
        }
        let mut file =
            File::options().read(true).write(true).create(true).truncate(false).open(path).map_err(failed)?;
        match file.try_lock() {
            // Where the file system knows no locks, two processes do some runs twice.
            Ok(()) | Err(TryLockError::Error(_)) => {}
            Err(TryLockError::WouldBlock) => return Err(KeptError::Busy { path: path.into() }),
        }
        let bytes = file.metadata().map_err(failed)?.len();
        if bytes > MOST_BYTES {
            return Err(KeptError::Large { path: path.into(), bytes });
        }
        let mut text = Vec::new();
        file.read_to_end(&mut text).map_err(failed)?;
        // A process that was killed while it wrote leaves a line without an end.
        let whole = text.iter().rposition(|&byte| byte == b'\n').map_or(0, |end| end + 1);
        let mut runs = BTreeMap::new();
        for (index, line) in text[..whole].split_inclusive(|&byte| byte == b'\n').enumerate() {
            let Line { digest, run } = serde_json::from_slice(line).map_err(|source| KeptError::Other {
                path: path.into(),
                line: index + 1,
                source,
            })?;
            // A digest that cannot be read is none that a configuration has.
            if let Ok(digest) = u64::from_str_radix(&digest, 16) {
                runs.insert(digest, run);
            }
        }
        // Nothing of a file that is not ours is removed.
        if let Some(rest) = text.get(whole..).filter(|rest| !rest.is_empty()) {
            if !rest.starts_with(b"{\"digest\":") && !b"{\"digest\":".starts_with(rest) {
                let source = serde::de::Error::custom("it has no end");
                return Err(KeptError::Other { path: path.into(), line: runs.len() + 1, source });
            }
            file.set_len(whole as u64).map_err(failed)?;
            file.seek(io::SeekFrom::Start(whole as u64)).map_err(failed)?;
        }
        Ok(Self { runs, file: Some((path.into(), file)) })
    }

    /// What came of the run with this digest, if it is known.
    pub(super) fn get(&self, digest: Digest) -> Option<&GaitRun> {
        self.runs.get(&digest.value())
    }

    /// Remembers a result, and writes it.
    pub(super) fn add(&mut self, digest: Digest, run: GaitRun) -> Result<(), KeptError> {
        if let Some((path, file)) = &mut self.file {
            let line = Line { digest: digest.to_string(), run: run.clone() };
            // Plain data: serialising it cannot fail.
            let mut text = serde_json::to_vec(&line).unwrap_or_default();
            text.push(b'\n');
            file.write_all(&text).map_err(|source| KeptError::Io { path: path.clone(), source })?;
        }
        self.runs.insert(digest.value(), run);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn run(seed: u64) -> GaitRun {
        GaitRun {
            creature: "apod".into(),
            movement: "running".into(),
            seed,
            usable: true,
            reasons: vec![],
            seconds_to_usable: Some(0.1),
            steps_to_usable: Some(7),
            seconds: 0.1 + 0.2,
            generations: 3,
            steps: 9,
            quality: Some(1.0 / 3.0),
            robust: None,
        }
    }

    fn digest(text: &str) -> Digest {
        let mut digest = Digest::default();
        digest.add(text.as_bytes());
        digest
    }

    #[test]
    fn results_are_found_again_and_a_torn_line_is_done_again() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("runs.jsonl");
        let mut kept = Kept::open(&path).expect("a new file");
        kept.add(digest("a"), run(1)).expect("written");
        kept.add(digest("b"), run(2)).expect("written");
        assert!(matches!(Kept::open(&path), Err(KeptError::Busy { .. })));
        drop(kept);
        let whole = std::fs::read(&path).expect("there");
        let first = whole.iter().position(|&byte| byte == b'\n').expect("a line") + 1;
        // Killed after any byte: what is whole is known, and what is written next is a line of its own.
        for end in 0..=whole.len() {
            std::fs::write(&path, &whole[..end]).expect("written");
            let mut kept = Kept::open(&path).expect("ours");
            assert_eq!(kept.get(digest("a")), (end >= first).then(|| run(1)).as_ref(), "{end}");
            assert_eq!(kept.get(digest("b")), (end == whole.len()).then(|| run(2)).as_ref(), "{end}");
            kept.add(digest("c"), run(3)).expect("written");
            drop(kept);
            assert_eq!(Kept::open(&path).expect("ours").get(digest("c")), Some(&run(3)), "{end}");
        }
    }

    #[test]
    fn a_file_of_somebody_else_is_left_alone() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("notes");
        for text in ["my notes", "my notes\n", "{}\n", "{\"digest\":\"0\",\"run\":{}}\nx\n"] {
            std::fs::write(&path, text).expect("written");
            let error = Kept::open(&path).err().expect("not ours").to_string();
            assert!(error.contains("notes, line 1, is no result of a run"), "{error}");
            assert_eq!(std::fs::read_to_string(&path).expect("there"), text);
        }
        let error = Kept::open(folder.path()).err().expect("a folder").to_string();
        assert!(error.ends_with("is no regular file; name another"), "{error}");
    }
}
