//! What conventional neuroevolution promises.

use ne_core::{
    Evaluation, Evolution, Failure, Genome, Phenotype, RandomStream, RankSelector, Roulette, Seed, Selection, Selector,
    Serial, StochasticUniversal, StopConditions, Strategy, Task, Tournament, Truncation,
    conformance::{StrategyOptions, check_strategy},
    digest::Digest,
};
use ne_fixed::{
    Arithmetic, ConventionalNe, ConventionalNeSettings, CrossoverChoice, GaussianMutation, MutationChoice, OnePoint,
    SelfAdaptiveMutation, Setting, StagnationBoost, TwoPoint, UniformMutation, WeightVector,
};
use ne_net::{DenseShape, TopologyMap};
use proptest::prelude::*;
use serde::{Deserialize, Serialize};

fn shape() -> DenseShape {
    DenseShape::new(3, vec![4], 2)
}

/// The closer all weights are to 1, the better; every seventh fails.
fn score(population: &[WeightVector]) -> Vec<Evaluation> {
    let evaluate = |(index, genome): (usize, &WeightVector)| {
        if index % 7 == 6 {
            return Evaluation::failed(Failure::Unstable { what: "speed".into() });
        }
        Evaluation::new(-genome.weights().iter().map(|&weight| f64::from(weight - 1.0).powi(2)).sum::<f64>())
    };
    population.iter().enumerate().map(evaluate).collect()
}

fn generation<S: Strategy<Genome = WeightVector>>(strategy: &mut S, number: u64) -> Vec<WeightVector> {
    let seed = Seed::of_run(1).generation(number);
    let population = strategy.ask(seed).to_vec();
    strategy.tell(&score(&population), seed);
    population
}

fn new(settings: ConventionalNeSettings) -> ConventionalNe {
    ConventionalNe::new(settings, shape()).expect("valid settings")
}

/// The presets, and one with all the other operators.
fn all_settings() -> [ConventionalNeSettings; 3] {
    let other = ConventionalNeSettings {
        population: 23,
        elites: 3,
        immigrants: 4,
        selection: Selection::Truncation(Truncation::default()),
        crossover_rate: 0.9,
        crossover: CrossoverChoice::Arithmetic(Arithmetic {}),
        mutation: MutationChoice::SelfAdaptive(SelfAdaptiveMutation::default()),
        initialization: ne_fixed::Initialization::ScaledGaussian { scale: 1.0 },
        stagnation_boost: Some(StagnationBoost { patience: 2, ..Default::default() }),
    };
    [ConventionalNeSettings::thesis(), ConventionalNeSettings::default(), other]
}

proptest! {
    #[test]
    fn the_population_keeps_its_size(
        (children, elites, immigrants) in (1..20usize, 0..20usize, 0..20usize), generations in 1..5u64,
    ) {
        let population = (children + elites + immigrants).max(2);
        let settings = ConventionalNeSettings { population, elites, immigrants, ..Default::default() };
        let mut strategy = new(settings);
        for number in 1..=generations {
            let asked = generation(&mut strategy, number);
            prop_assert_eq!(asked.len(), population);
            prop_assert!(asked.iter().all(|genome| genome.weights().iter().all(|weight| weight.is_finite())));
        }
    }

    #[test]
    fn elites_survive_unchanged(elites in 1..10usize) {
        let mut strategy = new(ConventionalNeSettings { elites, ..Default::default() });
        for number in 1..5 {
            let parents = generation(&mut strategy, number);
            let scores: Vec<_> = score(&parents).iter().map(Evaluation::fitness).collect();
            let mut order: Vec<usize> = (0..parents.len()).collect();
            order.sort_by(|&a, &b| scores[b].cmp(&scores[a]));
            let children = strategy.ask(Seed::of_run(1).generation(number + 1));
            for (elite, &parent) in children.iter().zip(&order[..elites]) {
                prop_assert_eq!(elite, &parents[parent]);
            }
        }
    }
}

