//! The search a configuration names.

use ne_fixed::{CmaEsSettings, ConventionalNeSettings, CosyneSettings, Nsga2Settings, OpenEsSettings};
use ne_neat::NeatSettings;
use serde::{Deserialize, Serialize};

/// The search, by name, with its settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum StrategySettings {
    /// Conventional neuroevolution: a genetic algorithm over the weights of a fixed topology.
    Conventional(ConventionalNeSettings),
    /// NEAT: topology and weights evolve together.
    Neat(Box<NeatSettings>),
    /// CMA-ES: a normal distribution of weights adapts its shape.
    CmaEs(CmaEsSettings),
    /// OpenAI-ES: a gradient estimated from mirrored perturbations.
    OpenEs(OpenEsSettings),
    /// CoSyNE: the weights of each place in the net form a subpopulation and coevolve.
    Cosyne(CosyneSettings),
    /// NSGA-II: a front of compromises between the movement's objectives.
    Nsga2(Nsga2Settings),
    /// A strategy of another program, by the name it has there. That program trains and resumes
    /// ([`train_with`](crate::training::train_with)); ours reports, replays and verifies.
    Custom(String),
}

/// A strategy a user can ask for by name.
#[derive(Clone, Copy, Debug)]
pub struct StrategyEntry {
    /// Its name in configurations.
    pub name: &'static str,
    /// A shorter name, for the command line.
    pub alias: Option<&'static str>,
    /// One sentence.
    pub description: &'static str,
    /// Its default settings.
    pub settings: fn() -> StrategySettings,
}

/// All strategies of ours.
pub const STRATEGIES: &[StrategyEntry] = &[
    StrategyEntry {
        name: "conventional",
        alias: Some("ga"),
        description: "conventional neuroevolution: a genetic algorithm over the weights of a fixed net",
        settings: || StrategySettings::Conventional(ConventionalNeSettings::default()),
    },
    StrategyEntry {
        name: "neat",
        alias: None,
        description: "NeuroEvolution of Augmenting Topologies: the net's connections and neurons evolve with its weights",
        settings: || StrategySettings::Neat(Box::default()),
    },
    StrategyEntry {
        name: "cma-es",
        alias: None,
        description: "covariance matrix adaptation: a normal distribution of weights that learns which way is up",
        settings: || StrategySettings::CmaEs(CmaEsSettings::default()),
    },
    StrategyEntry {
        name: "open-es",
        alias: None,
        description: "OpenAI's evolution strategy: gradient steps estimated from mirrored perturbations",
        settings: || StrategySettings::OpenEs(OpenEsSettings::default()),
    },
    StrategyEntry {
        name: "cosyne",
        alias: None,
        description: "cooperative synapse neuroevolution: the weights of each place in the net coevolve",
        settings: || StrategySettings::Cosyne(CosyneSettings::default()),
    },
    StrategyEntry {
        name: "nsga2",
        alias: None,
        description: "NSGA-II: a front of compromises between several objectives (movement.objectives)",
        settings: || StrategySettings::Nsga2(Nsga2Settings::default()),
    },
];

/// The strategy of this name or alias.
pub fn strategy(name: &str) -> Option<&'static StrategyEntry> {
    STRATEGIES.iter().find(|entry| entry.name == name || entry.alias == Some(name))
}

impl StrategySettings {
    /// The strategy's name.
    pub fn name(&self) -> &str {
        match self {
            Self::Conventional(_) => "conventional",
            Self::Neat(_) => "neat",
            Self::CmaEs(_) => "cma-es",
            Self::OpenEs(_) => "open-es",
            Self::Cosyne(_) => "cosyne",
            Self::Nsga2(_) => "nsga2",
            Self::Custom(name) => name,
        }
    }

    /// The number of individuals of a generation, if the settings say so.
    pub fn population(&self) -> Option<usize> {
        match self {
            Self::Conventional(settings) => Some(settings.population),
            Self::Neat(settings) => Some(settings.population),
            Self::CmaEs(settings) => settings.population,
            Self::OpenEs(settings) => Some(settings.population),
            Self::Cosyne(settings) => Some(settings.population),
            Self::Nsga2(settings) => Some(settings.population),
            Self::Custom(_) => None,
        }
    }

    /// Sets the number of individuals of a generation.
    pub fn set_population(&mut self, population: usize) {
        match self {
            Self::Conventional(settings) => settings.population = population,
            Self::Neat(settings) => settings.population = population,
            Self::CmaEs(settings) => settings.population = Some(population),
            Self::OpenEs(settings) => settings.population = population,
            Self::Cosyne(settings) => settings.population = population,
            Self::Nsga2(settings) => settings.population = population,
            Self::Custom(_) => {}
        }
    }
}
