//! Getting far, as fast as it goes.

use super::{BodyFacts, MovementDefaults, terms, with};
use crate::config::LimbPhases;
use envs_rapier::Variation;
use tasks::TermSpec;

/// 20 s, of which training has 10.
const STEPS: (Option<u32>, Option<u32>) = (Some(1000), Some(500));

/// What ends an episode is charged for by the distance it then cannot cover.
const CRAWLING: [(&str, f64); 5] =
    [("no-exploits", 0.0), ("upright", 0.0), ("headway", 0.0), ("vibration", -0.2), ("idleness", -5.0)];

const ON_LEGS: [(&str, f64); 7] = [
    ("no-exploits", 0.0),
    ("posture", -1.0),
    ("headway", 0.0),
    ("footfalls", -1.0),
    ("vibration", -0.2),
    ("slip", -1.0),
    ("haste", -0.95),
];

/// Weights of two legs with knees stay small: those that grow large make gaits that fail in other worlds (docs/gaits-experiments.md).
const SMALL_WEIGHTS: [(&str, f64); 2] = [("greatest_growth", 1.0), ("mean_decay", 0.01)];

/// The term that asks for a stride in each turn of the clock.
pub(super) const RHYTHM: &str = "rhythm";

/// The period of the stride of a clock of this one, s: as short in a file as it is meant.
pub(super) fn stride_of(clock: f32) -> f64 {
    f64::from(libm::roundf(1000.0 * clock)) / 1000.0
}

/// As a run, but what is beyond the speed asked for does not count anyway.
pub(super) fn cruising(body: &BodyFacts) -> MovementDefaults {
    let mut defaults = running(body);
    defaults.terms.retain(|term| term.term != "haste");
    defaults
}

pub(super) fn running(body: &BodyFacts) -> MovementDefaults {
    let BodyFacts { legs, joints, .. } = *body;
    let is_biped = (1..=2).contains(&legs);
    // A wave takes its time from head to tail; two legs that skip are quicker.
    let period = match legs {
        0 => 0.8,
        1..=2 => body.pendulum(0.39),
        _ => body.pendulum(0.5),
    };
    let mut on_legs = terms(&ON_LEGS);
    for haste in on_legs.iter_mut().filter(|term| term.term == "haste") {
        // Two legs that hurry fall.
        haste.settings.insert("speed".into(), if legs <= 2 { 1.3.into() } else { 2.2.into() });
    }
    let has_knees = joints > 1;
    // Many legs keep time by themselves. At the weight of the others two legs with knees may learn to go slowly.
    if legs <= 4 {
        let weight = if is_biped && has_knees { -0.5 } else { -1.0 };
        on_legs.push(with(TermSpec::new(RHYTHM, weight), "period", stride_of(body.clock.unwrap_or(period))));
    }
    let strategy = SMALL_WEIGHTS.into_iter().filter(|_| is_biped && has_knees);
    let unknown = MovementDefaults::unknown(body);
    MovementDefaults {
        strategy: strategy.map(|(name, value)| (name.to_owned(), value.into())).collect(),
        steps: STEPS.0,
        training_steps: STEPS.1,
        // Twelve segments that snap to their angles lie still on half of the seeds.
        gain: if legs == 0 { 15.0 } else { unknown.gain },
        terms: if legs == 0 { terms(&CRAWLING) } else { on_legs },
        // Two legs run best if one net moves them both: they skip, the same leg always first, and a skip bears a stumble that
        // an even stride does not.
        modular: (!is_biped).then_some(LimbPhases::Alternating),
        period,
        variation: (legs > 0).then(Variation::bumpy),
        ..unknown
    }
}

pub(super) fn backwards(body: &BodyFacts) -> MovementDefaults {
    let mut defaults = running(body);
    for headway in defaults.terms.iter_mut().filter(|term| term.term == "headway") {
        headway.settings.insert("backwards".into(), true.into());
    }
    defaults
}
