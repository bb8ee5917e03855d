//! The studio: what a page asks of Gambol and what it is answered.
//!
//! Its one decision: **the page asks for every step that it shows.** An [`Arena`] holds creatures and lets time pass only when it is told to.
//! So pause, slow motion and time lapse are a matter of the page alone, a page that sleeps costs nothing, and no clock is in any result.
//! Training is somewhere else, in a run folder as any run; the studio looks at it.
//!
//! | piece | what it is |
//! |---|---|
//! | [`protocol`] | what the two say to each other, as plain data |
//! | [`Arena`] | creatures that move on the same ground at once |
//! | [`choice`] | from what was chosen on a page to a configuration |
//! | [`page`] | the page: its sources, put together |
//!
//! Nothing here has a thread, a socket or a file: `studio-server` brings these.

pub mod choice;
pub mod page;
pub mod protocol;

mod arena;

pub use arena::{Arena, Entrant, MOST_STEPS};
