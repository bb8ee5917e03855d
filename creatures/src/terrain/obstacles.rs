//! The kinds of obstacles and how large they are.

use crate::{
    Blueprint,
    bounds::{
        Bounds, GAP_WIDTH, HURDLE_HEIGHT, OBSTACLE_SPACING, ROUGH_HEIGHT, SLOPE_DEGREES, STAIR_RISE, STAIR_TREAD,
    },
};
use serde::{Deserialize, Serialize};

/// Obstacles of one kind. A size that is not given follows from the difficulty d of the [`Terrain`](super::Terrain), the
/// body length B and the leg length L of the creature: see [`BodySizes`]. `spacing` is the level ground between one
/// obstacle and the next, m, 0.1 to 100; by default 3 B.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Obstacles {
    /// Pits without a way out, as deep as 1.5 B and at least 1 m.
    Gaps {
        /// m, 0 to 20; by default d · B.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 20.0)))]
        width: Option<f32>,
        /// m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 100.0)))]
        spacing: Option<f32>,
    },
    /// Upright blocks, 0.1 m thick.
    Hurdles {
        /// m, 0 to 5; by default d · 0.5 L.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 5.0)))]
        height: Option<f32>,
        /// m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 100.0)))]
        spacing: Option<f32>,
    },
    /// Flights of five steps.
    Stairs {
        /// Height of a step, m, 0 to 2; by default d · 0.5 L, so a quarter of the leg at 0.5.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 2.0)))]
        rise: Option<f32>,
        /// Depth of a step, m, 0.05 to 10; by default 0.5 B.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.05, max = 10.0)))]
        tread: Option<f32>,
        /// Default `up-and-down`: five steps up, then five down.
        #[serde(default)]
        direction: Direction,
        /// m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 100.0)))]
        spacing: Option<f32>,
    },
    /// Slanted ground, 3 B long, seen from above; its upper end is rounded by a low mound.
    Slopes {
        /// Steepness, 0 to 60°; by default d · 30°.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 60.0)))]
        degrees: Option<f32>,
        /// Default `up-and-down`: a hill, 0.5 B wide at its top.
        #[serde(default)]
        direction: Direction,
        /// m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 100.0)))]
        spacing: Option<f32>,
    },
    /// Eight blocks side by side, each 0, ¼, ½, ¾ or 1 times as high as may be and 0.25 to 0.75 B wide.
    Rough {
        /// Of the highest blocks there may be, m, 0 to 2; by default d · 0.3 L.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 2.0)))]
        height: Option<f32>,
        /// m.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 100.0)))]
        spacing: Option<f32>,
    },
}

/// Which way stairs and slopes go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Direction {
    /// Each is higher than the one before.
    Up,
    /// Each is lower than the one before.
    Down,
    /// Each goes up and comes down again.
    #[default]
    UpAndDown,
}

/// A kind of obstacle.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ObstacleKind {
    /// A pit.
    Gaps,
    /// A block.
    Hurdles,
    /// A flight of steps.
    Stairs,
    /// Slanted ground.
    Slopes,
    /// Blocks of random heights.
    Rough,
}

/// The sizes of a body that obstacles are measured by, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodySizes {
    /// B: the longer side of the bounding box in the start pose.
    pub body_length: f32,
    /// L: see [`Blueprint::leg_length`].
    pub leg_length: f32,
    /// How far forward the body reaches in the start pose.
    pub front: f32,
    /// How far back the body reaches in the start pose.
    pub back: f32,
}

/// Obstacles with all their sizes, for one body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObstacleSizes {
    /// Which.
    pub kind: ObstacleKind,
    /// What makes them hard: width of gaps, height of hurdles and of rough ground, rise of stairs, m; of slopes how steep
    /// they are, degrees. Below a thousandth there is no obstacle.
    pub main: f32,
    /// How long a step, a slope or, on average, a block of rough ground is, seen from above, m; of hurdles how thick they
    /// are; 0 for gaps.
    pub tread: f32,
    /// Of stairs and slopes.
    pub direction: Direction,
    /// Level ground until the next, on average, m.
    pub spacing: f32,
}

