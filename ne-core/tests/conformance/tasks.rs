use crate::{Cases, assert_caught};
use ne_core::{
    Evaluation, Phenotype, Seed, Task,
    conformance::{Puppet, check_task, task::*},
};
use std::{
    sync::atomic::{AtomicU64, AtomicUsize, Ordering},
    thread,
    time::Duration,
};

/// Ten steps; the fitness is the sum of the outputs. With one flaw.
struct Flawed {
    flaw: Flaw,
    evaluated: AtomicU64,
    under_way: AtomicUsize,
}

#[derive(Clone, Copy, PartialEq)]
enum Flaw {
    None,
    NoBatches,
    ShapeGrows,
    LearnsFromOthers,
    SeesOtherThreads,
    BatchBackwards,
    BatchTooShort,
    BatchSharesAWorld,
    KeepsThePhenotypesState,
    FeedsTooMuch,
    FeedsNan,
    PanicsAtOtherShapes,
    TakesOtherShapes,
    MisfitSpoilsTheBatch,
    ClampsNan,
    MeasuresNan,
}

impl Flawed {
    fn new(flaw: Flaw) -> Self {
        Self { flaw, evaluated: AtomicU64::new(0), under_way: AtomicUsize::new(0) }
    }

    fn is(&self, flaw: Flaw) -> bool {
        self.flaw == flaw
    }
}

impl Task for Flawed {
    fn inputs(&self) -> usize {
        2 + usize::from(self.is(Flaw::ShapeGrows)) * self.evaluated.fetch_add(1, Ordering::Relaxed) as usize
    }

    fn outputs(&self) -> usize {
        1
    }

    fn batch_size(&self) -> usize {
        if self.is(Flaw::NoBatches) { 0 } else { 2 }
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        match self.check_shape(phenotype) {
            Ok(()) => {}
            Err(failure) if self.is(Flaw::PanicsAtOtherShapes) => panic!("{failure}"),
            Err(_) if self.is(Flaw::TakesOtherShapes) => return Evaluation::new(-1e9),
            Err(failure) => return Evaluation::failed(failure),
        }
        if !self.is(Flaw::KeepsThePhenotypesState) {
            phenotype.reset();
        }
        let mut inputs = vec![seed.run_seed() as f32; if self.is(Flaw::FeedsTooMuch) { 3 } else { 2 }];
        let (mut sum, mut outputs) = (0.0, [0.0]);
        for step in 0..10 {
            inputs[1] = if self.is(Flaw::FeedsNan) && step == 7 { f32::NAN } else { step as f32 };
            phenotype.activate(&inputs, &mut outputs);
            sum += f64::from(if self.is(Flaw::ClampsNan) { outputs[0].clamp(-1.0, 1.0).max(-1.0) } else { outputs[0] });
            if self.is(Flaw::FeedsNan) && sum.is_nan() {
                sum = 0.0;
            }
        }
        if self.is(Flaw::LearnsFromOthers) {
            sum += self.evaluated.fetch_add(1, Ordering::Relaxed) as f64;
        }
        if self.is(Flaw::SeesOtherThreads) {
            self.under_way.fetch_add(1, Ordering::SeqCst);
            thread::sleep(Duration::from_millis(2));
            sum += self.under_way.load(Ordering::SeqCst) as f64;
            self.under_way.fetch_sub(1, Ordering::SeqCst);
        }
        let mut evaluation = Evaluation::new(sum).with_steps(10);
        if self.is(Flaw::MeasuresNan) {
            evaluation.measurements.insert("speed", f64::NAN);
        }
        evaluation
    }

    fn evaluate_batch(&self, phenotypes: &mut [&mut dyn Phenotype], seed: Seed) -> Vec<Evaluation> {
        let count = phenotypes.len() as f64;
        let mut all: Vec<_> = phenotypes.iter_mut().map(|phenotype| self.evaluate(&mut **phenotype, seed)).collect();
        match self.flaw {
            Flaw::BatchBackwards => all.reverse(),
            Flaw::BatchTooShort if all.len() > 2 => drop(all.pop()),
            Flaw::BatchSharesAWorld => all
                .iter_mut()
                .filter_map(|one| Some((one.fitness()?, one)))
                .for_each(|(fitness, one)| *one = Evaluation::new(fitness.get() / count).with_steps(10)),
            Flaw::MisfitSpoilsTheBatch => {
                if let Some(failed) = all.iter().find(|one| one.outcome.is_err()).cloned() {
                    all.fill(failed);
                }
            }
            _ => {}
        }
        all
    }
}

#[test]
fn broken_tasks_are_caught() {
    let seed = Seed::of_run(3);
    let check = |flaw: Flaw| check_task(&Flawed::new(flaw), &Puppet::sample(2, 1, 4), seed);
    assert_eq!(check(Flaw::None), Ok(()));
    let good = Flawed::new(Flaw::None);
    let cases: Cases<'_> = vec![
        (SAMPLE, "a sample of another shape", check_task(&good, &Puppet::sample(3, 1, 4), seed)),
        (SAMPLE, "a sample of one", check_task(&good, &Puppet::sample(2, 1, 1), seed)),
        (SHAPE, "a batch of none", check(Flaw::NoBatches)),
        (SHAPE, "shape grows", check(Flaw::ShapeGrows)),
        (DETERMINISTIC, "learns from others", check(Flaw::LearnsFromOthers)),
        (DETERMINISTIC, "keeps the phenotype's state", check(Flaw::KeepsThePhenotypesState)),
        (THREAD_SAFE, "sees other threads", check(Flaw::SeesOtherThreads)),
        (BATCH, "batch backwards", check(Flaw::BatchBackwards)),
        (BATCH, "batch too short", check(Flaw::BatchTooShort)),
        (BATCH, "batch shares a world", check(Flaw::BatchSharesAWorld)),
        (FEEDS, "feeds too much", check(Flaw::FeedsTooMuch)),
        (FEEDS, "feeds NaN", check(Flaw::FeedsNan)),
        (WRONG_SHAPE_FAILS, "panics at other shapes", check(Flaw::PanicsAtOtherShapes)),
        (WRONG_SHAPE_FAILS, "takes other shapes", check(Flaw::TakesOtherShapes)),
        (WRONG_SHAPE_FAILS, "a misfit spoils the batch", check(Flaw::MisfitSpoilsTheBatch)),
        (NAN_FAILS, "clamps NaN", check(Flaw::ClampsNan)),
        (FINITE, "measures NaN", check(Flaw::MeasuresNan)),
        (RESETS, "does not reset phenotypes without memory", check_task(&NoReset, &[Stateless(1), Stateless(2)], seed)),
    ];
    assert_caught(&cases, PROMISES);
}

/// A task that never resets, which shows in no score as long as phenotypes have no memory.
struct NoReset;

impl Task for NoReset {
    fn inputs(&self) -> usize {
        0
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        let mut outputs = [0.0];
        phenotype.activate(&[], &mut outputs);
        Evaluation::new(f64::from(outputs[0]))
    }
}

#[derive(Clone, serde::Serialize, serde::Deserialize)]
struct Stateless(u8);

impl ne_core::Genome for Stateless {
    type Phenotype = Self;

    fn express(&self) -> Self {
        self.clone()
    }
}

impl Phenotype for Stateless {
    fn inputs(&self) -> usize {
        0
    }

    fn outputs(&self) -> usize {
        1
    }

    fn reset(&mut self) {}

    fn activate(&mut self, _: &[f32], outputs: &mut [f32]) {
        outputs[0] = f32::from(self.0);
    }
}
