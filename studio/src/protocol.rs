//! What a page and the studio say to each other. A message is JSON; only what moves comes as [numbers](crate::Arena::frame).

use crate::scene::Scene;
use creatures::{Creature, Problem};
use gambol_reports::page::{ground::GroundData, network::NetworkData};
use gambol_runs::{Registry, champion::Champion, config::RunConfig, episode_parts::SetupError, gait};
use ne_core::{Failure, GenerationReport};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use tasks::gait::Judgement;

/// What a page asks for.
#[derive(Clone, Debug, Deserialize)]
#[serde(tag = "do", rename_all = "kebab-case", deny_unknown_fields)]
pub enum Request {
    /// What can be chosen, and what there is.
    Look,
    /// What every setting is: the JSON Schema of a configuration.
    Schema,
    /// What a choice comes to, before anything is trained.
    Describe {
        /// The choice.
        choice: Box<Choice>,
    },
    /// What is wrong with a creature that is being drawn.
    Check {
        /// The creature, as in a file.
        creature: Value,
        /// Comes back with the answer.
        number: u64,
    },
    /// Keep a creature that was drawn.
    Keep {
        /// The creature, as in a file.
        creature: Value,
    },
    /// Begin a run, and open it.
    Train {
        /// What is trained.
        choice: Box<Choice>,
    },
    /// From now on this run is what the page sees.
    Open {
        /// The name of its folder.
        run: String,
    },
    /// From now on this champion, from a file of the user's, is what the page sees.
    OpenChampion {
        /// What the file is called.
        name: String,
        /// Its text: as numbers of JavaScript it would be another file.
        text: String,
    },
    /// Let the open run wait before its next generation.
    Pause,
    /// Let it go on: from a pause, or from where it had stopped.
    GoOn {
        /// More generations than it had planned.
        #[serde(default)]
        generations: Option<u64>,
    },
    /// Let one generation pass, then wait.
    Step,
    /// Save and end it.
    Stop,
    /// Put these into an arena, in place of those that are in it.
    Show {
        /// Which creatures.
        who: Who,
        /// On another terrain than that of the run: a name, or `NAME:DIFFICULTY`.
        #[serde(default)]
        terrain: Option<String>,
        /// With another friction of the ground than that of the run.
        #[serde(default)]
        friction: Option<f32>,
    },
    /// Put these into an arena, as another viewer has sent them.
    Enter {
        /// What is to be shown.
        scene: Box<Scene>,
    },
    /// Let so many steps pass in the arena, and show it.
    Advance {
        /// How many.
        steps: u32,
    },
    /// What the bodies in the arena are told to do.
    Tell(Told),
    /// Push the first body in the arena.
    Push {
        /// Which part.
        part: usize,
        /// What is added to its velocity, m/s.
        velocity: [f32; 2],
    },
    /// Turn gravity, and make it so many times as strong.
    Tilt {
        /// To the right, rad.
        angle: f32,
        /// How many times as strong.
        factor: f32,
    },
    /// Put a box in the way.
    PutBox {
        /// Its middle, m.
        x: f32,
        /// m.
        width: f32,
        /// m.
        height: f32,
    },
}

/// Which creatures an arena shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Who {
    /// The latest generation, the best first.
    Population,
    /// The champion.
    Champion,
    /// The champion, and as its ghost the one that was shown before it.
    Champions,
}

/// What a body is told to do.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Told {
    /// body lengths/s.
    pub speed: f32,
    /// Whether the button is held.
    pub jump: bool,
}

/// What is to be trained, in names and settings.
#[derive(Clone, Debug, Default, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Choice {
    /// A creature that has a name; needed if none is drawn.
    pub creature: Option<String>,
    /// A creature that was drawn, as in a file.
    pub drawn: Option<Value>,
    /// The movement's name.
    pub movement: String,
    /// The preset; by default the first.
    pub preset: Option<String>,
    /// The strategy; by default the preset's.
    pub strategy: Option<String>,
    /// The terrain, `NAME` or `NAME:DIFFICULTY`; by default flat.
    pub terrain: Option<String>,
    /// The variation; by default the preset's.
    pub variation: Option<String>,
    /// The seed; by default the preset's.
    pub seed: Option<u64>,
    /// When to end, in generations; by default as the preset has it.
    pub generations: Option<u64>,
    /// Single settings, `key=value`.
    pub set: Vec<String>,
}

