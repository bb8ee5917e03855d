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
mod modules;
mod sight;

pub(crate) use copies::{LimbCopies, copies};
use gates::{Gates, SILENCE};
use limb::{Limb, limbs};
use modules::Module;
use sight::{Answers, Sight, Sights, sees};

use crate::config::{ControllerSettings, LimbPhases};
use creatures::{Blueprint, Motors, Senses};
use ne_net::{Activation, GraphNeuron, GraphShape, SharedShape, SharedWeight, Turn};
use std::f32::consts::PI;

/// Genes, each with its factor.
type Terms = Vec<(usize, f32)>;

/// Inputs and neurons that a neuron hears, each with its weight.
type Sources = Vec<(usize, SharedWeight)>;

/// The genes of the copies of one net, handed out in order.
#[derive(Default)]
struct Genes {
    groups: Vec<usize>,
    names: Vec<String>,
    by_hand: Vec<f32>,
}

impl Genes {
    /// New genes that belong together, with these names; the index of the first.
    fn group(&mut self, names: impl IntoIterator<Item = String>) -> usize {
        let first = self.names.len();
        self.names.extend(names);
        let size = self.names.len() - first;
        self.by_hand.resize(self.names.len(), 0.0);
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
    /// What each gene is if it is added to what has been learned without it: 0, but for those of a jump that is made by hand.
    pub(crate) by_hand: Vec<f32>,
}

/// The topology of a controller for this creature: for each limb a copy of one net.
///
/// The last layer sees the hidden neurons alone, if there are any: with fewer genes, and joints that move by the same few
/// signals, searches find gaits much sooner. With a jump clock hidden neurons of their own drive each phase of the jump: see
/// [`gates`].
pub(crate) fn topology(
    blueprint: &Blueprint,
    senses: &Senses,
    motors: &Motors,
    controller: &ControllerSettings,
    phases: LimbPhases,
) -> Limbs {
    let limbs = limbs(blueprint, senses, phases);
    let mut genes = Genes::default();
    let wave = genes.group(["wave".to_owned()]);
    let name_of = |limb: &Limb| &blueprint.parts()[limb.parts[0]].name;
    let offsets = genes.group(limbs.iter().map(|limb| format!("clock of {}", name_of(limb))));
    let kinds = limbs.iter().map(|limb| limb.kind).max().map_or(0, |kind| kind + 1);
    let (mut neurons, mut weights) = (Vec::new(), Vec::new());
    let gates = Gates::add(senses, controller, &mut neurons, &mut weights);
    let mut net = Net { inputs: senses.len(), wave, offsets, neurons, weights, output_of: vec![0; motors.len()] };
    let modules = Module::all(controller.hidden.iter().sum(), gates.as_ref());
    let feet = blueprint.feet().len();
    let of_stride = Answers::new(phases, feet, gates.is_some());
    let answers = [of_stride, of_stride.of_jump(feet)];
    for kind in 0..kinds {
        let copies: Vec<(usize, &Limb)> = limbs.iter().enumerate().filter(|(_, limb)| limb.kind == kind).collect();
        let kind = Kind::new(&copies, &modules, senses, answers, &mut genes);
        if !blueprint.is_legless() && copies[0].1.arm.is_none() {
            kind.jump_by_hand(feet, &mut genes);
        }
        for (place, &(index, limb)) in copies.iter().enumerate() {
            net.add_copy(&kind, place, index, limb, motors, controller);
        }
    }
    let Net { inputs, neurons, weights, output_of, .. } = net;
    let net = GraphShape { inputs, recurrent: false, neurons, outputs: output_of };
    Limbs {
        topology: SharedShape { net: net.into(), groups: genes.groups, weights },
        names: genes.names,
        by_hand: genes.by_hand,
    }
}

/// Limbs that share one net: its genes, and what each limb sees.
struct Kind<'a> {
    modules: &'a [Module],
    /// What each copy sees: of the stride, and of the jump.
    sights: Vec<[Sights; 2]>,
    /// Of each hidden neuron its first gene, and its module.
    hidden: Vec<(usize, Module)>,
    /// Of each joint its first gene.
    joints: Vec<usize>,
}

impl<'a> Kind<'a> {
    fn new(
        copies: &[(usize, &Limb)],
        modules: &'a [Module],
        senses: &Senses,
        answers: [Answers; 2],
        genes: &mut Genes,
    ) -> Self {
        let sights: Vec<[Sights; 2]> =
            copies.iter().map(|(_, limb)| answers.map(|answers| sees(limb, senses, answers))).collect();
        // A copy may lack a sense that another has, but slots are the same in all of them.
        let longest = |which: usize| sights.iter().map(|sights| &sights[which].slots).max_by_key(|slots| slots.len());
        let slots = [0, 1].map(|which| longest(which).map_or(&[][..], Vec::as_slice));
        let kind_name = copies[0].1.kind_name();
        let named = |target: &str, sources: &[String]| -> Vec<String> {
            let own = ["threshold", "place"].into_iter().chain(sources.iter().map(String::as_str));
            own.map(|source| format!("{kind_name}, {target}: {source}")).collect()
        };
        let mut hidden = Vec::new();
        for &module in modules {
            let slots = slots[usize::from(module.phase.is_some())];
            hidden.extend(module.neurons().map(|name| (genes.group(named(&name, slots)), module)));
        }
        let heard: Vec<String> =
            modules.iter().flat_map(Module::neurons).chain(modules.iter().flat_map(Module::thresholds)).collect();
        let heard = if hidden.is_empty() { slots[0] } else { &heard[..] };
        let joint = |joint: usize| genes.group(named(&format!("joint {joint}"), heard));
        let joints = (0..copies[0].1.hinges.len()).map(joint).collect();
        Self { modules, sights, hidden, joints }
    }

