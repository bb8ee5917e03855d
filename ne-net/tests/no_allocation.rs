//! `activate` allocates nothing. In a binary of its own, since the allocator that counts is the program's.

use ne_core::Phenotype;
use ne_net::{Activation, DenseNet, DenseShape, GraphNet, GraphNeuron, GraphShape, Network};

fn dense(activation: Activation) -> Network {
    let shape = DenseShape { hidden_activation: activation, ..DenseShape::new(9, vec![10, 17], 8) };
    let weights = vec![0.1; shape.weight_count()];
    DenseNet::new(shape, &weights).expect("valid").into()
}

/// Recurrent; every second neuron has another activation.
fn graph(activation: Activation) -> Network {
    let neuron = |index| {
        let activation = if index % 2 == 0 { activation } else { Activation::Tanh };
        GraphNeuron { activation, bias: true, sources: (index..index + 9).collect() }
    };
    let neurons = (0..13).map(neuron).collect();
    let shape = GraphShape { inputs: 9, recurrent: true, neurons, outputs: (14..22).collect() };
    let weights = vec![0.1; shape.weight_count()];
    GraphNet::new(shape, &weights).expect("valid").into()
}

#[test]
fn activate_and_reset_allocate_nothing() {
    let mut nets: Vec<_> =
        Activation::ALL.into_iter().flat_map(|activation| [dense(activation), graph(activation)]).collect();
    let mut outputs = [0.0; 8];
    let counted = allocation_counter::measure(|| {
        for net in &mut nets {
            net.activate(&[0.5; 9], &mut outputs);
            net.reset();
        }
    });
    assert_eq!(counted.count_total, 0);
}

#[test]
fn the_counter_counts() {
    let counted = allocation_counter::measure(|| drop(dense(Activation::Tanh)));
    assert!(counted.count_total > 0);
}
