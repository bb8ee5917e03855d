//! The strategies Gambol brings along, registered as any other.

use super::{NetStrategy, StrategyCatalogue, Transfer, expressed_net};
use ne_core::SettingError;
use ne_fixed::{
    Ars, ArsSettings, CmaEs, CmaEsSettings, ConventionalNe, ConventionalNeSettings, Cosyne, CosyneSettings,
    HillClimbing, HillClimbingSettings, Mutation, Nsga2, Nsga2Settings, OpenEs, OpenEsSettings, RandomSearch,
    RandomSearchSettings, WeightVector,
};
use ne_neat::{Neat, NeatSettings};
use ne_net::Topology;

impl Default for StrategyCatalogue {
    fn default() -> Self {
        let mut catalogue = Self::empty();
        catalogue
            .add::<ConventionalNe>("conventional neuroevolution: a genetic algorithm over the weights of a fixed net")
            .alias("ga")
            .add::<Neat>(
                "NeuroEvolution of Augmenting Topologies: the net's connections and neurons evolve with its weights",
            )
            .add::<CmaEs>("covariance matrix adaptation: a normal distribution of weights that learns which way is up")
            .add::<OpenEs>("OpenAI's evolution strategy: gradient steps estimated from mirrored perturbations")
            .add::<Cosyne>("cooperative synapse neuroevolution: the weights of each place in the net coevolve")
            .add::<Nsga2>("NSGA-II: a front of compromises between several objectives (movement.objectives)")
            .add::<Ars>("augmented random search, V1-t: steps along the best of random directions; a baseline")
            .add::<HillClimbing>("hill climbing: one parent and its noisy copies, the best goes on; a baseline")
            .add::<RandomSearch>("random search: every net is drawn anew, nothing is learnt; a baseline");
        catalogue
    }
}

/// The net of a weight vector.
fn weights_of(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
    match expressed {
        true => expressed_net(genome),
        false => (genome.topology().clone(), genome.weights().to_vec()),
    }
}

fn weights_error(error: impl std::fmt::Display) -> SettingError {
    SettingError::new("weights", error, "weights of the net")
}

impl NetStrategy for ConventionalNe {
    const NAME: &'static str = "conventional";

    type Settings = ConventionalNeSettings;

    fn build(settings: &ConventionalNeSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &ConventionalNeSettings {
        self.settings()
    }

    fn transfer(self, settings: &ConventionalNeSettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::remapped(self, settings.clone(), to.topology.clone(), to.genes)
    }

    fn begin_at(settings: &ConventionalNeSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        let champion = WeightVector::new(topology.clone(), weights.to_vec(), settings.mutation.initial_deviation());
        Self::build(settings, topology)?.with_start(vec![champion.map_err(weights_error)?])
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl NetStrategy for Neat {
    const NAME: &'static str = "neat";
    const FINDS_TOPOLOGY: bool = true;

    type Settings = NeatSettings;

    fn build(settings: &NeatSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.inputs(), topology.outputs())
    }

    fn settings(&self) -> &NeatSettings {
        self.settings()
    }

    fn transfer(self, settings: &NeatSettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::remapped(self, settings.clone(), to.inputs, to.outputs)
    }

    fn begin_at(_: &NeatSettings, _: &Topology, _: &[f32]) -> Result<Self, SettingError> {
        Err(SettingError::new("strategy", "neat", "one that searches the weights of a given net"))
    }
}

impl NetStrategy for CmaEs {
    const NAME: &'static str = "cma-es";

    type Settings = CmaEsSettings;

    fn build(settings: &CmaEsSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &CmaEsSettings {
        self.settings()
    }

    fn transfer(self, settings: &CmaEsSettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::remapped(self, settings.clone(), to.topology.clone(), to.genes)
    }

    fn begin_at(settings: &CmaEsSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_mean(weights).map_err(weights_error)
    }

    fn has_begun_anew(&self) -> bool {
        self.has_begun_anew()
    }

    fn has_nothing_to_transfer(&self) -> bool {
        self.has_begun_anew() && self.mean().is_none()
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl NetStrategy for OpenEs {
    const NAME: &'static str = "open-es";

    type Settings = OpenEsSettings;

    fn build(settings: &OpenEsSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &OpenEsSettings {
        self.settings()
    }

    fn transfer(self, settings: &OpenEsSettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::remapped(self, settings.clone(), to.topology.clone(), to.genes)
    }

    fn begin_at(settings: &OpenEsSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_centre(weights).map_err(weights_error)
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl NetStrategy for Cosyne {
    const NAME: &'static str = "cosyne";

    type Settings = CosyneSettings;

    fn build(settings: &CosyneSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &CosyneSettings {
        self.settings()
    }

    fn transfer(self, settings: &CosyneSettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::remapped(self, settings.clone(), to.topology.clone(), to.genes)
    }

    fn begin_at(settings: &CosyneSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_start(&[weights.to_vec()])
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl NetStrategy for Nsga2 {
    const NAME: &'static str = "nsga2";

    type Settings = Nsga2Settings;

    fn build(settings: &Nsga2Settings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &Nsga2Settings {
        self.settings()
    }

    fn transfer(self, settings: &Nsga2Settings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::remapped(self, settings.clone(), to.topology.clone(), to.genes)
    }

    fn begin_at(settings: &Nsga2Settings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        let champion = WeightVector::new(topology.clone(), weights.to_vec(), settings.mutation.initial_deviation());
        Self::build(settings, topology)?.with_start(vec![champion.map_err(weights_error)?])
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl NetStrategy for Ars {
    const NAME: &'static str = "ars";

    type Settings = ArsSettings;

    fn build(settings: &ArsSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &ArsSettings {
        self.settings()
    }

    fn transfer(self, settings: &ArsSettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::remapped(self, settings.clone(), to.topology.clone(), to.genes)
    }

    fn begin_at(settings: &ArsSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_centre(weights).map_err(weights_error)
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

impl NetStrategy for HillClimbing {
    const NAME: &'static str = "hill-climbing";

    type Settings = HillClimbingSettings;

    fn build(settings: &HillClimbingSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &HillClimbingSettings {
        self.settings()
    }

    fn transfer(self, settings: &HillClimbingSettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        Self::remapped(self, settings.clone(), to.topology.clone(), to.genes)
    }

    fn begin_at(settings: &HillClimbingSettings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_parent(weights)
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}

/// It learns nothing, so that it can neither begin at a net nor go on with what it knows.
impl NetStrategy for RandomSearch {
    const NAME: &'static str = "random-search";

    type Settings = RandomSearchSettings;

    fn build(settings: &RandomSearchSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &RandomSearchSettings {
        self.settings()
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }
}
