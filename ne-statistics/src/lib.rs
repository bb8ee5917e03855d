//! Statistics for comparing search strategies: is one method better than another, by how much, and how sure is that?
//!
//! A stochastic search gives another result with every seed, and researchers can afford few seeds. This crate holds what
//! is then worth reporting: robust aggregates with intervals in place of bare means (Agarwal, Schwarzer, Castro,
//! Courville & Bellemare, *Deep Reinforcement Learning at the Edge of the Statistical Precipice*, NeurIPS 2021, "Agarwal
//! et al. 2021" in this crate), and the classical tests for runs that are paired by their seeds.
//!
//! | question | answer |
//! |---|---|
//! | how good is a method over all tasks? | [`interquartile_mean`], [`median_of_task_means`], [`mean`], [`optimality_gap`], [`quantile`] |
//! | how sure is that? | [`Bootstrap::interval`] of any of them |
//! | which share of runs is good enough? | [`performance_profile`], [`performance_profile_band`] |
//! | by how much is x better than y? | [`Bootstrap::comparison`] of a difference; [`hodges_lehmann`] for pairs, [`shift_between`] otherwise |
//! | how often is x better than y? | [`probability_of_improvement`]; on one task [`vargha_delaney`] |
//! | could it be chance? | on one task [`wilcoxon_signed_rank`] for pairs, [`rank_sum`] otherwise; over all tasks [`improvement_test`]; for several tests [`holm`] |
//! | how long does it take? | [`Curve::first_reaching`], [`median_to_threshold`] |
//! | what does progress look like? | [`pointwise_quartiles`] |
//! | how to average metres and seconds? | [`normalize`] |
//!
//! The one decision behind it: **pure functions of plain numbers.** [`Scores`] (a row for each task, a column for each
//! run), [`Comparison`] and [`Curve`] are checked when they are made; what takes them cannot fail. Nothing here knows of
//! genomes, runs or files. Scores are larger-is-better throughout; negate costs.
//!
//! A failed run is not a number, and no function guesses one: decide what a failure scores before the comparison, and
//! say so.
//!
//! Tests and corrections are written here, as statrs, the library for statistics in Rust, has neither the signed-rank
//! test nor Holm's correction nor a bootstrap. They are checked against published tables and SciPy.
//!
//! # Example
//!
//! ```
//! use ne_core::Seed;
//! use ne_statistics::{
//!     Bootstrap, Comparison, Scores, holm, interquartile_mean, probability_of_improvement, wilcoxon_signed_rank,
//! };
//!
//! // Two tasks, six seeds; the same seeds for both methods.
//! let ours = Scores::new(&[vec![0.8, 0.9, 0.7, 0.95, 0.85, 0.9], vec![0.6, 0.5, 0.7, 0.65, 0.55, 0.6]])?;
//! let theirs = Scores::new(&[vec![0.7, 0.75, 0.6, 0.7, 0.8, 0.65], vec![0.5, 0.55, 0.6, 0.6, 0.5, 0.65]])?;
//!
//! let (bootstrap, seed) = (Bootstrap::default(), Seed::of_run(1));
//! let aggregate = bootstrap.interval(&ours, interquartile_mean, seed);
//! assert!(aggregate.low <= aggregate.estimate && aggregate.estimate <= aggregate.high);
//!
//! // A test for each task, corrected because there are two.
//! let p_values: Result<Vec<f64>, _> =
//!     ours.rows().zip(theirs.rows()).map(|(x, y)| wilcoxon_signed_rank(x, y).map(|test| test.p)).collect();
//! let adjusted = holm(&p_values?)?;
//! assert_eq!(adjusted[0], 2.0 * 0.03125);
//!
//! let both = Comparison::paired(ours, theirs)?;
//! let improvement = bootstrap.comparison(&both, probability_of_improvement, seed);
//! assert!(improvement.low > 0.5, "ours is likely to be better: {improvement:?}");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod aggregate;
mod bootstrap;
mod comparison;
mod curve;
mod hodges_lehmann;
mod holm;
mod improvement;
mod normalization;
mod permutation;
mod pointwise;
mod profile;
mod quantile;
mod rank_sum;
mod sample;
mod scores;
mod time_to_threshold;
mod vargha_delaney;
mod wilcoxon;

pub use aggregate::{interquartile_mean, mean, median_of_task_means, optimality_gap};
pub use bootstrap::{Bootstrap, Interval};
pub use comparison::{Comparison, ComparisonError};
pub use curve::{Curve, CurveError};
pub use hodges_lehmann::hodges_lehmann;
pub use holm::holm;
pub use improvement::probability_of_improvement;
pub use normalization::{NormalizationError, Reference, normalize};
pub use permutation::improvement_test;
pub use pointwise::{Quartiles, pointwise_quartiles};
pub use profile::{performance_profile, performance_profile_band};
pub use quantile::quantile;
pub use rank_sum::{RankSumTest, rank_sum, shift_between};
pub use sample::{LARGEST, SampleError};
pub use scores::{Scores, ScoresError};
pub use time_to_threshold::median_to_threshold;
pub use vargha_delaney::vargha_delaney;
pub use wilcoxon::{WilcoxonTest, wilcoxon_signed_rank};
