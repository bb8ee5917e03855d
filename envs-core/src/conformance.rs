//! The check that plug-in authors run in their own tests, of what a sensor owes: [`check_sense`]. What it has in common with
//! all checks is said in [`ne_core::conformance`].

use creatures::{Blueprint, BodyView, Channel, Sense};
use ne_core::conformance::{Promise, Violation};
use std::collections::BTreeSet;

/// Channels that can be scaled.
pub const CHANNELS: Promise = Promise::new(
    "sense",
    "at least one channel in any body that has a joint to move, each with a range of two finite numbers, the smaller first",
);
/// Inputs are known by their names.
pub const NAMES: Promise =
    Promise::new("sense", "each channel of a body has a name of its own, of one line, and a unit of one line");
/// One body, one list.
pub const SETTLED: Promise =
    Promise::new("sense", "a body has the same channels whenever it is asked, whatever was asked of other bodies");
/// Whatever the body tells.
pub const READS: Promise = Promise::new(
    "sense",
    "each channel is read at any moment, and asks for no joint or part that the body does not have",
);
/// It reads numbers.
pub const FINITE: Promise = Promise::new("sense", "each channel of a body that tells finite numbers is finite");
/// It remembers nothing.
pub const REMEMBERS_NOTHING: Promise = Promise::new(
    "sense",
    "equal bodies give equal bits, in whichever order channels are read and whatever was read before",
);

/// All of them.
pub const PROMISES: &[Promise] = &[CHANNELS, NAMES, SETTLED, READS, FINITE, REMEMBERS_NOTHING];

/// Moments in which each body is read.
const MOMENTS: usize = 60;

/// Checks a sense by reading the shipped creatures, as they move in no engine: whatever a body can be asked for changes from
/// moment to moment, within and beyond what is usual.
///
/// # Errors
/// The first promise that is not kept; the text says of which creature.
pub fn check_sense(sense: &dyn Sense) -> Result<(), Violation> {
    let bodies: Vec<(&str, Blueprint)> = creatures::shipped()
        .iter()
        .map(|shipped| (shipped.name, Blueprint::from_json(shipped.json).expect("a test reads every shipped file")))
        .collect();
    let mut told: Vec<Vec<Channel>> = Vec::new();
    for (name, blueprint) in &bodies {
        let channels = CHANNELS.check(|| {
            let channels = sense.channels(blueprint);
            scalable(&channels).map_err(|found| format!("{name}: {found}"))?;
            Ok(channels)
        })?;
        NAMES.check(|| named(&channels).map_err(|found| format!("{name}: {found}")))?;
        told.push(channels);
    }
    for ((name, blueprint), channels) in bodies.iter().zip(&told) {
        SETTLED.check(|| match sense.channels(blueprint) {
            again if again == *channels => Ok(()),
            again => Err(format!("{name}: {channels:?} at first, {again:?} afterwards")),
        })?;
        let read = |at: usize| {
            let moment = Moment { number: at / channels.len(), blueprint };
            sense.read(&moment, at % channels.len())
        };
        let of =
            |at: usize| format!("{name}: \"{}\" at moment {}", channels[at % channels.len()].name, at / channels.len());
        let values: Vec<f32> = READS.check(|| Ok((0..MOMENTS * channels.len()).map(read).collect()))?;
        FINITE.check(|| match values.iter().position(|value| !value.is_finite()) {
            Some(at) => Err(format!("{} is {}", of(at), values[at])),
            None => Ok(()),
        })?;
        REMEMBERS_NOTHING.check(|| {
            match (0..values.len()).rev().find(|&at| read(at).to_bits() != values[at].to_bits()) {
                Some(at) => Err(format!("{} is {} when read first, and another number later", of(at), values[at])),
                None => Ok(()),
            }
        })?;
    }
    Ok(())
}

