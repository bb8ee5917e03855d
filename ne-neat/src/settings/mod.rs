//! What NEAT can be told.

mod presets;

use crate::{
    BiasKind, Crossover, Layout, MutationSettings, Noise, ReproductionSettings, SpeciationSettings, StartTopology,
    noise::NewWeights,
};
use ne_core::SettingError;
use ne_net::{Activation, GraphShape};
use serde::{Deserialize, Serialize};

/// The settings of [`Neat`](crate::Neat).
///
/// Presets: [`default`](Self::default) for bodies, [`stanley_2002`](Self::stanley_2002) for the paper's XOR,
/// [`stanley_2002_double_pole`](Self::stanley_2002_double_pole) for its hardest task, and
/// [`pole_balancing`](Self::pole_balancing). A file states every field, since what a missing one means would depend on
/// the preset.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct NeatSettings {
    /// Number of individuals, from 2 to 1,000,000; it never changes.
    #[cfg_attr(feature = "schema", schemars(range(min = 2, max = 1_000_000)))]
    pub population: usize,
    /// Whether connections may form cycles, so that nets have a memory.
    pub recurrent: bool,
    /// How neurons get a bias.
    pub bias: BiasKind,
    /// The activation of outputs.
    pub output_activation: Activation,
    /// The activations of hidden neurons, at least one and none twice: a new neuron gets any of them.
    #[cfg_attr(feature = "schema", schemars(length(min = 1), extend("uniqueItems" = true)))]
    pub hidden_activations: Vec<Activation>,
    /// What the first nets look like.
    pub start: StartTopology,
    /// How weights are drawn in the first generation, for added connections, and when they are replaced. None is greater than
    /// `mutation.weights.limit`.
    pub new_weights: Noise,
    /// Species and fitness sharing.
    pub speciation: SpeciationSettings,
    /// Which individuals breed.
    pub reproduction: ReproductionSettings,
    /// How two parents' genes become a child's.
    pub crossover: Crossover,
    /// How a child's genes change.
    pub mutation: MutationSettings,
    /// Generations without a better best fitness after which the search begins anew, at least 1; none for never, as in the
    /// paper, and in a file that does not state it.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub restart: Option<u64>,
}

impl NeatSettings {
    /// The most connections that the first generation has altogether.
    pub const MOST_CONNECTIONS: usize = 1 << 26;

    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range: `mutation.add_node = 2: must be from 0 to 1`.
    pub fn validate(&self) -> Result<(), SettingError> {
        if !(2..=1_000_000).contains(&self.population) {
            return Err(SettingError::new("population", self.population, "from 2 to 1000000"));
        }
        if self.hidden_activations.is_empty() {
            return Err(SettingError::new("hidden_activations", "none", "at least one"));
        }
        for (index, activation) in self.hidden_activations.iter().enumerate() {
            if self.hidden_activations[..index].contains(activation) {
                return Err(SettingError::new(format!("hidden_activations[{index}]"), activation, "named once"));
            }
        }
        self.start.validate().map_err(|error| error.within("start"))?;
        self.new_weights.validate().map_err(|error| error.within("new_weights"))?;
        self.speciation.validate(self.population).map_err(|error| error.within("speciation"))?;
        self.reproduction.validate().map_err(|error| error.within("reproduction"))?;
        self.crossover.validate().map_err(|error| error.within("crossover"))?;
        self.mutation.validate().map_err(|error| error.within("mutation"))?;
        if self.restart == Some(0) {
            return Err(SettingError::new("restart", 0, "at least 1"));
        }
        Ok(())
    }

    /// How new weights are drawn.
    pub(crate) fn new_weights(&self) -> NewWeights {
        NewWeights { noise: self.new_weights, limit: self.mutation.weights.limit as f32 }
    }

