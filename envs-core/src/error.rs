use creatures::CreatureError;
use ne_core::{Failure, SettingError};

/// Why an environment cannot be built.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EnvironmentError {
    /// The sensors do not suit the creature.
    #[error(transparent)]
    Creature(#[from] CreatureError),
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The creature starts inside the ground, which would throw it up.
    #[error("the creature \"{creature}\" starts {depth} m below the ground: its lowest point must be near y = 0")]
    BelowGround {
        /// Its name.
        creature: String,
        /// How deep its lowest point is, m.
        depth: f32,
    },
    /// The creature explodes in its start pose, or has not reached the ground when it should have settled.
    #[error("the creature \"{creature}\" does not survive settling in its start pose: {failure}")]
    Settling {
        /// Its name.
        creature: String,
        /// What happened.
        failure: Failure,
    },
    /// The creature, its ground or the settings need what this engine does not have.
    #[error("{engine} cannot simulate this creature: {what}")]
    Unsupported {
        /// The engine's name.
        engine: &'static str,
        /// What it lacks.
        what: String,
    },
}
