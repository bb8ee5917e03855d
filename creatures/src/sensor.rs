//! What a creature can sense.

use crate::CustomSensor;
use serde::{Deserialize, Serialize};

/// One kind of sense, as a creature file or a run names it.
///
/// In a file: `"torso-rotation"`, `"joint-angles"`, `"joint-speeds"`, `"torso-velocity"`, `"torso-height"`,
/// `"foot-contacts"`, `{"rangefinder": {"angles": [-30, 0], "length": 3}}`, `{"clock": {"period": 1}}`, `"torso-spin"`,
/// `"height-above-ground"`, `"foot-slip"`, `{"next-gap": {"length": 4}}`, `{"landing-clock": {"period": 1}}`,
/// `{"commanded-speed": {"top": 3}}`, `"jump-command"`, `{"stride-clock": {"period": 0.5, "top": 3}}`,
/// `{"jump-clock": {"period": 0.5}}`, `{"custom": {"name": "whiskers"}}`.
/// [`Senses`](crate::Senses) turns sensors into the channels of a net; the ranges below are those of the raw values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum Sensor {
    /// Rotation of the torso relative to the start pose: one channel, rad, -π to π.
    TorsoRotation,
    /// Angle of each actuated joint relative to the start pose: a channel a joint, rad, plus or minus the larger of
    /// its limits.
    JointAngles,
    /// Speed of each actuated joint: a channel a joint, rad/s, plus or minus twice its motor's top speed.
    JointSpeeds,
    /// Velocity of the torso's centre in the world, forward and up: two channels, m/s, -5 to 5.
    TorsoVelocity,
    /// Height of the torso's centre above its settled start height: one channel, m, plus or minus the height of the
    /// torso's centre above the creature's lowest point in the start pose.
    TorsoHeight,
    /// Whether each foot (last segment of a leg) touches the ground: a channel a foot, 0 or 1.
    FootContacts,
    /// Distances from the torso's centre to whatever lies ahead, along rays that do not turn with the torso: a channel
    /// a ray, m, 0 to `length`.
    Rangefinder {
        /// Direction of each ray, degrees, -180 to 180: 0 looks forward (+x), negative down. 1 to 64 rays.
        #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 64), inner(range(min = -180.0, max = 180.0))))]
        angles: Vec<f32>,
        /// How far a ray reaches, m, 0.01 to 100; also the value of a ray that hits nothing.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 100.0)))]
        length: f32,
    },
    /// Sine and cosine of a phase that turns once a period: two channels, -1 to 1.
    Clock {
        /// Time of one turn, s, 0.02 to 100.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.02, max = 100.0)))]
        period: f32,
    },
    /// Angular speed of the torso: one channel, rad/s, -10 to 10.
    TorsoSpin,
    /// Height of the torso's centre above whatever is straight below it: one channel, m, 0 to twice its height above the
    /// creature's lowest point in the start pose.
    HeightAboveGround,
    /// How fast the lowest point of each foot slides along the ground while the foot touches it, positive forwards; 0 while it
    /// does not: a channel a foot, m/s, -2 to 2.
    FootSlip,
    /// The next gap ahead: two channels, the distance from the torso's centre to its near edge and its width, m, 0 to
    /// `length`. Above a gap the distance is 0; where none is within reach it is `length`, and the width 0.
    NextGap {
        /// How far ahead gaps are told, and how wide ones, m, 0.01 to 100.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 100.0)))]
        length: f32,
    },
    /// As a clock, but one that begins anew whenever the body lands: when a part touches the ground again after none did.
    /// Contacts within 0.2 s of a landing belong to it. Two channels, -1 to 1.
    LandingClock {
        /// Time of one turn, s, 0.02 to 100.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.02, max = 100.0)))]
        period: f32,
    },
    /// The speed the body is told to move at: one channel, body lengths/s, plus or minus `top`; below 0 is backwards.
    CommandedSpeed {
        /// The fastest it is told to move, body lengths/s, 0.1 to 20.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 20.0)))]
        top: f32,
    },
    /// Whether the body is told to jump, as long as the button is held: one channel, 0 or 1.
    JumpCommand,
    /// A clock that swings as far as the body is told to be fast: sine and cosine of its phase, times the commanded speed over
    /// `top`. Two channels, -1 to 1. Told to stand, a body has no rhythm; told to go backwards, the other one. The clock begins
    /// anew when the body is told to move after it has been told to stand, and when it is told to jump: so it sets off, and goes on
    /// after a jump, with the same leg each time.
    StrideClock {
        /// Time of one turn, s, 0.02 to 100.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.02, max = 100.0)))]
        period: f32,
        /// The speed at which it swings as far as it can, body lengths/s, 0.1 to 20.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 20.0)))]
        top: f32,
    },
    /// One turn of a clock, from the moment the body is told to jump: sine of its phase, and (1 - cosine) / 2. Two channels,
    /// -1 to 1 and 0 to 1; both are 0 before the first press and after the turn.
    JumpClock {
        /// Time of the turn, s, 0.02 to 100.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.02, max = 100.0)))]
        period: f32,
    },
    /// A sensor of another crate, which only the program that has it can read: see [`Sense`](crate::Sense).
    Custom(CustomSensor),
}