#[test]
fn state_survives_serialisation_to_the_bit() {
    for settings in all_settings() {
        let mut strategy = new(settings);
        for number in 1..8 {
            let seed = Seed::of_run(1).generation(number);
            let mut copy = reload(&strategy);
            let population = strategy.ask(seed).to_vec();
            assert_eq!(copy.ask(seed), population, "saved before generation {number} was asked");
            // Between ask and tell as well.
            let mut copy = reload(&strategy);
            strategy.tell(&score(&population), seed);
            copy.tell(&score(&population), seed);
            assert_eq!(copy.statistics(), strategy.statistics());
            let next = Seed::of_run(1).generation(number + 1);
            assert_eq!(copy.ask(next), strategy.clone().ask(next), "saved before generation {number} was told");
        }
    }
}

/// Parents are dropped once their children are bred: what can be asked of a strategy then comes from the children.
#[test]
fn between_ask_and_tell_the_children_count() {
    let settings = ConventionalNeSettings { elites: 2, ..Default::default() };
    let mut strategy = new(settings.clone());
    for number in 1..4 {
        let seed = Seed::of_run(1).generation(number);
        let asked = strategy.ask(seed).to_vec();
        assert_eq!(strategy.ask(seed.generation(9)), asked, "asked again before it was told");
        let same = TopologyMap::none(asked[0].weights().len());
        let mut next = strategy.clone().remapped(settings.clone(), shape(), &same).expect("goes on");
        assert_eq!(next.ask(Seed::of_run(2).generation(1)), asked, "goes on with generation {number}");
        strategy.tell(&score(&asked), seed);
    }
}

#[test]
fn keeps_the_promises_of_a_strategy() {
    for settings in all_settings() {
        check_strategy(|| new(settings.clone()), &StrategyOptions::default()).expect("keeps its promises");
    }
}

fn reload(strategy: &ConventionalNe) -> ConventionalNe {
    let text = serde_json::to_string(strategy).expect("serialises");
    serde_json::from_str(&text).expect("deserialises")
}

#[test]
fn damaged_states_are_errors_that_name_the_field() {
    let mut strategy = new(ConventionalNeSettings::default());
    generation(&mut strategy, 1);
    let state = serde_json::to_value(&strategy).expect("serialises");
    type Damage = fn(&mut serde_json::Value);
    let damages: [(Damage, &str); 7] = [
        (|s| s["settings"]["population"] = 1.into(), "population = 1: must be from 2 to 1000000"),
        (|s| s["settings"]["population"] = 51.into(), "parents: found 50 individuals, the settings say 51"),
        (
            |s| s["parents"][3]["genes"]["weights"] = vec![0.0; 5].into(),
            "parents[3].weights: found 5, a net of shape 3-4-2 has 26",
        ),
        (|s| s["parents"][3]["genes"]["weights"][17] = 1e39.into(), "parents[3].weights[17] = inf: must be finite"),
        (
            |s| s["parents"][0]["genes"]["mutation_deviation"] = (-1.0).into(),
            "parents[0].mutation_deviation = -1: must be at least 0",
        ),
        (|s| s["topology"]["dense"]["hidden"][0] = 0.into(), "hidden[0] = 0: must be from 1 to 4096"),
        (
            |s| s["asked"] = serde_json::json!([s["parents"][0]["genes"]]),
            "asked: found 1 individuals, the settings say 50",
        ),
    ];
    for (damage, message) in damages {
        let mut damaged = state.clone();
        damage(&mut damaged);
        let error = serde_json::from_value::<ConventionalNe>(damaged).expect_err("damaged").to_string();
        assert!(error.contains(message), "{error}");
    }
}

#[test]
fn settings_and_shape_are_checked_once() {
    let settings = ConventionalNeSettings { population: 1, ..Default::default() };
    let error = ConventionalNe::new(settings, shape()).expect_err("one is no population").to_string();
    assert_eq!(error, "population = 1: must be from 2 to 1000000");
    let flat = DenseShape::new(3, vec![0], 2);
    let error = ConventionalNe::new(ConventionalNeSettings::default(), flat).expect_err("no neuron").to_string();
    assert_eq!(error, "topology.hidden[0] = 0: must be from 1 to 4096");
}

