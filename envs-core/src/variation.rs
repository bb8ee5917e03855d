use crate::{Conditions, GroundShape, Push, bumps};
use ne_core::{Purpose, Seed, SettingError};
use rand::RngExt;
use serde::{Deserialize, Deserializer, Serialize};

const TRIAL_VARIATION: Purpose = Purpose::new("trial variation");
const TRIAL_BUMPS: Purpose = Purpose::new("trial bumps");
const TRIAL_TERRAIN: Purpose = Purpose::new("trial terrain");
const TRIAL_PHYSICS: Purpose = Purpose::new("trial physics");
const TRIAL_PUSHES: Purpose = Purpose::new("trial pushes");

/// Body lengths.
const BUMPS_REACH: f32 = 20.0;

/// The least and the greatest factor allowed where two are given.
const FACTORS: [f32; 2] = [0.1, 100.0];

/// From one push to the next, s.
const PUSH_PAUSES: [f32; 2] = [2.0, 4.0];
/// No push comes later, s.
const LAST_PUSH: f32 = 120.0;

/// How much the world differs from trial to trial, so that a gait cannot lean on one exact world.
///
/// Friction, mass, torque and gravity are shares: 0.2 draws a factor uniformly from 0.8 to 1.2. From 0 to 0.9; default 0, no
/// variation. Motor gain, frequencies and damping are the least and the greatest factor, drawn log-uniformly: from 0.1 to
/// 100; default 1 and 1, no variation; a file may have a share in their place.
///
/// Friction, mass, torque, start pose and pushes are what a real body meets. Time step, solver iterations, motor gain and the
/// frequencies and damping of joints and contacts are what two physics engines differ in when they simulate the same body:
/// a gait that bears them is a gait of the body, and not of one solver.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Variation {
    /// Of the ground's friction coefficient.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.9)))]
    pub friction: f32,
    /// Of the density of all parts together.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.9)))]
    pub mass: f32,
    /// Of the top torque of all motors together.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.9)))]
    pub torque: f32,
    /// The least and the greatest factor on [`PhysicsSettings::time_step`](crate::PhysicsSettings::time_step), drawn
    /// log-uniformly: a gait that needs steps of one length leans on the engine's errors. From 0.1 to 1 and from 1 to 2; default 1 and 1. A file may have a
    /// share in its place: 0.2 is read as 0.8 and 1.2.
    #[serde(deserialize_with = "factors")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "time_step_schema"))]
    pub time_step: [f32; 2],
    /// By up to this much, rad, each actuated joint is turned, either way, before the clock starts. Its own motor turns
    /// it, so a leg that bears weight turns less far. From 0 to 1; default 0.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub start_pose: f32,
    /// The highest of the [bumps](crate::bumps()) on flat ground, m, for as far as 20 body lengths; the lowest are a tenth
    /// as high. A terrain that is not flat has none, nor has water. 0, or from 0.01 to 0.1; default 0, none.
    #[cfg_attr(
        feature = "schema",
        schemars(
            range(min = 0.0, max = 0.1),
            extend("anyOf" = [{ "const": 0 }, { "format": "float", "minimum": 0.01 }])
        )
    )]
    pub bumps: f32,
    /// Whether each trial draws a seed of its own for the terrain, so that no terrain is learned by heart; `true` in
    /// [`light`](Self::light), [`bumpy`](Self::bumpy) and [`strong`](Self::strong), default `false`: all have that of the terrain's
    /// own seed.
    pub terrain: bool,
    /// Whether the first of several trials is in a [near](Self::near) world, so that the world of the settings is
    /// never out of sight; it has no bumps, and the terrain of the others; default `false`. With one trial alone it has no effect.
    pub near_first: bool,
    /// Of gravity.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 0.9)))]
    pub gravity: f32,
    /// On [`PhysicsSettings::motor_gain`](crate::PhysicsSettings::motor_gain): how hard a motor holds the speed asked for,
    /// within its torque.
    #[serde(deserialize_with = "factors")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "factors_schema"))]
    pub motor_gain: [f32; 2],
    /// The fewest and the most [solver iterations](crate::PhysicsSettings::solver_iterations), all equally likely; from 1 to
    /// 32. Default `null`: as the settings have it.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = 1, max = 32))))]
    pub solver_iterations: Option<[u32; 2]>,
    /// On [`PhysicsSettings::joint_frequency`](crate::PhysicsSettings::joint_frequency): how stiff hinges and their limits
    /// are.
    #[serde(deserialize_with = "factors")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "factors_schema"))]
    pub joint_frequency: [f32; 2],
    /// On [`PhysicsSettings::contact_frequency`](crate::PhysicsSettings::contact_frequency): how stiff the ground is.
    #[serde(deserialize_with = "factors")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "factors_schema"))]
    pub contact_frequency: [f32; 2],
    /// On [`PhysicsSettings::contact_damping_ratio`](crate::PhysicsSettings::contact_damping_ratio): how slowly the ground
    /// pushes out what is in it.
    #[serde(deserialize_with = "factors")]
    #[cfg_attr(feature = "schema", schemars(schema_with = "factors_schema"))]
    pub contact_damping: [f32; 2],
    /// The torso begins to turn with up to this much when the clock starts, rad/s, either way. From 0 to 5; default 0.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 5.0)))]
    pub torso_spin: f32,
    /// The strongest push against the torso, m/s of the whole body; from 0 to 5, default 0, none. A push is from half to all
    /// of it, either way along the ground, and comes 2 to 4 s after the one before, all uniformly drawn, for 120 s.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 5.0)))]
    pub pushes: f32,
}

