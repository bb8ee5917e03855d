use super::*;
use crate::{Setup, config::EngineChoice};
use creatures::Sensor;
use ne_core::{Evaluation, Failure, Phenotype, Seed, Task};
use ne_net::Network;
use tasks::{Combine, Trials};

/// A body like the creature's, but for its weight.
fn heavier(creature: &Creature, times: f32) -> Creature {
    let mut heavy = Creature { name: format!("{} x {times}", creature.name), ..creature.clone() };
    heavy.parts.iter_mut().for_each(|part| part.density *= times);
    heavy
}

/// Three bodies that run for a second, in varied worlds.
fn config(engine: EngineChoice, combine: Combine) -> RunConfig {
    let creature = creatures::find("biped-2").expect("shipped");
    let mut config = Registry::default().config("default", creature.clone(), "running").expect("a preset");
    config.movement.steps = Some(60);
    config.training_steps = Some(50);
    config.trials = Trials { count: 2, combine, lessons: false };
    config.further_bodies = [0.7, 1.6].map(|times| heavier(&creature, times)).into();
    RunConfig { engine, ..config }
}

fn setup(config: &RunConfig) -> Setup {
    Setup::new(config, &Registry::default()).expect("valid")
}

fn refusal(config: &RunConfig) -> String {
    Setup::new(config, &Registry::default()).err().map_or_else(|| "fine".into(), |error| error.to_string())
}

/// A run of the same kind in each body alone.
fn alone(config: &RunConfig) -> Vec<TrainingTask> {
    let bodies = std::iter::once(&config.creature).chain(&config.further_bodies);
    let config =
        |creature: &Creature| RunConfig { creature: creature.clone(), further_bodies: Vec::new(), ..config.clone() };
    bodies.map(|creature| setup(&config(creature)).task).collect()
}

fn network(setup: &Setup, number: u32) -> Network {
    let gene = |index: usize| 0.5 * libm::sinf(3.7 * index as f32 + 1.3 * number as f32);
    setup.topology.network(&(0..setup.topology.weight_count()).map(gene).collect::<Vec<_>>())
}

/// What evaluations in each body come to, told another way.
fn combined(evaluations: &[Evaluation], combine: Combine) -> Evaluation {
    let count = evaluations.len() as f64;
    let fitnesses: Vec<f64> = evaluations.iter().map(|it| it.fitness().expect("it did not fail").get()).collect();
    let worst = fitnesses.iter().copied().min_by(f64::total_cmp).expect("some");
    let mean = (fitnesses[0] + fitnesses[1] + fitnesses[2]) / count;
    let mut all = Evaluation::new(if combine == Combine::Mean { mean } else { worst });
    all.steps = evaluations[0].steps + evaluations[1].steps + evaluations[2].steps;
    for (name, _) in evaluations[0].measurements.iter() {
        let [a, b, c] = [0, 1, 2].map(|body: usize| evaluations[body].measurements[name] / count);
        all.measurements.insert(name, a + b + c);
    }
    for index in 0..evaluations[0].objectives.len() {
        let [a, b, c] = [0, 1, 2].map(|body: usize| evaluations[body].objectives[index] / count);
        all.objectives.push(a + b + c);
    }
    all
}

#[test]
fn an_evaluation_is_the_mean_or_the_worst_of_the_bodies() {
    let seed = Seed::of_run(5).generation(3);
    for combine in [Combine::Mean, Combine::Worst] {
        let mut found = Vec::new();
        for engine in EngineChoice::ALL {
            let mut config = config(engine, combine);
            config.movement.objectives = ["running", "energy"].map(|term| tasks::TermSpec::new(term, 1.0)).into();
            let setup = setup(&config);
            assert_eq!(setup.task.engine(), engine);
            let tasks = alone(&config);
            let cheaper = |task: &TrainingTask| task.shortened(20).with_fewer_trials(1);
            for (change, steps) in [(&(|task: &TrainingTask| task.clone()) as &dyn Fn(&_) -> _, 50), (&cheaper, 20)] {
                let (task, tasks): (TrainingTask, Vec<TrainingTask>) =
                    (change(&setup.task), tasks.iter().map(change).collect());
                assert_eq!(task.steps(), steps);
                let mut nets: Vec<Network> = (0..20).map(|number| network(&setup, number)).collect();
                let expected: Vec<Evaluation> = nets
                    .iter_mut()
                    .map(|net| tasks.iter().map(|task| task.evaluate(net, seed)).collect::<Vec<_>>())
                    .map(|evaluations| combined(&evaluations, combine))
                    .collect();
                assert!(expected.iter().any(|evaluation| evaluation.fitness() != expected[0].fitness()));
                let each: Vec<Evaluation> = nets.iter_mut().map(|net| task.evaluate(net, seed)).collect();
                assert_eq!(each, expected, "{engine:?} {combine:?}");
                let mut batch: Vec<&mut dyn Phenotype> = nets.iter_mut().map(|net| net as &mut dyn Phenotype).collect();
                assert_eq!(task.evaluate_batch(&mut batch, seed), expected, "{engine:?} {combine:?} at once");
                found.push(expected);
            }
        }
        let (lanes, rapier) = found.split_at(2);
        assert_eq!(lanes, rapier);
    }
}

/// Stands still, and has no answer any more in the `last` trial it begins.
#[derive(Clone)]
struct Faltering {
    shape: (usize, usize),
    begun: u32,
    last: u32,
    answers: u32,
}

