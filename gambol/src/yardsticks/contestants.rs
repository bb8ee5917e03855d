use super::Yardstick;
use crate::config::StrategySettings;
use ne_fixed::{CmaEsSettings, ConventionalNeSettings, CosyneSettings, OpenEsSettings};
use ne_neat::NeatSettings;
use ne_net::{Activation, DenseShape, GraphNeuron, GraphShape, Topology};
use tasks::OutputRange;

/// A strategy with the settings and the net it has for a task.
#[derive(Clone, Debug)]
pub struct Contestant {
    /// The task.
    pub task: Yardstick,
    /// The strategy and its settings.
    pub settings: StrategySettings,
    /// The net whose weights are searched; NEAT takes the numbers of inputs and outputs from it.
    pub topology: Topology,
    /// The range of its outputs.
    pub output_range: OutputRange,
    /// Settings and net, in words.
    pub description: &'static str,
}

/// Each strategy with each task it can be measured on.
pub fn contestants() -> Vec<Contestant> {
    let weights = |task| {
        [
            StrategySettings::CmaEs(CmaEsSettings::default()),
            StrategySettings::OpenEs(OpenEsSettings::default()),
            StrategySettings::Cosyne(CosyneSettings::default()),
            StrategySettings::Conventional(ConventionalNeSettings::default()),
        ]
        .map(|settings| searching_weights(settings, task))
    };
    Yardstick::ALL.into_iter().flat_map(|task| [neat(task)].into_iter().chain(weights(task))).collect()
}

fn searching_weights(settings: StrategySettings, task: Yardstick) -> Contestant {
    let (topology, description) = net(task);
    Contestant { task, settings, topology, output_range: OutputRange::MinusOneToOne, description }
}

fn neat(task: Yardstick) -> Contestant {
    let (settings, output_range, description) = match task {
        Yardstick::Xor => (NeatSettings::stanley_2002(), OutputRange::ZeroToOne, "preset stanley-2002"),
        _ => (NeatSettings::pole_balancing(), OutputRange::MinusOneToOne, "NeatSettings::pole_balancing"),
    };
    let topology = DenseShape::new(task.inputs(), Vec::new(), 1).into();
    Contestant { task, settings: StrategySettings::Neat(Box::new(settings)), topology, output_range, description }
}

/// The net of those that search weights only.
fn net(task: Yardstick) -> (Topology, &'static str) {
    match task {
        Yardstick::Xor => (DenseShape::new(2, vec![2], 1).into(), "net 2-2-1, tanh"),
        Yardstick::OnePole => (DenseShape::new(4, Vec::new(), 1).into(), "net 4-1, tanh"),
        Yardstick::TwoPoles => (DenseShape::new(6, Vec::new(), 1).into(), "net 6-1, tanh"),
        Yardstick::TwoPolesWithoutVelocities => {
            (recurrent(3, 3).into(), "3 inputs, 3 neurons connected with all, tanh")
        }
    }
}

/// Neurons that are connected with all inputs, all neurons and a bias; the last is the output.
fn recurrent(inputs: usize, neurons: usize) -> GraphShape {
    let neuron = GraphNeuron { activation: Activation::Tanh, bias: true, sources: (0..inputs + neurons).collect() };
    GraphShape { inputs, recurrent: true, neurons: vec![neuron; neurons], outputs: vec![inputs + neurons - 1] }
}
