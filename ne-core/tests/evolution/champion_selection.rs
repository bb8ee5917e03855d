//! Champions chosen by a champion selection.

use crate::{
    TASK,
    common::{Climber, Weights},
    scripted::{Prompter, Script, Unused},
    state,
};
use ne_core::{
    Candidate, Champion, Checkpoint, Evaluation, Evaluator, Evolution, Fitness, Parallel, Progress, Seed, Serial,
    StopConditions, StopReason, TieredFitness,
    champion_selection::{ChampionSelection, ReEvaluation, ReEvaluationReport, ReEvaluations},
    conformance::Puppet,
};
use proptest::prelude::*;
use std::sync::{Arc, Mutex};

const FAILED: f64 = f64::NAN;
const WORLD: Seed = Seed::of_run(99);

/// Knows beforehand what each genome of a script is worth, and keeps the candidates that it judged.
#[derive(Clone, Default)]
struct Known {
    /// The same shape as the script.
    worth: Vec<Vec<f64>>,
    /// The same shape, or shorter: a genome that is not in it has tier 0.
    tiers: Vec<Vec<u8>>,
    heard: Arc<Mutex<Vec<Vec<Puppet>>>>,
    diverged: bool,
    takes_recommendation: bool,
}

fn genome(generation: u64, index: u64) -> Puppet {
    Puppet::new(0, 1, 100 * generation + index)
}

impl ChampionSelection<Puppet> for Known {
    fn seed(&self) -> Seed {
        WORLD
    }

    fn takes_recommendation(&self) -> bool {
        self.takes_recommendation
    }

    fn judge(&self, candidates: &[Puppet], _: Option<TieredFitness>) -> ReEvaluation {
        self.heard.lock().expect("no test panics here").push(candidates.to_vec());
        let worth = |candidate: &Puppet| Evaluation::new(entry(&self.worth, candidate).unwrap_or(FAILED));
        let tier = |candidate: &Puppet| entry(&self.tiers, candidate).unwrap_or(0);
        let tiers = if self.tiers.is_empty() { Vec::new() } else { candidates.iter().map(tier).collect() };
        ReEvaluation { evaluations: candidates.iter().map(worth).collect(), tiers, diverged: self.diverged }
    }
}

/// What a table of the script's shape says of a genome.
fn entry<T: Copy>(table: &[Vec<T>], candidate: &Puppet) -> Option<T> {
    let lines = (1..).zip(table);
    let all = lines.flat_map(|(line, entries)| (0..).zip(entries).map(move |(index, entry)| (line, index, entry)));
    let mut mine = all.filter(|&(line, index, _)| genome(line, index) == *candidate);
    mine.next().map(|(_, _, &entry)| entry)
}

/// A run of these fitnesses in training before a champion selection to which they are worth `worth`.
fn scripted(lines: &[&[f64]], worth: &[&[f64]], re_evaluations: ReEvaluations) -> (Evolution<Script>, Known) {
    let known = Known { worth: worth.iter().map(|line| line.to_vec()).collect(), ..Known::default() };
    let stop = StopConditions { generations: Some(lines.len() as u64), ..Default::default() };
    (Script::evolution(lines, stop).with_champion_selection(re_evaluations, known.clone()), known)
}

fn fitness(value: f64) -> Fitness {
    Fitness::new(value).expect("finite")
}

