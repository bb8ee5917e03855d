//! What graph nets promise, for nets of any graph.

use ne_core::{Phenotype, conformance::check_phenotype};
use ne_net::{Activation, DenseNet, DenseShape, GraphNet, GraphNeuron, GraphShape};
use proptest::{collection::vec, prelude::*, sample};
use std::sync::Arc;

/// The definition, written down neuron by neuron, of one step; `before` holds what each node put out in the step before.
fn reference(net: &GraphNet, before: &[f32], inputs: &[f32]) -> Vec<f32> {
    let mut weights = net.weights().iter();
    let mut weight = || *weights.next().expect("as many weights as the shape has");
    let mut now = inputs.to_vec();
    for neuron in &net.shape().neurons {
        let mut sum = if neuron.bias { weight() } else { 0.0 };
        for &source in &neuron.sources {
            sum += weight() * now.get(source).unwrap_or_else(|| &before[source]);
        }
        now.push(neuron.activation.apply(sum));
    }
    now
}

/// All NaN are one: which of them comes out of a sum of two is up to the processor.
fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|value| if value.is_nan() { f32::NAN.to_bits() } else { value.to_bits() }).collect()
}

fn activate(net: &mut GraphNet, inputs: &[f32]) -> Vec<f32> {
    let mut outputs = vec![f32::NAN; net.outputs()];
    net.activate(inputs, &mut outputs);
    outputs
}

fn neurons(activations: &[Activation], sources: Vec<usize>, most: usize) -> impl Strategy<Value = GraphNeuron> + use<> {
    let most = sources.len().min(most);
    (sample::select(activations.to_vec()), any::<bool>(), sample::subsequence(sources, 0..=most).prop_shuffle())
        .prop_map(|(activation, bias, sources)| GraphNeuron { activation, bias, sources })
}

prop_compose! {
    /// Shapes, feed-forward or recurrent, with one or two of these activations: few, so that neighbours often share theirs.
    fn shapes_of(activations: Vec<Activation>)(
        activations in sample::subsequence(activations, 1..=2), recurrent in any::<bool>(),
        inputs in 1..10usize, count in 1..30usize, most_sources in 1..20usize,
    )(
        neurons in (inputs..inputs + count)
            .map(|node| neurons(&activations, (0..if recurrent { inputs + count } else { node }).collect(), most_sources))
            .collect::<Vec<_>>(),
        outputs in sample::subsequence((inputs..inputs + count).collect::<Vec<_>>(), 1..=count).prop_shuffle(),
        inputs in Just(inputs), recurrent in Just(recurrent),
    ) -> GraphShape {
        GraphShape { inputs, recurrent, neurons, outputs }
    }
}

prop_compose! {
    /// Nets, and the inputs of five steps.
    fn nets_of(activations: Vec<Activation>)(shape in shapes_of(activations))(
        weights in vec(-2.0..2.0f32, shape.weight_count()), steps in vec(vec(-3.0..3.0f32, shape.inputs), 5), shape in Just(shape),
    ) -> (GraphNet, Vec<Vec<f32>>) {
        (GraphNet::new(shape, &weights).expect("valid"), steps)
    }
}

/// With activations that keep within bounds what runs in circles.
fn bounded_nets() -> impl Strategy<Value = (GraphNet, Vec<Vec<f32>>)> {
    nets_of(Activation::ALL.into_iter().filter(|activation| activation.range().1 == 1.0).collect())
}

fn all_outputs(net: &mut GraphNet, steps: &[Vec<f32>]) -> Vec<Vec<u32>> {
    steps.iter().map(|inputs| bits(&activate(net, inputs))).collect()
}

