//! What a genome promises.

use ne_core::{Genome, Phenotype, conformance::check_genome};
use ne_neat::{BiasKind, ConnectionGene, Layout, NeatGenome, NodeGene, NodeKind};
use ne_net::Activation;
use proptest::prelude::*;
use serde_json::{Value, json};

/// Two inputs (0, 1), a bias node (2), an output (3).
const LAYOUT: Layout = Layout { inputs: 2, outputs: 1, bias: BiasKind::InputNode, recurrent: false };

fn node(id: u32) -> NodeGene {
    NodeGene { id, activation: Activation::Tanh, bias: 0.0 }
}

fn connection(innovation: u32, from: u32, to: u32, weight: f32) -> ConnectionGene {
    ConnectionGene { innovation, from, to, weight, enabled: true }
}

fn output_of(genome: &NeatGenome, steps: &[[f32; 2]]) -> f32 {
    let (mut net, mut output) = (genome.express(), [0.0]);
    steps.iter().for_each(|inputs| net.activate(inputs, &mut output));
    output[0]
}

#[test]
fn nodes_are_what_their_numbers_say() {
    let kinds: Vec<_> = (0..6).map(|node| LAYOUT.kind(node)).collect();
    use NodeKind::{Bias, Hidden, Input, Output};
    assert_eq!(kinds, [Input, Input, Bias, Output, Hidden, Hidden]);
    let without = Layout { bias: BiasKind::None, ..LAYOUT };
    assert_eq!((without.kind(2), without.kind(3)), (Output, Hidden));
}

#[test]
fn a_net_is_what_its_genes_say() {
    let nodes = vec![node(3), node(4)];
    let mut disabled = connection(1, 1, 3, 100.0);
    disabled.enabled = false;
    let connections = vec![
        connection(0, 0, 3, 0.5),
        disabled,
        connection(2, 2, 4, -0.25),
        connection(5, 1, 4, 2.0),
        connection(6, 4, 3, 1.5),
    ];
    let genome = NeatGenome::new(LAYOUT, nodes, connections).expect("valid");
    assert_eq!((genome.hidden_count(), genome.enabled_count()), (1, 4));
    let hidden = Activation::Tanh.apply(-0.25 + 2.0 * 0.7);
    let output = Activation::Tanh.apply(0.5 * 0.3 + 1.5 * hidden);
    assert_eq!(output_of(&genome, &[[0.3, 0.7]]), output);
    check_genome(&[genome]).expect("keeps its promises");
}

#[test]
fn what_leads_nowhere_is_not_expressed() {
    let connections = vec![connection(0, 0, 3, 0.5), connection(3, 0, 4, 1.0), connection(4, 4, 5, 1.0)];
    let genome = NeatGenome::new(LAYOUT, vec![node(3), node(4), node(5)], connections).expect("valid");
    let net = genome.express();
    assert_eq!((net.shape().hidden_count(), net.weights()), (0, &[0.5][..]));
}

#[test]
fn neurons_without_connections_put_out_a_constant() {
    let genome = NeatGenome::new(LAYOUT, vec![NodeGene { activation: Activation::Logistic, ..node(3) }], vec![]);
    assert_eq!(output_of(&genome.expect("valid"), &[[1.0, 1.0]]), 0.5);
}

#[test]
fn a_bias_of_a_neuron_is_its_genes() {
    let layout = Layout { bias: BiasKind::PerNeuron, ..LAYOUT };
    let nodes = vec![NodeGene { bias: 0.3, ..node(2) }];
    let genome = NeatGenome::new(layout, nodes, vec![connection(0, 1, 2, 2.0)]).expect("valid");
    assert_eq!(output_of(&genome, &[[9.0, 0.1]]), Activation::Tanh.apply(0.3 + 2.0 * 0.1));
}

/// Of two connections that form a cycle, the younger one is a step behind; disabling or splitting leaves it so.
#[test]
fn the_younger_connection_of_a_cycle_is_delayed() {
    let layout = Layout { recurrent: true, ..LAYOUT };
    let connections = vec![connection(3, 0, 4, 1.0), connection(4, 4, 3, 1.0), connection(5, 3, 4, 1.0)];
    let genome = NeatGenome::new(layout, vec![node(3), node(4)], connections.clone()).expect("valid");
    let tanh = |a| Activation::Tanh.apply(a);
    let first = tanh(tanh(0.5));
    let second = tanh(tanh(0.25 + first));
    assert_eq!(output_of(&genome, &[[0.5, 0.0], [0.25, 0.0]]), second);

    let mut split = connections;
    split[1].enabled = false;
    split.extend([connection(6, 4, 5, 1.0), connection(7, 5, 3, 1.0)]);
    let genome = NeatGenome::new(layout, vec![node(3), node(4), node(5)], split).expect("valid");
    let first = tanh(tanh(tanh(0.5)));
    let second = tanh(tanh(tanh(0.25 + first)));
    assert_eq!(output_of(&genome, &[[0.5, 0.0], [0.25, 0.0]]), second);
}

