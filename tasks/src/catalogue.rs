use crate::gait::{JumpingRules, PlayingRules, Rules, RunningRules, SwimmingRules};
use crate::{
    Alternation, Backwards, Carrying, Climbing, Cruising, Energy, FallEnds, Footfalls, GettingUp, Haste, Headway,
    Hopping, Idleness, Jumping, Landing, Leap, LongJump, Movement, NoExploits, Objectives, Playing, Posture, Rhythm,
    Rollovers, Running, Slip, Standing, Sum, Swimming, TimeAloft, Upright, Vibration, Walking,
};
use ne_core::{
    SettingError,
    field_path::{self, FieldError},
};
use serde::{Deserialize, Serialize, de::DeserializeOwned};
use serde_json::{Map, Value};
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
    /// What it is done in.
    pub medium: Medium,
    /// By which rules its gaits are judged; `None` if they are measured and audited alone.
    pub rules: Option<Arc<dyn Rules>>,
    make: Arc<Make>,
}

/// What a movement is done in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    /// On the ground.
    Ground,
    /// In water, which has no ground.
    Water,
}

/// Makes a movement with these settings. Fields in errors are seen from the settings.
type Make = dyn Fn(&MovementSettings) -> Result<Box<dyn Movement>, MovementSpecError> + Send + Sync;

/// Settings of a movement or a term, as a configuration file has them: a JSON object.
pub type MovementSettings = Map<String, Value>;

impl MovementEntry {
    /// Puts the movement into water.
    pub fn in_water(&mut self) -> &mut Self {
        self.medium = Medium::Water;
        self
    }

    /// Has its gaits judged by these rules.
    pub fn judged_by(&mut self, rules: impl Rules + 'static) -> &mut Self {
        self.rules = Some(Arc::new(rules));
        self
    }
}

impl fmt::Debug for MovementEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("MovementEntry").field("name", &self.name).field("steps", &self.steps).finish_non_exhaustive()
    }
}

/// A movement with its terms, as a configuration file has it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct MovementSpec {
    /// The movement's name.
    pub name: String,
    /// Steps an episode lasts at most, from 1 to 1,000,000; `None` means the movement's own number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1_000_000)))]
    pub steps: Option<u32>,
    /// Settings of its own; what is left out has its default.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub settings: MovementSettings,
    /// What is added to the movement's value.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub terms: Vec<TermSpec>,
    /// What is measured beside the fitness for a strategy that searches for several objectives at once: none, or from 2
    /// to 4 different ones. They are maximised, so that what is to be small has a weight below 0.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "schema", schemars(length(max = 4)))]
    pub objectives: Vec<TermSpec>,
}

/// A weighted term.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct TermSpec {
    /// Name of a movement.
    pub term: String,
    /// What its value is multiplied with, in the movement's unit per the term's; finite. Default 1.
    #[serde(default = "one")]
    pub weight: f64,
    /// Settings of its own; what is left out has its default.
    #[serde(default, skip_serializing_if = "Map::is_empty")]
    pub settings: MovementSettings,
}

fn one() -> f64 {
    1.0
}

/// What can be wrong with a [`MovementSpec`].
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
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
    /// A setting is unknown, missing or of the wrong type.
    #[error("{field}: {message}")]
    Settings {
        /// Where in the spec.
        field: String,
        /// What is wrong.
        message: String,
    },
    /// A number is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
}

impl MovementSpec {
    /// A movement by its name, as it is: with the length, the settings and the terms it has by itself.
    pub fn new(name: &str) -> Self {
        Self { name: name.into(), steps: None, settings: Map::new(), terms: Vec::new(), objectives: Vec::new() }
    }
}

impl TermSpec {
    /// A term by its name, with its weight and the settings it has by itself.
    pub fn new(term: &str, weight: f64) -> Self {
        Self { term: term.into(), weight, settings: Map::new() }
    }
}

impl MovementSpecError {
    /// The same error, with the field seen from further out: `speed` within `settings` is `settings.speed`.
    fn within(self, parent: &str) -> Self {
        match self {
            Self::Setting(error) => error.within(parent).into(),
            Self::Settings { field, message } if field.is_empty() => Self::Settings { field: parent.into(), message },
            Self::Settings { field, message } => Self::Settings { field: format!("{parent}.{field}"), message },
            Self::Unknown { field, name, known } => Self::Unknown { field: format!("{parent}.{field}"), name, known },
        }
    }
}

