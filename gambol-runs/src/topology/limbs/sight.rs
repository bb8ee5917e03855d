//! What a limb sees of what a body senses.

use super::limb::Limb;
use crate::config::LimbPhases;
use creatures::{Senses, Source};

/// What a copy of the net sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Sight {
    /// The sine of a clock whose cosine is the next input.
    ClockSine,
    ClockCosine,
    /// Something of the whole body.
    Whole,
    /// How the body tilts, or that it jumps, where limbs before and behind have to answer differently: its next slot is the answer's share
    /// that goes with the place of the limb.
    Tilt,
    /// The sign of a limb's joints goes with it.
    Joint,
    Foot,
    /// All feet as one, each of them so much of it.
    Feet(f32),
}

/// What a limb sees.
#[derive(Default)]
pub(super) struct Sights {
    /// Inputs, each with its slot: the same sense has the same slot in every limb of a kind.
    pub(super) seen: Vec<(usize, Sight, usize)>,
    /// The name of each slot.
    pub(super) slots: Vec<String>,
}

fn by_place(name: &str) -> String {
    format!("{name}, by place")
}

impl Sights {
    /// So many new slots; the first of them.
    fn add<N: IntoIterator<Item = String>>(&mut self, names: N) -> usize {
        let first = self.slots.len();
        self.slots.extend(names);
        first
    }
}

/// A body with more feet than these has many. They all come down at another moment, so legs that act together feel the mean: each would
/// fall out of step if it answered its own.
pub(super) const MOST_OF_FEW_FEET: usize = 4;

/// How a limb answers what is felt of the whole body.
#[derive(Clone, Copy, Debug)]
pub(super) struct Answers {
    /// Whether limbs before and behind answer how the body tilts differently.
    pub(super) tilt_by_place: bool,
    /// How many feet there are, if they are felt as one.
    pub(super) feet_as_one: Option<usize>,
    /// Whether the clock of the stride is none of its business.
    pub(super) deaf_to_stride: bool,
    /// Whether jump clocks are none of its business: gates hear them.
    pub(super) gated: bool,
}

impl Answers {
    /// Of limbs with these phases.
    pub(super) fn new(phases: LimbPhases, feet: usize, gated: bool) -> Self {
        let together = phases == LimbPhases::Together;
        let feet_as_one = (together && feet > MOST_OF_FEW_FEET).then_some(feet);
        Self { tilt_by_place: together, feet_as_one, deaf_to_stride: false, gated }
    }

    /// In a jump all legs do the same: those before and behind the middle answer a tilt each in their way. Of many legs it does not
    /// matter which is where in its stride, and without it a net of ten is a tenth smaller.
    pub(super) fn of_jump(self, feet: usize) -> Self {
        Self { tilt_by_place: true, deaf_to_stride: feet > MOST_OF_FEW_FEET, ..self }
    }
}

/// What a limb sees of what is sensed.
pub(super) fn sees(limb: &Limb, senses: &Senses, answers: Answers) -> Sights {
    let mut sights = Sights::default();
    let (mut angles, mut speeds, mut feet, mut slips) = (None, None, None, None);
    for (input, (probe, channel)) in senses.probes().iter().zip(senses.channels()).enumerate() {
        let joints = |what: &str| (0..limb.hinges.len()).map(|joint| format!("{what} of joint {joint}")).collect();
        let place_of = |hinge: usize| limb.hinges.iter().position(|&mine| mine == hinge);
        let sight = match probe.source {
            Source::JointAngle(hinge) => {
                let first = *angles.get_or_insert_with(|| sights.add::<Vec<_>>(joints("angle")));
                place_of(hinge).map(|joint| (Sight::Joint, first + joint))
            }
            Source::JointSpeed(hinge) => {
                let first = *speeds.get_or_insert_with(|| sights.add::<Vec<_>>(joints("speed")));
                place_of(hinge).map(|joint| (Sight::Joint, first + joint))
            }
            // Arms have no feet.
            Source::Contact(_) | Source::Slip(_) if limb.arm.is_some() => None,
            Source::Contact(_) if answers.feet_as_one.is_some() => {
                let slot = *feet.get_or_insert_with(|| sights.add(["contact of feet".to_owned()]));
                answers.feet_as_one.map(|feet| (Sight::Feet(1.0 / feet as f32), slot))
            }
            Source::Contact(part) => {
                let slot = *feet.get_or_insert_with(|| sights.add(["contact of foot".to_owned()]));
                limb.parts.contains(&part).then_some((Sight::Foot, slot))
            }
            Source::Slip(part) => {
                let slot = *slips.get_or_insert_with(|| sights.add(["slip of foot".to_owned()]));
                limb.parts.contains(&part).then_some((Sight::Foot, slot))
            }
            Source::StrideSine { .. } | Source::StrideCosine { .. } if answers.deaf_to_stride => None,
            Source::ClockSine { .. } | Source::LandingSine { .. } | Source::StrideSine { .. } => {
                Some((Sight::ClockSine, sights.add([channel.name.clone()])))
            }
            Source::ClockCosine { .. } | Source::LandingCosine { .. } | Source::StrideCosine { .. } => {
                Some((Sight::ClockCosine, sights.add([channel.name.clone()])))
            }
            Source::TorsoRotation | Source::TorsoSpin if answers.tilt_by_place => {
                Some((Sight::Tilt, sights.add([channel.name.clone(), by_place(&channel.name)])))
            }
            Source::JumpSine { .. } | Source::JumpSwell { .. } => match answers.gated {
                true => None,
                false => Some((Sight::Tilt, sights.add([channel.name.clone(), by_place(&channel.name)]))),
            },
            _ => Some((Sight::Whole, sights.add([channel.name.clone()]))),
        };
        sights.seen.extend(sight.map(|(sight, slot)| (input, sight, slot)));
    }
    sights
}
