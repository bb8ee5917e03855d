//! Settings that make no sense: each message names the setting, and the nearest valid name where a name is wrong.

use crate::program::{assert_says, fail, gambol, text};
use std::fs;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// After `train biped-1 running`.
#[rustfmt::skip]
const FLAGS: &[(&[&str], &[&str])] = &[
    (&["--population", "0", "--strategy", "ga"], &["strategy.conventional.population = 0: must be from 2 to 1000000"]),
    (&["--population", "1", "--strategy", "ga"], &["strategy.conventional.population = 1: must be from 2 to 1000000"]),
    (&["--generations", "0"],    &["stop.generations = 0: must be at least 1"]),
    (&["--evaluations", "0"],    &["stop.evaluations = 0: must be at least 1"]),
    (&["--steps", "0"],          &["stop.steps = 0: must be at least 1"]),
    (&["--stagnation", "0"],     &["stop.stagnation = 0: must be at least 1"]),
    (&["--minutes", "-1"],       &["stop.minutes = -1: must be a finite number above 0"]),
    (&["--minutes", "NaN"],      &["stop.minutes = NaN: must be a finite number above 0"]),
    (&["--minutes", "inf"],      &["stop.minutes = inf: must be a finite number above 0"]),
    (&["--target", "NaN"],       &["stop.target = NaN: must be a finite number"]),
    (&["--target", "-inf"],      &["stop.target = -inf: must be a finite number"]),
    (&["--engine", "lnaes"],     &["there is no engine \"lnaes\"; did you mean \"lanes\"? (there are: lanes, rapier)"]),
    (&["--variation", "lihgt"],  &["there is no variation \"lihgt\"; did you mean \"light\"? (there are: none, near, pushed, shoved, light, bumpy, strong, physics)"]),
    (&["--terrain", "gasp"],     &["there is no terrain \"gasp\"; did you mean \"gaps\"? (there are: flat, gaps, "]),
    (&["--terrain", "gaps:2"],   &["terrain.difficulty = 2: must be from 0 to 1"]),
    (&["--terrain", "gaps:x"],   &["terrain \"gaps:x\": \"x\" is no difficulty; write it as in gaps:0.5"]),
    (&["--preset", "thesys"],    &["there is no preset \"thesys\"", "did you mean \"thesis\"?"]),
];

