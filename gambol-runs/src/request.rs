//! What a user asks for, and the configuration that follows from it.

pub use crate::assembly::ConfigError;

use crate::{
    Registry,
    assembly::{self, Assembly},
    catalogue::UnknownName,
    champion::{Champion, ChannelRecord},
    config::{EngineChoice, FrozenTopology, RunConfig},
    defaults,
    presets::Preset,
    shaping::{self, ShapingError},
    source::{self, SourceError},
    strategies::StrategyEntry,
    suggest,
};
use creatures::{Blueprint, Creature, CreatureError};
use envs_rapier::Variation;
use ne_core::{
    StopConditions,
    archive::ArchiveError,
    bounded_read::{LARGEST_TEXT, read_text},
};
use serde_json::{Value, json};
use std::{
    io,
    path::{Path, PathBuf},
};

/// A configuration in a user's words: later entries win over earlier ones.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// A shipped creature's name or a creature file; otherwise the configuration file has to say.
    pub creature: Option<String>,
    /// The movement's name; otherwise the configuration file has to say.
    pub movement: Option<String>,
    /// The preset; otherwise what the configuration file says, otherwise the [first](crate::presets::PresetCatalogue::first).
    pub preset: Option<String>,
    /// The strategy, by name or alias; otherwise what the configuration file or the preset says. If that is another one, this
    /// one has its default settings.
    pub strategy: Option<String>,
    /// A champion whose topology is to be kept while its weights are searched for anew.
    pub topology_from: Option<PathBuf>,
    /// A run or a champion that is gone on from: without a configuration file, sensors and controller are those it learned
    /// with, in place of the preset's.
    pub from: Option<PathBuf>,
    /// A configuration file laid over the preset. Its `creature` and `further_bodies`, those of its stages too, may be whole
    /// creatures, names, or paths (seen from the file's folder).
    pub config: Option<PathBuf>,
    /// Further bodies of the creature: shipped creatures' names or creature files; if any, in place of the configuration file's.
    pub further_bodies: Vec<String>,
    /// The seed.
    pub seed: Option<u64>,
    /// The number of individuals of a generation.
    pub population: Option<usize>,
    /// When the run ends. Evaluations, steps or minutes take the place of the preset's generations and steps, generations of its
    /// steps; what a file or a setting names stays.
    pub limits: StopConditions,
    /// Single settings, `key=value`.
    pub set: Vec<String>,
    /// The engine of training, by name.
    pub engine: Option<String>,
    /// The variation, by name: see [`Registry::variations`].
    pub variation: Option<String>,
    /// The terrain, `NAME` or `NAME:DIFFICULTY`: see [`Registry::terrains`].
    pub terrain: Option<String>,
    /// Whether to leave out the preset's variation, so that the fitnesses of all generations can be compared.
    pub unvaried: bool,
}

/// Why a request gives no configuration.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// There is no such creature.
    #[error(transparent)]
    Creature(#[from] SourceError),
    /// A name is not known; the message has the nearest one.
    #[error("{0}")]
    Unknown(String),
    /// There is no such terrain or variation.
    #[error(transparent)]
    Name(#[from] UnknownName),
    /// Something that a run needs was not said.
    #[error("{0}")]
    Missing(String),
    /// The configuration file cannot be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file.
        path: PathBuf,
        /// The reason.
        source: io::Error,
    },
    /// The configuration file is wrong.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        source: ConfigError,
    },
    /// The champion cannot be read.
    #[error(transparent)]
    Champion(#[from] ArchiveError),
    /// What is gone on from cannot be read.
    #[error(transparent)]
    From(Box<ShapingError>),
    /// A single setting is wrong.
    #[error("--set {assignment}: {source}")]
    Set {
        /// The setting.
        assignment: String,
        /// What is wrong.
        source: ConfigError,
    },
}

