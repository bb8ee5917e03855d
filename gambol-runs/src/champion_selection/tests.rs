use super::{steps::STEPS, *};
use crate::tiers::DEPENDABLE;
use ne_core::{Failure, Fitness};
use serde::{Deserialize, Serialize};
use std::sync::Mutex;

/// A candidate that states what it is worth.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Candidate {
    /// Without variation.
    reference: f64,
    /// In varied worlds; NaN fails there.
    varied: f64,
    usable: bool,
    /// In how many perturbed worlds of the short and the long trial its gait is usable.
    steady: [usize; 2],
    /// In how many near worlds with other commands, of the trial that candidates are compared in and of that with more.
    commanded: [usize; 2],
}

/// The highest tier of a gait that is told nothing.
const HIGHEST: u8 = USABLE + STEPS.len() as u8;

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
    let phenotype: &dyn std::any::Any = phenotype;
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
        assert_eq!(seed, Seed::of_run(7), "all candidates are judged in one world");
        (self.0)(candidate(phenotype))
    }
}

/// A champion selection, those whose gaits it has looked at, and the trials it has held.
struct ScheduledSelection {
    champion_selection: ReferenceSelection,
    seen: Arc<Mutex<Vec<Candidate>>>,
    tried: Arc<Mutex<Vec<Trial>>>,
}

impl ScheduledSelection {
    fn new(lanes: Engine, rapier: Option<Engine>) -> Self {
        let seen: Arc<Mutex<Vec<Candidate>>> = Arc::default();
        let register = seen.clone();
        let usable = move |phenotypes: &[&dyn Phenotype], most: usize| {
            let is_usable = |phenotype: &dyn Phenotype| {
                let candidate = candidate(phenotype);
                register.lock().expect("no test panics here").push(candidate.clone());
                candidate.usable
            };
            (0..phenotypes.len()).filter(|&index| is_usable(phenotypes[index])).take(most).collect()
        };
        let tried: Arc<Mutex<Vec<Trial>>> = Arc::default();
        let register = tried.clone();
        let steadiness = move |phenotype: &dyn Phenotype, trial: Trial, _: usize| {
            register.lock().expect("no test panics here").push(trial);
            let candidate = candidate(phenotype);
            let ([short, long], [commands, more_commands]) = (candidate.steady, candidate.commanded);
            match trial {
                Trial::Short => short,
                Trial::Long => long,
                Trial::Commands => commands,
                Trial::MoreCommands => more_commands,
            }
        };
        let champion_selection = ReferenceSelection {
            task: Box::new(Fake(lanes)),
            reference: rapier.map(|rapier| Box::new(Fake(rapier)) as Box<dyn Task>),
            proof: Some(Box::new(Fake(|candidate| Evaluation::new(candidate.varied)))),
            usable: Some(Box::new(usable)),
            steadiness: Some(Box::new(steadiness)),
            steps: STEPS.into(),
            steadiest: None,
            choice: Choice::of(false, false),
            seed: Seed::of_run(7),
            evaluator: Arc::new(Parallel::new(1).expect("a thread starts")),
        };
        Self { champion_selection, seen, tried }
    }

    /// The tiers, and the fitness of those whose gait was looked at, in this order.
    fn tiers(&self, candidates: &[Candidate], standing: Option<TieredFitness>) -> (Vec<u8>, Vec<f64>) {
        let ReEvaluation { tiers, .. } = self.champion_selection.judge(candidates, standing);
        let seen = std::mem::take(&mut *self.seen.lock().expect("no test panics here"));
        (tiers, seen.iter().map(|candidate| candidate.reference).collect())
    }

    /// The trials that were held.
    fn tried(&self) -> Vec<Trial> {
        std::mem::take(&mut *self.tried.lock().expect("no test panics here"))
    }
}

fn reference(candidate: &Candidate) -> Evaluation {
    Evaluation::new(candidate.reference)
}

fn failed(_: &Candidate) -> Evaluation {
    Evaluation::failed(Failure::Other { what: "it fell apart".into() })
}

