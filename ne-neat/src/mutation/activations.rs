//! Hidden neurons get other activations.

use crate::NeatGenome;
use ne_core::RandomStream;
use ne_net::Activation;
use rand::RngExt;

/// Gives a hidden neuron another one of the activations to choose from.
pub(super) fn change_one(genome: &mut NeatGenome, choices: &[Activation], stream: &mut RandomStream) {
    let outputs = genome.layout().outputs;
    let hidden = &mut genome.genes_mut().0[outputs..];
    if hidden.is_empty() {
        return;
    }
    let index = stream.random_range(0..hidden.len());
    let neuron = &mut hidden[index];
    let others = choices.iter().filter(|&&choice| choice != neuron.activation);
    let count = others.clone().count();
    if count > 0 {
        neuron.activation = others.copied().nth(stream.random_range(0..count)).unwrap_or(neuron.activation);
    }
}
