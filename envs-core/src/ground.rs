use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// What a creature moves on: shapes that never move, in metres. Where they overlap, the ground is their union.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ground {
    /// At least one.
    pub shapes: Vec<GroundShape>,
}

/// A piece of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum GroundShape {
    /// Everything below y = 0: flat ground without end.
    HalfSpace,
    /// A rectangle whose sides are level and upright.
    Box {
        /// Of its centre, m.
        x: f32,
        /// Of its centre, m.
        y: f32,
        /// Full width, m; positive.
        width: f32,
        /// Full height, m; positive.
        height: f32,
    },
}

impl Default for Ground {
    /// Flat.
    fn default() -> Self {
        Self::flat()
    }
}

impl Ground {
    /// Flat ground at y = 0, without end.
    pub fn flat() -> Self {
        Self { shapes: vec![GroundShape::HalfSpace] }
    }

    /// Checks that there is ground, and that every number of it is finite and every size positive.
    ///
    /// # Errors
    /// Names the field, such as `shapes[1].width`, and what it must be.
    pub fn validate(&self) -> Result<(), SettingError> {
        if self.shapes.is_empty() {
            return Err(SettingError::new("shapes", "[]", "at least one shape"));
        }
        for (index, shape) in self.shapes.iter().enumerate() {
            shape.validate().map_err(|error| error.within(&format!("shapes[{index}]")))?;
        }
        Ok(())
    }
}

impl GroundShape {
    fn validate(&self) -> Result<(), SettingError> {
        let Self::Box { x, y, width, height } = *self else { return Ok(()) };
        for (field, place) in [("x", x), ("y", y)] {
            if !place.is_finite() {
                return Err(SettingError::new(field, place, "finite"));
            }
        }
        for (field, size) in [("width", width), ("height", height)] {
            if !(size.is_finite() && size > 0.0) {
                return Err(SettingError::new(field, size, "finite and above 0"));
            }
        }
        Ok(())
    }
}
