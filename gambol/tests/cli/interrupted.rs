//! Ctrl-C finishes the generation, saves, and says how to resume.
#![cfg(unix)]

use crate::{
    damage::json,
    folder::{assert_same_run, read},
    program::{Ended, LONG, assert_says, gambol, long_run, small_run, start_and_read, succeed, text},
};
use gambol::{
    run_folder::RunFolder,
    training::{self, TrainOptions},
};
use serde_json::Value;
use std::{
    fs::DirEntry,
    io::{BufRead, BufReader, Read},
    path::Path,
    process::{Child, Command, Stdio},
    time::Duration,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The exit code shells have for a program that ended on Ctrl-C.
const INTERRUPTED: Option<i32> = Some(130);

fn interrupt(child: &Child) {
    send(child, "INT");
}

fn send(child: &Child, signal: &str) {
    let kill = format!("kill -{signal} \"$1\"");
    let status = Command::new("sh").args(["-c", &kill, "sh", &child.id().to_string()]).status();
    assert!(status.expect("there is a shell").success());
}

#[test]
fn an_interrupted_run_ends_with_130_and_resumed_gives_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
    succeed(long_run(&whole).args(["--threads", "2", "--quiet"]));
    let (child, mut output) = start_and_read(long_run(&broken).args(["--threads", "1"]), 4);
    interrupt(&child);
    let mut rest = String::new();
    output.read_to_string(&mut rest)?;
    assert_eq!(Ended::from(child.wait_with_output()?).code, INTERRUPTED);
    let result: Value = serde_json::from_str(rest.lines().last().expect("a result"))?;
    assert_eq!(result["result"]["reason"], "interrupted");
    succeed(gambol("resume").arg(&broken).arg("--no-report"));
    assert_same_run(&whole, &broken);
    Ok(())
}

#[test]
fn an_interrupted_run_has_saved_its_last_generation_and_says_how_to_go_on() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--set", "movement.steps=100", "--no-report"]);
    // Generations of some tenths of a second: what is told while one ends is told in time.
    train.args(["--population", "4000"]);
    // No machine gets that far before it is interrupted.
    train.args(["--set", "record.checkpoint_every=1000000", "--generations", "1000000", "--out"]).arg(&path);
    let mut child = train.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?;
    let mut errors = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    let title = errors.next().expect("a title")?;
    assert_says(&title, &["biped-1 learns running"]);
    let first = errors.next().expect("the first generation is always told")?;
    assert_says(&first, &["generation 1/1000000: best "]);
    interrupt(&child);
    let ended = Ended::from(child.wait_with_output()?);
    assert_eq!(ended.code, INTERRUPTED, "{}", ended.stdout);
    let rest = errors.collect::<Result<Vec<_>, _>>()?.join("\n");
    assert_says(&rest, &["finishing this generation, then saving"]);
    assert_says(&ended.stdout, &["it was interrupted", &format!("gambol resume {}", text(&path))]);

    let done = json(&path.join("checkpoint"))["content"]["progress"]["generations"].as_u64().expect("a number");
    assert_eq!(
        read(&path.join("log.jsonl")).split(|&byte| byte == b'\n').count() as u64,
        done + 1,
        "lines, and the end"
    );
    assert_says(&succeed(gambol("verify").arg(path.join("champion.json"))), &["identical"]);
    Ok(())
}

/// A second interrupt loses the generations since the last checkpoint, for a while: resumed, they come again.
#[test]
fn a_second_interrupt_ends_at_once_and_what_was_saved_is_whole() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
    let every_ten = ["--set", "record.checkpoint_every=10"];
    succeed(long_run(&whole).args(every_ten).arg("--quiet"));
    let (child, mut output) = start_and_read(long_run(&broken).args(every_ten), 15);
    interrupt(&child);
    interrupt(&child);
    // The system may deliver two signals as one; then the run ends as after the first.
    output.read_to_end(&mut Vec::new())?;
    assert_eq!(Ended::from(child.wait_with_output()?).code, INTERRUPTED);
    let saved = json(&broken.join("checkpoint"))["content"]["progress"]["generations"].as_u64().expect("a number");
    assert!((10..LONG as u64).contains(&saved), "{saved}");
    succeed(gambol("resume").arg(&broken).arg("--no-report"));
    assert_same_run(&whole, &broken);
    Ok(())
}

