//! From the outputs of a net to the motors of a body.

use crate::{Blueprint, BodyView, Channel};
use serde::{Deserialize, Serialize};

/// What an output of the net means to its motor. In a file: `"speed"`, or `{"angle": {"gain": 10}}`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Actuation {
    /// The speed asked for: ±1 is the motor's top speed, either way. What the thesis did, and the default.
    #[default]
    Speed,
    /// The angle asked for: ±1 is plus or minus the larger of the joint's limits, clamped to both. The motor is asked for
    /// the speed `gain` × (angle asked for − angle of the joint), never more than its top speed. Since the motor in turn
    /// gives a torque in proportion to the speed that is lacking, that is a proportional-derivative law; outputs that
    /// rest let joints rest.
    Angle {
        /// Speed asked for, per angle that is lacking, 1/s, 0.1 to 50.
        gain: f32,
    },
}

impl Actuation {
    /// Angles, with a gain that follows a stride of half a second without lagging much, and is soft enough for 50 steps
    /// a second.
    pub const fn angle() -> Self {
        Self::Angle { gain: 10.0 }
    }

    /// The gains allowed, 1/s.
    pub const GAINS: [f32; 2] = [0.1, 50.0];

    /// Whether its gain is in range.
    pub fn is_valid(self) -> bool {
        match self {
            Self::Speed => true,
            Self::Angle { gain } => (Self::GAINS[0]..=Self::GAINS[1]).contains(&gain),
        }
    }
}

/// What a net moves: one output for each actuated hinge, in the order of [`Blueprint::actuated`].
#[derive(Clone, Debug, PartialEq)]
pub struct Motors {
    actuation: Actuation,
    channels: Vec<Channel>,
    drives: Vec<Drive>,
}

/// One motor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drive {
    /// Index of its hinge.
    pub hinge: usize,
    /// rad/s.
    pub top_speed: f32,
    /// Smallest and largest angle of the hinge, rad.
    pub limits: [f32; 2],
}

impl Drive {
    /// The larger of the limits, rad: what an output of 1 asks for where outputs ask for angles.
    pub fn reach(&self) -> f32 {
        self.limits[0].abs().max(self.limits[1].abs())
    }
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
            // `clamp` keeps NaN.
            let wanted = output.clamp(-1.0, 1.0);
            *speed = match self.actuation {
                Actuation::Speed => wanted * drive.top_speed,
                Actuation::Angle { gain } => {
                    let target = (wanted * drive.reach()).clamp(drive.limits[0], drive.limits[1]);
                    ((target - body.joint_angle(drive.hinge)) * gain).clamp(-drive.top_speed, drive.top_speed)
                }
            };
        }
    }
}
