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

/// A name that a command line and a folder cannot have, or rules by which nothing can be judged.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum RegistryError {
    /// A name.
    #[error("the {kind} \"{name}\": a name is of lower-case letters, digits and hyphens")]
    Name {
        /// What has it.
        kind: &'static str,
        /// The name.
        name: String,
    },
    /// How long an episode is judged.
    #[error("the rules of the movement \"{movement}\": seconds() = {seconds}: must be from 0.1 to 600")]
    Seconds {
        /// The movement.
        movement: String,
        /// What its rules say.
        seconds: f64,
    },
    /// A strategy's alias.
    #[error("the alias \"{alias}\" of the strategy \"{strategy}\": another strategy has this name or alias")]
    Alias {
        /// The alias.
        alias: String,
        /// The strategy.
        strategy: String,
    },
    /// What is said of a movement in `defaults`.
    #[error("defaults of the movement \"{movement}\": there is no movement of this name")]
    Defaults {
        /// The movement.
        movement: String,
    },
}

impl Registry {
    /// Checks what was added by other crates: names, aliases, for which movements there are defaults, and how long rules want to judge.
    /// `gambol::program` does so before anything else.
    ///
    /// # Errors
    /// The first that is not as it must be.
    pub fn check(&self) -> Result<(), RegistryError> {
        let movements = self.movements.entries().iter().map(|entry| ("movement", &*entry.name));
        let strategies = self.strategies.entries().iter().map(|entry| ("strategy", entry.name()));
        let aliases = self.strategies.entries().iter().filter_map(|entry| Some(("alias", entry.alias()?)));
        let presets = self.presets.entries().map(|preset| ("preset", &*preset.name));
        let variations = self.variations.names().into_iter().map(|name| ("variation", name));
        let terrains = self.terrains.names().into_iter().map(|name| ("terrain", name));
        let sensors = self.sensors.names().into_iter().map(|name| ("custom sensor", name));
        let all =
            movements.chain(strategies).chain(aliases).chain(presets).chain(variations).chain(terrains).chain(sensors);
        let fits = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-';
        for (kind, name) in all {
            if name.is_empty() || !name.chars().all(fits) {
                return Err(RegistryError::Name { kind, name: name.into() });
            }
        }
        let names = self.strategies.names();
        for entry in self.strategies.entries() {
            if let Some(alias) = entry.alias().filter(|alias| names.iter().filter(|name| name == &alias).count() > 1) {
                return Err(RegistryError::Alias { alias: alias.into(), strategy: entry.name().into() });
            }
        }
        if let Some(movement) = self.defaults.movements().find(|movement| self.movements.find(movement).is_none()) {
            return Err(RegistryError::Defaults { movement: movement.into() });
        }
        for entry in self.movements.entries() {
            if let Some(seconds) = entry.rules.as_ref().map(|rules| rules.seconds())
                && !(0.1..=600.0).contains(&seconds)
            {
                return Err(RegistryError::Seconds { movement: entry.name.clone(), seconds });
            }
        }
        Ok(())
    }

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::defaults::MovementDefaults;
    use tasks::{
        Running,
        gait::{Findings, GaitReport, Rules, Trajectory},
    };

    #[derive(Debug)]
    struct Endless;

    impl Rules for Endless {
        fn name(&self) -> &str {
            "endless"
        }
        fn seconds(&self) -> f64 {
            f64::NAN
        }
        fn judge(&self, _: &GaitReport, _: &Trajectory<'_>) -> Findings {
            Findings::default()
        }
    }

    #[test]
    fn what_is_built_in_can_be_named_and_what_is_added_must() {
        let check = |add: &dyn Fn(&mut Registry)| {
            let mut registry = Registry::default();
            add(&mut registry);
            registry.check().map_err(|error| error.to_string())
        };
        assert_eq!(check(&|_| {}), Ok(()));
        let rule = "a name is of lower-case letters, digits and hyphens";
        for name in ["High Kick", "a/b", ""] {
            let variation = |registry: &mut Registry| {
                registry.variations.add(name, "", Variation::default());
            };
            assert_eq!(check(&variation), Err(format!("the variation \"{name}\": {rule}")));
        }
        let rules = |registry: &mut Registry| {
            registry.movements.add::<Running>(Some(100), "").judged_by(Endless);
        };
        let expected = "the rules of the movement \"running\": seconds() = NaN: must be from 0.1 to 600";
        assert_eq!(check(&rules), Err(expected.into()));
        let alias = |registry: &mut Registry| {
            registry.strategies.add::<ne_fixed::HillClimbing>("").with_alias("ga");
        };
        let expected = "the alias \"ga\" of the strategy \"conventional\": another strategy has this name or alias";
        assert_eq!(check(&alias), Err(expected.into()));
        let defaults = |registry: &mut Registry| {
            registry.defaults.add("runing", MovementDefaults::unknown);
        };
        let expected = "defaults of the movement \"runing\": there is no movement of this name";
        assert_eq!(check(&defaults), Err(expected.into()));
    }
}
