//! From a body to the inputs of a net.

use std::{
    collections::BTreeMap,
    f32::consts::{FRAC_PI_2, PI},
};

use crate::bounds::INPUT_RANGE;
use crate::{Blueprint, BodyView, Channel, CreatureError, CustomSensor, Probe, Problem, Sensor, Source, check};

/// The range the thesis scales inputs to: -3 to 3, where tanh does most of its bending.
pub const DEFAULT_INPUT_RANGE: f32 = 3.0;

/// Speeds of the torso up to this are told apart, m/s.
const TOP_TORSO_SPEED: f32 = 5.0;
/// Spins of the torso up to this are told apart, rad/s.
const TOP_TORSO_SPIN: f32 = 10.0;
/// Feet that slide faster than this are not told apart, m/s.
const TOP_SLIP: f32 = 2.0;
/// Joints are thrown about faster than their motors drive them.
const SPEED_HEADROOM: f32 = 2.0;

/// What a net sees of a body: a list of [`Channel`]s, each scaled linearly so that its range becomes
/// [-`input_range`, `input_range`], and clamped to it.
///
/// The order of the channels is that of the sensors, and within a sensor that of the outputs, feet or rays; only
/// actuated hinges are sensed. It is part of what a trained net means, and never changes for the same creature and
/// sensors. No two channels have one name: of two gap sensors the second's are `distance to next gap (2)` and so on.
#[derive(Clone, Debug, PartialEq)]
pub struct Senses {
    channels: Vec<Channel>,
    probes: Vec<Probe>,
    /// Of other crates.
    custom: Vec<CustomSensor>,
    input_range: f32,
}

impl Senses {
    /// The senses of a creature. The sensors are usually `blueprint.creature().sensors`; `input_range` is usually
    /// [`DEFAULT_INPUT_RANGE`].
    ///
    /// # Errors
    /// [`CreatureError::InputRange`] if `input_range` is not within 0.001 to 1000, [`CreatureError::Invalid`] if a
    /// sensor's settings are out of range, a sensor is listed twice, none is listed, feet are to be sensed that the
    /// creature does not have, nothing is known of a [`CustomSensor`], or a channel of one has the name of another.
    pub fn new(blueprint: &Blueprint, sensors: &[Sensor], input_range: f32) -> Result<Self, CreatureError> {
        if !INPUT_RANGE.contains(input_range) {
            return Err(CreatureError::InputRange { found: input_range });
        }
        let mut problems = Vec::new();
        check::check_sensors(sensors, !blueprint.feet().is_empty(), &mut problems);
        if !problems.is_empty() {
            return Err(CreatureError::Invalid(problems));
        }
        let mut senses = Self { channels: Vec::new(), probes: Vec::new(), custom: Vec::new(), input_range };
        let mut names = BTreeMap::new();
        for (index, sensor) in sensors.iter().enumerate() {
            let told = senses.len();
            match sensor {
                Sensor::Custom(sensor) => problems.extend(senses.add_custom(index, sensor).err()),
                _ => senses.add(blueprint, sensor),
            }
            let is_custom = |index: usize| matches!(sensors[index], Sensor::Custom(_));
            for channel in &mut senses.channels[told..] {
                let Some(&first) = names.get(&channel.name) else {
                    names.insert(channel.name.clone(), index);
                    continue;
                };
                if is_custom(index) || is_custom(first) {
                    let (path, channel) = (format!("sensors[{index}]"), channel.name.clone());
                    problems.push(Problem::DuplicateChannel { path, channel, first });
                    break;
                }
                // Sensors of the format may look for one thing at two lengths: from two to the next free number.
                let mut numbered = (2..).map(|number| format!("{} ({number})", channel.name));
                channel.name = numbered.find(|name| !names.contains_key(name)).unwrap_or_default();
                names.insert(channel.name.clone(), index);
            }
        }
        if problems.is_empty() { Ok(senses) } else { Err(CreatureError::Invalid(problems)) }
    }