/// What the studio tells a page, asked or not.
#[derive(Clone, Debug, Serialize)]
#[serde(tag = "is", rename_all = "kebab-case")]
pub enum Event {
    /// What can be chosen, and what there is.
    Catalogue(Box<Catalogue>),
    /// What every setting is.
    Schema {
        /// The JSON Schema of a configuration.
        schema: Value,
    },
    /// What a choice comes to.
    Described(Box<Described>),
    /// What is wrong with a creature.
    Checked {
        /// The number it was asked with.
        number: u64,
        /// Empty: nothing.
        problems: Vec<Mistake>,
    },
    /// The run that is open now.
    Opened(Box<Opened>),
    /// How the open run stands.
    State(RunState),
    /// Generations of the open run that have not been told yet.
    Generations {
        /// In order.
        rows: Vec<GenerationReport>,
    },
    /// A stage of the open run has begun.
    Stage {
        /// Its name.
        name: String,
        /// Before which row of the history.
        row: usize,
    },
    /// The gait of the champion, judged.
    Verdict(Verdict),
    /// What is to be shown, for a page whose arena is elsewhere.
    Scene {
        /// What it takes.
        scene: Box<Scene>,
    },
    /// What is in the arena now.
    Arena {
        /// The number that its frames begin with.
        number: u32,
        /// Which creatures they are: `population` or `champion`.
        who: &'static str,
        /// The generation they are of.
        generation: u64,
        /// The fitness of each; `null` if it failed.
        fitness: Vec<Option<f64>>,
        /// The rest.
        #[serde(flatten)]
        data: Box<ArenaData>,
    },
    /// The ground of the arena has changed.
    Ground {
        /// `null`: flat.
        ground: Option<GroundData>,
    },
    /// What was asked for cannot be done.
    Refused {
        /// What was asked for.
        request: String,
        /// Why, in the words of the library.
        reason: String,
    },
}

/// What there is to choose from.
#[derive(Clone, Debug, Serialize)]
pub struct Catalogue {
    /// Creatures by name.
    pub creatures: Vec<Creature>,
    /// Those of them that were drawn here.
    pub drawn: Vec<String>,
    /// Movements with what they are.
    pub movements: Vec<NamedThing>,
    /// Presets.
    pub presets: Vec<NamedThing>,
    /// Strategies.
    pub strategies: Vec<NamedThing>,
    /// Terrains.
    pub terrains: Vec<NamedThing>,
    /// Variations.
    pub variations: Vec<NamedThing>,
    /// Formats of exports.
    pub formats: Vec<ExportFormat>,
    /// Runs, the latest first.
    pub runs: Vec<RunEntry>,
}

/// What a champion can be exported to.
#[derive(Clone, Debug, Serialize)]
pub struct ExportFormat {
    /// Its name.
    pub name: &'static str,
    /// How the names of its files end.
    pub endings: &'static [&'static str],
}

/// A name that can be chosen.
#[derive(Clone, Debug, Serialize)]
pub struct NamedThing {
    /// The name.
    pub name: String,
    /// What it is.
    pub description: String,
}

/// A run in the gallery.
#[derive(Clone, Debug, Serialize)]
pub struct RunEntry {
    /// The name of its folder.
    pub run: String,
    /// The creature.
    pub creature: Creature,
    /// The movement.
    pub movement: String,
    /// The fitness of its champion, if it has one.
    pub fitness: Option<f64>,
    /// Whether it is being trained here.
    pub is_running: bool,
}

/// What a choice comes to.
#[derive(Clone, Debug, Serialize)]
pub struct Described {
    /// The configuration; `None` if something is wrong.
    pub config: Option<RunConfig>,
    /// The same without the single settings.
    pub preset: Option<RunConfig>,
    /// What is wrong, in the words of the library.
    pub problem: Option<String>,
    /// The command line that does the same.
    pub command: String,
}

