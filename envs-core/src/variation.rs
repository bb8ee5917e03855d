use crate::PhysicsSettings;
use ne_core::{Purpose, Seed, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

const TRIAL_VARIATION: Purpose = Purpose::new("trial variation");

/// How much the world differs from trial to trial, so that a gait cannot lean on one exact world. Each field but
/// `start_pose` is a share: 0.2 draws a factor uniformly from 0.8 to 1.2. From 0 to 0.9; default 0, no variation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Variation {
    /// Of the ground's friction coefficient.
    pub friction: f32,
    /// Of the density of all parts together.
    pub mass: f32,
    /// Of the top torque of all motors together.
    pub torque: f32,
    /// Of [`PhysicsSettings::time_step`]: a gait that needs steps of one length leans on the engine's errors.
    pub time_step: f32,
    /// By up to this much, rad, each actuated joint is turned, either way, before the clock starts. Its own motor turns
    /// it, so a leg that bears weight turns less far. From 0 to 1; default 0.
    pub start_pose: f32,
}

/// The world of one trial, against that of the settings.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    /// Factor on the ground's friction coefficient.
    pub friction: f32,
    /// Factor on the density of every part.
    pub mass: f32,
    /// Factor on the top torque of every motor.
    pub torque: f32,
    /// Factor on the time step.
    pub time_step: f32,
    /// How far each actuated joint's motor is to turn it before the clock starts, rad, in order of
    /// [`Blueprint::actuated`](creatures::Blueprint::actuated).
    pub turns: Vec<f32>,
}

impl Conditions {
    /// The world as the settings have it, for a creature with so many actuated joints.
    pub fn nominal(motors: usize) -> Self {
        Self { friction: 1.0, mass: 1.0, torque: 1.0, time_step: 1.0, turns: vec![0.0; motors] }
    }

    /// Checks that every number is finite, every factor above 0 (that on friction may be 0), and that there is a turn
    /// for each of so many actuated joints.
    ///
    /// # Errors
    /// Names the field and what it must be.
    pub fn validate(&self, motors: usize) -> Result<(), SettingError> {
        let factors = [("mass", self.mass), ("torque", self.torque), ("time_step", self.time_step)];
        for (field, factor) in factors {
            if !(factor.is_finite() && factor > 0.0) {
                return Err(SettingError::new(field, factor, "finite and above 0"));
            }
        }
        if !(self.friction.is_finite() && self.friction >= 0.0) {
            return Err(SettingError::new("friction", self.friction, "finite and at least 0"));
        }
        if self.turns.len() != motors {
            let found = format!("{} turns", self.turns.len());
            return Err(SettingError::new("turns", found, format!("{motors}, one for each actuated joint")));
        }
        match self.turns.iter().find(|turn| !turn.is_finite()) {
            Some(turn) => Err(SettingError::new("turns", turn, "finite")),
            None => Ok(()),
        }
    }

    /// The settings of this trial: those given, with its time step.
    pub(crate) fn settings(&self, settings: &PhysicsSettings) -> PhysicsSettings {
        PhysicsSettings { time_step: settings.time_step * self.time_step, ..*settings }
    }
}

impl Variation {
    /// The world of a training run: a gait evolved in one exact world is brittle.
    ///
    /// Friction ± 30 %, mass and torque ± 10 %, time step ± 20 %, and every actuated joint turned by up to 0.05 rad (3°).
    pub const fn light() -> Self {
        Self { friction: 0.3, mass: 0.1, torque: 0.1, time_step: 0.2, start_pose: 0.05 }
    }

    /// More than [`light`](Self::light): friction ± 50 %, mass and torque ± 20 %, time step ± 40 %, and every actuated
    /// joint turned by up to 0.1 rad (6°).
    pub const fn strong() -> Self {
        Self { friction: 0.5, mass: 0.2, torque: 0.2, time_step: 0.4, start_pose: 0.1 }
    }

    /// Whether every trial has the same world.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Checks every range.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        let ranges = [
            ("friction", self.friction, 0.9),
            ("mass", self.mass, 0.9),
            ("torque", self.torque, 0.9),
            ("time_step", self.time_step, 0.9),
            ("start_pose", self.start_pose, 1.0),
        ];
        for (field, value, high) in ranges {
            if !(0.0..=high).contains(&value) {
                return Err(SettingError::new(field, value, format!("from 0 to {high}")));
            }
        }
        Ok(())
    }

    /// The world of the trial with this seed, for a creature with so many actuated joints.
    pub fn draw(&self, seed: Seed, motors: usize) -> Conditions {
        let mut stream = seed.stream(TRIAL_VARIATION);
        // Uniform from −share to share. The order of the draws is part of every recorded run.
        let mut draw = |share: f32| share * (2.0 * stream.random::<f32>() - 1.0);
        Conditions {
            friction: 1.0 + draw(self.friction),
            mass: 1.0 + draw(self.mass),
            torque: 1.0 + draw(self.torque),
            time_step: 1.0 + draw(self.time_step),
            turns: (0..motors).map(|_| draw(self.start_pose)).collect(),
        }
    }
}