#[test]
fn the_first_generation_is_drawn_as_set() {
    let first = generation(&mut new(ConventionalNeSettings::thesis()), 1);
    let weights: Vec<f32> = first.iter().flat_map(|genome| genome.weights().to_vec()).collect();
    assert!(weights.iter().all(|weight| weight.abs() <= 1.0));
    assert!(weights.iter().any(|weight| *weight > 0.9) && weights.iter().any(|weight| *weight < -0.9));
    assert_ne!(first[0], first[1]);
}

#[test]
fn mutations_grow_with_stagnation_and_shrink_with_progress() {
    let boost = StagnationBoost { patience: 3, factor: 2.0, limit: 8.0 };
    let mut strategy = new(ConventionalNeSettings { stagnation_boost: Some(boost), ..Default::default() });
    let mut strengths = Vec::new();
    // Progress in generations 1 and 9 alone.
    for number in 1..=10 {
        let seed = Seed::of_run(1).generation(number);
        let fitness = if number < 9 { 1.0 } else { 2.0 };
        let evaluations = vec![Evaluation::new(fitness); strategy.ask(seed).len()];
        strategy.tell(&evaluations, seed);
        strengths.push(strategy.mutation_strength());
    }
    assert_eq!(strengths, [1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 4.0, 4.0, 1.0, 1.0]);
    let names: Vec<_> = strategy.statistics().into_iter().map(|statistic| statistic.name).collect();
    assert_eq!(
        names,
        ["mutation_strength", "mutation_deviation", "stagnation_generations", "diversity", "distinct_parents"]
    );
}

#[test]
fn a_generation_of_failures_is_survived() {
    for settings in all_settings() {
        let mut strategy = new(settings);
        for number in 1..4 {
            let seed = Seed::of_run(1).generation(number);
            let failure = Evaluation::failed(Failure::Other { what: "test".into() });
            let evaluations = vec![failure; strategy.ask(seed).len()];
            strategy.tell(&evaluations, seed);
            assert!(strategy.statistics().iter().all(|statistic| statistic.value.is_finite()));
        }
    }
}

#[test]
fn diversity_is_the_spread_of_the_first_generation() {
    let mut strategy = new(ConventionalNeSettings { population: 1000, ..Default::default() });
    assert_eq!(strategy.statistics()[3].value, 0.0);
    generation(&mut strategy, 1);
    let diversity = strategy.statistics()[3].value;
    assert!((diversity - 1.0 / 3.0_f64.sqrt()).abs() < 0.01, "{diversity}");
}

/// A selector of someone else's: always the best.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Best;

impl Setting for Best {}

impl Selector for Best {
    fn select(&self, scores: &[Option<ne_core::Fitness>], count: usize, _: &mut RandomStream, chosen: &mut Vec<usize>) {
        let best = (0..scores.len()).max_by_key(|&index| scores[index]);
        chosen.extend(best.into_iter().cycle().take(count));
    }
}

#[test]
fn operators_of_someone_else_fit_in() {
    let settings = ConventionalNeSettings {
        population: 10,
        elites: 0,
        immigrants: 0,
        selection: Best,
        crossover_rate: 1.0,
        crossover: TwoPoint {},
        mutation: UniformMutation { rate: 0.0, limit: 0.0 },
        initialization: ne_fixed::Initialization::Uniform { limit: 1.0 },
        stagnation_boost: None,
    };
    let mut strategy = ConventionalNe::new(settings, shape()).expect("valid");
    let first = generation(&mut strategy, 1);
    let best = (0..10).max_by_key(|&index| score(&first)[index].fitness()).expect("ten");
    let text = serde_json::to_string(&strategy).expect("serialises");
    let mut loaded: ConventionalNe<Best, TwoPoint, UniformMutation> =
        serde_json::from_str(&text).expect("deserialises");
    assert!(generation(&mut loaded, 2).iter().all(|child| *child == first[best]));
    assert_eq!(loaded.statistics()[4].value, 1.0);
}