proptest! {
    #[test]
    fn equals_the_definition_to_the_bit((mut net, steps) in nets_of(Activation::ALL.to_vec())) {
        let mut wanted = vec![0.0; net.activations().len()];
        prop_assert_eq!(bits(net.activations()), bits(&wanted));
        for inputs in steps {
            let outputs = activate(&mut net, &inputs);
            wanted = reference(&net, &wanted, &inputs);
            prop_assert_eq!(bits(net.activations()), bits(&wanted));
            let nodes = &net.shape().outputs;
            prop_assert_eq!(bits(&outputs), nodes.iter().map(|&node| wanted[node].to_bits()).collect::<Vec<_>>());
        }
    }

    #[test]
    fn reset_is_birth((mut net, steps) in bounded_nets()) {
        let born = all_outputs(&mut net, &steps);
        net.reset();
        prop_assert!(net.activations().iter().all(|&value| value == 0.0));
        prop_assert_eq!(all_outputs(&mut net, &steps), born);
    }

    #[test]
    fn without_recurrence_there_is_no_memory((mut net, steps) in bounded_nets()) {
        if !net.shape().recurrent {
            let first = all_outputs(&mut net, &steps);
            prop_assert_eq!(all_outputs(&mut net, &steps), first);
        }
    }

    #[test]
    fn keeps_the_promises_of_a_phenotype((net, _) in bounded_nets()) {
        let weights = net.weights().to_vec();
        let shape = net.shape().clone();
        prop_assert_eq!(check_phenotype(|| GraphNet::from_checked(Arc::clone(&shape), &weights)), Ok(()));
    }

    #[test]
    fn survives_serialisation_to_the_bit((mut net, steps) in bounded_nets()) {
        let text = serde_json::to_string(&net).expect("serialises");
        let mut loaded: GraphNet = serde_json::from_str(&text).expect("deserialises");
        prop_assert_eq!(bits(loaded.weights()), bits(net.weights()));
        prop_assert_eq!(&loaded, &net);
        prop_assert_eq!(all_outputs(&mut loaded, &steps), all_outputs(&mut net, &steps));
    }

    #[test]
    fn a_shape_counts_what_it_has(shape in shapes_of(Activation::ALL.to_vec())) {
        let biases = shape.neurons.iter().filter(|neuron| neuron.bias).count();
        prop_assert_eq!(shape.weight_count(), shape.connection_count() + biases);
        prop_assert_eq!(shape.hidden_count() + shape.outputs.len(), shape.neurons.len());
        let text = format!(
            "{} inputs, {} hidden, {} outputs, {} connections",
            shape.inputs, shape.hidden_count(), shape.outputs.len(), shape.connection_count()
        );
        prop_assert_eq!(shape.to_string(), text);
    }

    #[test]
    fn a_dense_net_is_a_graph_net(
        dense in (1..8usize, vec(1..12usize, 0..3), 1..12usize),
        activations in (sample::select(Activation::ALL.to_vec()), sample::select(Activation::ALL.to_vec())),
        numbers in vec(-2.0..2.0f32, 1000), inputs in vec(-3.0..3.0f32, 8),
    ) {
        let (hidden_activation, output_activation) = activations;
        let dense = DenseShape {
            hidden_activation, output_activation, hidden_scale: 1.0, ..DenseShape::new(dense.0, dense.1, dense.2)
        };
        let weights = &numbers[..dense.weight_count()];
        let inputs = &inputs[..dense.inputs];
        let mut graph = as_graph(&dense, weights);
        let mut outputs = vec![0.0; dense.outputs];
        DenseNet::new(dense, weights).expect("valid").activate(inputs, &mut outputs);
        prop_assert_eq!(bits(&activate(&mut graph, inputs)), bits(&outputs));
    }
}

/// The same net, neuron by neuron. The weight of a bias is the last of a neuron's there, the first here.
fn as_graph(dense: &DenseShape, mut weights: &[f32]) -> GraphNet {
    let (mut neurons, mut graph_weights) = (Vec::new(), Vec::new());
    let mut first_source = 0;
    let last = dense.hidden.len();
    for (layer, (sources, targets)) in dense.connections().enumerate() {
        let activation = if layer == last { dense.output_activation } else { dense.hidden_activation };
        for _ in 0..targets {
            let (mine, rest) = weights.split_at(sources + 1);
            graph_weights.push(mine[sources]);
            graph_weights.extend_from_slice(&mine[..sources]);
            weights = rest;
            neurons.push(GraphNeuron {
                activation,
                bias: true,
                sources: (first_source..first_source + sources).collect(),
            });
        }
        first_source += sources;
    }
    let outputs = (first_source..first_source + dense.outputs).collect();
    let shape = GraphShape { inputs: dense.inputs, recurrent: false, neurons, outputs };
    GraphNet::new(shape, &graph_weights).expect("valid")
}