#[test]
fn the_best_of_each_generation_and_several_of_the_last_are_heard() {
    let lines: &[&[f64]] = &[&[1.0, 3.0, 2.0], &[FAILED, FAILED, FAILED], &[5.0, 7.0, 6.0], &[9.0, 9.0, 1.0]];
    let worth: &[&[f64]] = &[&[0.0, 4.0, 9.0], &[9.0, 9.0, 9.0], &[8.0, 2.0, 3.0], &[5.0, 6.0, 7.0]];
    let (mut evolution, known) = scripted(lines, worth, ReEvaluations { every: 3, group: 1, candidates: 2 });
    let prompter = Prompter::of(&evolution);
    let mut next = || {
        let report = evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
        (
            report.best_so_far.map(Fitness::get),
            report.re_evaluation,
            evolution.candidates().len(),
            evolution.progress().stagnation,
        )
    };
    assert_eq!(next(), (None, None, 1, 0));
    assert_eq!(next(), (None, None, 1, 0), "a generation that failed has no candidates");
    let (judged, trained) = (Some(fitness(4.0)), Some(fitness(3.0)));
    let report = ReEvaluationReport { candidates: 3, judged, trained, diverged: false };
    assert_eq!(next(), (Some(4.0), Some(report), 0, 0));
    assert_eq!(next(), (Some(4.0), None, 1, 0));
    let heard = known.heard.lock().expect("no test panics here").clone();
    assert_eq!(heard, [vec![genome(1, 1), genome(3, 1), genome(3, 2)]], "in the order of their generations and ranks");
    let champion = Champion {
        genome: genome(1, 1),
        fitness: fitness(4.0),
        generation: 1,
        seed: WORLD,
        trained,
        diverged: false,
        tier: 0,
    };
    assert_eq!(evolution.champion(), Some(&champion));
    // Of the equals in training the first is candidate; worth 5, it would take over.
    let next = evolution.champion_if_re_evaluated().expect("as many evaluations as candidates").expect("a champion");
    assert_eq!((next.genome, next.fitness, next.trained), (genome(4, 0), fitness(5.0), Some(fitness(9.0))));
    assert_eq!(evolution.champion(), Some(&champion), "it was only asked");
    assert_eq!(evolution.candidates().len(), 1);
}

/// What the strategy recommends has no fitness of its own: it is heard last, and where the champion selection asks for it alone.
#[test]
fn what_the_strategy_recommends_is_heard_where_it_is_asked_for() {
    let heard = |takes_recommendation, every| {
        let worth = vec![vec![1.0, 2.0, 3.0], vec![4.0, 5.0, 9.0]];
        let known = Known { worth, takes_recommendation, ..Known::default() };
        let mut evolution = Script::evolution(&[&[1.0, 3.0], &[2.0, 1.0]], StopConditions::default());
        evolution = evolution.with_champion_selection(ReEvaluations { every, group: 1, candidates: 1 }, known.clone());
        let prompter = Prompter::of(&evolution);
        for _ in 0..2 {
            evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
        }
        let champion = evolution.champion_if_re_evaluated().expect("as many evaluations as candidates");
        let champion = champion.expect("a champion");
        let heard = known.heard.lock().expect("no test panics here").clone();
        (heard, champion.genome, champion.fitness.get(), champion.generation, champion.trained)
    };
    let [first, second, recommended] = [genome(1, 1), genome(2, 0), genome(2, 2)];
    let all = vec![vec![first.clone(), second.clone(), recommended.clone()]];
    for every in [2, 3] {
        assert_eq!(heard(true, every), (all.clone(), recommended.clone(), 9.0, 2, None), "after {every} generations");
    }
    assert_eq!(heard(false, 2), (vec![vec![first, second.clone()]], second, 4.0, 2, Some(fitness(2.0))));
}

#[test]
fn a_champion_is_dethroned_only_by_one_that_is_better_before_the_champion_selection() {
    let lines: &[&[f64]] = &[&[1.0], &[2.0], &[3.0], &[4.0], &[5.0]];
    let (mut evolution, _) = scripted(
        lines,
        &[&[6.0], &[6.0], &[7.0], &[FAILED], &[1.0]],
        ReEvaluations { every: 1, group: 1, candidates: 9 },
    );
    let prompter = Prompter::of(&evolution);
    let mut next = || {
        let report = evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
        let champion = evolution.champion().expect("a champion");
        let judged = report.re_evaluation.and_then(|re_evaluation| re_evaluation.judged).map(Fitness::get);
        (champion.generation, champion.fitness.get(), judged, evolution.progress().stagnation)
    };
    assert_eq!(next(), (1, 6.0, Some(6.0), 0));
    assert_eq!(next(), (1, 6.0, Some(6.0), 1));
    assert_eq!(next(), (3, 7.0, Some(7.0), 0));
    assert_eq!(next(), (3, 7.0, None, 1));
    assert_eq!(next(), (3, 7.0, Some(1.0), 2));
}

