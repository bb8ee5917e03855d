//! The studio as a static page: the libraries as WebAssembly in workers of a browser, without any server.
//!
//! ```text
//!  page ──┬── worker of runs:  Host ── studio::Viewer ── runs on a disk in memory, kept in the browser's storage
//!         ├── worker of the arena:  Host ── studio::Viewer, for what is to be seen
//!         └── helpers: evaluate pieces of generations for the worker of runs
//! ```
//!
//! Three decisions:
//!
//! - **The same code, the same bytes.** All of the libraries are compiled for `wasm32-wasip1`. The page gives them a disk, so that a run writes
//!   its folder as it does everywhere; a champion that was trained on the page passes `gambol verify`.
//! - **One generation at a time.** There are no threads: a worker does a bit of its [jobs](studio::work::Job) between two messages. So it
//!   needs neither shared memory nor the headers that a page needs for it. Other cores help through messages, too: a [`desk`] hands
//!   out pieces of a generation, and every net is evaluated by itself, so that the bytes are the same with any number of helpers.
//! - **Two workers.** A generation may take a second. What moves on the page is therefore elsewhere: the worker of runs sends the
//!   [scene](studio::Scene) that is to be shown, and that of the arena plays it.
//!
//! `build_page`, a program of this crate, makes the page; *docs/studio.md* says how it is hosted.

pub mod desk;
mod host;
mod queue;

#[cfg(target_family = "wasm")]
pub mod page;

pub use host::{Helper, Host};
pub use queue::Queue;
