//! Files: whole or not at all, every damage found, every number kept.
#![cfg(feature = "evolution")]

mod damage;
mod numbers;
mod writing;

use ne_core::archive::{self, ArchiveError, Layout};
use serde::{Deserialize, Serialize};
use std::path::Path;

const FORMAT: &str = "test file";
const VERSION: u32 = 3;

/// A little of everything that files hold.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Content {
    name: String,
    weights: Vec<f32>,
    fitness: Option<f64>,
    steps: u64,
    nested: Vec<Inner>,
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Inner {
    x: f32,
    on: bool,
}

fn content() -> Content {
    Content {
        name: "bïped \"1\"\n".into(),
        weights: vec![0.1, -2.5e-8, 0.0, -0.0, 1e10],
        fitness: Some(-12.75),
        steps: u64::MAX,
        nested: vec![Inner { x: 0.5, on: true }, Inner { x: -1.0, on: false }],
    }
}

fn write(path: &Path, layout: Layout) -> Result<(), ArchiveError> {
    archive::write(path, FORMAT, VERSION, &content(), layout)
}

fn read(path: &Path) -> Result<Content, ArchiveError> {
    archive::read(path, FORMAT, VERSION)
}