/// One selector by its own type, without the choice among all.
fn with_selector<S: Setting + Selector>(selection: S) -> Result<usize, String> {
    let ConventionalNeSettings { elites, immigrants, crossover_rate, .. } = ConventionalNeSettings::default();
    let settings = ConventionalNeSettings {
        population: 10,
        elites,
        immigrants,
        selection,
        crossover_rate,
        crossover: TwoPoint {},
        mutation: UniformMutation { rate: 0.1, limit: 1.0 },
        initialization: ne_fixed::Initialization::Uniform { limit: 1.0 },
        stagnation_boost: None,
    };
    let mut strategy = ConventionalNe::new(settings, shape()).map_err(|error| error.to_string())?;
    generation(&mut strategy, 1);
    Ok(generation(&mut strategy, 2).len())
}

#[test]
fn selectors_of_the_core_fit_in() {
    assert_eq!(with_selector(Tournament::default()), Ok(10));
    assert_eq!(with_selector(RankSelector::default()), Ok(10));
    assert_eq!(with_selector(Truncation::default()), Ok(10));
    assert_eq!(with_selector(Roulette {}), Ok(10));
    assert_eq!(with_selector(StochasticUniversal {}), Ok(10));
    let error = with_selector(Tournament { size: 0 }).expect_err("no individual takes part");
    assert!(error.starts_with("selection.size = 0: must be from 1"), "{error}");
}

/// Exclusive or, on inputs ±1.
struct ExclusiveOr;

impl Task for ExclusiveOr {
    fn inputs(&self) -> usize {
        2
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        let mut error = 0.0;
        for (a, b) in [(-1.0, -1.0), (-1.0, 1.0), (1.0, -1.0), (1.0, 1.0_f32)] {
            let mut output = [0.0];
            phenotype.activate(&[a, b], &mut output);
            error += f64::from(output[0] + a * b).powi(2);
        }
        Evaluation::new(4.0 - error)
    }
}

#[test]
fn solves_exclusive_or_with_every_seed() {
    let operators = [
        MutationChoice::Gaussian(GaussianMutation::default()),
        MutationChoice::SelfAdaptive(SelfAdaptiveMutation::default()),
    ];
    let settings = operators.map(|mutation| ConventionalNeSettings { mutation, ..Default::default() });
    for settings in [ConventionalNeSettings::default()].into_iter().chain(settings) {
        for run in 0..10 {
            let strategy = ConventionalNe::new(settings.clone(), DenseShape::new(2, vec![4], 1)).expect("valid");
            let stop = StopConditions { generations: Some(200), target: Some(3.9), ..Default::default() };
            let mut evolution = Evolution::new(strategy, Seed::of_run(run), stop);
            evolution.run(&ExclusiveOr, &Serial, &mut []).expect("runs");
            let fitness = evolution.champion().expect("a best").fitness.get();
            assert!(fitness >= 3.9, "run {run}: {fitness} with {:?}", settings.mutation);
        }
    }
}

/// Golden: another digest changes every recorded run.
#[test]
fn runs_are_the_same_for_ever() {
    let thesis = ConventionalNeSettings::thesis();
    let [_, _, other] = all_settings();
    let gaussian = ConventionalNeSettings {
        elites: 2,
        selection: Selection::Roulette(Roulette {}),
        crossover: CrossoverChoice::OnePoint(OnePoint {}),
        mutation: MutationChoice::Gaussian(GaussianMutation { rate: 0.1, deviation: 0.3 }),
        ..ConventionalNeSettings::thesis()
    };
    let digests = [thesis, other, gaussian].map(|settings| {
        let mut strategy = new(settings);
        let mut digest = Digest::default();
        for number in 1..=20 {
            for genome in generation(&mut strategy, number) {
                genome.weights().iter().for_each(|&weight| digest.add_f32(weight));
                let mut outputs = [0.0; 2];
                genome.express().activate(&[0.5, -1.0, 2.0], &mut outputs);
                outputs.iter().for_each(|&output| digest.add_f32(output));
            }
        }
        digest.to_string()
    });
    assert_eq!(digests, ["2aab3272f4482cd3", "3be251fab86662b7", "4bb1d78e80d0c88d"]);
}