impl Phenotype for Faltering {
    fn inputs(&self) -> usize {
        self.shape.0
    }
    fn outputs(&self) -> usize {
        self.shape.1
    }
    fn reset(&mut self) {
        (self.begun, self.answers) = (self.begun + 1, 0);
    }
    fn activate(&mut self, _: &[f32], outputs: &mut [f32]) {
        self.answers += 1;
        outputs.fill(if self.begun == self.last && self.answers > 7 { f32::NAN } else { 0.0 });
    }
}

#[test]
fn an_individual_that_fails_in_one_body_fails_and_is_not_tried_in_the_next() {
    let seed = Seed::of_run(5);
    for engine in EngineChoice::ALL {
        let mut config = config(engine, Combine::Mean);
        // Nothing else ends an episode. Lanes play trials on flat ground beside those on bumps, and so not in turn.
        config.movement.terms.clear();
        config.variation.bumps = 0.0;
        let task = setup(&config).task;
        let shape = (task.inputs(), task.outputs());
        // Two trials of 50 steps in each of three bodies.
        for (last, begun, steps) in [(1, 1, 7), (2, 2, 57), (3, 3, 107), (6, 6, 257), (7, 6, 300)] {
            let mut faltering = Faltering { shape, begun: 0, last, answers: 0 };
            let mut steady = Faltering { shape, begun: 0, last: 0, answers: 0 };
            let evaluations = task.evaluate_batch(&mut [&mut faltering, &mut steady], seed);
            assert_eq!((faltering.begun, evaluations[0].steps), (begun, steps), "{engine:?}, {last}");
            let failure = Failure::NonFinite { what: "output 0".into() };
            assert_eq!(evaluations[0].outcome.as_ref().err(), (last < 7).then_some(&failure));
            assert_eq!((steady.begun, evaluations[1].steps, evaluations[1].outcome.is_ok()), (6, 300, true));
        }
        let mut misfit = Faltering { shape: (1, 1), begun: 0, last: 0, answers: 0 };
        assert!(matches!(task.evaluate(&mut misfit, seed).outcome, Err(Failure::ShapeMismatch { .. })));
    }
}

#[test]
fn the_champion_is_judged_in_the_creature_alone() {
    let mut config = config(EngineChoice::Lanes, Combine::Mean);
    (config.variation, config.training_steps) = (Default::default(), None);
    let several = setup(&config);
    let reference = several.reference.as_ref().expect("a champion selection");
    assert!(reference.judge.is_some() && reference.proof.is_none());
    let net = network(&several, 3);
    let own = alone(&config)[0].evaluate(&mut net.clone(), reference.seed);
    let judged = reference.task.evaluate(&mut net.clone(), reference.seed);
    assert_eq!(judged.outcome, own.outcome);
    config.further_bodies.clear();
    assert!(setup(&config).reference.is_none());
}

#[test]
fn further_bodies_are_as_many_as_allowed_and_fit_the_creature() {
    let config = config(EngineChoice::Lanes, Combine::Mean);
    let with = |further_bodies: Vec<Creature>| refusal(&RunConfig { further_bodies, ..config.clone() });
    let find = |name: &str| creatures::find(name).expect("shipped");
    assert_eq!(with(vec![find("biped-2"); 15]), "fine");
    assert_eq!(with(vec![find("biped-2"); 16]), "further_bodies = 16 creatures: must be at most 15 creatures");
    let message = with(vec![find("biped-2"), find("biped-1")]);
    let begins = "further_bodies[1] (\"biped-1\"): one net cannot move it and the creature: it has 11 inputs, the creature has 13";
    assert!(message.starts_with(begins), "{message}");
    let mut colliding = find("biped-2");
    colliding.self_collision = true;
    let message = with(vec![colliding.clone()]);
    assert!(message.starts_with("further_bodies[0] (\"biped-2\"): engine: "), "{message}");
    assert!(message.ends_with("train it with --engine rapier"), "{message}");
    let in_rapier = RunConfig { engine: EngineChoice::Rapier, further_bodies: vec![colliding], ..config.clone() };
    assert_eq!(refusal(&in_rapier), "fine");
    let mut torn = find("biped-2");
    torn.joints.pop();
    let message = with(vec![torn]);
    assert!(message.starts_with("further_bodies[0] (\"biped-2\"): creature: "), "{message}");
    // The same motors in another order would be driven by the wrong outputs.
    let mut crossed = find("biped-2");
    crossed.joints.swap(0, 2);
    let message = with(vec![crossed]);
    let order =
        "further_bodies[0] (\"biped-2\"): one net cannot move it and the creature: its inputs are in another order: ";
    assert!(message.starts_with(order), "{message}");
}

#[test]
fn without_sensors_of_the_run_those_of_each_creature_count() {
    let mut config = config(EngineChoice::Lanes, Combine::Mean);
    config.sensors = None;
    assert_eq!(refusal(&config), "fine");
    config.further_bodies[1].sensors.push(Sensor::JointSpeeds);
    let message = refusal(&config);
    assert!(message.starts_with("further_bodies[1] (\"biped-2 x 1.6\"): one net cannot move it"), "{message}");
    assert!(message.ends_with(" is not among the creature's"), "{message}");
    let sensors = config.further_bodies[1].sensors.clone();
    config.further_bodies[1].sensors.truncate(1);
    let message = refusal(&config);
    assert!(message.ends_with(" is not among the further body's"), "{message}");
    // Those of the run hold for all.
    config.sensors = Some(sensors);
    assert_eq!(refusal(&config), "fine");
}