    /// Has a leg of a body with so many feet begin with a jump that is made by hand.
    fn jump_by_hand(&self, feet: usize, genes: &mut Genes) {
        let Some(joint) = self.joints.first() else { return };
        let mut own = joint + 2 + self.hidden.len();
        for phase in self.modules.iter().filter_map(|module| module.phase) {
            genes.by_hand[own..own + 2].copy_from_slice(&phase.by_hand(feet));
            own += 2;
        }
    }

    /// The joint whose genes begin at `first`: its threshold, and what it hears of the hidden neurons.
    fn joint(&self, first: usize, hidden: &[usize], limb: &Limb) -> (Terms, Sources) {
        let (sign, by_place) = (limb.sign, limb.sign * limb.place);
        let heard = (first + 2..).zip(hidden).map(|(gene, &node)| (node, SharedWeight::Sum(vec![(gene, sign)])));
        let mut sources: Sources = heard.collect();
        let mut thresholds = vec![(first, sign), (first + 1, by_place)];
        let (mut neurons, mut own) = (first + 2, first + 2 + hidden.len());
        for module in self.modules {
            let threshold = if module.phase.is_some() { own } else { first };
            if module.phase.is_some() {
                thresholds.extend([(own, sign), (own + 1, by_place)]);
                own += 2;
            }
            let of_module = neurons..neurons + module.hidden;
            neurons += module.hidden;
            // A neuron that is silenced puts out 1; it is to count as 0, and so is the threshold of its module.
            let Some(gate) = module.silenced_by else { continue };
            let mut terms: Terms = of_module.map(|gene| (gene, -sign)).collect();
            terms.extend([(threshold, -sign), (threshold + 1, -by_place)]);
            sources.push((gate, SharedWeight::Sum(terms)));
        }
        (thresholds, sources)
    }
}

/// The net while copies are added to it.
struct Net {
    inputs: usize,
    /// The gene of the wave along the body, and the first of the limbs' phases.
    wave: usize,
    offsets: usize,
    neurons: Vec<GraphNeuron>,
    weights: Vec<SharedWeight>,
    /// The neuron of each motor.
    output_of: Vec<usize>,
}

impl Net {
    /// Adds the copy of a kind for one of its limbs; `index`: which limb of the body it is.
    fn add_copy(
        &mut self,
        kind: &Kind<'_>,
        place: usize,
        index: usize,
        limb: &Limb,
        motors: &Motors,
        controller: &ControllerSettings,
    ) {
        let [of_stride, of_jump] = &kind.sights[place];
        let mut nodes = Vec::with_capacity(kind.hidden.len());
        for &(first, module) in &kind.hidden {
            let mut sources =
                self.seen(if module.phase.is_some() { of_jump } else { of_stride }, first, 1.0, index, limb);
            sources.extend(module.silenced_by.map(|gate| (gate, SharedWeight::fixed(SILENCE))));
            let threshold = vec![(first, 1.0), (first + 1, limb.place)];
            nodes.push(self.add(controller.hidden_activation, threshold, sources));
        }
        for (joint, &first) in kind.joints.iter().enumerate() {
            let sign = limb.sign;
            let (threshold, mut sources) = kind.joint(first, &nodes, limb);
            if nodes.is_empty() {
                sources = self.seen(of_stride, first, sign, index, limb);
            }
            let node = self.add(controller.output_activation, threshold, sources);
            if let Some(output) = motors.drives().iter().position(|drive| drive.hinge == limb.hinges[joint]) {
                self.output_of[output] = node;
            }
        }
    }

    /// What a neuron whose genes begin at `first` sees, with the weights.
    fn seen(&self, sights: &Sights, first: usize, sign: f32, index: usize, limb: &Limb) -> Sources {
        let turn = |gene: usize| Turn {
            genes: [gene, gene + 1],
            factor: sign,
            phase: limb.phase,
            phase_genes: vec![(self.wave, PI * limb.place), (self.offsets + index, 1.0)],
        };
        let source = |&(input, sight, slot): &(usize, Sight, usize)| {
            let gene = first + 2 + slot;
            let weight = match sight {
                Sight::ClockSine => SharedWeight::Sine(turn(gene)),
                Sight::ClockCosine => SharedWeight::Cosine(turn(gene - 1)),
                Sight::Joint => SharedWeight::Sum(vec![(gene, sign * limb.sign)]),
                Sight::Whole | Sight::Foot => SharedWeight::Sum(vec![(gene, sign)]),
                Sight::Tilt => SharedWeight::Sum(vec![(gene, sign), (gene + 1, sign * limb.place)]),
                Sight::Feet(share) => SharedWeight::Sum(vec![(gene, sign * share)]),
            };
            (input, weight)
        };
        sights.seen.iter().map(source).collect()
    }

    /// Adds a neuron; its index among inputs and neurons.
    fn add(&mut self, activation: Activation, threshold: Terms, sources: Sources) -> usize {
        let (sources, weights): (Vec<usize>, Vec<SharedWeight>) = sources.into_iter().unzip();
        self.weights.push(SharedWeight::Sum(threshold));
        self.weights.extend(weights);
        self.neurons.push(GraphNeuron { activation, bias: true, sources });
        self.inputs + self.neurons.len() - 1
    }
}

#[cfg(test)]
mod tests;
