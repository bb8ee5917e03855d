//! Creatures, terrains, variations and sensors by their names.

use crate::suggest;
use creatures::{Blueprint, Creature, CreatureError, Sense, Sensor, ShippedCreature, Terrain, TerrainEntry};
use envs_rapier::Variation;
use ne_core::{
    SettingError,
    field_path::{self, FieldError},
};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::{
    fmt,
    sync::{Arc, OnceLock},
};

/// Things of one kind that a configuration may name. What is built in is read when something is looked for first.
#[derive(Clone, Debug)]
pub struct Catalogue<T> {
    kind: &'static str,
    built_in: fn() -> Vec<Named<T>>,
    entries: OnceLock<Vec<Named<T>>>,
}

/// What a name stands for.
#[derive(Clone, Debug)]
pub struct Named<T> {
    /// The name.
    pub name: String,
    /// What it is, in a few words.
    pub description: String,
    /// What a configuration holds in its place.
    pub value: T,
}

impl<T> Named<T> {
    fn new(name: &str, description: &str, value: T) -> Self {
        Self { name: name.into(), description: description.into(), value }
    }
}

impl<T> Catalogue<T> {
    fn new(kind: &'static str, built_in: fn() -> Vec<Named<T>>) -> Self {
        Self { kind, built_in, entries: OnceLock::new() }
    }

    /// Adds a thing, or replaces the one of the same name.
    pub fn add(&mut self, name: &str, description: &str, value: T) -> &mut Self {
        let entry = Named::new(name, description, value);
        let mut entries = self.entries.take().unwrap_or_else(self.built_in);
        match entries.iter_mut().find(|entry| entry.name == name) {
            Some(found) => *found = entry,
            None => entries.push(entry),
        }
        self.entries = OnceLock::from(entries);
        self
    }

    /// All of them, in the order they were added.
    pub fn entries(&self) -> &[Named<T>] {
        self.entries.get_or_init(self.built_in)
    }

    /// The names, in the order they were added.
    pub fn names(&self) -> Vec<&str> {
        self.entries().iter().map(|entry| &*entry.name).collect()
    }

    /// What this name stands for.
    ///
    /// # Errors
    /// Says which names there are, and the nearest.
    pub fn find(&self, name: &str) -> Result<&T, UnknownName> {
        let found = self.entries().iter().find(|entry| entry.name == name);
        found.map(|entry| &entry.value).ok_or_else(|| UnknownName(suggest::unknown(self.kind, name, &self.names())))
    }
}

/// A name that nothing has, or that is not well-formed. The message says what is allowed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct UnknownName(String);

impl Default for Catalogue<Creature> {
    /// The shipped creatures.
    fn default() -> Self {
        Self::new("creature", || {
            let read = |shipped: &ShippedCreature| {
                let creature = Creature::from_json(shipped.json).expect("a test reads every shipped file");
                Named::new(shipped.name, &creature.title.clone(), creature)
            };
            creatures::shipped().iter().map(read).collect()
        })
    }
}

impl Catalogue<Creature> {
    /// Adds the creature of a file with this text, by the name in it, or replaces the one of the same name.
    ///
    /// # Errors
    /// If the creature is not valid.
    pub fn add_file(&mut self, json: &str) -> Result<&mut Self, CreatureError> {
        let creature = Blueprint::from_json(json)?.creature().clone();
        Ok(self.add(&creature.name.clone(), &creature.title.clone(), creature))
    }
}

impl Default for Catalogue<Terrain> {
    /// Those of the crate `creatures`. The first is the default of a configuration.
    fn default() -> Self {
        Self::new("terrain", || {
            let named = |entry: &TerrainEntry| Named::new(entry.name, entry.description, entry.terrain());
            creatures::TERRAINS.iter().map(named).collect()
        })
    }
}

impl Catalogue<Terrain> {
    /// The terrain that `NAME` or `NAME:DIFFICULTY` stands for, such as `gaps:0.5`.
    ///
    /// # Errors
    /// If there is none of this name, or the difficulty is none.
    pub fn terrain(&self, text: &str) -> Result<Terrain, UnknownName> {
        let (name, difficulty) = text.split_once(':').map_or((text, None), |(name, rest)| (name, Some(rest)));
        let mut terrain = self.find(name)?.clone();
        if let Some(found) = difficulty {
            let difficulty = found.trim().parse().map_err(|_| {
                UnknownName(format!("terrain \"{text}\": \"{found}\" is no difficulty; write it as in gaps:0.5"))
            })?;
            terrain = terrain.with_difficulty(difficulty);
        }
        terrain.validate().map_err(|error| UnknownName(format!("terrain.{error}")))?;
        // Flat ground has no difficulty; a file would only keep it for nothing.
        Ok(if terrain.is_flat() { Terrain::default() } else { terrain })
    }
}

