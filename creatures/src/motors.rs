//! From the outputs of a net to the motors of a body.

use crate::{Blueprint, Channel};

/// What a net moves: one output for each actuated hinge, in the order of [`Blueprint::actuated`].
#[derive(Clone, Debug, PartialEq)]
pub struct Motors {
    channels: Vec<Channel>,
    top_speeds: Vec<f32>,
}

impl Motors {
    /// The motors of a creature.
    pub fn new(blueprint: &Blueprint) -> Self {
        let hinges = || blueprint.actuated().iter().map(|&index| &blueprint.hinges()[index]);
        let top_speeds: Vec<f32> = hinges().map(|hinge| hinge.motor.map_or(0.0, |motor| motor.top_speed)).collect();
        let channels = hinges()
            .zip(&top_speeds)
            .map(|(hinge, &top)| Channel {
                name: format!("speed of {}", blueprint.parts()[hinge.child].name),
                unit: "rad/s",
                range: [-top, top],
            })
            .collect();
        Self { channels, top_speeds }
    }

    /// The channels, in the order of the net's outputs: -1 asks for the lower end of a channel's range, 1 for the upper.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// Number of motors: outputs of the net. At least one.
    pub fn len(&self) -> usize {
        self.top_speeds.len()
    }

    /// Always false: a creature without motors is an error.
    pub fn is_empty(&self) -> bool {
        self.top_speeds.is_empty()
    }

    /// Turns outputs of a net into the speeds asked of the motors, rad/s. Outputs beyond [-1, 1] count as its ends; NaN
    /// stays NaN, for the engine to report as a failure. Allocates nothing.
    ///
    /// # Panics
    /// If `outputs` or `speeds` is not as long as there are motors.
    pub fn speeds(&self, outputs: &[f32], speeds: &mut [f32]) {
        assert_eq!(outputs.len(), self.top_speeds.len(), "one output for each motor");
        assert_eq!(speeds.len(), self.top_speeds.len(), "one speed for each motor");
        for ((speed, output), top) in speeds.iter_mut().zip(outputs).zip(&self.top_speeds) {
            // `clamp` keeps NaN.
            *speed = output.clamp(-1.0, 1.0) * top;
        }
    }
}
