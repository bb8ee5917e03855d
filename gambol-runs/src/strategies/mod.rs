//! The strategies that a configuration can name, each behind the same object-safe face.
//!
//! A [`NetStrategy`] is a [`Strategy`] whose genomes are neural nets, with what a run needs besides: settings, and ways to
//! begin from what another search has learned. [`StrategyCatalogue::add`] registers one, Gambol's own and yours alike; from
//! then on it is an [`AnyStrategy`], and nothing above this module knows which.

mod any;
mod built_in;
mod catalogue;
pub mod conformance;

pub use any::{AnyGenome, AnyStrategy};
pub use catalogue::{StrategyCatalogue, StrategyEntry, StrategyError};

use ne_core::{Genome, SettingError, Strategy};
use ne_fixed::WeightVector;
use ne_net::{Network, Topology, TopologyMap};
use serde::{Serialize, de::DeserializeOwned};

/// A strategy over neural nets that a configuration can name, with its settings.
///
/// An implementor owes, besides what [`Strategy`] asks for:
/// - [`NAME`](Self::NAME) is what [`name`](Strategy::name) returns;
/// - [`build`](Self::build) checks every setting; what it accepts runs;
/// - `Settings` are plain data that derive `Deserialize` with `#[serde(deny_unknown_fields)]`, so that a misspelt one is an
///   error. A field named `population` is what `--population` sets.
///
/// Check yours with [`check_net_strategy`](conformance::check_net_strategy).
pub trait NetStrategy:
    Strategy<Genome: Genome<Phenotype: Into<Network>> + DeserializeOwned> + DeserializeOwned + 'static
{
    /// The name users choose it by: lower case, hyphens.
    const NAME: &'static str;

    /// Whether it finds the topology of its nets itself, and so takes from a given one nothing but the numbers of inputs and
    /// outputs.
    const FINDS_TOPOLOGY: bool = false;

    /// Whether it finds, where limbs share a net, the net that is copied: it is given a [copied](Topology::Copied) topology there.
    const FINDS_COPIED: bool = false;

    /// What a configuration says of it; the default is what it has if the configuration says nothing.
    type Settings: Clone + Default + PartialEq + Serialize + DeserializeOwned + 'static;

    /// The strategy for nets of this topology.
    ///
    /// # Errors
    /// If a setting is out of range; the error names the field, seen from the settings.
    fn build(settings: &Self::Settings, topology: &Topology) -> Result<Self, SettingError>;

    /// The settings it was built with.
    fn settings(&self) -> &Self::Settings;

    /// A search that begins at one net, whose weights these are.
    ///
    /// # Errors
    /// If a setting is out of range, the weights are not the topology's, or the strategy cannot begin at a net, as by default.
    fn begin_at(settings: &Self::Settings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        let _ = (settings, topology, weights);
        Err(SettingError::new("strategy", Self::NAME, "one that can begin at a given net"))
    }

    /// A search that begins about weights that are but a guess; by default as at those of a good net.
    ///
    /// # Errors
    /// As of [`begin_at`](Self::begin_at).
    fn begin_about(settings: &Self::Settings, topology: &Topology, guess: &[f32]) -> Result<Self, SettingError> {
        Self::begin_at(settings, topology, guess)
    }

    /// The search that goes on with what this one has learned: with other settings, on another task, with nets that may
    /// have grown. What they do is the same until evolution changes it.
    ///
    /// # Errors
    /// If a setting is out of range, something learned has no place in the new nets that cannot be given up, or the strategy
    /// cannot go on with other nets, as by default.
    fn transfer(self, settings: &Self::Settings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        let _ = (settings, to);
        Err(SettingError::new("strategy", Self::NAME, "one whose population can go on with other nets"))
    }

    /// Whether its nets are of this topology, as far as it is given: a file may be of another body.
    fn fits(&self, topology: &Topology) -> bool {
        let _ = topology;
        true
    }

    /// Whether it has left what it had found, to look elsewhere: the champion then knows more than the search.
    fn has_begun_anew(&self) -> bool {
        false
    }

    /// Whether it has nothing that could be transferred: it has left what it had found, and found nothing since.
    fn has_nothing_to_transfer(&self) -> bool {
        false
    }

    /// The genome of one net, whose weights these are: the champion of another search is the first candidate of this one by it.
    /// `None`: the strategy has none for it, and begins without that champion.
    fn genome(topology: &Topology, weights: &[f32]) -> Option<Self::Genome>;

    /// The JSON Schema of its settings, which a schema of configurations has in it; `None`, the default: none was written, and
    /// any object will do. Of settings that derive `JsonSchema` it is `Some(generator.subschema_for::<Self::Settings>())`.
    #[cfg(feature = "schema")]
    fn settings_schema(generator: &mut schemars::SchemaGenerator) -> Option<schemars::Schema> {
        let _ = generator;
        None
    }

    /// The net of a genome: the topology and its weights, expressed or as they are searched. Of weight vectors it is
    /// [`weights_of`]; where both are the same, [`expressed_net`].
    fn net(genome: &Self::Genome, expressed: bool) -> (Topology, Vec<f32>);
}

/// What becomes of the nets of a search that goes on.
#[derive(Clone, Copy, Debug)]
pub struct Transfer<'a> {
    /// The new topology; of NEAT only its inputs, outputs and copies count.
    pub topology: &'a Topology,
    /// Which of its weights go on from which of the old topology's.
    pub genes: &'a TopologyMap,
    /// Which inputs of the net that is searched for are which of the old.
    pub inputs: &'a TopologyMap,
    /// Which outputs of the net that is searched for are which of the old.
    pub outputs: &'a TopologyMap,
}

/// The net that a genome is expressed as.
pub fn expressed_net<G: Genome<Phenotype: Into<Network>>>(genome: &G) -> (Topology, Vec<f32>) {
    let network: Network = genome.express().into();
    (network.topology(), network.weights().to_vec())
}

/// The net of a weight vector, expressed or as it is searched: what [`NetStrategy::net`] is of searches for weights.
pub fn weights_of(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
    match expressed {
        true => expressed_net(genome),
        false => (genome.topology().clone(), genome.weights().to_vec()),
    }
}