impl Request {
    /// The configuration asked for. Its numbers are checked by [`Setup::new`](crate::Setup::new).
    ///
    /// # Errors
    /// Names the file, field or setting that is wrong, and the nearest valid name.
    pub fn resolve(&self, registry: &Registry) -> Result<RunConfig, RequestError> {
        let mut layer = self.config.as_deref().map(Layer::read).transpose()?;
        if let Some(layer) = &mut layer {
            layer.find_creatures(registry)?;
        }
        let creature = self.creature(layer.as_ref(), registry)?;
        let movement = self.movement(layer.as_ref(), registry)?;
        let mut base = registry.configure(self.preset(layer.as_ref(), registry)?, creature, &movement);
        let entry = self.strategy(layer.as_mut(), registry)?;
        if let Some(entry) = entry.filter(|entry| entry.name() != base.strategy.name()) {
            base.strategy = entry.settings();
        }
        base.stop = base.stop.giving_way_to(&self.limits);
        if self.unvaried {
            base.variation = Variation::default();
            base.training_steps = None;
        }
        if let (Some(source), None) = (&self.from, &layer) {
            base = shaping::adopt(&base, source).map_err(|error| RequestError::From(Box::new(error)))?;
        }
        let mut assembly = Assembly::new(&base, registry);
        if let Some(Layer { path, value }) = layer {
            if value.get("variation").is_some() {
                // What a file leaves out of its variation does not vary, whatever the preset says.
                assembly.lay_over(json!({ "variation": Variation::default() }));
            }
            assembly.lay_over(value);
            // What was said on its own wins over the file.
            assembly.keep(&base, &["creature", "preset"]);
            assembly.keep_movement(&movement);
            assembly.check().map_err(|source| RequestError::File { path, source })?;
        }
        if let Some(path) = &self.topology_from {
            let topology = FrozenTopology::of(&Champion::read(path)?);
            assembly.lay_over(json!({ "topology": topology }));
        }
        if !self.further_bodies.is_empty() {
            let further_bodies = self.further_bodies.iter().map(|name| source::creature(name, registry));
            assembly.lay_over(json!({ "further_bodies": further_bodies.collect::<Result<Vec<_>, _>>()? }));
        }
        assembly.lay_over(self.choices(registry)?);
        for assignment in &self.set {
            check_strategy_of(assignment, base.strategy.name(), registry)?;
            let set = |assembly: &mut Assembly| assembly.set(assignment).and_then(|()| assembly.check());
            set(&mut assembly).map_err(|source| RequestError::Set { assignment: assignment.clone(), source })?;
        }
        let mut config = assembly.finish().map_err(|source| RequestError::Unknown(source.to_string()))?;
        if config.preset != base.preset {
            return Err(RequestError::Missing("a preset is chosen with --preset NAME, not with --set".into()));
        }
        if config.movement.name != base.movement.name {
            let message = "a movement is chosen on the command line or in a file, not with --set: steps, terms and more come with it";
            return Err(RequestError::Missing(message.into()));
        }
        defaults::follow_clock(&mut config, &base.movement);
        config.seed = self.seed.unwrap_or(config.seed);
        config.stop = config.stop.overlaid(self.limits);
        if let Some(population) = self.population {
            if !config.strategy.settings().contains_key("population") {
                let message = format!("the strategy {} has no population to be chosen", config.strategy.name());
                return Err(RequestError::Unknown(message));
            }
            config.strategy.set_population(population);
        }
        Ok(config)
    }

    /// The engine, the variation and the terrain that were asked for by name.
    fn choices(&self, registry: &Registry) -> Result<Value, RequestError> {
        let mut choices = json!({});
        if let Some(name) = &self.engine {
            let unknown =
                || RequestError::Unknown(suggest::unknown("engine", name, &EngineChoice::ALL.map(EngineChoice::name)));
            choices["engine"] = json!(EngineChoice::find(name).ok_or_else(unknown)?);
        }
        if let Some(name) = &self.variation {
            choices["variation"] = json!(registry.variations.find(name)?);
        }
        if let Some(name) = &self.terrain {
            choices["terrain"] = json!(registry.terrains.terrain(name)?);
        }
        Ok(choices)
    }

