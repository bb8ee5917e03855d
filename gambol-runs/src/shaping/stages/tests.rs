//! Which stage comes next, what it changes, and what is wrong with one.

use super::super::{tests::config, *};
use crate::Registry;
use crate::{
    config::{Origin, RunConfig, Transferred},
    training::{Resources, TrainError},
};
use creatures::Sensor;
use envs_rapier::Variation;
use ne_core::{EvolutionError, Progress, StopConditions, StopReason, StopSignal, promotion::Decision};
use serde_json::json;

fn stages(stages: serde_json::Value) -> Result<Stages, String> {
    let mut config = config("biped-1");
    config.stages = serde_json::from_value(stages).map_err(|error| error.to_string())?;
    Stages::new(&config, &Registry::default()).map_err(|error| error.to_string())
}

#[test]
fn a_stage_changes_what_it_names_and_keeps_the_rest() {
    let stages = stages(json!([
        { "name": "run", "promotion": { "generations": 3 }, "changes": { "controller": { "hidden": [3] } } },
        { "name": "look", "promotion": "usable", "add_sensors": ["joint-speeds"] },
        { "name": "jump", "changes": { "movement": { "name": "jumping" } } }
    ]))
    .expect("valid");
    let configs: Vec<&RunConfig> = stages.configs().map(|(_, config)| config).collect();
    let plain = config("biped-1");
    assert!(configs.iter().all(|config| config.controller.hidden == [3] && config.stages.is_empty()));
    assert_eq!(configs[0].sensors, plain.sensors);
    let mut more = plain.sensors.clone().expect("named");
    more.push(Sensor::JointSpeeds);
    assert_eq!((&configs[1].sensors, &configs[2].sensors), (&Some(more.clone()), &Some(more)));
    assert_eq!((&configs[1].movement, configs[1].training_steps), (&plain.movement, plain.training_steps));
    // What the preset knows of another movement comes with its name.
    let jumping = Registry::default().config("default", plain.creature.clone(), "jumping").expect("a preset");
    assert_eq!((&configs[2].movement, configs[2].training_steps), (&jumping.movement, jumping.training_steps));
}

/// And of a configuration without variation, none.
#[test]
fn a_stage_may_have_near_worlds_and_the_next_has_those_of_the_configuration() {
    let list = json!([
        { "name": "calm", "near": true, "promotion": { "generations": 1 } },
        { "name": "still-calm", "near": true, "changes": { "variation": { "friction": 0.2 } }, "promotion": { "generations": 1 } },
        { "name": "wild" }
    ]);
    let variations = |variation: Variation| -> Vec<Variation> {
        let settings = serde_json::from_value(list.clone()).expect("stages");
        let config = RunConfig { stages: settings, variation, ..config("tetrapod-1") };
        let stages = Stages::new(&config, &Registry::default()).expect("valid");
        stages.configs().map(|(_, config)| config.variation).collect()
    };
    let wild = Variation { friction: 0.2, ..Variation::light() };
    assert_eq!(variations(Variation::light()), [Variation::near(), Variation::near(), wild]);
    let none = Variation { friction: 0.2, ..Variation::default() };
    assert_eq!(variations(Variation::default()), [Variation::default(), Variation::near(), none]);
}

#[test]
fn water_comes_with_swimming_and_goes_with_it() {
    let stages = stages(json!([
        { "name": "run", "promotion": { "generations": 3 } },
        { "name": "swim", "promotion": { "generations": 3 }, "changes": { "movement": { "name": "swimming" } } },
        { "name": "jump", "promotion": { "generations": 3 }, "changes": { "movement": { "name": "jumping" } } },
        {
            "name": "dive",
            "changes": { "movement": { "name": "swimming" }, "physics": { "water": { "density": 1.5 } } }
        }
    ]))
    .expect("valid");
    let given: Vec<_> = stages.configs().map(|(_, config)| (config.physics, config.engine)).collect();
    let plain = config("biped-1");
    let swimming = Registry::default().config("default", plain.creature.clone(), "swimming").expect("a preset");
    assert!(swimming.physics.water.is_some() && swimming.engine != plain.engine);
    let (dry, wet) = ((plain.physics, plain.engine), (swimming.physics, swimming.engine));
    assert_eq!(given[..3], [dry, wet, dry]);
    let dense = given[3].0.water.expect("it dives");
    assert_eq!((dense.density, given[3].1), (Some(1.5), swimming.engine));
}

