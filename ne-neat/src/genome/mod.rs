//! The genome: genes of neurons and of connections.

mod check;
mod express;
mod genes;
pub(crate) mod graph;
mod layout;

pub use check::GenomeError;
pub use genes::{ConnectionGene, InnovationNumber, NodeGene};
pub use layout::{BiasKind, Layout, NodeId, NodeKind};

use check::UncheckedGenome;
use ne_net::{Copies, GraphShape};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// Genes of neurons and connections: a net whose topology evolves.
///
/// Neurons stand in the order of their numbers, so outputs come first; connections in the order of their innovation
/// numbers. Between two nodes there is at most one connection in each direction; none leads to an input or the bias
/// node; unless the [layout](Layout) is recurrent, connections form no cycle, disabled ones included.
///
/// [`express`](ne_core::Genome::express) builds the net: disabled connections are left out, and so are hidden neurons
/// from which no way leads to an output. With [copies](Self::copies) the net that evolves is a small one, of one limb, say,
/// and what is built is the whole.
///
/// Copies of an individual share their genes until one of them changes.
///
/// In JSON: `{"layout": {"inputs": 2, "outputs": 1, "bias": "input-node", "recurrent": false}, "nodes": [{"id": 3,
/// "activation": "tanh", "bias": 0}], "connections": [{"innovation": 0, "from": 0, "to": 3, "weight": 0.5, "enabled":
/// true}]}`, and `"copies": {…}` if there are any. Reading checks all of the above.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "UncheckedGenome")]
pub struct NeatGenome {
    layout: Layout,
    nodes: Arc<Vec<NodeGene>>,
    connections: Arc<Vec<ConnectionGene>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    copies: Option<Arc<Copies>>,
}

impl NeatGenome {
    /// A genome.
    ///
    /// # Errors
    /// If it is not as described above; the error names the gene.
    pub fn new(layout: Layout, nodes: Vec<NodeGene>, connections: Vec<ConnectionGene>) -> Result<Self, GenomeError> {
        Self::unchecked(layout, nodes, connections, None).checked()
    }

    /// The same genes for the small net of these copies.
    ///
    /// # Errors
    /// If the small net of these copies has other numbers of inputs or outputs, or there are too many neurons.
    pub fn with_copies(self, copies: Arc<Copies>) -> Result<Self, GenomeError> {
        Self { copies: Some(copies), ..self }.checked()
    }

    fn checked(self) -> Result<Self, GenomeError> {
        self.check()?;
        Ok(self)
    }

    /// A genome without genes, which is not yet a valid one: memory to write one into.
    pub(crate) fn blank(layout: Layout, copies: Option<Arc<Copies>>) -> Self {
        Self::unchecked(layout, Vec::new(), Vec::new(), copies)
    }

    fn unchecked(
        layout: Layout,
        nodes: Vec<NodeGene>,
        connections: Vec<ConnectionGene>,
        copies: Option<Arc<Copies>>,
    ) -> Self {
        Self { layout, nodes: Arc::new(nodes), connections: Arc::new(connections), copies }
    }

    /// Becomes a copy of an individual of the same run, in its own memory unless that is shared.
    pub(crate) fn copy_from(&mut self, other: &Self) {
        copy_genes(&mut self.nodes, &other.nodes);
        copy_genes(&mut self.connections, &other.connections);
    }

    /// The inputs and outputs, and what kind of nets these are.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// The copies that make up the whole net; `None`: the net is the whole.
    pub fn copies(&self) -> Option<&Arc<Copies>> {
        self.copies.as_ref()
    }

    pub(crate) fn set_copies(&mut self, copies: &Arc<Copies>) {
        self.copies = Some(Arc::clone(copies));
    }

    /// The most neurons that it may have.
    pub(crate) fn most_neurons(&self) -> usize {
        self.copies.as_ref().map_or(GraphShape::MAX_NEURONS, |copies| copies.most_neurons())
    }

    /// The genes of the neurons, in order of their numbers.
    pub fn nodes(&self) -> &[NodeGene] {
        &self.nodes
    }

    /// The genes of the connections, in order of their innovation numbers.
    pub fn connections(&self) -> &[ConnectionGene] {
        &self.connections
    }

    /// The number of hidden neurons, whether they lead to an output or not.
    pub fn hidden_count(&self) -> usize {
        self.nodes.len() - self.layout.outputs
    }

    /// The number of connections that are not disabled.
    pub fn enabled_count(&self) -> usize {
        self.connections.iter().filter(|gene| gene.enabled).count()
    }

    /// Whether it has this hidden neuron or output.
    pub(crate) fn has_neuron(&self, node: NodeId) -> bool {
        self.nodes.binary_search_by_key(&node, |gene| gene.id).is_ok()
    }

    /// The index of the gene of a neuron that the genome has; `None` for inputs and the bias node.
    pub(crate) fn neuron_index(&self, node: NodeId) -> Option<usize> {
        let index = (node as usize).checked_sub(self.layout.sources())?;
        // Outputs stand first.
        let is_output = index < self.layout.outputs;
        Some(if is_output { index } else { self.nodes.partition_point(|gene| gene.id < node) })
    }

    /// Both kinds of genes, to be changed.
    pub(crate) fn genes_mut(&mut self) -> (&mut Vec<NodeGene>, &mut Vec<ConnectionGene>) {
        (Arc::make_mut(&mut self.nodes), Arc::make_mut(&mut self.connections))
    }

    /// Adds a connection that the genome does not have yet.
    pub(crate) fn insert_connection(&mut self, gene: ConnectionGene) {
        let place = self.connections.partition_point(|other| other.innovation < gene.innovation);
        insert_gene(&mut self.connections, place, gene);
    }

    /// Adds a neuron that the genome does not have yet.
    pub(crate) fn insert_node(&mut self, gene: NodeGene) {
        let place = self.nodes.partition_point(|other| other.id < gene.id);
        insert_gene(&mut self.nodes, place, gene);
    }
}

fn copy_genes<T: Clone>(to: &mut Arc<Vec<T>>, from: &Arc<Vec<T>>) {
    match Arc::get_mut(to) {
        Some(own) => own.clone_from(from),
        None => *to = Arc::clone(from),
    }
}

/// Large populations have no room for genes that may come one day: the memory grows by a few at a time.
fn insert_gene<T: Clone>(genes: &mut Arc<Vec<T>>, place: usize, gene: T) {
    let genes = Arc::make_mut(genes);
    if genes.len() == genes.capacity() {
        genes.reserve_exact(4);
    }
    genes.insert(place, gene);
}