    fn creature(&self, layer: Option<&Layer>, registry: &Registry) -> Result<Creature, RequestError> {
        if let Some(name) = &self.creature {
            return Ok(source::creature(name, registry)?);
        }
        let Some((layer, value)) = layer.and_then(|layer| Some((layer, layer.value.get("creature")?))) else {
            let message =
                format!("say which creature: a name (see: {} creatures) or a creature file", crate::program_name());
            return Err(RequestError::Missing(message));
        };
        layer.creature("creature", value, registry)
    }

    fn movement(&self, layer: Option<&Layer>, registry: &Registry) -> Result<String, RequestError> {
        let known = || {
            let whole = registry.movements.entries().iter().filter(|entry| entry.steps.is_some());
            whole.map(|entry| entry.name.as_str()).collect::<Vec<_>>()
        };
        let check = |name: &str| match registry.movements.find(name) {
            Some(_) => Ok(name.to_owned()),
            None => Err(suggest::unknown("movement", name, &known())),
        };
        if let Some(name) = &self.movement {
            return check(name).map_err(RequestError::Unknown);
        }
        let wrong = |layer: &Layer, field, found| {
            let message = format!("must be a name (there are: {}), found {found}", known().join(", "));
            Err(layer.wrong(field, message))
        };
        let said = layer.and_then(|layer| Some((layer, layer.value.get("movement")?)));
        let named = said.map(|(layer, movement)| (layer, movement, movement.get("name")));
        match named {
            Some((layer, _, Some(Value::String(name)))) => {
                check(name).map_err(|message| layer.wrong("movement.name", message))
            }
            Some((layer, _, Some(found))) => wrong(layer, "movement.name", found),
            Some((layer, found, None)) if !found.is_object() => wrong(layer, "movement", found),
            _ => Err(RequestError::Missing(format!("say which movement (see: {} movements)", crate::program_name()))),
        }
    }

    /// The strategy that was asked for, on its own or in the file; what the file says of another one is dropped.
    fn strategy<'a>(
        &self,
        layer: Option<&mut Layer>,
        Registry { strategies, .. }: &'a Registry,
    ) -> Result<Option<&'a StrategyEntry>, RequestError> {
        let chosen = layer.as_ref().and_then(|layer| layer.value.get("strategy")?.as_object()?.keys().next().cloned());
        let Some(name) = &self.strategy else { return Ok(chosen.and_then(|name| strategies.find(&name))) };
        let entry = strategies.find(name).ok_or_else(|| RequestError::Unknown(strategies.unknown(name)))?;
        if let Some(fields) = layer.and_then(|layer| layer.value.as_object_mut())
            && chosen.is_some_and(|chosen| chosen != entry.name())
        {
            fields.remove("strategy");
        }
        Ok(Some(entry))
    }

    fn preset<'a>(
        &self,
        layer: Option<&Layer>,
        Registry { presets, .. }: &'a Registry,
    ) -> Result<&'a Preset, RequestError> {
        if let Some(name) = &self.preset {
            return presets.find(name).map_err(RequestError::Unknown);
        }
        match layer.and_then(|layer| Some((layer, layer.value.get("preset")?))) {
            Some((layer, Value::String(name))) => presets.find(name).map_err(|message| layer.wrong("preset", message)),
            Some((layer, other)) => Err(layer.wrong("preset", format!("must be a name, found {other}"))),
            None => Ok(presets.first()),
        }
    }
}

/// A setting of a strategy makes sense only if it is the strategy.
fn check_strategy_of(assignment: &str, chosen: &str, registry: &Registry) -> Result<(), RequestError> {
    let path = assignment.split('=').next().unwrap_or_default();
    match path.strip_prefix("strategy.").and_then(|path| path.split_once('.')) {
        Some((other, _))
            if other != chosen && registry.strategies.find(other).is_some_and(|entry| entry.name() == other) =>
        {
            let message = format!(
                "--set {assignment}: the strategy is \"{chosen}\"; choose the other one with --strategy {other}"
            );
            Err(RequestError::Unknown(message))
        }
        _ => Ok(()),
    }
}

