//! One small net for every limb: the topology of controllers whose limbs share what they learn.
//!
//! A body repeats itself: ten legs are ten times the same leg. Searched for separately, ten legs must each learn to walk,
//! and then to walk together; that is what decapods never managed. Here every limb has a copy of the same net, which
//! sees what belongs to its limb (its joints, its foot) and what belongs to the whole body (the torso, a clock). The
//! copies differ in two ways, each with genes of its own: the clock runs ahead by another phase in each limb, and where
//! along the body a limb hangs shifts its thresholds.

mod copies;
mod gates;
mod limb;

pub(crate) use copies::{LimbCopies, copies};
use gates::{Gates, SILENCE};
use limb::{Limb, limbs};

use crate::config::{ControllerSettings, LimbPhases};
use creatures::{Blueprint, Motors, Senses, Source};
use ne_net::{GraphNeuron, GraphShape, SharedShape, SharedWeight, Turn};
use std::f32::consts::PI;

/// What a copy of the net sees.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Sight {
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

/// Hidden neurons of a limb that have the body together.
#[derive(Clone, Copy, Debug)]
struct Module {
    /// What they are called in the names of genes.
    name: &'static str,
    /// The gate that is open while it is not their turn.
    silenced_by: Option<usize>,
    /// Whether they hear jump clocks.
    jumps: bool,
}

impl Module {
    fn neuron(&self, index: usize) -> String {
        format!("{} {index}", self.name)
    }
}

/// The genes of the copies of one net, handed out in order.
#[derive(Default)]
struct Genes {
    groups: Vec<usize>,
    names: Vec<String>,
}

impl Genes {
    /// New genes that belong together, with these names; the index of the first.
    fn group(&mut self, names: impl IntoIterator<Item = String>) -> usize {
        let first = self.names.len();
        self.names.extend(names);
        let size = self.names.len() - first;
        if size > 0 {
            self.groups.push(size);
        }
        first
    }
}

/// A topology of limbs, and what each of its genes is for.
pub(crate) struct Limbs {
    /// The topology.
    pub(crate) topology: SharedShape,
    /// The name of each gene: equal names in two topologies mean the same, whatever else is in them.
    pub(crate) names: Vec<String>,
}