/// After `train biped-1 running --strategy ga --set`.
#[rustfmt::skip]
const SETTINGS: &[(&str, &[&str])] = &[
    // Keys.
    ("physics.time_step",                           &["not of the form key=value"]),
    ("=3",                                          &["not of the form key=value"]),
    ("sede=3",                                      &["--set sede=3", "unknown field `sede`", "did you mean `seed`?"]),
    ("physics.timestep=0.01",                       &["physics.timestep: unknown field", "did you mean `time_step`?"]),
    ("strategy.conventional.popultion=3",           &["strategy.conventional.popultion", "did you mean `population`?"]),
    ("strategy.convetional.population=3",           &["strategy", "did you mean \"conventional\"?"]),
    ("engine=lnaes",                                &["engine: unknown variant `lnaes`", "did you mean `lanes`?"]),
    ("physics.time_step.x=1",                       &["physics.time_step: has no field \"x\""]),
    // Types.
    ("physics.time_step=fast",                      &["physics.time_step: invalid type: string \"fast\""]),
    ("physics.time_step=NaN",                       &["physics.time_step: invalid type: string \"NaN\""]),
    ("strategy.conventional.population=2.5",        &["strategy.conventional.population: invalid type"]),
    ("strategy.conventional.population=-5",         &["strategy.conventional.population: invalid value: integer `-5`"]),
    ("controller.hidden=[\"ten\"]",                 &["controller.hidden[0]: invalid type: string \"ten\""]),
    ("controller.hidden_activation=tanhh",          &["controller.hidden_activation", "did you mean `tanh`?"]),
    ("movement.terms=[{\"trem\":\"energy\"}]",      &["movement.terms[0].trem", "did you mean `term`?"]),
    ("movement.terms=[{\"term\":\"energy\",\"weight\":\"much\"}]", &["movement.terms[0].weight: invalid type"]),
    ("strategy.conventional.selection={\"tournment\":{\"size\":3}}",
                                                    &["strategy.conventional.selection", "did you mean `tournament`?"]),
    ("creature=biped-2",                            &["--set creature=biped-2: creature: invalid type"]),
    ("stop=null",                                   &["stop: invalid type: null"]),
    // Ranges.
    ("movement.steps=0",                            &["movement.steps = 0: must be from 1 to 1000000"]),
    ("trials.count=0",                              &["trials.count = 0: must be from 1 to 1000"]),
    ("variation.mass=1",                            &["variation.mass = 1: must be from 0 to 0.9"]),
    ("controller.hidden=[0]",                       &["controller.hidden[0] = 0: must be from 1 to 4096"]),
    ("controller.hidden_scale=-1",                  &["controller.hidden_scale = -1: must be"]),
    ("controller.input_range=0",                    &["controller.input_range = 0: must be from 0.001 to 1000"]),
    ("controller.modular=3",                          &["controller.modular", "invalid"]),
    ("controller.modular=altrenating",                &["controller.modular: unknown variant `altrenating`", "did you mean `alternating`?"]),
    ("controller.actuation=angel",                  &["controller.actuation: unknown variant `angel`", "did you mean `angle`?"]),
    ("controller.actuation=angle",                  &["controller.actuation", "invalid type"]),
    ("controller.actuation={\"angle\":{\"gian\":8}}", &["controller.actuation.angle", "did you mean `gain`?"]),
    ("controller.actuation={\"angle\":{\"gain\":0}}", &["controller.actuation.angle.gain = 0: must be from 0.1 to 50"]),
    ("controller.actuation={\"angle\":{\"gain\":51}}", &["controller.actuation.angle.gain = 51: must be from 0.1 to 50"]),
    ("training_steps=0",                                 &["training_steps = 0: must be from 1 to 1000000"]),
    ("training_steps=-1",                                &["training_steps: invalid value: integer `-1`"]),
    ("training_steps=short",                             &["training_steps: invalid type: string \"short\""]),
    ("rungs=[{\"steps\":9,\"share\":0.5},{\"steps\":99,\"share\":1.5}]", &["rungs[1].share = 1.5: must be above 0 and below 1"]),
    ("rungs=[{\"steps\":0,\"share\":0.5}]",         &["rungs[0].steps = 0: must be from 1 to 500, as many as in training"]),
    ("rungs=[{\"steps\":501,\"share\":0.5}]",       &["rungs[0].steps = 501: must be from 1 to 500, as many as in training"]),
    ("rungs=[{\"trials\":0,\"share\":0.5}]",        &["rungs[0].trials = 0: must be from 1 to 3, as many as in training"]),
    ("rungs=[{\"trials\":3,\"share\":0.5}]",        &["rungs[0] = 500 steps, trials: 3: must be cheaper than training: fewer steps than 500 or fewer trials than 3"]),
    ("rungs=[{\"steps\":50}]",                      &["rungs[0]: missing field `share`"]),
    ("rungs=[{\"steps\":50,\"shaer\":0.5}]",        &["rungs[0].shaer: unknown field", "did you mean `share`?"]),
    ("rungs={\"steps\":50,\"share\":0.5}",          &["rungs: invalid type: map"]),
    ("movement.terms=[{\"term\":\"uprihgt\"}]",     &["movement.terms[0].term", "\"uprihgt\"", "did you mean \"upright\"?"]),
    ("sensors=[\"torso-spni\"]",                    &["sensors[0]: unknown variant", "did you mean `torso-spin`?"]),
    ("movement.settings.speed=1",                   &["movement.settings.speed: unknown field; \"running\" has no settings"]),
    ("movement.settings=fast",                      &["movement.settings: invalid type: string \"fast\""]),
    ("movement.terms=[{\"term\":\"headway\",\"settings\":{\"backward\":true}}]",
                                                    &["movement.terms[0].settings.backward: unknown field", "did you mean `backwards`?"]),
    ("trials={\"count\":2,\"combine\":\"worst-lesson\",\"lessons\":true}", &["trials.lessons = true: must be false where no random commands are given"]),
    ("movement.name=jumping",                       &["a movement is chosen on the command line or in a file, not with --set"]),
    ("preset=thesis",                               &["a preset is chosen with --preset"]),
    ("movement.terms=[{\"term\":\"energy\"},{\"term\":\"energy\"}]", &["movement.terms[1].term = energy", "named once"]),
    ("movement.objectives=[{\"term\":\"running\"}]", &["movement.objectives = 1 objectives: must be from 2 to 4 objectives, or none"]),
    ("movement.objectives=[{\"term\":\"running\"},{\"term\":\"enrgy\"}]", &["movement.objectives[1].term", "did you mean \"energy\"?"]),
    ("movement.objectives=[{\"term\":\"running\"},{\"term\":\"energy\",\"weight\":0}]", &["movement.objectives[1].weight = 0: must be a finite number other than 0"]),
    ("movement.objectives=[{\"trem\":\"energy\"}]", &["movement.objectives[0].trem", "did you mean `term`?"]),
    ("terrain.difficulty=1.5",                      &["terrain.difficulty = 1.5: must be from 0 to 1"]),
    ("terrain.lenght=5",                            &["terrain.lenght: unknown field", "did you mean `length`?"]),
    ("terrain.obstacles=[{\"gasp\":{}}]",           &["terrain.obstacles[0]", "did you mean `gaps`?"]),
    ("terrain.obstacles=[{\"gaps\":{\"width\":21}}]", &["terrain.obstacles[0].gaps.width = 21: must be from 0 to 20 m"]),
    ("sensors=[{\"next-gap\":{\"length\":0}}]",     &["sensors[0].next-gap.length"]),
    ("physics.time_step=0",                         &["physics.time_step = 0: must be from 0.001 to 0.05"]),
    ("physics.time_step=1e39",                      &["physics.time_step: expected a number that fits single precision"]),
    ("physics.solver_iterations=4294967295",        &["physics.solver_iterations = 4294967295: must be from 1 to 32"]),
    ("physics.solver_iterations=0",                 &["physics.solver_iterations = 0: must be from 1 to 32"]),
    ("physics.continuous_collision_substeps=1",     &["engine: lanes cannot simulate this creature: it is to have continuous", "train it with --engine rapier"]),
    ("record.candidates=0",                          &["record.candidates = 0: must be from 1 to 1000"]),
    ("record.candidates=1001",                       &["record.candidates = 1001: must be from 1 to 1000"]),
    ("record.checkpoint_every=0",                   &["record.checkpoint_every = 0: must be at least 1"]),
    ("strategy.conventional.elites=1000000",        &["strategy.conventional.elites = 1000000: must be below"]),
    ("strategy.conventional.crossover_rate=1.5",    &["strategy.conventional.crossover_rate = 1.5: must be from 0 to 1"]),
    ("strategy.conventional.selection={\"tournament\":{\"size\":0}}",
                                                    &["strategy.conventional.selection.tournament.size = 0"]),
    ("movement.terms=[{\"term\":\"enrgy\"}]",       &["movement.terms[0].term", "\"enrgy\"", "did you mean \"energy\"?"]),
    ("sensors=[]",                                  &["sensors: expected 1 to"]),
    ("movement.terms=[{\"term\":\"energy\"}",       &["movement.terms=[{\"term\":\"energy\"}: EOF while parsing a list", "is read as JSON"]),
    ("preset=\"thesis",                             &["preset=\"thesis: EOF while parsing a string"]),
    ("sensors=[\"torso-rotation\",\"torso-rotation\"]", &["sensors[1]", "already sensors[0]"]),
];

