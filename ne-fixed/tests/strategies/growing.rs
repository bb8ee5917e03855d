//! Going on with nets that have grown: what was learned stays, to the bit.

use crate::common::{assert_resumes, dense, generation, recurrent, reload};
use ne_core::{Phenotype, Seed, Strategy};
use ne_fixed::{
    CmaEs, CmaEsSettings, ConventionalNe, ConventionalNeSettings, Cosyne, CosyneSettings, CovarianceModel, Nsga2,
    Nsga2Settings, OpenEs, OpenEsSettings, WeightVector,
};
use ne_net::{DenseShape, Topology, TopologyMap};

/// The net of the tests with an input in front, one at the end, and an output in the middle; and what becomes of its weights.
fn grown() -> (Topology, TopologyMap) {
    let names = |inputs: &[&str], outputs: &[&str]| {
        let mut names = Vec::new();
        for target in ["h0", "h1", "h2", "h3"] {
            names.extend(inputs.iter().map(|input| format!("{input} to {target}")));
            names.push(format!("bias of {target}"));
        }
        for target in outputs {
            names.extend(["h0", "h1", "h2", "h3", "bias"].map(|source| format!("{source} to {target}")));
        }
        names
    };
    let old = names(&["a", "b", "c"], &["x", "y"]);
    let new = names(&["left", "a", "b", "c", "right"], &["x", "between", "y"]);
    (DenseShape::new(5, vec![4], 3).into(), TopologyMap::by_name(&old, &new))
}

/// What a net answers to a few inputs, bit by bit.
fn answers(topology: &Topology, weights: &[f32], inputs: impl Fn(usize) -> Vec<f32>) -> Vec<Vec<u32>> {
    let mut net = topology.network(weights);
    let answer = |step: usize| {
        let mut outputs = vec![0.0; topology.outputs()];
        net.activate(&inputs(step), &mut outputs);
        outputs.iter().map(|output| output.to_bits()).collect()
    };
    (0..20).map(answer).collect()
}

/// Checks that a grown net does with any new inputs what the old one did, and nothing with its new output.
fn assert_same_behaviour(old: &[f32], new: &[f32]) {
    let sense = |step: usize| [0.3, -0.7, 1.1].map(|scale| scale * (step as f32 - 9.5)).to_vec();
    let more = |step: usize| {
        let own = sense(step);
        vec![step as f32, own[0], own[1], own[2], -3.0 * step as f32]
    };
    let before = answers(&dense().into(), old, sense);
    let after = answers(&grown().0, new, more);
    for (before, after) in before.iter().zip(&after) {
        assert_eq!(before[..], [after[0], after[2]]);
        assert_eq!(f32::from_bits(after[1]).abs(), 0.0);
    }
}

fn weights(population: &[WeightVector]) -> Vec<Vec<f32>> {
    population.iter().map(|individual| individual.weights().to_vec()).collect()
}

/// A strategy some generations old, and the population last told, best first.
fn trained<S: Strategy<Genome = WeightVector>>(mut strategy: S) -> (S, Vec<Vec<f32>>) {
    (1..=6).for_each(|number| drop(generation(&mut strategy, number)));
    let seed = Seed::of_run(1).generation(7);
    let population = strategy.ask(seed).to_vec();
    let evaluations = crate::common::score(&population);
    strategy.tell(&evaluations, seed);
    let mut order: Vec<usize> = (0..population.len()).collect();
    order.sort_by_key(|&index| std::cmp::Reverse(evaluations[index].fitness()));
    let sorted: Vec<WeightVector> = order.into_iter().map(|index| population[index].clone()).collect();
    (strategy, weights(&sorted))
}

/// Checks a strategy whose first generation after the growth is the population there was.
fn assert_population_goes_on<S: Strategy<Genome = WeightVector> + Clone + serde::de::DeserializeOwned>(
    old: Vec<Vec<f32>>,
    new: S,
    asked: usize,
) {
    let population = new.clone().ask(Seed::of_run(2).generation(1)).to_vec();
    assert_eq!(population.len(), asked);
    assert_eq!(reload(&new).ask(Seed::of_run(2).generation(1)), population);
    for (old, new) in old.iter().zip(&population) {
        assert_same_behaviour(old, new.weights());
    }
    // Chance may leave a copy as it is.
    let copies = population.iter().enumerate().skip(old.len());
    let mutated = copies.filter(|(index, copy)| copy.weights() != population[index % old.len()].weights()).count();
    assert!(2 * mutated >= population.len().saturating_sub(old.len()), "{mutated} copies have mutated");
    assert_resumes(new, 3);
}

