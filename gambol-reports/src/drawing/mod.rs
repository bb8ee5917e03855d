//! What pictures of gaits have in common: a canvas, creatures, ground, text, and files of 256 colours.

pub(crate) mod axis;
pub(crate) mod canvas;
pub(crate) mod corners;
pub(crate) mod creature;
mod error;
pub(crate) mod painter;
pub(crate) mod palette;
pub(crate) mod scene;
pub(crate) mod text;

pub use error::DrawingError;
pub(crate) use error::check_poses;
pub use painter::{Framing, MarkedGround, Painter};
