//! A configuration put together from a preset, a file and single settings, later ones winning.

use crate::{
    Registry,
    catalogue::UnknownName,
    config::{CONFIG_FORMAT, CONFIG_VERSION, RunConfig},
    layers::merge,
    strategies::StrategyError,
    suggest,
    unique_keys::UniqueKeys,
};
use ne_core::{digest::Digest, field_path};
use serde_json::{Map, Value, json};

/// Why a configuration is not one. The message names the field, and the nearest valid name where a name is wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum ConfigError {
    /// A file is not JSON.
    #[error("line {line}, column {column}: {message}")]
    Malformed {
        /// From 1.
        line: usize,
        /// From 1.
        column: usize,
        /// What the parser says.
        message: String,
    },
    /// A field is unknown, missing or of the wrong type.
    #[error("{field}: {message}")]
    Field {
        /// Its path.
        field: String,
        /// What is wrong.
        message: String,
    },
    /// A `key=value` without a key or without `=`.
    #[error("\"{0}\" is not of the form key=value, such as physics.time_step=0.01")]
    Assignment(String),
    /// A `key=value` whose value begins as a list, an object or a text of JSON does, and is none.
    #[error("{assignment}: {message}; a value that begins with [, {{ or \" is read as JSON")]
    Value {
        /// The whole assignment.
        assignment: String,
        /// What the parser says, with the column of the value.
        message: String,
    },
}

impl From<StrategyError> for ConfigError {
    fn from(error: StrategyError) -> Self {
        match error {
            StrategyError::Unknown { message } => Self::Field { field: "strategy".into(), message },
            StrategyError::Field { field, message } => Self::Field { field, message },
            StrategyError::Setting(error) => Self::Field { message: error.to_string(), field: error.field },
        }
    }
}

/// A configuration in the making.
#[derive(Clone, Debug)]
pub(crate) struct Assembly<'a> {
    value: Value,
    registry: &'a Registry,
}

impl<'a> Assembly<'a> {
    /// Starts from a complete configuration. Names are those of the registry.
    pub(crate) fn new(base: &RunConfig, registry: &'a Registry) -> Self {
        // Serialising plain data to a value cannot fail; were it to, the missing fields would be named at the end.
        Self { value: serde_json::to_value(base).unwrap_or_default(), registry }
    }

    /// Lays fields over what is there. Objects are merged; a choice (an object whose one key names what was chosen, with
    /// its settings, such as `{"tournament": {"size": 3}}`) replaces another choice. A variation or a terrain may be named
    /// (`"light"`, `"gaps:0.3"`), and replaces what is there.
    pub(crate) fn lay_over(&mut self, mut layer: Value) {
        self.spell_out(&mut layer);
        merge(&mut self.value, layer);
    }

    /// Puts these fields back to what they are in `base`.
    pub(super) fn keep(&mut self, base: &RunConfig, fields: &[&str]) {
        let base = Self::new(base, self.registry);
        for &field in fields {
            self.value[field] = base.value[field].clone();
        }
    }

    /// Puts the movement's name in place.
    pub(super) fn keep_movement(&mut self, name: &str) {
        if let Some(movement) = self.value.get_mut("movement").and_then(Value::as_object_mut) {
            movement.insert("name".into(), name.into());
        }
    }

    /// Sets one field: `physics.time_step=0.01`, `controller.hidden=[8,8]`, `movement.terms=[{"term":"energy"}]`. The
    /// value is JSON, or else a string.
    ///
    /// # Errors
    /// If there is no `=`, the path leads through something that is not an object, or the value begins as JSON and is none.
    pub(crate) fn set(&mut self, assignment: &str) -> Result<(), ConfigError> {
        let (path, text) = assignment
            .split_once('=')
            .filter(|(path, _)| !path.trim().is_empty())
            .ok_or_else(|| ConfigError::Assignment(assignment.into()))?;
        let value = match serde_json::from_str(text) {
            Ok(value) => value,
            Err(error) if text.trim_start().starts_with(['[', '{', '"']) => {
                return Err(ConfigError::Value { assignment: assignment.into(), message: error.to_string() });
            }
            Err(_) => Value::String(text.into()),
        };
        let keys: Vec<&str> = path.trim().split('.').collect();
        let mut layer = value;
        for key in keys.iter().rev() {
            layer = Value::Object(Map::from_iter([((*key).to_owned(), layer)]));
        }
        let mut place = &self.value;
        for (depth, key) in keys.iter().enumerate() {
            match place {
                Value::Object(fields) => place = fields.get(*key).unwrap_or(&Value::Null),
                Value::Null => break,
                _ => {
                    let field = keys[..depth].join(".");
                    return Err(ConfigError::Field { field, message: format!("has no field \"{key}\"") });
                }
            }
        }
        self.lay_over(layer);
        Ok(())
    }

