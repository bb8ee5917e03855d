//! The strategies that a configuration can name, behind one door: whoever adds one adds an `impl` and a line to `visit`.

use crate::config::StrategySettings;
use ne_core::{Genome, SettingError, Strategy};
use ne_fixed::{
    CmaEs, CmaEsSettings, ConventionalNe, ConventionalNeSettings, Cosyne, CosyneSettings, Mutation, Nsga2,
    Nsga2Settings, OpenEs, OpenEsSettings, WeightVector,
};
use ne_neat::{Neat, NeatGenome, NeatSettings};
use ne_net::{Growth, Network, Topology};

/// A strategy that can be built from the settings in a configuration.
pub trait Search: Strategy<Genome: Genome<Phenotype: Into<Network>>> {
    /// What a configuration says of it.
    type Settings: Clone + PartialEq;

    /// The strategy for nets of this topology. NEAT, which finds its own, takes the numbers of inputs and outputs from it.
    ///
    /// # Errors
    /// If a setting is out of range; the error names the field, seen from the strategy.
    fn build(settings: &Self::Settings, topology: &Topology) -> Result<Self, SettingError>;

    /// The settings it was built with.
    fn settings(&self) -> &Self::Settings;

    /// The search that goes on with what this one has learned: with other settings, on another task, with nets that may
    /// have grown. What they do is the same until evolution changes it.
    ///
    /// # Errors
    /// If a setting is out of range, or something learned has no place in the new nets that cannot be given up.
    fn grown(self, settings: &Self::Settings, passage: &Passage<'_>) -> Result<Self, SettingError>;

    /// A search that begins at one net, whose weights these are.
    ///
    /// # Errors
    /// If a setting is out of range, the weights are not the topology's, or the strategy cannot begin at a net.
    fn begin_at(settings: &Self::Settings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError>;

    /// Whether it has left what it had found, to look elsewhere: the champion then knows more than the search.
    fn has_begun_anew(&self) -> bool {
        false
    }

    /// Whether it has nothing that could go on: it has left what it had found, and found nothing since.
    fn has_nothing_to_carry(&self) -> bool {
        false
    }

    /// The net of a genome: the topology and its weights, expressed or as they are searched.
    fn net(genome: &Self::Genome, expressed: bool) -> (Topology, Vec<f32>);
}

/// What becomes of the nets of a search that goes on.
#[derive(Clone, Copy, Debug)]
pub struct Passage<'a> {
    /// The new topology; of NEAT only its inputs and outputs count.
    pub topology: &'a Topology,
    /// Which of its weights go on from which of the old topology's.
    pub genes: &'a Growth,
    /// Which of the new inputs are which of the old.
    pub inputs: &'a Growth,
    /// Which of the new outputs are which of the old.
    pub outputs: &'a Growth,
}

/// The net of a weight vector.
fn weights_of(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
    match expressed {
        true => expressed_net(genome),
        false => (genome.topology().clone(), genome.weights().to_vec()),
    }
}

fn expressed_net<G: Genome<Phenotype: Into<Network>>>(genome: &G) -> (Topology, Vec<f32>) {
    let network: Network = genome.express().into();
    (network.topology(), network.weights().to_vec())
}

fn weights_error(error: impl std::fmt::Display) -> SettingError {
    SettingError::new("weights", error, "weights of the net")
}

/// Something to be done with a strategy, whichever it is.
pub trait SearchVisitor {
    /// What comes of it.
    type Output;

    /// Does it, with the strategy that these settings are for.
    fn visit<S: Search>(self, settings: &S::Settings) -> Self::Output;

    /// What comes of it for a strategy of another program.
    fn foreign(self, name: &str) -> Self::Output;
}

impl StrategySettings {
    /// Shows the visitor the strategy these are the settings of.
    pub fn visit<V: SearchVisitor>(&self, visitor: V) -> V::Output {
        match self {
            Self::Conventional(settings) => visitor.visit::<ConventionalNe>(settings),
            Self::Neat(settings) => visitor.visit::<Neat>(settings),
            Self::CmaEs(settings) => visitor.visit::<CmaEs>(settings),
            Self::OpenEs(settings) => visitor.visit::<OpenEs>(settings),
            Self::Cosyne(settings) => visitor.visit::<Cosyne>(settings),
            Self::Nsga2(settings) => visitor.visit::<Nsga2>(settings),
            Self::Custom(name) => visitor.foreign(name),
        }
    }

