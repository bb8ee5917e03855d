//! What goes wrong is told as rapier's episode tells it: the same failure, after the same steps.

use crate::stage::{both, shipped};
use envs_core::{PhysicsSettings, Variation};
use envs_lanes::LaneEpisode;
use envs_rapier::RapierEnvironment;
use ne_core::{Evaluation, Failure, Phenotype, Seed, Task};
use tasks::{Combine, Episode, Movement, Running, Snapshot, Sum, Trials, Verdict};

/// Moves all its motors at full speed, and at one step puts out something else.
#[derive(Clone)]
struct Faulty {
    inputs: usize,
    outputs: usize,
    at: u32,
    puts_out: f32,
    step: u32,
}

impl Phenotype for Faulty {
    fn inputs(&self) -> usize {
        self.inputs
    }

    fn outputs(&self) -> usize {
        self.outputs
    }

    fn reset(&mut self) {
        self.step = 0;
    }

    fn activate(&mut self, _: &[f32], outputs: &mut [f32]) {
        self.step += 1;
        outputs.fill(if self.step % 20 < 10 { 1.0 } else { -1.0 });
        if self.step == self.at
            && let Some(last) = outputs.last_mut()
        {
            *last = self.puts_out;
        }
    }
}

type Tasks = (Episode<RapierEnvironment>, LaneEpisode);

fn tasks(name: &str, settings: PhysicsSettings, movement: Box<dyn Movement>, trials: Trials) -> Tasks {
    let blueprint = shipped(name);
    let sensors = blueprint.creature().sensors.clone();
    let (rapier, lanes) = both(&blueprint, &sensors, settings, Variation::light());
    let rapier = Episode::new(rapier, movement.clone(), 100, trials).expect("valid");
    (rapier, LaneEpisode::new(lanes, movement, 100, trials).expect("valid"))
}

/// Compares a batch of faulty controllers with rapier's episodes, one by one, and gives the evaluations.
fn compare((rapier, lanes): &Tasks, faults: &[(u32, f32)]) -> Vec<Evaluation> {
    let seed = Seed::of_run(6);
    let (inputs, outputs) = (rapier.inputs(), rapier.outputs());
    let new = |&(at, puts_out): &(u32, f32)| Faulty { inputs, outputs, at, puts_out, step: 0 };
    let mut faulty: Vec<Faulty> = faults.iter().map(new).collect();
    let wanted: Vec<Evaluation> = faulty.iter_mut().map(|one| rapier.evaluate(one, seed)).collect();
    let mut batch: Vec<&mut dyn Phenotype> = faulty.iter_mut().map(|one| one as &mut dyn Phenotype).collect();
    let found = lanes.evaluate_batch(&mut batch, seed);
    assert_eq!(found, wanted);
    found
}

#[test]
fn an_output_that_is_no_number_ends_the_trial_where_it_does_in_rapier() {
    let trials = Trials { count: 2, combine: Combine::Worst, lessons: false };
    for name in ["biped-1", "tetrapod-2"] {
        let tasks = tasks(name, PhysicsSettings::default(), Box::new(Running::default()), trials);
        let mut faults = Vec::new();
        for at in [1, 2, 50, 100, 101] {
            faults.extend([(at, f32::NAN), (at, f32::INFINITY), (at, f32::NEG_INFINITY), (at, 0.5)]);
        }
        let found = compare(&tasks, &faults);
        let last = tasks.0.outputs() - 1;
        let failure = Failure::NonFinite { what: format!("output {last}") };
        assert_eq!((&found[0].outcome, found[0].steps), (&Err(failure.clone()), 0));
        assert_eq!((&found[8].outcome, found[8].steps), (&Err(failure), 49));
        assert!(found[3].outcome.is_ok() && found[16].outcome.is_ok(), "nothing is wrong with these");
    }
}

#[test]
fn a_part_that_is_too_fast_ends_the_trial_where_it_does_in_rapier() {
    for (name, unstable_speed) in [("biped-1", 1.0), ("tetrapod-2", 2.0), ("decapod-2", 3.0), ("apod", 1.0)] {
        let settings = PhysicsSettings { unstable_speed, ..PhysicsSettings::default() };
        let trials = Trials { count: 3, combine: Combine::Mean, lessons: false };
        let faults: Vec<(u32, f32)> = (1..40).map(|at| (at, 0.3)).collect();
        let found = compare(&tasks(name, settings, Box::new(Running::default()), trials), &faults);
        let unstable = |one: &Evaluation| matches!(one.outcome, Err(Failure::Unstable { .. }));
        assert!(found.iter().any(unstable), "{name}: no creature exceeds {unstable_speed} m/s");
    }
}

/// Is over at the first step.
#[derive(Clone)]
struct Over;

impl Movement for Over {
    fn name(&self) -> &str {
        "over"
    }

    fn unit(&self) -> &str {
        "1"
    }

    fn begin(&mut self, _: &Snapshot) {}

    fn observe(&mut self, _: &Snapshot) -> Verdict {
        Verdict::End
    }

    fn value(&self) -> f64 {
        1.0
    }
}

#[test]
fn a_movement_that_ends_at_once_does_so_in_lanes() {
    let trials = Trials { count: 4, combine: Combine::Worst, lessons: false };
    let faults: Vec<(u32, f32)> = (1..40).map(|at| (at % 3, f32::NAN)).collect();
    let found = compare(&tasks("biped-1", PhysicsSettings::default(), Box::new(Over), trials), &faults);
    assert!(found.iter().any(|one| one.outcome.is_ok() && one.steps == 4));
}

/// Does not score torsos that sink by so much below their start, m, and ends the trial of those that rise by 20 cm.
#[derive(Clone)]
struct Disqualifies {
    by: f32,
    start: f32,
}

impl Movement for Disqualifies {
    fn name(&self) -> &str {
        "disqualifies"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn begin(&mut self, start: &Snapshot) {
        self.start = start.torso().y;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let rise = now.torso().y - self.start;
        match rise {
            _ if rise < -self.by => Verdict::Fail("it ducks"),
            _ if rise > 0.2 => Verdict::End,
            _ => Verdict::GoOn,
        }
    }

    fn value(&self) -> f64 {
        f64::from(self.start)
    }
}

#[test]
fn a_movement_that_fails_a_trial_does_so_in_lanes() {
    let trials = Trials { count: 3, combine: Combine::Mean, lessons: false };
    let ducks = Err(Failure::Other { what: "it ducks".into() });
    for name in ["biped-1", "tetrapod-2"] {
        for by in [0.0, 0.01, 0.05] {
            let movement = Sum::of(Running::default()).plus(0.5, Disqualifies { by, start: 0.0 });
            let faults: Vec<(u32, f32)> = (1..40).map(|at| (at, 0.3)).collect();
            let found = compare(&tasks(name, PhysicsSettings::default(), Box::new(movement), trials), &faults);
            assert!(by > 0.0 || found.iter().any(|one| one.outcome == ducks), "{name}: no creature ducks");
        }
    }
}