    fn add_custom(&mut self, index: usize, custom: &CustomSensor) -> Result<(), Problem> {
        let (path, name) = (format!("sensors[{index}]"), custom.name.clone());
        let Some(told) = custom.told() else { return Err(Problem::UnknownSensor { path, name }) };
        let channels = &told.channels;
        let is_sound = |range: [f32; 2]| range.iter().all(|bound| bound.is_finite()) && range[0] < range[1];
        if channels.is_empty() {
            return Err(Problem::NoChannels { path, name });
        }
        if let Some(Channel { name: channel, range, .. }) = channels.iter().find(|channel| !is_sound(channel.range)) {
            return Err(Problem::BadChannel { path, name, channel: channel.clone(), range: *range });
        }
        for (channel, Channel { name, unit, range }) in channels.iter().enumerate() {
            self.push(name.clone(), unit, *range, Source::Custom { sensor: self.custom.len(), channel });
        }
        self.custom.push(custom.clone());
        Ok(())
    }

    fn add(&mut self, blueprint: &Blueprint, sensor: &Sensor) {
        let torso = &blueprint.parts()[0].name;
        let hinges = blueprint.actuated().iter().map(|&index| (index, &blueprint.hinges()[index]));
        let name_of = |part: usize| &blueprint.parts()[part].name;
        match sensor {
            Sensor::TorsoRotation => {
                self.push(format!("rotation of {torso}"), "rad", [-PI, PI], Source::TorsoRotation);
            }
            Sensor::TorsoSpin => {
                self.push(format!("spin of {torso}"), "rad/s", [-TOP_TORSO_SPIN, TOP_TORSO_SPIN], Source::TorsoSpin);
            }
            Sensor::JointAngles => {
                for (index, hinge) in hinges {
                    let most = hinge.limits[0].abs().max(hinge.limits[1].abs());
                    let name = format!("angle of {}", name_of(hinge.child));
                    self.push(name, "rad", [-most, most], Source::JointAngle(index));
                }
            }
            Sensor::JointSpeeds => {
                for (index, hinge) in hinges {
                    let most = SPEED_HEADROOM * hinge.motor.map_or(1.0, |motor| motor.top_speed);
                    let name = format!("speed of {}", name_of(hinge.child));
                    self.push(name, "rad/s", [-most, most], Source::JointSpeed(index));
                }
            }
            Sensor::TorsoVelocity => {
                let range = [-TOP_TORSO_SPEED, TOP_TORSO_SPEED];
                self.push(format!("forward velocity of {torso}"), "m/s", range, Source::VelocityForward);
                self.push(format!("upward velocity of {torso}"), "m/s", range, Source::VelocityUp);
            }
            Sensor::TorsoHeight => {
                let most = blueprint.start_height();
                self.push(format!("height of {torso} above start"), "m", [-most, most], Source::TorsoHeight);
            }
            Sensor::FootContacts => {
                for &foot in blueprint.feet() {
                    self.push(format!("contact of {}", name_of(foot)), "", [0.0, 1.0], Source::Contact(foot));
                }
            }
            Sensor::Rangefinder { angles, length } => {
                for degrees in angles {
                    let source = Source::Ray { angle: degrees.to_radians(), length: *length };
                    self.push(format!("distance at {degrees}°"), "m", [0.0, *length], source);
                }
            }
            Sensor::HeightAboveGround => {
                let length = 2.0 * blueprint.start_height();
                let source = Source::Ray { angle: -FRAC_PI_2, length };
                self.push(format!("height of {torso} above ground"), "m", [0.0, length], source);
            }
            Sensor::FootSlip => {
                for &foot in blueprint.feet() {
                    let name = format!("slip of {}", name_of(foot));
                    self.push(name, "m/s", [-TOP_SLIP, TOP_SLIP], Source::Slip(foot));
                }
            }
            Sensor::NextGap { length } => {
                let length = *length;
                self.push("distance to next gap".to_owned(), "m", [0.0, length], Source::GapDistance { length });
                self.push("width of next gap".to_owned(), "m", [0.0, length], Source::GapWidth { length });
            }
            Sensor::Clock { period } => {
                let period = *period;
                self.push(format!("sine of {period} s clock"), "", [-1.0, 1.0], Source::ClockSine { period });
                self.push(format!("cosine of {period} s clock"), "", [-1.0, 1.0], Source::ClockCosine { period });
            }
            Sensor::LandingClock { period } => {
                let period = *period;
                let (sine, cosine) = (Source::LandingSine { period }, Source::LandingCosine { period });
                self.push(format!("sine of {period} s clock from landing"), "", [-1.0, 1.0], sine);
                self.push(format!("cosine of {period} s clock from landing"), "", [-1.0, 1.0], cosine);
            }
            Sensor::CommandedSpeed { top } => {
                self.push("commanded speed".to_owned(), "body lengths/s", [-*top, *top], Source::CommandedSpeed);
            }
            Sensor::JumpCommand => self.push("jump command".to_owned(), "", [0.0, 1.0], Source::JumpCommand),
            Sensor::StrideClock { period, top } => {
                let (period, top) = (*period, *top);
                let (sine, cosine) = (Source::StrideSine { period, top }, Source::StrideCosine { period, top });
                self.push(format!("sine of {period} s stride clock"), "", [-1.0, 1.0], sine);
                self.push(format!("cosine of {period} s stride clock"), "", [-1.0, 1.0], cosine);
            }
            Sensor::JumpClock { period } => {
                let period = *period;
                self.push(format!("sine of {period} s jump clock"), "", [-1.0, 1.0], Source::JumpSine { period });
                // From 0 to 1; the range has 0 in its middle, so that a net hears nothing until the button is pressed.
                self.push(format!("swell of {period} s jump clock"), "", [-1.0, 1.0], Source::JumpSwell { period });
            }
            // Added by `add_custom`.
            Sensor::Custom(_) => {}
        }
    }

