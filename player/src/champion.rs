//! Characters from creatures and nets, and from champion files.

use crate::{Character, Facing, FileError, Hinge, Medium, Motor, Net, Neuron, Part, World};
use alloc::{string::String, vec::Vec};
use creatures::{Actuation, Blueprint, Creature, CreatureError, Motors, Senses, Sensor};
use ne_core::archive::{self, ArchiveError};
use ne_net::Network;
use serde::Deserialize;
use std::path::Path;

/// What a character is made of. (Of the water in `medium` too, where there is any.)
#[derive(Clone, Copy, Debug)]
pub struct CharacterParts<'a> {
    /// The body.
    pub blueprint: &'a Blueprint,
    /// What its net senses.
    pub senses: &'a Senses,
    /// What its net moves.
    pub motors: &'a Motors,
    /// Its net.
    pub network: &'a Network,
    /// What it has learned.
    pub movement: &'a str,
    /// Time of a step in the world it has learned in, s.
    pub time_step: f32,
    /// Gravity there, m/s².
    pub gravity: f32,
    /// Friction coefficient of the ground there.
    pub ground_friction: f32,
    /// Gain of the motors there, N·m per rad/s.
    pub motor_gain: f32,
    /// What is around it there.
    pub medium: Medium,
    /// Height of the torso's centre once the body has come to rest, m.
    pub rest_height: f32,
}

/// Why a champion is not played.
#[derive(Debug)]
#[non_exhaustive]
pub enum ChampionError {
    /// The champion's file cannot be read.
    File(ArchiveError),
    /// Its creature or its sensors are not valid.
    Creature(CreatureError),
    /// Something of it is too large for a player, or of another crate.
    Character(FileError),
    /// Its net has not as many inputs and outputs as the body.
    Net {
        /// Inputs and outputs of the body.
        expected: (usize, usize),
        /// Inputs and outputs of the net.
        found: (usize, usize),
    },
    /// Its net has more nodes than 65,536.
    TooManyNodes,
}

impl core::fmt::Display for ChampionError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::File(error) => error.fmt(f),
            Self::Creature(error) => error.fmt(f),
            Self::Character(error) => write!(f, "the character cannot be played: {error}"),
            Self::Net { expected, found } => write!(
                f,
                "the net has {} inputs and {} outputs, the body {} and {}",
                found.0, found.1, expected.0, expected.1
            ),
            Self::TooManyNodes => f.write_str("the net has more than 65536 inputs and neurons: a player numbers fewer"),
        }
    }
}

impl core::error::Error for ChampionError {}

impl From<ArchiveError> for ChampionError {
    fn from(error: ArchiveError) -> Self {
        Self::File(error)
    }
}

impl From<CreatureError> for ChampionError {
    fn from(error: CreatureError) -> Self {
        Self::Creature(error)
    }
}

impl From<FileError> for ChampionError {
    fn from(error: FileError) -> Self {
        Self::Character(error)
    }
}

impl Character {
    /// A character of a creature and a net.
    ///
    /// # Errors
    /// If inputs and outputs of the net are not those of the body, a sensor is of another crate, or the net is too large.
    pub fn new(parts: CharacterParts<'_>) -> Result<Self, ChampionError> {
        let CharacterParts { blueprint, senses, motors, network, .. } = parts;
        let view = network.view();
        let (expected, found) = ((senses.len(), motors.len()), (view.inputs, view.outputs.len()));
        if expected != found {
            return Err(ChampionError::Net { expected, found });
        }
        let node = |node: usize| u16::try_from(node).map_err(|_| ChampionError::TooManyNodes);
        let weights = network.weights();
        let neuron = |neuron: &ne_net::NeuronView| {
            let source = |&(source, weight): &(usize, usize)| Ok((node(source)?, weights[weight]));
            Ok(Neuron {
                activation: neuron.activation,
                scale: neuron.scale,
                bias: neuron.bias.map_or(0.0, |weight| weights[weight]),
                sources: neuron.sources.iter().map(source).collect::<Result<_, ChampionError>>()?,
            })
        };
        let neurons: Vec<Neuron> = view.neurons.iter().map(neuron).collect::<Result<_, ChampionError>>()?;
        let outputs = view.outputs.iter().map(|&output| node(output)).collect::<Result<_, _>>()?;
        let character = Self {
            name: blueprint.name().into(),
            movement: parts.movement.into(),
            facing: Facing::Right,
            world: world(&parts),
            parts: bodies(blueprint),
            hinges: blueprint.hinges().iter().map(hinge).collect::<Result<_, _>>()?,
            actuation: motors.actuation(),
            outputs: motors.drives().iter().map(|drive| node(drive.hinge)).collect::<Result<_, _>>()?,
            input_range: senses.input_range(),
            inputs: senses.probes().to_vec(),
            net: Net::new(view.inputs, &neurons, outputs).ok_or(ChampionError::TooManyNodes)?,
        };
        character.validate()?;
        Ok(character)
    }

