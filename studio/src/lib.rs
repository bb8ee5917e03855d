//! The studio: runs that are watched, steered and played with through a page.
//!
//! ```text
//!  page ── messages ── Viewer ── Session ── run folder
//!                one for each page   one for each run
//! ```
//!
//! Three decisions:
//!
//! - **The page asks for every step that it shows.** An [`Arena`] holds creatures and lets time pass only when it is told to. So pause, slow
//!   motion and time lapse are a matter of the page alone, a page that sleeps costs nothing, and no clock is in any result.
//! - **A run that is watched is a run like any other.** A [`Session`] trains in a run folder, and looks at what it is told between two
//!   generations. It can let the run wait, or end it; what the run finds is the same to the bit.
//! - **Nothing here has a thread or a socket.** What takes its time is a [job](work::Job), done bit by bit by [workers](work::Workers).
//!   `studio-server` brings threads and web sockets, `studio-web` the workers of a browser: one studio, two homes.
//!
//! | piece | what it is |
//! |---|---|
//! | [`protocol`] | what page and studio say to each other, as plain data |
//! | [`Library`], [`Session`], [`Viewer`] | all runs, one run, what one page sees |
//! | [`Scene`], [`Arena`] | what is to be shown; creatures that move on the same ground at once |
//! | [`Member`], [`Descent`] | what is known of one of a generation, and where it comes from |
//! | [`Wanted`], [`Download`] | what a page can have of a run as a file |
//! | [`choice`] | from what was chosen on a page to a configuration |
//! | [`page`] | the page: its sources, put together |
//!
//! No path is ever taken from a page: names of runs are names of folders in one folder.

pub mod choice;
pub mod page;
pub mod protocol;
pub mod work;

mod arena;
mod descent;
mod downloads;
mod film;
mod judging;
mod library;
mod population;
mod robustness;
mod scene;
mod session;
mod training;
mod viewer;

pub use arena::{Arena, MOST_STEPS};
pub use descent::{Descent, Group, How, Member, Parent};
pub use downloads::{Download, DownloadError, Wanted};
pub use library::{Library, LibraryError};
pub use scene::{Entrant, Scene, Shown, World};
pub use session::{Means, Session, SessionError};
pub use viewer::{Reply, Viewer};