/// Fitness without variation and with it, and whether the gait is usable; if so, then in every perturbed world.
fn candidates(all: &[(f64, f64, bool)]) -> Vec<Candidate> {
    let steady = |usable| if usable { [15, 16] } else { [0, 0] };
    all.iter()
        .map(|&(reference, varied, usable)| Candidate {
            reference,
            varied,
            usable,
            steady: steady(usable),
            commanded: [0, 0],
        })
        .collect()
}

fn standing(tier: u8, fitness: f64) -> Option<TieredFitness> {
    Some(TieredFitness { tier, fitness: Fitness::new(fitness).expect("finite") })
}

#[test]
fn what_rapier_confirms_stands() {
    let candidates = candidates(&[(1.0, 1.0, false), (-3.0, 1.0, false), (2.5, 1.0, false)]);
    let judge = |lanes, rapier| ScheduledSelection::new(lanes, rapier).champion_selection.judge(&candidates, None);
    let alone = judge(reference, None);
    assert_eq!(alone.evaluations, [1.0, -3.0, 2.5].map(Evaluation::new));
    assert!(!alone.diverged);
    assert_eq!(judge(reference, Some(reference)), alone);
    assert_eq!(judge(failed, Some(reference)), judge(failed, None), "there is no candidate to confirm");
}

#[test]
fn where_lanes_and_rapier_part_all_are_judged_in_rapier() {
    let candidates = candidates(&[(1.0, 1.0, true), (3.0, 1.0, true), (2.5, 1.0, true)]);
    let judge = |lanes, rapier| ScheduledSelection::new(lanes, rapier).champion_selection.judge(&candidates, None);
    let off: Engine = |candidate| Evaluation::new(10.0 - candidate.reference);
    let by_a_bit: Engine = |candidate| Evaluation::new(candidate.reference.next_up());
    for rapier in [off, by_a_bit, failed] {
        let alone = judge(rapier, None);
        assert_eq!(
            judge(reference, Some(rapier)),
            ReEvaluation { diverged: true, ..alone },
            "tiers are those of rapier too"
        );
    }
}

/// A slow champion that is usable, and no more.
const SLOW: f64 = 0.1;

fn slow() -> Option<TieredFitness> {
    standing(USABLE, SLOW)
}

/// The candidate with the best tier is champion: so a usable one, and of those the one that is usable in more worlds.
#[test]
fn a_usable_candidate_stands_above_a_fitter_one_that_is_not() {
    let selection = ScheduledSelection::new(reference, None);
    let all = candidates(&[(9.0, 9.0, false), (5.0, 5.0, true), (7.0, 7.0, false), (6.0, 6.0, true)]);
    let (tiers, seen) = selection.tiers(&all, slow());
    assert_eq!(tiers, [0, 0, 0, HIGHEST]);
    assert_eq!(seen, [9.0, 7.0, 6.0], "the best first, until one is usable");
    let unusable = candidates(&[(9.0, 9.0, false), (7.0, 7.0, false)]);
    assert_eq!(selection.tiers(&unusable, slow()), (vec![0, 0], vec![9.0, 7.0]));
}

#[test]
fn the_first_usable_champion_is_not_tried() {
    let selection = ScheduledSelection::new(reference, None);
    let all = candidates(&[(9.0, 9.0, false), (5.0, 5.0, true)]);
    for standing in [None, standing(0, 100.0)] {
        assert_eq!(selection.tiers(&all, standing), (vec![0, USABLE], vec![9.0, 5.0]));
        assert!(selection.tried().is_empty());
    }
    assert_eq!(selection.tiers(&all, slow()).0, [0, HIGHEST]);
    assert_eq!(selection.tried(), [Trial::Short, Trial::Long]);
}

#[test]
fn a_champion_that_a_run_begins_with_has_the_tier_that_it_earns() {
    let mut selection = ScheduledSelection::new(reference, None);
    selection.champion_selection.choice = Choice::of(false, true);
    let brought = candidates(&[(5.0, 5.0, true)]);
    assert_eq!(selection.tiers(&brought, None).0, [HIGHEST]);
}