    /// The character of a champion's file (JSON).
    ///
    /// The file does not say how high the torso is once the body has come to rest, which a net may sense: the height in the
    /// start pose is taken, a millimetre or so above it. `gambol export --to player` lets the body come to rest. Nor does it say the
    /// density of water that was left to the creature: it is the creature's own mean.
    ///
    /// # Errors
    /// If it cannot be read, is damaged, or cannot be played.
    pub fn read_champion(path: &Path) -> Result<Self, ChampionError> {
        let champion: Champion = archive::read(path, "gambol champion", 2)?;
        let blueprint = Blueprint::new(champion.creature)?;
        let senses = Senses::new(&blueprint, &champion.sensors, champion.input_range)?;
        let motors = Motors::with_actuation(&blueprint, champion.actuation);
        let Physics { time_step, gravity, ground_friction, motor_gain, water } = champion.physics;
        let medium = water.map_or(Medium::Air, |water| water.around(&blueprint));
        Self::new(CharacterParts {
            blueprint: &blueprint,
            senses: &senses,
            motors: &motors,
            network: &champion.network,
            movement: &champion.movement.name,
            time_step,
            gravity,
            ground_friction,
            motor_gain,
            medium,
            rest_height: blueprint.start_height(),
        })
    }
}

fn world(parts: &CharacterParts<'_>) -> World {
    World {
        time_step: parts.time_step,
        gravity: parts.gravity,
        ground_friction: parts.ground_friction,
        motor_gain: parts.motor_gain,
        body_length: parts.blueprint.body_length(),
        rest_height: parts.rest_height,
        medium: parts.medium,
        self_collision: parts.blueprint.self_collision(),
    }
}

fn bodies(blueprint: &Blueprint) -> Vec<Part> {
    let part = |(index, part): (usize, &creatures::BodyPart)| Part {
        name: part.name.clone(),
        shape: part.shape,
        x: part.x,
        y: part.y,
        angle: part.angle,
        density: part.density,
        friction: part.friction,
        foot: blueprint.feet().contains(&index),
    };
    blueprint.parts().iter().enumerate().map(part).collect()
}

fn hinge(hinge: &creatures::Hinge) -> Result<Hinge, ChampionError> {
    let allowed = "fewer than 65536";
    let part = |part: usize| u16::try_from(part).map_err(|_| FileError::Field { field: "parts", index: part, allowed });
    Ok(Hinge {
        parent: part(hinge.parent)?,
        child: part(hinge.child)?,
        parent_anchor: hinge.parent_anchor,
        child_anchor: hinge.child_anchor,
        limits: hinge.limits,
        motor: hinge.motor.map(|motor| Motor { top_speed: motor.top_speed, top_torque: motor.top_torque }),
    })
}

/// What of a champion's file a player goes by.
#[derive(Deserialize)]
struct Champion {
    creature: Creature,
    movement: Movement,
    sensors: Vec<Sensor>,
    input_range: f32,
    #[serde(default)]
    actuation: Actuation,
    network: Network,
    physics: Physics,
}

#[derive(Deserialize)]
struct Movement {
    name: String,
}

#[derive(Deserialize)]
struct Physics {
    time_step: f32,
    gravity: f32,
    ground_friction: f32,
    motor_gain: f32,
    #[serde(default)]
    water: Option<Water>,
}

#[derive(Deserialize)]
struct Water {
    #[serde(default)]
    density: Option<f32>,
    drag: f32,
    slip: f32,
}

impl Water {
    fn around(&self, blueprint: &Blueprint) -> Medium {
        let area: f32 = blueprint.parts().iter().map(|part| part.shape.area()).sum();
        let density = self.density.unwrap_or(blueprint.mass() / area);
        Medium::Water { density, drag: self.drag, slip: self.slip }
    }
}
