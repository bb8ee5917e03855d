//! Terrains by name, in the default sizes.

use super::{Direction, Obstacles, Terrain};

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

impl TerrainEntry {
    /// The terrain, at difficulty 0.5.
    pub fn terrain(&self) -> Terrain {
        Terrain::of((self.obstacles)())
    }
}
