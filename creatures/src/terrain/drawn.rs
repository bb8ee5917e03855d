//! Obstacles that were drawn one by one, each in its place.

use super::{BodySizes, ObstacleKind, TerrainError, check};
use crate::bounds::{
    Bounds, DRAWN_HEIGHT, DRAWN_PLACE, DRAWN_RISE, DRAWN_WIDTH, GAP_WIDTH, MOST_DRAWN_OBSTACLES, SLOPE_DEGREES,
    SLOPE_WIDTH,
};
use serde::{Deserialize, Serialize};

/// An obstacle in its place. `from` is where it begins, in metres ahead of the front of the creature in its start pose, 0 to 1000.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum DrawnObstacle {
    /// A block that stands on level ground.
    Box {
        /// m.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        from: f32,
        /// m, 0.05 to 100.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.05, max = 100.0)))]
        width: f32,
        /// m, 0.01 to 5.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 5.0)))]
        height: f32,
    },
    /// A pit without a way out, as deep as 1.5 body lengths and at least 1 m.
    Gap {
        /// m.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        from: f32,
        /// m, 0.01 to 20.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 20.0)))]
        width: f32,
    },
    /// Slanted ground, at most 60° steep. All ground behind it is higher by `rise`.
    Slope {
        /// m.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1000.0)))]
        from: f32,
        /// Seen from above, m, 0.3 to 100: a mound that rounds the upper end would hide a shorter one.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.3, max = 100.0)))]
        width: f32,
        /// m, −20 to 20; it goes down if this is negative.
        #[cfg_attr(feature = "schema", schemars(range(min = -20.0, max = 20.0)))]
        rise: f32,
    },
}

impl DrawnObstacle {
    /// Which kind it counts as: a box is a hurdle.
    pub fn kind(&self) -> ObstacleKind {
        match self {
            Self::Box { .. } => ObstacleKind::Hurdles,
            Self::Gap { .. } => ObstacleKind::Gaps,
            Self::Slope { .. } => ObstacleKind::Slopes,
        }
    }

    /// Where it begins and ends for a body, m.
    pub fn reach(&self, body: &BodySizes) -> [f32; 2] {
        let [from, width] = self.place();
        [body.front + from, body.front + (from + width)]
    }

    /// Where it begins, and how wide it is.
    fn place(&self) -> [f32; 2] {
        match *self {
            Self::Box { from, width, .. } | Self::Gap { from, width } | Self::Slope { from, width, .. } => {
                [from, width]
            }
        }
    }

    fn name(&self) -> &'static str {
        match self {
            Self::Box { .. } => "box",
            Self::Gap { .. } => "gap",
            Self::Slope { .. } => "slope",
        }
    }

    fn fields(&self) -> Vec<(&'static str, f32, Bounds)> {
        match *self {
            Self::Box { from, width, height } => {
                vec![("from", from, DRAWN_PLACE), ("width", width, DRAWN_WIDTH), ("height", height, DRAWN_HEIGHT)]
            }
            Self::Gap { from, width } => {
                vec![("from", from, DRAWN_PLACE), ("width", width, Bounds { min: DRAWN_HEIGHT.min, ..GAP_WIDTH })]
            }
            Self::Slope { from, width, rise } => {
                vec![("from", from, DRAWN_PLACE), ("width", width, SLOPE_WIDTH), ("rise", rise, DRAWN_RISE)]
            }
        }
    }
}

/// Two that touch may overlap by this much, m: places of a file are rounded.
const TOUCH: f32 = 1e-4;

/// All that is wrong with drawn obstacles, each alone and beside the one before it.
pub(super) fn problems(drawn: &[DrawnObstacle]) -> Vec<TerrainError> {
    let mut problems = Vec::new();
    if drawn.len() > MOST_DRAWN_OBSTACLES {
        let found = format!("{} obstacles", drawn.len());
        problems.push(TerrainError::new("drawn", found, format!("at most {MOST_DRAWN_OBSTACLES} obstacles")));
    }
    let mut end = 0.0;
    for (index, obstacle) in drawn.iter().enumerate() {
        let path = |field: &str| format!("drawn[{index}].{}.{field}", obstacle.name());
        let fields = obstacle.fields().into_iter();
        problems.extend(fields.filter_map(|(field, value, bounds)| check(&path(field), value, bounds).err()));
        let [from, width] = obstacle.place();
        if from < end - TOUCH {
            let allowed = format!("at least {end}, where drawn[{}] ends", index.saturating_sub(1));
            problems.push(TerrainError::new(&path("from"), from, allowed));
        }
        end = from + width;
        if let DrawnObstacle::Slope { rise, .. } = *obstacle {
            let steepest = width * libm::tanf(SLOPE_DEGREES.max.to_radians());
            if rise.abs() > steepest * 1.000_01 {
                let allowed = format!("at most {steepest:.2} m up or down: {} ° is the steepest", SLOPE_DEGREES.max);
                problems.push(TerrainError::new(&path("rise"), rise, allowed));
            }
        }
    }
    problems
}
