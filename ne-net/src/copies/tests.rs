use super::*;
use crate::{Activation, Topology};
use ne_core::Phenotype;
use proptest::prelude::*;

fn sense(constant: f32, sources: &[(usize, f32)]) -> CopySense {
    CopySense { constant, sources: sources.to_vec() }
}

/// Two legs and a tail. All sense the first input; the legs are mirror images, and the tail has an output of its own.
fn body() -> Copies {
    let leg = |input, sign| NetCopy {
        senses: vec![sense(0.0, &[(0, 1.0)]), sense(0.0, &[(input, sign), (0, 0.5)]), sense(0.25 * sign, &[])],
        sign,
    };
    let tail = NetCopy { senses: vec![sense(0.0, &[(0, 1.0)]), sense(-0.5, &[]), sense(0.0, &[])], sign: 1.0 };
    Copies { inputs: 3, outputs: vec![(1, 0), (0, 0), (2, 1)], copies: vec![leg(1, 1.0), leg(2, -1.0), tail] }
}

/// What a copy senses.
fn sensed(copy: &NetCopy, inputs: &[f32]) -> Vec<f32> {
    let of = |sense: &CopySense| sense.sources.iter().map(|&(input, factor)| factor * inputs[input]).sum::<f32>();
    copy.senses.iter().map(|sense| sense.constant + of(sense)).collect()
}

/// Any net with three inputs and two outputs: four neurons, of which the last two are the outputs.
fn small(recurrent: bool) -> impl Strategy<Value = GraphNet> {
    let odd = prop::sample::select(vec![Activation::Tanh, Activation::Linear, Activation::Sine, Activation::SteepTanh]);
    let neuron = |index: usize| {
        let nodes = if recurrent { 7 } else { 3 + index };
        (odd.clone(), any::<bool>(), prop::sample::subsequence((0..nodes).collect::<Vec<_>>(), 0..=nodes))
    };
    let neurons: Vec<_> = (0..4).map(neuron).collect();
    (neurons, prop::collection::vec(-1.5..1.5_f32, 32)).prop_map(move |(neurons, weights)| {
        let neuron = |(activation, bias, sources)| GraphNeuron { activation, bias, sources };
        let neurons = neurons.into_iter().map(neuron).collect();
        let shape = GraphShape { inputs: 3, recurrent, neurons, outputs: vec![6, 5] };
        let count = shape.weight_count();
        GraphNet::new(shape, &weights[..count]).expect("a net")
    })
}

proptest! {
    #[test]
    fn the_whole_does_what_its_copies_do(
        net in any::<bool>().prop_flat_map(small),
        steps in prop::collection::vec(prop::array::uniform3(-1.0..1.0_f32), 1..4),
    ) {
        let copies = body();
        let mut whole = copies.whole(&net);
        prop_assert_eq!(whole.shape().validate(), Ok(()));
        let mut single = vec![net; 3];
        for inputs in steps {
            let mut found = [0.0; 3];
            whole.activate(&inputs, &mut found);
            let mut expected = [[0.0; 2]; 3];
            for ((copy, net), outputs) in copies.copies.iter().zip(&mut single).zip(&mut expected) {
                net.activate(&sensed(copy, &inputs), outputs);
                outputs.iter_mut().for_each(|output| *output *= copy.sign);
            }
            let expected = copies.outputs.iter().map(|&(copy, output)| expected[copy][output]);
            for (found, expected) in found.into_iter().zip(expected) {
                // Sums in another order; cycles let the difference grow.
                prop_assert!((found - expected).abs() < 1e-3 * (1.0 + expected.abs()), "{} {}", found, expected);
            }
        }
    }
}

#[test]
fn neurons_that_lead_to_no_output_of_a_copy_are_left_out() {
    let neuron = |source| GraphNeuron { activation: Activation::Tanh, bias: false, sources: vec![source] };
    // A hidden neuron for each output.
    let neurons = vec![neuron(0), neuron(1), neuron(3), neuron(4)];
    let shape = GraphShape { inputs: 3, recurrent: false, neurons, outputs: vec![5, 6] };
    let whole = body().whole(&GraphNet::new(shape, &[1.0, 2.0, 3.0, 4.0]).expect("a net"));
    let shape = whole.shape();
    assert_eq!((shape.neurons.len(), &shape.outputs[..]), (6, &[6, 4, 8][..]));
    // The tail's input is constant: a bias, and no source. The mirror image's hidden neuron is not turned, its output is.
    assert_eq!(shape.neurons[4], GraphNeuron { activation: Activation::Tanh, bias: true, sources: vec![] });
    assert_eq!(whole.weights(), [1.0, 3.0, 1.0, -3.0, -1.0, 4.0]);
}

