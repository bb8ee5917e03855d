//! How far two genomes are apart.

use crate::{BiasKind, ConnectionGene, NeatGenome};
use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// The weights of the terms in the distance between genomes.
///
/// δ = excess · E/N + disjoint · D/N + weights · W̄, with E and D the numbers of excess and disjoint genes, N the number
/// of connection genes in the larger genome, and W̄ the mean difference of the weights of matching genes, disabled ones
/// included. A bias of [a neuron of its own](BiasKind::PerNeuron) is one of those weights.
///
/// Source: Stanley & Miikkulainen, 2002, equation 1.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Compatibility {
    /// Weight of excess genes, those beyond the other genome's last: the paper's c1; from 0 to 1000.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
    pub excess: f64,
    /// Weight of disjoint genes, those between the other genome's: the paper's c2; from 0 to 1000.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
    pub disjoint: f64,
    /// Weight of the mean difference of weights: the paper's c3; from 0 to 1000.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
    pub weights: f64,
    /// N is 1 as long as both genomes have fewer connection genes than this; 20 in the paper, 0 for never.
    pub small_genome: usize,
}

impl Compatibility {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        for (field, value) in [("excess", self.excess), ("disjoint", self.disjoint), ("weights", self.weights)] {
            SettingError::check_range(field, value, 0.0, 1000.0)?;
        }
        Ok(())
    }

    /// The distance δ between two genomes of a run: 0 for equal ones, the same both ways.
    pub fn distance(&self, a: &NeatGenome, b: &NeatGenome) -> f64 {
        let (first, second) = (a.connections(), b.connections());
        let Alignment { matching, mut difference, disjoint, excess } = Alignment::of(first, second);
        let mut compared = matching;
        if a.layout().bias == BiasKind::PerNeuron {
            let (biases, neurons) = bias_difference(a, b);
            difference += biases;
            compared += neurons;
        }
        let mean = difference / compared.max(1) as f64;
        (self.excess * excess as f64 + self.disjoint * disjoint as f64) / self.size(a, b) + self.weights * mean
    }

    /// Whether the distance is below `threshold`.
    pub(crate) fn is_near(&self, a: &NeatGenome, b: &NeatGenome, threshold: f64) -> bool {
        // At least so many genes do not match. That settles most comparisons without a look at the genes.
        let unmatched = a.connections().len().abs_diff(b.connections().len());
        let least = self.excess.min(self.disjoint) * unmatched as f64 / self.size(a, b);
        least < threshold && self.distance(a, b) < threshold
    }

    /// N.
    fn size(&self, a: &NeatGenome, b: &NeatGenome) -> f64 {
        let larger = a.connections().len().max(b.connections().len());
        if larger < self.small_genome { 1.0 } else { larger.max(1) as f64 }
    }
}

/// The genes of two genomes compared by innovation number.
struct Alignment {
    matching: usize,
    /// Sum over the matching genes.
    difference: f64,
    disjoint: usize,
    excess: usize,
}

impl Alignment {
    fn of(a: &[ConnectionGene], b: &[ConnectionGene]) -> Self {
        let (mut i, mut j) = (0, 0);
        let (mut matching, mut difference) = (0, 0.0);
        while let (Some(first), Some(second)) = (a.get(i), b.get(j)) {
            if first.innovation == second.innovation {
                matching += 1;
                difference += f64::from((first.weight - second.weight).abs());
            }
            // Both step over a pair that matches.
            i += usize::from(first.innovation <= second.innovation);
            j += usize::from(second.innovation <= first.innovation);
        }
        let excess = a.len() - i + b.len() - j;
        Self { matching, difference, disjoint: i + j - 2 * matching, excess }
    }
}

/// The summed difference of the biases of neurons that both genomes have, and the number of these.
fn bias_difference(a: &NeatGenome, b: &NeatGenome) -> (f64, usize) {
    let (mut others, mut sum, mut count) = (b.nodes().iter().peekable(), 0.0, 0);
    for gene in a.nodes() {
        while others.next_if(|other| other.id < gene.id).is_some() {}
        if let Some(other) = others.next_if(|other| other.id == gene.id) {
            sum += f64::from((gene.bias - other.bias).abs());
            count += 1;
        }
    }
    (sum, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Layout, NodeGene};
    use ne_net::Activation;
    use proptest::prelude::*;

    const PAPER: Compatibility = Compatibility { excess: 1.0, disjoint: 1.0, weights: 0.4, small_genome: 20 };

    /// A genome with one output and connections from as many inputs as needed, numbered by them.
    fn genome(bias: BiasKind, output_bias: f32, genes: &[(u32, f32)]) -> NeatGenome {
        let layout = Layout { inputs: 50, outputs: 1, bias, recurrent: false };
        let id = layout.sources() as u32;
        let gene = |&(from, weight)| ConnectionGene { innovation: from, from, to: id, weight, enabled: from % 2 == 0 };
        let node = NodeGene { id, activation: Activation::Tanh, bias: output_bias };
        NeatGenome::new(layout, vec![node], genes.iter().map(gene).collect()).expect("valid")
    }

    #[test]
    fn the_terms_are_those_of_the_paper() {
        // Matching: 1, 2, 4. Disjoint: 3, 5. Excess: 6, 7, 9.
        let a = genome(BiasKind::None, 0.0, &[(1, 0.5), (2, 1.0), (4, -1.0), (5, 9.0)]);
        let b = genome(BiasKind::None, 0.0, &[(1, 1.0), (2, 1.0), (3, 9.0), (4, 1.5), (6, 0.0), (7, 0.0), (9, 0.0)]);
        let settings = Compatibility { excess: 10.0, disjoint: 100.0, weights: 0.5, small_genome: 20 };
        assert_eq!(settings.distance(&a, &b), 230.0 + 0.5 * (3.0 / 3.0));
        let divided = Compatibility { small_genome: 7, ..settings };
        assert_eq!(divided.distance(&a, &b), 230.0 / 7.0 + 0.5);
    }

    #[test]
    fn biases_are_weights() {
        let a = genome(BiasKind::PerNeuron, 1.0, &[(1, 0.5)]);
        let b = genome(BiasKind::PerNeuron, 3.5, &[(1, 1.0)]);
        assert_eq!(PAPER.distance(&a, &b), 0.4 * 1.5);
    }

    fn genes() -> impl Strategy<Value = Vec<(u32, f32)>> {
        proptest::collection::btree_map(0..50_u32, -3.0..3.0_f32, 0..40).prop_map(|genes| genes.into_iter().collect())
    }

    proptest! {
        #[test]
        fn it_is_a_distance(a in genes(), b in genes(), threshold in 0.0..10.0f64) {
            let (a, b) = (genome(BiasKind::None, 0.0, &a), genome(BiasKind::None, 0.0, &b));
            prop_assert_eq!(PAPER.distance(&a, &a), 0.0);
            prop_assert_eq!(PAPER.distance(&a, &b), PAPER.distance(&b, &a));
            prop_assert!(PAPER.distance(&a, &b) >= 0.0);
            prop_assert_eq!(PAPER.is_near(&a, &b, threshold), PAPER.distance(&a, &b) < threshold);
        }
    }
}