/// A run of equals in training, one a generation, each heard at once, with these worths and tiers.
fn given_a_tier(worth: &[f64], tiers: &[u8], stop: StopConditions) -> Evolution<Script> {
    let worth = worth.iter().map(|&worth| vec![worth]).collect();
    let tiers = tiers.iter().map(|&tier| vec![tier]).collect();
    let known = Known { worth, tiers, ..Known::default() };
    Script::evolution(&[&[1.0]], stop)
        .with_champion_selection(ReEvaluations { every: 1, group: 1, candidates: 1 }, known)
}

#[test]
fn a_higher_tier_dethrones_a_fitter_champion_and_no_fitness_a_higher_tier() {
    let mut evolution =
        given_a_tier(&[9.0, 2.0, 100.0, 3.0, FAILED, 1.0], &[0, 1, 0, 1, 200, 2], StopConditions::default());
    let prompter = Prompter::of(&evolution);
    let mut next = || {
        let report = evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
        let champion = evolution.champion().expect("a champion");
        assert_eq!((report.best_so_far, report.tier), (Some(champion.fitness), champion.tier));
        (champion.generation, champion.tier, champion.fitness.get(), evolution.progress().stagnation)
    };
    assert_eq!(next(), (1, 0, 9.0, 0));
    assert_eq!(next(), (2, 1, 2.0, 0), "less fit, of a higher tier");
    assert_eq!(next(), (2, 1, 2.0, 1), "fitter, of a lower tier");
    assert_eq!(next(), (4, 1, 3.0, 0), "of the same tier, and fitter");
    assert_eq!(next(), (4, 1, 3.0, 1), "a failed candidate has no tier");
    assert_eq!(next(), (6, 2, 1.0, 0));
}

#[test]
fn at_one_re_evaluation_the_highest_tier_wins_and_then_fitness() {
    let tiers = vec![vec![0, 1, 1, 0]];
    let known = Known { worth: vec![vec![9.0, 2.0, 3.0, 8.0]], tiers, ..Known::default() };
    let re_evaluations = ReEvaluations { every: 1, group: 1, candidates: 4 };
    let mut evolution = Script::evolution(&[&[4.0, 3.0, 2.0, 1.0]], StopConditions::default());
    evolution = evolution.with_champion_selection(re_evaluations, known);
    let prompter = Prompter::of(&evolution);
    let report = evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
    let champion = evolution.champion().expect("a champion");
    assert_eq!((champion.genome.clone(), champion.tier), (genome(1, 2), 1));
    assert_eq!(
        report.re_evaluation.and_then(|re_evaluation| re_evaluation.judged),
        Some(fitness(3.0)),
        "of the candidate that stood highest"
    );
}

#[test]
fn a_tier_that_is_good_enough_ends_the_run() {
    let run = |stop: StopConditions| {
        let mut evolution = given_a_tier(&[9.0, 8.0, 7.0, 6.0], &[0, 1, 0, 3], stop);
        let prompter = Prompter::of(&evolution);
        let reason = evolution.run(&Unused, &prompter, &mut []).expect("the run ends in peace");
        (reason, evolution.progress().generations)
    };
    let none = StopConditions::default();
    assert_eq!(run(StopConditions { tier: Some(1), ..none }), (StopReason::Tier, 2));
    assert_eq!(run(StopConditions { tier: Some(2), ..none }), (StopReason::Tier, 4));
    assert_eq!(run(StopConditions { tier: Some(1), target: Some(9.0), ..none }), (StopReason::Target, 1));
    assert_eq!(run(StopConditions { tier: Some(4), generations: Some(6), ..none }), (StopReason::Generations, 6));
    let overlaid = StopConditions { tier: Some(1), generations: Some(9), ..none };
    let overlaid = overlaid.overlaid(StopConditions { tier: Some(2), ..none });
    assert_eq!((overlaid.tier, overlaid.generations), (Some(2), Some(9)));
    assert_eq!(
        format!("it ended because {}", StopReason::Tier),
        "it ended because the champion has the tier asked for"
    );
}

