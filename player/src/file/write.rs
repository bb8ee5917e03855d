use super::{HEADER, MAGIC, codes, digest};
use crate::{Character, Facing, FileError, Hinge, Medium, Neuron, Part, VERSION};
use alloc::vec::Vec;
use creatures::{Actuation, Probe, Shape};

/// Writes a character's file.
pub(super) fn write(character: &Character) -> Result<Vec<u8>, FileError> {
    character.validate()?;
    if character.facing == Facing::Left {
        return Err(FileError::Field { field: "facing", index: 0, allowed: "right, as it was trained" });
    }
    let mut file = Writer(Vec::new());
    file.text(&character.name);
    file.text(&character.movement);
    file.world(character);
    file.count(character.parts.len());
    character.parts.iter().for_each(|part| file.part(part));
    file.count(character.hinges.len());
    character.hinges.iter().for_each(|hinge| file.hinge(hinge));
    match character.actuation {
        Actuation::Speed => file.bytes(&[0]).f32(0.0),
        Actuation::Angle { gain } => file.bytes(&[1]).f32(gain),
    };
    file.count(character.outputs.len());
    for (&hinge, &node) in character.outputs.iter().zip(character.net.outputs()) {
        file.u16(hinge).u16(node);
    }
    file.f32(character.input_range);
    file.count(character.inputs.len());
    for (index, probe) in character.inputs.iter().enumerate() {
        file.input(index, probe)?;
    }
    file.count(character.net.nodes() - character.net.inputs());
    character.net.neurons().for_each(|neuron| file.neuron(&neuron));
    let content = file.0;
    let length = u32::try_from(content.len());
    let length = length.map_err(|_| FileError::Field { field: "file", index: 0, allowed: "below 4 GiB" })?;
    let mut whole = Vec::with_capacity(HEADER + content.len());
    whole.extend(MAGIC);
    whole.extend(VERSION.to_le_bytes());
    whole.extend(length.to_le_bytes());
    whole.extend(digest(&content).to_le_bytes());
    whole.extend(content);
    Ok(whole)
}

struct Writer(Vec<u8>);

impl Writer {
    fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        self.0.extend_from_slice(bytes);
        self
    }

    fn u16(&mut self, number: u16) -> &mut Self {
        self.bytes(&number.to_le_bytes())
    }

    fn f32(&mut self, number: f32) -> &mut Self {
        self.bytes(&number.to_le_bytes())
    }

    fn f32s<const N: usize>(&mut self, numbers: [f32; N]) -> &mut Self {
        numbers.iter().for_each(|&number| {
            self.f32(number);
        });
        self
    }

    /// Of a valid character; all its counts fit.
    fn count(&mut self, count: usize) -> &mut Self {
        self.u16(u16::try_from(count).unwrap_or(u16::MAX))
    }

    /// Of a valid character; all its texts fit.
    fn text(&mut self, text: &str) -> &mut Self {
        let length = u8::try_from(text.len()).unwrap_or(u8::MAX);
        self.bytes(&[length]).bytes(&text.as_bytes()[..length.into()])
    }

    fn world(&mut self, character: &Character) {
        let world = &character.world;
        self.f32s([world.time_step, world.gravity, world.ground_friction, world.motor_gain]);
        self.f32s([world.body_length, world.rest_height]).bytes(&[u8::from(world.self_collision)]);
        match world.medium {
            Medium::Air => self.bytes(&[0]),
            Medium::Water { density, drag, slip } => self.bytes(&[1]).f32s([density, drag, slip]),
        };
    }

    fn part(&mut self, part: &Part) {
        let (code, sizes) = match part.shape {
            Shape::Box { width, height } => (0, [width, height]),
            Shape::Circle { radius } => (1, [radius, 0.0]),
            Shape::Capsule { length, radius } => (2, [length, radius]),
        };
        self.text(&part.name).bytes(&[code]).f32s(sizes);
        self.f32s([part.x, part.y, part.angle, part.density, part.friction]).bytes(&[u8::from(part.foot)]);
    }

    fn hinge(&mut self, hinge: &Hinge) {
        self.u16(hinge.parent).u16(hinge.child);
        self.f32s(hinge.parent_anchor).f32s(hinge.child_anchor).f32s(hinge.limits);
        match hinge.motor {
            None => self.bytes(&[0]),
            Some(motor) => self.bytes(&[1]).f32s([motor.top_speed, motor.top_torque]),
        };
    }

    fn input(&mut self, index: usize, probe: &Probe) -> Result<(), FileError> {
        let allowed = "a sensor of Gambol's own: those of other crates have code of theirs";
        let record = codes::of_source(probe.source).ok_or(FileError::Field { field: "inputs", index, allowed })?;
        let (code, of, first, second) = record;
        self.bytes(&[code]).count(of).f32s([first, second, probe.middle, probe.factor]);
        Ok(())
    }

    fn neuron(&mut self, neuron: &Neuron) {
        self.bytes(&[codes::of_activation(neuron.activation)]).f32s([neuron.scale, neuron.bias]);
        self.count(neuron.sources.len());
        for &(node, weight) in &neuron.sources {
            self.u16(node).f32(weight);
        }
    }
}
