//! Many runs, and what can be said of them.
//!
//! | module | what it does |
//! |---|---|
//! | [`compare`] | strategies against each other, with the same seeds and statistics |
//! | [`tune`] | the settings of a strategy, by random search on seeds of its own |
//! | [`reproduce`] | the experiments of the thesis Gambol starts from, beside what it reports |
//! | [`gaits`] | how many gaits are usable, how soon and how robust; what each piece of the default preset is worth |
//! | [`benchmarks`] | the strategies on classic tasks, beside published numbers |
//! | [`distributed`] | the runs of these experiments on machines that share no files |

pub mod benchmarks;
pub mod compare;
pub mod distributed;
mod folder;
pub mod gaits;
pub mod reproduce;
pub mod tune;
mod work;

pub use folder::ExperimentError;
