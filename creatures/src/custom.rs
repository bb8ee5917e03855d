//! Sensors that other crates add.

use crate::{BodyView, Channel};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};
use std::{fmt, sync::Arc};

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
    told: Option<Told>,
}

/// The value of a channel.
type Read = dyn Fn(&dyn BodyView, usize) -> f32 + Send + Sync;

/// The channels of a sensor in one body, and how they are read.
#[derive(Clone)]
pub(crate) struct Told {
    pub(crate) channels: Vec<Channel>,
    pub(crate) read: Arc<Read>,
}

impl CustomSensor {
    /// A sensor that tells nothing yet.
    pub fn new(name: &str) -> Self {
        Self { name: name.into(), settings: Map::new(), told: None }
    }

    /// The same sensor, which tells these channels of a body; see [`sensing`](Self::sensing).
    /// [`Senses::new`](crate::Senses::new) refuses one that tells nothing.
    #[must_use]
    pub fn telling(
        self,
        channels: Vec<Channel>,
        read: impl Fn(&dyn BodyView, usize) -> f32 + Send + Sync + 'static,
    ) -> Self {
        Self { told: Some(Told { channels, read: Arc::new(read) }), ..self }
    }

    pub(crate) fn told(&self) -> Option<&Told> {
        self.told.as_ref()
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