    /// What the genomes of a run with these settings have in common; checks the settings too.
    pub(crate) fn layout(&self, inputs: usize, outputs: usize) -> Result<Layout, SettingError> {
        self.validate()?;
        let layout = Layout { inputs, outputs, bias: self.bias, recurrent: self.recurrent };
        layout.validate()?;
        let (connections, most) = (self.start.numbered_connections(&layout), GraphShape::MAX_WEIGHTS / 2);
        if connections > most {
            let found = format!("{connections} connections of {inputs} inputs and {outputs} outputs");
            return Err(SettingError::new("start", found, format!("at most {most} connections")));
        }
        let most = Self::MOST_CONNECTIONS / connections.max(1);
        if self.population > most {
            let allowed = format!("at most {most}, since each starts with up to {connections} connections");
            return Err(SettingError::new("population", self.population, allowed));
        }
        Ok(layout)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{PopulationStagnation, TargetSpecies};

    #[test]
    fn presets_are_valid_and_survive_serialisation() {
        for settings in [
            NeatSettings::default(),
            NeatSettings::stanley_2002(),
            NeatSettings::stanley_2002_double_pole(),
            NeatSettings::pole_balancing(),
        ] {
            assert_eq!(settings.validate(), Ok(()));
            let text = serde_json::to_string(&settings).expect("serialises");
            let loaded: NeatSettings = serde_json::from_str(&text).expect("deserialises");
            assert_eq!(loaded, settings);
        }
    }

    #[test]
    fn errors_name_the_field() {
        type Change = fn(&mut NeatSettings);
        let target = |species, step| Some(TargetSpecies { species, step });
        let changes: [(Change, &str); 19] = [
            (|s| s.population = 1, "population = 1: must be from 2 to 1000000"),
            (|s| s.hidden_activations.clear(), "hidden_activations = none: must be at least one"),
            (
                |s| s.hidden_activations = vec![Activation::Sine, Activation::Sine],
                "hidden_activations[1] = sine: must be named once",
            ),
            (
                |s| s.start = StartTopology::PartlyConnected { share: 2.0 },
                "start.partly-connected.share = 2: must be from 0 to 1",
            ),
            (
                |s| s.start = StartTopology::HiddenLayer { neurons: 0 },
                "start.hidden-layer.neurons = 0: must be from 1 to 4096",
            ),
            (
                |s| s.new_weights = Noise::Uniform { limit: f64::INFINITY },
                "new_weights.uniform.limit = inf: must be from 0 to 1000",
            ),
            (
                |s| s.speciation.compatibility.excess = -1.0,
                "speciation.compatibility.excess = -1: must be from 0 to 1000",
            ),
            (|s| s.speciation.threshold = 0.0, "speciation.threshold = 0: must be from 0.001 to 1000"),
            (|s| s.speciation.stagnation = 0, "speciation.stagnation = 0: must be at least 1"),
            (
                |s| s.speciation.protected = 151,
                "speciation.protected = 151: must be at least 1 and at most 150, the population",
            ),
            (
                |s| s.speciation.protected = 0,
                "speciation.protected = 0: must be at least 1 and at most 150, the population",
            ),
            (
                |s| s.speciation.population_stagnation = Some(PopulationStagnation { generations: 0, species: 2 }),
                "speciation.population_stagnation.generations = 0: must be at least 1",
            ),
            (
                |s| s.speciation.population_stagnation = Some(PopulationStagnation { generations: 9, species: 0 }),
                "speciation.population_stagnation.species = 0: must be at least 1",
            ),
            (|s| s.reproduction.survival_share = 0.0, "reproduction.survival_share = 0: must be above 0 and at most 1"),
            (|s| s.reproduction.mutation_only = 1.1, "reproduction.mutation_only = 1.1: must be from 0 to 1"),
            (|s| s.reproduction.interspecies = -0.1, "reproduction.interspecies = -0.1: must be from 0 to 1"),
            (|s| s.crossover.averaging = 1.1, "crossover.averaging = 1.1: must be from 0 to 1"),
            (|s| s.mutation.enable = 1.1, "mutation.enable = 1.1: must be from 0 to 1"),
            (|s| s.restart = Some(0), "restart = 0: must be at least 1"),
        ];
        let check = |settings: &NeatSettings, message: &str| {
            assert_eq!(settings.validate().expect_err("out of range").to_string(), message);
        };
        for (change, message) in changes {
            let mut settings = NeatSettings::stanley_2002();
            change(&mut settings);
            check(&settings, message);
        }
        let mut settings = NeatSettings::stanley_2002();
        for (species, step, message) in [
            (0, 1.0, "speciation.target.species = 0: must be at least 1 and at most 75, half of the population"),
            (76, 1.0, "speciation.target.species = 76: must be at least 1 and at most 75, half of the population"),
            (5, 0.0, "speciation.target.step = 0: must be from 0.001 to 100"),
        ] {
            settings.speciation.target = target(species, step);
            check(&settings, message);
        }
    }
}