#[test]
fn the_more_worlds_a_gait_is_usable_in_the_higher_its_tier() {
    let selection = ScheduledSelection::new(reference, None);
    let tier = |steady| {
        let one = Candidate { reference: 1.0, varied: 1.0, usable: true, steady, commanded: [0, 0] };
        selection.tiers(&[one], slow()).0[0]
    };
    let short: Vec<u8> = (0..=15).map(|worlds| tier([worlds, 0])).collect();
    assert_eq!(short, [1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 4, 4, 4, 4, 4]);
    let both: Vec<u8> = (0..=16).map(|worlds| tier([14, worlds])).collect();
    assert_eq!(both, [4, 4, 4, 4, 4, 5, 5, 5, 6, 6, 6, 7, 7, 7, 8, 8, 9]);
    selection.tried();
    // A candidate less fit than the champion must be steadier, or it counts as usable and no more.
    let against = |champion: u8, steady| {
        let one = Candidate { reference: 1.0, varied: 1.0, usable: true, steady, commanded: [0, 0] };
        (selection.tiers(&[one], standing(champion, 2.0)).0[0], selection.tried())
    };
    let (short, both) = (vec![Trial::Short], vec![Trial::Short, Trial::Long]);
    assert_eq!(against(USABLE, [3, 16]), (USABLE, short.clone()), "the long trial is for what passes the short one");
    assert_eq!(against(USABLE, [4, 16]), (USABLE + 1, short.clone()));
    assert_eq!(against(USABLE + 2, [11, 7]), (USABLE + 3, both.clone()));
    assert_eq!(against(USABLE + 3, [10, 16]), (USABLE, short.clone()));
    assert_eq!(against(USABLE + 3, [13, 15]), (USABLE + 7, both.clone()), "worlds of both count alike");
    assert_eq!(against(USABLE + 3, [14, 4]), (USABLE, both.clone()));
    assert_eq!(against(USABLE + 4, [14, 7]), (USABLE, both.clone()));
    assert_eq!(against(USABLE + 4, [14, 8]), (USABLE + 5, both));
    assert_eq!(against(HIGHEST - 1, [13, 16]), (USABLE, short), "not even the whole long trial would do");
    assert_eq!(against(HIGHEST, [15, 16]), (0, vec![]), "it could not become champion");
}

/// The first of the candidates that are usable in most worlds, and in how many.
fn most(phenotypes: &[&dyn Phenotype], worlds: fn(&Candidate) -> usize) -> Option<(usize, usize)> {
    let counts = phenotypes.iter().map(|phenotype| worlds(candidate(*phenotype))).enumerate();
    counts.min_by_key(|&(_, worlds)| Reverse(worlds))
}

/// What a gait earns says little of how often it fails.
#[test]
fn usable_gaits_are_compared_but_for_the_first() {
    let mut selection = ScheduledSelection::new(reference, None);
    selection.champion_selection.steadiest =
        Some(Box::new(|phenotypes| most(phenotypes, |candidate| candidate.steady[0])));
    let of = |reference, short| Candidate {
        reference,
        varied: reference,
        usable: true,
        steady: [short, 0],
        commanded: [0, 0],
    };
    let all = [of(9.0, 4), of(8.0, 8), of(7.0, 12), of(6.0, 11), of(5.0, 15)];
    assert_eq!(selection.tiers(&all, None).0, [USABLE, 0, 0, 0, 0]);
    assert_eq!(selection.tiers(&all, slow()).0, [0, 0, USABLE + 3, 0, 0], "of the four that are the fittest");
    assert_eq!(selection.tried(), [Trial::Long], "the short trial is not held again");
}

/// A champion selection of gaits that are told what to do.
fn of_commanded() -> ScheduledSelection {
    let mut selection = ScheduledSelection::new(reference, None);
    selection.champion_selection.steps = steps(true);
    selection.champion_selection.choice = Choice::of(true, false);
    let register = selection.tried.clone();
    let steadiest = move |phenotypes: &[&dyn Phenotype]| {
        register.lock().expect("no test panics here").extend(phenotypes.iter().map(|_| Trial::Commands));
        most(phenotypes, |candidate| candidate.commanded[0])
    };
    selection.champion_selection.steadiest = Some(Box::new(steadiest));
    selection
}

