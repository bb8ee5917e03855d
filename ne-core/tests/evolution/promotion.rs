use crate::{
    TASK,
    common::Climber,
    evolution,
    scripted::{Prompter, Script, Unused},
};
use ne_core::{
    Checkpoint, Decision, Evaluation, Evolution, Failure, GenerationReport, Moment, PopulationShare, Progress,
    Promotion, Reached, Rule, Serial, Standing, StopConditions, StopReason,
};

/// Four individuals, one of which failed, in generation 7 of a stage.
fn is_met(rule: &Rule) -> bool {
    let measured = |fitness: f64, duration: f64| {
        let mut evaluation = Evaluation::new(fitness).with_steps(10);
        evaluation.measurements.insert("duration".into(), duration);
        evaluation
    };
    let failed = Evaluation::failed(Failure::TimedOut { steps: 10 });
    let evaluations = [measured(1.0, 2.0), measured(2.0, 4.0), measured(3.0, 6.0), failed];
    let report: GenerationReport = serde_json::from_str(
        r#"{"generation": 7, "evaluations": 28, "steps": 280, "best_so_far": 3.5, "fitness": null, "failures": 1,
            "population": 4, "strategy": []}"#,
    )
    .expect("a report");
    let fitness = Evaluation::new(3.5).fitness().expect("a fitness");
    let progress = Progress { generations: 7, evaluations: 28, steps: 280, stagnation: 3 };
    let champion = Some(Standing { tier: 1, fitness });
    let moment = Moment { report: &report, evaluations: &evaluations, champion, progress };
    let nobody = Moment { champion: None, evaluations: &[], ..moment };
    let needs_somebody = matches!(rule, Rule::Fitness(_) | Rule::Usable | Rule::Measurement(_));
    assert!(!needs_somebody || !rule.is_met(&nobody), "{rule} with nobody");
    let decided = rule.decide(&moment);
    assert_eq!(decided == Decision::Promote, rule.is_met(&moment), "{rule}");
    rule.is_met(&moment)
}

#[test]
fn a_rule_is_met_at_its_bound_and_not_before() {
    let share = |fitness, of| Rule::Share(PopulationShare { fitness, of });
    let mean = |at_least, at_most| Rule::Measurement(Reached { name: "duration".into(), at_least, at_most });
    let pairs = [
        (Rule::Fitness(3.5), Rule::Fitness(3.6)),
        // A failure is one of the four.
        (share(2.0, 0.5), share(2.0, 0.51)),
        (share(1.0, 0.75), share(1.0, 1.0)),
        (mean(Some(4.0), None), mean(Some(4.1), None)),
        (mean(None, Some(4.0)), mean(None, Some(3.9))),
        (Rule::Stagnation(3), Rule::Stagnation(4)),
        (Rule::Generations(7), Rule::Generations(8)),
        (Rule::Evaluations(28), Rule::Evaluations(29)),
        (Rule::Steps(280), Rule::Steps(281)),
    ];
    for (met, not_met) in &pairs {
        assert_eq!((is_met(met), is_met(not_met)), (true, false), "{met}, {not_met}");
        let both = vec![met.clone(), not_met.clone()];
        assert_eq!((is_met(&Rule::Any(both.clone())), is_met(&Rule::All(both))), (true, false));
        for rule in [met, not_met] {
            let text = serde_json::to_string(rule).expect("plain data");
            assert_eq!(&serde_json::from_str::<Rule>(&text).expect("what was written"), rule, "{text}");
            assert_eq!(rule.validate(), Ok(()));
        }
    }
    assert!(is_met(&Rule::Usable));
    let other = Reached { name: "height".into(), at_least: Some(-1e9), at_most: None };
    assert!(!is_met(&Rule::Measurement(other)), "nobody was measured so");
}

#[test]
fn rules_are_told_in_words() {
    let rules = vec![Rule::Usable, Rule::Any(vec![Rule::Fitness(20.0), Rule::Steps(9)])];
    assert_eq!(Rule::All(rules).to_string(), "usable and (fitness ≥ 20 or 9 steps)");
}

#[test]
fn a_decision_ends_the_run_before_its_limits_and_is_in_the_checkpoint() -> Result<(), Box<dyn std::error::Error>> {
    let stop = StopConditions { generations: Some(9), ..Default::default() };
    let mut rising = Script::evolution(&[&[1.0; 4], &[2.0; 4], &[3.0; 4]], stop).with_promotion(Rule::Fitness(2.0));
    let prompter = Prompter::of(&rising);
    assert_eq!(rising.run(&Unused, &prompter, &mut [])?, StopReason::Promoted);
    assert_eq!((rising.progress().generations, rising.decision()), (2, Decision::Promote));

    let mut first = evolution(9).with_promotion(Rule::Generations(3));
    assert_eq!(first.run(&TASK, &Serial, &mut [])?, StopReason::Promoted);
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("checkpoint");
    first.write_checkpoint(&path)?;
    let checkpoint = Checkpoint::<Climber>::read(&path)?;
    assert_eq!(checkpoint.decision, Decision::Promote);
    // Resumed, with the promotion or without, it has ended where it ended.
    let mut second = Evolution::resume(checkpoint, stop);
    assert_eq!(second.run(&TASK, &Serial, &mut [])?, StopReason::Promoted);
    assert_eq!(second.progress().generations, 3);
    Ok(())
}

#[test]
fn a_demotion_ends_the_run_too() -> Result<(), Box<dyn std::error::Error>> {
    struct Back;
    impl Promotion for Back {
        fn decide(&self, moment: &Moment<'_>) -> Decision {
            if moment.report.generation == 2 { Decision::Demote } else { Decision::Stay }
        }
    }
    let mut run = evolution(9).with_promotion(Back);
    assert_eq!(run.run(&TASK, &Serial, &mut [])?, StopReason::Demoted);
    assert_eq!(run.progress().generations, 2);
    Ok(())
}
