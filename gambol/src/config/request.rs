//! What a user asks for, and the configuration that follows from it.

use super::{Assembly, ConfigError, PRESETS, RunConfig, preset};
use crate::{source, source::SourceError, suggest};
use creatures::{Blueprint, Creature};
use serde_json::Value;
use std::{
    fs, io,
    path::{Path, PathBuf},
};
use tasks::MovementCatalogue;

/// A configuration in a user's words: later entries win over earlier ones.
#[derive(Clone, Debug, Default)]
pub struct Request {
    /// A shipped creature's name or a creature file; otherwise the configuration file has to say.
    pub creature: Option<String>,
    /// The movement's name; otherwise the configuration file has to say.
    pub movement: Option<String>,
    /// The preset; otherwise what the configuration file says, otherwise the first of [`PRESETS`].
    pub preset: Option<String>,
    /// A configuration file laid over the preset. Its `creature` may be a whole creature, a name, or a path (seen from
    /// the file's folder).
    pub config: Option<PathBuf>,
    /// Single settings, `key=value`.
    pub set: Vec<String>,
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
    /// Something that a run needs was not said.
    #[error("{0}")]
    Missing(&'static str),
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
    pub fn resolve(&self, catalogue: &MovementCatalogue) -> Result<RunConfig, RequestError> {
        let layer = self.config.as_deref().map(Layer::read).transpose()?;
        let creature = self.creature(layer.as_ref())?;
        let movement = self.movement(layer.as_ref(), catalogue)?;
        let preset_name = self.preset.as_deref().or(layer.as_ref().and_then(|layer| layer.text("/preset")));
        let base = match preset_name {
            Some(name) => preset(name).ok_or_else(|| {
                let known: Vec<&str> = PRESETS.iter().map(|preset| preset.name).collect();
                RequestError::Unknown(suggest::unknown("preset", name, &known))
            })?,
            None => &PRESETS[0],
        };
        let base = base.config(creature, &movement);
        let mut assembly = Assembly::new(&base);
        if let Some(Layer { path, value }) = layer {
            assembly.lay_over(value);
            // What was said on its own wins over the file.
            assembly.keep(&base, &["creature", "preset"]);
            assembly.keep_movement(&movement);
            assembly.check().map_err(|source| RequestError::File { path, source })?;
        }
        for assignment in &self.set {
            let set = |assembly: &mut Assembly| assembly.set(assignment).and_then(|()| assembly.check());
            set(&mut assembly).map_err(|source| RequestError::Set { assignment: assignment.clone(), source })?;
        }
        assembly.finish().map_err(|source| RequestError::Unknown(source.to_string()))
    }

    fn creature(&self, layer: Option<&Layer>) -> Result<Creature, RequestError> {
        if let Some(name) = &self.creature {
            return Ok(source::creature(name)?);
        }
        let Some((layer, value)) = layer.and_then(|layer| Some((layer, layer.value.get("creature")?))) else {
            return Err(RequestError::Missing("say which creature: a name (see: gambol creatures) or a creature file"));
        };
        if let Some(name) = value.as_str() {
            let beside = layer.path.parent().map(|folder| folder.join(name)).filter(|path| path.is_file());
            return Ok(match beside {
                Some(path) => source::creature_file(&path)?,
                None => source::creature(name)?,
            });
        }
        let blueprint = Blueprint::from_json(&value.to_string())
            .map_err(|source| SourceError::Invalid { path: layer.path.clone(), source: Box::new(source) })?;
        Ok(blueprint.creature().clone())
    }

    fn movement(&self, layer: Option<&Layer>, catalogue: &MovementCatalogue) -> Result<String, RequestError> {
        let name = self.movement.as_deref().or(layer.and_then(|layer| layer.text("/movement/name")));
        let Some(name) = name else {
            return Err(RequestError::Missing("say which movement (see: gambol movements)"));
        };
        if catalogue.find(name).is_none() {
            let known: Vec<&str> = catalogue
                .entries()
                .iter()
                .filter(|entry| entry.steps.is_some())
                .map(|entry| entry.name.as_str())
                .collect();
            return Err(RequestError::Unknown(suggest::unknown("movement", name, &known)));
        }
        Ok(name.into())
    }
}

/// A configuration file.
struct Layer {
    path: PathBuf,
    value: Value,
}

impl Layer {
    fn read(path: &Path) -> Result<Self, RequestError> {
        let text = fs::read_to_string(path).map_err(|source| RequestError::Read { path: path.into(), source })?;
        let value = super::assembly::parse(&text)
            .map_err(|source| RequestError::File { path: path.into(), source })?;
        Ok(Self { path: path.into(), value })
    }

    fn text(&self, pointer: &str) -> Option<&str> {
        self.value.pointer(pointer).and_then(Value::as_str)
    }
}
