//! A reader of ONNX models that knows what nets need, and computes them with the precision of f64.

use std::collections::BTreeMap;

#[derive(Debug, Default)]
pub(crate) struct Model {
    pub(crate) metadata: BTreeMap<String, String>,
    /// Each with its shape.
    pub(crate) inputs: Vec<(String, Vec<u64>)>,
    pub(crate) outputs: Vec<(String, Vec<u64>)>,
    operations: Vec<Operation>,
    constants: BTreeMap<String, Vec<f64>>,
}

#[derive(Debug, Default)]
struct Operation {
    inputs: Vec<String>,
    result: String,
    kind: String,
    axis: Option<u64>,
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

    /// Computes all rows that there are.
    pub(crate) fn run(&self, given: &[(&str, &[f64])]) -> BTreeMap<String, Vec<f64>> {
        let mut known = self.constants.clone();
        known.extend(given.iter().map(|(name, row)| ((*name).to_owned(), row.to_vec())));
        for Operation { inputs, result, kind, axis } in &self.operations {
            let inputs: Vec<&Vec<f64>> = inputs.iter().map(|input| &known[input]).collect();
            assert_eq!(axis.is_some(), matches!(&**kind, "Concat" | "Gather"));
            let row = compute(kind, &inputs);
            assert!(known.insert(result.clone(), row).is_none(), "{result} is computed once");
        }
        known
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
                operation.axis =
                    fields(field.bytes()).iter().find(|(number, _)| *number == 3).map(|(_, field)| field.number())
            }
            _ => {}
        }
    }
    operation
}

fn tensor(bytes: &[u8]) -> (String, Vec<f64>) {
    let (mut name, mut kind, mut size, mut numbers) = (String::new(), 0, 1, Vec::new());
    for (number, field) in fields(bytes) {
        match number {
            1 => size *= field.number() as usize,
            2 => kind = field.number(),
            8 => name = field.text(),
            9 if kind == 1 => {
                numbers = field.bytes().as_chunks().0.iter().map(|&number| f32::from_le_bytes(number).into()).collect();
            }
            9 => {
                assert_eq!(kind, 7);
                numbers = field.bytes().as_chunks().0.iter().map(|&number| i64::from_le_bytes(number) as f64).collect();
            }
            _ => {}
        }
    }
    assert_eq!(numbers.len(), size, "{name}");
    (name, numbers)
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

fn compute(kind: &str, inputs: &[&Vec<f64>]) -> Vec<f64> {
    let each = |function: fn(f64) -> f64| inputs[0].iter().map(|&number| function(number)).collect();
    let both = |function: fn(f64, f64) -> f64| {
        let second = inputs[1];
        let pair = |(place, &first): (usize, &f64)| function(first, second[if second.len() == 1 { 0 } else { place }]);
        inputs[0].iter().enumerate().map(pair).collect()
    };
    match kind {
        "Gemm" => {
            let (row, matrix, biases) = (inputs[0], inputs[1], inputs[2]);
            assert_eq!(matrix.len(), row.len() * biases.len());
            let sum = |(column, bias): (usize, &f64)| {
                let products = row.iter().zip(matrix[column..].iter().step_by(biases.len()));
                bias + products.map(|(number, weight)| number * weight).sum::<f64>()
            };
            biases.iter().enumerate().map(sum).collect()
        }
        "Concat" => inputs.iter().flat_map(|row| row.iter().copied()).collect(),
        "Gather" => inputs[1].iter().map(|&index| inputs[0][index as usize]).collect(),
        "Identity" => inputs[0].clone(),
        "Clip" => inputs[0].iter().map(|number| number.clamp(inputs[1][0], inputs[2][0])).collect(),
        "Sigmoid" => each(|a| 1.0 / (1.0 + libm::exp(-a))),
        "Tanh" => each(libm::tanh),
        "Relu" => each(|a| a.max(0.0)),
        "Sin" => each(libm::sin),
        "Exp" => each(libm::exp),
        "Neg" => each(|a| -a),
        "Mul" => both(|a, b| a * b),
        "Add" => both(|a, b| a + b),
        "Div" => both(|a, b| a / b),
        other => panic!("{other} is not known"),
    }
}
