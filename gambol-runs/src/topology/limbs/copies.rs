//! One net for every limb, whose topology is not given: copies of whatever net a search finds.
//!
//! What a copy senses is what a [copy of a given net](super::topology) senses. Where that one has genes for how far the clock of
//! a limb runs ahead, this one senses several clocks: its own, and in bodies of many limbs two that run along the body, one
//! from each end.

use super::{Answers, Limb, Sight, Sights, limbs, sees};
use crate::config::{ControllerSettings, LimbPhases};
use creatures::{Blueprint, Motors, Senses};
use ne_net::{CopiedShape, Copies, CopySense, GraphNeuron, GraphShape, NetCopy};
use std::f32::consts::PI;

/// Limbs at fewer places along the body have no use for a wave: half a turn is all they can be apart.
const PLACES_OF_A_WAVE: usize = 3;

/// Clocks that run along the body: what they are called, and how far they are ahead, in half turns at the front.
const WAVES: [(&str, f32); 2] = [("wave", 1.0), ("counter wave", -1.0)];

/// Copies of a net that is searched for, and what its inputs and outputs are.
pub(crate) struct LimbCopies {
    /// The copies, with the smallest net: outputs that hear every input.
    pub(crate) topology: CopiedShape,
    /// The name of each input of the small net.
    pub(crate) inputs: Vec<String>,
    /// The name of each output of the small net.
    pub(crate) outputs: Vec<String>,
}

/// The copies for a creature: for each limb one of the net that is searched for.
pub(crate) fn copies(
    blueprint: &Blueprint,
    senses: &Senses,
    motors: &Motors,
    controller: &ControllerSettings,
    phases: LimbPhases,
) -> LimbCopies {
    let limbs = limbs(blueprint, senses, phases);
    let answers = Answers::new(phases, blueprint.feet().len(), false);
    let places = places(&limbs);
    let sensed: Vec<Vec<(String, CopySense)>> =
        limbs.iter().map(|limb| senses_of(limb, &sees(limb, senses, answers), places)).collect();
    let mut inputs: Vec<String> = Vec::new();
    for (name, _) in sensed.iter().flatten() {
        if !inputs.contains(name) {
            inputs.push(name.clone());
        }
    }
    // A limb may lack a sense that others have.
    let sense = |sensed: &[(String, CopySense)], name: &String| {
        sensed.iter().find(|(known, _)| known == name).map_or_else(CopySense::default, |(_, sense)| sense.clone())
    };
    let copy = |(limb, sensed): (&Limb, &Vec<(String, CopySense)>)| NetCopy {
        senses: inputs.iter().map(|name| sense(sensed, name)).collect(),
        sign: limb.sign,
    };
    let copies = limbs.iter().zip(&sensed).map(copy).collect();
    let mut outputs: Vec<String> = Vec::new();
    let mut drives = Vec::with_capacity(motors.len());
    for drive in motors.drives() {
        let of = |limb: &Limb| limb.hinges.iter().position(|&hinge| hinge == drive.hinge);
        let Some((index, joint)) = limbs.iter().enumerate().find_map(|(index, limb)| Some((index, of(limb)?))) else {
            continue;
        };
        let name = format!("{}, joint {joint}", limbs[index].kind_name());
        let output = outputs.iter().position(|known| *known == name).unwrap_or_else(|| {
            outputs.push(name);
            outputs.len() - 1
        });
        drives.push((index, output));
    }
    let neuron =
        GraphNeuron { activation: controller.output_activation, bias: true, sources: (0..inputs.len()).collect() };
    let small = GraphShape {
        inputs: inputs.len(),
        recurrent: false,
        neurons: vec![neuron; outputs.len()],
        outputs: (inputs.len()..inputs.len() + outputs.len()).collect(),
    };
    let copies = Copies { inputs: senses.len(), outputs: drives, copies };
    LimbCopies { topology: CopiedShape { small: small.into(), copies: copies.into() }, inputs, outputs }
}

/// At how many places along the body limbs hang.
fn places(limbs: &[Limb]) -> usize {
    let mut places: Vec<f32> = limbs.iter().map(|limb| limb.place).collect();
    places.sort_by(f32::total_cmp);
    places.dedup_by(|one, other| (*one - *other).abs() < 0.01);
    places.len()
}

/// What a limb senses, by name.
fn senses_of(limb: &Limb, sights: &Sights, places: usize) -> Vec<(String, CopySense)> {
    let from = |sources: &[(usize, f32)]| CopySense { constant: 0.0, sources: sources.to_vec() };
    let mut sensed = Sensed(Vec::new());
    if places > 1 {
        sensed.add("place", CopySense { constant: limb.place, sources: Vec::new() });
    }
    for &(input, sight, slot) in &sights.seen {
        let name = &sights.slots[slot];
        match sight {
            Sight::ClockSine | Sight::ClockCosine => {
                let is_sine = sight == Sight::ClockSine;
                sensed.add(name, turned(input, is_sine, limb.phase));
                for (wave, half_turns) in WAVES.iter().filter(|_| places >= PLACES_OF_A_WAVE) {
                    let phase = limb.phase + half_turns * PI * limb.place;
                    sensed.add(&format!("{name}, {wave}"), turned(input, is_sine, phase));
                }
            }
            Sight::Whole | Sight::Foot => sensed.add(name, from(&[(input, 1.0)])),
            Sight::Tilt => {
                sensed.add(name, from(&[(input, 1.0)]));
                sensed.add(&sights.slots[slot + 1], from(&[(input, limb.place)]));
            }
            Sight::Joint => sensed.add(name, from(&[(input, limb.sign)])),
            Sight::Feet(share) => match sensed.0.iter_mut().find(|(known, _)| known == name) {
                Some((_, sense)) => sense.sources.push((input, share)),
                None => sensed.add(name, from(&[(input, share)])),
            },
        }
    }
    sensed.0
}

/// Senses by name.
struct Sensed(Vec<(String, CopySense)>);

impl Sensed {
    /// Adds one. Of several with one name, as sensors of one kind may be, all but the first are numbered.
    fn add(&mut self, name: &str, sense: CopySense) {
        let is_new = |name: &String| !self.0.iter().any(|(known, _)| known == name);
        let numbered = (2..).map(|number| format!("{name} ({number})"));
        let name = std::iter::once(name.to_owned()).chain(numbered).find(is_new);
        self.0.extend(name.map(|name| (name, sense)));
    }
}

/// A clock's sine or cosine, put forward by `phase`; `input` is that of the same before. The cosine follows the sine.
fn turned(input: usize, is_sine: bool, phase: f32) -> CopySense {
    let (sin, cos) = (libm::sinf(phase), libm::cosf(phase));
    let turned = match is_sine {
        true => [(input, cos), (input + 1, sin)],
        false => [(input - 1, -sin), (input, cos)],
    };
    // Half a turn is exact.
    let sources = turned.into_iter().filter(|(_, factor)| factor.abs() > 1e-6).collect();
    CopySense { constant: 0.0, sources }
}

#[cfg(test)]
mod tests;
