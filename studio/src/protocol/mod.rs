//! What a page and the studio say to each other. A message is JSON; only what moves comes as [numbers](crate::Arena::frame).

mod arena_error;
mod event;
mod request;
mod verdict;

pub use arena_error::ArenaError;
pub use event::{
    ArenaData, Catalogue, Described, Event, ExportFormat, Mistake, NamedThing, Opened, RobustnessResult,
    RobustnessState, RunEntry, RunState, TerrainChoice,
};
pub use request::{Choice, Request, Told, Who};
pub use verdict::Verdict;