/// A kind of sensor, as lists show it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SensorKind {
    /// Its name in files.
    pub name: &'static str,
    /// One as a file writes it, with its settings.
    pub example: &'static str,
    /// What its channels tell, in a few words.
    pub description: &'static str,
}

const fn kind(name: &'static str, example: &'static str, description: &'static str) -> SensorKind {
    SensorKind { name, example, description }
}

impl Sensor {
    /// All kinds of sensors, in the order of the variants.
    pub const KINDS: [SensorKind; 18] = [
        kind("torso-rotation", r#""torso-rotation""#, "rotation of the torso against the start pose"),
        kind("joint-angles", r#""joint-angles""#, "angle of each actuated joint against the start pose"),
        kind("joint-speeds", r#""joint-speeds""#, "speed of each actuated joint"),
        kind("torso-velocity", r#""torso-velocity""#, "velocity of the torso's centre, forwards and upwards"),
        kind("torso-height", r#""torso-height""#, "height of the torso's centre above its settled start height"),
        kind("foot-contacts", r#""foot-contacts""#, "whether each foot touches the ground"),
        kind(
            "rangefinder",
            r#"{"rangefinder":{"angles":[-60,-30],"length":3}}"#,
            "distance along each ray from the torso's centre",
        ),
        kind("clock", r#"{"clock":{"period":1}}"#, "sine and cosine of a phase that turns once a period"),
        kind("torso-spin", r#""torso-spin""#, "angular speed of the torso"),
        kind(
            "height-above-ground",
            r#""height-above-ground""#,
            "height of the torso's centre above whatever is straight below it",
        ),
        kind("foot-slip", r#""foot-slip""#, "how fast each foot slides while it touches the ground"),
        kind("next-gap", r#"{"next-gap":{"length":4}}"#, "distance to the next gap, and its width"),
        kind("landing-clock", r#"{"landing-clock":{"period":1}}"#, "a clock that begins anew whenever the body lands"),
        kind("commanded-speed", r#"{"commanded-speed":{"top":1.5}}"#, "the speed that the body is told"),
        kind("jump-command", r#""jump-command""#, "whether the body is told to jump"),
        kind(
            "stride-clock",
            r#"{"stride-clock":{"period":0.5,"top":1.5}}"#,
            "a clock that swings as far as the body is told to be fast",
        ),
        kind(
            "jump-clock",
            r#"{"jump-clock":{"period":0.6}}"#,
            "one turn of a clock from the moment the body is told to jump",
        ),
        kind("custom", r#"{"custom":{"name":"whiskers"}}"#, "a sensor of another crate"),
    ];

    /// The sensor's name as files write it.
    pub fn name(&self) -> &'static str {
        match self {
            Self::TorsoRotation => Self::KINDS[0].name,
            Self::JointAngles => Self::KINDS[1].name,
            Self::JointSpeeds => Self::KINDS[2].name,
            Self::TorsoVelocity => Self::KINDS[3].name,
            Self::TorsoHeight => Self::KINDS[4].name,
            Self::FootContacts => Self::KINDS[5].name,
            Self::Rangefinder { .. } => Self::KINDS[6].name,
            Self::Clock { .. } => Self::KINDS[7].name,
            Self::TorsoSpin => Self::KINDS[8].name,
            Self::HeightAboveGround => Self::KINDS[9].name,
            Self::FootSlip => Self::KINDS[10].name,
            Self::NextGap { .. } => Self::KINDS[11].name,
            Self::LandingClock { .. } => Self::KINDS[12].name,
            Self::CommandedSpeed { .. } => Self::KINDS[13].name,
            Self::JumpCommand => Self::KINDS[14].name,
            Self::StrideClock { .. } => Self::KINDS[15].name,
            Self::JumpClock { .. } => Self::KINDS[16].name,
            Self::Custom(_) => Self::KINDS[17].name,
        }
    }

    /// What a creature senses unless its file says otherwise: the rotation of the torso and the angles of its joints.
    pub fn defaults() -> Vec<Self> {
        vec![Self::TorsoRotation, Self::JointAngles]
    }
}

#[cfg(test)]
mod tests {
    use super::{Sensor, SensorKind};

    #[test]
    fn the_example_of_each_kind_is_a_sensor_of_its_name() {
        for SensorKind { name, example, .. } in Sensor::KINDS {
            let sensor: Sensor = serde_json::from_str(example).expect(example);
            assert_eq!(sensor.name(), name);
        }
    }
}
