//! Going on with other inputs and outputs.

use crate::{
    ConnectionGene, InnovationNumber, Layout, Neat, NeatGenome, NeatSettings, NodeGene, NodeId,
    innovation::direct_connection,
};
use ne_core::SettingError;
use ne_net::{Copies, TopologyMap};
use std::{cmp::Reverse, sync::Arc};

impl Neat {
    /// Goes on with other settings, on another task, or with other inputs and outputs: the population last told is the
    /// first generation, best first. It is divided into species anew.
    ///
    /// `copies`: those of which the small net is searched for from now on, if one is. `inputs` and `outputs` say for each new one
    /// of the net that is searched for which old one it is. A new input is connected with nothing; a new output
    /// has no connection, and no bias. One that is lost takes its connections with it. All genomes are renumbered alike, so that genes that had the same number have the
    /// same number still, and whatever is invented from now on has a number that was never given.
    ///
    /// # Errors
    /// If a setting is out of range, nets get their bias in another way or may no longer be recurrent, `inputs` or
    /// `outputs` are not of these nets, or a small net is to become a whole one, or a whole one a small one.
    pub fn remapped(
        self,
        settings: NeatSettings,
        copies: Option<Arc<Copies>>,
        inputs: &TopologyMap,
        outputs: &TopologyMap,
    ) -> Result<Self, SettingError> {
        check("inputs", inputs, self.layout.inputs)?;
        check("outputs", outputs, self.layout.outputs)?;
        if copies.is_some() != self.copies.is_some() {
            let told =
                |copies: &Option<Arc<Copies>>| if copies.is_some() { "copies of a small net" } else { "whole nets" };
            return Err(SettingError::new("copies", told(&copies), format!("{}, as before", told(&self.copies))));
        }
        let mut next = match &copies {
            Some(copies) => Self::of_copies(settings, Arc::clone(copies))?,
            None => Self::new(settings, inputs.weight_count(), outputs.weight_count())?,
        };
        let found = [next.layout.inputs, next.layout.outputs];
        for ((field, map), found) in [("inputs", inputs), ("outputs", outputs)].into_iter().zip(found) {
            if map.weight_count() != found {
                let found = format!("to {}", map.weight_count());
                return Err(SettingError::new(field, found, "to as many as the copies have"));
            }
        }
        if next.layout.bias != self.layout.bias {
            let allowed = format!("{:?}, as the nets have it", self.layout.bias);
            return Err(SettingError::new("bias", format!("{:?}", next.layout.bias), allowed));
        }
        if self.layout.recurrent && !next.layout.recurrent {
            return Err(SettingError::new("recurrent", false, "true, as the nets are"));
        }
        let renumbering = Renumbering::new(self.layout, next.layout, inputs, outputs);
        let too_many = || SettingError::new("innovations", "the last number", "less: numbers have run out");
        let next_node = renumbering.hidden(self.innovations.next_node).ok_or_else(too_many)?;
        let next_innovation = renumbering.invented(self.innovations.next_innovation).ok_or_else(too_many)?;
        next.innovations.next_node = next.innovations.next_node.max(next_node);
        next.innovations.next_innovation = next.innovations.next_innovation.max(next_innovation);
        let mut order: Vec<usize> = (0..self.parents.len()).collect();
        order.sort_by_key(|&index| Reverse(self.scores[index]));
        let parents = match order.is_empty() {
            true => self.start.iter().collect(),
            false => order.iter().map(|&index| &self.parents[index]).collect::<Vec<_>>(),
        };
        let activation = next.settings.output_activation;
        let grown = parents.into_iter().map(|parent| renumbering.genome(parent, activation));
        next.start = grown.collect::<Option<_>>().ok_or_else(too_many)?;
        if let Some(copies) = &copies {
            next.start.iter_mut().for_each(|genome| genome.set_copies(copies));
            let most = copies.most_neurons();
            if let Some(found) = next.start.iter().map(|genome| genome.nodes().len()).find(|&found| found > most) {
                let allowed = format!("at most {most} with {} copies of the net", copies.copies.len());
                return Err(SettingError::new("copies", format!("{found} neurons"), allowed));
            }
        }
        next.next_species = self.next_species;
        Ok(next)
    }
}

