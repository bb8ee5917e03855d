//! The search a configuration names.

use crate::layers::merge;
use ne_core::field_path::{self, FieldError};
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{DeserializeOwned, Error},
    ser::SerializeMap,
};
use serde_json::{Map, Value};

/// The search, by name, with its settings as they stand in files: `{"cma-es": {"population": 16, ...}}`.
///
/// What settings there are, and what they may be, its [entry](crate::strategies::StrategyEntry) knows.
#[derive(Clone, Debug, PartialEq)]
pub struct StrategySettings {
    name: String,
    settings: Map<String, Value>,
}

impl StrategySettings {
    /// The strategy of this name, with these settings: a struct, or `()` for none.
    pub fn new(name: &str, settings: &impl Serialize) -> Self {
        // Through text, because a reader will see the numbers as text has them: an f32 as its shortest decimal. Plain data
        // can be written; were it not, the missing fields would be named when they are read.
        let text = serde_json::to_string(settings).unwrap_or_default();
        Self { name: name.into(), settings: serde_json::from_str(&text).unwrap_or_default() }
    }

    /// The strategy's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Its settings.
    pub fn settings(&self) -> &Map<String, Value> {
        &self.settings
    }

    /// Its settings as what they are, if it is the strategy of this name and they are right.
    pub fn of<T: DeserializeOwned>(&self, name: &str) -> Option<T> {
        (self.name == name).then(|| self.parse().ok()).flatten()
    }

    /// Its settings as what they are.
    pub(crate) fn parse<T: DeserializeOwned>(&self) -> Result<T, FieldError> {
        let found = field_path::from_value(&Value::Object(self.settings.clone()));
        // Those of a strategy without any are written as an empty list of fields.
        match found {
            Err(_) if self.settings.is_empty() => field_path::from_value(&Value::Null).or(found),
            found => found,
        }
    }

    /// Changes one setting.
    pub fn set(&mut self, field: &str, value: impl Into<Value>) {
        self.settings.insert(field.into(), value.into());
    }

    /// Lays settings over what is there. Objects are merged; a choice (an object whose one key names what was chosen) replaces another.
    pub fn lay_over(&mut self, settings: Map<String, Value>) {
        for (field, value) in settings {
            merge(self.settings.entry(field).or_insert(Value::Null), value);
        }
    }

    /// The number of individuals of a generation, if the settings say so, as `population`.
    pub fn population(&self) -> Option<usize> {
        self.settings.get("population")?.as_u64()?.try_into().ok()
    }

    /// Sets the number of individuals of a generation, if that is one of the settings.
    pub fn set_population(&mut self, population: usize) {
        if let Some(found) = self.settings.get_mut("population") {
            *found = population.into();
        }
    }
}

/// Of any strategy: [`json_schema`](crate::schema::json_schema) fills in those that there are.
#[cfg(feature = "schema")]
impl schemars::JsonSchema for StrategySettings {
    fn schema_name() -> std::borrow::Cow<'static, str> {
        "StrategySettings".into()
    }

    fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
        schemars::json_schema!({
            "description": "The search, by name, with its settings.",
            "type": "object",
            "minProperties": 1,
            "maxProperties": 1,
            "additionalProperties": { "type": "object" },
        })
    }
}

impl Serialize for StrategySettings {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(1))?;
        map.serialize_entry(&self.name, &self.settings)?;
        map.end()
    }
}

impl<'de> Deserialize<'de> for StrategySettings {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let value = Value::deserialize(deserializer)?;
        let Value::Object(choice) = &value else {
            return Err(D::Error::custom(format!(
                "must be a strategy with its settings, such as {EXAMPLE}, found {value}"
            )));
        };
        match choice.iter().next() {
            Some((name, Value::Object(settings))) if choice.len() == 1 => {
                Ok(Self { name: name.clone(), settings: settings.clone() })
            }
            Some((name, other)) if choice.len() == 1 => {
                Err(D::Error::custom(format!("the settings of \"{name}\" must be an object, found {other}")))
            }
            _ => Err(D::Error::custom(format!("must be one strategy with its settings, such as {EXAMPLE}"))),
        }
    }
}

const EXAMPLE: &str = "{\"cma-es\": {}}";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strategy_may_have_no_settings() {
        let none = StrategySettings::new("dice", &());
        assert_eq!(none.of::<()>("dice"), Some(()));
        let written = serde_json::to_string(&none).expect("JSON");
        assert_eq!(written, r#"{"dice":{}}"#);
        assert_eq!(serde_json::from_str::<StrategySettings>(&written).expect("its own"), none);
    }
}
