use crate::{ExportError, Exported, Format};
use gambol_runs::champion::Champion;
use ne_core::archive;
use std::{
    io,
    path::{Path, PathBuf},
};

/// Where an export's files go: the one that was asked for, and beside it those that belong to it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Destination {
    /// What the files are called, without their endings.
    pub name: String,
    /// The files, in the order of the format's [endings](Format::endings).
    pub paths: Vec<PathBuf>,
}

impl Destination {
    /// `first`: the file that was asked for; by default it is named after creature and movement, in the current folder.
    ///
    /// # Errors
    /// If the file is called like one that stands beside it.
    pub fn new(format: Format, champion: &Champion, first: Option<PathBuf>) -> Result<Self, ExportError> {
        let endings = format.endings();
        let (usual, others) = (endings[0], &endings[1..]);
        let first =
            first.unwrap_or_else(|| format!("{}-{}{usual}", champion.creature.name, champion.movement.name).into());
        let text = |part: Option<&std::ffi::OsStr>| part.map_or_else(String::new, |part| part.to_string_lossy().into());
        let name = match text(first.file_name()).strip_suffix(usual) {
            Some(name) if !name.is_empty() => name.to_owned(),
            _ => text(first.file_stem()),
        };
        let others: Vec<PathBuf> =
            others.iter().map(|ending| first.with_file_name(format!("{name}{ending}"))).collect();
        if others.contains(&first) {
            return Err(ExportError::SameName { file: first, usual });
        }
        Ok(Self { name, paths: std::iter::once(first).chain(others).collect() })
    }

    /// Writes the files, each of them whole or not at all; the one that names the others comes last.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, exported: &[Exported]) -> io::Result<()> {
        let written = self.paths.iter().zip(exported);
        let files: Vec<(&Path, &[u8])> = written.rev().map(|(path, file)| (&**path, &*file.bytes)).collect();
        archive::write_whole_together(&files)
    }
}