    /// Checks the settings, for nets of this topology.
    ///
    /// # Errors
    /// Names the field and its range: `strategy.conventional.elites = 50: must be below 50`.
    pub fn validate(&self, topology: &Topology) -> Result<(), SettingError> {
        let built = self.visit(Build { topology });
        built.map_err(|error| error.within(self.name()).within("strategy"))
    }
}

/// Builds a strategy and throws it away.
struct Build<'a> {
    topology: &'a Topology,
}

impl SearchVisitor for Build<'_> {
    type Output = Result<(), SettingError>;

    fn visit<S: Search>(self, settings: &S::Settings) -> Self::Output {
        S::build(settings, self.topology).map(drop)
    }

    fn foreign(self, _name: &str) -> Self::Output {
        Ok(())
    }
}

impl Search for ConventionalNe {
    type Settings = ConventionalNeSettings;

    fn build(settings: &ConventionalNeSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &ConventionalNeSettings {
        self.settings()
    }

    fn grown(self, settings: &ConventionalNeSettings, passage: &Passage<'_>) -> Result<Self, SettingError> {
        Self::grown(self, settings.clone(), passage.topology.clone(), passage.genes)
    }

    fn begin_at(settings: &ConventionalNeSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        let champion = WeightVector::new(topology.clone(), weights.to_vec(), settings.mutation.initial_deviation());
        Self::build(settings, topology)?.with_start(vec![champion.map_err(weights_error)?])
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl Search for Neat {
    type Settings = NeatSettings;

    fn build(settings: &NeatSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.inputs(), topology.outputs())
    }

    fn settings(&self) -> &NeatSettings {
        self.settings()
    }

    fn grown(self, settings: &NeatSettings, passage: &Passage<'_>) -> Result<Self, SettingError> {
        Self::grown(self, settings.clone(), passage.inputs, passage.outputs)
    }

    fn begin_at(_: &NeatSettings, _: &Topology, _: &[f32]) -> Result<Self, SettingError> {
        Err(SettingError::new("strategy", "neat", "one that searches the weights of a given net"))
    }

    fn net(genome: &NeatGenome, _expressed: bool) -> (Topology, Vec<f32>) {
        expressed_net(genome)
    }
}

impl Search for CmaEs {
    type Settings = CmaEsSettings;

    fn build(settings: &CmaEsSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &CmaEsSettings {
        self.settings()
    }

    fn grown(self, settings: &CmaEsSettings, passage: &Passage<'_>) -> Result<Self, SettingError> {
        Self::grown(self, settings.clone(), passage.topology.clone(), passage.genes)
    }

    fn begin_at(settings: &CmaEsSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_mean(weights).map_err(weights_error)
    }

    fn has_begun_anew(&self) -> bool {
        self.has_begun_anew()
    }

    fn has_nothing_to_carry(&self) -> bool {
        self.has_begun_anew() && self.mean().is_none()
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl Search for OpenEs {
    type Settings = OpenEsSettings;

    fn build(settings: &OpenEsSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &OpenEsSettings {
        self.settings()
    }

    fn grown(self, settings: &OpenEsSettings, passage: &Passage<'_>) -> Result<Self, SettingError> {
        Self::grown(self, settings.clone(), passage.topology.clone(), passage.genes)
    }

    fn begin_at(settings: &OpenEsSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_centre(weights).map_err(weights_error)
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl Search for Cosyne {
    type Settings = CosyneSettings;

    fn build(settings: &CosyneSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &CosyneSettings {
        self.settings()
    }

    fn grown(self, settings: &CosyneSettings, passage: &Passage<'_>) -> Result<Self, SettingError> {
        Self::grown(self, settings.clone(), passage.topology.clone(), passage.genes)
    }

    fn begin_at(settings: &CosyneSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_start(&[weights.to_vec()])
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl Search for Nsga2 {
    type Settings = Nsga2Settings;

    fn build(settings: &Nsga2Settings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &Nsga2Settings {
        self.settings()
    }

    fn grown(self, settings: &Nsga2Settings, passage: &Passage<'_>) -> Result<Self, SettingError> {
        Self::grown(self, settings.clone(), passage.topology.clone(), passage.genes)
    }

    fn begin_at(settings: &Nsga2Settings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        let champion = WeightVector::new(topology.clone(), weights.to_vec(), settings.mutation.initial_deviation());
        Self::build(settings, topology)?.with_start(vec![champion.map_err(weights_error)?])
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}