    /// The finished configuration. Its numbers are not checked yet: [`Setup::new`](crate::Setup::new) does.
    ///
    /// # Errors
    /// If a field is unknown, missing or of the wrong type.
    pub(crate) fn finish(self) -> Result<RunConfig, ConfigError> {
        self.check()
    }

    /// As [`finish`](Self::finish), for a look in between.
    pub(super) fn check(&self) -> Result<RunConfig, ConfigError> {
        self.check_names()?;
        let config: RunConfig = field_path::from_value(&self.value)
            .map_err(|error| ConfigError::Field { field: error.path, message: suggest::explain(&error.message) })?;
        self.registry.strategies.check(&config.strategy)?;
        Ok(config)
    }

    /// Names that could not be spelled out.
    fn check_names(&self) -> Result<(), ConfigError> {
        let name = |field: &str| self.value.get(field).and_then(Value::as_str);
        let wrong = |field: &str| {
            let field = field.to_owned();
            move |error: UnknownName| ConfigError::Field { field, message: error.to_string() }
        };
        name("variation")
            .map_or(Ok(()), |name| self.registry.variations.find(name).map(drop))
            .map_err(wrong("variation"))?;
        name("terrain").map_or(Ok(()), |text| self.registry.terrains.terrain(text).map(drop)).map_err(wrong("terrain"))
    }

    /// Puts what they stand for in the place of a variation's and a terrain's names; unknown names stay.
    fn spell_out(&self, layer: &mut Value) {
        let name = |field: &str| layer.get(field).and_then(Value::as_str);
        let variation = name("variation").and_then(|name| self.registry.variations.find(name).ok());
        let terrain = name("terrain").and_then(|text| self.registry.terrains.terrain(text).ok());
        if let Some(variation) = variation {
            layer["variation"] = json!(variation);
        }
        if let Some(terrain) = terrain {
            layer["terrain"] = json!(terrain);
        }
    }
}

/// What a configuration file says.
pub(super) struct FileContent {
    /// Its fields.
    pub(super) fields: Value,
    /// Whether a digest stands in it that its fields do not have: somebody has edited what a run wrote.
    pub(super) edited: bool,
}

/// Reads a configuration file: one with some of the fields, or the `config.json` of another run.
pub(super) fn parse(text: &str) -> Result<FileContent, ConfigError> {
    let UniqueKeys(layer) = serde_json::from_str(text).map_err(|error| {
        let message = field_path::without_place(&error.to_string()).to_owned();
        ConfigError::Malformed { line: error.line(), column: error.column(), message }
    })?;
    if !layer.is_object() {
        return Err(ConfigError::Field { field: "the file".into(), message: "must be a JSON object".into() });
    }
    unwrapped(layer)
}

/// The fields of a file, which may stand in the envelope of a run's own `config.json`.
fn unwrapped(mut layer: Value) -> Result<FileContent, ConfigError> {
    let wrong = |field: &str, message: String| Err(ConfigError::Field { field: field.into(), message });
    let Some(fields) = layer.as_object_mut().filter(|fields| fields.contains_key("content")) else {
        return Ok(FileContent { fields: layer, edited: false });
    };
    match (fields.get("format"), fields.get("version")) {
        (Some(format), _) if format != CONFIG_FORMAT => {
            wrong("format", format!("is {format}, a configuration has \"{CONFIG_FORMAT}\""))
        }
        (_, Some(version)) if *version != CONFIG_VERSION => {
            wrong("version", format!("is {version}, this Gambol reads version {CONFIG_VERSION}"))
        }
        _ => {
            let content = fields.remove("content").unwrap_or_default();
            let digest = Digest::of_json(&content).to_string();
            let edited = fields.get("digest").and_then(Value::as_str).is_some_and(|written| written != digest);
            Ok(FileContent { fields: content, edited })
        }
    }
}
