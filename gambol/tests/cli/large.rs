//! Large populations and long runs: neither memory nor files grow without end.

use crate::{
    damage::json,
    folder::read,
    program::{gambol, small_run, succeed},
};
use serde_json::Value;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// A line of the gallery is made in memory: of a large population it has a thousand, the best and the worst among them.
#[test]
fn of_a_large_population_a_thousand_are_in_the_gallery() -> Outcome {
    let folder = tempfile::tempdir()?;
    let members = |population: u32| -> Result<Vec<Value>, Box<dyn std::error::Error>> {
        let run = folder.path().join(population.to_string());
        let mut train = gambol("train");
        train.args(["biped-1", "running", "--strategy", "ga", "--variation", "none", "--generations", "1", "--quiet"]);
        train.args([
            "--set",
            "movement.steps=20",
            "--set",
            "training_steps=null",
            "--set",
            "record.populations_at=[1]",
        ]);
        succeed(train.args(["--no-report", "--population", &population.to_string(), "--out"]).arg(&run));
        let gallery = String::from_utf8(read(&run.join("gallery.jsonl")))?;
        let line: Value = serde_json::from_str(gallery.lines().last().ok_or("no line")?)?;
        assert_eq!(line["kind"], "population");
        Ok(line["members"].as_array().ok_or("no list")?.clone())
    };
    assert_eq!(members(1000)?.len(), 1000);
    let kept = members(1700)?;
    assert_eq!(kept.len(), 1000);
    let fitness = |member: &Value| member["fitness"].as_f64().unwrap_or(f64::NEG_INFINITY);
    let best = kept.iter().map(fitness).fold(f64::NEG_INFINITY, f64::max);
    let champion: Value = serde_json::from_slice(&read(&folder.path().join("1700/champion.json")))?;
    assert_eq!(Some(best), champion["content"]["fitness"].as_f64(), "the best is among them");
    Ok(())
}

/// Between re-evaluations, which become rarer, candidates wait; all in all they are bounded. (CMA-ES has a history beside them,
/// by which it knows that a search stagnates.)
#[test]
#[ignore = "ten thousand generations: cargo test --release -p gambol --test cli large -- --ignored"]
fn the_candidates_in_the_checkpoint_of_a_long_run_take_as_much_as_those_of_a_short_one() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    let candidates = || json(&run.join("checkpoint"))["content"]["candidates"].to_string().len();
    succeed(small_run(&run, 99).arg("--quiet"));
    let short = candidates();
    succeed(gambol("resume").arg(&run).args(["--no-report", "--quiet", "--generations", "9999"]));
    let long = candidates();
    assert!(short > 1000 && long * 10 <= short * 12, "{long} bytes after 9999 generations, {short} after 99");
    Ok(())
}

/// The most memory a command has needed, kB.
#[cfg(target_os = "linux")]
fn most_memory(command: &mut std::process::Command) -> u64 {
    let mut child = crate::program::start(command);
    let mut most = 0;
    while child.try_wait().expect("it was started").is_none() {
        let status = std::fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        most = most.max(line.and_then(|line| line.split_whitespace().next()?.parse().ok()).unwrap_or(0));
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(child.wait().expect("it was started").success());
    most
}

/// Measured: 1.1 GB in the first generation and 1.2 GB from the second on, whose parents go while their children come: of 1.2 kB
/// an individual 0.6 are its 146 weights, the rest the evaluation and what holds all of it together.
#[cfg(target_os = "linux")]
#[test]
#[ignore = "a million individuals: cargo test --release -p gambol --test cli large -- --ignored"]
fn a_population_of_a_million_takes_less_than_one_and_a_half_gigabytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    for generations in [1, 3] {
        let mut train = gambol("train");
        train.args(["apod", "running", "--preset", "thesis", "--strategy", "ga", "--population", "1000000"]);
        train.args(["--set", "movement.steps=2", "--set", "record.populations_at=[1]", "--quiet", "--no-report"]);
        train.args(["--generations", &generations.to_string(), "--out"]);
        let most = most_memory(train.arg(folder.path().join(generations.to_string())));
        assert!(most <= 1_300_000, "{most} kB in {generations} generations");
    }
    Ok(())
}
