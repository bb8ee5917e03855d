use super::*;
use ne_core::{Failure, Fitness};
use serde::{Deserialize, Serialize};
use std::sync::Mutex;

/// A finalist who wears on its sleeve what it is worth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Candidate {
    /// Without variation.
    nominal: f64,
    /// In varied worlds; NaN fails there.
    varied: f64,
    usable: bool,
}

impl Genome for Candidate {
    type Phenotype = Self;

    fn express(&self) -> Self {
        self.clone()
    }
}

impl Phenotype for Candidate {
    fn inputs(&self) -> usize {
        0
    }

    fn outputs(&self) -> usize {
        1
    }

    fn reset(&mut self) {}

    fn activate(&mut self, _: &[f32], _: &mut [f32]) {
        unreachable!("a fake reads its worth")
    }
}

fn candidate(phenotype: &dyn Phenotype) -> &Candidate {
    let phenotype: &dyn Any = phenotype;
    phenotype.downcast_ref().expect("a candidate")
}

/// What one engine finds a candidate to be worth.
type Engine = fn(&Candidate) -> Evaluation;

struct Fake(Engine);

impl Task for Fake {
    fn inputs(&self) -> usize {
        0
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        assert_eq!(seed, Seed::of_run(7), "everybody is judged in one world");
        (self.0)(candidate(phenotype))
    }
}

/// A jury, and those whose gaits it has looked at.
struct Court {
    jury: NominalJury,
    seen: Arc<Mutex<Vec<Candidate>>>,
}

impl Court {
    fn new(lanes: Engine, rapier: Option<Engine>) -> Self {
        let seen: Arc<Mutex<Vec<Candidate>>> = Arc::default();
        let register = seen.clone();
        let usable = move |phenotype: &dyn Phenotype| {
            let candidate = candidate(phenotype);
            register.lock().expect("no test panics here").push(candidate.clone());
            candidate.usable
        };
        let jury = NominalJury {
            task: Box::new(Fake(lanes)),
            reference: rapier.map(|rapier| Box::new(Fake(rapier)) as Box<dyn Task>),
            proof: Some(Box::new(Fake(|candidate| Evaluation::new(candidate.varied)))),
            usable: Some(Box::new(usable)),
            seed: Seed::of_run(7),
            evaluator: Arc::new(Parallel::new(1).expect("a thread starts")),
        };
        Self { jury, seen }
    }

    /// The grades, and the fitness of those whose gait was looked at, in this order.
    fn grades(&self, candidates: &[Candidate], standing: Option<Standing>) -> (Vec<u8>, Vec<f64>) {
        let Judgement { grades, .. } = self.jury.judge(candidates, standing);
        let seen = std::mem::take(&mut *self.seen.lock().expect("no test panics here"));
        (grades, seen.iter().map(|candidate| candidate.nominal).collect())
    }
}

fn nominal(candidate: &Candidate) -> Evaluation {
    Evaluation::new(candidate.nominal)
}

fn failed(_: &Candidate) -> Evaluation {
    Evaluation::failed(Failure::Other { what: "it fell apart".into() })
}

/// Fitness without variation and with it, and whether the gait is usable.
fn candidates(all: &[(f64, f64, bool)]) -> Vec<Candidate> {
    all.iter().map(|&(nominal, varied, usable)| Candidate { nominal, varied, usable }).collect()
}

fn standing(grade: u8, fitness: f64) -> Option<Standing> {
    Some(Standing { grade, fitness: Fitness::new(fitness).expect("finite") })
}

#[test]
fn what_rapier_confirms_stands() {
    let candidates = candidates(&[(1.0, 1.0, false), (-3.0, 1.0, false), (2.5, 1.0, false)]);
    let judge = |lanes, rapier| Court::new(lanes, rapier).jury.judge(&candidates, None);
    let alone = judge(nominal, None);
    assert_eq!(alone.evaluations, [1.0, -3.0, 2.5].map(Evaluation::new));
    assert!(!alone.parted);
    assert_eq!(judge(nominal, Some(nominal)), alone);
    assert_eq!(judge(failed, Some(nominal)), judge(failed, None), "there is nobody to confirm");
}

#[test]
fn where_lanes_and_rapier_part_all_are_judged_in_rapier() {
    let candidates = candidates(&[(1.0, 1.0, true), (3.0, 1.0, true), (2.5, 1.0, true)]);
    let judge = |lanes, rapier| Court::new(lanes, rapier).jury.judge(&candidates, None);
    let off: Engine = |candidate| Evaluation::new(10.0 - candidate.nominal);
    let by_a_bit: Engine = |candidate| Evaluation::new(candidate.nominal.next_up());
    for rapier in [off, by_a_bit, failed] {
        let alone = judge(rapier, None);
        assert_eq!(judge(nominal, Some(rapier)), Judgement { parted: true, ..alone }, "grades are those of rapier too");
    }
}