impl Default for Catalogue<Variation> {
    fn default() -> Self {
        Self::new("variation", || {
            vec![
                Named::new("none", "every trial has the world of the settings", Variation::default()),
                Named::new("near", "worlds about one per cent away", Variation::near()),
                Named::new("pushed", "pushes of up to 0.3 m/s", Variation::pushed()),
                Named::new("shoved", "pushes of 0.27 to 0.53 m/s", Variation::shoved()),
                Named::new(
                    "light",
                    "friction, mass, start pose, pushes, and the hard half of other engines",
                    Variation::light(),
                ),
                Named::new(
                    "bumpy",
                    "as light, with bumps of up to 2 cm and up to 8 solver iterations",
                    Variation::bumpy(),
                ),
                Named::new("strong", "more than bumpy, in everything", Variation::strong()),
                Named::new("physics", "what physics engines differ in, and nothing of the body", Variation::physics()),
            ]
        })
    }
}

impl Catalogue<Variation> {
    /// The name of a variation, if it has one.
    pub fn name_of(&self, variation: &Variation) -> Option<&str> {
        self.entries().iter().find(|entry| entry.value == *variation).map(|entry| &*entry.name)
    }
}

/// How the sense of a sensor is made of its settings.
#[derive(Clone)]
pub struct MakeSense(Arc<Make>);

type Make = dyn Fn(&Map<String, Value>) -> Result<Arc<dyn Sense>, BadSettings> + Send + Sync;

/// Why no sense is made of some settings.
enum BadSettings {
    /// They are not those of the sensor.
    Unread(FieldError),
    /// One is out of range.
    OutOfRange(SettingError),
}

impl fmt::Debug for MakeSense {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("MakeSense")
    }
}

impl Default for Catalogue<MakeSense> {
    /// None: those of the crate `creatures` belong to the format of its files.
    fn default() -> Self {
        Self::new("custom sensor", Vec::new)
    }
}