/// A problem of a creature.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// The field, such as `parts[2].shape`; empty if it is about the whole.
    #[serde(rename = "where")]
    pub place: String,
    /// What is wrong.
    pub message: String,
}

impl From<&Problem> for Mistake {
    fn from(problem: &Problem) -> Self {
        let message = problem.to_string();
        // A problem's text begins with its field.
        let place = message.split_once(": ").map_or("", |(place, _)| place);
        let is_field = place.starts_with(|first: char| first.is_ascii_lowercase()) && !place.contains(' ');
        Self { place: if is_field { place.to_owned() } else { String::new() }, message }
    }
}

/// A run that was opened.
#[derive(Clone, Debug, Serialize)]
pub struct Opened {
    /// The name of its folder.
    pub run: String,
    /// Its configuration.
    pub config: RunConfig,
    /// The unit of its fitness.
    pub unit: String,
    /// The command line that does the same.
    pub command: String,
    /// How it stands.
    pub state: RunState,
}

/// What `gambol gait` says of a champion.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verdict {
    /// The champion's generation.
    pub generation: u64,
    /// Whether the gait is usable; `null` where gaits are not judged.
    pub usable: Option<bool>,
    /// What speaks against it, in words.
    pub against: Vec<String>,
    /// In how many near worlds it is usable, and of how many.
    pub near_worlds: Option<[u64; 2]>,
}

impl Verdict {
    /// Judges a champion as it moves in rapier.
    pub fn of(champion: &Champion, registry: &Registry) -> Self {
        let generation = champion.generation;
        match gait::judge(champion, registry) {
            Ok(report) => {
                let flagged = report.cheats.iter().map(ToString::to_string);
                let reasons = |judgement: &Judgement| judgement.reasons.iter().map(ToString::to_string).collect();
                let near = report.verdict.as_ref().and_then(|verdict| verdict.near_worlds);
                Self {
                    generation,
                    usable: report.verdict.as_ref().map(|verdict| verdict.usable),
                    against: report.verdict.as_ref().map_or_else(|| flagged.collect(), reasons),
                    near_worlds: near.map(|near| [near.usable as u64, near.worlds as u64]),
                }
            }
            Err(error) => Self { generation, usable: Some(false), against: vec![error.to_string()], near_worlds: None },
        }
    }
}

/// How a run stands.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[serde(tag = "state", rename_all = "kebab-case")]
pub enum RunState {
    /// It is being trained here.
    Running,
    /// It waits here for a word.
    Paused,
    /// It is saved, and nothing happens.
    Ended {
        /// Why.
        reason: String,
    },
    /// It broke off.
    Broken {
        /// Why.
        reason: String,
    },
}

/// What a page needs to draw an arena.
#[derive(Clone, Debug, Serialize)]
pub struct ArenaData {
    /// The body of all.
    pub creature: Creature,
    /// How many there are.
    pub actors: usize,
    /// How many parts each has.
    pub parts: usize,
    /// Seconds a step takes.
    pub time_step: f32,
    /// `null`: flat.
    pub ground: Option<GroundData>,
    /// Whether it does what it is told.
    pub follows_commands: bool,
    /// The net of the first.
    pub network: NetworkData,
}

/// Why something cannot be shown, or not be done to what is shown.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ArenaError {
    /// The world cannot be built.
    #[error(transparent)]
    World(#[from] SetupError),
    /// There is no creature to show.
    #[error("there is nothing to show yet")]
    Empty,
    /// A net is not made for the body.
    #[error("a net is not made for this body, which has {inputs} inputs and {outputs} outputs")]
    Shape {
        /// What the body has.
        inputs: usize,
        /// What the body has.
        outputs: usize,
    },
    /// The body does not come to rest.
    #[error("the body does not come to rest: {0}")]
    Start(#[from] Failure),
    /// A push that cannot be.
    #[error("a push must be at a part of the body, of at most 50 m/s")]
    Push,
    /// A gravity that cannot be.
    #[error("gravity can be turned by up to half a turn, and be from 0 to 5 times as strong")]
    Gravity,
    /// A box that cannot be.
    #[error("a box must be from 1 cm to 10 m wide and high, and there can be 100")]
    Obstacle,
}
