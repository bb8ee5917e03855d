//! Turning round: a body that looks the same from both sides runs both ways with one net.

use crate::{Character, Facing, PartState};
use alloc::vec::Vec;
use creatures::symmetry::{Asymmetry, SymmetryHinge, SymmetryPart, twins};

/// Which part, and which output, is the mirror image of each.
#[derive(Clone, Debug)]
pub(crate) struct Twins {
    parts: Vec<usize>,
    outputs: Vec<usize>,
}

impl Character {
    /// Whether its body looks the same from both sides, so that its player can [turn round](crate::Player::face).
    ///
    /// # Errors
    /// The first part that has no mirror image, or whose hinge is not that of its mirror image.
    pub fn symmetry(&self) -> Result<(), Asymmetry> {
        self.twins().map(|_| ())
    }

    pub(crate) fn twins(&self) -> Result<Twins, Asymmetry> {
        let part = |part: &crate::Part| SymmetryPart {
            shape: part.shape,
            x: part.x,
            y: part.y,
            angle: part.angle,
            density: part.density,
            friction: part.friction,
        };
        let hinge = |(index, hinge): (usize, &crate::Hinge)| SymmetryHinge {
            parent: hinge.parent.into(),
            child: hinge.child.into(),
            parent_anchor: hinge.parent_anchor,
            child_anchor: hinge.child_anchor,
            limits: hinge.limits,
            motor: hinge.motor.map(|motor| [motor.top_speed, motor.top_torque]),
            actuated: self.outputs.iter().any(|&output| usize::from(output) == index),
        };
        let parts: Vec<SymmetryPart> = self.parts.iter().map(part).collect();
        let hinges: Vec<SymmetryHinge> = self.hinges.iter().enumerate().map(hinge).collect();
        let parts = twins(&parts, &hinges)?;
        let child = |output: u16| usize::from(self.hinges[usize::from(output)].child);
        let output_twin = |&output: &u16| {
            let twin = parts[child(output)];
            self.outputs.iter().position(|&other| child(other) == twin).ok_or(Asymmetry::Hinge(child(output)))
        };
        let outputs = self.outputs.iter().map(output_twin).collect::<Result<_, _>>()?;
        Ok(Twins { parts, outputs })
    }
}

/// How a net that knows a body that faces right sees the one it moves, and moves it.
#[derive(Clone, Debug)]
pub(crate) struct View {
    /// Whether right and left are swapped.
    mirrored: bool,
    /// Which part takes the place of which, if the body was built to face the other way.
    twins: Option<Twins>,
}

impl View {
    /// Of a body that faces as it was built.
    pub(crate) fn new(facing: Facing) -> Self {
        Self { mirrored: facing == Facing::Left, twins: None }
    }

    /// Of a body that faces this way.
    pub(crate) fn turned(character: &Character, facing: Facing) -> Result<Self, Asymmetry> {
        let twins = if facing == character.facing { None } else { Some(character.twins()?) };
        Ok(Self { twins, ..Self::new(facing) })
    }

    pub(crate) fn facing(&self) -> Facing {
        if self.mirrored { Facing::Left } else { Facing::Right }
    }

    /// The parts as the net knows them.
    pub(crate) fn see(&self, parts: &[PartState], seen: &mut [PartState]) {
        for (index, seen) in seen.iter_mut().enumerate() {
            let part = parts[self.twins.as_ref().map_or(index, |twins| twins.parts[index])];
            *seen = if self.mirrored { part.mirrored() } else { part };
        }
    }

    /// Where the speed that the net asks for goes, and what becomes of it.
    pub(crate) fn drive(&self, output: usize, speed: f32) -> (usize, f32) {
        let place = self.twins.as_ref().map_or(output, |twins| twins.outputs[output]);
        (place, if self.mirrored { -speed } else { speed })
    }
}
