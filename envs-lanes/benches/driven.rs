//! Steps a second of creatures whose actions come from outside, on one core: what the vector environments of the Python package are
//! made of, without Python. `python python/benchmarks/environments.py` does the same with it.
//!
//! `cargo bench -p envs-lanes --bench driven` prints a table.

#![allow(clippy::print_stdout, reason = "a bench prints its table")]

use creatures::Blueprint;
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::{DrivenLanes, LANES, LaneEnvironment, LaneEpisode};
use ne_core::{Purpose, Seed};
use rand::RngExt;
use std::time::Instant;
use tasks::{Running, Trials};

const CREATURES: usize = 1024;
const STEPS: usize = 200;
const ROUNDS: usize = 7;

fn main() {
    println!("{CREATURES} creatures, random actions, {ROUNDS} rounds of {STEPS} steps");
    println!("{:<12} {:>14} {:>12}", "creature", "steps/s, best", "median");
    for name in ["biped-1", "tetrapod-2"] {
        let blueprint = Blueprint::new(creatures::find(name).expect("shipped")).expect("valid");
        let sensors = blueprint.creature().sensors.clone();
        let (settings, variation) = (PhysicsSettings::default(), Variation::default());
        let environment = LaneEnvironment::new(blueprint, &sensors, 3.0, settings, variation).expect("lanes take it");
        let start = environment.settled(Seed::of_run(1)).expect("it stands");
        let episode =
            LaneEpisode::new(environment, Box::new(Running::default()), 2000, Trials::default()).expect("valid");
        let mut groups: Vec<DrivenLanes> = (0..CREATURES / LANES).map(|_| DrivenLanes::new(&episode)).collect();
        for group in &mut groups {
            (0..LANES).for_each(|lane| group.begin(lane, &start));
        }
        let (inputs, outputs) = (groups[0].inputs(), groups[0].outputs());
        let mut random = Seed::of_run(2).stream(Purpose::new("actions"));
        let actions: Vec<Vec<f32>> =
            (0..50).map(|_| (0..CREATURES * outputs).map(|_| random.random_range(-1.0..1.0)).collect()).collect();
        let mut observations = vec![0.0; CREATURES * inputs];
        let mut rewards = vec![0.0; CREATURES];
        let mut seconds: Vec<Vec<f64>> = Vec::new();
        for _ in 0..ROUNDS {
            let round = (0..STEPS).map(|step| {
                let began = Instant::now();
                let whole = groups.iter_mut().zip(actions[step % actions.len()].chunks(LANES * outputs));
                let rows = observations.chunks_mut(LANES * inputs).zip(rewards.chunks_mut(LANES));
                for ((group, actions), (observations, rewards)) in whole.zip(rows) {
                    for (lane, actions) in actions.chunks(outputs).enumerate() {
                        group.act(lane, actions);
                    }
                    group.step(&mut |lane, step| rewards[lane] = step.reward);
                    group.sense();
                    for (lane, observations) in observations.chunks_mut(inputs).enumerate() {
                        group.read(lane, observations);
                    }
                }
                began.elapsed().as_secs_f64()
            });
            seconds.push(round.collect());
        }
        let best = seconds.iter().map(|round| round.iter().sum::<f64>()).fold(f64::INFINITY, f64::min);
        let mut single = seconds.concat();
        single.sort_unstable_by(f64::total_cmp);
        let median = CREATURES as f64 / single[single.len() / 2];
        println!("{name:<12} {:>14.0} {median:>12.0}", (CREATURES * STEPS) as f64 / best);
    }
}
