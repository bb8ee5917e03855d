use super::{BodyFacts, MovementDefaults};
use crate::{
    Registry,
    config::{LimbPhases, RunConfig, StageSettings},
    request::Request,
    setup::Setup,
    shaping::Stages,
};
use creatures::{Actuation, Sensor};
use ne_core::champion_selection::ReEvaluations;
use ne_fixed::{CmaEsSettings, Restart};
use tasks::Commands;

fn config(creature: &str, movement: &str) -> RunConfig {
    let creature = creatures::find(creature).expect("shipped");
    Registry::default().config("default", creature, movement).expect("there is one")
}

#[test]
fn strong_motors_have_their_torque_as_near_the_speed_asked_for_as_others() {
    let mut strong = creatures::find("biped-1").expect("shipped");
    strong.joints[1].motor = Some(creatures::Motor { top_speed: 24.0, top_torque: 16_000.0 });
    let config = Registry::default().config("default", strong, "running").expect("there is one");
    assert_eq!(config.physics.motor_gain, 12_800.0);
}

#[test]
fn limbs_leap_together_or_alternate_and_bipeds_leap_and_run_with_one_net() {
    let (alternating, together) = (Some(LimbPhases::Alternating), Some(LimbPhases::Together));
    for (creature, movement, limbs) in [
        ("biped-1", "running", None),
        ("biped-2", "running", None),
        ("biped-2", "walking", None),
        ("biped-1", "jumping", None),
        ("biped-2", "jumping", None),
        ("biped-2", "swimming", alternating),
        ("tetrapod-2", "running", alternating),
        ("tetrapod-2", "jumping", together),
        ("apod", "jumping", alternating),
    ] {
        assert_eq!(config(creature, movement).controller.modular, limbs, "{creature} {movement}");
    }
}

/// What docs/gaits.md says of them.
#[test]
fn clock_angle_law_step_size_and_bumps_are_those_of_the_movement() {
    for (creature, movement, period, gain, step_size, bumps) in [
        ("biped-1", "running", 0.39, 10.0, 0.5, true),
        ("biped-2", "backwards", 0.39, 10.0, 0.5, true),
        ("biped-1", "walking", 0.5, 10.0, 0.5, false),
        ("biped-2", "running", 0.39, 10.0, 0.5, true),
        ("tetrapod-1", "running", 0.5, 10.0, 0.5, true),
        ("decapod-1", "running", 0.42, 10.0, 0.5, true),
        ("apod", "running", 0.8, 15.0, 0.5, false),
        ("biped-1", "jumping", 1.0, 20.0, 0.2, false),
        ("decapod-1", "jumping", 0.84, 10.0, 0.2, false),
        ("tetrapod-2", "jumping", 1.0, 15.0, 0.2, false),
        ("apod", "jumping", 1.0, 15.0, 0.5, false),
    ] {
        let config = config(creature, movement);
        let name = format!("{creature} {movement}");
        assert_eq!(config.controller.hidden, [4], "{name}");
        let settings: CmaEsSettings = config.strategy.of("cma-es").expect("the default strategy");
        assert_eq!((settings.step_size, settings.starts, settings.start_generations), (step_size, 2, 80), "{name}");
        let rhythm = config.movement.terms.iter().find(|term| term.term == "rhythm").map(|term| term.weight);
        let runs = matches!(movement, "running" | "backwards") && !matches!(creature, "apod" | "decapod-1");
        assert_eq!(rhythm, runs.then_some(if creature == "biped-2" { -0.5 } else { -1.0 }), "{name}");
        let stay_small = (settings.greatest_growth, settings.mean_decay) == (1.0, 0.01);
        assert_eq!(stay_small, creature == "biped-2", "weights: {name}");
        assert_eq!((config.physics.motor_gain, config.trials.count), (200.0, 3), "{name}");
        assert!(matches!(config.controller.actuation, Actuation::Angle { gain: found } if found == gain), "{name}");
        assert_eq!(config.variation.bumps > 0.0, bumps, "{name}");
        let clock = |sensor: &Sensor| match *sensor {
            Sensor::Clock { period } | Sensor::LandingClock { period } => Some(period),
            _ => None,
        };
        let found = config.sensors.iter().flatten().find_map(clock).expect("a clock");
        assert!((found - period).abs() < 0.1, "{name}: a clock of {found} s");
    }
}

/// What docs/gaits.md says of it.
#[test]
fn two_legs_without_knees_that_jump_have_a_clock_that_begins_anew_when_they_land() {
    for (creature, movement, from_landing) in [
        ("biped-1", "jumping", true),
        ("biped-2", "jumping", false),
        ("biped-1", "running", false),
        ("tetrapod-1", "jumping", false),
        ("apod", "jumping", false),
    ] {
        let sensors = config(creature, movement).sensors.expect("the preset says which");
        let is_it = |sensor: &Sensor| matches!(sensor, Sensor::LandingClock { .. });
        assert_eq!(sensors.iter().any(is_it), from_landing, "{creature} {movement}");
    }
}

