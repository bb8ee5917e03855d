//! What a file holds: everything of a champion that a game needs.

use crate::{Net, PartState};
use alloc::{string::String, vec::Vec};
use core::f32::consts::PI;

use creatures::{Actuation, Drive, Probe, Shape, Source};

/// A body and the controller that moves it. Shared by all that play it.
#[derive(Clone, Debug, PartialEq)]
pub struct Character {
    /// The name of the creature.
    pub name: String,
    /// What it has learned: `running`, `playing`.
    pub movement: String,
    /// Which way it faces; a file has those that face right.
    pub facing: Facing,
    /// The world it has learned in.
    pub world: World,
    /// What it is made of; the first is the torso.
    pub parts: Vec<Part>,
    /// What holds its parts together.
    pub hinges: Vec<Hinge>,
    /// What an output of the net means to its motor.
    pub actuation: Actuation,
    /// The hinge that each output moves, in the order of the outputs.
    pub outputs: Vec<u16>,
    /// Inputs of the net lie within ± this.
    pub input_range: f32,
    /// What each input of the net is, in their order.
    pub inputs: Vec<Probe>,
    /// The net.
    pub net: Net,
}

/// Which way a body faces.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Facing {
    /// Towards greater x, as it was trained.
    #[default]
    Right,
    /// Towards smaller x: its mirror image.
    Left,
}

/// A rigid body in the pose in which the character starts.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its name.
    pub name: String,
    /// Its shape, centred on its place.
    pub shape: Shape,
    /// Centre, forward, m.
    pub x: f32,
    /// Centre, up, m; the ground is at 0.
    pub y: f32,
    /// Turned counter-clockwise, rad.
    pub angle: f32,
    /// Mass per area, kg/m².
    pub density: f32,
    /// Coulomb friction coefficient; that of a contact is the product with the ground's.
    pub friction: f32,
    /// Whether it is a foot: the last part of a leg.
    pub foot: bool,
}

/// What holds two parts together.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hinge {
    /// The part it hangs on; stands before the child.
    pub parent: u16,
    /// The part that hangs on it.
    pub child: u16,
    /// The hinge in the parent's own frame, m.
    pub parent_anchor: [f32; 2],
    /// The hinge in the child's own frame, m.
    pub child_anchor: [f32; 2],
    /// Smallest and largest angle of the child against the parent, rad, against that of the start pose.
    pub limits: [f32; 2],
    /// What drives it; none: it turns freely. A motor that is no output of the net is asked for speed 0 for ever.
    pub motor: Option<Motor>,
}

/// What drives a hinge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// The fastest it turns, rad/s.
    pub top_speed: f32,
    /// The most it gives, N·m.
    pub top_torque: f32,
}

/// The world a character has learned in: a game that is like it is played best.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct World {
    /// Time of a step, s.
    pub time_step: f32,
    /// Downwards, m/s².
    pub gravity: f32,
    /// Friction coefficient of the ground.
    pub ground_friction: f32,
    /// Torque of a motor, per speed that it lacks, N·m per rad/s, up to its top torque.
    pub motor_gain: f32,
    /// The length in which speeds are commanded, m.
    pub body_length: f32,
    /// Height of the torso's centre above the ground, at rest, m.
    pub rest_height: f32,
    /// Air and ground, or water.
    pub medium: Medium,
    /// Whether the parts of the body collide with each other; two that share a hinge never do.
    pub self_collision: bool,
}

/// What is around the body.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Medium {
    /// Nothing but ground.
    #[default]
    Air,
    /// Water all around.
    Water {
        /// Mass per area, kg/m².
        density: f32,
        /// Drag coefficient across the long side of a part.
        drag: f32,
        /// Drag coefficient along the long side of a thin part.
        slip: f32,
    },
}

/// Something that the game itself has to measure, since only it knows what is there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outside {
    /// The distance from the torso's centre to the first thing that is not the character, along a ray that does not turn with
    /// the torso; `length` if there is none.
    Ray {
        /// In the world, counter-clockwise, rad; 0 looks towards greater x.
        angle: f32,
        /// m.
        length: f32,
    },
    /// The distance from the torso's centre to the near edge of the next gap ahead, at least 0; `length` if there is none.
    GapDistance {
        /// m.
        length: f32,
    },
    /// The width of that gap; 0 if there is none.
    GapWidth {
        /// m.
        length: f32,
    },
}

impl Character {
    /// The parts as they start: at rest.
    pub fn start_pose(&self) -> impl Iterator<Item = PartState> + '_ {
        self.parts.iter().map(|part| PartState::at(part.x, part.y, part.angle))
    }

    /// What the game has to measure every frame, in the order in which [`Player::tick`](crate::Player::tick) takes it; nothing
    /// for most characters.
    pub fn outside(&self) -> impl Iterator<Item = Outside> + '_ {
        self.outside_facing(self.facing)
    }

    pub(crate) fn outside_facing(&self, facing: Facing) -> impl Iterator<Item = Outside> + '_ {
        self.inputs.iter().filter_map(move |probe| match probe.source {
            Source::Ray { angle, length } => {
                let angle = if facing == Facing::Left { PI - angle } else { angle };
                Some(Outside::Ray { angle, length })
            }
            Source::GapDistance { length } => Some(Outside::GapDistance { length }),
            Source::GapWidth { length } => Some(Outside::GapWidth { length }),
            _ => None,
        })
    }

    /// What drives each output.
    pub(crate) fn drives(&self) -> impl Iterator<Item = (Drive, Motor)> + '_ {
        self.outputs.iter().filter_map(|&hinge| {
            let hinge_ = self.hinges.get(usize::from(hinge))?;
            let motor = hinge_.motor?;
            // The net knows the body as it was trained: facing right.
            let limits = if self.facing == Facing::Left { mirrored_limits(hinge_.limits) } else { hinge_.limits };
            Some((Drive { hinge: hinge.into(), top_speed: motor.top_speed, limits }, motor))
        })
    }

    /// The same character, facing the other way: its parts and hinges are those to build, and its player takes and gives
    /// what belongs to that body.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let part = |part: &Part| Part { x: -part.x, angle: -part.angle, ..part.clone() };
        let anchor = |[x, y]: [f32; 2]| [-x, y];
        let hinge = |hinge: &Hinge| Hinge {
            parent_anchor: anchor(hinge.parent_anchor),
            child_anchor: anchor(hinge.child_anchor),
            limits: mirrored_limits(hinge.limits),
            ..*hinge
        };
        Self {
            facing: match self.facing {
                Facing::Right => Facing::Left,
                Facing::Left => Facing::Right,
            },
            parts: self.parts.iter().map(part).collect(),
            hinges: self.hinges.iter().map(hinge).collect(),
            ..self.clone()
        }
    }
}

fn mirrored_limits([low, high]: [f32; 2]) -> [f32; 2] {
    [-high, -low]
}