fn neuron(bias: bool, sources: &[usize]) -> GraphNeuron {
    GraphNeuron { activation: Activation::Linear, bias, sources: sources.to_vec() }
}

/// Node 0 is the input; node 1 hears node 2 a step late, node 2 hears node 1 at once and itself a step late.
fn recurrent() -> GraphShape {
    let neurons = vec![neuron(false, &[0, 2]), neuron(false, &[1, 2])];
    GraphShape { inputs: 1, recurrent: true, neurons, outputs: vec![1, 2] }
}

#[test]
fn a_source_behind_gives_what_it_put_out_a_step_before() {
    let mut net = GraphNet::new(recurrent(), &[1.0, 10.0, 1.0, 100.0]).expect("valid");
    let steps = [1.0, 0.0, 2.0].map(|input| activate(&mut net, &[input]));
    assert_eq!(steps, [[1.0, 1.0], [10.0, 110.0], [1102.0, 12102.0]]);
    assert_eq!(net.activations(), [2.0, 1102.0, 12102.0]);
}

#[test]
fn neurons_that_feed_each_other_both_ways_are_not_computed_at_once() {
    // Neighbours with one activation: two hear each other, and the third hears both.
    let neurons = vec![neuron(false, &[2, 3, 0]), neuron(false, &[1]), neuron(true, &[1, 2])];
    let shape = GraphShape { inputs: 1, recurrent: true, neurons, outputs: vec![3] };
    let mut net = GraphNet::new(shape, &[1.0, 1.0, 1.0, 2.0, 0.5, 1.0, 1.0]).expect("valid");
    let steps = [1.0, 0.0].map(|input| activate(&mut net, &[input]));
    assert_eq!(steps, [[0.5 + 1.0 + 2.0], [0.5 + 5.5 + 11.0]]);
}

#[test]
fn a_negative_zero_is_kept() {
    // A sum that started at 0 would lose the sign.
    let shape = GraphShape { inputs: 1, recurrent: false, neurons: vec![neuron(true, &[])], outputs: vec![1] };
    let mut net = GraphNet::new(shape, &[-0.0]).expect("valid");
    assert_eq!(bits(&activate(&mut net, &[0.0])), bits(&[-0.0]));
}

#[test]
fn a_copy_remembers_what_the_original_does_and_a_file_does_not() {
    let mut net = GraphNet::new(recurrent(), &[1.0, 10.0, 1.0, 100.0]).expect("valid");
    activate(&mut net, &[1.0]);
    let mut copy = net.clone();
    let text = serde_json::to_string(&net).expect("serialises");
    let mut loaded: GraphNet = serde_json::from_str(&text).expect("deserialises");
    assert_eq!((&copy, &loaded), (&net, &net), "what nets remember does not count");
    assert_eq!(activate(&mut net, &[0.0]), [10.0, 110.0]);
    assert_eq!(activate(&mut copy, &[0.0]), [10.0, 110.0]);
    assert_eq!(activate(&mut loaded, &[0.0]), [0.0, 0.0]);
}

#[test]
fn nan_goes_through_to_the_outputs() {
    for activation in Activation::ALL {
        let neuron = |sources: &[usize]| GraphNeuron { activation, bias: true, sources: sources.to_vec() };
        let neurons = vec![neuron(&[0, 1]), neuron(&[0]), neuron(&[2, 3])];
        let shape = GraphShape { inputs: 2, recurrent: false, neurons, outputs: vec![3, 4] };
        let mut net = GraphNet::new(shape, &[0.5; 8]).expect("valid");
        let outputs = activate(&mut net, &[0.0, f32::NAN]);
        assert!(outputs[0].is_finite() && outputs[1].is_nan(), "{activation}");
        assert!(activate(&mut net, &[0.0, 1.0]).iter().all(|output| output.is_finite()), "{activation}");
    }
}

#[test]
fn errors_name_the_field() {
    let mut weights = [0.5; 4];
    weights[2] = f32::INFINITY;
    let error = |shape: GraphShape, weights: &[f32]| GraphNet::new(shape, weights).expect_err("not a net").to_string();
    assert_eq!(error(recurrent(), &weights), "weights[2] = inf: must be finite");
    assert_eq!(
        error(recurrent(), &weights[..3]),
        "weights: found 3, a net of 1 inputs, 0 hidden, 2 outputs, 4 connections has 4"
    );
    let empty = GraphShape { outputs: vec![], ..recurrent() };
    assert_eq!(error(empty, &weights), "shape.outputs = 0 outputs: must be from 1 to 4096 outputs");
}