#[test]
fn a_neuron_can_listen_to_itself() {
    let layout = Layout { recurrent: true, ..LAYOUT };
    let connections = vec![connection(0, 0, 3, 1.0), connection(3, 3, 3, -0.5)];
    let genome = NeatGenome::new(layout, vec![node(3)], connections).expect("valid");
    let first = Activation::Tanh.apply(0.5);
    assert_eq!(output_of(&genome, &[[0.5, 0.0], [0.5, 0.0]]), Activation::Tanh.apply(0.5 - 0.5 * first));
}

#[test]
fn errors_name_the_gene() {
    type Change = fn(&mut Value);
    let changes: [(Change, &str); 17] = [
        (|g| g["layout"]["inputs"] = 0.into(), "layout.inputs = 0: must be from 1 to 4096"),
        (|g| g["layout"]["outputs"] = 5000.into(), "layout.outputs = 5000: must be from 1 to 4096"),
        (|g| g["nodes"] = json!([]), "nodes: found 0 outputs, the layout has 1, numbered from 3"),
        (|g| g["nodes"][0]["id"] = 2.into(), "nodes: found 0 outputs, the layout has 1, numbered from 3"),
        (|g| g["nodes"][2]["id"] = 4.into(), "nodes[2]: 4 does not come after 4"),
        (|g| g["nodes"][1]["bias"] = json!(1e39), "nodes[1].bias = inf: must be finite"),
        (|g| g["nodes"][1]["activation"] = "step".into(), "unknown variant `step`"),
        (|g| g["connections"][1]["innovation"] = 0.into(), "connections[1]: 0 does not come after 0"),
        (|g| g["connections"][1]["from"] = 9.into(), "connections[1].from = 9: must be a node of the genome"),
        (|g| g["connections"][1]["to"] = 9.into(), "connections[1].to = 9: must be a neuron of the genome"),
        (|g| g["connections"][1]["to"] = 1.into(), "connections[1].to = 1: must be a neuron of the genome"),
        (|g| g["connections"][1]["to"] = 2.into(), "connections[1].to = 2: must be a neuron of the genome"),
        (|g| g["connections"][1]["weight"] = json!(-1e39), "connections[1].weight = -inf: must be finite"),
        (
            |g| g["connections"][1] = json!({"innovation": 1, "from": 0, "to": 3, "weight": 1, "enabled": true}),
            "connections[1]: leads from 0 to 3, as connections[0] does",
        ),
        (
            |g| g["connections"][3]["from"] = 5.into(),
            "connections: form a cycle, which a layout that is not recurrent does not allow",
        ),
        (|g| g["connections"][0]["gater"] = 5.into(), "unknown field `gater`"),
        (|g| g["layout"]["bias"] = "node".into(), "unknown variant `node`"),
    ];
    let mut connections = vec![connection(0, 0, 3, 0.5), connection(1, 1, 3, 0.5)];
    // 4 to 5 to 3; the change makes the last one lead from 5 to 4.
    connections.extend([connection(2, 4, 5, 1.0), connection(3, 0, 4, 1.0), connection(4, 5, 3, 1.0)]);
    let genome = NeatGenome::new(LAYOUT, vec![node(3), node(4), node(5)], connections).expect("valid");
    let text = serde_json::to_value(&genome).expect("serialises");
    assert_eq!(serde_json::from_value::<NeatGenome>(text.clone()).expect("deserialises"), genome);
    for (change, message) in changes {
        let mut changed = text.clone();
        change(&mut changed);
        let error = serde_json::from_value::<NeatGenome>(changed).expect_err(message).to_string();
        assert!(error.starts_with(message), "{error}; expected {message}");
    }
}

