//! What NEAT can be told.

mod presets;

use crate::{
    BiasKind, Crossover, Layout, MutationSettings, Noise, ReproductionSettings, SpeciationSettings, StartTopology,
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
#[serde(deny_unknown_fields)]
pub struct NeatSettings {
    /// Number of individuals, from 2 to 1,000,000; it never changes.
    pub population: usize,
    /// Whether connections may form cycles, so that nets have a memory.
    pub recurrent: bool,
    /// How neurons get a bias.
    pub bias: BiasKind,
    /// The activation of outputs.
    pub output_activation: Activation,
    /// The activations of hidden neurons, at least one and none twice: a new neuron gets any of them.
    pub hidden_activations: Vec<Activation>,
    /// What the first nets look like.
    pub start: StartTopology,
    /// How weights are drawn in the first generation, for added connections, and when they are replaced.
    pub new_weights: Noise,
    /// Species and fitness sharing.
    pub speciation: SpeciationSettings,
    /// Who breeds.
    pub reproduction: ReproductionSettings,
    /// How two parents' genes become a child's.
    pub crossover: Crossover,
    /// How a child's genes change.
    pub mutation: MutationSettings,
}

impl NeatSettings {
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
        self.mutation.validate().map_err(|error| error.within("mutation"))
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
        Ok(layout)
    }
}