/// No signal is so early for sure; the library's own switch is.
#[test]
fn a_run_interrupted_before_its_first_generation_is_a_run_all_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
    succeed(&mut small_run(&whole, 3));
    let registry = gambol::Registry::default();
    let config = RunFolder::open(&whole)?.read_config()?;
    let signal = ne_core::StopSignal::default();
    signal.stop();
    let options = TrainOptions { threads: 1, registry, signal, on_generation: &mut |_| unreachable!("it is stopped") };
    let outcome = training::train(&config, &broken, options)?;
    assert_eq!((outcome.reason, outcome.progress.generations), (ne_core::StopReason::Interrupted, 0));
    assert!(outcome.champion.is_none());
    succeed(gambol("report").arg(&broken));
    succeed(gambol("resume").arg(&broken));
    assert_same_run(&whole, &broken);
    Ok(())
}

/// A run that would not end by itself, whose standard error is a pipe: as in `gambol train ... 2>&1 | tee log`.
fn endless_run(path: &Path) -> Command {
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--population", "4", "--set", "movement.steps=20", "--no-report"]);
    train.args(["--generations", "1000000", "--out"]).arg(path);
    train.stdout(Stdio::piped()).stderr(Stdio::piped());
    train
}

/// Waits for the first generation, with a pipe that is then closed.
fn begun(command: &mut Command) -> std::io::Result<Child> {
    let mut child = command.spawn()?;
    let mut errors = BufReader::new(child.stderr.take().expect("a pipe")).lines();
    errors.next().expect("a title")?;
    errors.next().expect("the first generation is always told")?;
    drop((errors, child.stdout.take()));
    Ok(child)
}

/// The terminal sends Ctrl-C to `tee` as well, which ends at once: nobody reads what the program writes then.
#[test]
fn ctrl_c_behind_a_dead_pipe_saves() -> Outcome {
    let folder = tempfile::tempdir()?;
    for number in 0..5 {
        let path = folder.path().join(number.to_string());
        let mut child = begun(&mut endless_run(&path))?;
        interrupt(&child);
        assert_eq!(child.wait()?.code(), INTERRUPTED);
        assert!(path.join("champion.json").is_file());
    }
    Ok(())
}

#[test]
fn a_request_to_terminate_and_a_closed_terminal_save_as_ctrl_c_does() -> Outcome {
    let folder = tempfile::tempdir()?;
    for signal in ["TERM", "HUP"] {
        if signal == "HUP" && !Path::new("/proc/self/status").exists() {
            continue;
        }
        let path = folder.path().join(signal);
        let mut child = begun(&mut endless_run(&path))?;
        send(&child, signal);
        assert_eq!(child.wait()?.code(), INTERRUPTED, "{signal}");
        assert!(path.join("champion.json").is_file());
    }
    Ok(())
}

#[test]
fn a_run_under_nohup_survives_its_terminal() -> Outcome {
    let folder = tempfile::tempdir()?;
    let train = endless_run(&folder.path().join("run"));
    let mut ignoring = Command::new("sh");
    ignoring.args(["-c", "trap '' HUP; exec \"$@\"", "sh"]).arg(train.get_program()).args(train.get_args());
    let mut child = begun(ignoring.stdout(Stdio::piped()).stderr(Stdio::piped()))?;
    send(&child, "HUP");
    std::thread::sleep(std::time::Duration::from_millis(300));
    assert!(child.try_wait()?.is_none(), "it goes on");
    interrupt(&child);
    assert_eq!(child.wait()?.code(), INTERRUPTED);
    Ok(())
}

/// A benchmark trains in the temporary folder, and leaves nothing there.
#[test]
fn an_interrupted_benchmark_ends_with_130_and_leaves_no_folder() -> Outcome {
    for arguments in [
        &["training", "--creature", "biped-1", "--generations", "1000000"][..],
        &["gaits", "--creatures", "biped-1", "--movements", "running", "--whole", "--steps", "1000000000000"],
    ] {
        let folder = tempfile::tempdir()?;
        let mut bench = gambol("bench");
        let bench = bench.args(arguments).env("TMPDIR", folder.path());
        let child = bench.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn()?;
        let left = || std::fs::read_dir(folder.path()).map(|entries| entries.flatten().next());
        let is_begun = |entry: DirEntry| entry.path().join("run/log.jsonl").is_file();
        while !left()?.is_some_and(is_begun) {
            std::thread::sleep(Duration::from_millis(20));
        }
        interrupt(&child);
        let ended = Ended::from(child.wait_with_output()?);
        assert_eq!(ended.code, INTERRUPTED, "{arguments:?}: {}", ended.stderr);
        assert!(left()?.is_none(), "{arguments:?}");
    }
    Ok(())
}
