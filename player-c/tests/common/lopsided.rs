//! A character that cannot turn round.

use player::Character;
use std::{error::Error, fs, path::Path};

/// A file of the same character, its last part where no other is the mirror image of it. What its net does is the same.
pub(crate) fn lopsided(file: &Path) -> Result<tempfile::NamedTempFile, Box<dyn Error>> {
    let mut character = Character::from_bytes(&fs::read(file)?)?;
    let last = character.parts.last_mut().ok_or("no parts")?;
    last.x += 0.1;
    let lopsided = tempfile::Builder::new().suffix(".player").tempfile()?;
    fs::write(lopsided.path(), character.to_bytes()?)?;
    Ok(lopsided)
}
