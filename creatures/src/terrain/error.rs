use std::fmt::Display;

/// A field of a terrain is out of range.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} = {found}: must be {allowed}")]
pub struct TerrainError {
    /// Its path in the terrain, such as `obstacles[0].gaps.width`.
    pub field: String,
    /// What is there.
    pub found: String,
    /// What may be there.
    pub allowed: String,
}

impl TerrainError {
    pub(super) fn new(field: &str, found: impl Display, allowed: impl Display) -> Self {
        let allowed = allowed.to_string().trim_end().to_owned();
        Self { field: field.to_owned(), found: found.to_string(), allowed }
    }
}
