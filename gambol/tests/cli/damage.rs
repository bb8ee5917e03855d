//! Damaging files, as disks, transfers and editors do.

use crate::folder::read;
use ne_core::archive::{self, Layout};
use serde_json::Value;
use std::{fs, path::Path};

/// Keeps only the first bytes.
pub(crate) fn truncate(path: &Path, length: usize) {
    let bytes = read(path);
    write(path, &bytes[..length]);
}

/// Flips one bit.
pub(crate) fn flip(path: &Path, byte: usize, bit: usize) {
    let mut bytes = read(path);
    bytes[byte] ^= 1 << (bit % 8);
    write(path, &bytes);
}

/// Raises the version in the file's envelope, as a later Gambol would write it.
pub(crate) fn raise_version(path: &Path) {
    let mut file = json(path);
    file["version"] = (file["version"].as_u64().expect("a version") + 1).into();
    write(path, file.to_string().as_bytes());
}

/// Changes the content by hand and leaves the digest as it was.
pub(crate) fn edit(path: &Path, change: impl FnOnce(&mut Value)) {
    let mut file = json(path);
    change(&mut file["content"]);
    write(path, file.to_string().as_bytes());
}

/// Changes the content and makes the digest fit, as only a program could.
pub(crate) fn edit_and_seal(path: &Path, change: impl FnOnce(&mut Value)) {
    let mut file = json(path);
    change(&mut file["content"]);
    let format = file["format"].as_str().expect("a format");
    let version = file["version"].as_u64().expect("a version") as u32;
    archive::write(path, format, version, &file["content"], Layout::Pretty).expect("a writable folder");
}

/// A few places spread over a file, the first and the last byte before the line break at its end among them.
pub(crate) fn places(path: &Path, count: usize) -> impl Iterator<Item = usize> + use<> {
    let last = read(path).len() - 2;
    (0..count).map(move |index| index * last / (count - 1))
}

pub(crate) fn json(path: &Path) -> Value {
    serde_json::from_slice(&read(path)).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

pub(crate) fn write(path: &Path, bytes: &[u8]) {
    fs::write(path, bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}
