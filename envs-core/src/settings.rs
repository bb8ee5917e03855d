use crate::Water;
use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// How an engine steps a creature: rapier's settings, which every engine takes, each with what breaks without it.
///
/// The defaults were found by measuring small creatures with strong motors. They are not rapier's own.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct PhysicsSettings {
    /// Seconds a step lasts, from 1/1000 to 1/20; default 0.02.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 0.05)))]
    pub time_step: f32,
    /// Downward acceleration, m/s², from 0 to 100; default 9.81.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 100.0)))]
    pub gravity: f32,
    /// Friction coefficient of the ground, from 0 to 10; default 1. A part's own coefficient is multiplied with it.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10.0)))]
    pub ground_friction: f32,
    /// Solver iterations (substeps) a step, from 1 to 32; default 2. Fewer is faster and softer.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 32)))]
    pub solver_iterations: u32,
    /// Gauss–Seidel sweeps in each iteration, from 1 to 32; default 4. Fewer lets joints come apart.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 32)))]
    pub internal_iterations: u32,
    /// Substeps of continuous collision detection, from 0 to 8; default 0, which turns it off. It moves a fast body
    /// back without the bodies it is jointed to, which tears joints apart.
    #[cfg_attr(feature = "schema", schemars(range(min = 0, max = 8)))]
    pub continuous_collision_substeps: u32,
    /// From how far away contacts are prepared, m, from 0.001 to 1; default 0.1. With less, and without continuous
    /// collision detection, feet sink deep into the ground before it answers.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.001, max = 1.0)))]
    pub prediction_distance: f32,
    /// Natural frequency of joints, Hz, from 1 to 1e7; default 60. Joints as hard as rapier's default (1e6) pump energy
    /// into a body that only falls.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 1e7)))]
    pub joint_frequency: f32,
    /// Damping ratio of joints, from 0.01 to 100; default 1 (critical).
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 100.0)))]
    pub joint_damping_ratio: f32,
    /// Natural frequency of contacts with the ground, Hz, from 1 to 1e7; default 60, as rapier has it. Softer ground lets feet
    /// sink in. Contacts between parts have half of it.
    #[serde(skip_serializing_if = "is_default_contact_frequency")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 1e7)))]
    pub contact_frequency: f32,
    /// Damping ratio of contacts, from 0.01 to 100; default 10, as rapier has it: what is in the ground is pushed out slowly
    /// and does not bounce.
    #[serde(skip_serializing_if = "is_default_contact_damping_ratio")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 100.0)))]
    pub contact_damping_ratio: f32,
    /// The fastest a violated constraint is corrected, m/s and rad/s, from 0.1 to 1000; default 20. With rapier's 3 a
    /// strong motor turns a leg right through its joint limit.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 1000.0)))]
    pub corrective_speed: f32,
    /// Gain of the motors, N·m per rad/s, from 0.01 to 1e6; default 20. Large enough that a motor gives its top torque
    /// unless it is close to the speed asked for.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 1e6)))]
    pub motor_gain: f32,
    /// How long a creature may settle before the clock starts, s, from 0 to 60; default 1. It stops earlier once at
    /// rest.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 60.0)))]
    pub settle_time: f32,
    /// The speed of any part, along x or along y, above which the simulation counts as exploded, m/s, from 1 to 400 (where rapier
    /// caps speeds); default 100.
    #[cfg_attr(feature = "schema", schemars(range(min = 1.0, max = 400.0)))]
    pub unstable_speed: f32,
    /// Water all around in place of the ground; `null`, the default: none. A creature in water does not settle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub water: Option<Water>,
}

/// Hz.
const CONTACT_FREQUENCY: f32 = 60.0;
const CONTACT_DAMPING_RATIO: f32 = 10.0;

// Files written before these settings were there stay what they were to the byte. The signatures are serde's.

#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_default_contact_frequency(value: &f32) -> bool {
    *value == CONTACT_FREQUENCY
}

#[allow(clippy::trivially_copy_pass_by_ref)]
fn is_default_contact_damping_ratio(value: &f32) -> bool {
    *value == CONTACT_DAMPING_RATIO
}

impl Default for PhysicsSettings {
    fn default() -> Self {
        Self {
            time_step: 0.02,
            gravity: 9.81,
            ground_friction: 1.0,
            solver_iterations: 2,
            internal_iterations: 4,
            continuous_collision_substeps: 0,
            prediction_distance: 0.1,
            joint_frequency: 60.0,
            joint_damping_ratio: 1.0,
            contact_frequency: CONTACT_FREQUENCY,
            contact_damping_ratio: CONTACT_DAMPING_RATIO,
            corrective_speed: 20.0,
            motor_gain: 20.0,
            settle_time: 1.0,
            unstable_speed: 100.0,
            water: None,
        }
    }
}

impl PhysicsSettings {
    /// Checks every range.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        let counts = [
            ("solver_iterations", self.solver_iterations, 1.0, 32.0),
            ("internal_iterations", self.internal_iterations, 1.0, 32.0),
            ("continuous_collision_substeps", self.continuous_collision_substeps, 0.0, 8.0),
        ];
        for (field, count, low, high) in counts {
            SettingError::check_range(field, count, low, high)?;
        }
        let ranges = [
            ("time_step", self.time_step, 0.001, 0.05),
            ("gravity", self.gravity, 0.0, 100.0),
            ("ground_friction", self.ground_friction, 0.0, 10.0),
            ("prediction_distance", self.prediction_distance, 0.001, 1.0),
            ("joint_frequency", self.joint_frequency, 1.0, 1e7),
            ("joint_damping_ratio", self.joint_damping_ratio, 0.01, 100.0),
            ("contact_frequency", self.contact_frequency, 1.0, 1e7),
            ("contact_damping_ratio", self.contact_damping_ratio, 0.01, 100.0),
            ("corrective_speed", self.corrective_speed, 0.1, 1000.0),
            ("motor_gain", self.motor_gain, 0.01, 1e6),
            ("settle_time", self.settle_time, 0.0, 60.0),
            ("unstable_speed", self.unstable_speed, 1.0, 400.0),
        ];
        for (field, value, low, high) in ranges {
            // Compared as f32 so that the ends themselves are in; shown as written.
            if !(low..=high).contains(&value) {
                return Err(SettingError::new(field, value, format!("from {low} to {high}")));
            }
        }
        self.water.map_or(Ok(()), |water| water.validate().map_err(|error| error.within("water")))
    }
}
