//! The numbers of a glTF file: one buffer, and what says where in it each list is.

use base64::{Engine, prelude::BASE64_STANDARD};
use serde_json::{Value, json};

/// What glTF calls lists of numbers and of vertices.
const FLOAT: u32 = 5126;
const UNSIGNED_SHORT: u32 = 5123;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;

/// What a list is used for.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Use {
    /// Vertices: have bounds, and are told to the graphics card.
    Vertices,
    /// Times of keys: have bounds.
    Times,
    /// Values of keys.
    Values,
}

#[derive(Default)]
pub(crate) struct Buffer {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
}

impl Buffer {
    /// Adds a list of vectors; its index.
    pub(crate) fn add<const N: usize>(&mut self, rows: &[[f32; N]], used: Use) -> usize {
        let kind = ["SCALAR", "VEC2", "VEC3", "VEC4"][N - 1];
        let bytes = rows.iter().flatten().flat_map(|number| number.to_le_bytes());
        let view = self.view(bytes, (used == Use::Vertices).then_some(ARRAY_BUFFER));
        let mut accessor = json!({ "bufferView": view, "componentType": FLOAT, "count": rows.len(), "type": kind });
        if used != Use::Values {
            let bounds = |start: f32, pick: fn(f32, f32) -> f32| {
                let bound = |place: usize| rows.iter().map(|row| row[place]).fold(start, pick);
                (0..N).map(bound).collect::<Vec<f32>>()
            };
            accessor["min"] = json!(bounds(f32::INFINITY, f32::min));
            accessor["max"] = json!(bounds(f32::NEG_INFINITY, f32::max));
        }
        self.accessors.push(accessor);
        self.accessors.len() - 1
    }

    /// Adds a list of triangles; its index.
    pub(crate) fn add_triangles(&mut self, corners: &[u16]) -> usize {
        let bytes = corners.iter().flat_map(|corner| corner.to_le_bytes());
        let view = self.view(bytes, Some(ELEMENT_ARRAY_BUFFER));
        let count = corners.len();
        self.accessors
            .push(json!({ "bufferView": view, "componentType": UNSIGNED_SHORT, "count": count, "type": "SCALAR" }));
        self.accessors.len() - 1
    }

    fn view(&mut self, bytes: impl Iterator<Item = u8>, target: Option<u32>) -> usize {
        // Numbers stand at multiples of their size.
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let mut view = json!({ "buffer": 0, "byteOffset": start, "byteLength": self.bytes.len() - start });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        self.views.push(view);
        self.views.len() - 1
    }

    /// Writes it into a document.
    pub(crate) fn write(self, document: &mut Value) {
        let data = BASE64_STANDARD.encode(&self.bytes);
        let uri = format!("data:application/octet-stream;base64,{data}");
        document["buffers"] = json!([{ "byteLength": self.bytes.len(), "uri": uri }]);
        document["bufferViews"] = Value::Array(self.views);
        document["accessors"] = Value::Array(self.accessors);
    }
}
