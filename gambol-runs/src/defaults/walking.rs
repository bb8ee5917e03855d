//! Getting far at a speed that is a setting.

use super::{BodyFacts, MovementDefaults, terms};

pub(super) fn walking(body: &BodyFacts) -> MovementDefaults {
    let usual = MovementDefaults::unknown(body);
    // Headway would ask for a speed of its own.
    let terms = match body.legs {
        0 => terms(&[("no-exploits", 0.0), ("upright", 0.0), ("vibration", -0.2), ("idleness", -5.0)]),
        _ => terms(&[("no-exploits", 0.0), ("upright", 0.0), ("footfalls", -1.0), ("vibration", -0.2)]),
    };
    // Two legs with knees walk best if one net moves them both.
    let is_biped_with_knees = (1..=2).contains(&body.legs) && body.joints > 1;
    let modular = usual.modular.filter(|_| !is_biped_with_knees);
    MovementDefaults { steps: Some(1000), training_steps: Some(500), terms, modular, ..usual }
}
