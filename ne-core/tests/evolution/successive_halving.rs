//! Evaluating in rungs: which individuals go on, what those left behind are worth, and what it costs.

use crate::{
    common::{Climber, Imitate},
    scripted::Unused,
    state,
};
use ne_core::{
    Evaluation, Evaluator, Evolution, Failure, Fitness, Genome, Parallel, Phenotype, Seed, Serial, StopConditions,
    Strategy as _, Task,
    successive_halving::{Rung, SuccessiveHalving},
};
use proptest::prelude::{Strategy, *};
use serde::{Deserialize, Serialize};
use std::any::Any;

/// What it is worth on each task is written in its genes; `None` fails.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Entrant(Vec<Option<f64>>);

impl Genome for Entrant {
    type Phenotype = Self;

    fn express(&self) -> Self {
        self.clone()
    }
}

impl Phenotype for Entrant {
    fn inputs(&self) -> usize {
        0
    }

    fn outputs(&self) -> usize {
        0
    }

    fn reset(&mut self) {}

    fn activate(&mut self, _: &[f32], _: &mut [f32]) {}
}

/// Reads the gene of this number. It takes 100 times as many steps as the one before, so that the steps of an evaluation
/// tell which tasks it is made of.
struct Gene(usize);

impl Gene {
    fn steps(&self) -> u64 {
        100_u64.pow(self.0 as u32)
    }
}

impl Task for Gene {
    fn inputs(&self) -> usize {
        0
    }

    fn outputs(&self) -> usize {
        0
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        let entrant: &dyn Any = phenotype;
        let Some(Entrant(genes)) = entrant.downcast_ref() else { panic!("it is an entrant") };
        let mut evaluation = match genes[self.0] {
            Some(fitness) => Evaluation::new(fitness),
            None => Evaluation::failed(Failure::Other { what: format!("no gene {}", self.0) }),
        };
        evaluation.measurements.insert("task", self.0 as f64);
        evaluation.with_steps(self.steps())
    }

    fn batch_size(&self) -> usize {
        3
    }
}

const SEED: Seed = Seed::of_run(1);

/// A rung for each share, and at the end a task of its own.
fn evaluate<E: Evaluator>(inner: E, shares: &[f64], entrants: &[Entrant]) -> Vec<Evaluation> {
    let rung = |(gene, &share)| Rung { task: Box::new(Gene(gene)), share };
    SuccessiveHalving::new(inner, shares.iter().enumerate().map(rung).collect()).evaluate(
        &Gene(shares.len()),
        entrants,
        SEED,
    )
}

/// How many rungs an individual ran, the whole evaluation included.
fn tasks_run(evaluation: &Evaluation) -> usize {
    let tasks = evaluation.steps.ilog(100) as usize + 1;
    assert_eq!(evaluation.steps, (0..tasks).map(|gene| Gene(gene).steps()).sum::<u64>(), "each task once");
    tasks
}

fn fitnesses(evaluations: &[Evaluation]) -> Vec<Option<f64>> {
    evaluations.iter().map(|evaluation| evaluation.fitness().map(Fitness::get)).collect()
}

#[test]
fn the_best_go_on_and_the_others_are_put_below_them() {
    let genes = [[1.0, 9.0], [4.0, 2.0], [3.0, 5.0], [2.0, 9.0], [4.0, 3.0]];
    let entrants = genes.map(|genes| Entrant(genes.map(Some).to_vec()));
    let evaluations = evaluate(Serial, &[0.5], &entrants);
    let top = 2.0_f64.next_down();
    assert_eq!(fitnesses(&evaluations), [Some(top - 1.0), Some(2.0), Some(5.0), Some(top), Some(3.0)]);
    assert_eq!(evaluations.iter().map(tasks_run).collect::<Vec<_>>(), [1, 2, 2, 1, 2]);
}

