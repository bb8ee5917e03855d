//! The operations of ONNX, and the lists of numbers they work on.

use super::protobuf::Message;
use std::collections::BTreeMap;

/// The numbers that ONNX has for kinds of numbers and of attributes.
const FLOAT: u64 = 1;
const INT64: u64 = 7;
const DOUBLE: u64 = 11;
const ATTRIBUTE_INT: u64 = 2;

/// The numbers of the fields of a graph.
const NODE: u64 = 1;
const NAME: u64 = 2;
const INITIALIZER: u64 = 5;
const INPUT: u64 = 11;
const OUTPUT: u64 = 12;

/// What numbers are cast to.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    Single,
    Double,
    Whole,
}

/// A graph that grows. Every list that goes in or comes out has one row.
pub(crate) struct Graph {
    message: Message,
    /// What the operations belong to: their names begin with it.
    part: String,
    operations: usize,
    constants: usize,
    /// Single numbers, by their bytes.
    known: BTreeMap<Vec<u8>, String>,
    powers: Option<String>,
}

impl Graph {
    pub(crate) fn new(name: &str) -> Self {
        let message = Message::default().text(NAME, name);
        Self { message, part: name.into(), operations: 0, constants: 0, known: BTreeMap::new(), powers: None }
    }

    fn field(&mut self, field: u64, message: Message) {
        self.message = std::mem::take(&mut self.message).message(field, message);
    }

    pub(crate) fn input(&mut self, name: &str, count: usize, what: &str) {
        self.field(INPUT, value(name, count, what));
    }

    pub(crate) fn output(&mut self, name: &str, count: usize, what: &str) {
        self.field(OUTPUT, value(name, count, what));
    }

    /// The operations that follow are those of a part.
    pub(crate) fn begin(&mut self, part: &str) {
        (self.part, self.operations) = (part.into(), 0);
    }

    /// An operation of the given kind; the name of its result.
    pub(crate) fn apply(&mut self, kind: &str, inputs: &[&str]) -> String {
        let result = self.next_name(kind);
        self.field(NODE, operation(kind, inputs, &result));
        result
    }

    /// One that works along an axis.
    pub(crate) fn along(&mut self, axis: u64, kind: &str, inputs: &[&str]) -> String {
        let result = self.next_name(kind);
        self.along_to(axis, kind, inputs, &result);
        result
    }

    /// The same, with a name for the result.
    pub(crate) fn along_to(&mut self, axis: u64, kind: &str, inputs: &[&str], result: &str) {
        self.field(NODE, operation(kind, inputs, result).message(5, attribute("axis", axis)));
    }

    /// What comes out, as it is.
    pub(crate) fn identity(&mut self, input: &str, result: &str) {
        self.field(NODE, operation("Identity", &[input], result));
    }

    pub(crate) fn cast(&mut self, input: &str, to: Kind) -> String {
        let result = self.next_name("Cast");
        let number = match to {
            Kind::Single => FLOAT,
            Kind::Double => DOUBLE,
            Kind::Whole => INT64,
        };
        self.field(NODE, operation("Cast", &[input], &result).message(5, attribute("to", number)));
        result
    }

    fn next_name(&mut self, kind: &str) -> String {
        self.operations += 1;
        format!("{}.{}{}", self.part, kind.to_lowercase(), self.operations - 1)
    }

    /// A single number; its name.
    pub(crate) fn number(&mut self, number: f32) -> String {
        self.single(FLOAT, &number.to_le_bytes())
    }

    /// A single number of 64 bits; its name.
    pub(crate) fn double(&mut self, number: f64) -> String {
        self.single(DOUBLE, &number.to_le_bytes())
    }

    /// A single whole number; its name.
    pub(crate) fn whole(&mut self, number: usize) -> String {
        self.single(INT64, &(number as i64).to_le_bytes())
    }

    fn single(&mut self, kind: u64, bytes: &[u8]) -> String {
        let key = [&[kind as u8], bytes].concat();
        if let Some(name) = self.known.get(&key) {
            return name.clone();
        }
        let name = self.constant(kind, &[], bytes);
        self.known.insert(key, name.clone());
        name
    }

    /// A constant; its name.
    pub(crate) fn numbers(&mut self, shape: &[usize], numbers: &[f32]) -> String {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        self.constant(FLOAT, shape, &bytes)
    }

    /// All powers of 2 whose exponents are so far from 0, as a list; its name.
    pub(crate) fn powers_of_two(&mut self, most: i32) -> String {
        if let Some(name) = &self.powers {
            return name.clone();
        }
        let powers: Vec<f32> = (-most..=most).map(|exponent| libm::exp2f(exponent as f32)).collect();
        let name = self.numbers(&[powers.len()], &powers);
        self.powers = Some(name.clone());
        name
    }

    /// A constant of whole numbers; its name.
    pub(crate) fn indices(&mut self, shape: &[usize], indices: &[usize]) -> String {
        let bytes: Vec<u8> = indices.iter().flat_map(|&index| (index as i64).to_le_bytes()).collect();
        self.constant(INT64, shape, &bytes)
    }

    fn constant(&mut self, kind: u64, shape: &[usize], bytes: &[u8]) -> String {
        let name = format!("constant{}", self.constants);
        self.constants += 1;
        let tensor = shape.iter().fold(Message::default(), |tensor, &size| tensor.number(1, size as u64));
        self.field(INITIALIZER, tensor.number(2, kind).text(8, &name).bytes(9, bytes));
        name
    }

    pub(crate) fn into_message(self) -> Message {
        self.message
    }
}

fn operation(kind: &str, inputs: &[&str], result: &str) -> Message {
    let node = inputs.iter().fold(Message::default(), |node, input| node.text(1, input));
    // Some programs want a name for each.
    node.text(2, result).text(3, result).text(4, kind)
}

fn attribute(name: &str, number: u64) -> Message {
    Message::default().text(1, name).number(3, number).number(20, ATTRIBUTE_INT)
}

/// What goes in or comes out: a row of numbers.
fn value(name: &str, count: usize, what: &str) -> Message {
    let size = |count: usize| Message::default().number(1, count as u64);
    let shape = Message::default().message(1, size(1)).message(1, size(count));
    let tensor = Message::default().number(1, FLOAT).message(2, shape);
    Message::default().text(1, name).message(2, Message::default().message(1, tensor)).text(3, what)
}
