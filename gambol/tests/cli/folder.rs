//! Comparing folders.

use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

/// The files of a run that are a function of its configuration; `timing.jsonl` and the report have wall-clock time in
/// them.
pub(crate) const LASTING: [&str; 5] = ["config.json", "log.jsonl", "gallery.jsonl", "checkpoint", "champion.json"];

/// Both runs have the same bytes in the files that last.
#[track_caller]
pub(crate) fn assert_same_run(one: &Path, other: &Path) {
    assert_same_files(one, other, &LASTING);
}

/// Both folders have the same bytes in these files.
#[track_caller]
pub(crate) fn assert_same_files(one: &Path, other: &Path, names: &[&str]) {
    for name in names {
        let (one, other) = (read(&one.join(name)), read(&other.join(name)));
        if one != other {
            let place = one.iter().zip(&other).take_while(|(a, b)| a == b).count();
            panic!("{name} differs from byte {place} on ({} and {} bytes)", one.len(), other.len());
        }
    }
}

/// Everything in a folder, to see later whether it was touched.
pub(crate) fn contents(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).expect("a folder") {
        let path = entry.expect("a folder that can be read").path();
        if path.is_dir() {
            found.extend(contents(&path));
            found.insert(path, Vec::new());
        } else {
            found.insert(path.clone(), read(&path));
        }
    }
    found
}

/// Nothing in the folder is new, gone or changed.
#[track_caller]
pub(crate) fn assert_untouched(folder: &Path, before: &BTreeMap<PathBuf, Vec<u8>>) {
    let after = contents(folder);
    assert!(before.keys().eq(after.keys()), "{:?} became {:?}", before.keys(), after.keys());
    for (path, bytes) in before {
        assert!(after[path] == *bytes, "{} was changed", path.display());
    }
}

pub(crate) fn read(path: &Path) -> Vec<u8> {
    fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}
