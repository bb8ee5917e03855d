//! Named starting points.

use super::{ControllerSettings, EngineChoice, RecordSettings, RunConfig, StrategySettings, coaching};
use creatures::{Actuation, Creature, Terrain};
use envs_rapier::{PhysicsSettings, Variation, Water};
use ne_core::StopConditions;
use ne_fixed::{CmaEsSettings, ConventionalNeSettings};
use ne_neat::NeatSettings;
use ne_net::Activation;
use tasks::{MovementSpec, Trials};

/// A named starting point of a configuration.
#[derive(Clone, Copy, Debug)]
pub struct Preset {
    /// Its name.
    pub name: &'static str,
    /// One sentence.
    pub description: &'static str,
    strategy: fn() -> StrategySettings,
    activation: Activation,
    variation: fn() -> Variation,
    /// What is added for creature and movement.
    equip: fn(&mut RunConfig),
}

/// All presets; the first is the default.
pub const PRESETS: &[Preset] = &[
    Preset {
        name: "default",
        description: "what we found to work best: CMA-ES, a net a limb, clocks, target angles, and a coach's eye for gaits",
        strategy: || StrategySettings::CmaEs(CmaEsSettings::gaits()),
        activation: Activation::Tanh,
        variation: Variation::light,
        equip: coaching::equip,
    },
    Preset {
        name: "thesis",
        description: "the algorithm of Gegendorfer 2017: roulette, one-point crossover, small uniform mutation, no elite",
        strategy: || StrategySettings::Conventional(ConventionalNeSettings::thesis()),
        activation: Activation::RationalTanh,
        variation: Variation::default,
        equip: |_| {},
    },
    Preset {
        name: "stanley-2002",
        description: "NEAT with the settings of Stanley & Miikkulainen 2002; outputs stretched to ±1, as motors want them",
        strategy: || {
            let output_activation = Activation::SteepTanh;
            StrategySettings::Neat(Box::new(NeatSettings { output_activation, ..NeatSettings::stanley_2002() }))
        },
        activation: Activation::Tanh,
        variation: Variation::default,
        equip: |_| {},
    },
];

/// Variations a user can ask for by name.
pub const VARIATIONS: [&str; 7] = ["none", "near", "pushed", "light", "bumpy", "strong", "physics"];

/// The variation of this name.
pub fn variation(name: &str) -> Option<Variation> {
    match name {
        "none" => Some(Variation::default()),
        "light" => Some(Variation::light()),
        "near" => Some(Variation::near()),
        "pushed" => Some(Variation::pushed()),
        "physics" => Some(Variation::physics()),
        "bumpy" => Some(Variation::bumpy()),
        "strong" => Some(Variation::strong()),
        _ => None,
    }
}

/// The preset of this name.
pub fn preset(name: &str) -> Option<&'static Preset> {
    PRESETS.iter().find(|preset| preset.name == name)
}

impl Preset {
    /// The configuration this preset gives for a creature and a movement, with seed 1 and 300 generations. Who is to swim is
    /// put into water.
    pub fn config(&self, creature: Creature, movement: &str) -> RunConfig {
        let mut config = RunConfig {
            preset: self.name.into(),
            seed: 1,
            movement: MovementSpec::new(movement),
            trials: Trials::default(),
            variation: (self.variation)(),
            rehearsal: None,
            heats: Vec::new(),
            engine: EngineChoice::Lanes,
            strategy: (self.strategy)(),
            controller: ControllerSettings {
                hidden: vec![10],
                hidden_activation: self.activation,
                output_activation: self.activation,
                hidden_scale: 3.0,
                input_range: creatures::DEFAULT_INPUT_RANGE,
                actuation: Actuation::Speed,
                limbs: None,
            },
            topology: None,
            stop: StopConditions { generations: Some(300), ..StopConditions::default() },
            physics: PhysicsSettings::default(),
            terrain: Terrain::default(),
            record: RecordSettings {
                checkpoint_every: 10,
                populations_at: vec![1, 3, 7, 20, 50, 100, 200, 300, 600, 1000, 3000, 10_000],
                finalists: super::default_finalists(),
            },
            stages: Vec::new(),
            origin: None,
            sensors: None,
            creature,
            companions: Vec::new(),
        };
        if movement == "swimming" {
            // Only rapier has water.
            config.physics.water = Some(Water::default());
            config.engine = EngineChoice::Rapier;
        }
        (self.equip)(&mut config);
        config
    }
}
