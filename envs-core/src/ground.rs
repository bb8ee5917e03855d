use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// What a creature moves on: shapes that never move, in metres. Where they overlap, the ground is their union.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Ground {
    /// At least one, except in water, where there is no ground.
    pub shapes: Vec<GroundShape>,
}

/// A piece of the ground.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum GroundShape {
    /// Everything below y = 0: flat ground without end.
    HalfSpace,
    /// Everything below a height: the floor of pits.
    Floor {
        /// The height, m.
        y: f32,
    },
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
    /// A turned rectangle: slanted ground.
    Slab {
        /// Of its centre, m.
        x: f32,
        /// Of its centre, m.
        y: f32,
        /// Full width before it is turned, m; positive.
        width: f32,
        /// Full height before it is turned, m; positive.
        height: f32,
        /// Counter-clockwise, rad.
        angle: f32,
    },
    /// A disc. Where its top looks out of other ground it is a mound, without an edge that a sunken foot could hit.
    Circle {
        /// Of its centre, m.
        x: f32,
        /// Of its centre, m.
        y: f32,
        /// m; positive.
        radius: f32,
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

    /// None at all: water is deep.
    pub fn none() -> Self {
        Self { shapes: Vec::new() }
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
        let place = |field, place: f32| match place.is_finite() {
            true => Ok(()),
            false => Err(SettingError::new(field, place, "finite")),
        };
        let size = |field, size: f32| match size.is_finite() && size > 0.0 {
            true => Ok(()),
            false => Err(SettingError::new(field, size, "finite and above 0")),
        };
        match *self {
            Self::HalfSpace => Ok(()),
            Self::Floor { y } => place("y", y),
            Self::Box { x, y, width, height } => {
                place("x", x).and(place("y", y)).and(size("width", width)).and(size("height", height))
            }
            Self::Slab { x, y, width, height, angle } => place("x", x)
                .and(place("y", y))
                .and(size("width", width))
                .and(size("height", height))
                .and(place("angle", angle)),
            Self::Circle { x, y, radius } => place("x", x).and(place("y", y)).and(size("radius", radius)),
        }
    }
}
