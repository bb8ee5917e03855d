//! What a creature moves on, as plain data: kinds of obstacles, how large they are, and a seed.
//!
//! A terrain says what is to be built, not where: [`sizes`](Obstacles::sizes) turns it into metres for a body, and
//! `envs-core` lays it out. Only obstacles that were [drawn](DrawnObstacle) have places of their own.

mod drawn;
mod error;
mod named;
mod obstacles;

pub use drawn::DrawnObstacle;
pub use error::TerrainError;
pub use named::{TERRAINS, TerrainEntry};
pub use obstacles::{BodySizes, Direction, ObstacleKind, ObstacleSizes, Obstacles};

use crate::bounds::{Bounds, MOST_OBSTACLE_KINDS, TERRAIN_DIFFICULTY, TERRAIN_JITTER, TERRAIN_LENGTH, TERRAIN_RUN_UP};
use serde::{Deserialize, Serialize};

/// Ground with obstacles on it. In a file, for example:
///
/// ```json
/// { "obstacles": [{ "gaps": {} }, { "stairs": { "rise": 0.1, "direction": "up" } }], "difficulty": 0.3, "seed": 7 }
/// ```
///
/// Sizes that are not given in metres follow from the difficulty and the body: see [`Obstacles`]. The default is flat. Or each obstacle
/// is given with its place:
///
/// ```json
/// { "drawn": [{ "box": { "from": 2, "width": 1, "height": 0.1 } }, { "slope": { "from": 4, "width": 3, "rise": -0.5 } }] }
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Terrain {
    /// The kinds of obstacles, at most 16. Several take turns; none: flat ground without end.
    #[cfg_attr(feature = "schema", schemars(length(max = 16)))]
    pub obstacles: Vec<Obstacles>,
    /// How hard the sizes are that are not given, from 0 (flat) to 1 (as hard as could be); default 0.5.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub difficulty: f32,
    /// What the spacings, and the blocks of rough ground, are drawn from; default 0.
    pub seed: u64,
    /// No obstacle begins further than this from the start, m, 1 to 1000; default 80. Behind the last one the ground is
    /// level.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 1000.0)))]
    pub length: f32,
    /// Level ground between the front of the creature and the first obstacle, m, 0 to 100; `null`, the default: 2 body
    /// lengths.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 100.0)))]
    pub run_up: Option<f32>,
    /// By up to this share each spacing is longer or shorter, 0 to 0.9; default 0.3.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.9)))]
    pub jitter: f32,
    /// Obstacles in their places, in place of `obstacles`: from left to right, at most 200, none within another. The other fields have
    /// no effect on them.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    #[cfg_attr(feature = "schema", schemars(length(max = 200)))]
    pub drawn: Vec<DrawnObstacle>,
}

impl Default for Terrain {
    /// Flat.
    fn default() -> Self {
        let (obstacles, drawn) = (Vec::new(), Vec::new());
        Self { obstacles, difficulty: 0.5, seed: 0, length: 80.0, run_up: None, jitter: 0.3, drawn }
    }
}

impl Terrain {
    /// A terrain of these obstacles, all else by default.
    pub fn of(obstacles: Vec<Obstacles>) -> Self {
        Self { obstacles, ..Self::default() }
    }

    /// The same, this hard.
    #[must_use]
    pub fn with_difficulty(self, difficulty: f32) -> Self {
        Self { difficulty, ..self }
    }

    /// Whether it has no obstacles, for any body.
    pub fn is_flat(&self) -> bool {
        self.obstacles.is_empty() && self.drawn.is_empty()
    }

    /// Whether nothing of it was ever set: what files leave out.
    pub fn is_default(&self) -> bool {
        *self == Self::default()
    }

    /// Whether its obstacles can differ from seed to seed.
    pub fn has_chance(&self) -> bool {
        let rough = |obstacles: &Obstacles| matches!(obstacles, Obstacles::Rough { .. });
        !self.obstacles.is_empty() && (self.jitter > 0.0 || self.obstacles.iter().any(rough))
    }

    /// The level ground before the first obstacle, m.
    pub fn run_up_of(&self, body: &BodySizes) -> f32 {
        self.run_up.unwrap_or(2.0 * body.body_length)
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the first field that is out of range, such as `obstacles[0].gaps.width`, and the range.
    pub fn validate(&self) -> Result<(), TerrainError> {
        if self.obstacles.len() > MOST_OBSTACLE_KINDS {
            let found = format!("{} kinds", self.obstacles.len());
            return Err(TerrainError::new("obstacles", found, format!("at most {MOST_OBSTACLE_KINDS} kinds")));
        }
        for (index, obstacles) in self.obstacles.iter().enumerate() {
            for (field, size, bounds) in obstacles.written() {
                check(&format!("obstacles[{index}].{}.{field}", obstacles.kind().name()), size, bounds)?;
            }
        }
        check("difficulty", self.difficulty, TERRAIN_DIFFICULTY)?;
        check("length", self.length, TERRAIN_LENGTH)?;
        check("jitter", self.jitter, TERRAIN_JITTER)?;
        self.run_up.map_or(Ok(()), |run_up| check("run_up", run_up, TERRAIN_RUN_UP))?;
        self.drawn_problems().into_iter().next().map_or(Ok(()), Err)
    }

    /// All that is wrong with the obstacles that were drawn, for an editor; of everything else [`validate`](Self::validate) names the first.
    pub fn drawn_problems(&self) -> Vec<TerrainError> {
        let mut problems = drawn::problems(&self.drawn);
        if !self.drawn.is_empty() && !self.obstacles.is_empty() {
            let found = format!("{} obstacles", self.drawn.len());
            problems.push(TerrainError::new("drawn", found, "empty where there are `obstacles`"));
        }
        problems
    }
}

fn check(field: &str, value: f32, bounds: Bounds) -> Result<(), TerrainError> {
    match bounds.contains(value) {
        true => Ok(()),
        false => Err(TerrainError::new(field, value, format!("from {} to {} {}", bounds.min, bounds.max, bounds.unit))),
    }
}
