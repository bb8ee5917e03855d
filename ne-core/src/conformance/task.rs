//! What a task owes.

use super::{
    Promise, Puppet, Violation,
    spy::{NotANumber, Spy},
};
use crate::{Evaluation, Genome, Phenotype, Seed, Task, Threads};
use std::{panic::resume_unwind, sync::Barrier, thread};

/// The sample fits.
pub const SAMPLE: Promise = Promise::new("check of tasks", "at least two genomes of the task's shape");
/// Its shape never changes.
pub const SHAPE: Promise =
    Promise::new("task", "`inputs()`, `outputs()` and `batch_size()` never change, and batches hold at least one");
/// The same again.
pub const DETERMINISTIC: Promise =
    Promise::new("task", "the same phenotype and seed give the same evaluation, whatever was evaluated in between");
/// From anywhere at once.
pub const THREAD_SAFE: Promise = Promise::new("task", "several threads at once get the evaluations that one gets");
/// A batch is its members.
pub const BATCH: Promise =
    Promise::new("task", "a batch of any size and order, on any threads, gives, in order, what its members give alone");
/// It starts with a clean phenotype.
pub const RESETS: Promise = Promise::new("task", "the phenotype is reset before its first step");
/// It keeps to the phenotype's shape.
pub const FEEDS: Promise =
    Promise::new("task", "`activate` gets slices of the declared lengths; an evaluation with a NaN input fails");
/// Wrong shape, no panic.
pub const WRONG_SHAPE_FAILS: Promise =
    Promise::new("task", "a phenotype of another shape gets a failure and changes nothing else in its batch");
/// No success without numbers.
pub const NAN_FAILS: Promise = Promise::new("task", "a phenotype whose outputs are NaN gets a failure");
/// Every number can be written down.
pub const FINITE: Promise = Promise::new("task", "objectives and measurements are finite");

/// All of them.
pub const PROMISES: &[Promise] =
    &[SAMPLE, SHAPE, DETERMINISTIC, THREAD_SAFE, BATCH, RESETS, FEEDS, WRONG_SHAPE_FAILS, NAN_FAILS, FINITE];

/// Checks a task with the phenotypes of a few genomes that behave differently (take [`Puppet::sample`] if there is
/// nothing better) and phenotypes of its own: one that notes how it is treated, some of wrong shape, one whose outputs
/// are NaN.
///
/// # Errors
/// The first promise that is not kept.
pub fn check_task<G: Genome>(task: &dyn Task, sample: &[G], seed: Seed) -> Result<(), Violation> {
    let shape = check_shapes(task, sample)?;
    let check = Check { task, sample, seed };
    let alone = DETERMINISTIC.check(|| check.alone_twice())?;
    alone.iter().enumerate().try_for_each(|(index, evaluation)| {
        FINITE.check(|| finite(evaluation).map_err(|found| format!("genome {index}: {found}")))
    })?;
    THREAD_SAFE.check(|| check.on_threads(&alone))?;
    BATCH.check(|| check.in_batches(&alone))?;
    check.as_spy(shape)?;
    WRONG_SHAPE_FAILS.check(|| check.wrong_shapes(shape, &alone))?;
    NAN_FAILS.check(|| check.not_a_number(shape))
}

struct ThreeThreads;

impl Threads for ThreeThreads {
    fn count(&self) -> usize {
        3
    }

    fn each(&self, work: &(dyn Fn() + Sync)) {
        thread::scope(|scope| (0..self.count()).for_each(|_| drop(scope.spawn(work))));
    }
}

fn check_shapes<G: Genome>(task: &dyn Task, sample: &[G]) -> Result<(usize, usize), Violation> {
    let shape = SHAPE.check(|| {
        let (first, second) = [(); 2].map(|()| (task.inputs(), task.outputs(), task.batch_size())).into();
        match first {
            (.., 0) => Err("a batch size of 0".into()),
            _ if first != second => Err(format!("{first:?} first, {second:?} then")),
            (inputs, outputs, _) => Ok((inputs, outputs)),
        }
    })?;
    SAMPLE.check(|| match sample {
        [] | [_] => Err(format!("{}", sample.len())),
        _ => sample.iter().enumerate().try_for_each(|(index, genome)| {
            let phenotype = genome.express();
            match (phenotype.inputs(), phenotype.outputs()) {
                found if found == shape => Ok(()),
                found => Err(format!("genome {index} has {found:?}, the task {shape:?}")),
            }
        }),
    })?;
    Ok(shape)
}

