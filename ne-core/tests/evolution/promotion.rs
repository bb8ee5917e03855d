use crate::{
    TASK,
    common::Climber,
    evolution,
    scripted::{Prompter, Script, Unused},
};
use ne_core::{
    Checkpoint, Evaluation, Evolution, Failure, GenerationReport, Progress, Serial, StopConditions, StopReason,
    TieredFitness,
    promotion::{Decision, MeasurementBound, PopulationShare, Promotion, PromotionRule, StageState},
};

/// Four individuals, one of which failed, in generation 7 of a stage.
fn is_met(rule: &PromotionRule) -> bool {
    let measured = |fitness: f64, duration: f64| {
        let mut evaluation = Evaluation::new(fitness).with_steps(10);
        evaluation.measurements.insert("duration", duration);
        evaluation
    };
    let failed = Evaluation::failed(Failure::Unstable { what: "speed".into() });
    let evaluations = [measured(1.0, 2.0), measured(2.0, 4.0), measured(3.0, 6.0), failed];
    let report: GenerationReport = serde_json::from_str(
        r#"{"generation": 7, "evaluations": 28, "steps": 280, "best_so_far": 3.5, "fitness": null, "failures": 1,
            "population": 4, "strategy": []}"#,
    )
    .expect("a report");
    let fitness = Evaluation::new(3.5).fitness().expect("a fitness");
    let progress = Progress { generations: 7, evaluations: 28, steps: 280, stagnation: 3 };
    let champion = Some(TieredFitness { tier: 1, fitness });
    let moment = StageState { report: &report, evaluations: &evaluations, champion, progress };
    let without = StageState { champion: None, evaluations: &[], ..moment };
    let needs_a_champion = matches!(
        rule,
        PromotionRule::Fitness(_) | PromotionRule::Usable | PromotionRule::Tier(_) | PromotionRule::Measurement(_)
    );
    assert!(!needs_a_champion || !rule.is_met(&without), "{rule} without a champion");
    let decided = rule.decide(&moment);
    assert_eq!(decided == Decision::Promote, rule.is_met(&moment), "{rule}");
    rule.is_met(&moment)
}

#[test]
fn a_rule_is_met_at_its_bound_and_not_before() {
    let share = |fitness, of| PromotionRule::Share(PopulationShare { fitness, of });
    let mean =
        |at_least, at_most| PromotionRule::Measurement(MeasurementBound { name: "duration".into(), at_least, at_most });
    let pairs = [
        (PromotionRule::Fitness(3.5), PromotionRule::Fitness(3.6)),
        (PromotionRule::Tier(1), PromotionRule::Tier(2)),
        // A failure is one of the four.
        (share(2.0, 0.5), share(2.0, 0.51)),
        (share(1.0, 0.75), share(1.0, 1.0)),
        (mean(Some(4.0), None), mean(Some(4.1), None)),
        (mean(None, Some(4.0)), mean(None, Some(3.9))),
        (PromotionRule::Stagnation(3), PromotionRule::Stagnation(4)),
        (PromotionRule::Generations(7), PromotionRule::Generations(8)),
        (PromotionRule::Evaluations(28), PromotionRule::Evaluations(29)),
        (PromotionRule::Steps(280), PromotionRule::Steps(281)),
    ];
    for (met, not_met) in &pairs {
        assert_eq!((is_met(met), is_met(not_met)), (true, false), "{met}, {not_met}");
        let both = vec![met.clone(), not_met.clone()];
        assert_eq!((is_met(&PromotionRule::Any(both.clone())), is_met(&PromotionRule::All(both))), (true, false));
        let not = |rule: &PromotionRule| PromotionRule::Not(Box::new(rule.clone()));
        assert_eq!((is_met(&not(met)), is_met(&not(not_met))), (false, true), "{met}, {not_met}");
        for rule in [met, not_met, &not(met)] {
            let text = serde_json::to_string(rule).expect("plain data");
            assert_eq!(&serde_json::from_str::<PromotionRule>(&text).expect("what was written"), rule, "{text}");
            assert_eq!(rule.validate(), Ok(()));
        }
    }
    assert!(is_met(&PromotionRule::Usable));
    let other = MeasurementBound { name: "height".into(), at_least: Some(-1e9), at_most: None };
    assert!(!is_met(&PromotionRule::Measurement(other)), "it was not measured");
}