impl FrozenTopology {
    /// The topology of a champion.
    pub fn of(champion: &Champion) -> Self {
        let names = |channels: &[ChannelRecord]| channels.iter().map(|channel| channel.name.clone()).collect();
        let (inputs, outputs) = (names(&champion.inputs), names(&champion.outputs));
        Self { inputs, outputs, net: champion.network.topology(), genes: Vec::new() }
    }
}

/// The message without line and column, since the creature is part of a larger file.
fn without_place(error: &CreatureError) -> String {
    let (line, column) = match error {
        CreatureError::Field { line, column, .. } => (*line, *column),
        CreatureError::UnknownName(name) => (name.line, name.column),
        _ => return error.to_string(),
    };
    let message = error.to_string().replace(&format!(" (line {line}, column {column})"), "");
    message.trim_start_matches("the file: ").to_owned()
}

/// A configuration file.
struct Layer {
    path: PathBuf,
    value: Value,
}

impl Layer {
    fn read(path: &Path) -> Result<Self, RequestError> {
        let text = read_text(path, LARGEST_TEXT).map_err(|source| RequestError::Read { path: path.into(), source })?;
        let file = assembly::parse(&text).map_err(|source| RequestError::File { path: path.into(), source })?;
        if file.edited {
            tracing::warn!(
                "{} was changed after a run wrote it: its digest does not fit; it is used as it is",
                path.display()
            );
        }
        Ok(Self { path: path.into(), value: file.fields })
    }

    /// The creature that a field of this file names, or is.
    fn creature(&self, field: &str, value: &Value, registry: &Registry) -> Result<Creature, RequestError> {
        if let Some(name) = value.as_str() {
            let beside = self.path.parent().map(|folder| folder.join(name)).filter(|path| path.is_file());
            return match beside {
                Some(path) => Ok(source::creature_file(&path)?),
                None => source::creature(name, registry).map_err(|error| self.wrong(field, error)),
            };
        }
        let blueprint =
            Blueprint::from_json(&value.to_string()).map_err(|error| self.wrong(field, without_place(&error)))?;
        Ok(blueprint.creature().clone())
    }

    /// Puts creatures in the place of their names: of the further bodies of the run, and of the creature and the further bodies of
    /// each of its stages.
    fn find_creatures(&mut self, registry: &Registry) -> Result<(), RequestError> {
        let stages = self.value.get("stages").and_then(Value::as_array).map_or(0, Vec::len);
        let of_stage = |stage| {
            (format!("/stages/{stage}/changes/further_bodies"), format!("stages[{stage}].changes.further_bodies"))
        };
        let of_run = ("/further_bodies".to_owned(), "further_bodies".to_owned());
        for (place, field) in std::iter::once(of_run).chain((0..stages).map(of_stage)) {
            let Some(named) = self.value.pointer(&place).and_then(Value::as_array) else { continue };
            let find = |(index, it)| self.creature(&format!("{field}[{index}]"), it, registry);
            let found = named.iter().enumerate().map(find);
            let found = json!(found.collect::<Result<Vec<_>, _>>()?);
            if let Some(further_bodies) = self.value.pointer_mut(&place) {
                *further_bodies = found;
            }
        }
        for stage in 0..stages {
            let place = format!("/stages/{stage}/changes/creature");
            let Some(named) = self.value.pointer(&place) else { continue };
            let found = json!(self.creature(&format!("stages[{stage}].changes.creature"), named, registry)?);
            if let Some(creature) = self.value.pointer_mut(&place) {
                *creature = found;
            }
        }
        Ok(())
    }

    /// The error that a field of this file is wrong.
    fn wrong(&self, field: &str, message: impl ToString) -> RequestError {
        let source = ConfigError::Field { field: field.into(), message: message.to_string() };
        RequestError::File { path: self.path.clone(), source }
    }
}
