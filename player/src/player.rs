//! One body that is played.

use crate::{
    Character, Command, Facing, FileError, Outside, PartState, TickError,
    body::{Body, Rest},
    facing::View,
};
use alloc::{sync::Arc, vec, vec::Vec};
use creatures::{Drive, Landings, Source, limit, symmetry::Asymmetry};

/// One body that is played: the state of its controller, which is a function of what it was told since it began.
///
/// A new one allocates; [`tick`](Self::tick) does not. Bodies that share a [`Character`] share its memory.
#[derive(Clone, Debug)]
pub struct Player {
    character: Arc<Character>,
    rest: Arc<Rest>,
    drives: Vec<Drive>,
    view: View,
    /// How many things the game measures.
    outside: usize,
    /// How high the ground is, m.
    ground: f32,
    /// Inputs, and what each neuron put out last.
    nodes: Vec<f32>,
    /// The parts as the net knows them: facing right.
    parts: Vec<PartState>,
    joint_angles: Vec<f32>,
    speeds: Vec<f32>,
    /// Since the start, s. A sum of equal steps is exact for centuries.
    seconds: f64,
    landings: Landings,
    command: Command,
    since_press: f32,
    /// When the stride clock began, s.
    stride_began: f32,
    /// Of the last frame, s.
    step: f32,
}

/// The longest a frame may last, s.
const LONGEST_FRAME: f32 = 1.0;

impl Player {
    /// A body that stands in its start pose, its clocks at 0.
    ///
    /// # Errors
    /// If the character is [not valid](Character::validate). One from a file is.
    pub fn new(character: Arc<Character>) -> Result<Self, FileError> {
        character.validate()?;
        let rest = match character.facing {
            Facing::Right => Rest::new(&character),
            Facing::Left => Rest::new(&character.mirrored()),
        };
        let mut player = Self {
            rest: Arc::new(rest),
            drives: character.drives().map(|(drive, _)| drive).collect(),
            view: View::new(character.facing),
            outside: character.outside().count(),
            ground: 0.0,
            nodes: vec![0.0; character.net.nodes()],
            parts: vec![PartState::default(); character.parts.len()],
            joint_angles: vec![0.0; character.hinges.len()],
            speeds: vec![0.0; character.outputs.len()],
            seconds: 0.0,
            landings: Landings::default(),
            command: Command::STAND,
            since_press: f32::INFINITY,
            stride_began: 0.0,
            step: 0.0,
            character,
        };
        player.reset();
        Ok(player)
    }

    /// Another body that does what the same character does, at its start, on ground of height 0; cheaper than [`new`](Self::new).
    #[must_use]
    pub fn another(&self) -> Self {
        let mut other = Self { ground: 0.0, ..self.clone() };
        other.reset();
        other
    }

    /// Begins anew: clocks at 0, the net without memory, facing as it was built. Call it when the body was put back into its start pose.
    pub fn reset(&mut self) {
        self.view = View::new(self.character.facing);
        self.nodes.fill(0.0);
        self.speeds.fill(0.0);
        (self.seconds, self.landings) = (0.0, Landings::default());
        (self.command, self.step) = (Command::STAND, 0.0);
        (self.since_press, self.stride_began) = (f32::INFINITY, 0.0);
    }

    /// What is played.
    pub fn character(&self) -> &Arc<Character> {
        &self.character
    }

    /// How high the ground is where the body stands, m; 0 until it is said, and unchanged by what is not finite. Only a character
    /// that senses the height of its torso goes by it. One that was trained on a terrain that rises or falls heard its height above
    /// the ground it started on: tell it the height of that.
    pub fn set_ground(&mut self, height: f32) {
        if height.is_finite() {
            self.ground = height;
        }
    }

    /// Asks all motors for speed 0 until the next frame.
    pub fn hold_still(&mut self) {
        self.speeds.fill(0.0);
    }

    /// Turns round, from the next frame on: a body that looks [the same from both sides](Character::symmetry) runs the other way
    /// with the same net, and what it is told is meant the way it faces. A body that stands turns best; one that runs is told
    /// to stand first. Allocates when it turns away from how it was built.
    ///
    /// # Errors
    /// If the body does not look the same from both sides; it goes on as it was.
    pub fn face(&mut self, facing: Facing) -> Result<(), Asymmetry> {
        if facing != self.view.facing() {
            self.view = View::turned(&self.character, facing)?;
        }
        Ok(())
    }

    /// Which way it faces.
    pub fn facing(&self) -> Facing {
        self.view.facing()
    }