/// That it does as it is told comes first: what fails at it is not tried in perturbed worlds.
#[test]
fn a_gait_that_is_told_what_to_do_is_told_more_before_it_is_tried_in_perturbed_worlds() {
    let selection = of_commanded();
    let tier = |schedules, steady| {
        let one = Candidate { reference: 1.0, varied: 1.0, usable: true, steady, commanded: [0, schedules] };
        selection.tiers(&[one], slow()).0[0]
    };
    let told: Vec<u8> =
        [7, 8, 15, 16, 20, 24, 25, 26, 28, 30, 31, 32].map(|schedules| tier(schedules, [15, 16])).into();
    assert_eq!(told, [1, 2, 2, 3, 4, 5, 5, 6, 7, 22, 23, 23]);
    assert_eq!([[3, 16], [4, 0], [15, 0], [1, 0]].map(|steady| tier(32, steady)), [17, 10, 15, DEPENDABLE]);
    assert_eq!(tier(30, [6, 0]), tier(32, [4, 0]), "a schedule is worth a world");
    selection.tried();
    tier(29, [15, 16]);
    assert_eq!(selection.tried(), [Trial::MoreCommands]);
    tier(30, [0, 0]);
    assert_eq!(selection.tried(), [Trial::MoreCommands, Trial::Short, Trial::Long]);
}

/// Else a later candidate with a low tier would take the place of what a stage before has found.
#[test]
fn the_first_champion_that_does_as_it_is_told_has_the_tier_that_it_earns() {
    let selection = of_commanded();
    let one =
        |schedules| Candidate { reference: 1.0, varied: 1.0, usable: true, steady: [0, 0], commanded: [schedules; 2] };
    for standing in [None, standing(0, 100.0)] {
        assert_eq!(selection.tiers(&[one(30), one(16)], standing).0, [8, 0]);
    }
    assert_eq!(selection.tiers(&[one(16)], standing(8, 1.0)).0, [USABLE], "and what is worse is no better than usable");
}

/// What a gait earns says little of how often it fails.
#[test]
fn of_gaits_that_are_told_what_to_do_all_that_are_usable_are_compared() {
    let selection = of_commanded();
    let of = |reference, usable, schedules| Candidate {
        reference,
        varied: reference,
        usable,
        steady: [0, 0],
        commanded: [schedules, 24],
    };
    let all = [of(9.0, true, 8), of(8.0, true, 14), of(7.0, false, 16), of(6.0, true, 14), of(5.0, true, 13)];
    assert_eq!(selection.tiers(&all, slow()), (vec![0, 5, 0, 0, 0], vec![9.0, 8.0, 7.0, 6.0, 5.0]));
    let compared = [Trial::Commands; 4];
    assert_eq!(selection.tried(), [&compared[..], &[Trial::MoreCommands]].concat());
    selection.tiers(&all[..1], slow());
    assert_eq!(selection.tried(), [Trial::MoreCommands], "with nothing else to be compared with");
    // What keeps little of its fitness is not compared with what keeps most of it.
    let little = Candidate { varied: 0.5, ..of(9.0, true, 16) };
    assert_eq!(selection.tiers(&[little, of(8.0, true, 10)], slow()).0, [0, 5]);
    // So many, the fittest.
    let many: Vec<Candidate> = (0..=16).map(|index| of(100.0 + f64::from(index), true, 16 - index as usize)).collect();
    assert_eq!(selection.tiers(&many, slow()).0[..3], [0, 5, 0]);
}

