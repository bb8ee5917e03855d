use crate::scripted::{Prompter, Script, Unused};
use ne_core::{Generation, Observer, ObserverError, StopConditions, StopReason, StopSignal};

/// Runs a script of four genomes a generation, 10 steps each, whose fitness rises for three generations.
fn run(stop: StopConditions) -> (StopReason, u64) {
    let mut evolution = Script::evolution(&[&[1.0; 4], &[2.0; 4], &[3.0; 4]], stop);
    let prompter = Prompter::of(&evolution);
    let reason = evolution.run(&Unused, &prompter, &mut []).expect("the run ends in peace");
    (reason, evolution.progress().generations)
}

const NONE: StopConditions = StopConditions {
    generations: None,
    evaluations: None,
    steps: None,
    minutes: None,
    target: None,
    tier: None,
    stagnation: None,
};

#[test]
fn each_condition_ends_the_run() {
    assert_eq!(run(StopConditions { generations: Some(5), ..NONE }), (StopReason::Generations, 5));
    assert_eq!(run(StopConditions { evaluations: Some(8), ..NONE }), (StopReason::Evaluations, 2));
    assert_eq!(run(StopConditions { steps: Some(120), ..NONE }), (StopReason::Steps, 3));
    assert_eq!(run(StopConditions { target: Some(2.0), ..NONE }), (StopReason::Target, 2));
    assert_eq!(run(StopConditions { stagnation: Some(4), ..NONE }), (StopReason::Stagnation, 7));
    let (reason, generations) = run(StopConditions { minutes: Some(1e-4), ..NONE });
    assert!(reason == StopReason::Minutes && generations > 0, "{reason} after {generations}");
}

#[test]
fn the_generation_under_way_is_finished() {
    assert_eq!(run(StopConditions { evaluations: Some(9), ..NONE }), (StopReason::Evaluations, 3));
    assert_eq!(run(StopConditions { steps: Some(1), ..NONE }), (StopReason::Steps, 1));
}

#[test]
fn the_first_condition_wins_and_the_target_before_all() {
    let both = StopConditions { generations: Some(3), target: Some(3.0), ..NONE };
    assert_eq!(run(both), (StopReason::Target, 3));
    assert_eq!(run(StopConditions { target: Some(1e9), ..both }), (StopReason::Generations, 3));
}

#[test]
fn a_run_that_has_ended_does_nothing_more() {
    let mut evolution = Script::evolution(&[&[1.0]], StopConditions { generations: Some(3), ..NONE });
    let prompter = Prompter::of(&evolution);
    for _ in 0..2 {
        assert_eq!(evolution.run(&Unused, &prompter, &mut []).expect("it ends"), StopReason::Generations);
        assert_eq!(evolution.progress().generations, 3);
    }
}

/// Pulls the switch in the second generation, as Ctrl-C would.
struct Puller(StopSignal);

impl Observer<Script> for Puller {
    fn generation(&mut self, generation: &Generation<'_, Script>) -> Result<(), ObserverError> {
        if generation.report.generation == 2 {
            self.0.stop();
        }
        Ok(())
    }
}

#[test]
fn the_signal_ends_the_run_after_the_generation_under_way() {
    let signal = StopSignal::default();
    let stop = StopConditions { generations: Some(100), ..NONE };
    let mut evolution = Script::evolution(&[&[1.0]], stop).with_signal(signal.clone());
    let prompter = Prompter::of(&evolution);
    let reason = evolution.run(&Unused, &prompter, &mut [Box::new(Puller(signal))]).expect("it ends");
    assert_eq!((reason, evolution.progress().generations), (StopReason::Interrupted, 2));
}

#[test]
fn reasons_read_as_sentences() {
    assert_eq!(format!("stopped because {}", StopReason::Target), "stopped because the target fitness was reached");
    assert_eq!(serde_json::to_string(&StopReason::Interrupted).expect("plain data"), r#""interrupted""#);
}
