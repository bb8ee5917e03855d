//! What no crate can promise on its own: that the documents tell the truth, that the crates stand on each other as
//! drawn, that runs come out as they always did, and that a movement of one's own is as short as promised.

mod arrows;
mod circles;
mod classic_table;
mod documents;
mod engines;
mod golden;
mod packages;
mod tables;
mod thirty_lines;
mod transfer;

use std::path::Path;

/// The workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("this package is in the workspace")
}