#[test]
fn a_resumed_run_knows_the_tier_of_its_champion() -> Result<(), Box<dyn std::error::Error>> {
    let (worth, tiers) = ([2.0, 100.0, 3.0], [1, 0, 1]);
    let stop = |generations| StopConditions { generations: Some(generations), ..Default::default() };
    let mut first = given_a_tier(&worth, &tiers, stop(1));
    let prompter = Prompter::of(&first);
    first.run(&Unused, &prompter, &mut [])?;
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("checkpoint");
    first.write_checkpoint(&path)?;
    let known = Known {
        worth: worth.iter().map(|&worth| vec![worth]).collect(),
        tiers: tiers.iter().map(|&tier| vec![tier]).collect(),
        ..Known::default()
    };
    let resumed = |stop| -> Result<Evolution<Script>, Box<dyn std::error::Error>> {
        let resumed = Evolution::resume(Checkpoint::<Script>::read(&path)?, stop);
        Ok(resumed.with_champion_selection(ReEvaluations { every: 1, group: 1, candidates: 1 }, known.clone()))
    };
    let mut second = resumed(stop(3))?;
    assert_eq!(second.champion(), first.champion());
    let report = second.generation(&Unused, &prompter, &mut [])?;
    assert_eq!((report.best_so_far, report.tier), (Some(fitness(2.0)), 1), "a fitter one of a lower tier is none");
    second.run(&Unused, &prompter, &mut [])?;
    assert_eq!(second.champion().map(|champion| (champion.generation, champion.tier)), Some((3, 1)));
    // A run whose champion is good enough already has ended.
    let mut good_enough = resumed(StopConditions { tier: Some(1), ..Default::default() })?;
    assert_eq!(good_enough.run(&Unused, &prompter, &mut [])?, StopReason::Tier);
    assert_eq!(good_enough.progress().generations, 1);
    Ok(())
}

/// Between re-evaluations it is unknown whether there is progress.
#[test]
fn stop_conditions_look_at_the_champion() {
    let run = |stop: StopConditions| {
        let worth: Vec<Vec<f64>> = (1..=20).map(|generation| vec![f64::from(generation.min(7))]).collect();
        let known = Known { worth, ..Known::default() };
        let re_evaluations = ReEvaluations { every: 4, group: 1, candidates: 1 };
        let mut evolution = Script::evolution(&[&[100.0]], stop).with_champion_selection(re_evaluations, known);
        let prompter = Prompter::of(&evolution);
        let reason = evolution.run(&Unused, &prompter, &mut []).expect("the run ends in peace");
        (reason, evolution.progress().generations)
    };
    let none = StopConditions::default();
    assert_eq!(run(StopConditions { stagnation: Some(1), ..none }), (StopReason::Stagnation, 12));
    assert_eq!(run(StopConditions { stagnation: Some(5), ..none }), (StopReason::Stagnation, 16));
    assert_eq!(run(StopConditions { target: Some(4.5), ..none }), (StopReason::Target, 8));
}

