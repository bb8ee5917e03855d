//! The contracts of `ne-core` and nothing else: a genome, a phenotype, a task and a strategy of one's own learn XOR.

use ne_core::{
    Evaluation, Evolution, Genome, Phenotype, Purpose, Seed, Serial, StopConditions, StopReason, Strategy, Task,
};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// The nine weights of a net of two inputs, two hidden neurons and an output: genome and phenotype in one.
#[derive(Clone, Serialize, Deserialize)]
struct Net([f32; 9]);

impl Genome for Net {
    type Phenotype = Self;
    fn express(&self) -> Self {
        self.clone()
    }
}

impl Phenotype for Net {
    fn inputs(&self) -> usize {
        2
    }
    fn outputs(&self) -> usize {
        1
    }
    fn reset(&mut self) {}
    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        let neuron = |w: &[f32], a: f32, b: f32| libm::tanhf(w[0] * a + w[1] * b + w[2]);
        let hidden = |w: &[f32]| neuron(w, inputs[0], inputs[1]);
        outputs[0] = neuron(&self.0[6..], hidden(&self.0), hidden(&self.0[3..]));
    }
}

/// 1 if the inputs differ in sign, else -1.
struct Xor;

impl Task for Xor {
    fn inputs(&self) -> usize {
        2
    }
    fn outputs(&self) -> usize {
        1
    }
    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        if let Err(failure) = self.check_shape(phenotype) {
            return Evaluation::failed(failure);
        }
        phenotype.reset();
        let (mut error, mut answer) = (0.0, [0.0]);
        for [a, b] in [[-1.0, -1.0], [-1.0, 1.0], [1.0, -1.0], [1.0, 1.0_f32]] {
            phenotype.activate(&[a, b], &mut answer);
            error += f64::from((answer[0] + a * b).powi(2));
        }
        Evaluation::new(-error).with_steps(4)
    }
}

/// A (1 + 20) evolution strategy: the best so far and twenty mutants of it, by steps of three sizes in turn.
#[derive(Serialize, Deserialize)]
struct Mutants(Vec<Net>);

impl Strategy for Mutants {
    type Genome = Net;
    fn name(&self) -> &str {
        "mutants"
    }
    fn ask(&mut self, seed: Seed) -> &[Net] {
        let mut stream = seed.stream(Purpose::new("mutants"));
        let step = [2.0, 0.5, 0.1][seed.generation_index() as usize % 3];
        self.0 = vec![self.0[0].clone(); 21];
        let weights = self.0[1..].iter_mut().flat_map(|mutant| &mut mutant.0);
        weights.for_each(|weight| *weight += step * stream.random_range(-1.0..1.0_f32));
        &self.0
    }
    fn tell(&mut self, evaluations: &[Evaluation], _: Seed) {
        self.0.swap(0, (0..evaluations.len()).max_by_key(|&index| evaluations[index].fitness()).unwrap_or(0));
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let stop = StopConditions { target: Some(-0.01), generations: Some(1000), ..Default::default() };
    let mut evolution = Evolution::new(Mutants(vec![Net([0.0; 9])]), Seed::of_run(1), stop);
    let reason = evolution.run(&Xor, &Serial, &mut [])?;
    println!("after {} generations {reason}", evolution.progress().generations);
    if reason == StopReason::Target { Ok(()) } else { Err("XOR was not learned".into()) }
}
