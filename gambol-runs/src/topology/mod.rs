//! The nets of controllers: how limbs share one, what weights are called, and how a net goes on in another body.

mod fitting;
pub(crate) mod limbs;
mod names;
mod remapped;

pub(crate) use fitting::difference;
pub(crate) use names::{of_weights, weight_names};
