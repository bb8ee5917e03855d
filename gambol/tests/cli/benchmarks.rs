//! The benchmarks: every strategy is measured on classic tasks, the same each time.

use crate::program::{assert_says, fail, gambol, run, succeed};
use serde_json::Value;

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn bench(arguments: &[&str]) -> std::process::Command {
    let mut bench = gambol("bench");
    bench.arg("strategies").args(arguments);
    bench
}

#[test]
fn neat_and_cma_es_solve_what_they_should_beside_the_published_figures() -> Outcome {
    let table = succeed(&mut bench(&["--tasks", "xor,one-pole", "--strategies", "neat,cma-es", "--seeds", "2"]));
    assert_says(
        &table,
        &["2 seeds from 1001", "xor: evaluations to a solution", "NEAT 4755 (Stanley & Miikkulainen 2002)"],
    );
    assert_says(&table, &["one-pole: evaluations to a solution", "CMA-ES 283", "2/2"]);
    Ok(())
}

#[test]
fn every_attempt_is_told_as_json_and_is_the_same_again() -> Outcome {
    let attempts = || -> Result<Vec<Value>, Box<dyn std::error::Error>> {
        let text = succeed(&mut bench(&["--tasks", "one-pole", "--strategies", "cosyne", "--seeds", "3", "--json"]));
        let mut measured: Value = serde_json::from_str(&text)?;
        assert!(measured["published"].as_array().is_some_and(|published| published.len() > 20));
        let measured = &mut measured["measured"];
        assert_eq!(measured[0]["strategy"], "cosyne");
        assert_eq!(measured[0]["task"], "one-pole");
        let attempts = measured[0]["attempts"].as_array_mut().ok_or("a list")?;
        attempts.iter_mut().filter_map(Value::as_object_mut).for_each(|attempt| drop(attempt.remove("seconds")));
        Ok(attempts.clone())
    };
    let first = attempts()?;
    assert_eq!(first.len(), 3);
    assert!(first.iter().all(|attempt| attempt["solved"] == true), "{first:?}");
    assert_eq!(first, attempts()?);
    Ok(())
}

#[test]
fn random_guessing_stands_beside_published_guessing_and_every_row_names_its_net_and_settings() {
    let table = succeed(&mut bench(&["--tasks", "one-pole", "--strategies", "random-search,ga", "--seeds", "2"]));
    assert_says(
        &table,
        &["random-search [2]", "random weight guessing 199 (Gomez", "[1] one logistic neuron, a constant"],
    );
    assert_says(&table, &["[2] one logistic neuron, a constant among its inputs: initialization {\"uniform\""]);
}

#[test]
fn both_ways_of_counting_are_told() {
    let table =
        succeed(&mut bench(&["--tasks", "two-poles-without-velocities", "--strategies", "cma-es", "--seeds", "2"]));
    assert_says(&table, &["tested, not counted", "cma-es [1]          all", "cma-es [2]          best"]);
}

#[test]
fn misspelt_names_are_corrected() {
    for (arguments, says) in [
        (&["--strategies", "naet"][..], "there is no strategy \"naet\"; did you mean \"neat\"?"),
        (&["--tasks", "two-pole"], "there is no task \"two-pole\"; did you mean \"two-poles\"?"),
        (&["--seeds", "0"], "0 is not in 1.."),
    ] {
        let ended = run(&mut bench(arguments));
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        assert_says(&ended.stderr, &[says]);
    }
}

#[test]
fn settings_of_a_strategy_are_chosen_by_their_text() {
    let general = ["--tasks", "two-poles-without-velocities", "--strategies", "neat", "--seeds", "1"];
    let table = succeed(bench(&general).args(["--settings", "pole_balancing"]));
    assert!(table.contains("NeatSettings::pole_balancing") && !table.contains("stanley_2002"), "{table}");
    assert_says(
        &fail(bench(&general).args(["--settings", "pole-balancing"])),
        &[
            "none of the strategies asked for is measured with \"pole-balancing\" in its net or named settings on a task asked for",
        ],
    );
    assert_says(
        &fail(&mut bench(&["--strategies", "nsga2"])),
        &["none of the strategies asked for is measured on a task asked for"],
    );
}