impl Default for MovementCatalogue {
    /// The built-in movements and terms.
    fn default() -> Self {
        let mut catalogue = Self { entries: Vec::new() };
        let running = "distance the torso covers, forwards";
        let jumping = "height the torso reaches above its start";
        // The speed of a walk is a setting, and hopping, standing and getting up have no rules yet that a game agrees on.
        catalogue.add::<Running>(Some(2000), running).judged_by(RunningRules::default());
        catalogue.add::<Jumping>(Some(500), jumping).judged_by(JumpingRules);
        // What gets far without getting high off all legs is a stride.
        let longest = "distance the torso covers in its longest flight";
        catalogue.add::<LongJump>(Some(500), longest).judged_by(JumpingRules);
        catalogue.add::<Hopping>(Some(1000), "heights of all hops on the spot, added up");
        catalogue.add_with_settings(
            Some(2000),
            "distance covered at a walk; settings: speed, body lengths/s (1)",
            Walking::new,
        );
        catalogue
            .add_with_settings(
                Some(2000),
                "distance at a wanted speed, discounted by its cost of transport; settings: speed, body lengths/s (2)",
                Cruising::new,
            )
            .judged_by(RunningRules::default());
        catalogue.add_with_settings(
            Some(1000),
            "time it stands still and upright; settings: after, s (2), from when on",
            Standing::new,
        );
        let climbing = "height of the ground the feet reach, and a fifth of the distance";
        catalogue.add::<Climbing>(Some(2000), climbing).judged_by(RunningRules::default());
        catalogue.add_with_settings(
            Some(1000),
            "how far a creature that starts lying is up at the end; settings: turn, degrees (180), to upright",
            GettingUp::new,
        );
        let carrying = "distance covered with a torso that neither tilts nor shakes";
        catalogue.add::<Carrying>(Some(2000), carrying).judged_by(RunningRules::default());
        let backwards = "distance the torso covers, backwards";
        catalogue.add::<Backwards>(Some(2000), backwards).judged_by(RunningRules { backwards: true });
        catalogue.add_with_settings(
            Some(1000),
            "time it does as it is told: a speed, standing still, a jump; settings: jump, s (1.5), what one is worth",
            Playing::new,
        )
        .judged_by(PlayingRules);
        let swimming = "distance the centre of mass covers in water, forwards";
        catalogue.add::<Swimming>(Some(1000), swimming).in_water().judged_by(SwimmingRules);
        catalogue.add::<Energy>(None, "work of all motors; weigh it negatively");
        catalogue.add::<Rollovers>(None, "how often the torso turned over; weigh it negatively");
        catalogue.add::<FallEnds>(None, "ends the episode when the torso touches the ground; 1 if it did");
        catalogue.add::<TimeAloft>(None, "time without any part on the ground");
        catalogue.add::<Upright>(None, "ends the episode when the torso turns beyond 60°; 1 if it did");
        catalogue.add_with_settings(
            None,
            "way made tilted (by the square of the tilt), too low or with more than feet on the ground; weigh it negatively; \
             ends the episode when far out; settings: tilt (40) and margin (20), degrees, height (0.65), brush, s (0.2)",
            Posture::new,
        );
        catalogue.add::<Slip>(None, "how far feet slide, beyond 0.2 m a metre; weigh it negatively");
        catalogue.add_with_settings(
            None,
            "way made out of rhythm; weigh it negatively; settings: period, s (0.5), of a stride",
            Rhythm::new,
        );
        catalogue.add_with_settings(
            None,
            "way beyond what a wanted speed gives; weigh it negatively; settings: speed, body lengths/s (2)",
            Haste::new,
        );
        catalogue.add::<Footfalls>(
            None,
            "way made while legs were not used for 0.9 s, by their share; weigh it negatively; ends the episode when half \
             of them are idle",
        );
        catalogue.add::<Alternation>(None, "way made by steps of two legs that do not take turns; weigh it negatively");
        catalogue.add_with_settings(
            None,
            "ends the episode when there is no headway for 1 s; 1 if there was none; settings: backwards (false)",
            Headway::new,
        );
        catalogue.add_with_settings(
            None,
            "fails the evaluation of a body that lives on the errors of its physics; settings: ends (false), the episode \
             ends instead, and it is 1: weigh it negatively, or with 0",
            NoExploits::new,
        );
        catalogue.add::<Vibration>(None, "reversals a second of joints, beyond what is smooth; weigh it negatively");
        catalogue
            .add::<Idleness>(None, "share of the motion expected of joints that they leave out; weigh it negatively");
        catalogue.add::<Leap>(
            None,
            "rise of the centre of mass in a flight that all legs began together and the body landed",
        );
        catalogue.add::<Landing>(None, "time after the first leap that the body stands, or leaps on");
        catalogue
    }
}