/// What docs/playing.md says of it.
#[test]
fn what_plays_is_told_what_to_do_in_five_stages_and_chosen_over_eight_schedules() {
    for creature in ["biped-1", "tetrapod-2", "apod"] {
        let config = config(creature, "playing");
        let stages: Vec<&str> = config.stages.iter().map(|stage| stage.name.as_str()).collect();
        assert_eq!(
            (stages, config.trials.count),
            (vec!["move", "follow", "jump", "polish", "harden"], 6),
            "{creature}"
        );
        let alternates = config.movement.terms.iter().any(|term| term.term == "alternation");
        assert_eq!(alternates, creature == "biped-1", "two legs take turns: {creature}");
        // Only the last has the worlds of the configuration.
        let near: Vec<bool> = config.stages.iter().map(|stage| stage.near).collect();
        assert_eq!(near, [true, true, true, true, false], "{creature}");
        assert_eq!(config.controller.hidden, [if creature == "biped-1" { 8 } else { 4 }], "{creature}");
        let settings: CmaEsSettings = config.strategy.of("cma-es").expect("the default strategy");
        assert_eq!((settings.restart, settings.starts, settings.step_size), (Restart::None, 1, 0.2));
        assert_eq!(settings.least_deviation, 0.03);
        let trials = [0, 1, 2, 3].map(|stage| config.stages[stage].changes["trials"]["count"].clone());
        assert_eq!(trials, if creature == "biped-1" { [1, 3, 6, 8] } else { [6, 6, 6, 8] }, "{creature}");
        let gives_up = [0, 1, 2, 3].map(|stage| config.stages[stage].give_up.as_ref().map(ToString::to_string));
        let expected = match creature {
            "biped-1" => [
                Some("given up at 8000000 steps and not (fitness ≥ 33), to begin anew at move, 4 times"),
                None,
                Some(
                    "given up at (4000000 steps and fitness ≥ 0 and not (fitness ≥ 20)) or (12000000 steps and not (fitness ≥ 40)), \
                     to begin anew at move, 8 times",
                ),
                Some("given up at 60000000 steps and not (tier ≥ 8), to begin anew at move, 4 times"),
            ],
            _ => [
                Some("given up at 12000000 steps and not (fitness ≥ 33.5), to begin anew at move, 5 times"),
                Some("given up at 30000000 steps and not (usable), to begin anew at move, 3 times"),
                Some("given up at 12000000 steps and not (fitness ≥ 44), to begin anew at move, 4 times"),
                Some("given up at 40000000 steps and not (usable or fitness ≥ 60), to begin anew at move, 2 times"),
            ],
        };
        let promoted = config.stages[2].promotion.as_ref().map(ToString::to_string).unwrap_or_default();
        let most = if creature == "biped-1" { "20000000 steps" } else { "14000000 steps" };
        assert!(promoted.ends_with(most), "{creature}: {promoted}");
        assert_eq!(gives_up, expected.map(|given_up| given_up.map(str::to_owned)), "{creature}");
        let speeds = match &config.commands {
            Some(Commands::Random(random)) => random.speeds,
            other => panic!("{creature}: {other:?}"),
        };
        assert_eq!(speeds, if creature == "biped-1" { [0.4, 1.2] } else { [0.5, 1.5] }, "{creature}");
        let sensors = config.sensors.iter().flatten();
        let told =
            sensors.filter(|sensor| matches!(sensor, Sensor::CommandedSpeed { .. } | Sensor::StrideClock { .. }));
        assert_eq!(told.count(), 2, "{creature}");
        let setup = Setup::new(&config, &Registry::default()).expect("valid");
        assert_eq!(setup.reference.map(|reference| reference.trials.count), Some(8), "{creature}");
    }
    let thesis = Registry::default().config("thesis", creatures::find("apod").expect("shipped"), "playing");
    assert!(thesis.expect("a preset").commands.is_some() && config("apod", "running").commands.is_none());
    let setup = Setup::new(&config("biped-1", "running"), &Registry::default()).expect("valid");
    assert_eq!(setup.reference.map(|reference| reference.trials.count), Some(1));
}

/// What docs/playing.md says of it.
#[test]
fn two_legs_with_knees_have_more_time_to_jump_and_of_others_a_jump_counts_more_in_the_end() {
    for (creature, clocks) in
        [("biped-1", [0.6, 0.9]), ("biped-2", [0.7, 1.2]), ("tetrapod-2", [0.6, 0.9]), ("decapod-1", [0.6, 0.9])]
    {
        let stages = config(creature, "playing").stages;
        let [jump, polish] = ["jump", "polish"].map(|name| stages.iter().find(|stage| stage.name == name));
        let (jump, polish) = (jump.expect("a stage"), polish.expect("a stage"));
        let expected = clocks.map(|period| Sensor::JumpClock { period });
        assert_eq!(jump.add_sensors, expected, "{creature}");
        let worth = |stage: &StageSettings| stage.changes["movement"]["settings"]["jump"].as_f64();
        let polished = if creature.starts_with("biped") { 4.0 } else { 10.0 };
        assert_eq!([jump, polish].map(worth), [Some(4.0), Some(polished)], "{creature}");
    }
}

