use crate::scripted::{Prompter, Script, Unused};
use ne_core::{
    Evaluation, Evaluator, Evolution, EvolutionError, Genome, Phenotype, Seed, Serial, Statistic, StopConditions, Task,
    conformance::Puppet,
};

const FAILED: f64 = f64::NAN;

/// Generation and fitness of the champion, and the character of its genome, after each line of a script.
fn champions(lines: &[&[f64]]) -> Vec<Option<(u64, f64, Puppet)>> {
    let mut evolution = Script::evolution(lines, StopConditions::default());
    let prompter = Prompter::of(&evolution);
    let mut champion_after = || {
        evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
        let champion = evolution.champion()?;
        assert_eq!(champion.seed, Seed::of_run(1).generation(champion.generation));
        Some((champion.generation, champion.fitness.get(), champion.genome.clone()))
    };
    lines.iter().map(|_| champion_after()).collect()
}

fn genome(generation: u64, index: u64) -> Puppet {
    Puppet::new(0, 1, 100 * generation + index)
}

#[test]
fn of_equals_the_first_is_champion() {
    assert_eq!(champions(&[&[1.0, 3.0, 2.0, 3.0, 3.0]]), [Some((1, 3.0, genome(1, 1)))]);
    assert_eq!(champions(&[&[0.0, -0.0]]), [Some((1, 0.0, genome(1, 0)))]);
}

#[test]
fn a_champion_is_dethroned_only_by_a_better_one() {
    let history = champions(&[&[1.0], &[0.5, 1.0], &[FAILED, 2.0], &[1.9]]);
    let [first, second] = [Some((1, 1.0, genome(1, 0))), Some((3, 2.0, genome(3, 1)))];
    assert_eq!(history, [first.clone(), first, second.clone(), second]);
}

#[test]
fn failures_make_no_champion() {
    let history = champions(&[&[FAILED, FAILED], &[FAILED, -1e300]]);
    assert_eq!(history, [None, Some((2, -1e300, genome(2, 1)))]);
}

#[test]
fn stagnation_counts_generations_since_the_champion() {
    let mut evolution = Script::evolution(&[&[1.0], &[1.0], &[FAILED], &[3.0]], StopConditions::default());
    let prompter = Prompter::of(&evolution);
    let mut after = || {
        evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
        evolution.progress().stagnation
    };
    assert_eq!([after(), after(), after(), after(), after()], [0, 1, 2, 0, 1]);
}

#[test]
fn the_report_counts_what_was_done() -> Result<(), EvolutionError> {
    let mut evolution = Script::evolution(&[&[1.0, FAILED, 4.0], &[2.0]], StopConditions::default());
    let prompter = Prompter::of(&evolution);
    let first = evolution.generation(&Unused, &prompter, &mut [])?;
    assert_eq!((first.generation, first.evaluations, first.steps, first.population, first.failures), (1, 3, 30, 3, 1));
    assert_eq!(first.fitness.map(|fitness| (fitness.worst, fitness.best)), Some((1.0, 4.0)));
    let second = evolution.generation(&Unused, &prompter, &mut [])?;
    assert_eq!((second.generation, second.evaluations, second.steps, second.population), (2, 4, 40, 1));
    assert_eq!(second.best_so_far.map(|best| best.get()), Some(4.0));
    Ok(())
}

#[test]
fn a_statistic_that_is_no_number_is_an_error_with_names() {
    let mut script = Script::new(&[&[1.0]]);
    script.statistics = vec![Statistic::new("heat", 1.0), Statistic::new("depth", f64::NAN)];
    let mut evolution = Evolution::new(script, Seed::of_run(1), StopConditions::default());
    let prompter = Prompter::of(&evolution);
    let error = evolution.run(&Unused, &prompter, &mut []).expect_err("no log can hold it");
    let says = "the strategy \"script\" tells a \"depth\" of NaN in generation 1: it must be finite";
    assert_eq!((error.to_string(), error.generation()), (says.to_owned(), Some(1)));
}

#[test]
fn an_empty_population_is_an_error_with_names() {
    let mut evolution =
        Script::evolution(&[&[1.0], &[]], StopConditions { generations: Some(9), ..Default::default() });
    let prompter = Prompter::of(&evolution);
    let error = evolution.run(&Unused, &prompter, &mut []).expect_err("no genome was asked for");
    assert_eq!(error.to_string(), "the strategy \"script\" asked for the evaluation of no genome in generation 2");
    assert_eq!(evolution.progress().generations, 1);
}

/// An evaluator that loses the last.
struct Careless;

impl Evaluator for Careless {
    fn evaluate<G: Genome>(&self, _: &dyn Task, genomes: &[G], _: Seed) -> Vec<Evaluation> {
        genomes.iter().skip(1).map(|_| Evaluation::new(1.0)).collect()
    }
}

#[test]
fn an_evaluator_that_loses_evaluations_is_an_error() {
    let mut evolution = Script::evolution(&[&[1.0; 5]], StopConditions { generations: Some(9), ..Default::default() });
    let error = evolution.run(&Unused, &Careless, &mut []).expect_err("one is missing");
    assert_eq!(error.to_string(), "the evaluator gave 4 evaluations for 5 genomes in generation 1");
    assert_eq!((evolution.progress().generations, evolution.champion().is_none()), (0, true));
}

/// A task whose batches lose the last.
struct CarelessBatch;

impl Task for CarelessBatch {
    fn inputs(&self) -> usize {
        0
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, _: &mut dyn Phenotype, _: Seed) -> Evaluation {
        Evaluation::new(1.0)
    }

    fn evaluate_batch(&self, phenotypes: &mut [&mut dyn Phenotype], _: Seed) -> Vec<Evaluation> {
        vec![Evaluation::new(1.0); phenotypes.len() / 2 * 2]
    }

    fn batch_size(&self) -> usize {
        3
    }
}

#[test]
fn a_batch_that_loses_evaluations_has_failed_as_a_whole() {
    let evaluations = Serial.evaluate(&CarelessBatch, &Puppet::sample(0, 1, 8), Seed::of_run(1));
    let failures: Vec<_> = evaluations.iter().map(|evaluation| evaluation.outcome.is_err()).collect();
    assert_eq!(failures, [true, true, true, true, true, true, false, false]);
    let message = evaluations[0].outcome.as_ref().expect_err("it failed").to_string();
    assert_eq!(message, "the task gave 2 evaluations for a batch of 3");
}
