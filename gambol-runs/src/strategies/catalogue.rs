//! Which strategies there are.

use super::{AnyGenome, AnyStrategy, NetStrategy, any::any_checkpoint};
use crate::{config::StrategySettings, suggest};
use ne_core::{Checkpoint, SettingError, archive::ArchiveError, field_path::FieldError};
use ne_net::Topology;
use std::{fmt, marker::PhantomData, path::Path, sync::Arc};

/// The strategies that configurations can name. The default has the built-in ones.
#[derive(Clone, Debug)]
pub struct StrategyCatalogue {
    entries: Vec<StrategyEntry>,
}

/// A strategy that users can ask for by name.
#[derive(Clone)]
pub struct StrategyEntry {
    name: &'static str,
    alias: Option<String>,
    description: String,
    kind: Arc<dyn Kind>,
}

/// Why a strategy cannot be had. The message names the field, as a configuration has it.
#[derive(Clone, Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StrategyError {
    /// There is none of this name.
    #[error("strategy: {message}")]
    Unknown {
        /// Which one there is not, which there are, and the nearest name.
        message: String,
    },
    /// A setting is unknown, missing or of the wrong type.
    #[error("{field}: {message}")]
    Field {
        /// Its path.
        field: String,
        /// What is wrong.
        message: String,
    },
    /// A setting is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

impl StrategyCatalogue {
    /// A catalogue without any.
    pub fn empty() -> Self {
        Self { entries: Vec::new() }
    }

    /// Adds a strategy, or replaces the one of the same name, whose alias it has then. `description`: one sentence.
    pub fn add<S: NetStrategy>(&mut self, description: &str) -> &mut StrategyEntry {
        let kind = Arc::new(KindOf::<S>(PhantomData));
        let found = self.entries.iter().position(|entry| entry.name == S::NAME);
        let alias = found.and_then(|index| self.entries[index].alias.clone());
        let entry = StrategyEntry { name: S::NAME, alias, description: description.into(), kind };
        let place = found.unwrap_or(self.entries.len());
        match found {
            Some(_) => self.entries[place] = entry,
            None => self.entries.push(entry),
        }
        &mut self.entries[place]
    }

    /// All strategies, in the order in which they were added.
    pub fn entries(&self) -> &[StrategyEntry] {
        &self.entries
    }

    /// The strategy of this name or alias.
    pub fn find(&self, name: &str) -> Option<&StrategyEntry> {
        let named = self.entries.iter().find(|entry| entry.name == name);
        named.or_else(|| self.entries.iter().find(|entry| entry.alias.as_deref() == Some(name)))
    }

    /// All names, each with its alias before it.
    pub fn names(&self) -> Vec<&str> {
        self.entries.iter().flat_map(|entry| [entry.alias.as_deref(), Some(entry.name)]).flatten().collect()
    }

    /// What [`StrategyError::Unknown`] says of a name that is not known.
    pub fn unknown(&self, name: &str) -> String {
        suggest::unknown("strategy", name, &self.names())
    }

    /// The strategy that these settings are for.
    ///
    /// # Errors
    /// If there is none of this name.
    pub fn of(&self, settings: &StrategySettings) -> Result<&StrategyEntry, StrategyError> {
        // By its name alone: files have no aliases.
        let name = settings.name();
        let found = self.entries.iter().find(|entry| entry.name == name);
        found.ok_or_else(|| {
            let meant = self.entries.iter().find(|entry| entry.alias.as_deref() == Some(name));
            let message = meant.map_or_else(
                || self.unknown(name),
                |entry| format!("in files and settings the strategy \"{name}\" is called \"{}\"", entry.name),
            );
            StrategyError::Unknown { message }
        })
    }

    /// Checks that there is such a strategy and that it has these settings, of these types; not their ranges.
    ///
    /// # Errors
    /// Names the field.
    pub fn check(&self, settings: &StrategySettings) -> Result<(), StrategyError> {
        self.of(settings)?.kind.check(settings)
    }

    /// Checks all of the settings, for nets of this topology.
    ///
    /// # Errors
    /// Names the field and its range: `strategy.conventional.elites = 50: must be below 50`.
    pub fn validate(&self, settings: &StrategySettings, topology: &Topology) -> Result<(), StrategyError> {
        match self.build(settings, topology) {
            Err(StrategyError::Setting(error)) => Err(error.within(settings.name()).within("strategy").into()),
            built => built.map(drop),
        }
    }

    /// As [`NetStrategy::build`].
    ///
    /// # Errors
    /// As [`NetStrategy::build`], and as [`check`](Self::check).
    pub fn build(&self, settings: &StrategySettings, topology: &Topology) -> Result<AnyStrategy, StrategyError> {
        self.of(settings)?.kind.build(settings, topology)
    }

    /// As [`NetStrategy::begin_at`].
    ///
    /// # Errors
    /// As [`NetStrategy::begin_at`], and as [`check`](Self::check).
    pub fn begin_at(
        &self,
        settings: &StrategySettings,
        topology: &Topology,
        weights: &[f32],
    ) -> Result<AnyStrategy, StrategyError> {
        self.of(settings)?.kind.begin_at(settings, topology, weights)
    }

    /// As [`NetStrategy::begin_about`].
    ///
    /// # Errors
    /// As [`NetStrategy::begin_about`], and as [`check`](Self::check).
    pub fn begin_about(
        &self,
        settings: &StrategySettings,
        topology: &Topology,
        guess: &[f32],
    ) -> Result<AnyStrategy, StrategyError> {
        self.of(settings)?.kind.begin_about(settings, topology, guess)
    }

