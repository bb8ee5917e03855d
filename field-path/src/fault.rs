//! What is wrong, while it is carried up to where its path is known.

use crate::{FieldError, without_place};
use serde::de::{self, Expected, Unexpected};
use std::fmt::{self, Display};

/// A place in a list or an object.
#[derive(Debug)]
enum Step {
    Item(usize),
    Key(String),
}

/// Boxed: what is read is handed up through many functions, and is seldom wrong.
#[derive(Debug)]
pub(crate) struct Fault(Box<Parts>);

#[derive(Debug)]
struct Parts {
    message: String,
    /// From the innermost outwards.
    path: Vec<Step>,
    /// The address of the value's text: where it lies in the whole, however deep it was found.
    address: Option<usize>,
}

impl Fault {
    /// What `serde_json` says of a part of the text; where in that part it says so means nothing.
    pub(crate) fn of_part(error: &serde_json::Error) -> Self {
        de::Error::custom(without_place(&error.to_string()))
    }

    /// The same fault, seen from the list that has it in an item with this text.
    #[cold]
    pub(crate) fn in_item(self, index: usize, text: &str) -> Self {
        self.within(Step::Item(index), text)
    }

    /// The same fault, seen from the object that has it in a field, or the enum that has it in a variant, with this text.
    #[cold]
    pub(crate) fn in_field(self, key: &str, text: &str) -> Self {
        self.within(Step::Key(key.to_owned()), text)
    }

    fn within(mut self, step: Step, text: &str) -> Self {
        self.0.path.push(step);
        self.0.address.get_or_insert(text.as_ptr() as usize);
        self
    }

    pub(crate) fn explain(self, whole: &[u8]) -> FieldError {
        let Parts { message, path: steps, address } = *self.0;
        let mut path = String::new();
        for step in steps.iter().rev() {
            match step {
                Step::Item(index) => path.push_str(&format!("[{index}]")),
                Step::Key(key) if path.is_empty() => path.push_str(key),
                Step::Key(key) => {
                    path.push('.');
                    path.push_str(key);
                }
            }
        }
        if path.is_empty() {
            path.push('.');
        }
        let start = whole.len() - whole.trim_ascii_start().len();
        let offset = address.map_or(start, |address| address.saturating_sub(whole.as_ptr() as usize));
        let before = &whole[..offset.min(whole.len())];
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        let column = 1 + before.iter().rev().take_while(|&&byte| byte != b'\n').count();
        FieldError { path, message, line, column, is_syntax: false }
    }
}

impl Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.message)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    fn custom<T: Display>(message: T) -> Self {
        Self(Box::new(Parts { message: message.to_string(), path: Vec::new(), address: None }))
    }

    // In the words of JSON: of serde's own "unit" it makes "null".
    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::custom(<serde_json::Error as de::Error>::invalid_type(found, expected))
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::custom(<serde_json::Error as de::Error>::invalid_value(found, expected))
    }
}
