//! In water there is nothing to stand on: legs are limbs like others.

use super::{BodyFacts, MovementDefaults, terms};

/// 20 s, of which training has 5.
pub(super) fn swimming(body: &BodyFacts) -> MovementDefaults {
    MovementDefaults {
        steps: Some(1000),
        training_steps: Some(250),
        terms: terms(&[("no-exploits", 0.0), ("vibration", -0.2)]),
        // A stroke.
        period: 0.35,
        stands: false,
        ..MovementDefaults::unknown(body)
    }
}
