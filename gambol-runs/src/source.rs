//! Finding a creature by its name or its file.

use crate::{Registry, catalogue::UnknownName};
use creatures::{Blueprint, Creature, CreatureError};
use ne_core::bounded_read::{LARGEST_TEXT, read_text};
use std::{
    io,
    path::{Path, PathBuf},
};

/// Why there is no creature.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SourceError {
    /// No creature of the registry has this name.
    #[error("{0}\n(a creature of your own is given by its file, such as ./my-creature.json)")]
    Unknown(#[from] UnknownName),
    /// The file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The file is not a valid creature.
    #[error("{}: {source}", path.display())]
    Invalid {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: Box<CreatureError>,
    },
}

/// The creature of this name in the registry, or the one in this file. What has a slash, a backslash or `.json` in it is a file.
///
/// # Errors
/// If there is no such creature or its file is not valid.
pub fn creature(name_or_path: &str, registry: &Registry) -> Result<Creature, SourceError> {
    if name_or_path.contains(['/', '\\']) || name_or_path.ends_with(".json") {
        creature_file(Path::new(name_or_path))
    } else {
        Ok(registry.creatures.find(name_or_path)?.clone())
    }
}

/// The creature in a file, checked.
///
/// # Errors
/// If the file cannot be read or is not valid.
pub fn creature_file(path: &Path) -> Result<Creature, SourceError> {
    let text = read_text(path, LARGEST_TEXT).map_err(|source| SourceError::Read { path: path.into(), source })?;
    let blueprint = Blueprint::from_json(&text)
        .map_err(|source| SourceError::Invalid { path: path.into(), source: Box::new(source) })?;
    Ok(blueprint.creature().clone())
}
