//! Sensors that other crates add.

use crate::{Blueprint, BodyView, Channel};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::{fmt, sync::Arc};

/// What a sensor of another crate tells, and how. It knows a body as [`BodyView`] shows it, and remembers nothing.
pub trait Sense: Send + Sync {
    /// Its channels in a body, at least one; each with a range of two finite numbers, the smaller first. Names say what is
    /// sensed of which part, and no two of a creature are alike.
    fn channels(&self, blueprint: &Blueprint) -> Vec<Channel>;

    /// The raw value of a channel, in the order of [`channels`](Self::channels). Equal bodies give equal bits; nothing is
    /// allocated. Scaling and clamping are done for you.
    fn read(&self, body: &dyn BodyView, channel: usize) -> f32;
}

/// A sensor of another crate, by its name. A file holds name and settings; the program that reads it has to know the sense.
#[derive(Clone, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CustomSensor {
    /// The name under which the program knows it.
    pub name: String,
    /// Its settings; none by default.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub settings: Map<String, Value>,
    #[serde(skip)]
    sense: Option<Arc<dyn Sense>>,
}

impl CustomSensor {
    /// A sensor that tells nothing yet.
    pub fn new(name: &str) -> Self {
        Self { name: name.into(), settings: Map::new(), sense: None }
    }

    /// The same sensor, which tells this. [`Senses::new`](crate::Senses::new) refuses one that tells nothing.
    #[must_use]
    pub fn telling(self, sense: Arc<dyn Sense>) -> Self {
        Self { sense: Some(sense), ..self }
    }

    pub(crate) fn sense(&self) -> Option<&Arc<dyn Sense>> {
        self.sense.as_ref()
    }
}

/// As files have it: name and settings say what it is.
impl PartialEq for CustomSensor {
    fn eq(&self, other: &Self) -> bool {
        (&self.name, &self.settings) == (&other.name, &other.settings)
    }
}

impl fmt::Debug for CustomSensor {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("CustomSensor").field("name", &self.name).field("settings", &self.settings).finish()
    }
}
