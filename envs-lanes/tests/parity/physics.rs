//! Worlds that differ in gravity, motors, joints, contacts, solver iterations and pushes.

use crate::stage::{SHIPPED, all_sensors, both, drive, nets, shipped};
use envs_core::{Conditions, Ground, PhysicsSettings, Push, Variation};
use envs_lanes::{LaneEnvironment, LaneEpisode};
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Phenotype, Purpose, Seed, Task};
use rand::RngExt;
use std::collections::BTreeSet;
use tasks::{Combine, Environment, Episode, Movement, Snapshot, Trials, Verdict};

/// Everything varies that can on level ground.
fn everything() -> Variation {
    Variation { friction: 0.3, mass: 0.1, start_pose: 0.05, torso_spin: 0.5, pushes: 0.3, ..Variation::physics() }
}

fn environments(name: &str, variation: Variation) -> (RapierEnvironment, LaneEnvironment) {
    environments_of(name, PhysicsSettings::default(), variation)
}

fn environments_of(
    name: &str,
    settings: PhysicsSettings,
    variation: Variation,
) -> (RapierEnvironment, LaneEnvironment) {
    let blueprint = shipped(name);
    both(&blueprint, &all_sensors(&blueprint), settings, variation)
}

#[test]
fn every_shipped_creature_moves_as_in_rapier_in_worlds_of_other_physics() {
    let named = [Variation::near(), Variation::physics(), Variation::pushed(), everything()];
    for name in SHIPPED {
        for variation in named {
            let (mut rapier, mut lanes) = environments(name, variation);
            for seed in 1..4 {
                // What explodes does so in both.
                drive(&mut rapier, &mut lanes, seed, 250, 9);
            }
        }
    }
}

#[test]
fn a_world_of_given_conditions_is_that_of_rapier() {
    for name in SHIPPED {
        let (rapier, lanes) = environments(name, Variation::default());
        for seed in 1..4 {
            let mut stream = Seed::of_run(seed).stream(Purpose::new("pushes"));
            let mut push =
                |_| Push { time: 2.0 * stream.random::<f32>(), velocity: 0.8 * stream.random::<f32>() - 0.4 };
            let pushes = (0..6).map(&mut push).collect();
            let conditions = Conditions { pushes, ..everything().draw(Seed::of_run(seed), rapier.outputs()) };
            let rapier = rapier.under(&conditions, Ground::flat());
            let lanes = lanes.under(&conditions, Ground::flat());
            match (rapier, lanes) {
                (Ok(mut rapier), Ok(mut lanes)) => {
                    drive(&mut rapier, &mut lanes, seed, 200, 9);
                }
                (rapier, lanes) => {
                    let [rapier, lanes] = [rapier.err(), lanes.err()].map(|error| error.map(|e| e.to_string()));
                    assert_eq!(rapier, lanes);
                }
            }
        }
    }
}

/// A number that every bit of every step goes into. It ends the trial at a step that depends on them too, so that the lanes
/// of a batch come to be in different trials, which is in different worlds.
#[derive(Clone, Default)]
struct Fingerprint {
    hash: u64,
    steps: u32,
}

impl Fingerprint {
    fn add(&mut self, value: u64) {
        self.hash = (self.hash ^ value).wrapping_mul(0x0000_0100_0000_01b3).rotate_left(23);
    }
}

