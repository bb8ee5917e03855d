use crate::{
    catalogue::{Catalogue, MakeSense},
    config::RunConfig,
    defaults::DefaultsCatalogue,
    presets::{Preset, PresetCatalogue},
    strategies::StrategyCatalogue,
};
use creatures::{Creature, Terrain};
use envs_rapier::Variation;
use tasks::MovementCatalogue;

/// Everything that a configuration can name and that a program can add to: what `gambol::program` is given.
///
/// ```
/// use gambol_runs::Registry;
/// # use tasks::{Movement, Snapshot, Verdict};
/// # #[derive(Clone, Default)]
/// # struct HighKick;
/// # impl Movement for HighKick {
/// #     fn name(&self) -> &str { "high-kick" }
/// #     fn unit(&self) -> &str { "m" }
/// #     fn begin(&mut self, _: &Snapshot) {}
/// #     fn observe(&mut self, _: &Snapshot) -> Verdict { Verdict::GoOn }
/// #     fn value(&self) -> f64 { 0.0 }
/// # }
///
/// let mut registry = Registry::default();
/// registry.movements.add::<HighKick>(Some(150), "how high a limb gets above the ground");
/// let config = registry.config("default", creatures::find("biped-2")?, "high-kick")?;
/// assert!(gambol_runs::Setup::new(&config, &registry).is_ok());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Registry {
    /// Movements and terms, with the rules by which gaits are judged. Default: the built-in ones.
    pub movements: MovementCatalogue,
    /// Strategies. Default: the built-in ones.
    pub strategies: StrategyCatalogue,
    /// Presets. Default: the built-in ones.
    pub presets: PresetCatalogue,
    /// What the default preset adds for each movement. Default: what there is for the built-in ones.
    pub defaults: DefaultsCatalogue,
    /// Creatures. Default: the shipped ones.
    pub creatures: Catalogue<Creature>,
    /// Terrains. Default: the built-in ones.
    pub terrains: Catalogue<Terrain>,
    /// Variations of the world. Default: the built-in ones.
    pub variations: Catalogue<Variation>,
    /// Sensors beside those of the creature file's format. Default: none.
    pub sensors: Catalogue<MakeSense>,
}

/// There is no preset of this name; the message has those there are, and the nearest.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct UnknownPreset(String);

impl Registry {
    /// The configuration a preset gives for a creature and a movement, with seed 1 and 300 generations: see
    /// [`Preset::config`].
    ///
    /// # Errors
    /// If there is no such preset. Whether there is such a movement, [`Setup`](crate::Setup) checks.
    pub fn config(&self, preset: &str, creature: Creature, movement: &str) -> Result<RunConfig, UnknownPreset> {
        Ok(self.configure(self.presets.find(preset).map_err(UnknownPreset)?, creature, movement))
    }

    /// As [`config`](Self::config), of a preset at hand.
    pub fn configure(&self, preset: &Preset, creature: Creature, movement: &str) -> RunConfig {
        preset.config(creature, movement, &self.movements, &self.defaults)
    }
}
