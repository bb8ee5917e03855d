use super::{HEADER, MAGIC, codes, digest};
use crate::{Character, Facing, FileError, Hinge, Medium, Motor, Net, Neuron, Part, VERSION, World};
use alloc::{string::String, vec::Vec};
use creatures::{Actuation, Probe, Shape};

/// Reads a character's file.
pub(super) fn read(bytes: &[u8]) -> Result<Character, FileError> {
    let (header, content) = bytes.split_at_checked(HEADER).ok_or(FileError::NotACharacter)?;
    let mut file = Reader { rest: header, field: "header", numbers: Vec::new() };
    if file.array::<8>()? != MAGIC {
        return Err(FileError::NotACharacter);
    }
    let (version, length) = (u32::from_le_bytes(file.array()?), u32::from_le_bytes(file.array()?));
    if version != VERSION {
        return Err(FileError::Version { found: version });
    }
    let expected = usize::try_from(length).unwrap_or(usize::MAX);
    if expected != content.len() {
        return Err(FileError::Length { expected, found: content.len() });
    }
    if u64::from_le_bytes(file.array()?) != digest(content) {
        return Err(FileError::Digest);
    }
    let mut file = Reader { rest: content, field: "numbers", numbers: Vec::new() };
    let character = file.character()?;
    if !file.rest.is_empty() {
        return Err(FileError::Cut { field: "neurons" });
    }
    character.validate()?;
    Ok(character)
}

const WHOLE: &str = "of whole numbers from 0 to 65535, in at most three bytes";

struct Reader<'a> {
    rest: &'a [u8],
    /// What is read, for errors.
    field: &'static str,
    /// The numbers that the rest of the file points at.
    numbers: Vec<f32>,
}

/// The shortest records, in bytes: a count that promises more than the file holds is not believed.
const NUMBER: usize = 4;
const SHORTEST_PART: usize = 10;
const SHORTEST_HINGE: usize = 9;
const SHORTEST_OUTPUT: usize = 2;
const SHORTEST_INPUT: usize = 6;
const SHORTEST_NEURON: usize = 4;
const SHORTEST_SOURCE: usize = 2;