impl Default for Variation {
    /// None.
    fn default() -> Self {
        Self::NONE
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

/// Two factors from these ranges, or the share they are off 1.
#[cfg(feature = "schema")]
fn two_factors([least, greatest]: [[f64; 2]; 2]) -> schemars::Schema {
    schemars::json_schema!({
        "anyOf": [
            {
                "description": "The least and the greatest factor.",
                "type": "array",
                "prefixItems": [
                    { "type": "number", "format": "float", "minimum": least[0], "maximum": least[1] },
                    { "type": "number", "format": "float", "minimum": greatest[0], "maximum": greatest[1] },
                ],
                "minItems": 2,
                "maxItems": 2,
            },
            {
                "description": "A share: 0.2 is read as the factors 0.8 and 1.2.",
                "type": "number",
                "format": "float",
                "minimum": 0,
                "maximum": 0.9,
            },
        ],
    })
}

#[cfg(feature = "schema")]
fn time_step_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    two_factors([[0.1, 1.0], [1.0, 2.0]])
}

#[cfg(feature = "schema")]
fn factors_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
    two_factors([[0.1, 100.0]; 2])
}

impl Variation {
    const NONE: Self = Self {
        friction: 0.0,
        mass: 0.0,
        torque: 0.0,
        time_step: [1.0, 1.0],
        start_pose: 0.0,
        bumps: 0.0,
        terrain: false,
        near_first: false,
        gravity: 0.0,
        motor_gain: [1.0, 1.0],
        solver_iterations: None,
        joint_frequency: [1.0, 1.0],
        contact_frequency: [1.0, 1.0],
        contact_damping: [1.0, 1.0],
        torso_spin: 0.0,
        pushes: 0.0,
    };

    /// The world of a training run: a gait evolved in one exact world is brittle.
    ///
    /// Friction ± 30 %, mass and torque ± 10 %, every actuated joint turned by up to 0.05 rad (3°), pushes of up to 0.3 m/s, and
    /// what [engines differ in](Self::physics), where it is hard: gravity, 1 to 4 solver iterations, stiffer joints and contacts,
    /// motors of half to ten times the gain, and steps between 0.7 and 1.25 times as long (1/71 to 1/40 s in place of 1/50). A
    /// gait that bears long steps on stiff ground bears short ones. The first of several trials is in a [near](Self::near)
    /// world.
    pub const fn light() -> Self {
        Self {
            near_first: true,
            terrain: true,
            friction: 0.3,
            mass: 0.1,
            torque: 0.1,
            time_step: [0.7, 1.25],
            gravity: 0.05,
            motor_gain: [0.5, 10.0],
            solver_iterations: Some([1, 4]),
            joint_frequency: [1.0, 16.0],
            contact_frequency: [1.0, 4.0],
            contact_damping: [0.5, 2.0],
            start_pose: 0.05,
            pushes: 0.3,
            ..Self::NONE
        }
    }