#[test]
fn rules_are_told_in_words() {
    let rules =
        vec![PromotionRule::Usable, PromotionRule::Any(vec![PromotionRule::Fitness(20.0), PromotionRule::Steps(9)])];
    assert_eq!(PromotionRule::All(rules).to_string(), "usable and (fitness ≥ 20 or 9 steps)");
    assert_eq!(PromotionRule::Tier(8).to_string(), "tier ≥ 8");
    let not = PromotionRule::Not(Box::new(PromotionRule::Fitness(20.0)));
    assert_eq!(not.to_string(), "not (fitness ≥ 20)");
    assert_eq!(serde_json::to_string(&not).expect("plain data"), r#"{"not":{"fitness":20.0}}"#);
}

#[test]
fn the_highest_tier_that_is_asked_for_is_known() {
    let not_8 = PromotionRule::Not(Box::new(PromotionRule::Tier(8)));
    let rules = PromotionRule::All(vec![PromotionRule::Usable, PromotionRule::Steps(9), not_8, PromotionRule::Tier(3)]);
    assert_eq!(rules.highest_tier(), Some((&PromotionRule::Tier(8), 8)));
    assert_eq!(PromotionRule::Any(vec![PromotionRule::Usable]).highest_tier(), Some((&PromotionRule::Usable, 1)));
    assert_eq!(PromotionRule::Fitness(20.0).highest_tier(), None);
    let limited = rules.with_tiers_up_to(2).to_string();
    assert_eq!(limited, "usable and 9 steps and not (tier ≥ 2) and tier ≥ 2");
}

#[test]
fn a_decision_ends_the_run_before_its_limits_and_is_in_the_checkpoint() -> Result<(), Box<dyn std::error::Error>> {
    let stop = StopConditions { generations: Some(9), ..Default::default() };
    let mut rising =
        Script::evolution(&[&[1.0; 4], &[2.0; 4], &[3.0; 4]], stop).with_promotion(PromotionRule::Fitness(2.0));
    let prompter = Prompter::of(&rising);
    assert_eq!(rising.run(&Unused, &prompter, &mut [])?, StopReason::Promoted);
    assert_eq!((rising.progress().generations, rising.decision()), (2, Decision::Promote));

    let mut first = evolution(9).with_promotion(PromotionRule::Generations(3));
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
        fn decide(&self, moment: &StageState<'_>) -> Decision {
            if moment.report.generation == 2 { Decision::Demote } else { Decision::Stay }
        }
    }
    let mut run = evolution(9).with_promotion(Back);
    assert_eq!(run.run(&TASK, &Serial, &mut [])?, StopReason::Demoted);
    assert_eq!(run.progress().generations, 2);
    Ok(())
}

#[test]
fn giving_up_ends_the_run_too() -> Result<(), Box<dyn std::error::Error>> {
    struct GivesUp;
    impl Promotion for GivesUp {
        fn decide(&self, _: &StageState<'_>) -> Decision {
            Decision::GiveUp
        }
    }
    let mut run = evolution(9).with_promotion(GivesUp);
    let reason = run.run(&TASK, &Serial, &mut [])?;
    assert_eq!((reason, run.progress().generations), (StopReason::GivenUp, 1));
    assert_eq!(reason.to_string(), "the population was given up, and another begins anew");
    Ok(())
}

#[test]
fn a_rule_that_contradicts_itself_is_known() -> Result<(), serde_json::Error> {
    for (can, rule) in [
        (true, r#"{ "generations": 5 }"#),
        (true, r#"{ "not": { "generations": 2 } }"#),
        (false, r#"{ "not": { "generations": 1 } }"#),
        (false, r#"{ "all": [{ "generations": 5 }, { "not": { "generations": 5 } }] }"#),
        (true, r#"{ "all": [{ "generations": 5 }, { "not": { "generations": 6 } }] }"#),
        (true, r#"{ "any": [{ "not": { "generations": 1 } }, "usable"] }"#),
        (false, r#"{ "all": [{ "not": { "generations": 1 } }, "usable"] }"#),
        (false, r#"{ "not": { "any": [{ "generations": 1 }, "usable"] } }"#),
        (true, r#"{ "not": { "all": [{ "generations": 1 }, "usable"] } }"#),
        (true, r#"{ "all": [{ "steps": 5 }, { "not": { "fitness": 5 } }] }"#),
    ] {
        assert_eq!(serde_json::from_str::<PromotionRule>(rule)?.can_be_met(), can, "{rule}");
    }
    Ok(())
}
