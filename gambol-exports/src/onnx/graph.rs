//! The operations of ONNX, and the lists of numbers they work on.

use super::protobuf::Message;

/// The numbers that ONNX has for kinds of numbers and of attributes.
const FLOAT: u64 = 1;
const INT64: u64 = 7;
const ATTRIBUTE_INT: u64 = 2;

/// The numbers of the fields of a graph.
const NODE: u64 = 1;
const NAME: u64 = 2;
const INITIALIZER: u64 = 5;
const INPUT: u64 = 11;
const OUTPUT: u64 = 12;

/// A graph that grows. Every list has one row.
pub(crate) struct Graph {
    message: Message,
    constants: usize,
}

impl Graph {
    pub(crate) fn new(name: &str) -> Self {
        Self { message: Message::default().text(NAME, name), constants: 0 }
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

    /// An operation, of the given kind; the name of its result.
    pub(crate) fn operation(&mut self, kind: &str, inputs: &[&str], result: &str) -> String {
        self.field(NODE, operation(kind, inputs, result));
        result.into()
    }

    /// One that works along the columns of a row.
    pub(crate) fn along_row(&mut self, kind: &str, inputs: &[&str], result: &str) -> String {
        let axis = Message::default().text(1, "axis").number(3, 1).number(20, ATTRIBUTE_INT);
        self.field(NODE, operation(kind, inputs, result).message(5, axis));
        result.into()
    }

    /// A constant; its name.
    pub(crate) fn numbers(&mut self, shape: &[usize], numbers: &[f32]) -> String {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        self.constant(FLOAT, shape, &bytes)
    }

    /// A constant of whole numbers; its name.
    pub(crate) fn indices(&mut self, indices: &[usize]) -> String {
        let bytes: Vec<u8> = indices.iter().flat_map(|&index| (index as i64).to_le_bytes()).collect();
        self.constant(INT64, &[indices.len()], &bytes)
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

/// What goes in or comes out: a row of numbers.
fn value(name: &str, count: usize, what: &str) -> Message {
    let size = |count: usize| Message::default().number(1, count as u64);
    let shape = Message::default().message(1, size(1)).message(1, size(count));
    let tensor = Message::default().number(1, FLOAT).message(2, shape);
    Message::default().text(1, name).message(2, Message::default().message(1, tensor)).text(3, what)
}
