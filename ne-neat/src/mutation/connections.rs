//! Connections are enabled, disabled and deleted.

use super::one_of;
use crate::{ConnectionGene, NeatGenome};
use ne_core::RandomStream;
use rand::RngExt;

/// Enables one of the disabled connections, or disables one of the enabled ones.
pub(super) fn switch_one(genome: &mut NeatGenome, enabled: bool, stream: &mut RandomStream) {
    let connections = genome.genes_mut().1;
    if let Some(index) = one_of(connections, |gene: &ConnectionGene| gene.enabled != enabled, stream) {
        connections[index].enabled = enabled;
    }
}

/// Deletes a connection, and hidden neurons that have no other.
pub(super) fn delete_one(genome: &mut NeatGenome, stream: &mut RandomStream) {
    let first_hidden = genome.layout().first_hidden();
    let (nodes, connections) = genome.genes_mut();
    if connections.is_empty() {
        return;
    }
    let deleted = connections.remove(stream.random_range(0..connections.len()));
    nodes.retain(|node| {
        node.id < first_hidden
            || !deleted.touches(node.id)
            || connections.iter().any(|connection| connection.touches(node.id))
    });
}
