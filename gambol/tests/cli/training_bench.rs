//! `bench training`: how long whole runs take.

use crate::program::{assert_says, gambol, run, succeed};
use serde_json::Value;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn bench(arguments: &[&str]) -> std::process::Command {
    let mut bench = gambol("bench");
    bench.arg("training").args(arguments);
    bench
}

#[test]
fn each_creature_has_a_line() {
    let table =
        succeed(&mut bench(&["--creature", "biped-1", "--creature", "apod", "--generations", "2", "--steps", "20"]));
    assert_says(&table, &["2 generations", "lanes", "seconds", "generations/s", "\nbiped-1 ", "\napod "]);
}

#[test]
fn json_has_the_figures() -> Outcome {
    let flags =
        ["--creature", "biped-1", "--generations", "3", "--steps", "30", "--engine", "rapier", "--threads", "1"];
    let measured: Value = serde_json::from_str(&succeed(bench(&flags).arg("--json")))?;
    assert_eq!((&measured["engine"], &measured["threads"]), (&"rapier".into(), &1.into()));
    let run = &measured["runs"][0];
    assert_eq!((&run["creature"], &run["generations"]), (&"biped-1".into(), &3.into()));
    // At most as many steps as planned, for each of at least two individuals a generation at least one.
    assert!((6..=3 * 30 * 1000).contains(&run["steps"].as_u64().unwrap_or(0)), "{run}");
    for figure in ["seconds", "generations_per_second", "microseconds_per_step_and_core"] {
        assert!(run[figure].as_f64() > Some(0.0), "{figure}: {run}");
    }
    assert!(run["fitness"].is_number() && run["fitness_in_training"].is_number(), "{run}");
    Ok(())
}

#[test]
fn misspelt_names_are_corrected() {
    for (arguments, says) in [
        (&["--creature", "bipde-1"][..], "did you mean \"biped-1\"?"),
        (&["--engine", "lnaes"], "there is no engine \"lnaes\"; did you mean \"lanes\"?"),
        (&["--generations", "0"], "stop.generations = 0: must be at least 1"),
        (&["--steps", "0"], "movement.steps = 0: must be from 1 to 1000000"),
    ] {
        let ended = run(&mut bench(arguments));
        assert_eq!(ended.code, Some(1), "{arguments:?}: {}", ended.stderr);
        assert_says(&ended.stderr, &[says]);
    }
}
