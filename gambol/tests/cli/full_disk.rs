//! A disk that is full breaks a run off; what was saved before is whole.
//!
//! A limit on the size of files stands in for the disk: a write beyond it fails as on a full one.
#![cfg(unix)]

use crate::{
    bad_creatures,
    damage::json,
    folder::{assert_same_run, contents, read},
    program::{Ended, assert_says, gambol, run, small_run, small_run_of, succeed, text},
};
use std::{collections::BTreeSet, fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Of the shell's `ulimit -f`.
const BLOCK: usize = 512;

/// Runs a command with no file growing beyond so many blocks. The signal that would end it is ignored, so that the
/// write gives an error.
fn run_limited(command: &Command, blocks: usize) -> Ended {
    let script = format!("trap '' XFSZ; ulimit -f {blocks}; exec \"$@\"");
    run(Command::new("sh").args(["-c", &script, "sh"]).arg(command.get_program()).args(command.get_args()))
}

/// A run of a creature without looks, with few settings: its configuration is small, and every other file grows beyond
/// it.
fn train(folder: &Path, generations: u32) -> Command {
    let creature = folder.with_file_name("stroller.json");
    fs::write(&creature, bad_creatures::creature().to_string()).expect("a writable folder");
    let mut train = small_run_of(text(&creature), "running", folder, generations);
    train.args(["--preset", "thesis", "--variation", "light"]);
    train.args(["--quiet", "--set", "record.checkpoint_every=4", "--set", "record.populations_at=[9,30]"]);
    train
}

#[test]
fn a_run_broken_off_by_a_full_disk_resumes_to_the_same_bytes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let whole = folder.path().join("whole");
    succeed(&mut train(&whole, 60));
    let blocks = |name: &str| read(&whole.join(name)).len().div_ceil(BLOCK);
    let mut broken_off_at = BTreeSet::new();
    // The configuration fits each time: without it there is no run yet.
    let limits = [blocks("config.json"), 12, 16, 24, 40, blocks("log.jsonl") - 1, blocks("gallery.jsonl") - 1];
    for limit in BTreeSet::from(limits) {
        let path = folder.path().join(format!("limit-{limit}"));
        let ended = run_limited(&train(&path, 60), limit);
        assert_eq!(ended.code, Some(1), "{limit} blocks: {}", ended.stderr);
        assert_says(&ended.stderr, &["cannot write ", text(&path), "File too large"]);
        // It can be read, so it is whole.
        broken_off_at.insert(json(&path.join("checkpoint"))["content"]["progress"]["generations"].as_u64());
        assert!(contents(&path).keys().all(|path| path.extension().is_none_or(|end| end != "tmp")), "a remnant");
        succeed(gambol("resume").arg(&path).args(["--quiet", "--no-report"]));
        assert_same_run(&whole, &path);
    }
    assert!(broken_off_at.len() > 2, "it was always the same moment: {broken_off_at:?}");
    Ok(())
}

#[test]
fn a_resumed_run_that_meets_a_full_disk_can_be_resumed_again() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, path) = (folder.path().join("whole"), folder.path().join("run"));
    succeed(&mut train(&whole, 60));
    succeed(&mut train(&path, 20));
    let largest = contents(&path).values().map(Vec::len).max().expect("files");
    let mut resume = gambol("resume");
    resume.arg(&path).args(["--no-report", "--generations", "60"]);
    let ended = run_limited(&resume, largest.div_ceil(BLOCK));
    assert_eq!(ended.code, Some(1));
    assert_says(&ended.stderr, &["cannot write ", text(&path)]);
    succeed(&mut resume);
    assert_same_run(&whole, &path);
    Ok(())
}

/// The run itself is whole.
#[test]
fn lines_for_programs_that_cannot_be_written_are_an_error() -> Outcome {
    const LARGEST: usize = 4096;
    let folder = tempfile::tempdir()?;
    let full = folder.path().join("full");
    fs::write(&full, vec![b' '; LARGEST * BLOCK])?;
    let (whole, path) = (folder.path().join("whole"), folder.path().join("run"));
    succeed(&mut small_run(&whole, 4));
    let train = |output: &[&str]| {
        let train = small_run(&path, 4);
        let script = format!("trap '' XFSZ; ulimit -f {LARGEST}; exec \"$@\" >> \"$0\"");
        let mut limited = Command::new("sh");
        run(limited.args(["-c", &script]).arg(&full).arg(train.get_program()).args(train.get_args()).args(output))
    };
    for output in [&["--json"][..], &[]] {
        let ended = train(output);
        assert_eq!(ended.code, Some(1), "{output:?}: {}", ended.stderr);
        assert_says(&ended.stderr, &["File too large"]);
        assert_same_run(&whole, &path);
        fs::remove_dir_all(&path)?;
    }
    Ok(())
}

#[test]
fn a_folder_without_room_for_the_configuration_names_it() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let ended = run_limited(&train(&path, 2), 2);
    assert_eq!(ended.code, Some(1));
    assert_says(&ended.stderr, &["cannot write ", text(&path.join("config.json"))]);
    let left = [".lock", "checkpoint"].map(|name| path.join(name));
    assert!(contents(&path).into_keys().eq(left), "nothing half-written is left");
    // So that the same command can be given again.
    succeed(&mut train(&path, 2));
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
