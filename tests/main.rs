//! What no crate can promise on its own: that the documents tell the truth, that the crates stand on each other as
//! drawn, and that runs come out as they always did.

mod arrows;
mod documents;
mod engines;
mod golden;
mod transfer;

use std::path::Path;

/// The workspace.
fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("this package is in the workspace")
}
