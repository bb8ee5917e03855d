//! Being upright.

use super::{BodyFacts, MovementDefaults, terms};

/// 10 s, of which training has 6.
const STEPS: (Option<u32>, Option<u32>) = (Some(500), Some(300));

pub(super) fn standing(body: &BodyFacts) -> MovementDefaults {
    let terms = terms(&[("no-exploits", 0.0), ("vibration", -0.1)]);
    MovementDefaults { steps: STEPS.0, training_steps: STEPS.1, terms, ..MovementDefaults::unknown(body) }
}

pub(super) fn getting_up(body: &BodyFacts) -> MovementDefaults {
    // One that lies on its back has legs all the same.
    let body = &BodyFacts { legs: body.limbs, ..*body };
    let terms = terms(&[("no-exploits", 0.0), ("vibration", -0.01)]);
    MovementDefaults { steps: STEPS.0, training_steps: STEPS.1, terms, ..MovementDefaults::unknown(body) }
}
