//! How an output of a net drives a motor.

use crate::limit;
#[cfg(feature = "files")]
use serde::{Deserialize, Serialize};

/// What an output of the net means to its motor. In a file: `"speed"`, or `{"angle": {"gain": 10}}`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[cfg_attr(feature = "files", derive(Serialize, Deserialize), serde(rename_all = "kebab-case", deny_unknown_fields))]
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
        #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 50.0)))]
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

    /// The speed asked of the motor for an output of the net, rad/s. Outputs beyond [-1, 1] count as its ends; NaN stays NaN.
    /// `angle`: that of its hinge, rad, asked for if outputs mean angles.
    #[inline]
    pub fn speed(&self, actuation: Actuation, output: f32, angle: impl FnOnce() -> f32) -> f32 {
        let wanted = limit(output, -1.0, 1.0);
        match actuation {
            Actuation::Speed => wanted * self.top_speed,
            Actuation::Angle { gain } => {
                let target = limit(wanted * self.reach(), self.limits[0], self.limits[1]);
                limit((target - angle()) * gain, -self.top_speed, self.top_speed)
            }
        }
    }
}
