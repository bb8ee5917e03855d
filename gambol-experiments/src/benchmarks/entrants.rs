use super::BenchmarkTask;
use gambol_runs::config::StrategySettings;
use ne_fixed::{
    ArsSettings, CmaEsSettings, ConventionalNeSettings, CosyneSettings, GaussianMutation, HillClimbingSettings,
    Initialization, MutationChoice, OpenEsSettings, RandomSearchSettings,
};
use ne_neat::NeatSettings;
use ne_net::{Activation, DenseShape, GraphNeuron, GraphShape, Topology};
use tasks::OutputRange;

/// A strategy with the settings and the net it has for a task.
#[derive(Clone, Debug)]
pub struct Entrant {
    /// The task.
    pub task: BenchmarkTask,
    /// The strategy and its settings.
    pub settings: StrategySettings,
    /// The net whose weights are searched; NEAT takes the numbers of inputs and outputs from it.
    pub topology: Topology,
    /// The range of its outputs.
    pub output_range: OutputRange,
    /// Whether the task gives it a constant input, for nets that have no biases of their own.
    pub bias_input: bool,
    /// Settings and net, in words.
    pub description: &'static str,
}

/// Each strategy with each task, some with more than one setting.
pub fn entrants() -> Vec<Entrant> {
    let others = |task| {
        let searches = [cma_es(task), cosyne(task), open_es(task), conventional(task)];
        searches.into_iter().chain([ars(task), hill_climbing(task), random_search(task)])
    };
    let all = |task| neat(task).into_iter().chain(others(task));
    BenchmarkTask::ALL.into_iter().flat_map(all).collect()
}

/// NEAT as the paper has it, and where poles are balanced without velocities also with settings of our own.
fn neat(task: BenchmarkTask) -> Vec<Entrant> {
    let with = |settings, description| Entrant {
        task,
        settings: StrategySettings::new("neat", &settings),
        topology: DenseShape::new(task.inputs(), Vec::new(), 1).into(),
        output_range: OutputRange::ZeroToOne,
        bias_input: false,
        description,
    };
    match task {
        BenchmarkTask::TwoPolesWithoutVelocities | BenchmarkTask::GeneralTwoPoles => vec![
            with(NeatSettings::stanley_2002_double_pole(), "NeatSettings::stanley_2002_double_pole"),
            with(NeatSettings::pole_balancing(), "NeatSettings::pole_balancing"),
        ],
        _ => vec![with(NeatSettings::stanley_2002(), "NeatSettings::stanley_2002")],
    }
}

fn cma_es(task: BenchmarkTask) -> Entrant {
    let settings = match task {
        BenchmarkTask::Xor => CmaEsSettings::default(),
        _ => CmaEsSettings::pole_balancing(),
    };
    on_its_net(task, StrategySettings::new("cma-es", &settings))
}

fn cosyne(task: BenchmarkTask) -> Entrant {
    let settings = match task {
        BenchmarkTask::Xor => CosyneSettings::default(),
        _ => CosyneSettings::pole_balancing(),
    };
    on_its_net(task, StrategySettings::new("cosyne", &settings))
}

fn open_es(task: BenchmarkTask) -> Entrant {
    on_its_net(task, StrategySettings::new("open-es", &OpenEsSettings::default()))
}

fn conventional(task: BenchmarkTask) -> Entrant {
    // The default mutates one gene in twenty, which leaves most children of so small nets as they were.
    let mutation = MutationChoice::Gaussian(GaussianMutation { rate: 0.4, deviation: 1.0 });
    let settings = ConventionalNeSettings { mutation, ..ConventionalNeSettings::default() };
    on_its_net(task, StrategySettings::new("conventional", &settings))
}

fn ars(task: BenchmarkTask) -> Entrant {
    on_its_net(task, StrategySettings::new("ars", &ArsSettings::default()))
}

/// With the mutation of conventional neuroevolution, but on every weight.
fn hill_climbing(task: BenchmarkTask) -> Entrant {
    let settings = HillClimbingSettings { mutation_deviation: 1.0, ..HillClimbingSettings::default() };
    on_its_net(task, StrategySettings::new("hill-climbing", &settings))
}

/// From the distribution with which CoSyNE begins.
fn random_search(task: BenchmarkTask) -> Entrant {
    let initialization = Initialization::Uniform { limit: 10.0 };
    let settings = RandomSearchSettings { initialization, ..RandomSearchSettings::default() };
    on_its_net(task, StrategySettings::new("random-search", &settings))
}

/// A search for the weights of the net the task is given.
fn on_its_net(task: BenchmarkTask, settings: StrategySettings) -> Entrant {
    // The constant input is one more.
    let inputs = task.inputs() + 1;
    let (topology, output_range, description): (Topology, _, _) = match task {
        BenchmarkTask::Xor => (DenseShape::new(2, vec![4], 1).into(), OutputRange::MinusOneToOne, "net 2-4-1, tanh"),
        BenchmarkTask::OnePole | BenchmarkTask::TwoPoles => {
            let description = "one logistic neuron, a constant among its inputs";
            (single_neuron(inputs).into(), OutputRange::ZeroToOne, description)
        }
        BenchmarkTask::TwoPolesWithoutVelocities | BenchmarkTask::GeneralTwoPoles => {
            let description = "two logistic neurons connected with all inputs, each other and themselves";
            (fully_recurrent(inputs, 2).into(), OutputRange::ZeroToOne, description)
        }
    };
    Entrant { task, settings, topology, output_range, bias_input: task != BenchmarkTask::Xor, description }
}

/// One neuron without a bias, connected with all inputs.
fn single_neuron(inputs: usize) -> GraphShape {
    let neuron = GraphNeuron { activation: Activation::Logistic, bias: false, sources: (0..inputs).collect() };
    GraphShape { inputs, recurrent: false, neurons: vec![neuron], outputs: vec![inputs] }
}

/// Neurons each connected with all of them and with all inputs; the last is the output.
fn fully_recurrent(inputs: usize, neurons: usize) -> GraphShape {
    let neuron =
        GraphNeuron { activation: Activation::Logistic, bias: false, sources: (0..inputs + neurons).collect() };
    GraphShape { inputs, recurrent: true, neurons: vec![neuron; neurons], outputs: vec![inputs + neurons - 1] }
}