#[test]
fn a_picture_has_names_weights_and_styles() {
    let layout = Layout { recurrent: true, ..LAYOUT };
    let mut connections = vec![connection(0, 0, 3, 0.5), connection(3, 0, 4, 1.0), connection(4, 4, 3, -2.0)];
    connections.push(connection(5, 3, 4, 0.25));
    connections[0].enabled = false;
    let genome = NeatGenome::new(layout, vec![node(3), node(4)], connections).expect("valid");
    let expected = r#"digraph {
    rankdir="LR"
    0 [ label = "speed" shape = box]
    1 [ label = "input 1" shape = box]
    2 [ label = "bias" shape = box]
    3 [ label = "a \"motor\"" shape = doublecircle]
    4 [ label = "4 tanh" shape = circle]
    0 -> 3 [ label = "0.5" style = dashed]
    0 -> 4 [ label = "1"]
    4 -> 3 [ label = "-2"]
    3 -> 4 [ label = "0.25" color = blue constraint = false]
}
"#;
    assert_eq!(genome.to_dot(&["speed"], &["a \"motor\""]), expected);
}

/// A genome with any connections between three inputs' places, two outputs and five hidden neurons.
fn any_genome() -> impl Strategy<Value = NeatGenome> {
    let genes = proptest::collection::vec((0..10_u32, 3..10_u32, -3.0..3.0_f32, proptest::bool::ANY), 0..40);
    (genes, proptest::bool::ANY).prop_map(|(genes, recurrent)| {
        let layout = Layout { inputs: 3, outputs: 2, bias: BiasKind::PerNeuron, recurrent };
        let nodes: Vec<_> = (3..10).map(|id| NodeGene { bias: 0.1 * id as f32, ..node(id) }).collect();
        let mut genome = NeatGenome::new(layout, nodes.clone(), vec![]).expect("valid");
        for (innovation, (from, to, weight, enabled)) in (0..).zip(genes) {
            let mut connections = genome.connections().to_vec();
            connections.push(ConnectionGene { innovation, from, to, weight, enabled });
            // Doubles, and cycles where none may be, are left out.
            genome = NeatGenome::new(layout, nodes.clone(), connections).unwrap_or(genome);
        }
        genome
    })
}

proptest! {
    /// Read from the genes alone: each neuron asks its sources, unless they are asking it; then they tell of before.
    #[test]
    fn feed_forward_nets_compute_what_the_genes_say(genome in any_genome(), inputs in proptest::array::uniform3(-1.0..1.0f32)) {
        fn value(node: u32, genome: &NeatGenome, inputs: &[f32; 3]) -> f32 {
            let Ok(index) = genome.nodes().binary_search_by_key(&node, |gene| gene.id) else {
                return inputs[node as usize];
            };
            let gene = genome.nodes()[index];
            let sources = genome.connections().iter().filter(|gene| gene.enabled && gene.to == node);
            let sum = sources.fold(gene.bias, |sum, gene| sum + gene.weight * value(gene.from, genome, inputs));
            gene.activation.apply(sum)
        }
        if !genome.layout().recurrent {
            let (mut net, mut outputs) = (genome.express(), [0.0; 2]);
            net.activate(&inputs, &mut outputs);
            prop_assert_eq!(outputs, [3, 4].map(|output| value(output, &genome, &inputs)));
        }
    }

    #[test]
    fn genomes_keep_their_promises(genome in any_genome()) {
        prop_assert_eq!(genome.express().shape().validate(), Ok(()));
        let loaded: NeatGenome = serde_json::from_value(serde_json::to_value(&genome)?)?;
        prop_assert_eq!(loaded.express(), genome.express());
        check_genome(&[genome]).map_err(|violation| TestCaseError::fail(violation.to_string()))?;
    }

    /// A connection that has got its direction keeps it, whatever younger ones do.
    #[test]
    fn younger_connections_do_not_turn_older_ones(genome in any_genome()) {
        let delayed = |genome: &NeatGenome| -> Vec<String> {
            let picture = genome.to_dot(&[], &[]);
            picture.lines().filter(|line| line.contains("->")).map(|line| line.contains("blue").to_string()).collect()
        };
        let mut enabled = genome.connections().to_vec();
        enabled.iter_mut().for_each(|gene| gene.enabled = true);
        let old = enabled[..enabled.len() / 2].to_vec();
        let build = |connections| NeatGenome::new(*genome.layout(), genome.nodes().to_vec(), connections).expect("valid");
        let (old, all) = (build(old), build(enabled));
        // Only connections between neurons that lead to an output are marked.
        for (before, after) in delayed(&old).iter().zip(delayed(&all)) {
            prop_assert!(before == "false" || after == "true");
        }
    }
}