/// A movement of another crate gets what its crate says, and a controller if it says nothing.
#[test]
fn any_crate_can_say_what_the_default_preset_adds_for_a_movement() {
    let mut registry = Registry::default();
    let creature = || creatures::find("biped-2").expect("shipped");
    let bare = registry.config("default", creature(), "high-kick").expect("a preset");
    assert_eq!((bare.movement.terms.len(), bare.controller.modular), (0, Some(LimbPhases::Alternating)));
    registry.defaults.add("high-kick", |body: &BodyFacts| MovementDefaults {
        steps: Some(100),
        period: body.pendulum(1.0),
        modular: None,
        ..MovementDefaults::unknown(body)
    });
    let config = registry.config("default", creature(), "high-kick").expect("a preset");
    assert_eq!((config.movement.steps, config.controller.modular), (Some(100), None));
    assert_eq!(
        registry.config("defualt", creature(), "running").expect_err("none").to_string(),
        "there is no preset \"defualt\"; did you mean \"default\"? (there are: default, thesis, stanley-2002, plain, shaped)"
    );
}

/// A run with stages is not to end in the middle of them.
#[test]
fn playing_ends_after_steps_and_not_after_generations() {
    for (creature, movement, generations, steps) in [
        ("tetrapod-1", "playing", None, Some(350_000_000)),
        ("biped-2", "playing", None, Some(650_000_000)),
        ("biped-2", "running", Some(300), None),
    ] {
        let stop = config(creature, movement).stop;
        assert_eq!((stop.generations, stop.steps), (generations, steps), "{creature} {movement}");
    }
}

/// A candidate for the champion of `playing` is told what to do in eight whole schedules.
#[test]
fn re_evaluations_are_rarer_where_each_takes_long() {
    let registry = Registry::default();
    let every = |config: &RunConfig| {
        let ReEvaluations { every, group, candidates } =
            Setup::new(config, &registry).expect("valid").re_evaluations(config);
        assert_eq!((every, candidates), (10 * group, 22));
        every
    };
    for creature in creatures::shipped() {
        for movement in ["running", "jumping"] {
            assert_eq!(every(&config(creature.name, movement)), 10, "{} {movement}", creature.name);
        }
    }
    let of_stages = |creature| {
        let stages = Stages::new(&config(creature, "playing"), &registry).expect("valid");
        let goals: Vec<bool> = (0..5).map(|stage| stages.is_goal(stage)).collect();
        assert_eq!(goals, [false, false, false, true, true], "a run until usable ends in one of the last two");
        stages.configs().map(|(_, stage)| every(stage)).collect::<Vec<_>>()
    };
    assert_eq!(of_stages("biped-2"), [110, 40, 20, 20, 20]);
    assert_eq!(of_stages("tetrapod-1"), [20, 20, 20, 20, 20]);
}

/// The period of the stride that is asked for, s.
fn stride(set: &[&str]) -> Option<f64> {
    let request = Request {
        creature: Some("tetrapod-1".into()),
        movement: Some("running".into()),
        set: set.iter().map(|&set| set.to_owned()).collect(),
        ..Request::default()
    };
    let config = request.resolve(&Registry::default()).expect("valid");
    config.movement.terms.iter().find(|term| term.term == "rhythm")?.settings["period"].as_f64()
}

/// Otherwise a body that hears a slower clock is charged for each of its strides, and learns to stand still.
#[test]
fn the_stride_that_is_asked_for_takes_as_long_as_the_clock_that_is_heard() {
    let clock = r#"sensors=["torso-rotation","joint-angles",{"clock":{"period":0.8}}]"#;
    let own = r#"movement.terms=[{"term":"rhythm","weight":-1,"settings":{"period":0.7}}]"#;
    assert_eq!(stride(&[]), Some(0.46));
    assert_eq!(stride(&[clock]), Some(0.8));
    assert_eq!(stride(&[clock, own]), Some(0.7), "what was chosen stays");
    assert_eq!(stride(&[r#"sensors=["torso-rotation","joint-angles"]"#]), Some(0.46), "there is no clock");
}

/// It would hold a body below the speed that it is told.
#[test]
fn cruising_is_a_run_without_haste() {
    let terms = |movement| config("tetrapod-1", movement).movement.terms;
    let mut running = terms("running");
    running.retain(|term| term.term != "haste");
    assert_eq!(terms("cruising"), running);
    assert!(running.len() < terms("running").len());
}
