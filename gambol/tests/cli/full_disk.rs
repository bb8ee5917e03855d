//! A disk that is full breaks a run off; what was saved before is whole.
//!
//! A limit on the size of files stands in for the disk: a write beyond it fails as on a full one.
#![cfg(unix)]

use crate::{
    damage::json,
    folder::{assert_same_run, contents, read},
    program::{Ended, assert_says, gambol, run, small_run, succeed, text},
};
use std::{path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Of the shell's `ulimit -f`.
const BLOCK: usize = 512;

/// Runs a command with no file growing beyond so many blocks. The signal that would end it is ignored, so that the
/// write gives an error.
fn run_limited(command: &Command, blocks: usize) -> Ended {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$@\"");
    run(Command::new("sh").args(["-c", &script, "sh"]).arg(command.get_program()).args(command.get_args()))
}

fn train(folder: &Path) -> Command {
    let mut train = small_run(folder, 60);
    // Small checkpoints, so that it is each time another file that is too large first.
    train.args(["--quiet", "--set", "record.checkpoint_every=4", "--set", "controller.hidden=[]"]);
    train
}

#[test]
fn a_run_broken_off_by_a_full_disk_resumes_to_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let whole = folder.path().join("whole");
    succeed(&mut train(&whole));
    let size = |name: &str| read(&whole.join(name)).len();
    let largest = contents(&whole).values().map(Vec::len).max().expect("files") / BLOCK;
    // The configuration fits: without it there is no run yet.
    let smallest = size("config.json").div_ceil(BLOCK);
    assert!(smallest < largest);
    let mut resumed = 0;
    for step in 0..6 {
        let blocks = smallest + (largest - smallest) * step / 6;
        let path = folder.path().join(format!("limit-{blocks}"));
        let ended = run_limited(&train(&path), blocks);
        assert_eq!(ended.code, Some(1), "{blocks} blocks: {}", ended.stderr);
        assert_says(&ended.stderr, &["cannot write ", text(&path), "File too large"]);
        // Reads only if it is whole.
        let done = json(&path.join("checkpoint"))["content"]["progress"]["generations"].as_u64().expect("a number");
        resumed += u32::from(done > 0);
        assert!(contents(&path).keys().all(|path| path.extension().is_none_or(|end| end != "tmp")), "a remnant");
        succeed(gambol("resume").arg(&path).args(["--quiet", "--no-report"]));
        assert_same_run(&whole, &path);
    }
    assert!(resumed > 0, "no run came to its first checkpoint");
    Ok(())
}

#[test]
fn a_resumed_run_that_meets_a_full_disk_can_be_resumed_again() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, path) = (folder.path().join("whole"), folder.path().join("run"));
    succeed(&mut small_run(&whole, 40));
    succeed(&mut small_run(&path, 20));
    let blocks = read(&path.join("config.json")).len().max(read(&path.join("champion.json")).len()).div_ceil(BLOCK);
    let limited = read(&whole.join("gallery.jsonl")).len().max(read(&whole.join("log.jsonl")).len()) > blocks * BLOCK;
    let mut resume = gambol("resume");
    resume.arg(&path).args(["--no-report", "--generations", "40"]);
    let ended = run_limited(&resume, blocks);
    assert_eq!(ended.code == Some(1), limited, "{}", ended.stderr);
    if limited {
        succeed(&mut resume);
    }
    assert_same_run(&whole, &path);
    Ok(())
}

#[test]
fn a_folder_without_room_for_the_configuration_names_it() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let ended = run_limited(&train(&path), 2);
    assert_eq!(ended.code, Some(1));
    assert_says(&ended.stderr, &["cannot write ", text(&path.join("config.json"))]);
    assert!(contents(&path).is_empty());
    // So that the same command can be given again.
    succeed(&mut train(&path));
    Ok(())
}

#[test]
fn a_page_without_room_leaves_the_old_one() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut small_run(&path, 2));
    succeed(gambol("report").arg(&path));
    let before = read(&path.join("report.html"));
    let mut report = gambol("report");
    let ended = run_limited(report.arg(&path), 8);
    assert_eq!(ended.code, Some(1));
    assert_says(&ended.stderr, &["cannot write ", "report.html"]);
    assert_eq!(read(&path.join("report.html")), before);
    Ok(())
}
