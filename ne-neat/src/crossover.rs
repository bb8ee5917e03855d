//! A child of two genomes.

use crate::{ConnectionGene, NeatGenome, NodeGene, genome::graph::is_cyclic, noise::happens};
use ne_core::{RandomStream, SettingError};
use rand::Rng;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// How the genes of two parents become those of a child.
///
/// Genes are aligned by innovation number. A matching gene comes from one of the parents at random, or is the mean of
/// both; disjoint and excess genes come from the fitter parent. If both are equally fit, each disjoint and excess gene
/// of either is inherited or not at random (figure 4 of the paper); a gene that would double a connection is then left
/// out, and if a cycle came about where none may be, those of the second parent are.
///
/// Hidden neurons come with the connections that lead to or from them; the gene of one that both parents have is either's
/// at random, or their mean.
///
/// Source: Stanley & Miikkulainen, 2002, sections 3.2 and 4.1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Crossover {
    /// The share of crossovers in which matching genes get the mean of the parents' weights, from 0 to 1; 0 in the paper.
    pub averaging: f64,
    /// The probability that an inherited gene is disabled if it is in either parent, from 0 to 1; 0.75 in the paper. It
    /// is enabled otherwise.
    pub stays_disabled: f64,
}

impl Crossover {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("averaging", self.averaging, 0.0, 1.0)?;
        SettingError::check_range("stays_disabled", self.stays_disabled, 0.0, 1.0)
    }

    /// Writes the child of two parents; `fitness` compares the first's with the second's.
    pub(crate) fn cross(
        &self,
        first: &NeatGenome,
        second: &NeatGenome,
        fitness: Ordering,
        child: &mut NeatGenome,
        stream: &mut RandomStream,
    ) {
        let (fitter, other) = if fitness == Ordering::Less { (second, first) } else { (first, second) };
        let pick = if happens(self.averaging, stream) { Pick::Mean } else { Pick::Either };
        if fitness == Ordering::Equal {
            self.inherit_from_both(fitter, other, pick, child, stream);
            if child.layout().recurrent || !is_cyclic(child) {
                return;
            }
        }
        self.inherit_from_fitter(fitter, other, pick, child, stream);
    }

    fn inherit_from_fitter(
        &self,
        fitter: &NeatGenome,
        other: &NeatGenome,
        pick: Pick,
        child: &mut NeatGenome,
        stream: &mut RandomStream,
    ) {
        let (nodes, connections) = child.genes_mut();
        connections.clear();
        align(
            fitter.connections(),
            other.connections(),
            |gene| gene.innovation,
            |pair| {
                if let Some(gene) = pair.0 {
                    connections.push(self.inherit(gene, pair.1, pick, stream));
                }
            },
        );
        nodes.clear();
        align(
            fitter.nodes(),
            other.nodes(),
            |gene| gene.id,
            |pair| {
                if let Some(gene) = pair.0 {
                    nodes.push(pick.node(gene, pair.1, stream));
                }
            },
        );
    }

    fn inherit_from_both(
        &self,
        first: &NeatGenome,
        second: &NeatGenome,
        pick: Pick,
        child: &mut NeatGenome,
        stream: &mut RandomStream,
    ) {
        let first_hidden = child.layout().first_hidden();
        let (nodes, connections) = child.genes_mut();
        connections.clear();
        align(
            first.connections(),
            second.connections(),
            |gene| gene.innovation,
            |pair| match pair {
                (Some(gene), Some(other)) => connections.push(self.inherit(gene, Some(other), pick, stream)),
                (Some(gene), None) | (None, Some(gene)) => {
                    let is_double = |other: &ConnectionGene| (other.from, other.to) == (gene.from, gene.to);
                    if happens(0.5, stream) && !connections.iter().any(is_double) {
                        connections.push(self.inherit(gene, None, pick, stream));
                    }
                }
                (None, None) => {}
            },
        );
        nodes.clear();
        align(
            first.nodes(),
            second.nodes(),
            |gene| gene.id,
            |pair| {
                let Some(gene) = pair.0.or(pair.1) else { return };
                if gene.id < first_hidden || connections.iter().any(|connection| connection.touches(gene.id)) {
                    nodes.push(pick.node(gene, pair.0.and(pair.1), stream));
                }
            },
        );
    }

    /// The child's gene, from one that both or only one of the parents has.
    fn inherit(
        &self,
        gene: &ConnectionGene,
        other: Option<&ConnectionGene>,
        pick: Pick,
        stream: &mut RandomStream,
    ) -> ConnectionGene {
        let weight = other.map_or(gene.weight, |other| pick.number(gene.weight, other.weight, stream));
        let is_disabled = !gene.enabled || other.is_some_and(|other| !other.enabled);
        let enabled = !is_disabled || !happens(self.stays_disabled, stream);
        ConnectionGene { weight, enabled, ..*gene }
    }
}

/// What becomes of two numbers.
#[derive(Clone, Copy)]
enum Pick {
    Either,
    Mean,
}

impl Pick {
    fn number(self, a: f32, b: f32, stream: &mut RandomStream) -> f32 {
        match self {
            Self::Mean => 0.5 * (a + b),
            Self::Either if coin(stream) => a,
            Self::Either => b,
        }
    }

    fn node(self, gene: &NodeGene, other: Option<&NodeGene>, stream: &mut RandomStream) -> NodeGene {
        match other {
            Some(other) if other != gene => {
                let activation = if coin(stream) { gene.activation } else { other.activation };
                NodeGene { id: gene.id, activation, bias: self.number(gene.bias, other.bias, stream) }
            }
            _ => *gene,
        }
    }
}

fn coin(stream: &mut RandomStream) -> bool {
    stream.next_u32() & 1 == 0
}

/// Visits the genes of two parents in the order of their numbers: the first's, the second's, or both if they match.
fn align<G>(first: &[G], second: &[G], number: impl Fn(&G) -> u32, mut visit: impl FnMut((Option<&G>, Option<&G>))) {
    let (mut first, mut second) = (first.iter().peekable(), second.iter().peekable());
    loop {
        let order = match (first.peek(), second.peek()) {
            (None, None) => return,
            (Some(_), None) => Ordering::Less,
            (None, Some(_)) => Ordering::Greater,
            (Some(a), Some(b)) => number(a).cmp(&number(b)),
        };
        visit((first.next_if(|_| order.is_le()), second.next_if(|_| order.is_ge())));
    }
}