    /// What the game has to measure every frame, as [`Character::outside`], the way it faces now.
    pub fn outside(&self) -> impl Iterator<Item = Outside> + '_ {
        self.character.outside_facing(self.facing())
    }

    /// Since the start, s.
    pub fn seconds(&self) -> f64 {
        self.seconds
    }

    /// The inputs of the net in the last frame.
    pub fn inputs(&self) -> &[f32] {
        &self.nodes[..self.character.net.inputs()]
    }

    /// What the net put out in the last frame.
    pub fn outputs(&self) -> impl Iterator<Item = f32> + '_ {
        self.character.net.outputs().iter().map(|&node| self.nodes[usize::from(node)])
    }

    /// The speed that the motor of each output was last asked for, rad/s: of the child against the parent, counter-clockwise.
    pub fn speeds(&self) -> &[f32] {
        &self.speeds
    }

    /// A frame: what the body does now, what is outside of it, and what it is told; the speeds that its motors are asked for
    /// until the next, rad/s, in the order of [`Character::outputs`].
    ///
    /// - `parts`: where each part is, in the order of [`Character::parts`];
    /// - `outside`: what the game measures, in the order of [`Character::outside`];
    /// - `seconds`: how long this frame lasts, from 0 to 1 s.
    ///
    /// Allocates nothing.
    ///
    /// # Errors
    /// If there are too few or too many parts or measurements, or a number is not finite. The motors are then asked for
    /// speed 0, and what was told is not heard: clocks stand still, and after a number that is not finite the net begins anew. A
    /// net whose own numbers grow beyond all bounds fails in the same way, but its frame has passed.
    pub fn tick(
        &mut self,
        parts: &[PartState],
        outside: &[f32],
        command: Command,
        seconds: f32,
    ) -> Result<&[f32], TickError> {
        match self.control(parts, outside, command, seconds) {
            Ok(()) => Ok(&self.speeds),
            Err(error) => {
                self.hold_still();
                if error == TickError::NotFinite {
                    self.nodes.fill(0.0);
                }
                Err(error)
            }
        }
    }

    /// The torque of the motor of each output, N·m, counter-clockwise on the child and as much the other way on the parent, for
    /// engines whose hinges have no motors: in proportion to the speed that is lacking, up to the motor's top torque. May be
    /// asked for at every step of the engine, several times a frame: a light part shakes where steps are long, as `motor_gain` × step
    /// ÷ inertia grows beyond 2. Motors of the engine do better. As many as there are outputs are written; 0 where a spin is not
    /// finite. A motor that is no output gets none here: the game holds it still by the same law, asked for speed 0.
    pub fn torques(&self, parts: &[PartState], torques: &mut [f32]) {
        let character = &*self.character;
        let spin = |part: u16| parts.get(usize::from(part)).map_or(0.0, |part| part.spin);
        for ((torque, &hinge), &speed) in torques.iter_mut().zip(&character.outputs).zip(&self.speeds) {
            let hinge = &character.hinges[usize::from(hinge)];
            let most = hinge.motor.map_or(0.0, |motor| motor.top_torque);
            let lacking = speed - (spin(hinge.child) - spin(hinge.parent));
            let wanted = if lacking.is_finite() { lacking * character.world.motor_gain } else { 0.0 };
            *torque = limit(wanted, -most, most);
        }
    }

    fn control(
        &mut self,
        parts: &[PartState],
        outside: &[f32],
        command: Command,
        seconds: f32,
    ) -> Result<(), TickError> {
        let character = &*self.character;
        if parts.len() != character.parts.len() {
            return Err(TickError::Parts { expected: character.parts.len(), found: parts.len() });
        }
        if outside.len() != self.outside {
            return Err(TickError::Outside { expected: self.outside, found: outside.len() });
        }
        if !(0.0..=LONGEST_FRAME).contains(&seconds) {
            return Err(TickError::Seconds);
        }
        let is_finite = |number: &f32| number.is_finite();
        if !parts.iter().all(PartState::is_finite) || !outside.iter().chain([&command.speed]).all(is_finite) {
            return Err(TickError::NotFinite);
        }
        self.view.see(parts, &mut self.parts);
        self.rest.joint_angles(&self.parts, &mut self.joint_angles);
        let time = self.seconds as f32;
        self.landings.observe(self.parts.iter().any(|part| part.touching != 0), time);
        let pressed = command.jump != 0 && self.command.jump == 0;
        self.since_press = if pressed { 0.0 } else { self.since_press + self.step };
        if pressed || command.speed != 0.0 && self.command.speed == 0.0 {
            self.stride_began = time;
        }
        (self.command, self.step) = (command, seconds);
        self.seconds += f64::from(seconds);
        self.sense(outside, time);
        self.character.net.activate(&mut self.nodes);
        let actuation = self.character.actuation;
        for (output, (drive, &node)) in self.drives.iter().zip(self.character.net.outputs()).enumerate() {
            let asked = drive.speed(actuation, self.nodes[usize::from(node)], || self.joint_angles[drive.hinge]);
            if !asked.is_finite() {
                return Err(TickError::NotFinite);
            }
            let (place, speed) = self.view.drive(output, asked);
            self.speeds[place] = speed;
        }
        Ok(())
    }

    /// Writes the inputs of the net.
    fn sense(&mut self, outside: &[f32], time: f32) {
        let character = &*self.character;
        let body = Body {
            rest: &self.rest,
            parts: &self.parts,
            joint_angles: &self.joint_angles,
            rest_height: self.ground + character.world.rest_height,
            time,
            landings: self.landings,
            command: self.command,
            since_press: self.since_press,
            stride_began: self.stride_began,
        };
        let mut outside = outside.iter();
        for (input, probe) in self.nodes.iter_mut().zip(&character.inputs) {
            let value = match probe.source {
                Source::Ray { .. } | Source::GapDistance { .. } | Source::GapWidth { .. } => {
                    outside.next().copied().unwrap_or(0.0)
                }
                source => source.read(&body),
            };
            *input = probe.scale(value, character.input_range);
        }
    }
}
