use super::{HEADER, MAGIC, codes, digest};
use crate::{Character, Facing, FileError, Hinge, Medium, Neuron, Part, VERSION};
use alloc::{collections::BTreeMap, vec::Vec};
use core::cmp::Reverse;
use creatures::{Actuation, Probe, Shape};

/// Writes a character's file.
pub(super) fn write(character: &Character) -> Result<Vec<u8>, FileError> {
    character.validate()?;
    if character.facing == Facing::Left {
        return Err(FileError::Field { field: "facing", index: 0, allowed: "right, as it was trained" });
    }
    let mut file = Writer::default();
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
    let content = file.content()?;
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

/// The fields of a file before its numbers are listed.
#[derive(Default)]
struct Writer(Vec<Token>);

enum Token {
    Byte(u8),
    Whole(u16),
    /// The bits of a number that is listed.
    Number(u32),
}

impl Writer {
    /// The list of numbers, those first that stand in most places and so get the shortest indices, and all fields.
    fn content(self) -> Result<Vec<u8>, FileError> {
        let mut places: BTreeMap<u32, usize> = BTreeMap::new();
        for token in &self.0 {
            if let Token::Number(bits) = token {
                *places.entry(*bits).or_default() += 1;
            }
        }
        let mut listed: Vec<(u32, usize)> = places.into_iter().collect();
        listed.sort_by_key(|&(bits, places)| (Reverse(places), bits));
        let allowed = "at most 65535 that differ, weights and all others";
        let length =
            u16::try_from(listed.len()).map_err(|_| FileError::Field { field: "numbers", index: 0, allowed })?;
        let index: BTreeMap<u32, u16> = listed.iter().map(|&(bits, _)| bits).zip(0..).collect();
        let mut content = Vec::new();
        push_whole(&mut content, length);
        listed.iter().for_each(|(bits, _)| content.extend(bits.to_le_bytes()));
        for token in self.0 {
            match token {
                Token::Byte(byte) => content.push(byte),
                Token::Whole(whole) => push_whole(&mut content, whole),
                Token::Number(bits) => push_whole(&mut content, index[&bits]),
            }
        }
        Ok(content)
    }

    fn bytes(&mut self, bytes: &[u8]) -> &mut Self {
        self.0.extend(bytes.iter().copied().map(Token::Byte));
        self
    }

    fn u16(&mut self, whole: u16) -> &mut Self {
        self.0.push(Token::Whole(whole));
        self
    }

    fn f32(&mut self, number: f32) -> &mut Self {
        self.0.push(Token::Number(number.to_bits()));
        self
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
        let record = codes::source_record(probe.source).ok_or(FileError::Field { field: "inputs", index, allowed })?;
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

/// Seven bits a byte, the lowest first; the eighth says that another byte follows.
fn push_whole(bytes: &mut Vec<u8>, mut whole: u16) {
    while whole >= 0x80 {
        bytes.push(whole as u8 | 0x80);
        whole >>= 7;
    }
    bytes.push(whole as u8);
}
