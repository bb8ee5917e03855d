//! The studio, served from this machine to a browser on it.
//!
//! ```text
//!  browser ── HTTP, web socket ── Server ── Viewer ── Session ── run folder
//!                                    one for each page   one for each run
//! ```
//!
//! Three decisions:
//!
//! - **A page is never trusted.** The [`Server`] listens on the loopback address alone. It answers requests that have the secret in their path and
//!   come from its own page. Names of runs are names of folders in one folder; no path is ever taken from a page.
//! - **A run that is watched is a run like any other.** A [`Session`] trains in a run folder, and looks at what it is told between two
//!   generations. It can let the run wait, or end it; what the run finds is the same to the bit.
//! - **A thread for each page.** A [`Viewer`] answers one message after the other; nothing is asynchronous but the sockets.

mod downloads;
mod guard;
mod library;
mod secret;
mod server;
mod session;
mod shared;
mod socket;
mod viewer;

pub use library::{Library, LibraryError};
pub use server::{Server, ServerError};
pub use session::Session;
pub use viewer::{Reply, Viewer};