/// Checks that this is about so many old inputs or outputs.
fn check(field: &str, growth: &TopologyMap, old: usize) -> Result<(), SettingError> {
    match growth.old_weight_count() {
        count if count == old => Ok(()),
        count => Err(SettingError::new(field, format!("from {count}"), format!("from {old}, as the nets have"))),
    }
}

/// What numbers become when inputs and outputs are added or lost.
struct Renumbering {
    old: Layout,
    new: Layout,
    /// For each old input and output its new node; `None`: it is lost.
    inputs: Vec<Option<NodeId>>,
    outputs: Vec<Option<NodeId>>,
}

/// What becomes of a node.
enum Fate {
    Kept(NodeId),
    Lost,
}

impl Renumbering {
    fn new(old: Layout, new: Layout, inputs: &TopologyMap, outputs: &TopologyMap) -> Self {
        let places = |growth: &TopologyMap, first: usize| {
            let place = |old: usize| growth.origins().iter().position(|&origin| origin == Some(old));
            let node = |old: usize| place(old).map(|place| (first + place) as NodeId);
            (0..growth.old_weight_count()).map(node).collect()
        };
        Self { old, new, inputs: places(inputs, 0), outputs: places(outputs, new.sources()) }
    }

    /// What becomes of a node; `None` if numbers have run out.
    fn node(&self, node: NodeId) -> Option<Fate> {
        let (index, sources) = (node as usize, self.old.sources());
        let place = |node: Option<NodeId>| Some(node.map_or(Fate::Lost, Fate::Kept));
        if index < self.old.inputs {
            place(self.inputs[index])
        } else if index < sources {
            Some(Fate::Kept(self.new.inputs as NodeId))
        } else if let Some(&output) = self.outputs.get(index - sources) {
            place(output)
        } else {
            self.hidden(node).map(Fate::Kept)
        }
    }

    /// The new number of a hidden node, or of one to come; `None` if numbers have run out.
    fn hidden(&self, node: NodeId) -> Option<NodeId> {
        (node - self.old.first_hidden()).checked_add(self.new.first_hidden())
    }

    /// The new number of an innovation that is not a connection from an input to an output.
    fn invented(&self, number: InnovationNumber) -> Option<InnovationNumber> {
        let direct = |layout: &Layout| (layout.sources() * layout.outputs) as InnovationNumber;
        (number - direct(&self.old)).checked_add(direct(&self.new))
    }

    /// What becomes of a connection: nothing, if an end of it is lost. `None` if numbers have run out.
    fn connection(&self, gene: &ConnectionGene) -> Option<Option<ConnectionGene>> {
        let (Fate::Kept(from), Fate::Kept(to)) = (self.node(gene.from)?, self.node(gene.to)?) else {
            return Some(None);
        };
        let innovation = match direct_connection(from, to, &self.new) {
            Some(direct) => direct,
            None => self.invented(gene.innovation)?,
        };
        Some(Some(ConnectionGene { innovation, from, to, ..*gene }))
    }

    /// The genome; `None` if numbers have run out.
    fn genome(&self, genome: &NeatGenome, activation: ne_net::Activation) -> Option<NeatGenome> {
        let mut grown = NeatGenome::blank(self.new, None);
        let (nodes, connections) = grown.genes_mut();
        for gene in genome.nodes() {
            if let Fate::Kept(id) = self.node(gene.id)? {
                nodes.push(NodeGene { id, ..*gene });
            }
        }
        let sources = self.new.sources() as NodeId;
        for id in (sources..self.new.first_hidden()).filter(|&id| !self.outputs.contains(&Some(id))) {
            nodes.push(NodeGene { id, activation, bias: 0.0 });
        }
        nodes.sort_by_key(|gene| gene.id);
        for gene in genome.connections() {
            connections.extend(self.connection(gene)?);
        }
        connections.sort_by_key(|gene| gene.innovation);
        Some(grown)
    }
}
