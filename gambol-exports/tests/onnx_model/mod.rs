//! A reader of ONNX models that knows what nets need, and computes them as the format's description says, each operation by
//! itself: with 32 bits what has 32 bits, with 64 bits what has 64.

mod tensor;

use std::collections::BTreeMap;
use tensor::{Kind, Tensor, compute};

#[derive(Debug, Default)]
pub(crate) struct Model {
    pub(crate) metadata: BTreeMap<String, String>,
    /// Each with its shape.
    pub(crate) inputs: Vec<(String, Vec<u64>)>,
    pub(crate) outputs: Vec<(String, Vec<u64>)>,
    operations: Vec<Operation>,
    constants: BTreeMap<String, Tensor>,
}

#[derive(Debug, Default)]
struct Operation {
    inputs: Vec<String>,
    result: String,
    kind: String,
    attribute: Option<(String, u64)>,
}

enum Field<'a> {
    Number(u64),
    Bytes(&'a [u8]),
}

/// The fields of a message, with their numbers.
fn fields(mut bytes: &[u8]) -> Vec<(u64, Field<'_>)> {
    let mut fields = Vec::new();
    while !bytes.is_empty() {
        let key = varint(&mut bytes);
        let field = match key & 7 {
            0 => Field::Number(varint(&mut bytes)),
            2 => {
                let length = varint(&mut bytes) as usize;
                let (field, rest) = bytes.split_at(length);
                bytes = rest;
                Field::Bytes(field)
            }
            other => panic!("wire type {other}"),
        };
        fields.push((key >> 3, field));
    }
    fields
}

fn varint(bytes: &mut &[u8]) -> u64 {
    let mut value = 0;
    for shift in (0..).step_by(7) {
        let (&byte, rest) = bytes.split_first().expect("another byte");
        *bytes = rest;
        value |= u64::from(byte & 0x7f) << shift;
        if byte < 0x80 {
            break;
        }
    }
    value
}

impl<'a> Field<'a> {
    fn bytes(&self) -> &'a [u8] {
        match self {
            Self::Bytes(bytes) => bytes,
            Self::Number(number) => panic!("{number} is no message"),
        }
    }

    fn number(&self) -> u64 {
        match self {
            Self::Number(number) => *number,
            Self::Bytes(bytes) => panic!("{bytes:?} are no number"),
        }
    }

    fn text(&self) -> String {
        String::from_utf8(self.bytes().to_vec()).expect("text")
    }
}

impl Model {
    pub(crate) fn read(bytes: &[u8]) -> Self {
        let mut model = Self::default();
        for (number, field) in fields(bytes) {
            match number {
                1 => assert_eq!(field.number(), 8),
                7 => model.read_graph(field.bytes()),
                8 => assert!(fields(field.bytes()).iter().all(|(number, field)| *number == 1 || field.number() == 17)),
                14 => {
                    let entry: Vec<String> = fields(field.bytes()).iter().map(|(_, field)| field.text()).collect();
                    model.metadata.insert(entry[0].clone(), entry[1].clone());
                }
                _ => {}
            }
        }
        model
    }

    fn read_graph(&mut self, bytes: &[u8]) {
        for (number, field) in fields(bytes) {
            match number {
                1 => self.operations.push(operation(field.bytes())),
                5 => self.constants.extend([tensor(field.bytes())]),
                11 => self.inputs.push(value(field.bytes())),
                12 => self.outputs.push(value(field.bytes())),
                _ => {}
            }
        }
    }

    /// Computes all that there is, of rows; gives the rows that are there then.
    pub(crate) fn run(&self, given: &[(&str, &[f32])]) -> BTreeMap<String, Vec<f32>> {
        let mut known = self.constants.clone();
        known.extend(given.iter().map(|(name, row)| ((*name).to_owned(), Tensor::row(row))));
        for operation in &self.operations {
            let inputs: Vec<&Tensor> = operation.inputs.iter().map(|input| &known[input]).collect();
            let attribute = operation.attribute.as_ref().map(|(name, number)| (&**name, *number));
            let result = compute(&operation.kind, &inputs, attribute);
            assert!(known.insert(operation.result.clone(), result).is_none(), "{} is computed once", operation.result);
        }
        let row =
            |(name, tensor): (String, Tensor)| (tensor.shape.first() == Some(&1)).then(|| (name, tensor.singles()));
        known.into_iter().filter_map(row).collect()
    }
}

fn operation(bytes: &[u8]) -> Operation {
    let mut operation = Operation::default();
    for (number, field) in fields(bytes) {
        match number {
            1 => operation.inputs.push(field.text()),
            2 => operation.result = field.text(),
            4 => operation.kind = field.text(),
            5 => {
                let attribute = fields(field.bytes());
                let of = |wanted| attribute.iter().find(|(number, _)| *number == wanted).map(|(_, field)| field);
                operation.attribute = of(1).zip(of(3)).map(|(name, number)| (name.text(), number.number()));
            }
            _ => {}
        }
    }
    operation
}

fn tensor(bytes: &[u8]) -> (String, Tensor) {
    let (mut name, mut kind, mut shape, mut raw) = (String::new(), 0, Vec::new(), Vec::new());
    for (number, field) in fields(bytes) {
        match number {
            1 => shape.push(field.number() as usize),
            2 => kind = field.number(),
            8 => name = field.text(),
            9 => raw = field.bytes().to_vec(),
            _ => {}
        }
    }
    let kind = Kind::of(kind);
    let numbers: Vec<f64> = match kind {
        Kind::Single => raw.as_chunks().0.iter().map(|&number| f32::from_le_bytes(number).into()).collect(),
        Kind::Double => raw.as_chunks().0.iter().map(|&number| f64::from_le_bytes(number)).collect(),
        Kind::Whole => raw.as_chunks().0.iter().map(|&number| i64::from_le_bytes(number) as f64).collect(),
    };
    assert_eq!(numbers.len(), shape.iter().product::<usize>(), "{name}");
    (name, Tensor { kind, shape, numbers })
}

fn value(bytes: &[u8]) -> (String, Vec<u64>) {
    let (mut name, mut shape) = (String::new(), Vec::new());
    for (number, field) in fields(bytes) {
        match number {
            1 => name = field.text(),
            2 => {
                // A type of a tensor, its shape, its sizes, and a number each.
                let tensor = fields(field.bytes())[0].1.bytes();
                let sizes = fields(tensor).iter().find(|(number, _)| *number == 2).map(|(_, field)| field.bytes());
                shape = fields(sizes.expect("a shape"))
                    .iter()
                    .map(|(_, size)| fields(size.bytes())[0].1.number())
                    .collect();
            }
            _ => {}
        }
    }
    (name, shape)
}