struct Check<'a, G> {
    task: &'a dyn Task,
    sample: &'a [G],
    seed: Seed,
}

impl<G: Genome> Check<'_, G> {
    fn alone(&self, index: usize, seed: Seed) -> Evaluation {
        self.task.evaluate(&mut self.sample[index].express(), seed)
    }

    fn alone_twice(&self) -> Result<Vec<Evaluation>, String> {
        let all: Vec<usize> = (0..self.sample.len()).collect();
        let first: Vec<Evaluation> = all.iter().map(|&index| self.alone(index, self.seed)).collect();
        for &index in all.iter().rev() {
            self.alone(all.len() - 1 - index, self.seed.generation(self.seed.generation_index() + 1));
            same(&self.alone(index, self.seed), &first[index], &format!("genome {index}, again against first"))?;
        }
        // One phenotype, twice in a row: what the first evaluation left in it must not matter.
        let mut used = self.sample[0].express();
        self.task.evaluate(&mut used, self.seed);
        same(&self.task.evaluate(&mut used, self.seed), &first[0], "genome 0, the same phenotype again against first")?;
        Ok(first)
    }

    fn on_threads(&self, alone: &[Evaluation]) -> Result<(), String> {
        const THREADS: usize = 3;
        let start = Barrier::new(THREADS);
        let work = |thread: usize| {
            start.wait();
            (0..3 * alone.len()).try_for_each(|turn| {
                let index = (turn + thread) % alone.len();
                let what = format!("genome {index} on one of {THREADS} threads against alone");
                same(&self.alone(index, self.seed), &alone[index], &what)
            })
        };
        thread::scope(|scope| {
            let threads: Vec<_> = (0..THREADS).map(|thread| scope.spawn(move || work(thread))).collect();
            let results: Vec<_> = threads.into_iter().map(|thread| thread.join()).collect();
            results.into_iter().try_for_each(|result| result.unwrap_or_else(|panic| resume_unwind(panic)))
        })
    }

    fn in_batches(&self, alone: &[Evaluation]) -> Result<(), String> {
        let forwards: Vec<usize> = (0..alone.len()).collect();
        let backwards: Vec<usize> = forwards.iter().rev().copied().collect();
        let twice = [&forwards[..], &forwards[..]].concat();
        let mut batches: Vec<&[usize]> = vec![&[], &forwards, &backwards, &twice];
        batches.extend(forwards.chunks(1).chain(backwards.chunks(2)).chain(twice.chunks(self.task.batch_size())));
        for batch in batches {
            let mut phenotypes: Vec<G::Phenotype> = batch.iter().map(|&index| self.sample[index].express()).collect();
            let mut members: Vec<&mut dyn Phenotype> = phenotypes.iter_mut().map(|one| one as _).collect();
            let found = self.task.evaluate_batch(&mut members, self.seed);
            if found.len() != batch.len() {
                return Err(format!("{} evaluations for a batch of {}", found.len(), batch.len()));
            }
            for (found, &index) in found.iter().zip(batch) {
                same(found, &alone[index], &format!("genome {index} in the batch {batch:?} against alone"))?;
            }
        }
        let mut phenotypes: Vec<G::Phenotype> = self.sample.iter().map(Genome::express).collect();
        let mut members: Vec<&mut dyn Phenotype> = phenotypes.iter_mut().map(|one| one as _).collect();
        let found = self.task.evaluate_spread(&mut members, self.seed, &ThreeThreads);
        if found.len() != alone.len() {
            return Err(format!("{} evaluations for {} genomes on three threads", found.len(), alone.len()));
        }
        found.iter().zip(alone).enumerate().try_for_each(|(index, (found, alone))| {
            same(found, alone, &format!("genome {index} on three threads against alone"))
        })
    }

    fn as_spy(&self, (inputs, outputs): (usize, usize)) -> Result<(), Violation> {
        let (mut alone, mut batched) = (Spy::new(inputs, outputs), Spy::new(inputs, outputs));
        let evaluations = RESETS.check(|| {
            let mut evaluations = vec![self.task.evaluate(&mut alone, self.seed)];
            alone.use_again();
            evaluations.push(self.task.evaluate(&mut alone, self.seed));
            evaluations.extend(self.task.evaluate_batch(&mut [&mut batched], self.seed));
            match (alone.used_unreset, batched.used_unreset) {
                (false, false) => Ok(evaluations),
                (true, _) => Err("a step of a phenotype not reset".into()),
                (false, true) => Err("a step of a phenotype not reset, in a batch".into()),
            }
        })?;
        FEEDS.check(|| {
            if let Some((found_inputs, found_outputs)) = alone.wrong_slices.or(batched.wrong_slices) {
                return Err(format!(
                    "{found_inputs} inputs and {found_outputs} outputs for a phenotype of {inputs} and {outputs}"
                ));
            }
            match alone.non_finite_input.or(batched.non_finite_input) {
                Some(input) if evaluations.iter().any(|evaluation| evaluation.outcome.is_ok()) => {
                    Err(format!("an input {input}, yet the evaluation has a fitness"))
                }
                _ => Ok(()),
            }
        })
    }

    fn wrong_shapes(&self, (inputs, outputs): (usize, usize), alone: &[Evaluation]) -> Result<(), String> {
        let wrong = [(inputs + 1, outputs), (inputs, outputs + 1), (outputs + 1, inputs + 2), (0, 0)];
        for shape in wrong.into_iter().filter(|&shape| shape != (inputs, outputs)) {
            let misfit = || Puppet::new(shape.0, shape.1, 1).express();
            let failure = |evaluation: &Evaluation, place: &str| match evaluation.fitness() {
                None => Ok(()),
                Some(fitness) => Err(format!("fitness {fitness} {place} for (inputs, outputs) = {shape:?}")),
            };
            failure(&self.task.evaluate(&mut misfit(), self.seed), "alone")?;
            let (mut first, mut second, mut third) = (self.sample[0].express(), misfit(), self.sample[1].express());
            let found = self.task.evaluate_batch(&mut [&mut first, &mut second, &mut third], self.seed);
            let [first, second, third] = &found[..] else {
                return Err(format!("{} evaluations for a batch of 3", found.len()));
            };
            failure(second, "in a batch")?;
            same(first, &alone[0], "genome 0 before a misfit against alone")?;
            same(third, &alone[1], "genome 1 after a misfit against alone")?;
        }
        Ok(())
    }

    fn not_a_number(&self, (inputs, outputs): (usize, usize)) -> Result<(), String> {
        if outputs == 0 {
            return Ok(());
        }
        match self.task.evaluate(&mut NotANumber { inputs, outputs }, self.seed).fitness() {
            None => Ok(()),
            Some(fitness) => Err(format!("fitness {fitness}")),
        }
    }
}