#[test]
fn a_topology_of_copies_has_the_small_nets_weights() {
    let neuron = |source| GraphNeuron { activation: Activation::Tanh, bias: true, sources: vec![source] };
    let small = GraphShape { inputs: 3, recurrent: false, neurons: vec![neuron(0), neuron(1)], outputs: vec![3, 4] };
    let topology = Topology::from(CopiedShape { small: small.into(), copies: body().into() });
    assert_eq!((topology.inputs(), topology.outputs(), topology.weight_count()), (3, 3, 4));
    assert_eq!(topology.weights_of_neurons().collect::<Vec<_>>(), [2, 2]);
    assert_eq!(topology.to_string(), "3 copies of 3 inputs, 0 hidden, 2 outputs, 2 connections");
    assert_eq!((topology.validate(), topology.view().neurons.len()), (Ok(()), 3));
    let network = topology.network(&[0.1, 1.0, 0.2, 2.0]);
    assert_eq!((network.inputs(), network.outputs()), (3, 3));
    let text = serde_json::to_string(&topology).expect("serialises");
    assert_eq!(serde_json::from_str::<Topology>(&text).expect("deserialises"), topology);
    let other = text.replace("\"small\":{\"inputs\":3", "\"small\":{\"inputs\":4");
    let error = serde_json::from_str::<Topology>(&other).expect_err("another input").to_string();
    assert!(error.contains("must be"), "{error}");
}

#[test]
fn weights_of_any_finite_genes_are_finite() {
    let neuron = || GraphNeuron { activation: Activation::Tanh, bias: true, sources: vec![0, 1, 2] };
    let shape = GraphShape { inputs: 3, recurrent: false, neurons: vec![neuron(), neuron()], outputs: vec![3, 4] };
    let copies = body();
    for weight in [f32::MAX, f32::MIN] {
        let net = GraphNet::new(shape.clone(), &[weight; 8]).expect("a net");
        assert!(copies.whole(&net).weights().iter().all(|weight| weight.is_finite()));
    }
}

#[test]
fn errors_name_the_field() {
    type Change = fn(&mut Copies);
    let changes: [(Change, &str); 11] = [
        (|c| c.inputs = 0, "inputs = 0 inputs: must be from 1 to 4096 inputs"),
        (|c| c.outputs.clear(), "outputs = 0 outputs: must be from 1 to 4096 outputs"),
        (|c| c.copies.clear(), "copies = 0 copies: must be from 1 to 4096 copies"),
        (
            |c| drop(c.copies[1].senses.pop()),
            "copies[1].senses = 2 senses: must be as many as in every copy, from 1 to 4096",
        ),
        (|c| c.copies[2].sign = 0.5, "copies[2].sign = 0.5: must be -1 or 1"),
        (|c| c.copies[0].senses[2].constant = f32::NAN, "copies[0].senses[2] = NaN: must be finite"),
        (
            |c| c.copies[0].senses[1].sources[0].0 = 3,
            "copies[0].senses[1].sources = 3: must be an input below 3, listed once",
        ),
        (
            |c| c.copies[0].senses[1].sources[0].0 = 0,
            "copies[0].senses[1].sources = 0: must be an input below 3, listed once",
        ),
        (|c| c.outputs[0].0 = 3, "outputs[0] = 0 of copy 3: must be of a copy below 3"),
        (|c| c.outputs[0].1 = 4096, "outputs[0] = 4096 of copy 1: must be below 4096"),
        (|c| c.outputs[1] = c.outputs[0], "outputs[1] = 0 of copy 1: must be listed once"),
    ];
    for (change, message) in changes {
        let mut copies = body();
        change(&mut copies);
        assert_eq!(copies.validate().expect_err("not allowed").to_string(), message);
    }
}

#[test]
fn a_whole_that_would_be_no_net_is_refused() {
    let neuron = GraphNeuron { activation: Activation::Tanh, bias: true, sources: vec![0, 1, 2] };
    let small = |neurons: usize| GraphShape {
        inputs: 3,
        recurrent: false,
        neurons: vec![neuron.clone(); neurons],
        outputs: vec![3, 4],
    };
    let error = |neurons, copies: Copies| {
        let shape = CopiedShape { small: small(neurons).into(), copies: copies.into() };
        shape.validate().expect_err("too large").to_string()
    };
    assert_eq!(error(21_846, body()), "small.neurons = 21846 neurons: must be at most 21845 with 3 copies");
    // A sense of 4,096 inputs.
    let mut wide = Copies { inputs: 4096, ..body() };
    wide.copies[0].senses[0].sources = (0..4096).map(|input| (input, 1.0)).collect();
    let found = 2000 * (1 + 4096 + 2 + 1) * 3;
    assert_eq!(error(2000, wide), format!("small = {found} weights in all copies: must be at most 16777216"));
}