#[test]
fn populations_go_on_in_grown_nets() {
    let (topology, growth) = grown();
    for size in [30, 20, 50] {
        let settings = |population| ConventionalNeSettings { population, ..ConventionalNeSettings::default() };
        let (strategy, old) = trained(ConventionalNe::new(settings(30), dense()).expect("valid"));
        let new = strategy.remapped(settings(size), topology.clone(), &growth).expect("grows");
        assert_population_goes_on(old, new, size);
        let settings = |population| CosyneSettings { population, ..CosyneSettings::default() };
        let (strategy, old) = trained(Cosyne::new(settings(30), dense()).expect("valid"));
        let new = strategy.remapped(settings(size), topology.clone(), &growth).expect("grows");
        assert_population_goes_on(old, new, size);
    }
}

#[test]
fn the_survivors_of_a_search_for_compromises_go_on() {
    let (topology, growth) = grown();
    let settings = Nsga2Settings::default();
    let (strategy, _) = trained(Nsga2::new(settings.clone(), dense()).expect("valid"));
    let front = strategy.front().expect("it has one")[0].genome.weights().to_vec();
    let mut new = strategy.remapped(settings, topology, &growth).expect("grows");
    let first = new.clone().ask(Seed::of_run(2).generation(1)).to_vec();
    assert_eq!(reload(&new).ask(Seed::of_run(2).generation(1)), first);
    // With the fitness as the only objective the front is the best.
    assert_same_behaviour(&front, first[0].weights());
    generation(&mut new, 1);
    assert_resumes(new, 3);
}

#[test]
fn a_mean_goes_on_in_grown_nets() {
    let (topology, growth) = grown();
    use CovarianceModel::{Full, Separable};
    for (before, after) in [(Separable, Separable), (Full, Full), (Full, Separable), (Separable, Full)] {
        let settings = |covariance| CmaEsSettings { covariance, ..CmaEsSettings::default() };
        let (strategy, _) = trained(CmaEs::new(settings(before), dense()).expect("valid"));
        let mean =
            |strategy: &CmaEs| -> Vec<f32> { strategy.mean().expect("a mean").iter().map(|&x| x as f32).collect() };
        let old = mean(&strategy);
        let deviation = |strategy: &CmaEs| strategy.statistics()[1].value;
        let first = settings(after).step_size;
        let expected = deviation(&strategy).max(first);
        let new = strategy.remapped(settings(after), topology.clone(), &growth).expect("grows");
        assert_same_behaviour(&old, &mean(&new));
        // The new weights deviate by the first step size.
        assert!((deviation(&new) / expected - 1.0).abs() < 1e-9, "{} of {expected}", deviation(&new));
        assert_resumes(new, 3);
    }
}

#[test]
fn what_has_settled_can_leave_again() {
    let settings = CmaEsSettings::default();
    let mut strategy = CmaEs::new(settings.clone(), dense()).expect("valid");
    (1..=400).for_each(|number| drop(generation(&mut strategy, number)));
    let deviation = |strategy: &CmaEs| strategy.statistics()[1].value;
    assert!(deviation(&strategy) < 0.1 * settings.step_size);
    let same = TopologyMap::none(dense().weight_count());
    let mean = strategy.mean().expect("a mean").to_vec();
    let new = strategy.remapped(settings.clone(), dense(), &same).expect("goes on");
    assert_eq!(new.mean(), Some(mean.as_slice()));
    assert!((deviation(&new) / (0.3 * settings.step_size) - 1.0).abs() < 1e-9);
}

/// A search for three weights that has come to this step size and these variances, in units of it.
fn narrowed(covariance: CovarianceModel, step_size: f64, [one, two, three]: [f64; 3]) -> CmaEs {
    let settings = CmaEsSettings { covariance, ..CmaEsSettings::default() };
    let mut strategy = CmaEs::new(settings, DenseShape::new(2, vec![], 1)).expect("valid");
    generation(&mut strategy, 1);
    let mut state = serde_json::to_value(&strategy).expect("serialises");
    state["distribution"]["step_size"] = step_size.into();
    state["distribution"]["covariance"] = match covariance {
        CovarianceModel::Separable => [one, two, three].to_vec(),
        CovarianceModel::Full => vec![one, 0.0, 0.0, two, 0.0, three],
    }
    .into();
    serde_json::from_value(state).expect("deserialises")
}

/// The widest weight may be one that is lost.
#[test]
fn what_goes_on_can_move_when_other_weights_are_lost() {
    for covariance in [CovarianceModel::Separable, CovarianceModel::Full] {
        let strategy = narrowed(covariance, 0.01, [1.0, 1e-4, 1e-4]);
        let settings = CmaEsSettings { covariance, ..CmaEsSettings::default() };
        let without_first = TopologyMap::new(vec![Some(1), Some(2)], 3).expect("two of three");
        let new = strategy.remapped(settings.clone(), DenseShape::new(1, vec![], 1), &without_first).expect("goes on");
        let deviation = new.statistics()[1].value;
        assert!((deviation / (0.3 * settings.step_size) - 1.0).abs() < 1e-9, "{deviation}");
        assert_resumes(new, 3);
    }
}