    /// As [`NetStrategy::genome`]; `None` too for a strategy that there is not.
    pub fn genome(&self, settings: &StrategySettings, topology: &Topology, weights: &[f32]) -> Option<AnyGenome> {
        self.of(settings).ok()?.kind.genome(topology, weights)
    }
}

impl StrategyEntry {
    /// Its name in configurations.
    pub fn name(&self) -> &str {
        self.name
    }

    /// Gives it a shorter name, for the command line.
    pub fn with_alias(&mut self, alias: &str) -> &mut Self {
        self.alias = Some(alias.into());
        self
    }

    /// A shorter name, for the command line.
    pub fn alias(&self) -> Option<&str> {
        self.alias.as_deref()
    }

    /// One sentence.
    pub fn description(&self) -> &str {
        &self.description
    }

    /// As [`NetStrategy::FINDS_TOPOLOGY`].
    pub fn finds_topology(&self) -> bool {
        self.kind.finds_topology()
    }

    /// As [`NetStrategy::FINDS_COPIED`].
    pub fn finds_copied(&self) -> bool {
        self.kind.finds_copied()
    }

    /// Its default settings.
    pub fn settings(&self) -> StrategySettings {
        self.kind.settings()
    }

    /// The JSON Schema of its settings, with its sentence as description and its default settings as default. What it refers
    /// to is defined by the generator.
    #[cfg(feature = "schema")]
    pub fn schema(&self, generator: &mut schemars::SchemaGenerator) -> schemars::Schema {
        let any_object = || schemars::json_schema!({ "type": "object" });
        let mut schema = self.kind.schema(generator).unwrap_or_else(any_object);
        schema.insert("description".into(), self.description.as_str().into());
        schema.insert("default".into(), self.settings().settings().clone().into());
        schema
    }

    /// Reads a checkpoint of it.
    ///
    /// # Errors
    /// As [`Checkpoint::read`].
    pub fn read_checkpoint(&self, path: &Path) -> Result<Checkpoint<AnyStrategy>, ArchiveError> {
        self.kind.read_checkpoint(path)
    }
}

impl fmt::Debug for StrategyEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("StrategyEntry").field(&self.name).finish()
    }
}

/// What can be asked of a strategy that is not built yet.
trait Kind: Send + Sync {
    fn finds_topology(&self) -> bool;
    fn finds_copied(&self) -> bool;
    fn settings(&self) -> StrategySettings;
    fn check(&self, settings: &StrategySettings) -> Result<(), StrategyError>;
    fn build(&self, settings: &StrategySettings, topology: &Topology) -> Result<AnyStrategy, StrategyError>;
    fn begin_at(
        &self,
        settings: &StrategySettings,
        topology: &Topology,
        weights: &[f32],
    ) -> Result<AnyStrategy, StrategyError>;
    fn begin_about(
        &self,
        settings: &StrategySettings,
        topology: &Topology,
        guess: &[f32],
    ) -> Result<AnyStrategy, StrategyError>;
    fn genome(&self, topology: &Topology, weights: &[f32]) -> Option<AnyGenome>;
    fn read_checkpoint(&self, path: &Path) -> Result<Checkpoint<AnyStrategy>, ArchiveError>;
    #[cfg(feature = "schema")]
    fn schema(&self, generator: &mut schemars::SchemaGenerator) -> Option<schemars::Schema>;
}

struct KindOf<S>(PhantomData<fn() -> S>);

impl<S: NetStrategy> KindOf<S> {
    fn parse(settings: &StrategySettings) -> Result<S::Settings, StrategyError> {
        settings.parse().map_err(|FieldError { path, message, .. }| {
            let place = if path == "." { String::new() } else { format!(".{path}") };
            let field = format!("strategy.{}{place}", S::NAME);
            StrategyError::Field { field, message: suggest::explain(&message) }
        })
    }
}

impl<S: NetStrategy> Kind for KindOf<S> {
    fn finds_topology(&self) -> bool {
        S::FINDS_TOPOLOGY
    }

    fn finds_copied(&self) -> bool {
        S::FINDS_COPIED
    }

    fn settings(&self) -> StrategySettings {
        StrategySettings::new(S::NAME, &S::Settings::default())
    }

    fn check(&self, settings: &StrategySettings) -> Result<(), StrategyError> {
        Self::parse(settings).map(drop)
    }

    fn build(&self, settings: &StrategySettings, topology: &Topology) -> Result<AnyStrategy, StrategyError> {
        Ok(AnyStrategy::new(S::build(&Self::parse(settings)?, topology)?))
    }

    fn begin_at(
        &self,
        settings: &StrategySettings,
        topology: &Topology,
        weights: &[f32],
    ) -> Result<AnyStrategy, StrategyError> {
        Ok(AnyStrategy::new(S::begin_at(&Self::parse(settings)?, topology, weights)?))
    }

    fn begin_about(
        &self,
        settings: &StrategySettings,
        topology: &Topology,
        guess: &[f32],
    ) -> Result<AnyStrategy, StrategyError> {
        Ok(AnyStrategy::new(S::begin_about(&Self::parse(settings)?, topology, guess)?))
    }

    fn genome(&self, topology: &Topology, weights: &[f32]) -> Option<AnyGenome> {
        S::genome(topology, weights).map(AnyGenome::new::<S>)
    }

    fn read_checkpoint(&self, path: &Path) -> Result<Checkpoint<AnyStrategy>, ArchiveError> {
        Ok(any_checkpoint(Checkpoint::<S>::read(path)?))
    }

    #[cfg(feature = "schema")]
    fn schema(&self, generator: &mut schemars::SchemaGenerator) -> Option<schemars::Schema> {
        S::settings_schema(generator)
    }
}
