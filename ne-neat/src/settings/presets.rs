use super::NeatSettings;
use crate::{
    BiasKind, Compatibility, Crossover, FitnessBaseline, MutationSettings, Noise, PopulationStagnation,
    ReproductionSettings, SpeciationSettings, SplitChoice, StartTopology, TargetSpecies, WeightMutation,
};
use ne_net::Activation;

impl NeatSettings {
    /// The settings of the paper, as it used them for XOR: population 150, feed-forward nets with a bias input.
    pub fn stanley_2002() -> Self {
        Self {
            population: 150,
            recurrent: false,
            bias: BiasKind::InputNode,
            output_activation: Activation::SteepLogistic,
            hidden_activations: vec![Activation::SteepLogistic],
            start: StartTopology::FullyConnected,
            new_weights: Noise::Uniform { limit: 3.0 },
            speciation: SpeciationSettings {
                compatibility: Compatibility { excess: 1.0, disjoint: 1.0, weights: 0.4, small_genome: 20 },
                threshold: 3.0,
                target: None,
                baseline: FitnessBaseline::Zero,
                stagnation: 15,
                protected: 1,
                population_stagnation: Some(PopulationStagnation { generations: 20, species: 2 }),
            },
            reproduction: ReproductionSettings {
                survival_share: 0.2,
                champion_above: 5,
                mutation_only: 0.25,
                interspecies: 0.001,
            },
            crossover: Crossover { averaging: 0.0, stays_disabled: 0.75 },
            mutation: MutationSettings {
                weights: WeightMutation {
                    rate: 0.8,
                    share: 1.0,
                    replaced: 0.1,
                    perturbation: Noise::Uniform { limit: 2.5 },
                    limit: 8.0,
                },
                enable: 0.0,
                disable: 0.0,
                delete_connection: 0.0,
                delete_node: 0.0,
                activation: 0.0,
                add_connection: 0.05,
                add_node: 0.03,
                split: SplitChoice::Older { probability: 0.7, below: 15 },
            },
        }
    }

    /// The settings of the paper for two poles without velocities: population 1000, recurrent nets.
    pub fn stanley_2002_double_pole() -> Self {
        let mut settings = Self { population: 1000, recurrent: true, ..Self::stanley_2002() };
        settings.speciation.compatibility.weights = 3.0;
        settings.speciation.threshold = 4.0;
        settings.mutation.add_connection = 0.3;
        settings
    }

    /// Settings for balancing poles.
    pub fn pole_balancing() -> Self {
        Self { recurrent: true, ..Self::default() }
    }
}

/// The project's own.
impl Default for NeatSettings {
    fn default() -> Self {
        let mut settings = Self {
            bias: BiasKind::PerNeuron,
            output_activation: Activation::Tanh,
            hidden_activations: vec![Activation::Tanh],
            ..Self::stanley_2002()
        };
        settings.speciation.target = Some(TargetSpecies { species: 10, step: 0.1 });
        settings.speciation.baseline = FitnessBaseline::Worst;
        settings
    }
}
