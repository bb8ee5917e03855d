//! The moments at which a process that is killed leaves something half done, for tests that kill it there.
//!
//! A test gives [`observe`] a function that ends the process at the moment it wants. So it stops at *every* write of a run,
//! where a clock would hit some. Nothing but a test observes them, and without an observer they cost a look at a flag.

use std::{fs::File, path::Path, sync::OnceLock};

/// Something that is about to be changed on the disk.
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum WritePoint<'a> {
    /// This folder will be made, if it is not there.
    Folder(&'a Path),
    /// A temporary file will be made for this path.
    Begin(&'a Path),
    /// The temporary file is written and flushed; it will be renamed to this path.
    Rename(&'a Path),
    /// The file is at this path; its folder will be flushed.
    FlushFolder(&'a Path),
    /// This line will be appended to a file.
    Append {
        /// The file's path.
        path: &'a Path,
        /// The file, so that an observer may write half of the line.
        file: &'a File,
        /// The line with its end.
        line: &'a [u8],
    },
    /// What is at this path will be moved to another place.
    Move(&'a Path),
}

type Observer = Box<dyn Fn(WritePoint<'_>) + Send + Sync>;

static OBSERVER: OnceLock<Observer> = OnceLock::new();

/// Has this function called at every write point of this process from now on; the first observer stays.
pub fn observe(observer: impl Fn(WritePoint<'_>) + Send + Sync + 'static) {
    let _ = OBSERVER.set(Box::new(observer));
}

/// Tells the observer, if there is one. Every writer calls it before it writes.
pub fn reach(point: WritePoint<'_>) {
    if let Some(observer) = OBSERVER.get() {
        observer(point);
    }
}
