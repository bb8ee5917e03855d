use crate::{PhysicsSettings, Push};
use ne_core::SettingError;

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
    /// Factor on gravity.
    pub gravity: f32,
    /// Factor on [`PhysicsSettings::motor_gain`].
    pub motor_gain: f32,
    /// Factor on [`PhysicsSettings::joint_frequency`].
    pub joint_frequency: f32,
    /// Factor on [`PhysicsSettings::contact_frequency`].
    pub contact_frequency: f32,
    /// Factor on [`PhysicsSettings::contact_damping_ratio`].
    pub contact_damping: f32,
    /// In place of [`PhysicsSettings::solver_iterations`]; none: as the settings have it.
    pub solver_iterations: Option<u32>,
    /// What is added to the torso's spin once the creature has settled, rad/s.
    pub torso_spin: f32,
    /// Pushes against the torso, in any order.
    pub pushes: Vec<Push>,
}

/// The fastest push, m/s either way.
const FASTEST_PUSH: f32 = 100.0;

impl Conditions {
    /// The world as the settings have it, for a creature with so many actuated joints.
    pub fn reference(motors: usize) -> Self {
        Self {
            friction: 1.0,
            mass: 1.0,
            torque: 1.0,
            time_step: 1.0,
            turns: vec![0.0; motors],
            gravity: 1.0,
            motor_gain: 1.0,
            joint_frequency: 1.0,
            contact_frequency: 1.0,
            contact_damping: 1.0,
            solver_iterations: None,
            torso_spin: 0.0,
            pushes: Vec::new(),
        }
    }

    /// Checks that every number is finite, every factor above 0 (those on friction and gravity may be 0), that there is a
    /// turn for each of so many actuated joints, and that every push is in range.
    ///
    /// # Errors
    /// Names the field and what it must be.
    pub fn validate(&self, motors: usize) -> Result<(), SettingError> {
        let factors = [
            ("mass", self.mass),
            ("torque", self.torque),
            ("time_step", self.time_step),
            ("motor_gain", self.motor_gain),
            ("joint_frequency", self.joint_frequency),
            ("contact_frequency", self.contact_frequency),
            ("contact_damping", self.contact_damping),
        ];
        for (field, factor) in factors {
            if !(factor.is_finite() && factor > 0.0) {
                return Err(SettingError::new(field, factor, "finite and above 0"));
            }
        }
        for (field, factor) in [("friction", self.friction), ("gravity", self.gravity)] {
            if !(factor.is_finite() && factor >= 0.0) {
                return Err(SettingError::new(field, factor, "finite and at least 0"));
            }
        }
        if self.turns.len() != motors {
            let found = format!("{} turns", self.turns.len());
            return Err(SettingError::new("turns", found, format!("{motors}, one for each actuated joint")));
        }
        if let Some(turn) = self.turns.iter().find(|turn| !turn.is_finite()) {
            return Err(SettingError::new("turns", turn, "finite"));
        }
        if !self.torso_spin.is_finite() {
            return Err(SettingError::new("torso_spin", self.torso_spin, "finite"));
        }
        for (index, Push { time, velocity }) in self.pushes.iter().enumerate() {
            if !(time.is_finite() && *time >= 0.0) {
                return Err(SettingError::new(format!("pushes[{index}].time"), time, "finite and at least 0"));
            }
            if !(-FASTEST_PUSH..=FASTEST_PUSH).contains(velocity) {
                let allowed = format!("from -{FASTEST_PUSH} to {FASTEST_PUSH}");
                return Err(SettingError::new(format!("pushes[{index}].velocity"), velocity, allowed));
            }
        }
        Ok(())
    }

    /// The settings of this trial: those given, with its time step, gravity, motors, joints, contacts and iterations.
    pub(crate) fn settings(&self, settings: &PhysicsSettings) -> PhysicsSettings {
        PhysicsSettings {
            time_step: settings.time_step * self.time_step,
            gravity: settings.gravity * self.gravity,
            solver_iterations: self.solver_iterations.unwrap_or(settings.solver_iterations),
            joint_frequency: settings.joint_frequency * self.joint_frequency,
            contact_frequency: settings.contact_frequency * self.contact_frequency,
            contact_damping_ratio: settings.contact_damping_ratio * self.contact_damping,
            motor_gain: settings.motor_gain * self.motor_gain,
            ..*settings
        }
    }
}