#[test]
fn objectives_stay_with_another_movement() {
    let mut config = config("biped-1");
    config.movement.objectives = vec![tasks::TermSpec::new("running", 1.0), tasks::TermSpec::new("energy", -1.0)];
    let stages = json!([
        { "name": "run", "promotion": { "generations": 3 } },
        { "name": "cruise", "changes": { "movement": { "name": "cruising" } } }
    ]);
    config.stages = serde_json::from_value(stages).expect("stages");
    let stages = Stages::new(&config, &Registry::default()).expect("valid");
    let last = stages.configs().last().expect("two").1;
    assert_eq!((&*last.movement.name, &last.movement.objectives), ("cruising", &config.movement.objectives));
}

#[test]
fn a_stage_has_a_creature_of_its_own_as_a_whole() {
    let worm = creatures::find("apod").expect("shipped");
    let stages = stages(json!([
        { "name": "run", "promotion": { "generations": 3 } },
        { "name": "worm", "promotion": { "generations": 3 }, "allow_loss": true, "transfer": "nothing", "changes": {
            "creature": worm, "movement": { "name": "backwards" }, "sensors": ["joint-angles"]
        } },
        { "name": "biped", "transfer": "nothing", "changes": { "creature": creatures::find("biped-1").expect("shipped") } }
    ]))
    .expect("valid");
    let configs: Vec<&RunConfig> = stages.configs().map(|(_, config)| config).collect();
    assert_eq!((&configs[1].creature, &configs[2].creature), (&worm, &config("biped-1").creature));
    // The creature without legs gets the coaching for a body without legs.
    let coached = Registry::default().config("default", worm, "backwards").expect("a preset").movement;
    assert_ne!(
        coached,
        Registry::default().config("default", configs[0].creature.clone(), "backwards").expect("a preset").movement
    );
    assert_eq!(configs[1].movement, coached);
    // Nothing of the movement is new where it is the same.
    assert_eq!(configs[2].movement, coached);
}

#[test]
fn errors_of_a_leg_are_told_of_the_run() {
    let run = crate::run_folder::RunFolder::at(std::path::Path::new("runs/all"));
    let leg = crate::run_folder::RunFolder::at(std::path::Path::new("runs/all/stages/02-feel"));
    let used = Progress { generations: 14, ..Progress::default() };
    let told = |error: TrainError| stage_progress::of_the_run(error.into(), &run, used).to_string();
    let over = TrainError::Over { folder: leg.clone(), reason: StopReason::Generations, generations: 6 };
    let message = told(over);
    assert!(message.starts_with("the run in runs/all has ended: "), "{message}");
    assert!(message.ends_with(" (generation 20); to go on, say --generations 120"), "{message}");
    let source = EvolutionError::EmptyPopulation { strategy: "cma-es".into(), generation: 3 };
    let message = told(TrainError::BrokeOff { folder: leg, generation: 2, source });
    assert!(message.contains("\nthe run stopped in generation 16; "), "{message}");
    // Any other is what it was.
    assert_eq!(told(TrainError::Stages), TrainError::Stages.to_string());
}

/// A planned stage, once it has ended so, with a champion of this fitness.
fn ended(number: usize, planned: PlannedStage, decision: Decision, fitness: f64) -> StageRun {
    let fitness = ne_core::Fitness::new(fitness).expect("finite");
    StageRun {
        number,
        stage: planned.stage,
        name: planned.name,
        folder: std::path::PathBuf::new(),
        decision,
        progress: Progress::default(),
        champion: Some(ne_core::TieredFitness { tier: 0, fitness }),
    }
}

#[test]
fn stages_follow_each_other_as_populations_are_promoted_and_demoted() {
    let stages = stages(json!([
        { "name": "a", "promotion": { "generations": 3 } },
        { "name": "b", "promotion": { "fitness": 3 }, "demotion": { "generations": 9 } },
        { "name": "c", "promotion": { "generations": 1 } }
    ]))
    .expect("valid");
    let mut legs: Vec<StageRun> = Vec::new();
    use Decision::{Demote, Promote};
    for (name, decision) in [("a", Promote), ("b", Demote), ("a", Promote), ("b", Promote), ("c", Promote)] {
        let planned = stages.next(&legs).expect("a stage");
        assert_eq!(planned.name, name);
        // Only a population that goes back may give something up.
        let went_back = legs.last().is_some_and(|leg| leg.decision == Demote);
        assert_eq!(planned.allow_loss, went_back);
        legs.push(ended(legs.len() + 1, planned, decision, 1.0));
    }
    assert!(stages.next(&legs).is_none());
}

