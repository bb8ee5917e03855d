//! A pose as angles: what an animation is made of.

use creatures::{Blueprint, Hinge};
use std::f64::consts::{PI, TAU};
use tasks::{PartState, Snapshot};

/// Where the torso is, and the angle of each hinge.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// Centre of the torso, forward, m.
    pub x: f64,
    /// Centre of the torso, up, m.
    pub y: f64,
    /// Angle of the torso in the world, counter-clockwise, rad.
    pub angle: f64,
    /// Angle of each hinge, child against parent, relative to the start pose, rad.
    pub hinges: Vec<f64>,
}

impl Pose {
    /// The pose of a body.
    pub fn of(blueprint: &Blueprint, snapshot: &Snapshot) -> Self {
        let parts = &snapshot.parts;
        let angle = |part: usize| f64::from(parts[part].angle());
        let hinge = |hinge: &Hinge| wrapped(angle(hinge.child) - angle(hinge.parent) - rest_angle(blueprint, hinge));
        Self {
            x: parts[0].x.into(),
            y: parts[0].y.into(),
            angle: angle(0),
            hinges: blueprint.hinges().iter().map(hinge).collect(),
        }
    }

    /// Where every part is: each hangs on its hinge exactly, as it nearly does in the physics.
    pub fn snapshot(&self, blueprint: &Blueprint) -> Snapshot {
        let mut placed = vec![(self.x, self.y, self.angle); blueprint.parts().len()];
        // A parent stands before its child.
        let mut order: Vec<usize> = (0..self.hinges.len()).collect();
        order.sort_by_key(|&hinge| blueprint.hinges()[hinge].child);
        for index in order {
            let hinge = &blueprint.hinges()[index];
            let parent = placed[hinge.parent];
            let angle = parent.2 + rest_angle(blueprint, hinge) + self.hinges[index];
            let ([px, py], [cx, cy]) = (turned(hinge.parent_anchor, parent.2), turned(hinge.child_anchor, angle));
            placed[hinge.child] = (parent.0 + px - cx, parent.1 + py - cy, angle);
        }
        let part = |(x, y, angle): (f64, f64, f64)| {
            let (sin, cos) = libm::sincos(angle);
            PartState { x: x as f32, y: y as f32, cos: cos as f32, sin: sin as f32, ..PartState::default() }
        };
        Snapshot { parts: placed.into_iter().map(part).collect(), ..Snapshot::default() }
    }

    /// This pose, moved towards another by a share of the way: 0 is this, 1 the other.
    pub(crate) fn towards(&self, other: &Self, share: f64) -> Self {
        let between = |from: f64, to: f64| from + share * (to - from);
        let turned = |from: f64, to: f64| from + share * wrapped(to - from);
        Self {
            x: between(self.x, other.x),
            y: between(self.y, other.y),
            angle: turned(self.angle, other.angle),
            hinges: self.hinges.iter().zip(&other.hinges).map(|(&from, &to)| turned(from, to)).collect(),
        }
    }

    /// How far another pose is from this one, its place along the ground aside: the greatest angle between them, rad, and the
    /// height, m.
    pub(crate) fn difference(&self, other: &Self) -> (f64, f64) {
        let hinges = self.hinges.iter().zip(&other.hinges).map(|(one, other)| wrapped(other - one).abs());
        (hinges.fold(wrapped(other.angle - self.angle).abs(), f64::max), (other.y - self.y).abs())
    }
}

/// Angle of the child against the parent in the start pose, rad.
pub(crate) fn rest_angle(blueprint: &Blueprint, hinge: &Hinge) -> f64 {
    let parts = blueprint.parts();
    f64::from(parts[hinge.child].angle) - f64::from(parts[hinge.parent].angle)
}

/// Less whole turns: from −π to π.
pub(crate) fn wrapped(angle: f64) -> f64 {
    let turns = (angle / TAU).round();
    (angle - turns * TAU).clamp(-PI, PI)
}

fn turned([x, y]: [f32; 2], angle: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(angle);
    let (x, y) = (f64::from(x), f64::from(y));
    [cos * x - sin * y, sin * x + cos * y]
}
