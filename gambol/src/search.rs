//! The strategies that a configuration can name, behind one door: whoever adds one adds an `impl` and a line to `visit`.

use crate::config::StrategySettings;
use ne_core::{Genome, SettingError, Strategy};
use ne_fixed::{
    CmaEs, CmaEsSettings, ConventionalNe, ConventionalNeSettings, Cosyne, CosyneSettings, OpenEs, OpenEsSettings,
};
use ne_neat::{Neat, NeatSettings};
use ne_net::{Network, Topology};

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
}

impl Search for Neat {
    type Settings = NeatSettings;

    fn build(settings: &NeatSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.inputs(), topology.outputs())
    }

    fn settings(&self) -> &NeatSettings {
        self.settings()
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
}

impl Search for OpenEs {
    type Settings = OpenEsSettings;

    fn build(settings: &OpenEsSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &OpenEsSettings {
        self.settings()
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
}