/// The topology of a controller for this creature: for each limb a copy of one net.
///
/// The last layer sees the hidden neurons alone, if there are any: with fewer genes, and joints that move by the same few
/// signals, searches find gaits much sooner. A jump clock it sees as well. With one, hidden neurons of their own drive the jump:
/// see [`gates`].
pub(crate) fn topology(
    blueprint: &Blueprint,
    senses: &Senses,
    motors: &Motors,
    controller: &ControllerSettings,
    phases: LimbPhases,
) -> Limbs {
    let limbs = limbs(blueprint, senses, phases);
    let hidden: usize = controller.hidden.iter().sum();
    let mut genes = Genes::default();
    let wave = genes.group(["wave".to_owned()]);
    let name_of = |limb: &Limb| &blueprint.parts()[limb.parts[0]].name;
    let offsets = genes.group(limbs.iter().map(|limb| format!("clock of {}", name_of(limb))));
    let kinds = limbs.iter().map(|limb| limb.kind).max().map_or(0, |kind| kind + 1);
    let mut neurons = Vec::new();
    let mut weights = Vec::new();
    let mut output_of = vec![0; motors.len()];
    let inputs = senses.len();
    let together = (phases == LimbPhases::Together).then(|| blueprint.feet().len());
    let gates = Gates::add(senses, controller, &mut neurons, &mut weights);
    // Which hidden neurons there are, what silences them, and whether they hear jump clocks.
    let modules = match gates {
        None => vec![Module { name: "hidden", silenced_by: None, jumps: false }],
        Some(Gates { jumping, striding }) => vec![
            Module { name: "hidden", silenced_by: Some(jumping), jumps: false },
            Module { name: "jump hidden", silenced_by: Some(striding), jumps: true },
        ],
    };
    for kind in 0..kinds {
        let copies: Vec<(usize, &Limb)> = limbs.iter().enumerate().filter(|(_, limb)| limb.kind == kind).collect();
        let (joints, kind_name) = (copies[0].1.hinges.len(), copies[0].1.kind_name());
        let sights: Vec<Sights> =
            copies.iter().map(|(_, limb)| sees(limb, senses, together, gates.is_some())).collect();
        // A copy may lack a sense that another has, but slots are the same in all of them.
        let longest = sights.iter().max_by_key(|sights| sights.slots.len());
        let slots = longest.map_or(&[][..], |sights| &sights.slots);
        let jumps = longest.map_or(&[][..], |sights| &sights.jumps);
        let jumps = jumps.iter().map(|&input| &senses.channels()[input].name);
        let jumps: Vec<String> = jumps.flat_map(|name| [name.clone(), by_place(name)]).collect();
        let neuron = |target: &str, more: &[String]| {
            let own = ["threshold", "place"].into_iter().chain(slots.iter().chain(more).map(String::as_str));
            own.map(|source| format!("{kind_name}, {target}: {source}")).collect::<Vec<_>>()
        };
        let hears = |joint: usize| {
            let target = format!("joint {joint}");
            if hidden == 0 {
                return neuron(&target, &[]);
            }
            let heard = modules.iter().flat_map(|module| (0..hidden).map(|index| module.neuron(index)));
            let of_jump = gates.iter().flat_map(|_| ["jump threshold", "jump place"].map(str::to_owned));
            let sources = ["threshold", "place"].into_iter().map(str::to_owned).chain(heard).chain(of_jump);
            let sources = sources.chain(jumps.clone());
            sources.map(|source| format!("{kind_name}, {target}: {source}")).collect()
        };
        let mut hidden_genes: Vec<(usize, Module)> = Vec::new();
        for &module in &modules {
            let more = if module.jumps { &jumps[..] } else { &[] };
            hidden_genes.extend((0..hidden).map(|index| (genes.group(neuron(&module.neuron(index), more)), module)));
        }
        let output_genes: Vec<usize> = (0..joints).map(|joint| genes.group(hears(joint))).collect();
        for ((limb_index, limb), Sights { seen, jumps, .. }) in copies.iter().zip(&sights) {
            let turn = |gene: usize, factor| Turn {
                genes: [gene, gene + 1],
                factor,
                phase: limb.phase,
                phase_genes: vec![(wave, PI * limb.place), (offsets + limb_index, 1.0)],
            };
            // The sources of a neuron whose genes begin at `first`, with their weights.
            let threshold =
                |first: usize, sign: f32| SharedWeight::Sum(vec![(first, sign), (first + 1, sign * limb.place)]);
            let sees = |first: usize, sign: f32| {
                let source = move |&(input, sight, slot): &(usize, Sight, usize)| {
                    let gene = first + 2 + slot;
                    let weight = match sight {
                        Sight::ClockSine => SharedWeight::Sine(turn(gene, sign)),
                        Sight::ClockCosine => SharedWeight::Cosine(turn(gene - 1, sign)),
                        Sight::Joint => SharedWeight::Sum(vec![(gene, sign * limb.sign)]),
                        Sight::Whole | Sight::Foot => SharedWeight::Sum(vec![(gene, sign)]),
                        Sight::Tilt => SharedWeight::Sum(vec![(gene, sign), (gene + 1, sign * limb.place)]),
                        Sight::Feet(share) => SharedWeight::Sum(vec![(gene, sign * share)]),
                    };
                    (input, weight)
                };
                seen.iter().map(source).collect::<Vec<_>>()
            };
            let hears_jumps = |first: usize, sign: f32| {
                (first..).step_by(2).zip(jumps).map(move |(gene, &input)| {
                    (input, SharedWeight::Sum(vec![(gene, sign), (gene + 1, sign * limb.place)]))
                })
            };
            let mut add = |activation, threshold: SharedWeight, sources: Vec<(usize, SharedWeight)>| {
                let (sources, weighed): (Vec<usize>, Vec<SharedWeight>) = sources.into_iter().unzip();
                weights.push(threshold);
                weights.extend(weighed);
                neurons.push(GraphNeuron { activation, bias: true, sources });
                inputs + neurons.len() - 1
            };
            let mut hidden_nodes = Vec::with_capacity(hidden_genes.len());
            for &(first, module) in &hidden_genes {
                let mut sources = sees(first, 1.0);
                if module.jumps {
                    sources.extend(hears_jumps(first + 2 + slots.len(), 1.0));
                }
                sources.extend(module.silenced_by.map(|gate| (gate, SharedWeight::fixed(SILENCE))));
                hidden_nodes.push(add(controller.hidden_activation, threshold(first, 1.0), sources));
            }
            for (joint, &first) in output_genes.iter().enumerate() {
                let sign = limb.sign;
                let mut sources: Vec<(usize, SharedWeight)> = match hidden {
                    0 => sees(first, sign),
                    _ => {
                        let heard = (first + 2..).zip(&hidden_nodes);
                        heard.map(|(gene, &node)| (node, SharedWeight::Sum(vec![(gene, sign)]))).collect()
                    }
                };
                // A neuron that is silenced puts out 1; it is to count as 0. And the jump has thresholds of its own.
                let own = first + 2 + hidden_nodes.len();
                for (number, module) in modules.iter().enumerate() {
                    let Some(gate) = module.silenced_by else { continue };
                    let silenced = first + 2 + number * hidden;
                    let mut terms: Vec<(usize, f32)> =
                        (silenced..silenced + hidden).map(|gene| (gene, -sign)).collect();
                    if !module.jumps {
                        let by_place = sign * limb.place;
                        terms.extend([(first, -sign), (first + 1, -by_place), (own, sign), (own + 1, by_place)]);
                    }
                    sources.push((gate, SharedWeight::Sum(terms)));
                }
                if hidden > 0 {
                    sources.extend(hears_jumps(if gates.is_some() { own + 2 } else { own }, sign));
                }
                let node = add(controller.output_activation, threshold(first, sign), sources);
                if let Some(output) = motors.drives().iter().position(|drive| drive.hinge == limb.hinges[joint]) {
                    output_of[output] = node;
                }
            }
        }
    }
    let net = GraphShape { inputs, recurrent: false, neurons, outputs: output_of };
    Limbs { topology: SharedShape { net: net.into(), groups: genes.groups, weights }, names: genes.names }
}

