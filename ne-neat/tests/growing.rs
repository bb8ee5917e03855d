//! Going on with more inputs and outputs: what was learned stays, to the bit.

use ne_core::{Evaluation, Genome, Phenotype, Seed, Strategy};
use ne_neat::{BiasKind, Layout, Neat, NeatGenome, NeatSettings, StartTopology};
use ne_net::TopologyMap;
use std::{cmp::Reverse, collections::BTreeMap};

fn growths() -> (TopologyMap, TopologyMap) {
    let inputs = TopologyMap::new(vec![None, Some(0), Some(1), None, Some(2)], 3).expect("a growth");
    let outputs = TopologyMap::new(vec![Some(0), None, Some(1)], 2).expect("a growth");
    (inputs, outputs)
}

fn score(population: &[NeatGenome]) -> Vec<Evaluation> {
    let evaluate = |genome: &NeatGenome| {
        let mut net = genome.express();
        let mut answer = vec![0.0; genome.layout().outputs];
        let inputs: Vec<f32> = (0..genome.layout().inputs).map(|index| 0.3 - 0.2 * index as f32).collect();
        net.activate(&inputs, &mut answer);
        Evaluation::new(f64::from(answer[0]) + 0.1 * genome.enabled_count() as f64)
    };
    population.iter().map(evaluate).collect()
}

fn generation(neat: &mut Neat, number: u64) -> (Vec<NeatGenome>, Vec<Evaluation>) {
    let seed = Seed::of_run(1).generation(number);
    let population = neat.ask(seed).to_vec();
    let evaluations = score(&population);
    neat.tell(&evaluations, seed);
    (population, evaluations)
}

fn settings() -> Vec<NeatSettings> {
    let mut all = Vec::new();
    for bias in [BiasKind::InputNode, BiasKind::PerNeuron, BiasKind::None] {
        for recurrent in [false, true] {
            for start in [StartTopology::FullyConnected, StartTopology::HiddenLayer { neurons: 3 }] {
                let mut settings = NeatSettings { population: 40, bias, recurrent, start, ..NeatSettings::default() };
                (settings.mutation.add_connection, settings.mutation.add_node) = (0.5, 0.4);
                settings.mutation.delete_connection = 0.1;
                all.push(settings);
            }
        }
    }
    all
}

/// Which node of the grown net an old one is: [`growths`] adds two inputs and an output.
fn renumbered(node: u32, layout: &Layout) -> u32 {
    let sources = layout.sources() as u32;
    let node_of_input = [1, 2, 4];
    match node {
        0..3 => node_of_input[node as usize],
        _ if node < sources => 5,
        _ if node == sources => sources + 2,
        _ if node == sources + 1 => sources + 4,
        _ => node + 3,
    }
}

/// What a net answers, bit by bit, with or without the new inputs.
fn answers(genome: &NeatGenome, grown: bool) -> Vec<Vec<u32>> {
    let mut net = genome.express();
    let answer = |step: usize| {
        let [a, b, c] = [0.3, -0.7, 1.1].map(|scale| scale * (step as f32 - 9.5));
        let inputs = if grown { vec![step as f32, a, b, -2.0 * step as f32, c] } else { vec![a, b, c] };
        let mut outputs = vec![0.0; genome.layout().outputs];
        net.activate(&inputs, &mut outputs);
        outputs.iter().map(|output| output.to_bits()).collect()
    };
    (0..20).map(answer).collect()
}

#[test]
fn genomes_do_the_same_and_stay_related() {
    let (inputs, outputs) = growths();
    for settings in settings() {
        let mut neat = Neat::new(settings.clone(), 3, 2).expect("valid");
        (1..=14).for_each(|number| drop(generation(&mut neat, number)));
        let (old, evaluations) = generation(&mut neat, 15);
        let mut order: Vec<usize> = (0..old.len()).collect();
        order.sort_by_key(|&index| Reverse(evaluations[index].fitness()));
        let old: Vec<&NeatGenome> = order.iter().map(|&index| &old[index]).collect();
        assert!(old.iter().any(|genome| genome.hidden_count() > 3));

        let mut grown = neat.remapped(settings.clone(), None, &inputs, &outputs).expect("grows");
        let text = serde_json::to_string(&grown).expect("serialises");
        let mut read: Neat = serde_json::from_str(&text).expect("deserialises");
        let new = grown.ask(Seed::of_run(2).generation(1)).to_vec();
        assert_eq!(read.ask(Seed::of_run(2).generation(1)), new);

        // Old numbers and new ones go one to one, over all genomes.
        let mut numbers = BTreeMap::new();
        for (old, new) in old.iter().zip(&new) {
            let (before, after) = (answers(old, false), answers(new, true));
            for (before, after) in before.iter().zip(&after) {
                assert_eq!(before[..], [after[0], after[2]], "{settings:?}");
            }
            assert_eq!(old.connections().len(), new.connections().len());
            for old_gene in old.connections() {
                let ends = (renumbered(old_gene.from, old.layout()), renumbered(old_gene.to, old.layout()));
                let same = |gene: &&ne_neat::ConnectionGene| (gene.from, gene.to) == ends;
                let gene = new.connections().iter().find(same).expect("the gene is still there");
                assert_eq!((gene.weight, gene.enabled), (old_gene.weight, old_gene.enabled));
                let number = *numbers.entry(old_gene.innovation).or_insert(gene.innovation);
                assert_eq!(number, gene.innovation, "{settings:?}");
            }
            // A genome is one that a file could hold.
            let text = serde_json::to_string(new).expect("serialises");
            assert_eq!(&serde_json::from_str::<NeatGenome>(&text).expect("valid"), new);
        }
        let mut targets: Vec<_> = numbers.values().collect();
        targets.sort_unstable();
        targets.dedup();
        assert_eq!(targets.len(), numbers.len());

        // It goes on, and saves and loads: no number is given twice.
        for number in 2..=12 {
            generation(&mut grown, number);
            let text = serde_json::to_string(&grown).expect("serialises");
            grown = serde_json::from_str(&text).expect("deserialises");
        }
    }
}