/// That is the last stage, and those before it that differ in nothing but when they are passed, and in how much worlds vary. A stage that is
/// passed at the same moment is not followed by another.
#[test]
fn what_a_run_is_to_reach_ends_it_in_a_stage_that_learns_what_the_run_is_for() {
    let mut config = config("biped-1");
    (config.variation, config.training_steps, config.movement.steps) = (Variation::default(), None, Some(20));
    let ends = |generations: u64, changes: [serde_json::Value; 2]| {
        let promotion = json!({ "generations": generations });
        let list = json!([
            { "name": "a", "near": true, "promotion": promotion },
            { "name": "b", "near": true, "promotion": promotion, "changes": changes[0] },
            { "name": "c", "promotion": promotion, "changes": changes[1] }
        ]);
        let stages = serde_json::from_value(list).expect("stages");
        let stop = StopConditions { target: Some(-1e9), generations: Some(9), ..StopConditions::default() };
        let config = RunConfig { stages, stop, ..config.clone() };
        let folder = tempfile::tempdir().expect("a folder");
        let resources = Resources { threads: 1, registry: Registry::default(), signal: StopSignal::default() };
        let run = StagedTraining::begin(&config, &folder.path().join("run"), resources).expect("valid");
        let mut names = Vec::new();
        let mut on_stage_run = |stage: &PlannedStage, _: Option<&Origin>| names.push(stage.name.clone());
        let outcome = run.run(StageProgress { on_stage_run: &mut on_stage_run }, &mut |_| {}).expect("it runs");
        (outcome.reason, outcome.progress.generations, names.concat())
    };
    let (same, gaps) = (json!({}), json!({ "terrain": "gaps" }));
    for generations in [1, 3] {
        let ends = |changes| ends(generations, changes);
        assert_eq!(ends([same.clone(), same.clone()]), (StopReason::Target, 1, "a".into()));
        assert_eq!(ends([gaps.clone(), same.clone()]), (StopReason::Target, generations + 1, "ab".into()));
        assert_eq!(ends([same.clone(), gaps.clone()]), (StopReason::Target, 2 * generations + 1, "abc".into()));
    }
}

#[test]
fn a_stage_is_given_up_so_often_and_then_the_best_attempt_goes_on() {
    use Decision::{GiveUp, Promote};
    let give_up = json!({ "when": { "generations": 1 }, "back_to": "b", "times": 2 });
    let stages = stages(json!([
        { "name": "a", "promotion": { "generations": 3 } },
        { "name": "b", "promotion": { "generations": 3 } },
        { "name": "c", "promotion": { "generations": 3 }, "give_up": give_up },
        { "name": "d" }
    ]))
    .expect("valid");
    let mut legs: Vec<StageRun> = Vec::new();
    let way = [
        ("a", Beginning::Nothing, Promote, 1.0),
        ("b", Beginning::After(1), Promote, 1.0),
        ("c", Beginning::After(2), GiveUp, 5.0),
        ("b", Beginning::After(1), Promote, 2.0),
        ("c", Beginning::After(4), GiveUp, 7.0),
        ("b", Beginning::After(1), Promote, 9.0),
        ("c", Beginning::After(6), GiveUp, 6.0),
        ("c", Beginning::After(5), Promote, 6.5),
    ];
    for (name, begins, decision, fitness) in way {
        let planned = stages.next(&legs).expect("a stage");
        assert_eq!((planned.name.as_str(), planned.begins), (name, begins));
        // All attempts are over: the search of the best goes on.
        let is_taken_up = legs.len() == 7;
        assert_eq!(planned.transfer == Some(Transferred::Population), is_taken_up);
        legs.push(ended(legs.len() + 1, planned, decision, fitness));
    }
    assert_eq!(stages.next(&legs).map(|planned| planned.begins), Some(Beginning::After(5)));
}

