//! How one layer of a configuration is laid over another.

use serde_json::{Map, Value};

/// Lays fields over what is there, as [`Assembly::lay_over`](crate::assembly::Assembly::lay_over) says.
pub(crate) fn merge(base: &mut Value, layer: Value) {
    match (base, layer) {
        (Value::Object(base), Value::Object(layer)) if !is_other_choice(base, &layer) => {
            for (key, value) in layer {
                merge(base.entry(key).or_insert(Value::Null), value);
            }
        }
        (base, layer) => *base = layer,
    }
}

/// A choice is an object whose one field names what was chosen and, in our own configurations, holds its settings,
/// themselves an object.
fn is_other_choice(base: &Map<String, Value>, layer: &Map<String, Value>) -> bool {
    let is_choice = base.len() == 1 && base.values().all(Value::is_object);
    is_choice && layer.len() == 1 && base.keys().ne(layer.keys())
}