    fn push(&mut self, name: String, unit: &'static str, range: [f32; 2], source: Source) {
        let [min, max] = range;
        self.channels.push(Channel { name, unit, range });
        self.probes.push(Probe { source, middle: 0.5 * (min + max), factor: 2.0 * self.input_range / (max - min) });
    }

    /// The channels, in the order of the net's inputs.
    pub fn channels(&self) -> &[Channel] {
        &self.channels
    }

    /// How each channel is measured, in the order of the net's inputs.
    pub fn probes(&self) -> &[Probe] {
        &self.probes
    }

    /// Number of channels: inputs of the net. At least one.
    pub fn len(&self) -> usize {
        self.probes.len()
    }

    /// Always false: a creature that senses nothing is an error.
    pub fn is_empty(&self) -> bool {
        self.probes.is_empty()
    }

    /// The size of the range inputs are scaled to.
    pub fn input_range(&self) -> f32 {
        self.input_range
    }

    /// Asks the body and writes the inputs of the net, each within [-`input_range`, `input_range`] or, where the body
    /// tells NaN, NaN. Allocates nothing.
    ///
    /// # Panics
    /// If `inputs` is not as long as there are channels.
    pub fn read<B: BodyView>(&self, body: &B, inputs: &mut [f32]) {
        assert_eq!(inputs.len(), self.probes.len(), "one input for each channel");
        let range = self.input_range;
        for (input, probe) in inputs.iter_mut().zip(&self.probes) {
            let value = match probe.source {
                Source::Custom { sensor, channel } => {
                    self.custom[sensor].told().map_or(f32::NAN, |told| (told.read)(body, channel))
                }
                source => source.read(body),
            };
            *input = probe.scale(value, range);
        }
    }
}
