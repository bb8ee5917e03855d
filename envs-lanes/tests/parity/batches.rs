//! A creature's result does not depend on the other creatures in its batch.

use crate::stage::{both, shipped};
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::{Instructions, LaneEpisode};
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Evaluator, Genome, Parallel, Phenotype, Purpose, Seed, Task, conformance::Puppet};
use ne_net::{Activation, DenseNet, DenseShape, GraphNet, GraphNeuron, GraphShape};
use rand::RngExt;
use tasks::{Combine, Episode, FallEnds, Running, Sum, Trials};

fn tasks(name: &str) -> (Episode<RapierEnvironment>, LaneEpisode) {
    let blueprint = shipped(name);
    let sensors = blueprint.creature().sensors.clone();
    let (rapier, lanes) = both(&blueprint, &sensors, PhysicsSettings::default(), Variation::light());
    let movement = || Box::new(Sum::of(Running::default()).plus(-1.0, FallEnds::default()));
    let trials = Trials { count: 3, combine: Combine::Worst, lessons: false };
    let rapier = Episode::new(rapier, movement(), 80, trials).expect("valid");
    (rapier, LaneEpisode::new(lanes, movement(), 80, trials).expect("valid"))
}

/// A net with a memory: each neuron hears every input, itself and every other.
fn recurrent(inputs: usize, outputs: usize, hidden: usize, weight: &mut impl FnMut() -> f32) -> GraphNet {
    let neurons = hidden + outputs;
    let neuron = |_| GraphNeuron { activation: Activation::Tanh, bias: true, sources: (0..inputs + neurons).collect() };
    let outputs = (inputs + hidden..inputs + neurons).collect();
    let shape = GraphShape { inputs, recurrent: true, neurons: (0..neurons).map(neuron).collect(), outputs };
    let weights: Vec<f32> = (0..shape.weight_count()).map(|_| weight()).collect();
    GraphNet::new(shape, &weights).expect("valid")
}

fn dense(inputs: usize, outputs: usize, hidden: usize, weight: &mut impl FnMut() -> f32) -> DenseNet {
    let shape = DenseShape::new(inputs, vec![hidden], outputs);
    let weights: Vec<f32> = (0..shape.weight_count()).map(|_| weight()).collect();
    DenseNet::new(shape, &weights).expect("valid")
}

/// Which controllers a batch is made of.
#[derive(Clone, Copy, Debug)]
enum Crew {
    Dense,
    Recurrent,
    Strangers,
    Mixed,
}

/// Nets of one topology, of one with a memory, controllers of a kind lanes do not know, and all of these with misfits
/// among them.
fn crew(kind: Crew, task: &LaneEpisode, count: usize) -> Vec<Box<dyn Phenotype>> {
    let (inputs, outputs) = (task.inputs(), task.outputs());
    let mut stream = Seed::of_run(5).stream(Purpose::new("weights"));
    let mut weight = || stream.random::<f32>() * 4.0 - 2.0;
    let mut member = |index: usize| -> Box<dyn Phenotype> {
        match (kind, index % 6) {
            (Crew::Dense, _) | (Crew::Mixed, 0) => Box::new(dense(inputs, outputs, 10, &mut weight)),
            (Crew::Recurrent, _) | (Crew::Mixed, 1) => Box::new(recurrent(inputs, outputs, 3, &mut weight)),
            (Crew::Mixed, 2) => Box::new(dense(inputs, outputs, 4, &mut weight)),
            (Crew::Mixed, 3) => Box::new(dense(inputs + 1, outputs, 4, &mut weight)),
            (Crew::Mixed, 4) => Box::new(recurrent(inputs, outputs + 1, index % 5, &mut weight)),
            (Crew::Strangers | Crew::Mixed, _) => Box::new(Puppet::new(inputs, outputs, index as u64).express()),
        }
    };
    (0..count).map(&mut member).collect()
}

fn batch(task: &LaneEpisode, crew: &mut [Box<dyn Phenotype>], seed: Seed) -> Vec<Evaluation> {
    let mut members: Vec<&mut dyn Phenotype> = crew.iter_mut().map(|one| &mut **one).collect();
    task.evaluate_batch(&mut members, seed)
}

#[test]
fn any_crew_gets_rapiers_results_in_any_batch() {
    let seed = Seed::of_run(7);
    let (rapier, lanes) = tasks("biped-1");
    for kind in [Crew::Dense, Crew::Recurrent, Crew::Strangers, Crew::Mixed] {
        let mut crew = crew(kind, &lanes, 41);
        let wanted: Vec<Evaluation> = crew.iter_mut().map(|one| rapier.evaluate(&mut **one, seed)).collect();
        for instructions in Instructions::available() {
            let task = lanes.clone().with_instructions(instructions);
            for size in [1, 3, 16, 17, 41] {
                let found: Vec<Evaluation> = crew.chunks_mut(size).flat_map(|crew| batch(&task, crew, seed)).collect();
                assert_eq!(found, wanted, "{kind:?} in batches of {size}, {instructions}");
            }
        }
        for threads in 1..=3 {
            let pool = Parallel::new(threads).expect("threads start");
            let mut members: Vec<&mut dyn Phenotype> = crew.iter_mut().map(|one| &mut **one).collect();
            assert_eq!(lanes.evaluate_spread(&mut members, seed, &pool), wanted, "{kind:?} on {threads} threads");
        }
        // Another order: 18 and 41 have no divisor in common.
        let order: Vec<usize> = (0..41).map(|place| place * 18 % 41).collect();
        let mut places: Vec<Option<Box<dyn Phenotype>>> = crew.into_iter().map(Some).collect();
        let mut permuted: Vec<_> = order.iter().filter_map(|&index| places[index].take()).collect();
        let found = batch(&lanes, &mut permuted, seed);
        let wanted: Vec<Evaluation> = order.iter().map(|&index| wanted[index].clone()).collect();
        assert_eq!(found, wanted, "{kind:?} permuted");
    }
}

#[test]
fn the_number_of_threads_changes_no_bit() {
    let seed = Seed::of_run(9);
    for name in ["biped-1", "tetrapod-2"] {
        let (rapier, lanes) = tasks(name);
        let puppets = Puppet::sample(rapier.inputs(), rapier.outputs(), 37);
        let wanted: Vec<Evaluation> = puppets.iter().map(|one| rapier.evaluate(&mut one.express(), seed)).collect();
        for threads in 1..=3 {
            let found = Parallel::new(threads).expect("threads start").evaluate(&lanes, &puppets, seed);
            assert_eq!(found, wanted, "{name}, {threads} threads");
        }
    }
}