/// Configuration files, laid over `train biped-1 running`. The message names the file as well.
#[rustfmt::skip]
const FILES: &[(&str, &[&str])] = &[
    ("",                                            &["line 1, column 0: ", "EOF"]),
    ("{\n  \"seed\": 1,\n  oops\n}",                &["line 3, column 3: ", "key must be a string"]),
    ("{\"seed\": 1,\n\"physics\": {\"gravity\": 9.81}",  &["line 2, column 28: ", "EOF"]),
    ("{\"seed\": NaN}",                             &["line 1, column 10: ", "expected value"]),
    ("{\"physics\": {\"gravity\": 1e999}}",         &["line 1, column 29", "number"]),
    ("[1, 2]",                                      &["must be a JSON object"]),
    ("{\"seed\": 3, \"seed\": 4}",                  &["line 1, column 18: \"seed\" is there twice"]),
    ("{\"physics\": {\"gravity\": 3,\n\"gravity\": 5}}", &["line 2, column 9: \"gravity\" is there twice"]),
    ("{\"sede\": 1}",                               &["sede: unknown field", "did you mean `seed`?"]),
    ("{\"stop\": {\"generatons\": 1}}",             &["stop.generatons: unknown field", "did you mean `generations`?"]),
    ("{\"strategy\": {\"conventional\": {\"mutation\": {\"gausian\": {}}}}}",
                                                    &["strategy.conventional.mutation", "did you mean `gaussian`?"]),
    ("{\"preset\": \"thesys\"}",                    &["preset: there is no preset \"thesys\"", "did you mean \"thesis\"?"]),
    ("{\"preset\": 7}",                             &["preset: must be a name, found 7"]),
    ("{\"movement\": 8}",                           &["movement: invalid type: integer `8`"]),
    ("{\"seed\": -1}",                              &["seed: invalid value: integer `-1`"]),
    ("{\"strategy\": {\"conventional\": {\"population\": 1}}}", &["strategy.conventional.population = 1: must be"]),
    ("{\"controller\": {\"hidden\": [5, 0]}}",      &["controller.hidden[1] = 0: must be from 1 to 4096"]),
    ("{\"movement\": {\"terms\": [{\"term\": \"enrgy\"}]}}",  &["movement.terms[0].term", "did you mean \"energy\"?"]),
    ("{\"sensors\": [\"torso-rotaton\"]}",          &["sensors[0]: unknown variant", "did you mean `torso-rotation`?"]),
    ("{\"format\": \"gambol champion\", \"version\": 1, \"content\": {}}", &["format", "\"gambol champion\"", "\"gambol run\""]),
    ("{\"format\": \"gambol run\", \"version\": 3, \"content\": {}}",      &["version: is 3, this Gambol reads version 2"]),
];

