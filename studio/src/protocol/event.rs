//! What the studio tells a page.

use crate::{
    descent::Member,
    protocol::Verdict,
    scene::{Scene, Shown},
};
use creatures::{Creature, DrawnObstacle, Problem, TerrainError};
use gambol_reports::page::{ground::GroundData, network::NetworkData};
use gambol_runs::{
    config::RunConfig,
    robust::{CauseShare, Robustness},
};
use ne_core::GenerationReport;
use serde::Serialize;
use serde_json::Value;

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
    /// The run whose champion is in the second arena.
    Beside {
        /// The name of its folder.
        run: String,
        /// Its creature's name or title.
        creature: String,
        /// Its movement.
        movement: String,
        /// The unit of its fitness.
        unit: String,
        /// The verdict on its champion, once it is judged.
        verdict: Option<Verdict>,
    },
    /// What is left of the champion's gait in other worlds, or how far that has been found out.
    Robustness(RobustnessState),
    /// How a run's champion moves: one stride, again and again.
    Film {
        /// The name of the run's folder.
        run: String,
        /// Seconds between two poses.
        time_step: f64,
        /// Place (m) and angle (rad) of each part, pose after pose; empty if its gait has no stride.
        poses: Vec<f32>,
    },
    /// What is to be shown, for a page whose arena is elsewhere.
    Scene {
        /// What it takes.
        scene: Box<Scene>,
        /// In which of the two arenas, 0 or 1.
        arena: usize,
    },
    /// What is in an arena now.
    Arena {
        /// Which of the two arenas, 0 or 1.
        arena: usize,
        /// The number that its frames begin with.
        number: u32,
        /// Which creatures they are.
        who: Shown,
        /// The generation they are of.
        generation: u64,
        /// What is known of each.
        members: Vec<Member>,
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
    pub terrains: Vec<TerrainChoice>,
    /// Variations.
    pub variations: Vec<NamedThing>,
    /// Formats of exports.
    pub formats: Vec<ExportFormat>,
    /// Runs, the latest first.
    pub runs: Vec<RunEntry>,
    /// How many older runs there are that are not among them.
    pub more_runs: usize,
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

/// A terrain that can be chosen.
#[derive(Clone, Debug, Serialize)]
pub struct TerrainChoice {
    /// The name.
    pub name: String,
    /// What it is.
    pub description: String,
    /// The obstacles of one that was drawn here.
    pub drawn: Option<Vec<DrawnObstacle>>,
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

impl From<&TerrainError> for Mistake {
    fn from(error: &TerrainError) -> Self {
        Self { place: error.field.clone(), message: error.to_string() }
    }
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

/// How far a champion was replayed in worlds that are not quite the one it learned in.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobustnessState {
    /// The champion's generation.
    pub generation: u64,
    /// In how many worlds it was replayed, and of how many.
    pub worlds: [usize; 2],
    /// What came out, at the end.
    pub result: Option<RobustnessResult>,
    /// Why nothing can be said.
    pub problem: Option<String>,
}

/// What is left of a champion's gait.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RobustnessResult {
    /// Share of the worlds in which its gait is usable, 0 to 1.
    pub usable_share: f64,
    /// The part of the fitness that is kept in the median.
    pub fitness_kept: Option<f64>,
    /// What was changed, in how many worlds, and in what share of them its gait is usable.
    pub causes: Vec<CauseShare>,
}

impl From<Robustness> for RobustnessResult {
    fn from(robustness: Robustness) -> Self {
        let Robustness { usable_share, fitness_kept, causes, .. } = robustness;
        Self { usable_share, fitness_kept, causes }
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
