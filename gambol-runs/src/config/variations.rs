//! Variations a user can ask for by name.

use envs_rapier::Variation;

/// Their names.
pub const VARIATIONS: [&str; 7] = ["none", "near", "pushed", "light", "bumpy", "strong", "physics"];

/// The variation of this name.
pub fn variation(name: &str) -> Option<Variation> {
    match name {
        "none" => Some(Variation::default()),
        "light" => Some(Variation::light()),
        "near" => Some(Variation::near()),
        "pushed" => Some(Variation::pushed()),
        "physics" => Some(Variation::physics()),
        "bumpy" => Some(Variation::bumpy()),
        "strong" => Some(Variation::strong()),
        _ => None,
    }
}
