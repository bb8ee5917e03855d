//! What a page asks for.

use serde::Deserialize;
use serde_json::Value;

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
    /// What is wrong with a terrain that is being drawn.
    CheckTerrain {
        /// The terrain, as in a configuration.
        terrain: Value,
        /// Comes back with the answer.
        number: u64,
    },
    /// Keep a terrain that was drawn.
    KeepTerrain {
        /// What it is called from now on.
        name: String,
        /// The terrain, as in a configuration.
        terrain: Value,
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
    /// From now on the latest run is what the page sees. Where there is none, one begins: a biped that learns to run.
    OpenLatest,
    /// Remove a run with all that is in its folder.
    Remove {
        /// The name of its folder.
        run: String,
    },
    /// Remove a creature that was drawn here. Runs of it stay.
    RemoveCreature {
        /// Its name.
        name: String,
    },
    /// Remove a terrain that was drawn here. Runs on it stay.
    RemoveTerrain {
        /// Its name.
        name: String,
    },
    /// How a run's champion moves, as a picture for a gallery.
    Film {
        /// The name of its folder.
        run: String,
    },
    /// Replay the open run's champion in worlds that are not quite the one it learned in.
    Robustness,
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
        /// More generations than it has done.
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
        /// In which of the two arenas, 0 or 1.
        #[serde(default)]
        arena: usize,
        /// The champion of another run than the open one.
        #[serde(default)]
        run: Option<String>,
        /// Of the generation that was shown last only the one at this place, with its parents.
        #[serde(default)]
        family_of: Option<usize>,
        /// On another terrain than that of the run: a name, or `NAME:DIFFICULTY`.
        #[serde(default)]
        terrain: Option<String>,
        /// With another friction of the ground than that of the run.
        #[serde(default)]
        friction: Option<f32>,
    },
    /// Put these into an arena, as another viewer has sent them.
    Enter {
        /// What is to be shown: a [`Scene`](crate::Scene). What a tag stands in is read twice, so it has no large type.
        scene: Value,
        /// In which of the two arenas, 0 or 1.
        #[serde(default)]
        arena: usize,
    },
    /// Let so many steps pass in an arena, and show it.
    Advance {
        /// How many.
        steps: u32,
        /// In which of the two arenas, 0 or 1.
        #[serde(default)]
        arena: usize,
        /// The number of what is shown there: if something else is by now, nothing happens.
        #[serde(default)]
        number: Option<u32>,
    },
    /// Show nothing in an arena any more.
    Leave {
        /// Which of the two arenas, 0 or 1.
        arena: usize,
    },
    /// What the bodies in the first arena are told to do.
    Tell(Told),
    /// Push the first body in the first arena.
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
    /// A run that is gone on from, by the name of its folder; by default none.
    pub from: Option<String>,
    /// The seed; by default the preset's.
    pub seed: Option<u64>,
    /// When to end, in generations; by default as the preset has it.
    pub generations: Option<u64>,
    /// Single settings, `key=value`.
    pub set: Vec<String>,
}