impl MovementCatalogue {
    /// Adds a movement, or replaces the one of the same name, with its rules and its medium. `steps` as in [`MovementEntry::steps`].
    pub fn add<M: Movement + Default + 'static>(
        &mut self,
        steps: Option<u32>,
        description: &str,
    ) -> &mut MovementEntry {
        self.add_with(steps, description, || Box::new(M::default()))
    }

    /// As [`add`](Self::add), for a movement that needs more than its default to be made.
    pub fn add_with(
        &mut self,
        steps: Option<u32>,
        description: &str,
        make: impl Fn() -> Box<dyn Movement> + Send + Sync + 'static,
    ) -> &mut MovementEntry {
        let sample = make();
        let name = sample.name().to_owned();
        let plain = move |settings: &MovementSettings| match settings.keys().next() {
            None => Ok(make()),
            Some(field) => {
                let message = format!("unknown field; \"{name}\" has no settings");
                Err(MovementSpecError::Settings { field: field.clone(), message })
            }
        };
        self.insert(&*sample, steps, description, Arc::new(plain))
    }

    /// As [`add`](Self::add), for a movement with settings, which are read from the `settings` of a [`MovementSpec`] or a
    /// [`TermSpec`]. `configure` checks them and makes the movement; the movement's default is what it is without any.
    ///
    /// Settings derive `Deserialize` with `#[serde(default, deny_unknown_fields)]`: a file need not say all of them, and
    /// a misspelt one is an error. The fields of `configure`'s errors are seen from the settings.
    ///
    /// ```
    /// use ne_core::SettingError;
    /// use serde::Deserialize;
    /// use tasks::{Movement, MovementCatalogue, MovementSpec, Snapshot, Verdict};
    ///
    /// #[derive(Default, Deserialize)]
    /// #[serde(default, deny_unknown_fields)]
    /// struct Goal { x: f64 }
    ///
    /// /// How far the torso is from a goal, m.
    /// #[derive(Clone, Default)]
    /// struct Approach { goal: f64, x: f64 }
    /// impl Approach {
    ///     fn new(goal: Goal) -> Result<Self, SettingError> {
    ///         SettingError::check_range("x", goal.x, -100.0, 100.0)?;
    ///         Ok(Self { goal: goal.x, x: 0.0 })
    ///     }
    /// }
    /// impl Movement for Approach {
    ///     fn name(&self) -> &str { "approach" }
    ///     fn unit(&self) -> &str { "m" }
    ///     fn begin(&mut self, start: &Snapshot) { self.x = start.torso().x.into() }
    ///     fn observe(&mut self, now: &Snapshot) -> Verdict { self.x = now.torso().x.into(); Verdict::GoOn }
    ///     fn value(&self) -> f64 { -(self.goal - self.x).abs() }
    /// }
    ///
    /// let mut catalogue = MovementCatalogue::default();
    /// catalogue.add_with_settings(Some(500), "how near the torso is to a goal", Approach::new);
    /// let spec: MovementSpec = serde_json::from_str(r#"{ "name": "approach", "settings": { "x": 101 } }"#)?;
    /// let error = catalogue.build(&spec).err().ok_or("it is too far")?;
    /// assert_eq!(error.to_string(), "settings.x = 101: must be from -100 to 100");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn add_with_settings<M: Movement + Default + 'static, S: DeserializeOwned>(
        &mut self,
        steps: Option<u32>,
        description: &str,
        configure: impl Fn(S) -> Result<M, SettingError> + Send + Sync + 'static,
    ) -> &mut MovementEntry {
        let make = move |settings: &MovementSettings| -> Result<Box<dyn Movement>, MovementSpecError> {
            Ok(Box::new(configure(parse(settings)?)?))
        };
        self.insert(&M::default(), steps, description, Arc::new(make))
    }

    fn insert(
        &mut self,
        sample: &dyn Movement,
        steps: Option<u32>,
        description: &str,
        make: Arc<Make>,
    ) -> &mut MovementEntry {
        let (name, unit) = (sample.name().to_owned(), sample.unit().to_owned());
        self.entries.retain(|entry| entry.name != name);
        let (description, medium, rules) = (description.into(), Medium::Ground, None);
        let place = self.entries.len();
        self.entries.push(MovementEntry { name, description, unit, steps, medium, rules, make });
        &mut self.entries[place]
    }

    /// The rules by which gaits of the movement of this name are judged; `None` if they are not, or there is none.
    pub fn rules(&self, name: &str) -> Option<Arc<dyn Rules>> {
        self.find(name)?.rules.clone()
    }

    /// The movements whose gaits are judged.
    pub fn judged(&self) -> impl Iterator<Item = &str> {
        self.entries.iter().filter(|entry| entry.rules.is_some()).map(|entry| &*entry.name)
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
    /// If a name or a setting is unknown, a setting is of the wrong type or out of range, a weight is not finite, or the
    /// objectives are not as [`MovementSpec::objectives`] says; the error names the field.
    pub fn build(&self, spec: &MovementSpec) -> Result<Box<dyn Movement>, MovementSpecError> {
        let movement = self.sum(spec)?;
        if spec.objectives.is_empty() {
            return Ok(movement);
        }
        if !(2..=4).contains(&spec.objectives.len()) {
            let found = format!("{} objectives", spec.objectives.len());
            return Err(SettingError::new("objectives", found, "from 2 to 4 objectives, or none").into());
        }
        let mut objectives = Objectives::beside(movement);
        for (index, objective) in spec.objectives.iter().enumerate() {
            let field = |name| format!("objectives[{index}].{name}");
            if !objective.weight.is_finite() || objective.weight == 0.0 {
                let error = SettingError::new(field("weight"), objective.weight, "a finite number other than 0");
                return Err(error.into());
            }
            if spec.objectives[..index].iter().any(|earlier| earlier.term == objective.term) {
                return Err(SettingError::new(field("term"), &objective.term, "named once").into());
            }
            objectives = objectives.and(
                objective.weight,
                self.make(field("term"), &objective.term, &objective.settings, &field("settings"))?,
            );
        }
        Ok(Box::new(objectives))
    }

    /// The movement with its terms.
    fn sum(&self, spec: &MovementSpec) -> Result<Box<dyn Movement>, MovementSpecError> {
        let movement = self.make("name".into(), &spec.name, &spec.settings, "settings")?;
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
            let made = self.make(field("term"), &term.term, &term.settings, &field("settings"))?;
            sum = sum.plus_boxed(term.weight, made);
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
        SettingError::check_range("steps", steps, 1.0, 1e6)?;
        Ok(steps)
    }

    /// The movement of this name, which stands in `field`, with its settings, which stand in `settings_field`.
    fn make(
        &self,
        field: String,
        name: &str,
        settings: &MovementSettings,
        settings_field: &str,
    ) -> Result<Box<dyn Movement>, MovementSpecError> {
        (self.entry(field, name)?.make)(settings).map_err(|error| error.within(settings_field))
    }

    fn entry(&self, field: String, name: &str) -> Result<&MovementEntry, MovementSpecError> {
        self.find(name).ok_or_else(|| {
            let known = self.entries.iter().map(|entry| entry.name.clone()).collect();
            MovementSpecError::Unknown { field, name: name.into(), known }
        })
    }
}

/// Reads settings of their own type from what a file says.
fn parse<S: DeserializeOwned>(settings: &MovementSettings) -> Result<S, MovementSpecError> {
    field_path::from_value(&Value::Object(settings.clone())).map_err(|FieldError { path, message, .. }| {
        let field = if path == "." { String::new() } else { path };
        MovementSpecError::Settings { field, message }
    })
}
