//! A run that is killed and resumed gives the bytes of one that was not.

use crate::{
    folder::assert_same_run,
    program::{fail, gambol, long_run, start_and_read, succeed},
};
use std::{
    fs::OpenOptions,
    io::Write,
    path::{Path, PathBuf},
    process::Command,
    thread,
    time::Duration,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Kills the program once it has told of so many generations; it goes on meanwhile, so that the kill lands anywhere in
/// a generation. With none it is killed as soon as there is a run.
pub(crate) fn kill_after(command: &mut Command, folder: &Path, generations: usize) {
    let (mut child, output) = start_and_read(command, generations);
    while !folder.join("config.json").exists() {
        thread::sleep(Duration::from_millis(1));
    }
    child.kill().expect("it is running");
    let status = child.wait().expect("it was started");
    assert_eq!(status.code(), None, "the run ended before it was killed");
    drop(output);
}

fn resume(folder: &Path) -> Command {
    let mut resume = gambol("resume");
    resume.arg(folder).args(["--threads", "2", "--no-report"]);
    resume
}

/// Runs that were never disturbed, one for each way to write checkpoints.
struct Undisturbed {
    folder: tempfile::TempDir,
}

impl Undisturbed {
    fn run(checkpoint_every: u32) -> Self {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let this = Self { folder };
        succeed(this.train("whole", checkpoint_every).arg("--quiet"));
        this
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn train(&self, name: &str, checkpoint_every: u32) -> Command {
        let mut train = long_run(&self.path(name));
        train.args(["--threads", "1", "--set", &format!("record.checkpoint_every={checkpoint_every}")]);
        train
    }
}

#[test]
fn a_run_killed_at_any_moment_and_resumed_gives_the_same_bytes() {
    for (checkpoint_every, moments) in [(1, &[1, 12][..]), (7, &[0, 5, 14]), (1000, &[0, 40])] {
        let runs = Undisturbed::run(checkpoint_every);
        for moment in moments {
            let name = format!("killed-after-{moment}");
            let path = runs.path(&name);
            kill_after(&mut runs.train(&name, checkpoint_every), &path, *moment);
            succeed(&mut resume(&path));
            assert_same_run(&runs.path("whole"), &path);
        }
    }
}

/// As above, for the engine that steps one creature at a time.
#[test]
fn a_run_in_rapier_that_is_killed_and_resumed_gives_the_same_bytes() {
    let runs = Undisturbed { folder: tempfile::tempdir().expect("a temporary folder") };
    for variation in ["none", "light"] {
        let rapier = ["--engine", "rapier", "--variation", variation];
        let [whole, killed] = ["whole", "killed"].map(|name| format!("{name}-{variation}"));
        succeed(runs.train(&whole, 7).args(rapier).arg("--quiet"));
        kill_after(runs.train(&killed, 7).args(rapier), &runs.path(&killed), 12);
        succeed(&mut resume(&runs.path(&killed)));
        assert_same_run(&runs.path(&whole), &runs.path(&killed));
    }
}

#[test]
fn a_run_killed_twice_and_resumed_twice_gives_the_same_bytes() {
    let runs = Undisturbed::run(3);
    let path = runs.path("killed");
    kill_after(&mut runs.train("killed", 3), &path, 10);
    kill_after(&mut resume(&path), &path, 10);
    succeed(&mut resume(&path));
    assert_same_run(&runs.path("whole"), &path);
}

#[test]
fn half_written_lines_of_a_killed_run_are_dropped() -> Outcome {
    let runs = Undisturbed::run(5);
    let path = runs.path("killed");
    kill_after(&mut runs.train("killed", 5), &path, 12);
    // Whatever was on its way to the disk: half a line, a block of zeros, nothing that is a line at all.
    for (name, rest) in
        [("log.jsonl", &b"{\"generation\":13,\"eval"[..]), ("gallery.jsonl", &[0; 512]), ("timing.jsonl", b"\xff\n\n")]
    {
        OpenOptions::new().append(true).open(path.join(name))?.write_all(rest)?;
    }
    succeed(&mut resume(&path));
    assert_same_run(&runs.path("whole"), &path);
    Ok(())
}

/// The report looks at a run while it goes on, or where it was killed.
#[test]
fn a_killed_run_can_be_reported() {
    let runs = Undisturbed::run(5);
    let path = runs.path("killed");
    kill_after(&mut runs.train("killed", 5), &path, 12);
    succeed(gambol("report").arg(&path));
    assert!(path.join("report.html").is_file());
}

/// Where a checkpoint was and is no more there is nothing to resume: the message says so.
#[test]
fn a_folder_without_a_checkpoint_cannot_be_resumed() -> Outcome {
    let runs = Undisturbed::run(1000);
    let path = runs.path("whole");
    std::fs::remove_file(path.join("checkpoint"))?;
    assert!(fail(&mut resume(&path)).contains("it has no checkpoint"));
    Ok(())
}
