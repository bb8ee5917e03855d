//! What the loop sees to, so that no task can forget it.

use ne_core::{Evaluation, Evaluator, Failure, Parallel, Phenotype, Seed, Serial, Task, TaskFn, conformance::Puppet};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Counts the phenotypes it is given, and believes them to be right.
#[derive(Default)]
struct Trusting(AtomicUsize);

impl Task for Trusting {
    fn inputs(&self) -> usize {
        2
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, _: &mut dyn Phenotype, _: Seed) -> Evaluation {
        self.0.fetch_add(1, Ordering::Relaxed);
        Evaluation::new(1.0)
    }
}

#[test]
fn a_phenotype_of_another_shape_never_reaches_the_task() {
    let genomes = [Puppet::new(2, 1, 0), Puppet::new(3, 1, 1), Puppet::new(2, 1, 2), Puppet::new(2, 2, 3)];
    let mismatch = |found_inputs, found_outputs| {
        Err(Failure::ShapeMismatch { found_inputs, found_outputs, inputs: 2, outputs: 1 })
    };
    let parallel = Parallel::new(2).expect("two threads");
    let check = |evaluations: Vec<Evaluation>, task: &Trusting| {
        let outcomes: Vec<_> =
            evaluations.into_iter().map(|evaluation| evaluation.outcome.map(ne_core::Fitness::get)).collect();
        assert_eq!(outcomes, [Ok(1.0), mismatch(3, 1), Ok(1.0), mismatch(2, 2)]);
        assert_eq!(task.0.load(Ordering::Relaxed), 2);
    };
    let task = Trusting::default();
    check(Serial.evaluate(&task, &genomes, Seed::of_run(1)), &task);
    let task = Trusting::default();
    check(parallel.evaluate(&task, &genomes, Seed::of_run(1)), &task);
}

#[test]
fn a_function_is_a_task() {
    let task = TaskFn::new(0, 1, |phenotype: &mut dyn Phenotype, _: Seed| {
        let mut outputs = [0.0];
        phenotype.activate(&[], &mut outputs);
        f64::from(outputs[0])
    });
    assert!(ne_core::conformance::check_task(&task, &Puppet::sample(0, 1, 3), Seed::of_run(1)).is_ok());
    let wrong = task.evaluate(&mut ne_core::Genome::express(&Puppet::new(1, 1, 0)), Seed::of_run(1));
    assert_eq!(
        wrong.outcome.expect_err("another shape").to_string(),
        "the phenotype has 1 inputs and 1 outputs, the task needs 0 and 1"
    );
    let failing = TaskFn::new(0, 1, |_: &mut dyn Phenotype, _: Seed| f64::NAN);
    let evaluations = Serial.evaluate(&failing, &[Puppet::new(0, 1, 0)], Seed::of_run(1));
    assert_eq!(evaluations[0].outcome, Err(Failure::NonFinite { what: "fitness".into() }));
}