/// A new weight, next to others that hardly vary any more, makes a matrix that no file may hold.
#[test]
fn a_narrow_search_that_grows_can_be_saved() {
    for covariance in [CovarianceModel::Separable, CovarianceModel::Full] {
        let strategy = narrowed(covariance, 0.01, [1.0, 1.0, 2e-14]);
        let settings = CmaEsSettings { covariance, ..CmaEsSettings::default() };
        let with_another = TopologyMap::new(vec![Some(0), Some(1), None, Some(2)], 3).expect("three of three");
        let new = strategy.remapped(settings, DenseShape::new(3, vec![], 1), &with_another).expect("grows");
        assert_resumes(reload(&new), 3);
    }
}

#[test]
fn a_centre_goes_on_in_grown_nets() {
    let (topology, growth) = grown();
    let settings = OpenEsSettings::default();
    let (mut strategy, _) = trained(OpenEs::new(settings.clone(), dense()).expect("valid"));
    let new = strategy.clone().remapped(settings.clone(), topology, &growth).expect("grows");
    let seed = Seed::of_run(1).generation(8);
    // The centre is the first individual.
    let old = strategy.ask(seed)[0].weights().to_vec();
    assert_same_behaviour(&old, new.clone().ask(seed)[0].weights());
    assert_resumes(new, 3);
    let champion = vec![0.25; dense().weight_count()];
    let started =
        OpenEs::new(settings, dense()).map(|new| new.with_start(std::slice::from_ref(&champion)).expect("weights"));
    assert_eq!(started.expect("valid").ask(seed)[0].weights(), champion);
}

#[test]
fn a_recurrent_net_goes_on_too() {
    let same = TopologyMap::none(recurrent().weight_count());
    let settings = ConventionalNeSettings::default();
    let (strategy, old) = trained(ConventionalNe::new(settings.clone(), recurrent()).expect("valid"));
    let mut new = strategy.remapped(settings, recurrent(), &same).expect("goes on");
    assert_eq!(weights(new.ask(Seed::of_run(2).generation(1))), old);
}

#[test]
fn errors_name_what_does_not_fit() {
    let (topology, _) = grown();
    let same = TopologyMap::none(26);
    let message = "growth = from 26 to 26 weights: must be from 26 to 39, as the topologies have";
    let conventional = ConventionalNe::new(ConventionalNeSettings::default(), dense()).expect("valid");
    let error = conventional.clone().remapped(ConventionalNeSettings::default(), topology.clone(), &same);
    assert_eq!(error.expect_err("too few").to_string(), message);
    let cosyne = Cosyne::new(CosyneSettings::default(), dense()).expect("valid");
    let error = cosyne.clone().remapped(CosyneSettings::default(), topology.clone(), &same);
    assert_eq!(error.expect_err("too few").to_string(), message);
    let cma_es = CmaEs::new(CmaEsSettings::default(), dense()).expect("valid");
    let error = cma_es.remapped(CmaEsSettings::default(), topology.clone(), &same);
    assert_eq!(error.expect_err("too few").to_string(), message);
    let open_es = OpenEs::new(OpenEsSettings::default(), dense()).expect("valid");
    let error = open_es.remapped(OpenEsSettings::default(), topology.clone(), &same);
    assert_eq!(error.expect_err("too few").to_string(), message);
    // One signature for all.
    let begun = [
        conventional.with_start(&[vec![0.0; 26], vec![0.0; 3]]).map(drop),
        cosyne.with_start(&[vec![0.0; 26], vec![0.0; 3]]).map(drop),
        CmaEs::new(CmaEsSettings::default(), dense())
            .expect("valid")
            .with_start(&[vec![0.0; 26], vec![0.0; 3]])
            .map(drop),
        OpenEs::new(OpenEsSettings::default(), dense())
            .expect("valid")
            .with_start(&[vec![0.0; 26], vec![0.0; 3]])
            .map(drop),
        Nsga2::new(Nsga2Settings::default(), dense())
            .expect("valid")
            .with_start(&[vec![0.0; 26], vec![0.0; 3]])
            .map(drop),
    ];
    for error in begun {
        let error = error.expect_err("too few").to_string();
        assert_eq!(error, "start[1] = weights: found 3, a net of shape 3-4-2 has 26: must be weights of the net");
    }
}