#[test]
fn if_all_that_went_on_failed_the_next_in_rank_go_on() {
    let entrant = |short, long| Entrant(vec![Some(short), long]);
    let entrants = [
        entrant(1.0, Some(7.0)),
        entrant(2.0, Some(8.0)),
        entrant(6.0, None),
        entrant(5.0, None),
        entrant(4.0, None),
        entrant(3.0, Some(1.0)),
    ];
    let evaluations = evaluate(Serial, &[0.3], &entrants);
    assert_eq!(evaluations.iter().map(tasks_run).collect::<Vec<_>>(), [1, 1, 2, 2, 2, 2]);
    assert_eq!(
        fitnesses(&evaluations),
        [Some(1.0_f64.next_down() - 1.0), Some(1.0_f64.next_down()), None, None, None, Some(1.0)]
    );
    let hopeless = [3.0, 1.0, 2.0].map(|short| entrant(short, None));
    assert!(evaluate(Serial, &[0.4], &hopeless).iter().all(|evaluation| tasks_run(evaluation) == 2));
}

#[test]
fn without_rungs_it_is_the_inner_evaluator() {
    let genomes = Climber::new(9).ask(SEED.generation(1)).to_vec();
    let inner = Serial.evaluate(&Imitate { batch: 2 }, &genomes, SEED);
    assert_eq!(SuccessiveHalving::new(Serial, Vec::new()).evaluate(&Imitate { batch: 2 }, &genomes, SEED), inner);
}

#[test]
fn a_run_in_rungs_is_the_same_on_any_number_of_threads() {
    fn run<E: Evaluator>(inner: E, batch: usize) -> String {
        let rung = |share| Rung { task: Box::new(Imitate { batch }), share };
        let stop = StopConditions { generations: Some(12), ..Default::default() };
        let mut evolution = Evolution::new(Climber::new(21), Seed::of_run(5), stop);
        let evaluator = SuccessiveHalving::new(inner, vec![rung(0.7), rung(0.3)]);
        evolution.run(&Imitate { batch }, &evaluator, &mut []).expect("the run ends in peace");
        state(&evolution)
    }
    let serial = run(Serial, 1);
    for threads in [1, 2, 3] {
        let parallel = Parallel::new(threads).expect("threads start");
        for batch in [1, 4, 100] {
            assert_eq!(run(&parallel, batch), serial, "{threads} threads, batches of {batch}");
        }
    }
}

/// An evaluator that loses the last of a small group, or of a large one.
struct Careless {
    loses_at_most: usize,
}

impl Evaluator for Careless {
    fn evaluate<G: Genome>(&self, _: &dyn Task, genomes: &[G], _: Seed) -> Vec<Evaluation> {
        let lost = usize::from(genomes.len() <= self.loses_at_most);
        genomes.iter().skip(lost).map(|_| Evaluation::new(1.0)).collect()
    }
}

#[test]
fn lost_evaluations_are_not_covered_up() {
    for loses_at_most in [3, 6] {
        let rung = || Rung { task: Box::new(Unused), share: 0.5 };
        let evaluator = SuccessiveHalving::new(Careless { loses_at_most }, vec![rung(), rung()]);
        let stop = StopConditions { generations: Some(1), ..Default::default() };
        let mut evolution = Evolution::new(Climber::new(6), Seed::of_run(5), stop);
        let error = evolution.run(&Unused, &evaluator, &mut []).expect_err("some are missing");
        assert_eq!(error.to_string(), "the evaluator gave 0 evaluations for 6 genomes in generation 1");
    }
}

/// Fitnesses with many equals, some failures and some extremes.
fn gene() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        4 => (-3..4).prop_map(|fitness| Some(f64::from(fitness))),
        2 => Just(None),
        2 => (-1e3..1e3).prop_map(Some),
        1 => prop_oneof![Just(1e307), Just(-1e300), Just(5e-324), Just(0.0)].prop_map(Some),
    ]
}

fn field() -> impl Strategy<Value = (Vec<f64>, Vec<Entrant>)> {
    prop::collection::vec(0.01..0.99, 0..4).prop_flat_map(|shares| {
        let entrant = prop::collection::vec(gene(), shares.len() + 1).prop_map(Entrant);
        (Just(shares), prop::collection::vec(entrant, 0..20))
    })
}