impl ObstacleKind {
    /// Its name, as files have it.
    pub fn name(self) -> &'static str {
        match self {
            Self::Gaps => "gaps",
            Self::Hurdles => "hurdles",
            Self::Stairs => "stairs",
            Self::Slopes => "slopes",
            Self::Rough => "rough",
        }
    }

    /// What a creature does with such obstacles, as in "gaps crossed: 3 of 5".
    pub fn passed(self) -> &'static str {
        match self {
            Self::Gaps => "gaps crossed",
            Self::Hurdles => "hurdles cleared",
            Self::Stairs => "stairs passed",
            Self::Slopes => "slopes passed",
            Self::Rough => "rough stretches passed",
        }
    }
}

impl BodySizes {
    /// Those of a creature.
    pub fn of(blueprint: &Blueprint) -> Self {
        let [back, _, front, _] = blueprint.bounding_box();
        Self { body_length: blueprint.body_length(), leg_length: blueprint.leg_length(), front, back }
    }
}

impl Obstacles {
    /// Which kind.
    pub fn kind(&self) -> ObstacleKind {
        match self {
            Self::Gaps { .. } => ObstacleKind::Gaps,
            Self::Hurdles { .. } => ObstacleKind::Hurdles,
            Self::Stairs { .. } => ObstacleKind::Stairs,
            Self::Slopes { .. } => ObstacleKind::Slopes,
            Self::Rough { .. } => ObstacleKind::Rough,
        }
    }

    /// All sizes, for a body, at a difficulty from 0 to 1.
    pub fn sizes(&self, difficulty: f32, body: &BodySizes) -> ObstacleSizes {
        let BodySizes { body_length, leg_length, .. } = *body;
        let up_and_down = Direction::UpAndDown;
        let (main, tread, direction, spacing) = match *self {
            Self::Gaps { width, spacing } => (width.unwrap_or(difficulty * body_length), 0.0, up_and_down, spacing),
            Self::Hurdles { height, spacing } => {
                (height.unwrap_or(difficulty * 0.5 * leg_length), 0.1, up_and_down, spacing)
            }
            Self::Stairs { rise, tread, direction, spacing } => {
                let rise = rise.unwrap_or(difficulty * 0.5 * leg_length);
                (rise, tread.unwrap_or(0.5 * body_length).max(STAIR_TREAD.min), direction, spacing)
            }
            Self::Slopes { degrees, direction, spacing } => {
                (degrees.unwrap_or(difficulty * 30.0), 3.0 * body_length, direction, spacing)
            }
            Self::Rough { height, spacing } => {
                (height.unwrap_or(difficulty * 0.3 * leg_length), 0.5 * body_length, up_and_down, spacing)
            }
        };
        let spacing = spacing.unwrap_or(3.0 * body_length).max(OBSTACLE_SPACING.min);
        ObstacleSizes { kind: self.kind(), main, tread, direction, spacing }
    }

    /// The sizes that are given, each with its name and its range.
    pub(super) fn written(&self) -> Vec<(&'static str, f32, Bounds)> {
        let all = match *self {
            Self::Gaps { width, spacing } => vec![("width", width, GAP_WIDTH), ("spacing", spacing, OBSTACLE_SPACING)],
            Self::Hurdles { height, spacing } => {
                vec![("height", height, HURDLE_HEIGHT), ("spacing", spacing, OBSTACLE_SPACING)]
            }
            Self::Stairs { rise, tread, spacing, .. } => {
                let sizes = [("rise", rise, STAIR_RISE), ("tread", tread, STAIR_TREAD)];
                [sizes.as_slice(), &[("spacing", spacing, OBSTACLE_SPACING)]].concat()
            }
            Self::Slopes { degrees, spacing, .. } => {
                vec![("degrees", degrees, SLOPE_DEGREES), ("spacing", spacing, OBSTACLE_SPACING)]
            }
            Self::Rough { height, spacing } => {
                vec![("height", height, ROUGH_HEIGHT), ("spacing", spacing, OBSTACLE_SPACING)]
            }
        };
        all.into_iter().filter_map(|(field, size, bounds)| Some((field, size?, bounds))).collect()
    }
}
