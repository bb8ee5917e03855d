//! Whether a body looks the same from both sides, so that what it can do one way it can do the other way.

extern crate alloc;

use crate::Shape;
use alloc::{vec, vec::Vec};
use core::f32::consts::TAU;

/// A part in the start pose, as far as symmetry goes by it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryPart {
    /// Its shape.
    pub shape: Shape,
    /// Centre, forward, m.
    pub x: f32,
    /// Centre, up, m.
    pub y: f32,
    /// Turned counter-clockwise, rad.
    pub angle: f32,
    /// Mass per area, kg/m².
    pub density: f32,
    /// Friction coefficient.
    pub friction: f32,
}

/// A hinge, as far as symmetry goes by it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SymmetryHinge {
    /// The part it hangs on; stands before the child.
    pub parent: usize,
    /// The part that hangs on it.
    pub child: usize,
    /// In the parent's own frame, m.
    pub parent_anchor: [f32; 2],
    /// In the child's own frame, m.
    pub child_anchor: [f32; 2],
    /// Smallest and largest angle, rad.
    pub limits: [f32; 2],
    /// Top speed and top torque of its motor, if it has one.
    pub motor: Option<[f32; 2]>,
    /// Whether a net moves it.
    pub actuated: bool,
}

/// Why a body does not look the same from both sides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asymmetry {
    /// No part is the mirror image of this one.
    Part(usize),
    /// The hinge of this part is not the mirror image of that of its twin.
    Hinge(usize),
}

/// Lengths may differ by so much, m, and angles, rad: files hold decimals.
const TOLERANCE: f32 = 1e-4;

/// For each part the one that is its mirror image, across the upright line through the torso: a part in the middle is its own.
/// The first of the parts is the torso; the twin of a twin is the part itself.
///
/// # Errors
/// The first part, or hinge, that has no twin.
pub fn twins(parts: &[SymmetryPart], hinges: &[SymmetryHinge]) -> Result<Vec<usize>, Asymmetry> {
    let Some(torso) = parts.first() else { return Ok(Vec::new()) };
    let mut hangs: Vec<Option<&SymmetryHinge>> = vec![None; parts.len()];
    for hinge in hinges {
        if let Some(place) = hangs.get_mut(hinge.child) {
            place.get_or_insert(hinge);
        }
    }
    let hinge_of = |child: usize| hangs[child];
    let mut twin: Vec<Option<usize>> = vec![None; parts.len()];
    for part in 0..parts.len() {
        if twin[part].is_some() {
            continue;
        }
        let above = hinge_of(part).and_then(|hinge| twin[hinge.parent]);
        let is_twin = |&other: &usize| {
            twin[other].is_none()
                && hinge_of(other).map(|hinge| hinge.parent) == above
                && are_mirrored(&parts[part], &parts[other], torso.x)
        };
        let mut candidates = (part..parts.len()).filter(is_twin).peekable();
        if candidates.peek().is_none() {
            return Err(Asymmetry::Part(part));
        }
        let hinges_fit = |&other: &usize| match (hinge_of(part), hinge_of(other)) {
            (Some(one), Some(other)) => hinges_are_mirrored(one, other),
            (one, other) => one.is_none() && other.is_none(),
        };
        let Some(other) = candidates.find(hinges_fit) else { return Err(Asymmetry::Hinge(part)) };
        (twin[part], twin[other]) = (Some(other), Some(part));
    }
    Ok(twin.into_iter().flatten().collect())
}

fn near(one: f32, other: f32) -> bool {
    (one - other).abs() <= TOLERANCE
}

fn are_mirrored(one: &SymmetryPart, other: &SymmetryPart, middle: f32) -> bool {
    // After half a turn a part looks the same, but its angle, which is sensed, is not.
    let turns = (one.angle + other.angle) / TAU;
    let turned = near((turns - libm::roundf(turns)) * TAU, 0.0);
    one.shape == other.shape
        && near(one.x - middle, middle - other.x)
        && near(one.y, other.y)
        && turned
        && near(one.density / other.density, 1.0)
        && near(one.friction, other.friction)
}