    /// [`light`](Self::light) with bumps up to 2 cm high and up to 8 solver iterations, for gaits that last: a creature
    /// that stumbles over a bump has to go on, and the more iterations, the harder ground and joints answer.
    pub const fn bumpy() -> Self {
        Self { bumps: 0.02, solver_iterations: Some([1, 8]), ..Self::light() }
    }

    /// More than [`bumpy`](Self::bumpy): friction ± 50 %, mass and torque ± 20 %, steps between 0.5 and 1.5 times as long,
    /// every actuated joint turned by up to 0.1 rad (6°), pushes of up to 0.4 m/s.
    pub const fn strong() -> Self {
        Self {
            friction: 0.5,
            mass: 0.2,
            torque: 0.2,
            time_step: [0.5, 1.5],
            start_pose: 0.1,
            pushes: 0.4,
            ..Self::bumpy()
        }
    }

    /// Worlds so near to that of the settings that a gait must not notice: friction, gravity and mass ± 1 %, steps between
    /// 0.99 and 1.01 times as long, every actuated joint turned by up to 1°, the torso turning by up to 0.05 rad/s.
    pub const fn near() -> Self {
        Self {
            friction: 0.01,
            gravity: 0.01,
            mass: 0.01,
            time_step: [0.99, 1.01],
            start_pose: 0.017_453_3,
            torso_spin: 0.05,
            ..Self::NONE
        }
    }

    /// What physics engines differ in, and nothing of the body: 1 to 8 solver iterations; joints of 30 Hz to 1 kHz (0.5 to
    /// 16.7 times the default's 60 Hz); contacts with 0.5 to 4 times the frequency and 0.5 to 2 times the damping; motors
    /// with 0.5 to 50 times the gain; gravity ± 5 %; steps between 0.2083 and 1.25 times as long (1/240 to 1/40 s in place
    /// of 1/50).
    pub const fn physics() -> Self {
        Self {
            solver_iterations: Some([1, 8]),
            joint_frequency: [0.5, 16.7],
            contact_frequency: [0.5, 4.0],
            contact_damping: [0.5, 2.0],
            motor_gain: [0.5, 50.0],
            gravity: 0.05,
            time_step: [0.2083, 1.25],
            ..Self::NONE
        }
    }

    /// The world of the settings with pushes of up to 0.3 m/s.
    pub const fn pushed() -> Self {
        Self { pushes: 0.3, ..Self::NONE }
    }

    /// The world of the settings with pushes of 0.4 m/s in the mean, between two thirds and four thirds of it: what a character of a
    /// game has to bear.
    pub const fn shoved() -> Self {
        Self { pushes: 1.6 / 3.0, ..Self::NONE }
    }

    /// Whether every trial has the same world.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// The same, for evaluations of so many trials.
    #[must_use]
    pub fn for_trials(self, count: u32) -> Self {
        Self { near_first: self.near_first && count > 1, ..self }
    }

    fn is_near(&self, seed: Seed) -> bool {
        self.near_first && seed.trial_index() == 0
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
            ("gravity", self.gravity, 0.9),
            ("torso_spin", self.torso_spin, 5.0),
            ("pushes", self.pushes, 5.0),
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
        let factors = [
            ("motor_gain", self.motor_gain),
            ("joint_frequency", self.joint_frequency),
            ("contact_frequency", self.contact_frequency),
            ("contact_damping", self.contact_damping),
        ];
        let [low, high] = FACTORS;
        for (field, [least, greatest]) in factors {
            if !(low <= least && least <= greatest && greatest <= high) {
                let allowed = format!("two factors from {low} to {high}, the least first");
                return Err(SettingError::new(field, format!("[{least}, {greatest}]"), allowed));
            }
        }
        match self.solver_iterations {
            Some([fewest, most]) if !(1 <= fewest && fewest <= most && most <= 32) => {
                let allowed = "two numbers from 1 to 32, the fewest first";
                Err(SettingError::new("solver_iterations", format!("[{fewest}, {most}]"), allowed))
            }
            _ => Ok(()),
        }
    }

