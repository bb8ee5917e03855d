//! Named starting points of a configuration.

use crate::{
    config::{ControllerSettings, EngineChoice, RecordSettings, RunConfig, StrategySettings, default_candidates},
    defaults::{self, DefaultsCatalogue},
    suggest,
};
use creatures::{Actuation, Creature, Terrain};
use envs_rapier::{PhysicsSettings, Variation, Water};
use ne_core::StopConditions;
use ne_fixed::{CmaEsSettings, ConventionalNeSettings};
use ne_neat::NeatSettings;
use ne_net::Activation;
use std::{fmt, sync::Arc};
use tasks::{Commands, Medium, MovementCatalogue, MovementSpec, Trials};

/// A named starting point of a configuration.
#[derive(Clone)]
pub struct Preset {
    /// Its name.
    pub name: String,
    /// One sentence.
    pub description: String,
    change: Arc<Change>,
}

type Change = dyn Fn(&mut RunConfig, &DefaultsCatalogue) + Send + Sync;

/// The presets there are; the first is the default. By default those of Gambol.
#[derive(Clone, Debug)]
pub struct PresetCatalogue {
    first: Preset,
    others: Vec<Preset>,
}

fn default() -> Preset {
    let description = "what we found to work best: CMA-ES, a net a limb, clocks, target angles, and rewards for gaits";
    Preset::new("default", description, |config, known| {
        config.strategy = StrategySettings::new("cma-es", &CmaEsSettings::gaits());
        config.variation = Variation::light();
        defaults::apply(config, known);
    })
}

fn thesis() -> Preset {
    let description =
        "the algorithm of Gegendorfer 2017: roulette, one-point crossover, small uniform mutation, no elite";
    Preset::new("thesis", description, |config, _| {
        config.strategy = StrategySettings::new("conventional", &ConventionalNeSettings::thesis());
        config.controller.hidden_activation = Activation::RationalTanh;
        config.controller.output_activation = Activation::RationalTanh;
    })
}

fn stanley_2002() -> Preset {
    let description =
        "NEAT with the settings of Stanley & Miikkulainen 2002; outputs stretched to ±1, as motors want them";
    Preset::new("stanley-2002", description, |config, _| {
        let output_activation = Activation::SteepTanh;
        let settings = NeatSettings { output_activation, ..NeatSettings::stanley_2002() };
        config.strategy = StrategySettings::new("neat", &settings);
    })
}

fn plain() -> Preset {
    let description =
        "for fair comparisons: a dense net of ten hidden neurons, the movement alone as fitness, worlds do not vary";
    // Episodes as long as those that champions of the default preset are judged by, so that the scores of both compare.
    Preset::new("plain", description, |config, known| config.movement.steps = defaults::steps(config, known))
}

/// All that the default preset has, but for the settings of its strategy.
fn shaped() -> Preset {
    let description = "for fair comparisons: all that the default preset has, but for the settings of its strategy";
    Preset::new("shaped", description, |config, known| {
        config.variation = Variation::light();
        defaults::apply(config, known);
        // Every strategy has its own defaults, the first mutation strength too.
        config.strategy = StrategySettings::new("cma-es", &CmaEsSettings::default());
    })
}

impl Default for PresetCatalogue {
    fn default() -> Self {
        Self { first: default(), others: vec![thesis(), stanley_2002(), plain(), shaped()] }
    }
}

impl fmt::Debug for Preset {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Preset").field("name", &self.name).finish_non_exhaustive()
    }
}

impl PresetCatalogue {
    /// Adds a preset, or replaces the one of the same name.
    pub fn add(&mut self, preset: Preset) -> &mut Self {
        let found = std::iter::once(&mut self.first).chain(&mut self.others).find(|found| found.name == preset.name);
        match found {
            Some(found) => *found = preset,
            None => self.others.push(preset),
        }
        self
    }

    /// The default.
    pub fn first(&self) -> &Preset {
        &self.first
    }

    /// All of them, the default first.
    pub fn entries(&self) -> impl Iterator<Item = &Preset> + Clone {
        std::iter::once(&self.first).chain(&self.others)
    }

    /// The preset of this name.
    ///
    /// # Errors
    /// Says which there are, and the nearest name.
    pub fn find(&self, name: &str) -> Result<&Preset, String> {
        let known = || self.entries().map(|preset| &*preset.name).collect::<Vec<_>>();
        self.entries().find(|preset| preset.name == name).ok_or_else(|| suggest::unknown("preset", name, &known()))
    }
}

impl Preset {
    /// A preset of this name, described in one sentence. `change` is given a bare configuration for a creature and a movement: one with the
    /// default strategy, a net with ten hidden neurons, motors that are given speeds, and nothing that varies.
    pub fn new(
        name: &str,
        description: &str,
        change: impl Fn(&mut RunConfig, &DefaultsCatalogue) + Send + Sync + 'static,
    ) -> Self {
        Self { name: name.into(), description: description.into(), change: Arc::new(change) }
    }

    /// The configuration this preset gives for a creature and a movement, with seed 1 and 300 generations. A creature that
    /// is to swim is put into water.
    pub fn config(
        &self,
        creature: Creature,
        movement: &str,
        movements: &MovementCatalogue,
        known: &DefaultsCatalogue,
    ) -> RunConfig {
        let mut config = RunConfig { preset: self.name.clone(), ..bare(creature, movement) };
        if movements.find(movement).is_some_and(|entry| entry.medium == Medium::Water) {
            // Only rapier has water.
            config.physics.water = Some(Water::default());
            config.engine = EngineChoice::Rapier;
        }
        if movements.rules(movement).is_some_and(|rules| rules.needs_commands()) {
            config.commands = Some(Commands::default());
        }
        (self.change)(&mut config, known);
        config
    }
}

/// What presets change.
fn bare(creature: Creature, movement: &str) -> RunConfig {
    RunConfig {
        preset: String::new(),
        seed: 1,
        movement: MovementSpec::new(movement),
        trials: Trials::default(),
        variation: Variation::default(),
        training_steps: None,
        rungs: Vec::new(),
        engine: EngineChoice::Lanes,
        strategy: StrategySettings::new("cma-es", &CmaEsSettings::default()),
        controller: ControllerSettings {
            hidden: vec![10],
            hidden_activation: Activation::Tanh,
            output_activation: Activation::Tanh,
            hidden_scale: 3.0,
            input_range: creatures::DEFAULT_INPUT_RANGE,
            actuation: Actuation::Speed,
            modular: None,
        },
        topology: None,
        stop: StopConditions { generations: Some(300), ..StopConditions::default() },
        physics: PhysicsSettings::default(),
        terrain: Terrain::default(),
        commands: None,
        record: RecordSettings {
            checkpoint_every: 10,
            populations_at: vec![1, 3, 7, 20, 50, 100, 200, 300, 600, 1000, 3000, 10_000],
            candidates: default_candidates(),
        },
        stages: Vec::new(),
        origin: None,
        sensors: None,
        creature,
        further_bodies: Vec::new(),
    }
}
