use crate::{GroundShape, PhysicsSettings, bumps};
use ne_core::{Purpose, Seed, SettingError};
use rand::RngExt;
use serde::{Deserialize, Deserializer, Serialize};

const TRIAL_VARIATION: Purpose = Purpose::new("trial variation");
const TRIAL_BUMPS: Purpose = Purpose::new("trial bumps");
const TRIAL_TERRAIN: Purpose = Purpose::new("trial terrain");

/// Body lengths.
const BUMPS_REACH: f32 = 20.0;

/// How much the world differs from trial to trial, so that a gait cannot lean on one exact world. Friction, mass and torque
/// are shares: 0.2 draws a factor uniformly from 0.8 to 1.2. From 0 to 0.9; default 0, no variation.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct Variation {
    /// Of the ground's friction coefficient.
    pub friction: f32,
    /// Of the density of all parts together.
    pub mass: f32,
    /// Of the top torque of all motors together.
    pub torque: f32,
    /// The least and the greatest factor on [`PhysicsSettings::time_step`], drawn log-uniformly: a gait that needs steps
    /// of one length leans on the engine's errors. From 0.1 to 1 and from 1 to 2; default 1 and 1. A file may have a
    /// share in its place: 0.2 is read as 0.8 and 1.2.
    #[serde(deserialize_with = "factors")]
    pub time_step: [f32; 2],
    /// By up to this much, rad, each actuated joint is turned, either way, before the clock starts. Its own motor turns
    /// it, so a leg that bears weight turns less far. From 0 to 1; default 0.
    pub start_pose: f32,
    /// The highest of the [bumps](crate::bumps()) on the ground, m, for as far as 20 body lengths; the lowest are a tenth
    /// as high. 0, or from 0.01 to 0.1; default 0, none.
    pub bumps: f32,
    /// Whether each trial draws a seed of its own for the terrain, so that no terrain is learned by heart; default `false`:
    /// all have that of the terrain's own seed.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub terrain: bool,
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

impl Default for Variation {
    /// None.
    fn default() -> Self {
        Self {
            friction: 0.0,
            mass: 0.0,
            torque: 0.0,
            time_step: [1.0, 1.0],
            start_pose: 0.0,
            bumps: 0.0,
            terrain: false,
        }
    }
}

/// Two factors, or the share they are off 1.
fn factors<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f32; 2], D::Error> {
    #[derive(Deserialize)]
    #[serde(untagged, expecting = "expected the least and the greatest factor, such as [0.8, 1.2]")]
    enum Written {
        Factors([f32; 2]),
        Share(f32),
    }
    Ok(match Written::deserialize(deserializer)? {
        Written::Factors(factors) => factors,
        Written::Share(share) => [1.0 - share, 1.0 + share],
    })
}

impl Variation {
    /// The world of a training run: a gait evolved in one exact world is brittle.
    ///
    /// Friction ± 30 %, mass and torque ± 10 %, steps between 0.42 and 1.25 times as long (1/120 to 1/40 s in place of
    /// 1/50), and every actuated joint turned by up to 0.05 rad (3°).
    pub const fn light() -> Self {
        Self {
            friction: 0.3,
            mass: 0.1,
            torque: 0.1,
            time_step: [0.42, 1.25],
            start_pose: 0.05,
            bumps: 0.0,
            terrain: false,
        }
    }

    /// More than [`light`](Self::light): friction ± 50 %, mass and torque ± 20 %, steps between 0.33 and 1.5 times as long,
    /// every actuated joint turned by up to 0.1 rad (6°), and bumps up to 2 cm high.
    pub const fn strong() -> Self {
        Self {
            friction: 0.5,
            mass: 0.2,
            torque: 0.2,
            time_step: [0.33, 1.5],
            start_pose: 0.1,
            bumps: 0.02,
            terrain: false,
        }
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
            ("start_pose", self.start_pose, 1.0),
        ];
        for (field, value, high) in ranges {
            if !(0.0..=high).contains(&value) {
                return Err(SettingError::new(field, value, format!("from 0 to {high}")));
            }
        }
        if self.bumps != 0.0 && !(0.01..=0.1).contains(&self.bumps) {
            return Err(SettingError::new("bumps", self.bumps, "0, or from 0.01 to 0.1"));
        }
        let [least, greatest] = self.time_step;
        if !((0.1..=1.0).contains(&least) && (1.0..=2.0).contains(&greatest)) {
            let allowed = "a factor from 0.1 to 1 and one from 1 to 2";
            return Err(SettingError::new("time_step", format!("[{least}, {greatest}]"), allowed));
        }
        Ok(())
    }

    /// The world of the trial with this seed, for a creature with so many actuated joints.
    pub fn draw(&self, seed: Seed, motors: usize) -> Conditions {
        let mut stream = seed.stream(TRIAL_VARIATION);
        // From −1 to 1. The order of the draws is part of every recorded run.
        let mut draw = || 2.0 * stream.random::<f32>() - 1.0;
        Conditions {
            friction: 1.0 + self.friction * draw(),
            mass: 1.0 + self.mass * draw(),
            torque: 1.0 + self.torque * draw(),
            time_step: self.time_step_at(0.5 * (1.0 + draw())),
            turns: (0..motors).map(|_| self.start_pose * draw()).collect(),
        }
    }

    /// The bumps of the trial with this seed, for a creature that stands from `left` to `right`, m, and is so long.
    pub(crate) fn draw_bumps(&self, seed: Seed, [left, right]: [f32; 2], body_length: f32) -> Vec<GroundShape> {
        if self.bumps == 0.0 {
            return Vec::new();
        }
        let heights = [0.1 * self.bumps, self.bumps];
        bumps(&mut seed.stream(TRIAL_BUMPS), heights, [left, right], BUMPS_REACH * body_length)
    }

    /// The seed of the terrain of the trial with this seed, if it has one of its own.
    pub(crate) fn draw_terrain(&self, seed: Seed) -> Option<u64> {
        self.terrain.then(|| seed.stream(TRIAL_TERRAIN).random())
    }

    /// The factor on the time step, from the least at 0 to the greatest at 1.
    fn time_step_at(&self, place: f32) -> f32 {
        let [least, greatest] = self.time_step.map(libm::logf);
        libm::expf(least + (greatest - least) * place)
    }
}
