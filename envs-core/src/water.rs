use crate::inertia::inertia_per_mass;
use creatures::{Blueprint, BodyPart, Shape};
use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// Still water without surface, bottom or walls, in place of the ground.
///
/// Every part is buoyed up by what it displaces, and resisted by drag that grows with the square of its speed. Drag is
/// found by resistive force theory: each piece of a part is resisted for itself, across the part's long side by much, along
/// it by little. That is what a wave running down a body pushes itself off from (Gray & Hancock 1955, J. Exp. Biol. 32,
/// 802–814; with forces that are square in the speed, as here, Taylor 1952, Proc. R. Soc. Lond. A 214, 158–183). Left out
/// are the mass of the water that moves along, and what one part does to the water around another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Water {
    /// Mass per area, kg/m², as parts have it, from 0.01 to 1e5. `null`, the default: as much as the creature has on the
    /// whole, so that it floats in balance, also where its mass varies.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 1e5)))]
    pub density: Option<f32>,
    /// Drag coefficient across the long side of a part, from 0 to 10; default 1, about that of a rod.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10.0)))]
    pub drag: f32,
    /// Drag coefficient along the long side of a thin part, from 0 to the other; default 0.05. For a part of breadth b and
    /// length l the share (b/l)² of the difference between the two comes to it, so that a part as broad as it is long is
    /// resisted alike in both directions (as ellipses are: Hoerner 1965, Fluid-Dynamic Drag, chapter 6).
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10.0)))]
    pub slip: f32,
}

impl Default for Water {
    fn default() -> Self {
        Self { density: None, drag: 1.0, slip: 0.05 }
    }
}

impl Water {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        let density = self.density.map(|density| ("density", density, 0.01, 1e5));
        for (field, value, low, high) in density.into_iter().chain([("drag", self.drag, 0.0, 10.0)]) {
            if !(low..=high).contains(&value) {
                return Err(SettingError::new(field, value, format!("from {low} to {high}")));
            }
        }
        if !(0.0..=self.drag).contains(&self.slip) {
            return Err(SettingError::new("slip", self.slip, format!("from 0 to drag, which is {}", self.drag)));
        }
        Ok(())
    }

    /// Its mass per area, kg/m², around a creature whose densities are multiplied with a factor.
    pub fn density_around(&self, blueprint: &Blueprint, mass_factor: f32) -> f32 {
        self.density.unwrap_or_else(|| mass_factor * mean_density(blueprint))
    }
}

/// Mass of all parts over their area, kg/m².
fn mean_density(blueprint: &Blueprint) -> f32 {
    let parts = blueprint.parts();
    let sum = |of: fn(&BodyPart) -> f32| parts.iter().map(of).sum::<f32>();
    sum(|part| part.mass()) / sum(|part| part.shape.area())
}

/// A part as the water feels it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hull {
    /// Half of its long side, m.
    half_length: f64,
    /// Whether its long side is its height.
    upright: bool,
    /// Whether it has no long side, and is resisted alike in all directions.
    round: bool,
    /// Drag per length over mass, 1/m²: what slows down, times the square of a speed.
    across: f64,
    along: f64,
    /// Moment of inertia over mass, m².
    inertia: f64,
    weight_left: f32,
}

/// How fast a part is: x and y of its centre, m/s, and its spin, rad/s.
pub type PartVelocity = ([f32; 2], f32);

/// The points along the long side at which drag is measured, as shares of half its length, and what each counts: Gauss and
/// Legendre's three.
const POINTS: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

impl Hull {
    /// A part of a creature whose densities are multiplied with a factor, in water of this mass per area, kg/m².
    pub fn new(part: &BodyPart, water: &Water, water_density: f32, mass_factor: f32) -> Self {
        let (length, breadth, upright) = match part.shape {
            Shape::Box { width, height } => (width.max(height), width.min(height), height > width),
            Shape::Circle { radius } => (2.0 * radius, 2.0 * radius, false),
            Shape::Capsule { length, radius } => (length + 2.0 * radius, 2.0 * radius, true),
        };
        let slimness = f64::from(breadth) / f64::from(length);
        let [drag, slip] = [water.drag, water.slip].map(f64::from);
        let mass = f64::from(part.mass()) * f64::from(mass_factor);
        let pressure = 0.5 * f64::from(water_density) / mass;
        Self {
            half_length: 0.5 * f64::from(length),
            upright,
            round: matches!(part.shape, Shape::Circle { .. }),
            across: pressure * drag,
            along: pressure * (slip + (drag - slip) * slimness * slimness),
            inertia: f64::from(inertia_per_mass(&part.shape)),
            weight_left: 1.0 - water_density / (part.density * mass_factor),
        }
    }

    /// The share of the part's weight that buoyancy leaves; below 0 if it rises.
    pub fn weight_left(&self) -> f32 {
        self.weight_left
    }

    /// The velocity that is left after drag alone has acted for so long, s, on a part turned by the angle whose cosine and
    /// sine are given.
    ///
    /// The drag coefficients are those at the beginning, the velocities they act on those at the end (the implicit Euler
    /// step of a drag that is linear in between, and the exact solution for a part that only glides). So drag never turns back what it slows down, and never adds energy,
    /// however long the step, and however fast and light the part.
    pub fn slowed(&self, ([vx, vy], spin): PartVelocity, [cos, sin]: [f32; 2], seconds: f32) -> PartVelocity {
        let [vx, vy, spin, cos, sin, seconds] = [vx, vy, spin, cos, sin, seconds].map(f64::from);
        let [c, s] = if self.upright { [-sin, cos] } else { [cos, sin] };
        let (along, across) = (c * vx + s * vy, c * vy - s * vx);
        // Sums over the points of how much each slows down, 1, and times its place, m, and its square, m².
        let (mut slowing_along, mut slowing, mut first, mut second) = (0.0, 0.0, 0.0, 0.0);
        for (share, weight) in POINTS {
            let place = share * self.half_length;
            let length_and_time = weight * self.half_length * seconds;
            let there = across + spin * place;
            let [fast_along, fast_across] = match self.round {
                true => [(along * along + there * there).sqrt(); 2],
                false => [along.abs(), there.abs()],
            };
            slowing_along += self.along * fast_along * length_and_time;
            let slows = self.across * fast_across * length_and_time;
            slowing += slows;
            first += slows * place;
            second += slows * place * place;
        }
        let along = along / (1.0 + slowing_along);
        let (a, d) = (1.0 + slowing, self.inertia + second);
        let determinant = a * d - first * first;
        let turning = self.inertia * spin;
        let (across, spin) =
            ((across * d - turning * first) / determinant, (a * turning - first * across) / determinant);
        ([(c * along - s * across) as f32, (s * along + c * across) as f32], spin as f32)
    }
}