/// It waits for the first re-evaluation, even if the run is killed before.
#[test]
fn a_candidate_from_before_the_run_is_heard_first() -> Result<(), Box<dyn std::error::Error>> {
    let lines: &[&[f64]] = &[&[9.0], &[8.0], &[7.0]];
    let re_evaluations = ReEvaluations { every: 3, group: 1, candidates: 1 };
    for (before, champion) in [(5.0, 0), (3.0, 2)] {
        // Of generation 9, which never comes.
        let mut worth = vec![vec![1.0], vec![4.0], vec![2.0]];
        worth.resize(9, vec![before]);
        let known = Known { worth, ..Known::default() };
        let mut evolution = Script::evolution(lines, StopConditions::default()).with_candidate(genome(9, 0));
        let prompter = Prompter::of(&evolution);
        evolution = evolution.with_champion_selection(re_evaluations, known.clone());
        evolution.generation(&Unused, &prompter, &mut [])?;
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("checkpoint");
        evolution.write_checkpoint(&path)?;
        let mut evolution = Evolution::resume(Checkpoint::<Script>::read(&path)?, StopConditions::default())
            .with_champion_selection(re_evaluations, known.clone());
        evolution.generation(&Unused, &prompter, &mut [])?;
        evolution.generation(&Unused, &prompter, &mut [])?;
        assert_eq!(evolution.champion().map(|champion| champion.generation), Some(champion));
        let heard = known.heard.lock().expect("no test panics here").clone();
        assert_eq!(heard, [vec![genome(9, 0), genome(1, 0), genome(2, 0), genome(3, 0)]]);
    }
    Ok(())
}

#[test]
fn a_candidate_is_heard_once_however_often_it_was_best() {
    let candidate =
        |genome, fitness: f64, generation| Candidate { genome, fitness: Some(self::fitness(fitness)), generation };
    let candidates =
        vec![candidate(genome(1, 1), 5.0, 1), candidate(genome(1, 0), 6.0, 2), candidate(genome(1, 1), 9.0, 3)];
    let (evolution, known) = scripted(&[&[1.0]], &[&[2.0, 3.0]], ReEvaluations { every: 1, group: 1, candidates: 1 });
    let strategy = Script::evolution(&[&[1.0]], StopConditions::default());
    let folder = tempfile::tempdir().expect("a folder");
    strategy.write_checkpoint(&folder.path().join("checkpoint")).expect("it is written");
    let checkpoint: Checkpoint<Script> = Checkpoint::read(&folder.path().join("checkpoint")).expect("it is whole");
    let resumed = Evolution::resume(Checkpoint { candidates, ..checkpoint }, StopConditions::default())
        .with_champion_selection(ReEvaluations { every: 1, group: 1, candidates: 1 }, known.clone());
    let champion = resumed.champion_if_re_evaluated().expect("as many evaluations as candidates").expect("a champion");
    assert_eq!((champion.generation, champion.trained), (1, Some(fitness(5.0))), "as it was first");
    assert_eq!(*known.heard.lock().expect("no test panics here"), [vec![genome(1, 1), genome(1, 0)]]);
    assert_eq!(evolution.champion_if_re_evaluated().expect("as many evaluations as candidates"), None);
}

/// A champion selection that loses all evaluations.
struct Asleep;

impl ChampionSelection<Puppet> for Asleep {
    fn seed(&self) -> Seed {
        WORLD
    }

    fn judge(&self, _: &[Puppet], _: Option<TieredFitness>) -> ReEvaluation {
        ReEvaluation { evaluations: Vec::new(), tiers: Vec::new(), diverged: false }
    }
}

#[test]
fn a_champion_selection_that_loses_evaluations_is_an_error_and_the_candidates_stay() {
    let stop = StopConditions { generations: Some(2), ..Default::default() };
    let mut evolution = Script::evolution(&[&[1.0]], stop)
        .with_champion_selection(ReEvaluations { every: 1, group: 1, candidates: 1 }, Asleep);
    let prompter = Prompter::of(&evolution);
    let error = evolution.run(&Unused, &prompter, &mut []).expect_err("one is missing");
    let message = "the champion selection gave 0 evaluations for 1 candidates in generation 1";
    assert_eq!(error.to_string(), message);
    assert_eq!((evolution.champion(), evolution.candidates().len()), (None, 1));
    assert_eq!(evolution.champion_if_re_evaluated().expect_err("still missing").to_string(), message);
}