/// What a limb sees.
#[derive(Default)]
struct Sights {
    /// Inputs, each with its slot: the same sense has the same slot in every limb of a kind.
    seen: Vec<(usize, Sight, usize)>,
    /// The name of each slot.
    slots: Vec<String>,
    /// The inputs of jump clocks.
    jumps: Vec<usize>,
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

/// Of more feet than these, which all come down at another moment, legs that act together feel the mean: each would fall out
/// of step if it answered its own.
const FEET_FELT_ALONE: usize = 4;

/// What a limb sees of what is sensed; `together`: how many feet there are, if all legs act together.
fn sees(limb: &Limb, senses: &Senses, together: Option<usize>, gated: bool) -> Sights {
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
            Source::Contact(_) if together.is_some_and(|feet| feet > FEET_FELT_ALONE) => {
                let slot = *feet.get_or_insert_with(|| sights.add(["contact of feet".to_owned()]));
                together.map(|feet| (Sight::Feet(1.0 / feet as f32), slot))
            }
            Source::Contact(part) => {
                let slot = *feet.get_or_insert_with(|| sights.add(["contact of foot".to_owned()]));
                limb.parts.contains(&part).then_some((Sight::Foot, slot))
            }
            Source::Slip(part) => {
                let slot = *slips.get_or_insert_with(|| sights.add(["slip of foot".to_owned()]));
                limb.parts.contains(&part).then_some((Sight::Foot, slot))
            }
            Source::ClockSine { .. } | Source::LandingSine { .. } | Source::StrideSine { .. } => {
                Some((Sight::ClockSine, sights.add([channel.name.clone()])))
            }
            Source::ClockCosine { .. } | Source::LandingCosine { .. } | Source::StrideCosine { .. } => {
                Some((Sight::ClockCosine, sights.add([channel.name.clone()])))
            }
            Source::TorsoRotation | Source::TorsoSpin if together.is_some() => {
                Some((Sight::Tilt, sights.add([channel.name.clone(), by_place(&channel.name)])))
            }
            Source::JumpSine { .. } | Source::JumpSwell { .. } => {
                sights.jumps.push(input);
                match gated {
                    true => None,
                    false => Some((Sight::Tilt, sights.add([channel.name.clone(), by_place(&channel.name)]))),
                }
            }
            _ => Some((Sight::Whole, sights.add([channel.name.clone()]))),
        };
        sights.seen.extend(sight.map(|(sight, slot)| (input, sight, slot)));
    }
    sights
}

#[cfg(test)]
mod tests;
