//! A toy genome, task and strategy that several test programs share.
#![allow(dead_code, reason = "no program uses all of it")]

use ne_core::{
    Evaluation, Failure, Fitness, Genome, Phenotype, Purpose, Seed, Selector, Statistic, Strategy, Task, Tournament,
};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Inputs of the toy task.
pub(crate) const INPUTS: usize = 3;

/// One weight for each input, and one on what was answered before.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Weights(pub(crate) Vec<f32>);

impl Genome for Weights {
    type Phenotype = Neuron;

    fn express(&self) -> Neuron {
        Neuron { weights: self.0.clone(), last: 0.0 }
    }
}

/// One clipped neuron with a memory.
pub(crate) struct Neuron {
    weights: Vec<f32>,
    last: f32,
}

impl Phenotype for Neuron {
    fn inputs(&self) -> usize {
        INPUTS
    }

    fn outputs(&self) -> usize {
        1
    }

    fn reset(&mut self) {
        self.last = 0.0;
    }

    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        let sum: f32 = self.weights.iter().zip(inputs).map(|(weight, input)| weight * input).sum();
        self.last = (sum + self.weights[INPUTS] * self.last).clamp(-1.0, 1.0);
        outputs[0] = self.last;
    }
}

/// Answer half the first input minus a quarter of the second, on inputs drawn from the seed. A quarter of the
/// genomes, by their answers, fail.
pub(crate) struct Imitate {
    /// How many at a time.
    pub(crate) batch: usize,
}

const INPUT: Purpose = Purpose::new("test input");

impl Task for Imitate {
    fn inputs(&self) -> usize {
        INPUTS
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        if let Err(failure) = self.check_shape(phenotype) {
            return Evaluation::failed(failure);
        }
        phenotype.reset();
        let mut stream = seed.stream(INPUT);
        let (mut error, mut answer) = (0.0, [0.0]);
        for step in 0..20 {
            let inputs: [f32; INPUTS] = std::array::from_fn(|_| stream.random_range(-1.0..1.0));
            phenotype.activate(&inputs, &mut answer);
            if answer[0] > 0.999 {
                return Evaluation::failed(Failure::Unstable { what: "the answer is stuck".into() })
                    .with_steps(step + 1);
            }
            error += f64::from((answer[0] - 0.5 * inputs[0] + 0.25 * inputs[1]).abs());
        }
        Evaluation::new(-error).with_steps(20)
    }

    fn batch_size(&self) -> usize {
        self.batch
    }
}

/// Children of tournament winners, slightly changed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Climber {
    size: usize,
    deviation: f32,
    parents: Vec<Weights>,
    population: Vec<Weights>,
    scores: Vec<Option<Fitness>>,
}

const BREED: Purpose = Purpose::new("test breed");

impl Climber {
    pub(crate) fn new(size: usize) -> Self {
        Self { size, deviation: 0.5, parents: Vec::new(), population: Vec::new(), scores: Vec::new() }
    }
}

impl Strategy for Climber {
    type Genome = Weights;

    fn name(&self) -> &str {
        "climber"
    }

    fn ask(&mut self, seed: Seed) -> &[Weights] {
        let mut stream = seed.stream(BREED);
        let mut parents = Vec::new();
        Tournament::default().select(&self.scores, self.size, &mut stream, &mut parents);
        let mut child = |parent: Option<&Weights>| {
            let mut weights = parent.map_or(vec![0.0; INPUTS + 1], |parent| parent.0.clone());
            weights.iter_mut().for_each(|weight| *weight += self.deviation * stream.random_range(-1.0..1.0_f32));
            Weights(weights)
        };
        self.population = (0..self.size).map(|index| child(parents.get(index).map(|&p| &self.parents[p]))).collect();
        &self.population
    }

    fn tell(&mut self, evaluations: &[Evaluation], _: Seed) {
        self.scores = evaluations.iter().map(Evaluation::fitness).collect();
        self.parents.clone_from(&self.population);
        self.deviation *= 0.97;
    }

    fn statistics(&self) -> Vec<Statistic> {
        vec![Statistic::new("deviation", f64::from(self.deviation))]
    }
}
