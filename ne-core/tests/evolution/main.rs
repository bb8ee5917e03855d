//! The loop: champions, stop conditions, observers, threads, resuming.
#![cfg(feature = "parallel")]

mod champion;
mod champion_selection;
#[path = "../common/mod.rs"]
mod common;
mod observers;
mod promotion;
mod resuming;
mod scripted;
mod stopping;
mod successive_halving;
mod tasks;
mod threads;

use common::{Climber, Imitate};
use ne_core::{Evolution, Seed, StopConditions};

const TASK: Imitate = Imitate { batch: 4 };

/// A run that lasts this many generations.
fn evolution(generations: u64) -> Evolution<Climber> {
    let stop = StopConditions { generations: Some(generations), ..Default::default() };
    Evolution::new(Climber::new(21), Seed::of_run(5), stop)
}

/// All there is to compare of a run, bit by bit.
fn state(evolution: &Evolution<Climber>) -> String {
    let champion = serde_json::to_string(&evolution.champion()).expect("a champion is plain data");
    let strategy = serde_json::to_string(evolution.strategy()).expect("a strategy is plain data");
    format!("{:?} {champion} {strategy}", evolution.progress())
}