impl Catalogue<MakeSense> {
    /// Adds a sensor, which creature files and configurations name as `{"custom": {"name": NAME, "settings": {}}}`. The
    /// sense is read from its settings: it derives `Deserialize` with `#[serde(default, deny_unknown_fields)]`.
    pub fn add_sense<S: Sense + DeserializeOwned + 'static>(&mut self, name: &str, description: &str) -> &mut Self {
        self.add_sense_with_settings(name, description, Ok::<S, _>)
    }

    /// As [`add_sense`](Self::add_sense), where the sense is made of its settings, which may be out of range: the error names the
    /// field, seen from the settings.
    pub fn add_sense_with_settings<T: DeserializeOwned, S: Sense + 'static>(
        &mut self,
        name: &str,
        description: &str,
        make: impl Fn(T) -> Result<S, SettingError> + Send + Sync + 'static,
    ) -> &mut Self {
        let make = move |settings: &Map<String, Value>| -> Result<Arc<dyn Sense>, BadSettings> {
            let settings = field_path::from_value(&Value::Object(settings.clone())).map_err(BadSettings::Unread)?;
            Ok(Arc::new(make(settings).map_err(BadSettings::OutOfRange)?))
        };
        self.add(name, description, MakeSense(Arc::new(make)))
    }

    /// These sensors, of which those of other crates tell of this body what they are named for.
    ///
    /// # Errors
    /// If a name or a setting is not known. The message says which sensor.
    pub fn telling(&self, sensors: &[Sensor], blueprint: &Blueprint) -> Result<Vec<Sensor>, UnknownName> {
        let tell = |(index, sensor): (usize, &Sensor)| {
            let Sensor::Custom(custom) = sensor else { return Ok(sensor.clone()) };
            let place = format!("sensors[{index}].custom");
            let make = self.find(&custom.name).map_err(|error| UnknownName(format!("{place}.name: {error}")))?;
            let sense = (make.0)(&custom.settings).map_err(|error| match error {
                BadSettings::Unread(FieldError { path, message, .. }) => {
                    let field = if path == "." { String::new() } else { format!(".{path}") };
                    UnknownName(format!("{place}.settings{field}: {}", suggest::explain(&message)))
                }
                BadSettings::OutOfRange(error) => UnknownName(error.within(&format!("{place}.settings")).to_string()),
            })?;
            Ok(Sensor::Custom(custom.clone().sensing(sense, blueprint)))
        };
        sensors.iter().enumerate().map(tell).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use creatures::{BodyView, Channel};

    #[test]
    fn terrains_are_named_with_their_difficulty() {
        let terrains = Catalogue::<Terrain>::default();
        let named = |text: &str| terrains.terrain(text).expect("known");
        for entry in terrains.entries() {
            assert_eq!((named(&entry.name), entry.value.validate()), (entry.value.clone(), Ok(())));
        }
        assert_eq!(named("gaps:0.25"), named("gaps").with_difficulty(0.25));
        assert!(named("flat:0.7").is_default());
        for (text, says) in [
            ("gasp", "there is no terrain \"gasp\"; did you mean \"gaps\"? (there are: flat, gaps, hurdles, "),
            ("gaps:hard", "terrain \"gaps:hard\": \"hard\" is no difficulty; write it as in gaps:0.5"),
            ("gaps:2", "terrain.difficulty = 2: must be from 0 to 1"),
            ("gaps:NaN", "terrain.difficulty = NaN: must be from 0 to 1"),
        ] {
            let error = terrains.terrain(text).expect_err(says).to_string();
            assert!(error.starts_with(says), "{error}");
        }
    }

    /// How far the torso leans, as a share of `most`.
    struct Lean {
        most: f32,
    }

    impl Sense for Lean {
        fn channels(&self, _: &Blueprint) -> Vec<Channel> {
            vec![Channel { name: "lean".into(), unit: "", range: [0.0, 1.0] }]
        }
        fn read(&self, body: &dyn BodyView, _: usize) -> f32 {
            body.torso_rotation().abs() / self.most
        }
    }

    #[derive(serde::Deserialize)]
    #[serde(deny_unknown_fields)]
    struct LeanSettings {
        most: f32,
    }

    #[test]
    fn settings_of_a_sensor_are_checked_by_it() {
        let mut sensors = Catalogue::<MakeSense>::default();
        sensors.add_sense_with_settings("lean", "how far the torso leans", |LeanSettings { most }| {
            SettingError::check_range("most", most, 0.1, 3.0).map(|()| Lean { most })
        });
        let blueprint = Blueprint::new(creatures::find("biped-1").expect("it is shipped")).expect("valid");
        let told = |settings: &str| {
            let sensor = format!(r#"{{"custom": {{"name": "lean", "settings": {settings}}}}}"#);
            let sensor = serde_json::from_str(&sensor).expect("a sensor");
            sensors.telling(&[sensor], &blueprint).map(|_| ()).map_err(|error| error.to_string())
        };
        assert_eq!(told(r#"{"most": 0.5}"#), Ok(()));
        for (settings, says) in [
            (r#"{"most": -1}"#, "sensors[0].custom.settings.most = -1: must be from 0.1 to 3"),
            (
                r#"{"mots": 1}"#,
                "sensors[0].custom.settings.mots: unknown field `mots`, expected `most`; did you mean `most`?",
            ),
        ] {
            assert_eq!(told(settings), Err(says.into()));
        }
    }

    #[test]
    fn what_is_added_is_found_and_replaces_what_had_its_name() {
        let mut variations = Catalogue::<Variation>::default();
        let icy = Variation { friction: 0.9, ..Variation::default() };
        variations.add("icy", "any friction", icy);
        assert_eq!((variations.find("icy"), variations.name_of(&icy)), (Ok(&icy), Some("icy")));
        variations.add("icy", "as light", Variation::light());
        assert_eq!(variations.find("icy"), Ok(&Variation::light()));
        assert_eq!(variations.name_of(&icy), None);

        let mut creatures = Catalogue::<Creature>::default();
        assert_eq!(creatures.names(), creatures::shipped().iter().map(|it| it.name).collect::<Vec<_>>());
        assert!(creatures.add_file("{}").is_err());
        let json = creatures::shipped()[1].json.replacen("biped-1", "walker", 1);
        creatures.add_file(&json).expect("valid");
        assert_eq!(creatures.find("walker").expect("it was added").name, "walker");
    }
}
