//! The creature file.

use serde::{Deserialize, Serialize};

use crate::look::is_zero;
use crate::{Look, Sensor, Shape};

/// A creature as its file says it: parts, joints, sensors and looks.
///
/// Its fields may say anything; a [`Blueprint`](crate::Blueprint) is a creature that has been checked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Creature {
    /// Where the JSON Schema of the file is found, for editors; otherwise ignored.
    #[serde(rename = "$schema", default, skip_serializing_if = "Option::is_none")]
    pub schema: Option<String>,
    /// Always `gambol creature`.
    #[cfg_attr(feature = "schema", schemars(regex(pattern = "^gambol creature$")))]
    pub format: String,
    /// Version of the file format: 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1)))]
    pub version: u32,
    /// Short name, used on the command line and in file names: letters, digits, spaces, `-`, `_` and `.`, at most 64,
    /// a letter or digit first.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 64)))]
    pub name: String,
    /// Name shown to people; default empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// A sentence or two about it; default empty.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub description: String,
    /// Its parts, 1 to 256; the first is the torso.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 256)))]
    pub parts: Vec<Part>,
    /// The hinges that hold the parts together: one for each part but the torso.
    #[serde(default)]
    pub joints: Vec<Joint>,
    /// Parts with one of these tags are actuated: the motors of their joints are outputs of the net. Default `["leg"]`.
    #[serde(default = "default_actuated_tags")]
    pub actuated_tags: Vec<String>,
    /// What it senses, 1 to 64 sensors; default `["torso-rotation", "joint-angles"]`.
    #[serde(default = "Sensor::defaults")]
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 64)))]
    pub sensors: Vec<Sensor>,
    /// Whether its parts collide with each other (parts held by a common joint never do); default false.
    #[serde(default)]
    pub self_collision: bool,
    /// Whether it looks the same from both sides, so that it runs both ways with one net; default false. It is proved: each part
    /// must have a mirror image across the upright line through the torso, with the same hinge and motor.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub symmetric: bool,
}

/// A rigid body of a creature.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Its name, unique in the creature, at most 64 characters.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 64)))]
    pub name: String,
    /// What it is, such as `torso`, `leg`, `head`; `actuated_tags` refers to it. At most 64 characters.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 64)))]
    pub tag: String,
    /// Its solid shape, centred on its position.
    pub shape: Shape,
    /// Mass per area, kg/m², 0.1 to 10000.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.1, max = 10000.0)))]
    pub density: f32,
    /// Coulomb friction coefficient, 0 (ice) to 10; default 1.
    #[serde(default = "default_friction")]
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 10.0)))]
    pub friction: f32,
    /// Centre in the start pose, x forward and y up, m, -100 to 100. The ground is at y = 0.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = -100.0, max = 100.0))))]
    pub position: [f32; 2],
    /// Turned counter-clockwise in the start pose, degrees, -360 to 360; default 0.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[cfg_attr(feature = "schema", schemars(range(min = -360.0, max = 360.0)))]
    pub angle: f32,
    /// Whether the chain of parts it belongs to may be a leg; default true. False for arms and tails: their last part is no
    /// foot, but their motors are outputs of the net like all others.
    #[serde(default = "default_leg", skip_serializing_if = "is_true")]
    pub leg: bool,
    /// How it is drawn; default a grey shape.
    #[serde(default)]
    pub look: Look,
}

/// A hinge that holds two parts together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Joint {
    /// Name of the part it hangs on; must stand earlier in `parts` than the child.
    pub parent: String,
    /// Name of the part that hangs on it.
    pub child: String,
    /// Where the hinge is in the start pose, in the world, m; at most 1 m outside the shape of either part.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = -100.0, max = 100.0))))]
    pub anchor: [f32; 2],
    /// Smallest and largest angle of the child against the parent, degrees, relative to the start pose: from at most 0
    /// to at least 0, between -180 and 180, no more than 340 apart.
    #[cfg_attr(feature = "schema", schemars(inner(range(min = -180.0, max = 180.0))))]
    pub limits: [f32; 2],
    /// What drives it; the hinge turns freely between its limits if absent. It holds still if the child is not actuated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub motor: Option<Motor>,
}

/// What drives a hinge: it tries to reach the speed asked for, with no more than its torque.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Motor {
    /// Largest speed that can be asked for, either way, rad/s, 0.01 to 100.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 100.0)))]
    pub top_speed: f32,
    /// Largest torque, N·m, 0.01 to 100000.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.01, max = 100_000.0)))]
    pub top_torque: f32,
}

impl Creature {
    /// A creature without any parts yet, everything else as the file's defaults say.
    pub fn new(name: &str) -> Self {
        Self {
            schema: None,
            format: crate::format::FORMAT.to_owned(),
            version: crate::format::VERSION,
            name: name.to_owned(),
            title: String::new(),
            description: String::new(),
            parts: Vec::new(),
            joints: Vec::new(),
            actuated_tags: default_actuated_tags(),
            sensors: Sensor::defaults(),
            self_collision: false,
            symmetric: false,
        }
    }

    /// Writes the creature file, indented; [`from_json`](Self::from_json) gives the same creature back. Numbers that
    /// are not finite become `null`, which no reader accepts: a checked creature has none.
    pub fn to_json(&self) -> String {
        // Only maps with keys that are no text and failing writers make serde_json fail; neither is here.
        serde_json::to_string_pretty(self).expect("a creature is plain data")
    }

    /// Indices of the parts in the order they are drawn: by layer, then as in the file.
    pub fn drawing_order(&self) -> Vec<usize> {
        let mut order: Vec<usize> = (0..self.parts.len()).collect();
        order.sort_by_key(|&part| self.parts[part].look.layer);
        order
    }
}

fn default_actuated_tags() -> Vec<String> {
    vec!["leg".to_owned()]
}

fn default_leg() -> bool {
    true
}

fn is_true(value: &bool) -> bool {
    *value
}

fn default_friction() -> f32 {
    1.0
}