impl<'a> Reader<'a> {
    fn bytes(&mut self, count: usize) -> Result<&'a [u8], FileError> {
        let (taken, rest) = self.rest.split_at_checked(count).ok_or(FileError::Cut { field: self.field })?;
        self.rest = rest;
        Ok(taken)
    }

    fn array<const N: usize>(&mut self) -> Result<[u8; N], FileError> {
        let bytes = self.bytes(N)?;
        bytes.try_into().map_err(|_| FileError::Cut { field: self.field })
    }

    fn u8(&mut self) -> Result<u8, FileError> {
        self.array().map(|[byte]| byte)
    }

    /// Seven bits a byte, the lowest first; the eighth says that another byte follows.
    fn u16(&mut self) -> Result<u16, FileError> {
        let mut whole = 0;
        for place in 0..3 {
            let byte = u32::from(self.u8()?);
            whole |= (byte & 0x7f) << (7 * place);
            if byte < 0x80 {
                return u16::try_from(whole).or_else(|_| self.wrong(0, WHOLE));
            }
        }
        self.wrong(0, WHOLE)
    }

    /// One of the numbers at the beginning.
    fn f32(&mut self) -> Result<f32, FileError> {
        let index = self.u16()?;
        let number = self.numbers.get(usize::from(index)).copied();
        number.map_or_else(|| self.wrong(0, "of numbers that are listed"), Ok)
    }

    fn f32s<const N: usize>(&mut self) -> Result<[f32; N], FileError> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            *number = self.f32()?;
        }
        Ok(numbers)
    }

    fn wrong<T>(&self, index: usize, allowed: &'static str) -> Result<T, FileError> {
        Err(FileError::Field { field: self.field, index, allowed })
    }

    /// 0 or 1.
    fn flag(&mut self, index: usize) -> Result<bool, FileError> {
        match self.u8()? {
            0 => Ok(false),
            1 => Ok(true),
            _ => self.wrong(index, "0 or 1 where it says yes or no"),
        }
    }

    fn text(&mut self, index: usize) -> Result<String, FileError> {
        let length = self.u8()?;
        let bytes = self.bytes(length.into())?;
        match core::str::from_utf8(bytes) {
            Ok(text) => Ok(text.into()),
            Err(_) => self.wrong(index, "named in UTF-8"),
        }
    }

    /// As many records as are counted here, each at least `shortest` bytes long.
    fn list<T>(
        &mut self,
        field: &'static str,
        shortest: usize,
        record: impl Fn(&mut Self, usize) -> Result<T, FileError>,
    ) -> Result<Vec<T>, FileError> {
        self.field = field;
        let count = usize::from(self.u16()?);
        if count * shortest > self.rest.len() {
            return Err(FileError::Cut { field });
        }
        (0..count).map(|index| record(self, index)).collect()
    }

    fn character(&mut self) -> Result<Character, FileError> {
        self.numbers = self.list("numbers", NUMBER, |file, _| file.array().map(f32::from_le_bytes))?;
        self.field = "name";
        let name = self.text(0)?;
        self.field = "movement";
        let movement = self.text(0)?;
        let world = self.world()?;
        let parts = self.list("parts", SHORTEST_PART, Self::part)?;
        let hinges = self.list("hinges", SHORTEST_HINGE, Self::hinge)?;
        self.field = "actuation";
        let actuation = match (self.u8()?, self.f32()?) {
            (0, _) => Actuation::Speed,
            (1, gain) => Actuation::Angle { gain },
            _ => return self.wrong(0, "0 (speed) or 1 (angle)"),
        };
        let outputs = self.list("outputs", SHORTEST_OUTPUT, |file, _| Ok((file.u16()?, file.u16()?)))?;
        self.field = "input range";
        let input_range = self.f32()?;
        let inputs = self.list("inputs", SHORTEST_INPUT, Self::input)?;
        let neurons = self.list("neurons", SHORTEST_NEURON, Self::neuron)?;
        let (outputs, nodes): (Vec<u16>, Vec<u16>) = outputs.into_iter().unzip();
        let Some(net) = Net::new(inputs.len(), &neurons, nodes) else {
            return self.wrong(0, "connected with nodes that are there");
        };
        let facing = Facing::Right;
        Ok(Character { name, movement, facing, world, parts, hinges, actuation, outputs, input_range, inputs, net })
    }

    fn world(&mut self) -> Result<World, FileError> {
        self.field = "world";
        let [time_step, gravity, ground_friction, motor_gain, body_length, rest_height] = self.f32s()?;
        let self_collision = self.flag(0)?;
        let medium = match self.flag(0)? {
            false => Medium::Air,
            true => {
                let [density, drag, slip] = self.f32s()?;
                Medium::Water { density, drag, slip }
            }
        };
        Ok(World { time_step, gravity, ground_friction, motor_gain, body_length, rest_height, medium, self_collision })
    }

    fn part(&mut self, index: usize) -> Result<Part, FileError> {
        let name = self.text(index)?;
        let code = self.u8()?;
        let [first, second] = self.f32s()?;
        let shape = match code {
            0 => Shape::Box { width: first, height: second },
            1 => Shape::Circle { radius: first },
            2 => Shape::Capsule { length: first, radius: second },
            _ => return self.wrong(index, "a box (0), a circle (1) or a capsule (2)"),
        };
        let [x, y, angle, density, friction] = self.f32s()?;
        Ok(Part { name, shape, x, y, angle, density, friction, foot: self.flag(index)? })
    }

    fn hinge(&mut self, index: usize) -> Result<Hinge, FileError> {
        let (parent, child) = (self.u16()?, self.u16()?);
        let (parent_anchor, child_anchor, limits) = (self.f32s()?, self.f32s()?, self.f32s()?);
        let motor = match self.flag(index)? {
            false => None,
            true => {
                let [top_speed, top_torque] = self.f32s()?;
                Some(Motor { top_speed, top_torque })
            }
        };
        Ok(Hinge { parent, child, parent_anchor, child_anchor, limits, motor })
    }

    fn input(&mut self, index: usize) -> Result<Probe, FileError> {
        let (code, of) = (self.u8()?, self.u16()?);
        let [first, second, middle, factor] = self.f32s()?;
        match codes::source(code, of.into(), first, second) {
            Some(source) => Ok(Probe { source, middle, factor }),
            None => self.wrong(index, "a sensor that this player knows"),
        }
    }

    fn neuron(&mut self, index: usize) -> Result<Neuron, FileError> {
        let code = self.u8()?;
        let Some(activation) = codes::activation(code) else {
            return self.wrong(index, "an activation that this player knows");
        };
        let [scale, bias] = self.f32s()?;
        let sources = self.list("neurons", SHORTEST_SOURCE, |file, _| Ok((file.u16()?, file.f32()?)))?;
        Ok(Neuron { activation, scale, bias, sources })
    }
}
