use super::probe::noise;
use crate::{Genome, Phenotype};
use serde::{Deserialize, Serialize};

/// A controller of any shape, with a memory and a character of its own, for checking tasks that have no genomes at hand.
///
/// Its outputs lie from -1 to 1, depend on every input and on all earlier steps, and differ from puppet to puppet. It
/// learns nothing.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Puppet {
    inputs: usize,
    outputs: usize,
    character: u64,
    #[serde(skip)]
    memory: Vec<f32>,
}

impl Puppet {
    /// A puppet of this shape; another character behaves differently.
    pub fn new(inputs: usize, outputs: usize, character: u64) -> Self {
        Self { inputs, outputs, character, memory: Vec::new() }
    }

    /// A few puppets of this shape, of characters 0, 1, 2 and so on.
    pub fn sample(inputs: usize, outputs: usize, count: usize) -> Vec<Self> {
        (0..count as u64).map(|character| Self::new(inputs, outputs, character)).collect()
    }
}

impl Genome for Puppet {
    type Phenotype = Self;

    fn express(&self) -> Self {
        Self { memory: vec![0.0; self.outputs], ..*self }
    }
}

impl Phenotype for Puppet {
    fn inputs(&self) -> usize {
        self.inputs
    }

    fn outputs(&self) -> usize {
        self.outputs
    }

    fn reset(&mut self) {
        self.memory.fill(0.0);
    }

    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        for (index, (output, memory)) in outputs.iter_mut().zip(&mut self.memory).enumerate() {
            let weight = |input: usize| noise(self.character, (index * self.inputs + input) as u64);
            let bias = noise(self.character, u64::MAX - index as u64);
            let sum: f32 = inputs.iter().enumerate().map(|(input, value)| weight(input) * value).sum();
            *memory = 0.5 * *memory + 0.5 * (sum + bias).clamp(-1.0, 1.0);
            *output = *memory;
        }
    }
}