/// A later stage that is given up, too, does not go on from an attempt of before.
#[test]
fn attempts_are_counted_anew_once_a_later_stage_was_visited() {
    use Decision::{GiveUp, Promote};
    let give_up = |times: u32| json!({ "when": { "generations": 1 }, "back_to": "a", "times": times });
    let stages = stages(json!([
        { "name": "a", "promotion": { "generations": 3 } },
        { "name": "b", "promotion": { "generations": 3 }, "give_up": give_up(1) },
        { "name": "c", "give_up": give_up(1) }
    ]))
    .expect("valid");
    let mut legs: Vec<StageRun> = Vec::new();
    let way = [
        ("a", Beginning::Nothing, Promote, 1.0),
        ("b", Beginning::After(1), GiveUp, 9.0),
        ("a", Beginning::Nothing, Promote, 1.0),
        ("b", Beginning::After(3), Promote, 5.0),
        // The best of two attempts at b.
        ("c", Beginning::After(2), GiveUp, 2.0),
        ("a", Beginning::Nothing, Promote, 1.0),
        ("b", Beginning::After(6), GiveUp, 3.0),
        ("a", Beginning::Nothing, Promote, 1.0),
        ("b", Beginning::After(8), GiveUp, 4.0),
        ("b", Beginning::After(9), Promote, 4.5),
        // Not of that of before, from which c was given up.
        ("c", Beginning::After(10), GiveUp, 1.0),
        ("c", Beginning::After(5), Promote, 3.0),
    ];
    for (name, begins, decision, fitness) in way {
        let planned = stages.next(&legs).expect("a stage");
        assert_eq!((planned.name.as_str(), planned.begins), (name, begins), "after {} stage runs", legs.len());
        legs.push(ended(legs.len() + 1, planned, decision, fitness));
    }
}

