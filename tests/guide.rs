//! The code in the guide, compiled and run as documentation tests: what a reader copies works.

#[cfg(doctest)]
#[doc = include_str!("../docs/own-movement.md")]
mod own_movement {}

#[cfg(doctest)]
#[doc = include_str!("../docs/own-creature.md")]
mod own_creature {}

#[cfg(doctest)]
#[doc = include_str!("../docs/own-strategy.md")]
mod own_strategy {}

#[cfg(doctest)]
#[doc = include_str!("../docs/own-environment.md")]
mod own_environment {}

#[cfg(doctest)]
#[doc = include_str!("../docs/libraries.md")]
mod libraries {}