#[test]
fn a_candidate_that_keeps_little_of_its_fitness_in_training_worlds_gets_hardly_more_than_usable() {
    let selection = ScheduledSelection::new(reference, None);
    let tier = |one: (f64, f64, bool)| selection.tiers(&candidates(&[one]), slow()).0[0];
    for whole in [(2.0, 6.0, true), (2.0, 2.0, true), (2.0, 0.5, true)] {
        assert_eq!(tier(whole), HIGHEST, "{whole:?}");
    }
    for little in [(2.0, 0.4, true), (2.0, -6.0, true), (2.0, f64::NAN, true)] {
        assert_eq!(tier(little), USABLE + 1, "{little:?}");
    }
    // The candidate that keeps more comes first, then the fitter one.
    let all = candidates(&[(9.0, 0.9, true), (5.0, 4.9, true), (7.0, f64::NAN, true), (6.0, 0.6, true)]);
    assert_eq!(selection.tiers(&all, slow()), (vec![0, HIGHEST, 0, 0], vec![5.0]));
    let alike = candidates(&[(5.0, 5.0, true), (9.0, 8.9, true)]);
    assert_eq!(selection.tiers(&alike, slow()), (vec![0, HIGHEST], vec![9.0]));
}

#[test]
fn a_candidate_with_less_than_half_of_the_best_fitness_is_not_credited_for_keeping_it() {
    let selection = ScheduledSelection::new(reference, None);
    let tiers = |slower: f64| selection.tiers(&candidates(&[(10.0, 0.1, true), (slower, slower, true)]), slow()).0;
    assert_eq!((tiers(4.9), tiers(5.0)), (vec![USABLE + 1, 0], vec![0, HIGHEST]));
}

#[test]
fn where_those_that_keep_most_are_not_usable_the_fittest_have_their_turn() {
    let selection = ScheduledSelection::new(reference, None);
    let safe = [(6.0, 6.0, false), (6.1, 6.1, false), (6.2, 6.2, false), (6.3, 6.3, false), (6.4, 6.4, true)];
    let all = candidates(&[&safe[..], &[(9.0, 0.9, true), (10.0, 1.0, false)]].concat());
    assert_eq!(selection.tiers(&all, slow()), (vec![0, 0, 0, 0, HIGHEST, 0, 0], vec![6.4]));
    let without = [&all[..4], &all[5..]].concat();
    let seen = vec![6.3, 6.2, 6.1, 6.0, 10.0, 9.0];
    assert_eq!(selection.tiers(&without, slow()), (vec![0, 0, 0, 0, USABLE + 1, 0], seen), "none is looked at twice");
}

#[test]
fn only_candidates_that_could_become_champion_are_looked_at_and_of_those_few() {
    let selection = ScheduledSelection::new(reference, None);
    let all: Vec<(f64, f64, bool)> = (1..=10).map(|fitness| (fitness.into(), fitness.into(), fitness <= 2)).collect();
    let all = candidates(&all);
    assert_eq!(selection.tiers(&all, None), (vec![0; 10], vec![10.0, 9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 3.0]));
    assert_eq!(selection.tiers(&all, standing(HIGHEST, 10.0)), (vec![0; 10], vec![]));
    assert_eq!(selection.tiers(&all, standing(HIGHEST, 8.5)), (vec![0; 10], vec![10.0, 9.0]));
    assert_eq!(selection.tiers(&all[..3], standing(HIGHEST - 1, 100.0)), (vec![0, HIGHEST, 0], vec![3.0, 2.0]));
    let failed = ScheduledSelection::new(failed, None);
    assert_eq!(failed.tiers(&all, None), (vec![0; 10], vec![]), "a failed candidate has no gait");
}

#[test]
fn without_varied_worlds_none_is_tried_and_without_a_judged_movement_none_is_given_a_tier() {
    let all = candidates(&[(1.0, 1.0, true), (3.0, 3.0, true)]);
    let mut selection = ScheduledSelection::new(reference, None);
    (selection.champion_selection.proof, selection.champion_selection.steadiness) = (None, None);
    assert_eq!(selection.tiers(&all, slow()), (vec![0, USABLE], vec![3.0]));
    selection.champion_selection.usable = None;
    assert_eq!(selection.tiers(&all, slow()), (vec![0, 0], vec![]));
}
