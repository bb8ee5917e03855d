//! Candidates in a checkpoint: what is the same in the genomes of all of them is written once.
//!
//! The genomes of a search over weights all have one topology, which can be larger than the weights. In JSON:
//! `{"shared": {"topology": …}, "each": [{"genome": {"weights": […]}, "fitness": 1.0, "generation": 3}]}`.

use crate::{Candidate, field_path};
use serde::{
    Deserialize, Deserializer, Serialize, Serializer,
    de::{DeserializeOwned, Error as _},
    ser::Error as _,
};
use serde_json::{Map, Value};

#[derive(Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SharedFields {
    /// Fields of every genome.
    shared: Map<String, Value>,
    /// The candidates without them.
    each: Vec<Value>,
}

/// Where a genome stands in a candidate.
const GENOME: &str = "genome";

pub(crate) fn serialize<G: Serialize, R: Serializer>(
    candidates: &[Candidate<G>],
    serializer: R,
) -> Result<R::Ok, R::Error> {
    // Through text, which has an f32 as its shortest decimal.
    let value = |candidate| serde_json::from_str(&serde_json::to_string(candidate)?);
    let mut each: Vec<Value> =
        candidates.iter().map(value).collect::<Result<_, serde_json::Error>>().map_err(R::Error::custom)?;
    let genome = |candidate: &Value| candidate.get(GENOME).and_then(Value::as_object).cloned();
    let mut shared = each.first().and_then(genome).unwrap_or_default();
    for candidate in &each {
        let fields = candidate.get(GENOME).and_then(Value::as_object);
        shared.retain(|name, value| fields.and_then(|fields| fields.get(name)) == Some(value));
    }
    for genome in each.iter_mut().filter_map(|candidate| candidate.get_mut(GENOME)?.as_object_mut()) {
        genome.retain(|name, _| !shared.contains_key(name));
    }
    SharedFields { shared, each }.serialize(serializer)
}

pub(crate) fn deserialize<'de, G: DeserializeOwned, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Vec<Candidate<G>>, D::Error> {
    let SharedFields { shared, each } = SharedFields::deserialize(deserializer)?;
    let whole = |(index, mut candidate): (usize, Value)| {
        if let Some(genome) = candidate.get_mut(GENOME).and_then(Value::as_object_mut) {
            for (name, value) in &shared {
                genome.entry(name).or_insert_with(|| value.clone());
            }
        }
        field_path::from_value(&candidate).map_err(|error| D::Error::custom(format!("each[{index}]: {error}")))
    };
    each.into_iter().enumerate().map(whole).collect()
}
