//! The studio, served from this machine to a browser on it.
//!
//! ```text
//!  browser ── HTTP, web socket ── Server ── studio::Viewer
//!                                    one for each page, on a thread of its own
//! ```
//!
//! Two decisions:
//!
//! - **A page is never trusted.** The [`Server`] listens on the loopback address alone. It answers requests that have the secret in their path and
//!   come from its own page.
//! - **A thread for each page, and for each job** ([`Threads`]). A viewer answers one message after the other; nothing is asynchronous but
//!   the sockets.

mod downloads;
mod guard;
mod secret;
mod server;
mod shared;
mod socket;
mod threads;

pub use server::{Server, ServerError};
pub use threads::Threads;

use gambol_runs::Registry;
use std::{path::PathBuf, sync::Arc};
use studio::{Library, Means};

/// The library over the runs in a folder, which need not be there yet. `threads` of each training; 0: one for each core.
pub fn library(registry: Registry, runs: PathBuf, threads: usize) -> Library {
    let workers = Arc::new(Threads::default());
    Library::new(registry, runs, Means { workers, helpers: None, threads, writes_reports: true })
}