#[test]
fn a_lost_input_is_as_one_that_is_silent() {
    // The second input is lost, the others change places; the first output is lost.
    let turned = TopologyMap::new(vec![Some(2), None, Some(0)], 3).expect("a growth");
    let second = TopologyMap::new(vec![Some(1)], 2).expect("a growth");
    for settings in settings() {
        for outputs in [TopologyMap::none(2), second.clone()] {
            let mut neat = Neat::new(settings.clone(), 3, 2).expect("valid");
            (1..=14).for_each(|number| drop(generation(&mut neat, number)));
            let (old, evaluations) = generation(&mut neat, 15);
            let mut order: Vec<usize> = (0..old.len()).collect();
            order.sort_by_key(|&index| Reverse(evaluations[index].fitness()));
            let mut next = neat.remapped(settings.clone(), None, &turned, &outputs).expect("goes on");
            let new = next.ask(Seed::of_run(2).generation(1)).to_vec();
            for (old, new) in order.iter().map(|&index| &old[index]).zip(&new) {
                let text = serde_json::to_string(new).expect("serialises");
                assert_eq!(&serde_json::from_str::<NeatGenome>(&text).expect("valid"), new);
                assert!(new.connections().len() <= old.connections().len());
                if outputs.old_weight_count() > outputs.weight_count() {
                    continue;
                }
                let (mut before, mut after) = (old.express(), new.express());
                for step in 0..20 {
                    let [a, c] = [0.03, 0.11].map(|scale| scale * (step as f32 - 9.5));
                    let [mut x, mut y] = [[0.0; 2]; 2];
                    before.activate(&[a, 0.0, c], &mut x);
                    after.activate(&[c, 5.0, a], &mut y);
                    let near = x.iter().zip(&y).all(|(x, y)| (x - y).abs() < 1e-3);
                    assert!(near, "{x:?} {y:?} in step {step}, {settings:?}");
                }
            }
            (2..=8).for_each(|number| drop(generation(&mut next, number)));
        }
    }
}

#[test]
fn populations_may_change_their_size() {
    let same = (TopologyMap::none(3), TopologyMap::none(2));
    for size in [25, 90] {
        let mut neat = Neat::new(NeatSettings { population: 40, ..NeatSettings::default() }, 3, 2).expect("valid");
        (1..=5).for_each(|number| drop(generation(&mut neat, number)));
        let settings = NeatSettings { population: size, ..NeatSettings::default() };
        let mut grown = neat.remapped(settings, None, &same.0, &same.1).expect("goes on");
        assert_eq!(grown.ask(Seed::of_run(2).generation(1)).len(), size);
    }
}

#[test]
fn errors_name_what_does_not_fit() {
    let neat = || Neat::new(NeatSettings { recurrent: true, ..NeatSettings::default() }, 3, 2).expect("valid");
    let (inputs, outputs) = growths();
    let error = |settings: NeatSettings, inputs: &TopologyMap, outputs: &TopologyMap| {
        neat().remapped(settings, None, inputs, outputs).expect_err("does not fit").to_string()
    };
    let recurrent = || NeatSettings { recurrent: true, ..NeatSettings::default() };
    let others = TopologyMap::none(4);
    assert_eq!(error(recurrent(), &others, &outputs), "inputs = from 4: must be from 3, as the nets have");
    assert_eq!(error(recurrent(), &inputs, &others), "outputs = from 4: must be from 2, as the nets have");
    assert_eq!(
        error(NeatSettings { recurrent: false, ..recurrent() }, &inputs, &outputs),
        "recurrent = false: must be true, as the nets are"
    );
    let bias = if recurrent().bias == BiasKind::None { BiasKind::PerNeuron } else { BiasKind::None };
    let message = error(NeatSettings { bias, ..recurrent() }, &inputs, &outputs);
    assert!(message.starts_with(&format!("bias = {bias:?}: must be ")), "{message}");
}