/// Configuration files that say creature and movement themselves.
#[rustfmt::skip]
const WHOLE_FILES: &[(&str, &[&str])] = &[
    ("{\"creature\": \"bipde-1\", \"movement\": {\"name\": \"running\"}}", &["creature: there is no creature", "did you mean \"biped-1\"?"]),
    ("{\"creature\": \"biped-1\", \"movement\": {\"name\": \"runing\"}}",  &["movement.name: there is no movement", "did you mean \"running\"?"]),
    ("{\"creature\": \"no/such/file.json\", \"movement\": {\"name\": \"running\"}}", &["creature: cannot read no/such/file.json"]),
    ("{\"creature\": 7, \"movement\": {\"name\": \"running\"}}",           &["creature: invalid type: integer `7`, expected an object"]),
    ("{\"creature\": {\"format\": \"gambol creature\", \"version\": 1, \"name\": \"x\", \"parts\": []}, \"movement\": {\"name\": \"running\"}}",
                                                    &["creature: parts: a creature needs parts"]),
];

/// Runs `train` in an empty folder, which must be as empty afterwards.
fn refused(arguments: &[&str], says: &[&str]) -> Outcome {
    let folder = tempfile::tempdir()?;
    let message = fail(gambol("train").args(arguments).current_dir(folder.path()));
    assert_says(&message, says);
    assert!(!message.contains("learns"), "{arguments:?} began before it was checked: {message}");
    assert_eq!(fs::read_dir(folder.path())?.count(), 0, "{arguments:?} left something behind");
    Ok(())
}