fn hinges_are_mirrored(one: &SymmetryHinge, other: &SymmetryHinge) -> bool {
    let anchors = |[x, y]: [f32; 2], [other_x, other_y]: [f32; 2]| near(x, -other_x) && near(y, other_y);
    let motors = match (one.motor, other.motor) {
        (Some(one), Some(other)) => near(one[0] / other[0], 1.0) && near(one[1] / other[1], 1.0),
        (one, other) => one.is_none() && other.is_none(),
    };
    anchors(one.parent_anchor, other.parent_anchor)
        && anchors(one.child_anchor, other.child_anchor)
        && near(one.limits[0], -other.limits[1])
        && near(one.limits[1], -other.limits[0])
        && motors
        && one.actuated == other.actuated
}

impl core::fmt::Display for Asymmetry {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Part(part) => write!(f, "part {part} has no mirror image on the other side"),
            Self::Hinge(part) => write!(f, "the hinge of part {part} is not the mirror image of that of its twin"),
        }
    }
}

impl core::error::Error for Asymmetry {}

#[cfg(test)]
mod tests {
    use super::*;

    fn part(x: f32, y: f32, angle: f32) -> SymmetryPart {
        let shape = Shape::Box { width: 0.1, height: 0.4 };
        SymmetryPart { shape, x, y, angle, density: 10.0, friction: 1.0 }
    }

    fn hinge(parent: usize, child: usize, x: f32) -> SymmetryHinge {
        SymmetryHinge {
            parent,
            child,
            parent_anchor: [x, -0.1],
            child_anchor: [0.0, 0.2],
            limits: if x < 0.0 { [-0.5, 1.0] } else { [-1.0, 0.5] },
            motor: Some([8.0, 30.0]),
            actuated: true,
        }
    }

    /// A torso with two legs on either side.
    fn body() -> (Vec<SymmetryPart>, Vec<SymmetryHinge>) {
        let places = [0.5, 0.5, -0.5, -0.5];
        let parts = places.iter().map(|&x| part(2.0 + x, 0.7, 0.3 * x));
        let hinges = places.iter().enumerate().map(|(index, &x)| hinge(0, index + 1, x)).collect();
        ([part(2.0, 1.0, 0.0)].into_iter().chain(parts).collect(), hinges)
    }

    #[test]
    fn a_body_with_the_same_legs_on_both_sides_is_symmetric() {
        let (parts, hinges) = body();
        assert_eq!(twins(&parts, &hinges), Ok(vec![0, 3, 4, 1, 2]));
        assert_eq!(twins(&[], &[]), Ok(vec![]));
        assert_eq!(twins(&parts[..1], &[]), Ok(vec![0]));
    }

    #[test]
    fn every_difference_is_found() {
        let changed = |change: &dyn Fn(&mut SymmetryPart)| {
            let (mut parts, hinges) = body();
            change(&mut parts[2]);
            twins(&parts, &hinges)
        };
        assert_eq!(changed(&|part| part.x += 0.01), Err(Asymmetry::Part(2)));
        assert_eq!(changed(&|part| part.y += 0.01), Err(Asymmetry::Part(2)));
        assert_eq!(changed(&|part| part.angle += 0.01), Err(Asymmetry::Part(2)));
        assert_eq!(changed(&|part| part.angle += 0.5 * TAU), Err(Asymmetry::Part(2)));
        assert_eq!(changed(&|part| part.angle += TAU), changed(&|_| {}));
        assert_eq!(changed(&|part| part.density *= 1.01), Err(Asymmetry::Part(2)));
        assert_eq!(changed(&|part| part.friction += 0.1), Err(Asymmetry::Part(2)));
        let changed = |change: &dyn Fn(&mut SymmetryHinge)| {
            let (parts, mut hinges) = body();
            change(&mut hinges[1]);
            twins(&parts, &hinges)
        };
        assert_eq!(changed(&|hinge| hinge.limits[0] -= 0.1), Err(Asymmetry::Hinge(2)));
        assert_eq!(changed(&|hinge| hinge.parent_anchor[0] += 0.01), Err(Asymmetry::Hinge(2)));
        assert_eq!(changed(&|hinge| hinge.motor = None), Err(Asymmetry::Hinge(2)));
        assert_eq!(changed(&|hinge| hinge.actuated = false), Err(Asymmetry::Hinge(2)));
    }
}