fn scalable(channels: &[Channel]) -> Result<(), String> {
    if channels.is_empty() {
        return Err("no channels".into());
    }
    let is_sound = |range: [f32; 2]| range.iter().all(|bound| bound.is_finite()) && range[0] < range[1];
    match channels.iter().find(|channel| !is_sound(channel.range)) {
        Some(Channel { name, range, .. }) => Err(format!("\"{name}\" has the range {range:?}")),
        None => Ok(()),
    }
}

fn named(channels: &[Channel]) -> Result<(), String> {
    let mut names = BTreeSet::new();
    for Channel { name, unit, .. } in channels {
        if name.trim().is_empty() || [&**name, *unit].iter().any(|text| text.chars().any(char::is_control)) {
            return Err(format!("the name {name:?} with the unit {unit:?}"));
        }
        if !names.insert(name) {
            return Err(format!("\"{name}\" twice"));
        }
    }
    Ok(())
}

/// A body at a moment. Everything it can tell has a rhythm of its own; at every seventh moment all is 0.
struct Moment<'a> {
    number: usize,
    blueprint: &'a Blueprint,
}

impl Moment<'_> {
    /// A number between -`most` and `most`, which differs from question to question.
    fn wave(&self, question: usize, most: f32) -> f32 {
        let step = if self.number % 7 == 6 { 0.0 } else { self.number as f32 };
        most * libm::sinf(step * (0.31 + 0.17 * question as f32))
    }

    fn wave_of_hinge(&self, hinge: usize, question: usize, most: f32) -> f32 {
        let hinges = self.blueprint.hinges().len();
        assert!(hinge < hinges, "it asks for hinge {hinge} of {hinges}");
        self.wave(question + hinge, most)
    }

    fn wave_of_part(&self, part: usize, question: usize, most: f32) -> f32 {
        let parts = self.blueprint.parts().len();
        assert!(part < parts, "it asks for part {part} of {parts}");
        self.wave(question + part, most)
    }
}

impl BodyView for Moment<'_> {
    fn torso_rotation(&self) -> f32 {
        self.wave(0, 3.1)
    }
    fn torso_spin(&self) -> f32 {
        self.wave(1, 30.0)
    }
    fn joint_angle(&self, hinge: usize) -> f32 {
        self.wave_of_hinge(hinge, 2, 4.0)
    }
    fn joint_speed(&self, hinge: usize) -> f32 {
        self.wave_of_hinge(hinge, 3, 50.0)
    }
    fn torso_velocity(&self) -> [f32; 2] {
        [self.wave(4, 20.0), self.wave(5, 20.0)]
    }
    fn torso_height(&self) -> f32 {
        self.wave(6, 3.0)
    }
    fn touches_ground(&self, part: usize) -> bool {
        self.wave_of_part(part, 7, 1.0) > 0.0
    }
    fn slip(&self, part: usize) -> f32 {
        if self.touches_ground(part) { self.wave_of_part(part, 8, 5.0) } else { 0.0 }
    }
    fn next_gap(&self, length: f32) -> [f32; 2] {
        let way = self.wave(9, 2.0 * length).abs();
        if way < length { [way, 0.5 * length] } else { [length, 0.0] }
    }
    fn distance_along_ray(&self, angle: f32, length: f32) -> f32 {
        (self.wave(10, 2.0 * length).abs() + angle.abs()).min(length)
    }
    fn time(&self) -> f32 {
        self.number as f32 / 7.0
    }
    fn time_since_landing(&self) -> f32 {
        self.wave(11, 1.0).abs().min(self.time())
    }
    fn commanded_speed(&self) -> f32 {
        self.wave(12, 2.0)
    }
    fn is_told_to_jump(&self) -> bool {
        self.time_since_press() < 0.2
    }
    fn time_since_press(&self) -> f32 {
        // Infinity, until it is first pressed, is no number that a sense may pass on.
        if self.number < 10 { f32::INFINITY } else { (self.time() - 10.0 / 7.0) % 1.5 }
    }
    fn stride_time(&self) -> f32 {
        self.time() % 2.0
    }
}