#[test]
fn damaged_files_are_errors() {
    let file = |neuron: &str, weights: &str| {
        format!(
            r#"{{"shape": {{"inputs": 2, "recurrent": false, "neurons": [{neuron}], "outputs": [2]}}, "weights": {weights}}}"#
        )
    };
    let neuron = r#"{"activation": "tanh", "bias": false, "sources": [1]}"#;
    assert!(serde_json::from_str::<GraphNet>(&file(neuron, "[0.5]")).is_ok());
    for (text, part) in [
        (file(neuron, "[]"), "weights: found 0, a net of 2 inputs, 0 hidden, 1 outputs, 1 connections has 1"),
        (file(neuron, "[1e39]"), "number out of range"),
        (file(neuron, "[null]"), "invalid type: null"),
        (
            file(r#"{"activation": "swish", "bias": false, "sources": [1]}"#, "[1]"),
            "unknown variant `swish`, expected one of `logistic`, `tanh`, `rational-tanh`, `relu`, `linear`, `sine`, \
             `gaussian`, `steep-logistic`, `steep-tanh`",
        ),
        (file(r#"{"bias": false, "sources": [1]}"#, "[1]"), "missing field `activation`"),
        (file(r#"{"activation": "tanh", "bias": 0.5, "sources": [1]}"#, "[1]"), "expected a boolean"),
        (file(r#"{"activation": "tanh", "bias": false, "sources": [-1]}"#, "[1]"), "invalid value: integer `-1`"),
        (
            file(r#"{"activation": "tanh", "bias": false, "sources": [1], "scale": 3}"#, "[1]"),
            "unknown field `scale`, expected one of `activation`, `bias`, `sources`",
        ),
        (
            file(r#"{"activation": "tanh", "bias": false, "sources": [3]}"#, "[1]"),
            "neurons[0].sources[0] = 3: must be below 3, the number of nodes",
        ),
        (
            file(r#"{"activation": "tanh", "bias": false, "sources": [2]}"#, "[1]"),
            "neurons[0].sources[0] = 2: must be below 2, the node of this neuron",
        ),
    ] {
        let error = serde_json::from_str::<GraphNet>(&text).expect_err("damaged").to_string();
        assert!(error.contains(part), "{error}");
    }
    // Through a value, a number too large for an f32 becomes an infinity.
    let value = serde_json::from_str::<serde_json::Value>(&file(neuron, "[1e39]"));
    let error = serde_json::from_value::<GraphNet>(value.expect("JSON")).expect_err("infinite").to_string();
    assert!(error.contains("weights[0] = inf: must be finite"), "{error}");
}

#[test]
#[should_panic = "number of weights for a net of 1 inputs, 0 hidden, 2 outputs, 4 connections"]
fn a_wrong_number_of_weights_for_a_checked_shape_panics() {
    GraphNet::from_checked(recurrent().into(), &[0.5; 3]);
}

/// Golden: other bits are other runs, and champions that no longer repeat theirs.
#[test]
fn bits_are_the_same_for_ever() {
    let neurons = (0..12_usize).map(|index| GraphNeuron {
        activation: if index < 4 { Activation::SteepTanh } else { Activation::Tanh },
        bias: index % 3 != 0,
        sources: (0..9).chain([9 + (index + 5) % 12]).collect(),
    });
    let shape = GraphShape { inputs: 9, recurrent: true, neurons: neurons.collect(), outputs: (13..21).collect() };
    let weights: Vec<f32> = (0..128).map(|index| ((index * 37 % 101) as f32 - 50.0) * 0.006).collect();
    let mut net = GraphNet::new(shape, &weights).expect("valid");
    let inputs: Vec<f32> = (0..9).map(|index| (index as f32 - 4.0) * 0.7).collect();
    activate(&mut net, &inputs);
    let golden =
        [0x3edd_ce0d, 0x3ecd_2224, 0xbf35_be94, 0xbf3a_2e4d, 0xbf35_b767, 0xbed8_4362, 0xbe66_179a, 0xbe4c_de50];
    assert_eq!(bits(&activate(&mut net, &inputs)), golden);
}
