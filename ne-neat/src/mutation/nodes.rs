//! Hidden neurons are deleted.

use crate::NeatGenome;
use ne_core::RandomStream;
use rand::RngExt;

/// Deletes a hidden neuron with its connections, and hidden neurons that have no others.
pub(super) fn delete_one(genome: &mut NeatGenome, stream: &mut RandomStream) {
    let outputs = genome.layout().outputs;
    let (nodes, connections) = genome.genes_mut();
    if nodes.len() == outputs {
        return;
    }
    let deleted = nodes.remove(stream.random_range(outputs..nodes.len())).id;
    connections.retain(|connection| !connection.touches(deleted));
    let mut index = 0;
    nodes.retain(|node| {
        index += 1;
        index <= outputs || connections.iter().any(|connection| connection.touches(node.id))
    });
}
