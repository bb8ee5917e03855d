//! Terrains by name, in the default sizes.

use super::{Direction, Obstacles, Terrain, TerrainError};
use crate::names::{did_you_mean, nearest, shortened};

/// A terrain that can be asked for by name.
#[derive(Clone, Copy, Debug)]
pub struct TerrainEntry {
    /// Its name.
    pub name: &'static str,
    /// What it is, and how large at difficulty 1.
    pub description: &'static str,
    obstacles: fn() -> Vec<Obstacles>,
}

/// All of them; the first is the default.
pub const TERRAINS: &[TerrainEntry] = &[
    TerrainEntry { name: "flat", description: "level ground without end", obstacles: Vec::new },
    TerrainEntry { name: "gaps", description: "pits, up to 1 body length wide", obstacles: || vec![GAPS] },
    TerrainEntry { name: "hurdles", description: "blocks, up to 0.5 leg lengths high", obstacles: || vec![HURDLES] },
    TerrainEntry {
        name: "stairs",
        description: "five steps up and five down, up to 0.5 leg lengths each",
        obstacles: || vec![stairs(Direction::UpAndDown)],
    },
    TerrainEntry {
        name: "stairs-up",
        description: "flights of five steps up, up to 0.5 leg lengths each",
        obstacles: || vec![stairs(Direction::Up)],
    },
    TerrainEntry {
        name: "stairs-down",
        description: "flights of five steps down, up to 0.5 leg lengths each",
        obstacles: || vec![stairs(Direction::Down)],
    },
    TerrainEntry { name: "slopes", description: "hills, up to 30° steep", obstacles: || vec![SLOPES] },
    TerrainEntry {
        name: "rough",
        description: "blocks of random heights, up to 0.3 leg lengths",
        obstacles: || vec![ROUGH],
    },
    TerrainEntry {
        name: "mixture",
        description: "gaps, hurdles, stairs, slopes and rough ground in turns",
        obstacles: || vec![GAPS, HURDLES, stairs(Direction::UpAndDown), SLOPES, ROUGH],
    },
];

const GAPS: Obstacles = Obstacles::Gaps { width: None, spacing: None };
const HURDLES: Obstacles = Obstacles::Hurdles { height: None, spacing: None };
const SLOPES: Obstacles = Obstacles::Slopes { degrees: None, direction: Direction::UpAndDown, spacing: None };
const ROUGH: Obstacles = Obstacles::Rough { height: None, spacing: None };

fn stairs(direction: Direction) -> Obstacles {
    Obstacles::Stairs { rise: None, tread: None, direction, spacing: None }
}

/// What was asked for by name is no terrain.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum UnknownTerrain {
    /// There is none of this name.
    #[error("there is no terrain \"{name}\"{} (there are: {})", did_you_mean(.nearest), names())]
    Name {
        /// What was asked for.
        name: String,
        /// The name most like it.
        nearest: Option<String>,
    },
    /// What stands behind the colon is no difficulty.
    #[error("terrain \"{text}\": \"{found}\" is no difficulty; write it as in gaps:0.5")]
    Difficulty {
        /// What was asked for.
        text: String,
        /// What stands behind the colon.
        found: String,
    },
    /// The difficulty is out of range.
    #[error("terrain.{0}")]
    Range(#[from] TerrainError),
}

fn names() -> String {
    TERRAINS.iter().map(|entry| entry.name).collect::<Vec<_>>().join(", ")
}

impl TerrainEntry {
    /// The terrain, at difficulty 0.5.
    pub fn terrain(&self) -> Terrain {
        Terrain::of((self.obstacles)())
    }
}

impl std::str::FromStr for Terrain {
    type Err = UnknownTerrain;

    /// `NAME` or `NAME:DIFFICULTY`, such as `gaps:0.5`: one of [`TERRAINS`].
    fn from_str(text: &str) -> Result<Self, UnknownTerrain> {
        let (name, difficulty) = text.split_once(':').map_or((text, None), |(name, rest)| (name, Some(rest)));
        let entry = TERRAINS.iter().find(|entry| entry.name == name).ok_or_else(|| UnknownTerrain::Name {
            name: shortened(name),
            nearest: nearest(name, TERRAINS.iter().map(|entry| entry.name)),
        })?;
        let terrain = entry.terrain();
        let Some(found) = difficulty else { return Ok(terrain) };
        let difficulty = found.trim().parse().map_err(|_| {
            let [text, found] = [text, found].map(shortened);
            UnknownTerrain::Difficulty { text, found }
        })?;
        let terrain = terrain.with_difficulty(difficulty);
        terrain.validate()?;
        // Flat ground has no difficulty; a file would only keep it for nothing.
        Ok(if terrain.is_flat() { Self::default() } else { terrain })
    }
}
