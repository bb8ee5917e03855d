//! `activate` allocates nothing. In a binary of its own, since it counts the allocations of the whole program.

use ne_core::Phenotype;
use ne_net::{Activation, DenseNet, DenseShape, GraphNet, GraphNeuron, GraphShape, Network};
use std::{
    alloc::{GlobalAlloc, Layout, System},
    sync::atomic::{AtomicUsize, Ordering},
};

struct Counting;

static ALLOCATIONS: AtomicUsize = AtomicUsize::new(0);

// The trait is unsafe to implement; each method hands its call on to the system's allocator as it came.
#[allow(unsafe_code)]
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.fetch_add(1, Ordering::Relaxed);
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

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
    // The test harness' other thread may allocate while we count; it does not do so a hundred times in a row.
    let quiet = (0..100).any(|_| {
        let before = ALLOCATIONS.load(Ordering::Relaxed);
        for net in &mut nets {
            net.activate(&[0.5; 9], &mut outputs);
            net.reset();
        }
        ALLOCATIONS.load(Ordering::Relaxed) == before
    });
    assert!(quiet, "each of a hundred rounds allocated");
}
