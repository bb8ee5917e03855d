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
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Crossover {
    /// The share of crossovers in which matching genes get the mean of the parents' weights, from 0 to 1; 0 in the paper.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub averaging: f64,
    /// The probability that an inherited gene is disabled if it is in either parent, from 0 to 1; 0.75 in the paper. It
    /// is enabled otherwise.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
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
            // The hidden neurons of both may be too many.
            let fits = child.nodes().len() <= child.most_neurons();
            if fits && (child.layout().recurrent || !is_cyclic(child)) {
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
        let mut touched: Vec<_> = connections.iter().flat_map(|connection| [connection.from, connection.to]).collect();
        touched.sort_unstable();
        nodes.clear();
        align(
            first.nodes(),
            second.nodes(),
            |gene| gene.id,
            |pair| {
                let Some(gene) = pair.0.or(pair.1) else { return };
                if gene.id < first_hidden || touched.binary_search(&gene.id).is_ok() {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{BiasKind, Layout, Neat, NeatSettings};
    use ne_core::{Evaluation, Purpose, Seed, Strategy};
    use ne_net::Activation;
    use proptest::prelude::*;

    const PAPER: Crossover = Crossover { averaging: 0.0, stays_disabled: 0.75 };
    const LAYOUT: Layout = Layout { inputs: 1, outputs: 1, bias: BiasKind::None, recurrent: false };

    fn stream(seed: u64) -> RandomStream {
        Seed::of_run(seed).stream(Purpose::new("test"))
    }

    fn child(crossover: Crossover, a: &NeatGenome, b: &NeatGenome, fitness: Ordering, seed: u64) -> NeatGenome {
        let mut child = NeatGenome::blank(*a.layout(), None);
        crossover.cross(a, b, fitness, &mut child, &mut stream(seed));
        child
    }

    /// Input 0, output 1, hidden neurons; genes are (number, from, to, weight).
    fn genome(hidden: &[u32], genes: &[(u32, u32, u32, f32)]) -> NeatGenome {
        let node = |&id: &u32| NodeGene { id, activation: Activation::Tanh, bias: 0.0 };
        let gene = |&(innovation, from, to, weight)| ConnectionGene { innovation, from, to, weight, enabled: true };
        let nodes = [1].iter().chain(hidden).map(node).collect();
        NeatGenome::new(LAYOUT, nodes, genes.iter().map(gene).collect()).expect("valid")
    }

    fn parents() -> (NeatGenome, NeatGenome) {
        let a = genome(&[2], &[(0, 0, 1, 1.0), (1, 0, 2, 1.0), (2, 2, 1, 1.0)]);
        let b = genome(&[2, 3], &[(0, 0, 1, 3.0), (1, 0, 2, 3.0), (2, 2, 1, 3.0), (3, 2, 3, 3.0), (4, 3, 1, 3.0)]);
        (a, b)
    }

    #[test]
    fn disjoint_and_excess_genes_come_from_the_fitter() {
        let (a, b) = parents();
        for seed in 0..20 {
            for (fitness, expected) in [(Ordering::Greater, &a), (Ordering::Less, &b)] {
                let child = child(PAPER, &a, &b, fitness, seed);
                let numbers = |genome: &NeatGenome| -> Vec<u32> {
                    genome.connections().iter().map(|gene| gene.innovation).collect()
                };
                assert_eq!(numbers(&child), numbers(expected));
                assert_eq!(child.nodes(), expected.nodes());
            }
        }
    }

    #[test]
    fn matching_genes_are_of_either_or_the_mean() {
        let (a, b) = parents();
        let weights = |crossover: Crossover| -> Vec<f32> {
            let children = (0..500).map(|seed| child(crossover, &a, &b, Ordering::Greater, seed));
            children.map(|child| child.connections()[1].weight).collect()
        };
        let of_first = weights(PAPER).iter().filter(|&&weight| weight == 1.0).count();
        let of_second = weights(PAPER).iter().filter(|&&weight| weight == 3.0).count();
        assert!(of_first + of_second == 500 && of_first.abs_diff(250) < 50, "{of_first}");
        assert!(weights(Crossover { averaging: 1.0, ..PAPER }).iter().all(|&weight| weight == 2.0));
    }

    #[test]
    fn genes_disabled_in_either_parent_stay_so_with_their_probability() {
        let (mut a, b) = parents();
        a.genes_mut().1[1].enabled = false;
        let disabled = (0..1000).filter(|&seed| {
            let child = child(PAPER, &a, &b, Ordering::Less, seed);
            assert!(child.connections()[0].enabled);
            !child.connections()[1].enabled
        });
        let disabled = disabled.count();
        assert!(disabled.abs_diff(750) < 55, "{disabled}");
    }

    #[test]
    fn of_equally_fit_parents_every_gene_can_come() {
        let (a, b) = parents();
        let has_excess = (0..1000).filter(|&seed| {
            let child = child(PAPER, &a, &b, Ordering::Equal, seed);
            child.connections().iter().any(|gene| gene.innovation == 3)
        });
        let has_excess = has_excess.count();
        assert!(has_excess.abs_diff(500) < 65, "{has_excess}");
    }

    #[test]
    fn equally_fit_parents_beget_no_cycle_and_no_double() {
        // 2 to 3 in one, 3 to 2 in the other; 0 to 3 under two numbers.
        let a = genome(&[2, 3], &[(0, 0, 2, 1.0), (1, 2, 3, 1.0), (2, 3, 1, 1.0), (5, 0, 3, 1.0)]);
        let b = genome(&[2, 3], &[(3, 0, 3, 1.0), (4, 3, 2, 1.0), (6, 2, 1, 1.0)]);
        for seed in 0..500 {
            let child = child(PAPER, &a, &b, Ordering::Equal, seed);
            let checked = NeatGenome::new(LAYOUT, child.nodes().to_vec(), child.connections().to_vec());
            assert_eq!(checked, Ok(child), "seed {seed}");
        }
    }

    proptest! {
        /// On parents that a run has brought forth.
        #[test]
        fn children_are_genomes_of_their_parents_genes(seed in 0..1000u64, recurrent in proptest::bool::ANY, averaging in 0.0..1.0f64) {
            let mut settings = NeatSettings { population: 10, recurrent, ..NeatSettings::stanley_2002() };
            (settings.mutation.add_connection, settings.mutation.add_node) = (0.5, 0.5);
            let mut neat = Neat::new(settings, 2, 2).expect("valid");
            for generation in 1..12 {
                neat.ask(Seed::of_run(seed).generation(generation));
                neat.tell(&vec![Evaluation::new(1.0); 10], Seed::of_run(seed).generation(generation));
            }
            let genomes = neat.ask(Seed::of_run(seed).generation(12)).to_vec();
            for pair in genomes.windows(2) {
                for fitness in [Ordering::Less, Ordering::Equal, Ordering::Greater] {
                    let child = child(Crossover { averaging, ..PAPER }, &pair[0], &pair[1], fitness, seed);
                    let checked = NeatGenome::new(*child.layout(), child.nodes().to_vec(), child.connections().to_vec());
                    prop_assert_eq!(checked.as_ref(), Ok(&child));
                    let mut inherited = pair.iter().flat_map(NeatGenome::connections);
                    prop_assert!(child.connections().iter().all(|gene| inherited.clone().any(|other| other.innovation == gene.innovation)));
                    prop_assert!(inherited.next().is_some());
                }
            }
        }
    }

    #[test]
    fn errors_name_the_field() {
        let error = |crossover: Crossover| crossover.validate().expect_err("out of range").to_string();
        assert_eq!(error(Crossover { averaging: 2.0, ..PAPER }), "averaging = 2: must be from 0 to 1");
        assert_eq!(error(Crossover { stays_disabled: -1.0, ..PAPER }), "stays_disabled = -1: must be from 0 to 1");
    }
}
