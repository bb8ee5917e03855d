//! Getting off the ground.

use super::{BodyFacts, MovementDefaults, terms, with};
use crate::config::LimbPhases;
use serde_json::Map;

/// 5 s: a jump and its landing.
pub(super) fn jumping(body: &BodyFacts) -> MovementDefaults {
    // A body without legs lies in any posture, but not on its back.
    let is_legless = body.legs == 0;
    let stays_upright = if is_legless { "upright" } else { "posture" };
    let mut terms =
        terms(&[("no-exploits", 0.0), (stays_upright, 0.0), ("leap", 4.0), ("landing", 3.0), ("vibration", -0.2)]);
    let defaults = leap(body);
    for posture in terms.iter_mut().filter(|term| term.term == "posture") {
        // A jump crouches, and nothing but feet may touch the ground, however shortly.
        *posture = with(posture.clone(), "tilt", 35);
        *posture = with(posture.clone(), "margin", 5);
        *posture = with(posture.clone(), "height", 0.3);
        *posture = with(posture.clone(), "brush", 0);
    }
    MovementDefaults {
        steps: Some(250),
        training_steps: Some(250),
        terms,
        // Where a search begins with steps as wide as it does for a run, legs thrash, and hardly any of the first nets leaves
        // the ground and lands. A body that has none must begin to bend.
        strategy: Map::from_iter([("step_size".to_owned(), 0.2.into())].into_iter().filter(|_| !is_legless)),
        // Two legs without knees take off as they have landed, and no two of their jumps last equally long: the next begins
        // when they have landed, and not by the clock. Knees make up for it by themselves, and more legs, whose clocks run
        // ahead of each other by genes, get worse by it.
        from_landing: (1..=2).contains(&body.legs) && body.joints == 1,
        // One that snaps to its angles rolls over.
        gain: if is_legless { 15.0 } else { defaults.gain },
        ..defaults
    }
}

/// 5 s, of which training has 2.
pub(super) fn long_jump(body: &BodyFacts) -> MovementDefaults {
    // A somersault also gets far.
    let terms = terms(&[("no-exploits", 0.0), ("upright", 0.0), ("leap", 1.0), ("vibration", -0.02)]);
    MovementDefaults { steps: Some(250), training_steps: Some(100), terms, ..leap(body) }
}

/// 10 s, of which training has 4.
pub(super) fn hopping(body: &BodyFacts) -> MovementDefaults {
    let terms = terms(&[("no-exploits", 0.0), ("upright", 0.0), ("vibration", -0.02)]);
    let period = MovementDefaults::unknown(body).period;
    MovementDefaults { steps: Some(500), training_steps: Some(200), terms, period, ..leap(body) }
}

/// A leap with its run-up. Many legs leap together; two leap best if one net moves them both. The leap of a biped must follow
/// closely; many legs that snap at once tear at their joints, and stiff ones throw the body over.
fn leap(body: &BodyFacts) -> MovementDefaults {
    let (modular, gain, period) = match body.legs {
        0 => (Some(LimbPhases::Alternating), 20.0, 1.0),
        1..=2 => (None, 20.0, body.pendulum(1.0)),
        _ => (Some(LimbPhases::Together), if body.joints == 1 { 10.0 } else { 15.0 }, body.pendulum(1.0)),
    };
    MovementDefaults { modular, gain, period, ..MovementDefaults::unknown(body) }
}