    /// The world of the trial with this seed, for a creature with so many actuated joints.
    pub fn draw(&self, seed: Seed, motors: usize) -> Conditions {
        if self.is_near(seed) {
            return Self::near().draw(seed, motors);
        }
        let mut stream = seed.stream(TRIAL_VARIATION);
        // From −1 to 1. The order of the draws is part of every recorded run.
        let mut draw = || 2.0 * stream.random::<f32>() - 1.0;
        let (friction, mass, torque) =
            (1.0 + self.friction * draw(), 1.0 + self.mass * draw(), 1.0 + self.torque * draw());
        let time_step = between(self.time_step, 0.5 * (1.0 + draw()));
        let turns = (0..motors).map(|_| self.start_pose * draw()).collect();
        // What came later is drawn from a stream of its own, so that what is above stays what it was.
        let mut stream = seed.stream(TRIAL_PHYSICS);
        let mut draw = || stream.random::<f32>();
        Conditions {
            friction,
            mass,
            torque,
            time_step,
            turns,
            gravity: 1.0 + self.gravity * (2.0 * draw() - 1.0),
            motor_gain: between(self.motor_gain, draw()),
            joint_frequency: between(self.joint_frequency, draw()),
            contact_frequency: between(self.contact_frequency, draw()),
            contact_damping: between(self.contact_damping, draw()),
            torso_spin: self.torso_spin * (2.0 * draw() - 1.0),
            solver_iterations: self.solver_iterations.map(|[fewest, most]| {
                let count = most - fewest + 1;
                // The product may round up to the count.
                (fewest + (count as f32 * draw()) as u32).min(most)
            }),
            pushes: self.draw_pushes(seed),
        }
    }

    fn draw_pushes(&self, seed: Seed) -> Vec<Push> {
        if self.pushes == 0.0 {
            return Vec::new();
        }
        let mut stream = seed.stream(TRIAL_PUSHES);
        let mut draw = || stream.random::<f32>();
        let [shortest, longest] = PUSH_PAUSES;
        let next = |time: f32, place: f32| time + shortest + (longest - shortest) * place;
        let (mut pushes, mut time) = (Vec::new(), next(0.0, draw()));
        while time <= LAST_PUSH {
            let size = self.pushes * (0.5 + 0.5 * draw());
            let velocity = if draw() < 0.5 { -size } else { size };
            pushes.push(Push { time, velocity });
            time = next(time, draw());
        }
        pushes
    }

    /// The bumps of the trial with this seed, for a creature that stands from `left` to `right`, m, and is so long.
    pub(crate) fn draw_bumps(
        &self,
        seed: Seed,
        [left, right]: [f32; 2],
        body_length: f32,
        backwards: bool,
    ) -> Vec<GroundShape> {
        if self.bumps == 0.0 || self.is_near(seed) {
            return Vec::new();
        }
        let heights = [0.1 * self.bumps, self.bumps];
        bumps(&mut seed.stream(TRIAL_BUMPS), heights, [left, right], BUMPS_REACH * body_length, backwards)
    }

    /// The seed of the terrain of the trial with this seed, if it has one of its own.
    pub(crate) fn draw_terrain(&self, seed: Seed) -> Option<u64> {
        self.terrain.then(|| seed.stream(TRIAL_TERRAIN).random())
    }
}

/// The factor from the least at 0 to the greatest at 1, log-uniformly.
fn between(factors: [f32; 2], place: f32) -> f32 {
    let [least, greatest] = factors.map(libm::logf);
    libm::expf(least + (greatest - least) * place)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_near_trial_has_no_bumps() {
        let bumps = |variation: Variation, trial| {
            variation.draw_bumps(Seed::of_run(1).trial(trial), [-0.5, 0.5], 1.0, false).len()
        };
        let strong = Variation::strong();
        assert!(bumps(strong, 0) == 0 && bumps(strong, 1) > 0);
        assert!(bumps(Variation { near_first: false, ..strong }, 0) > 0, "no trial is near");
    }
}