proptest! {
    #[test]
    fn an_individual_that_reaches_the_end_is_evaluated_as_by_the_inner_evaluator((shares, entrants) in field()) {
        let evaluations = evaluate(Serial, &shares, &entrants);
        prop_assert_eq!(evaluations.len(), entrants.len());
        let whole = Serial.evaluate(&Gene(shares.len()), &entrants, SEED);
        for (evaluation, whole) in evaluations.iter().zip(whole) {
            if tasks_run(evaluation) > shares.len() {
                prop_assert_eq!(evaluation, &whole.with_steps(evaluation.steps));
            }
        }
    }

    #[test]
    fn an_individual_left_behind_ranks_below_those_that_went_further((shares, entrants) in field()) {
        let evaluations = evaluate(Serial, &shares, &entrants);
        for (one, behind) in evaluations.iter().enumerate() {
            let gene = tasks_run(behind) - 1;
            prop_assert_eq!(behind.measurements["task"], gene as f64);
            prop_assert_eq!(behind.outcome.is_err(), entrants[one].0[gene].is_none());
            for (other, further) in evaluations.iter().enumerate() {
                if tasks_run(further) > gene + 1 && further.outcome.is_ok() {
                    prop_assert!(behind.fitness() < further.fitness());
                    // In the rung that both ran, the one that went further was no worse, of equals the first.
                    let (mine, theirs) = (entrants[one].0[gene], entrants[other].0[gene]);
                    prop_assert!(theirs > mine || (theirs == mine && other < one));
                } else if tasks_run(further) == gene + 1 {
                    let before = entrants[one].0[gene].partial_cmp(&entrants[other].0[gene]);
                    prop_assert_eq!(behind.fitness().cmp(&further.fitness()), before.expect("no NaN"));
                }
            }
        }
    }

    #[test]
    fn a_share_goes_on_and_more_only_if_they_fail((shares, entrants) in field()) {
        let evaluations = evaluate(Serial, &shares, &entrants);
        let ran = |tasks: usize| evaluations.iter().filter(|evaluation| tasks_run(evaluation) >= tasks).count();
        let succeeded = |evaluation: &&Evaluation| tasks_run(evaluation) > shares.len() && evaluation.outcome.is_ok();
        let winners = evaluations.iter().filter(succeeded).count();
        prop_assert!(winners > 0 || ran(shares.len() + 1) == entrants.len(), "all have been evaluated whole");
        let failed = evaluations.iter().any(|evaluation| tasks_run(evaluation) > shares.len() && evaluation.outcome.is_err());
        for (rung, share) in shares.iter().enumerate() {
            let places = (share * ran(rung + 1) as f64 - 1e-9).ceil() as usize;
            let went_on = ran(rung + 2);
            prop_assert!(went_on == places || (failed && went_on > places), "{} of {}", went_on, ran(rung + 1));
        }
        let best = evaluations.iter().filter(|evaluation| evaluation.outcome.is_ok()).max_by_key(|best| best.fitness());
        prop_assert!(best.is_none_or(|best| tasks_run(best) > shares.len()), "a champion was evaluated whole");
    }

    #[test]
    fn threads_change_nothing((shares, entrants) in field()) {
        let serial = evaluate(Serial, &shares, &entrants);
        for threads in [1, 2, 3] {
            prop_assert_eq!(&evaluate(Parallel::new(threads).expect("threads start"), &shares, &entrants), &serial);
        }
    }

    #[test]
    fn the_order_changes_nothing_where_no_two_are_equal(
        shares in prop::collection::vec(0.01..0.99, 0..4),
        genes in prop::collection::btree_map(-1000..1000, prop::collection::vec(-9..9, 4), 0..20),
    ) {
        // The whole number makes each unlike all others, on every task.
        let unlike = |(number, genes): (i32, Vec<i32>)| {
            Entrant(genes.iter().map(|gene| Some(f64::from(*gene) + f64::from(number) * 1e-4)).collect())
        };
        let mut entrants: Vec<Entrant> = genes.into_iter().map(unlike).collect();
        let forwards = evaluate(Serial, &shares, &entrants);
        entrants.reverse();
        let mut backwards = evaluate(Serial, &shares, &entrants);
        backwards.reverse();
        prop_assert_eq!(forwards, backwards);
    }
}
