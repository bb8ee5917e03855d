//! The tasks on which NEAT is compared with the literature.

mod poles;
mod runs;
mod xor;
