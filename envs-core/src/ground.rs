use ne_core::SettingError;
use serde::{Deserialize, Serialize};
use tasks::gait::GroundProfile;

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

    /// How high it is over a range of x, m.
    pub fn profile(&self, range: [f64; 2]) -> GroundProfile {
        let mut profile = GroundProfile::flat(f32::NEG_INFINITY, range);
        for shape in &self.shapes {
            shape.raise(&mut profile);
        }
        profile
    }
}

impl GroundShape {
    fn raise(&self, profile: &mut GroundProfile) {
        const EVERYWHERE: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];
        match *self {
            Self::HalfSpace => profile.raise(EVERYWHERE, |_| 0.0),
            Self::Floor { y } => profile.raise(EVERYWHERE, |_| y),
            Self::Box { x, y, width, height } => {
                profile.raise(around(x, 0.5 * f64::from(width)), |_| y + 0.5 * height);
            }
            Self::Slab { x, y, width, height, angle } => {
                let (sin, cos) = libm::sincos(f64::from(angle));
                let (along, across) = (0.5 * f64::from(width), 0.5 * f64::from(height));
                // Where the line above x leaves the two strips of which the rectangle is made.
                let leaves = |slope: f64, ahead: f64, half: f64| match slope {
                    0.0 => f64::INFINITY,
                    _ => (half - ahead * slope.signum()) / slope.abs(),
                };
                profile.raise(around(x, cos.abs() * along + sin.abs() * across), |place| {
                    let ahead = place - f64::from(x);
                    y + leaves(sin, cos * ahead, along).min(leaves(cos, -sin * ahead, across)) as f32
                });
            }
            Self::Circle { x, y, radius } => profile.raise(around(x, radius.into()), |place| {
                let (ahead, radius) = (place - f64::from(x), f64::from(radius));
                y + libm::sqrt((radius * radius - ahead * ahead).max(0.0)) as f32
            }),
        }
    }

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

fn around(x: f32, reach: f64) -> [f64; 2] {
    [f64::from(x) - reach, f64::from(x) + reach]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_profile_is_the_top_of_the_shapes() {
        let shapes = vec![
            GroundShape::Floor { y: -2.0 },
            GroundShape::Box { x: 0.0, y: -0.5, width: 2.0, height: 1.0 },
            GroundShape::Circle { x: 0.0, y: -0.4, radius: 0.5 },
            // A square on its corner.
            GroundShape::Slab { x: 3.0, y: 0.0, width: 2.0, height: 2.0, angle: std::f32::consts::FRAC_PI_4 },
        ];
        let profile = Ground { shapes }.profile([-2.0, 5.0]);
        let top = std::f64::consts::SQRT_2;
        for (x, height) in
            [(-1.5, -2.0), (-0.9, 0.0), (0.0, 0.1), (0.2, 0.05826), (3.0, top), (3.5, top - 0.5), (2.0, 0.41421)]
        {
            let found = profile.height(x).expect("ground");
            assert!((found - height).abs() < 1e-4, "{found} at {x}, not {height}");
        }
        assert_eq!(Ground::flat().profile([0.0, 1.0]).height(0.5), Some(0.0));
        assert_eq!(Ground::none().profile([0.0, 1.0]).height(0.5), None);
    }
}
