//! What is said of settings out of range, and how files name selectors.
#![cfg(feature = "evolution")]

use ne_core::{RankSelector, Roulette, Selection, SettingError, StopConditions, Tournament, Truncation};

#[test]
fn setting_errors_name_field_value_and_range() {
    let message = |result: Result<(), SettingError>| result.expect_err("out of range").to_string();
    assert_eq!(message(RankSelector { pressure: 2.5 }.validate()), "pressure = 2.5: must be from 1 to 2");
    assert_eq!(message(RankSelector { pressure: f64::NAN }.validate()), "pressure = NaN: must be from 1 to 2");
    assert_eq!(message(Tournament { size: 0 }.validate()), "size = 0: must be from 1 to 1000");
    assert_eq!(message(Truncation { share: 0.0 }.validate()), "share = 0: must be above 0 and at most 1");
    assert_eq!(message(Truncation { share: f64::NAN }.validate()), "share = NaN: must be above 0 and at most 1");
    let selection = Selection::Tournament(Tournament { size: 0 });
    assert_eq!(message(selection.validate()), "tournament.size = 0: must be from 1 to 1000");
    let deep = selection.validate().map_err(|error| error.within("selection").within("strategy"));
    assert_eq!(message(deep), "strategy.selection.tournament.size = 0: must be from 1 to 1000");
    assert_eq!(message(SettingError::check_range("rate", 2.0, 0.0, 1.0)), "rate = 2: must be from 0 to 1");
    assert_eq!(message(SettingError::check_range("x", -1.0, 0.0, f64::INFINITY)), "x = -1: must be at least 0");
    assert_eq!(
        message(SettingError::check_range("x", f64::INFINITY, 0.0, f64::INFINITY)),
        "x = inf: must be finite and at least 0"
    );
}

#[test]
fn stop_conditions_name_the_field() {
    let message = |stop: StopConditions| stop.validate().expect_err("out of range").to_string();
    let none = StopConditions::default();
    assert_eq!(message(StopConditions { generations: Some(0), ..none }), "generations = 0: must be at least 1");
    assert_eq!(message(StopConditions { evaluations: Some(0), ..none }), "evaluations = 0: must be at least 1");
    assert_eq!(message(StopConditions { steps: Some(0), ..none }), "steps = 0: must be at least 1");
    assert_eq!(message(StopConditions { stagnation: Some(0), ..none }), "stagnation = 0: must be at least 1");
    assert_eq!(message(StopConditions { tier: Some(0), ..none }), "tier = 0: must be at least 1");
    assert_eq!(message(StopConditions { minutes: Some(0.0), ..none }), "minutes = 0: must be a finite number above 0");
    assert_eq!(
        message(StopConditions { minutes: Some(f64::INFINITY), ..none }),
        "minutes = inf: must be a finite number above 0"
    );
    assert_eq!(message(StopConditions { target: Some(f64::NAN), ..none }), "target = NaN: must be a finite number");
    let never = "generations = none: must be a number, as there is no other limit and the run would never end";
    assert_eq!(message(none), never);
    assert_eq!(StopConditions { target: Some(-1.0), ..none }.validate(), Ok(()));
}

#[test]
fn a_selection_is_written_as_its_name_with_its_settings() -> Result<(), serde_json::Error> {
    let written = |selection: Selection| serde_json::to_string(&selection);
    assert_eq!(written(Selection::Roulette(Roulette {}))?, r#"{"roulette":{}}"#);
    assert_eq!(written(Selection::Tournament(Tournament { size: 4 }))?, r#"{"tournament":{"size":4}}"#);
    let read: Selection = serde_json::from_str(r#"{"stochastic-universal": {}}"#)?;
    assert_eq!(written(read)?, r#"{"stochastic-universal":{}}"#);
    let default: Selection = serde_json::from_str(r#"{"truncation": {}}"#)?;
    assert_eq!(default, Selection::Truncation(Truncation::default()));
    let unknown = serde_json::from_str::<Selection>(r#"{"tournament": {"sise": 4}}"#).expect_err("a typing error");
    assert!(unknown.to_string().contains("unknown field `sise`, expected `size`"), "{unknown}");
    Ok(())
}

#[test]
fn a_run_that_goes_on_has_the_newer_budget_alone() {
    let none = StopConditions::default();
    let planned = StopConditions {
        generations: Some(9),
        minutes: Some(0.5),
        target: Some(3.0),
        tier: Some(1),
        stagnation: Some(50),
        ..none
    };
    assert_eq!(planned.resumed_with(none), planned);
    let kept = StopConditions { target: Some(3.0), stagnation: Some(50), ..none };
    for newer in [
        StopConditions { generations: Some(20), ..none },
        StopConditions { evaluations: Some(20), ..none },
        StopConditions { steps: Some(20), ..none },
        StopConditions { minutes: Some(2.0), ..none },
    ] {
        assert_eq!(planned.resumed_with(newer), kept.overlaid(newer));
    }
    let higher = StopConditions { target: Some(5.0), ..none };
    assert_eq!(planned.resumed_with(higher), StopConditions { target: Some(5.0), tier: None, ..planned });
}