#[test]
fn a_wrong_flag_is_named() -> Outcome {
    for (flags, says) in FLAGS {
        refused(&[&["biped-1", "running"], *flags].concat(), says)?;
    }
    Ok(())
}

#[test]
fn a_wrong_setting_is_named() -> Outcome {
    for (setting, says) in SETTINGS {
        refused(&["biped-1", "running", "--strategy", "ga", "--generations", "1", "--set", setting], says)?;
    }
    Ok(())
}

#[test]
fn a_wrong_field_of_a_configuration_file_is_named_with_its_file() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("mine.json");
    for (content, says) in FILES {
        fs::write(&file, content)?;
        refused(&["biped-1", "running", "--config", text(&file)], &[&[text(&file)], *says].concat())?;
    }
    for (content, says) in WHOLE_FILES {
        fs::write(&file, content)?;
        refused(&["--config", text(&file)], &[&[text(&file)], *says].concat())?;
    }
    Ok(())
}

#[test]
fn a_wrong_setting_of_a_movement_is_named() -> Outcome {
    for (movement, setting, says) in [
        ("walking", "speed=-1", "movement.settings.speed = -1: must be from 0 to 100"),
        ("walking", "speed=fast", "movement.settings.speed: invalid type: string \"fast\""),
        (
            "walking",
            "spede=1",
            "movement.settings.spede: unknown field `spede`, expected `speed`; did you mean `speed`?",
        ),
        ("standing", "after=1001", "movement.settings.after = 1001: must be from 0 to 1000"),
        ("getting-up", "turn=0", "movement.settings.turn = 0: must be from 10 to 180, or from -180 to -10"),
    ] {
        let setting = format!("movement.settings.{setting}");
        refused(&["tetrapod-1", movement, "--generations", "1", "--set", &setting], &[says])?;
    }
    Ok(())
}

/// What `train` refuses in a file, `check` has warned of.
#[test]
fn check_finds_what_train_refuses() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("mine.json");
    for (content, says) in FILES.iter().chain(WHOLE_FILES).filter(|(content, _)| content.starts_with("{\"")) {
        fs::write(&file, content)?;
        // By its format a file may be of a kind that is checked in another way.
        let says = if content.contains("gambol champion") { &[] } else { *says };
        assert_says(&fail(gambol("check").arg(&file)), &[&[text(&file)], says].concat());
    }
    Ok(())
}

#[test]
fn a_file_is_not_blamed_for_what_a_flag_says() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("mine.json");
    fs::write(&file, "{\"strategy\": {\"conventional\": {\"population\": 20}}}")?;
    let message = fail(gambol("train").args(["biped-1", "running", "--population", "1", "--config", text(&file)]));
    assert_says(&message, &["error: strategy.conventional.population = 1"]);
    Ok(())
}

#[test]
fn unknown_names_are_answered_with_the_nearest() -> Outcome {
    refused(&["bipde-1", "running"], &["there is no creature \"bipde-1\"", "did you mean \"biped-1\"?", "decapod-2"])?;
    refused(&["biped-1", "runing"], &["there is no movement \"runing\"", "did you mean \"running\"?"])?;
    refused(&["biped-1", "energy"], &["movement.steps", "since this movement has no length of its own"])?;
    refused(&["biped-1"], &["say which movement", "gambol movements"])?;
    refused(&[], &["say which creature", "gambol creatures"])
}