/// Usable, and keeps all of its fitness.
const BEST: u8 = USABLE + DEGREES;

/// Who is graded best is champion: so a usable one, and of those the one that keeps more.
#[test]
fn a_usable_finalist_stands_above_a_fitter_one_that_is_not() {
    let court = Court::new(nominal, None);
    let all = candidates(&[(9.0, 9.0, false), (5.0, 5.0, true), (7.0, 7.0, false), (6.0, 6.0, true)]);
    let (grades, seen) = court.grades(&all, None);
    assert_eq!(grades, [0, 0, 0, BEST]);
    assert_eq!(seen, [9.0, 7.0, 6.0], "the best first, until one is usable");
    let nobody = candidates(&[(9.0, 9.0, false), (7.0, 7.0, false)]);
    assert_eq!(court.grades(&nobody, None), (vec![0, 0], vec![9.0, 7.0]));
}

#[test]
fn of_usable_finalists_the_one_that_keeps_more_of_its_fitness_stands_above_the_fitter() {
    let court = Court::new(nominal, None);
    let all = candidates(&[(9.0, 0.9, true), (5.0, 4.9, true), (7.0, f64::NAN, true), (6.0, 0.6, true)]);
    assert_eq!(court.grades(&all, None), (vec![0, BEST, 0, 0], vec![5.0]));
    // Where they keep as much, fitness decides.
    let alike = candidates(&[(5.0, 5.0, true), (9.0, 8.9, true)]);
    assert_eq!(court.grades(&alike, None).0, [0, BEST]);
    // More than all of it cannot be kept, and of nothing, or less, nothing.
    let grade = |one: (f64, f64, bool)| court.grades(&candidates(&[one]), None).0[0];
    assert_eq!(grade((2.0, 6.0, true)), BEST);
    assert!((USABLE..BEST).contains(&grade((2.0, 1.0, true))), "half is less than all");
    for worthless in [(2.0, -6.0, true), (0.0, 1.0, true), (-2.0, -1.0, true), (2.0, f64::NAN, true)] {
        assert_eq!(grade(worthless), USABLE, "{worthless:?}");
    }
}

#[test]
fn who_has_less_than_half_of_the_best_fitness_is_not_credited_for_keeping_it() {
    let court = Court::new(nominal, None);
    let grades = |slow: f64| court.grades(&candidates(&[(10.0, 0.1, true), (slow, slow, true)]), None).0;
    assert_eq!((grades(4.9), grades(5.0)), (vec![USABLE, 0], vec![0, BEST]));
}

#[test]
fn where_those_who_keep_most_are_not_usable_the_fittest_have_their_turn() {
    let court = Court::new(nominal, None);
    let safe = [(6.0, 6.0, false), (6.1, 6.1, false), (6.2, 6.2, false), (6.3, 6.3, false), (6.4, 6.4, true)];
    let all = candidates(&[&safe[..], &[(9.0, 0.9, true), (10.0, 1.0, false)]].concat());
    assert_eq!(court.grades(&all, None), (vec![0, 0, 0, 0, BEST, 0, 0], vec![6.4]));
    let without = [&all[..4], &all[5..]].concat();
    let seen = vec![6.3, 6.2, 6.1, 6.0, 10.0, 9.0];
    assert_eq!(court.grades(&without, None), (vec![0, 0, 0, 0, USABLE, 0], seen), "nobody is looked at twice");
}

#[test]
fn only_who_could_become_champion_is_looked_at_and_of_those_few() {
    let court = Court::new(nominal, None);
    let all: Vec<(f64, f64, bool)> = (1..=6).map(|fitness| (fitness.into(), fitness.into(), fitness <= 2)).collect();
    let all = candidates(&all);
    assert_eq!(court.grades(&all, None), (vec![0; 6], vec![6.0, 5.0, 4.0, 3.0]));
    assert_eq!(court.grades(&all, standing(BEST, 6.0)), (vec![0; 6], vec![]));
    assert_eq!(court.grades(&all, standing(BEST, 4.5)), (vec![0; 6], vec![6.0, 5.0]));
    assert_eq!(court.grades(&all[..3], standing(BEST - 1, 100.0)), (vec![0, BEST, 0], vec![3.0, 2.0]));
    let failed = Court::new(failed, None);
    assert_eq!(failed.grades(&all, None), (vec![0; 6], vec![]), "who failed has no gait");
}

#[test]
fn without_varied_worlds_nothing_is_kept_and_without_a_judged_movement_nobody_is_graded() {
    let all = candidates(&[(1.0, 1.0, true), (3.0, 3.0, true)]);
    let mut court = Court::new(nominal, None);
    court.jury.proof = None;
    assert_eq!(court.grades(&all, None), (vec![0, USABLE], vec![3.0]));
    court.jury.usable = None;
    assert_eq!(court.grades(&all, None), (vec![0, 0], vec![]));
}
