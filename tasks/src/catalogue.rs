use crate::{
    Energy, FallEnds, Footfalls, Headway, Honest, Idleness, Jumping, Leap, Movement, Rollovers, Running, Sum,
    TimeAloft, Upright, Vibration,
};
use ne_core::SettingError;
use serde::{Deserialize, Serialize};
use std::{fmt, sync::Arc};

/// The movements that can be chosen by name: the built-in ones and those a program adds.
///
/// ```
/// use tasks::{MovementCatalogue, MovementSpec};
/// let catalogue = MovementCatalogue::default();
/// let spec: MovementSpec = serde_json::from_str(
///     r#"{ "name": "running", "terms": [{ "term": "energy", "weight": -0.001 }] }"#)?;
/// assert_eq!(catalogue.build(&spec)?.unit(), "m");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct MovementCatalogue {
    entries: Vec<MovementEntry>,
}

/// A movement that can be chosen by name.
#[derive(Clone)]
pub struct MovementEntry {
    /// Its name: lower case, hyphens.
    pub name: String,
    /// One sentence.
    pub description: String,
    /// The unit of its value.
    pub unit: String,
    /// How many steps its episodes last unless the settings say otherwise; `None` for a term that only makes sense
    /// beside a movement.
    pub steps: Option<u32>,
    make: Arc<dyn Fn() -> Box<dyn Movement> + Send + Sync>,
}

impl fmt::Debug for MovementEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MovementEntry").field("name", &self.name).field("steps", &self.steps).finish_non_exhaustive()
    }
}

/// A movement with its terms, as a configuration file has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct MovementSpec {
    /// The movement's name.
    pub name: String,
    /// Steps an episode lasts at most; `None` means the movement's own number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<u32>,
    /// What is added to the movement's value.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub terms: Vec<TermSpec>,
}

/// A weighted term.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TermSpec {
    /// Name of a movement.
    pub term: String,
    /// What its value is multiplied with, in the movement's unit per the term's; finite. Default 1.
    #[serde(default = "one")]
    pub weight: f64,
}

fn one() -> f64 {
    1.0
}

/// What can be wrong with a [`MovementSpec`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum MovementSpecError {
    /// There is no movement of this name.
    #[error("{field}: there is no movement or term \"{name}\"; there are: {}", known.join(", "))]
    Unknown {
        /// Where in the spec.
        field: String,
        /// The name asked for.
        name: String,
        /// The names there are.
        known: Vec<String>,
    },
    /// A number is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

impl Default for MovementCatalogue {
    /// The built-in movements and terms.
    fn default() -> Self {
        let mut catalogue = Self { entries: Vec::new() };
        let running = "distance the torso covers, forwards";
        let jumping = "height the torso reaches above its start";
        catalogue.add::<Running>(Some(2000), running).add::<Jumping>(Some(500), jumping);
        catalogue.add::<Energy>(None, "work of all motors; weigh it negatively");
        catalogue.add::<Rollovers>(None, "how often the torso turned over; weigh it negatively");
        catalogue.add::<FallEnds>(None, "ends the episode when the torso touches the ground; 1 if it did");
        catalogue.add::<TimeAloft>(None, "time without any part on the ground");
        catalogue.add::<Upright>(None, "ends the episode when the torso turns beyond 60°; 1 if it did");
        catalogue.add::<Footfalls>(None, "ends the episode when a leg is not used for 1.5 s; how many were not");
        catalogue.add::<Headway>(None, "ends the episode when there is no headway for 1 s; 1 if there was none");
        catalogue.add::<Honest>(None, "fails the evaluation of a body that lives on the errors of its physics");
        catalogue.add::<Vibration>(None, "reversals a second of joints, beyond what is smooth; weigh it negatively");
        catalogue
            .add::<Idleness>(None, "share of the motion expected of joints that they leave out; weigh it negatively");
        catalogue.add::<Leap>(None, "height of the torso above its start in a flight that all legs began together");
        catalogue
    }
}

impl MovementCatalogue {
    /// Adds a movement, or replaces the one of the same name. `steps` as in [`MovementEntry::steps`].
    pub fn add<M: Movement + Default + 'static>(&mut self, steps: Option<u32>, description: &str) -> &mut Self {
        self.add_with(steps, description, || Box::new(M::default()))
    }

    /// As [`add`](Self::add), for a movement that needs more than its default to be made.
    pub fn add_with(
        &mut self,
        steps: Option<u32>,
        description: &str,
        make: impl Fn() -> Box<dyn Movement> + Send + Sync + 'static,
    ) -> &mut Self {
        let sample = make();
        let (name, unit) = (sample.name().to_owned(), sample.unit().to_owned());
        self.entries.retain(|entry| entry.name != name);
        self.entries.push(MovementEntry { name, description: description.into(), unit, steps, make: Arc::new(make) });
        self
    }

    /// All entries, in the order they were added.
    pub fn entries(&self) -> &[MovementEntry] {
        &self.entries
    }

    /// The entry of this name.
    pub fn find(&self, name: &str) -> Option<&MovementEntry> {
        self.entries.iter().find(|entry| entry.name == name)
    }

    /// The movement a spec describes.
    ///
    /// # Errors
    /// If a name is unknown or a weight is not finite; the error names the field.
    pub fn build(&self, spec: &MovementSpec) -> Result<Box<dyn Movement>, MovementSpecError> {
        let movement = self.make("name".into(), &spec.name)?;
        if spec.terms.is_empty() {
            return Ok(movement);
        }
        let mut sum = Sum::of_boxed(movement);
        for (index, term) in spec.terms.iter().enumerate() {
            let field = |name| format!("terms[{index}].{name}");
            if !term.weight.is_finite() {
                return Err(SettingError::new(field("weight"), term.weight, "a finite number").into());
            }
            let earlier = spec.terms[..index].iter().map(|term| &term.term).chain([&spec.name]);
            if earlier.into_iter().any(|name| *name == term.term) {
                return Err(SettingError::new(field("term"), &term.term, "named once; add the weights up").into());
            }
            sum = sum.plus_boxed(term.weight, self.make(field("term"), &term.term)?);
        }
        Ok(Box::new(sum))
    }

    /// How many steps an episode of this spec lasts.
    ///
    /// # Errors
    /// If the name is unknown, if the movement is only a term and the spec gives no steps, or if they are not from 1 to
    /// 1,000,000.
    pub fn steps(&self, spec: &MovementSpec) -> Result<u32, MovementSpecError> {
        let entry = self.entry("name".into(), &spec.name)?;
        let Some(steps) = spec.steps.or(entry.steps) else {
            return Err(
                SettingError::new("steps", "nothing", "given, since this movement has no length of its own").into()
            );
        };
        SettingError::check_range("steps", f64::from(steps), 1.0, 1e6)?;
        Ok(steps)
    }

    fn make(&self, field: String, name: &str) -> Result<Box<dyn Movement>, MovementSpecError> {
        Ok((self.entry(field, name)?.make)())
    }

    fn entry(&self, field: String, name: &str) -> Result<&MovementEntry, MovementSpecError> {
        self.find(name).ok_or_else(|| {
            let known = self.entries.iter().map(|entry| entry.name.clone()).collect();
            MovementSpecError::Unknown { field, name: name.into(), known }
        })
    }
}
