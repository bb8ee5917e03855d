//! The engine a run is trained in.

use serde::{Deserialize, Serialize};

/// The engine that steps creatures during training. Whatever it is, champions are proved in rapier.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum EngineChoice {
    /// `envs-lanes`: a whole population at once, with the same bits as rapier, many times faster.
    Lanes,
    /// `envs-rapier`: one creature at a time. It can do what lanes refuse, such as parts that collide with each other.
    Rapier,
}

impl EngineChoice {
    /// All engines; the first is the one presets choose.
    pub const ALL: [Self; 2] = [Self::Lanes, Self::Rapier];

    /// Its name in configurations.
    pub fn name(self) -> &'static str {
        match self {
            Self::Lanes => "lanes",
            Self::Rapier => "rapier",
        }
    }

    /// The engine of this name.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|engine| engine.name() == name)
    }

    /// What a configuration means that was written when there was no choice.
    pub(super) fn of_old() -> Self {
        Self::Rapier
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_those_of_files() {
        for engine in EngineChoice::ALL {
            assert_eq!(serde_json::to_value(engine).expect("a text"), engine.name());
            assert_eq!(EngineChoice::find(engine.name()), Some(engine));
        }
        assert_eq!(EngineChoice::find("Lanes"), None);
    }
}
