use crate::common::{Climber, INPUTS, Imitate, Weights};
use ne_core::{
    Evaluation, Genome, Phenotype, RankSelector, Roulette, Seed, Selection, Selector, StochasticUniversal, Strategy,
    Task, Tournament, Truncation,
    conformance::{Puppet, StrategyOptions, check_genome, check_phenotype, check_selector, check_strategy, check_task},
};
use serde::{Deserialize, Serialize};

const SEED: Seed = Seed::of_run(1);

#[test]
fn the_five_selectors_pass() {
    let selectors: [&dyn Selector; 11] = [
        &Roulette {},
        &StochasticUniversal {},
        &RankSelector { pressure: 1.0 },
        &RankSelector::default(),
        &RankSelector { pressure: 2.0 },
        &Tournament { size: 1 },
        &Tournament { size: 10 },
        &Truncation { share: 1e-9 },
        &Truncation::default(),
        &Truncation { share: 1.0 },
        &Selection::Tournament(Tournament::default()),
    ];
    for (index, selector) in selectors.into_iter().enumerate() {
        for run in 0..5 {
            check_selector(selector, Seed::of_run(run)).unwrap_or_else(|violation| panic!("{index}: {violation}"));
        }
    }
}

#[test]
fn the_toy_genome_passes() -> Result<(), Box<dyn std::error::Error>> {
    check_genome(&[Weights(vec![0.0; 4]), Weights(vec![0.1, -3.0, 0.7, 0.9]), Weights(vec![7.038531e-26; 4])])?;
    Ok(())
}

#[test]
fn puppets_pass_in_every_shape() -> Result<(), Box<dyn std::error::Error>> {
    for (inputs, outputs) in [(0, 0), (0, 1), (1, 0), (1, 1), (9, 8), (2, 30)] {
        check_genome(&Puppet::sample(inputs, outputs, 3))?;
        check_phenotype(|| Puppet::new(inputs, outputs, 5).express())?;
    }
    Ok(())
}

#[test]
fn the_toy_task_passes_whatever_its_batch_size() -> Result<(), Box<dyn std::error::Error>> {
    for batch in [1, 2, 100] {
        check_task(&Imitate { batch }, &Puppet::sample(INPUTS, 1, 5), SEED)?;
        check_task(&Imitate { batch }, &[Weights(vec![0.5; 4]), Weights(vec![-0.1; 4])], SEED)?;
    }
    Ok(())
}

#[test]
fn the_toy_strategy_passes() -> Result<(), Box<dyn std::error::Error>> {
    check_strategy(|| Climber::new(12), &StrategyOptions::default())?;
    check_strategy(|| Climber::new(1), &StrategyOptions { generations: 3, seed: u64::MAX, ..Default::default() })?;
    Ok(())
}

/// A strategy without chance and without a fixed size: a grid that gets finer.
#[derive(Serialize, Deserialize)]
struct Grid(Vec<Weights>);

impl Strategy for Grid {
    type Genome = Weights;
    fn name(&self) -> &str {
        "grid"
    }
    fn ask(&mut self, seed: Seed) -> &[Weights] {
        let count = seed.generation_index() as usize + 1;
        self.0 = (0..count).map(|index| Weights(vec![index as f32 / count as f32; INPUTS + 1])).collect();
        &self.0
    }
    fn tell(&mut self, _: &[Evaluation], _: Seed) {}
}

#[test]
fn a_strategy_may_say_that_its_size_varies_and_that_it_takes_no_chances() -> Result<(), Box<dyn std::error::Error>> {
    let options = StrategyOptions { size_varies: true, ignores_seed: true, ..Default::default() };
    check_strategy(|| Grid(Vec::new()), &options)?;
    Ok(())
}

/// A task that sees no outputs at all.
struct Nothing;

impl Task for Nothing {
    fn inputs(&self) -> usize {
        0
    }
    fn outputs(&self) -> usize {
        0
    }
    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        match self.check_shape(phenotype) {
            Ok(()) => Evaluation::new(0.0),
            Err(failure) => Evaluation::failed(failure),
        }
    }
}

#[test]
fn a_task_without_inputs_and_outputs_passes() -> Result<(), Box<dyn std::error::Error>> {
    check_task(&Nothing, &Puppet::sample(0, 0, 2), SEED)?;
    Ok(())
}
