//! From the outputs of a net to the motors of a body.

use crate::{Actuation, Blueprint, BodyView, Channel, Drive};

/// What a net moves: one output for each actuated hinge, in the order of [`Blueprint::actuated`].
#[derive(Clone, Debug, PartialEq)]
pub struct Motors {
    actuation: Actuation,
    channels: Vec<Channel>,
    drives: Vec<Drive>,
}

impl Motors {
    /// The motors of a creature, with outputs that ask for speeds.
    pub fn new(blueprint: &Blueprint) -> Self {
        Self::with_actuation(blueprint, Actuation::Speed)
    }

    /// The motors of a creature.
    pub fn with_actuation(blueprint: &Blueprint, actuation: Actuation) -> Self {
        let drive = |&index: &usize| {
            let hinge = &blueprint.hinges()[index];
            Drive { hinge: index, top_speed: hinge.motor.map_or(0.0, |motor| motor.top_speed), limits: hinge.limits }
        };
        let drives: Vec<Drive> = blueprint.actuated().iter().map(drive).collect();
        let channel = |drive: &Drive| {
            let part = &blueprint.parts()[blueprint.hinges()[drive.hinge].child].name;
            let (what, unit, most) = match actuation {
                Actuation::Speed => ("speed", "rad/s", drive.top_speed),
                Actuation::Angle { .. } => ("angle", "rad", drive.reach()),
            };
            Channel { name: format!("{what} of {part}"), unit, range: [-most, most] }
        };
        Self { actuation, channels: drives.iter().map(channel).collect(), drives }
    }

    /// What an output means.
    pub fn actuation(&self) -> Actuation {
        self.actuation
    }

    /// The channels, in the order of the net's outputs: -1 asks for the lower end of a channel's range, 1 for the upper.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// What each output drives, in their order.
    pub fn drives(&self) -> &[Drive] {
        &self.drives
    }

    /// Number of motors: outputs of the net. At least one.
    pub fn len(&self) -> usize {
        self.drives.len()
    }

    /// Always false: a creature without motors is an error.
    pub fn is_empty(&self) -> bool {
        self.drives.is_empty()
    }

    /// Turns outputs of a net into the speeds asked of the motors, rad/s. Outputs beyond [-1, 1] count as its ends; NaN
    /// stays NaN, for the engine to report as a failure. The body is asked for its joint angles, if outputs mean angles.
    /// Allocates nothing.
    ///
    /// # Panics
    /// If `outputs` or `speeds` is not as long as there are motors.
    pub fn speeds<B: BodyView + ?Sized>(&self, body: &B, outputs: &[f32], speeds: &mut [f32]) {
        assert_eq!(outputs.len(), self.drives.len(), "one output for each motor");
        assert_eq!(speeds.len(), self.drives.len(), "one speed for each motor");
        for ((speed, output), drive) in speeds.iter_mut().zip(outputs).zip(&self.drives) {
            *speed = drive.speed(self.actuation, *output, || body.joint_angle(drive.hinge));
        }
    }
}