#[test]
fn errors_name_stage_and_field() {
    let two = |second: serde_json::Value| json!([{ "name": "run", "promotion": { "generations": 3 } }, second]);
    for (given, message) in [
        (
            json!([{ "name": "Run 1" }]),
            "stages[0] (\"Run 1\"): name = \"Run 1\": must be 1 to 40 lower-case letters, digits and hyphens: it names a folder",
        ),
        (
            two(json!({ "name": "run" })),
            "stages[1] (\"run\"): name = \"run\": must be another than that of an earlier stage",
        ),
        (
            json!([{ "name": "a" }, { "name": "b" }]),
            "stages[0] (\"a\"): promotion = missing: must be a rule, or the stage could never be left; only the last stage needs none",
        ),
        (
            json!([{ "name": "a", "demotion": "usable" }]),
            "stages[0] (\"a\"): demotion = a rule: must be missing in the first stage: there is none before it",
        ),
        (
            json!([{ "name": "a", "transfer": "champion" }]),
            "stages[0] (\"a\"): transfer = given: must be missing in the first stage: there is none before it",
        ),
        (
            two(json!({ "name": "b", "promotion": { "generations": 0 } })),
            "stages[1] (\"b\"): promotion.generations = 0: must be at least 1",
        ),
        (
            two(json!({ "name": "b", "give_up": { "when": "usable", "back_to": "c", "times": 1 } })),
            "stages[1] (\"b\"): give_up.back_to = \"c\": must be this stage or an earlier one: run, b",
        ),
        (
            two(json!({ "name": "b", "give_up": { "when": "usable", "back_to": "b", "times": 0 } })),
            "stages[1] (\"b\"): give_up.times = 0: must be from 1 to 100",
        ),
        (
            two(json!({ "name": "b", "give_up": { "when": { "steps": 0 }, "back_to": "run", "times": 1 } })),
            "stages[1] (\"b\"): give_up.when.steps = 0: must be at least 1",
        ),
        (
            two(json!({ "name": "b", "promotion": { "not": { "generations": 1 } } })),
            "stages[1] (\"b\"): promotion = not (1 generations): must be a rule that some number of generations can meet",
        ),
        (
            two(json!({ "name": "b", "promotion": { "any": [] } })),
            "stages[1] (\"b\"): promotion.any = []: must be at least one rule",
        ),
        (
            two(json!({ "name": "b", "promotion": { "all": [{ "share": { "fitness": 1, "of": 2 } }] } })),
            "stages[1] (\"b\"): promotion.all[0].share.of = 2: must be above 0 and at most 1",
        ),
        (
            two(json!({ "name": "b", "promotion": { "measurement": { "name": "height", "at_least": 1 } } })),
            "stages[1] (\"b\"): promotion.measurement.name = \"height\": must be one of those there are: duration, ",
        ),
        (
            two(json!({ "name": "b", "promotion": { "measurement": { "name": "duration" } } })),
            "stages[1] (\"b\"): promotion.measurement = no bound: must be either at_least or at_most",
        ),
        (
            two(json!({ "name": "b", "promotion": { "any": ["usable", { "tier": 10 }] } })),
            "stages[1] (\"b\"): promotion.tier = 10: must be from 1 to 9",
        ),
        (
            two(json!({
                "name": "b",
                "promotion": { "tier": 24 },
                "changes": { "movement": { "name": "playing" }, "commands": { "random": {} } },
            })),
            "stages[1] (\"b\"): promotion.tier = 24: must be from 1 to 23",
        ),
        (
            two(json!({ "name": "b", "promotion": { "tier": 0 } })),
            "stages[1] (\"b\"): promotion.tier = 0: must be at least 1",
        ),
        (
            two(json!({ "name": "b", "promotion": "usable", "changes": { "movement": { "name": "standing" } } })),
            "stages[1] (\"b\"): promotion.usable = usable: must be asked for only where gaits are judged during training",
        ),
        (
            two(json!({ "name": "b", "promotion": "usable", "changes": { "variation": null } })),
            "stages[1] (\"b\"): changes.variation: ",
        ),
        (
            two(json!({ "name": "b", "changes": { "variation": "ligth" } })),
            "stages[1] (\"b\"): changes.variation: there is no variation \"ligth\"; did you mean \"light\"?",
        ),
        (
            two(json!({ "name": "b", "changes": { "terrain": "gasp:0.5" } })),
            "stages[1] (\"b\"): changes.terrain: there is no terrain \"gasp\"",
        ),
        (
            two(json!({ "name": "b", "changes": { "training_stps": 5 } })),
            "stages[1] (\"b\"): changes.training_stps: unknown field `training_stps`, expected one of `preset`, ",
        ),
        (
            two(json!({ "name": "b", "changes": { "seed": 5 } })),
            "stages[1] (\"b\"): changes.seed = a change: must be left to the whole run; what ends a stage is its promotion",
        ),
        (
            two(json!({ "name": "b", "changes": { "trials": { "count": 0 } } })),
            "stages[1] (\"b\"): trials.count = 0: must be from 1 to 1000",
        ),
        (
            two(json!({ "name": "b", "add_sensors": ["joint-angles"] })),
            "stages[1] (\"b\"): sensors[7]: `joint-angles` is already sensors[2]; list each sensor once",
        ),
        (
            two(json!({ "name": "b", "changes": { "sensors": ["joint-angles"] } })),
            "stages[1] (\"b\"): \"input rotation of torso\", ",
        ),
        (
            two(json!({ "name": "b", "changes": { "controller": { "modular": "alternating" } } })),
            "stages[1] (\"b\"): 58 of 58 weights: what was learned with it would be lost; keep it, or allow it with ",
        ),
        (
            two(json!({ "name": "b", "transfer": "topology", "changes": { "strategy": { "neat": {} } } })),
            "stages[1] (\"b\"): neat goes on from a population of its own, and from no single net",
        ),
        (
            json!([
                { "name": "a", "promotion": { "generations": 3 }, "changes": { "strategy": { "neat": {} } } },
                { "name": "b", "demotion": { "generations": 3 }, "changes": { "strategy": { "cma-es": {} } } }
            ]),
            "stages[1] (\"b\"): demotion: neat goes on from a population of its own, and from no single net",
        ),
        (
            two(json!({ "name": "b", "changes": { "creature": "biped-2" } })),
            "stages[1] (\"b\"): changes.creature: invalid type: string \"biped-2\", expected ",
        ),
        (
            two(json!({ "name": "b", "transfer": "population", "changes": { "strategy": { "open-es": {} } } })),
            "stages[1] (\"b\"): a population of cma-es is none of open-es: transfer the champion or its topology, or keep the strategy",
        ),
    ] {
        let error = stages(given.clone()).expect_err("it is wrong");
        assert!(error.starts_with(message), "{given}: {error}");
    }
    let misspelled =
        stages(two(json!({ "name": "b", "changes": { "training_stps": 5 } }))).expect_err("there is no such field");
    assert!(misspelled.ends_with("; did you mean `training_steps`?"), "{misspelled}");
    // A variation and a terrain can be named.
    let named = stages(two(json!({ "name": "b", "changes": { "variation": "none", "terrain": "gaps:0.5" } })));
    let named = named.expect("valid").configs().last().map(|(_, config)| (config.variation, config.terrain.clone()));
    assert_eq!(
        named,
        Some((Variation::default(), Registry::default().terrains.terrain("gaps:0.5").expect("a terrain")))
    );
    // NEAT can give up what a stage has added.
    let there_and_back = json!([
        { "name": "a", "promotion": { "generations": 3 }, "changes": { "strategy": { "neat": {} } } },
        { "name": "b", "demotion": { "generations": 3 }, "add_sensors": ["joint-speeds"] }
    ]);
    assert!(stages(there_and_back).is_ok());
    // What was learned may be given up if that is said.
    let forgetful = json!({ "name": "b", "allow_loss": true, "changes": { "sensors": ["joint-angles"] } });
    assert!(stages(two(forgetful)).is_ok());
}
