//! The creatures that come with the crate. They are ordinary files, and nothing else treats them specially.

use crate::Creature;
use crate::names::{did_you_mean, nearest, shortened};

/// A creature file that comes with the crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShippedCreature {
    /// The creature's name.
    pub name: &'static str,
    /// The text of its file.
    pub json: &'static str,
}

macro_rules! shipped {
    ($($name:literal),* $(,)?) => {
        &[$(ShippedCreature { name: $name, json: include_str!(concat!("../shipped/", $name, ".json")) }),*]
    };
}

static SHIPPED: &[ShippedCreature] =
    shipped!["apod", "biped-1", "biped-2", "tetrapod-1", "tetrapod-2", "decapod-1", "decapod-2"];

/// All creatures that come with the crate, from the one without legs to those with most.
pub fn shipped() -> &'static [ShippedCreature] {
    SHIPPED
}

/// The shipped creature of that name.
///
/// # Errors
/// [`UnknownCreature`] if there is none, with the name most like it.
pub fn find(name: &str) -> Result<Creature, UnknownCreature> {
    let Some(found) = SHIPPED.iter().find(|creature| creature.name == name) else {
        let names = || SHIPPED.iter().map(|creature| creature.name);
        return Err(UnknownCreature {
            name: shortened(name),
            nearest: nearest(name, names()),
            valid: names().collect(),
        });
    };
    Ok(Creature::from_json(found.json).expect("a test reads every shipped file"))
}

/// No shipped creature has this name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no creature `{name}`{} (valid: {})", did_you_mean(.nearest), .valid.join(", "))]
pub struct UnknownCreature {
    /// The name asked for, shortened.
    pub name: String,
    /// The shipped name most like it.
    pub nearest: Option<String>,
    /// All shipped names.
    pub valid: Vec<&'static str>,
}