fn finite(evaluation: &Evaluation) -> Result<(), String> {
    let numbered = |what: &str, values: &[f64]| match values.iter().position(|value| !value.is_finite()) {
        Some(index) => Err(format!("{what} {index} is {}", values[index])),
        None => Ok(()),
    };
    numbered("objective", &evaluation.objectives)?;
    match evaluation.measurements.iter().find(|(_, value)| !value.is_finite()) {
        Some((name, value)) => Err(format!("measurement \"{name}\" is {value}")),
        None => Ok(()),
    }
}

/// An error that says in which field two evaluations differ, if they do.
fn same(found: &Evaluation, expected: &Evaluation, what: &str) -> Result<(), String> {
    let fields = |of: &Evaluation| {
        let outcome = match &of.outcome {
            Ok(fitness) => format!("fitness {fitness}"),
            Err(failure) => format!("failure \"{failure}\""),
        };
        // As text, because it tells 0.0 from -0.0 and takes NaN for NaN.
        [
            outcome,
            format!("{} steps", of.steps),
            format!("objectives {:?}", of.objectives),
            format!("measurements {:?}", of.measurements),
        ]
    };
    let differs = |(found, expected): &(String, String)| found != expected;
    match fields(found).into_iter().zip(fields(expected)).find(differs) {
        Some((found, expected)) => Err(format!("{what}: {found} against {expected}")),
        None => Ok(()),
    }
}