#[test]
fn a_champion_selection_whose_two_ways_part_is_reported() {
    let known = Known { worth: vec![vec![1.0]], diverged: true, ..Known::default() };
    let mut evolution = Script::evolution(&[&[1.0]], StopConditions::default());
    evolution = evolution.with_champion_selection(ReEvaluations { every: 1, group: 1, candidates: 1 }, known);
    let prompter = Prompter::of(&evolution);
    let report = evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
    assert!(report.re_evaluation.is_some_and(|re_evaluation| re_evaluation.diverged));
    let text = serde_json::to_string(&report).expect("plain data");
    assert!(
        text.ends_with(r#""re_evaluation":{"candidates":1,"judged":1.0,"trained":1.0,"diverged":true}}"#),
        "{text}"
    );
}

#[test]
fn re_evaluations_name_the_field() {
    let message = |re_evaluations: ReEvaluations| re_evaluations.validate().expect_err("out of range").to_string();
    assert_eq!(message(ReEvaluations { every: 0, group: 1, candidates: 1 }), "every = 0: must be at least 1");
    assert_eq!(message(ReEvaluations { every: 1, group: 0, candidates: 1 }), "group = 0: must be at least 1");
    assert_eq!(message(ReEvaluations { every: 1, group: 1, candidates: 0 }), "candidates = 0: must be at least 1");
    assert_eq!(ReEvaluations { every: 1, group: 1, candidates: 1 }.validate(), Ok(()));
}

/// Judges climbers in the world of one seed.
struct Panel;

impl ChampionSelection<Weights> for Panel {
    fn seed(&self) -> Seed {
        WORLD
    }

    fn judge(&self, candidates: &[Weights], _: Option<TieredFitness>) -> ReEvaluation {
        ReEvaluation { evaluations: Serial.evaluate(&TASK, candidates, WORLD), tiers: Vec::new(), diverged: false }
    }
}

fn judged(evolution: Evolution<Climber>) -> Evolution<Climber> {
    evolution.with_champion_selection(ReEvaluations { every: 4, group: 1, candidates: 5 }, Panel)
}

#[test]
fn a_run_with_a_champion_selection_resumed_at_any_generation_ends_the_same() -> Result<(), Box<dyn std::error::Error>> {
    const GENERATIONS: u64 = 14;
    let mut whole = judged(crate::evolution(GENERATIONS));
    whole.run(&TASK, &Serial, &mut [])?;
    assert!(whole.champion().is_some_and(|champion| champion.seed == WORLD && champion.trained.is_some()));
    assert_eq!(whole.candidates().len(), 2, "of generations 13 and 14");
    let (folder, threads) = (tempfile::tempdir()?, Parallel::new(3)?);
    let (path, end) = (folder.path().join("checkpoint"), folder.path().join("end"));
    whole.write_checkpoint(&end)?;
    let last = std::fs::read(&end)?;
    for until in 1..GENERATIONS {
        let mut first = judged(crate::evolution(until));
        first.run(&TASK, &Serial, &mut [])?;
        // As at the end of a run: asked for, and not kept.
        first.champion_if_re_evaluated().expect("as many evaluations as candidates");
        first.write_checkpoint(&path)?;
        let stop = StopConditions { generations: Some(GENERATIONS), ..Default::default() };
        let mut second = judged(Evolution::resume(Checkpoint::<Climber>::read(&path)?, stop));
        second.run(&TASK, &threads, &mut [])?;
        assert_eq!(state(&second), state(&whole), "resumed after generation {until}");
        assert_eq!(
            second.champion_if_re_evaluated().expect("as many evaluations as candidates"),
            whole.champion_if_re_evaluated()?
        );
        second.write_checkpoint(&path)?;
        assert_eq!(std::fs::read(&path)?, last, "resumed after generation {until}");
    }
    Ok(())
}

/// A champion selection changes the champion, and nothing of the search.
#[test]
fn a_champion_selection_does_not_steer() {
    let (mut with, mut without) = (judged(crate::evolution(9)), crate::evolution(9));
    for evolution in [&mut with, &mut without] {
        evolution.run(&TASK, &Serial, &mut []).expect("the run ends in peace");
    }
    let search = |evolution: &Evolution<Climber>| {
        let progress = Progress { stagnation: 0, ..evolution.progress() };
        (progress, serde_json::to_string(evolution.strategy()).expect("plain data"))
    };
    assert_eq!(search(&with), search(&without));
    assert_eq!(
        without.champion_if_re_evaluated().expect("as many evaluations as candidates").as_ref(),
        without.champion()
    );
}

#[test]
fn without_a_champion_selection_no_file_speaks_of_one() -> Result<(), Box<dyn std::error::Error>> {
    let mut evolution = crate::evolution(3);
    let report = evolution.generation(&TASK, &Serial, &mut [])?;
    let folder = tempfile::tempdir()?;
    evolution.write_checkpoint(&folder.path().join("checkpoint"))?;
    let checkpoint = std::fs::read_to_string(folder.path().join("checkpoint"))?;
    let text = checkpoint + &serde_json::to_string(&report)?;
    for word in ["candidates", "trained", "re_evaluation"] {
        assert!(!text.contains(word), "{word}: {text}");
    }
    Ok(())
}

fn borrowed(lines: &[Vec<f64>]) -> Vec<&[f64]> {
    lines.iter().map(Vec::as_slice).collect()
}

proptest! {
    /// Against the rule, written down naively: of all judged candidates the first with the highest worth among those of
    /// the highest tier.
    #[test]
    fn the_champion_is_the_best_of_all_judged_candidates(
        run in prop::collection::vec(prop::collection::vec((-3..4_i8, -3..4_i8, 0..3_u8), 1..5), 1..12),
        every in 1..5_u64,
        candidates in 1..4_usize,
    ) {
        // −3 stands for a failure.
        let value = |number: i8| if number == -3 { FAILED } else { f64::from(number) };
        let column = |of: fn(&(i8, i8, u8)) -> i8| -> Vec<Vec<f64>> {
            run.iter().map(|line| line.iter().map(|one| value(of(one))).collect()).collect()
        };
        let (lines, worth) = (column(|one| one.0), column(|one| one.1));
        let tiers: Vec<Vec<u8>> = run.iter().map(|line| line.iter().map(|one| one.2).collect()).collect();
        let known = Known { worth: worth.clone(), tiers: tiers.clone(), ..Known::default() };
        let stop = StopConditions { generations: Some(lines.len() as u64), ..Default::default() };
        let mut evolution =
            Script::evolution(&borrowed(&lines), stop).with_champion_selection(ReEvaluations { every, group: 1, candidates }, known);
        let prompter = Prompter::of(&evolution);
        evolution.run(&Unused, &prompter, &mut []).expect("the run ends in peace");

        // The runs are too short for more than the first change.
        let hears =
            |generation: u64| generation.is_multiple_of(if generation > 8 * every { 2 * every } else { every });
        let mut heard = Vec::new();
        for (generation, line) in (1..).zip(&lines) {
            let mut ranks: Vec<usize> = (0..line.len()).filter(|&index| line[index].is_finite()).collect();
            ranks.sort_by(|&a, &b| line[b].total_cmp(&line[a]).then(a.cmp(&b)));
            ranks.truncate(if hears(generation) { candidates } else { 1 });
            heard.extend(ranks.into_iter().map(|index| (generation, index)));
        }
        let best = |until: u64| {
            let mut best: Option<(u64, usize, (u8, f64))> = None;
            for &(generation, index) in heard.iter().filter(|(generation, _)| *generation <= until) {
                let worth = worth[generation as usize - 1][index];
                let standing = (tiers[generation as usize - 1][index], worth);
                if worth.is_finite() && best.is_none_or(|(_, _, best)| standing > best) {
                    best = Some((generation, index, standing));
                }
            }
            best.map(|(generation, index, standing)| (genome(generation, index as u64), generation, standing))
        };
        let seen = |champion: Option<Champion<Puppet>>| {
            champion.map(|champion| (champion.genome, champion.generation, (champion.tier, champion.fitness.get())))
        };
        let last_re_evaluation = (1..=lines.len() as u64).filter(|&generation| hears(generation)).max().unwrap_or(0);
        prop_assert_eq!(seen(evolution.champion().cloned()), best(last_re_evaluation));
        prop_assert_eq!(seen(evolution.champion_if_re_evaluated().expect("as many evaluations as candidates")), best(lines.len() as u64));
    }
}

/// How many candidates wait after each generation, and which are judged at each re-evaluation. The best fitness rises by 1 with each
/// generation and falls to 0 after `period` of them.
fn waiting_and_heard(generations: u32, period: u32, re_evaluations: ReEvaluations) -> (Vec<usize>, Vec<Vec<Puppet>>) {
    let lines: Vec<Vec<f64>> = (0..generations).map(|generation| vec![f64::from(generation % period), -1.0]).collect();
    let lines: Vec<&[f64]> = lines.iter().map(Vec::as_slice).collect();
    let (mut evolution, known) = scripted(&lines, &[], re_evaluations);
    let prompter = Prompter::of(&evolution);
    let mut waiting = Vec::new();
    for _ in 0..generations {
        evolution.generation(&Unused, &prompter, &mut []).expect("a generation");
        waiting.push(evolution.candidates().len());
    }
    let heard = known.heard.lock().expect("no test panics here").clone();
    (waiting, heard)
}

/// However far apart re-evaluations are, no more than twice as many candidates wait as there were generations between the
/// first ones.
#[test]
fn the_number_of_those_that_wait_is_bounded() {
    let (waiting, heard) = waiting_and_heard(200, 8, ReEvaluations { every: 2, group: 1, candidates: 1 });
    assert_eq!((waiting[..32].iter().max(), waiting.iter().max()), (Some(&3), Some(&4)));
    // From generation 65 on they are 16 generations apart; of each four, the best has waited.
    let last = heard.last().expect("re-evaluations");
    let expected = [180, 184, 188].map(|generation| genome(generation, 0));
    assert_eq!(last[..3], expected, "the fittest of 177 to 180, of 181 to 184, and of 185 to 188");
}

#[test]
fn of_a_group_of_generations_the_best_waits() {
    let (waiting, heard) = waiting_and_heard(120, 4, ReEvaluations { every: 6, group: 3, candidates: 1 });
    assert_eq!((waiting[..48].iter().max(), waiting.iter().max()), (Some(&2), Some(&4)), "2 × 6 / 3");
    assert_eq!(heard[0], [3, 4, 6].map(|generation| genome(generation, 0)), "the fittest of 1 to 3, of 4 and 5, and 6");
    assert_eq!(heard[1][..2], [8, 11].map(|generation| genome(generation, 0)));
}

/// What the genomes of all candidates have in common is in a checkpoint once.
#[test]
fn candidates_share_what_is_the_same_in_a_checkpoint() -> Result<(), Box<dyn std::error::Error>> {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("checkpoint");
    let evolution = Script::evolution(&[&[1.0]], StopConditions::default());
    evolution.write_checkpoint(&path)?;
    let candidate = |generation| Candidate { genome: genome(generation, 0), fitness: Some(fitness(7.0)), generation };
    for count in [1, 2, 9] {
        let candidates: Vec<_> = (1..=count).map(candidate).collect();
        let checkpoint: Checkpoint<Script> = Checkpoint::read(&path)?;
        Checkpoint { candidates: candidates.clone(), ..checkpoint }.write(&path)?;
        assert_eq!(Checkpoint::<Script>::read(&path)?.candidates, candidates);
        let text: serde_json::Value = serde_json::from_slice(&std::fs::read(&path)?)?;
        let found = &text["content"]["candidates"];
        assert_eq!((&found["shared"]["inputs"], &found["shared"]["outputs"]), (&0.into(), &1.into()));
        if count > 1 {
            assert_eq!(found["each"][1]["genome"], serde_json::json!({ "character": 200 }));
        }
    }
    Ok(())
}