impl Movement for Fingerprint {
    fn name(&self) -> &str {
        "fingerprint"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn begin(&mut self, start: &Snapshot) {
        *self = Self::default();
        self.observe(start);
    }

    fn observe(&mut self, Snapshot { time, parts, motor_work, push_work, command }: &Snapshot) -> Verdict {
        self.add(u64::from(time.to_bits()));
        self.add(u64::from(command.speed.to_bits()));
        self.add(u64::from(command.since_press.to_bits()));
        self.add(motor_work.to_bits());
        self.add(push_work.to_bits());
        for part in parts {
            for value in [part.x, part.y, part.cos, part.sin, part.vx, part.vy, part.spin] {
                self.add(u64::from(value.to_bits()));
            }
            self.add(u64::from(part.touching));
        }
        self.steps += 1;
        if self.steps > 10 && (self.hash >> 7).is_multiple_of(120) { Verdict::End } else { Verdict::GoOn }
    }

    fn value(&self) -> f64 {
        // As many bits as a float has.
        (self.hash >> 11) as f64
    }
}

const TRIALS: Trials = Trials { count: 6, combine: Combine::Mean, lessons: false };

fn batch(task: &LaneEpisode, nets: &mut [impl Phenotype], seed: Seed) -> Vec<Evaluation> {
    let mut phenotypes: Vec<&mut dyn Phenotype> = nets.iter_mut().map(|net| net as &mut dyn Phenotype).collect();
    task.evaluate_batch(&mut phenotypes, seed)
}

/// Compares each step of each trial of a batch with rapier; gives the evaluations.
fn compare(name: &str, variation: Variation, seed: Seed) -> Vec<Evaluation> {
    compare_all(name, environments(name, variation), seed)
}

fn compare_all(name: &str, both: (RapierEnvironment, LaneEnvironment), seed: Seed) -> Vec<Evaluation> {
    let (rapier, lanes) = both;
    let variation = *rapier.variation();
    let rapier = Episode::new(rapier, Box::new(Fingerprint::default()), 300, TRIALS).expect("valid");
    let lanes = LaneEpisode::new(lanes, Box::new(Fingerprint::default()), 300, TRIALS).expect("valid");
    let mut nets = nets(rapier.inputs(), rapier.outputs(), 24);
    let wanted: Vec<Evaluation> = nets.iter_mut().map(|net| rapier.evaluate(net, seed)).collect();
    let found = batch(&lanes, &mut nets, seed);
    for (found, wanted) in found.iter().zip(&wanted) {
        assert_eq!(found, wanted, "{name}, {seed:?}, {variation:?}");
    }
    found
}

#[test]
fn lanes_in_worlds_of_different_physics_take_each_step_as_rapier_does() {
    for (name, run) in SHIPPED.into_iter().zip(1..) {
        let seed = Seed::of_run(run);
        let draw = |trial| everything().draw(seed.trial(trial), 4).solver_iterations;
        let iterations: BTreeSet<_> = (0..TRIALS.count).map(draw).collect();
        assert!(iterations.len() >= 3, "{name}: the trials have {iterations:?} iterations");
        let found = compare(name, everything(), seed);
        let lengths: BTreeSet<u64> = found.iter().map(|evaluation| evaluation.steps).collect();
        assert!(lengths.len() > 12, "{name}: trials must end at different times, not after {lengths:?} steps");
        assert!(found.iter().any(|evaluation| evaluation.outcome.is_ok()), "{name}: no creature lasts");
    }
}

#[test]
fn so_they_do_on_ground_of_several_shapes() {
    for name in ["biped-1", "tetrapod-2"] {
        compare(name, Variation { bumps: 0.02, ..everything() }, Seed::of_run(5));
    }
}

#[test]
fn a_batch_in_varied_physics_gives_what_rapier_gives() {
    for variation in [Variation::near(), Variation::physics(), Variation::pushed()] {
        for name in ["biped-2", "apod"] {
            compare(name, variation, Seed::of_run(2));
        }
    }
}

/// One iteration, motors of 50 times the gain and joints of 6 kHz hardly damped: that may explode, and is a failure then.
#[test]
fn what_explodes_fails_as_in_rapier() {
    let extreme = Variation {
        time_step: [0.2083, 2.0],
        motor_gain: [50.0, 100.0],
        solver_iterations: Some([1, 3]),
        joint_frequency: [17.0, 100.0],
        contact_frequency: [0.1, 100.0],
        contact_damping: [0.1, 0.2],
        gravity: 0.9,
        torso_spin: 5.0,
        pushes: 5.0,
        ..Variation::default()
    };
    let settings = PhysicsSettings {
        internal_iterations: 1,
        joint_damping_ratio: 0.1,
        corrective_speed: 1000.0,
        motor_gain: 1e5,
        unstable_speed: 5.0,
        ..PhysicsSettings::default()
    };
    let mut failed = 0;
    for bumps in [0.0, 0.1] {
        for (name, run) in SHIPPED.into_iter().zip(1..) {
            let both = environments_of(name, settings, Variation { bumps, ..extreme });
            let found = compare_all(name, both, Seed::of_run(run));
            failed += found.iter().filter(|evaluation| evaluation.outcome.is_err()).count();
        }
    }
    assert!(failed > 0, "nothing explodes, so that nothing is shown");
}
