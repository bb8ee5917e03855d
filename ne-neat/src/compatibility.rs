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
#[serde(deny_unknown_fields)]
pub struct Compatibility {
    /// Weight of excess genes, those beyond the other genome's last: the paper's c1; from 0 to 1000.
    pub excess: f64,
    /// Weight of disjoint genes, those between the other genome's: the paper's c2; from 0 to 1000.
    pub disjoint: f64,
    /// Weight of the mean difference of weights: the paper's c3; from 0 to 1000.
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
        let larger = first.len().max(second.len());
        let size = if larger < self.small_genome { 1.0 } else { larger.max(1) as f64 };
        let mean = difference / compared.max(1) as f64;
        (self.excess * excess as f64 + self.disjoint * disjoint as f64) / size + self.weights * mean
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
