//! Starting the program.

use std::{
    ffi::OsStr,
    io::{BufRead, BufReader},
    path::Path,
    process::{Child, ChildStdout, Command, Output, Stdio},
};

/// A command of the program, to which arguments can be added.
pub(crate) fn gambol(command: &str) -> Command {
    let mut program = Command::new(env!("CARGO_BIN_EXE_gambol"));
    program.arg(command).env_remove("GAMBOL_LOG").stdin(Stdio::null());
    program
}

/// `train biped-1 running` with episodes and a population so small that a generation takes milliseconds.
pub(crate) fn small_run(folder: &Path, generations: u32) -> Command {
    small_run_of("biped-1", "running", folder, generations)
}

/// As [`small_run`], for any creature and movement.
pub(crate) fn small_run_of(creature: &str, movement: &str, folder: &Path, generations: u32) -> Command {
    let mut train = gambol("train");
    train.args([creature, movement, "--population", "8", "--set", "movement.steps=60", "--no-report"]);
    train.arg("--generations").arg(generations.to_string()).arg("--out").arg(folder);
    train
}

/// Flags of a run without a champion selection: what is found in training is what is found.
pub(crate) const WITHOUT_SELECTION: [&str; 4] = ["--variation", "none", "--set", "training_steps=null"];

/// The generations of a [`long_run`].
pub(crate) const LONG: usize = 200;

/// A run of tiny generations, for tests that stop a run which is under way.
///
/// With `--json` and its output in a pipe without a reader, it cannot end: a pipe holds 64 KiB, about a hundred lines.
/// So a test that has read up to forty lines knows that the run is still there, however slow the machine.
pub(crate) fn long_run(folder: &Path) -> Command {
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--population", "4", "--set", "movement.steps=20", "--no-report"]);
    train.arg("--generations").arg(LONG.to_string()).arg("--out").arg(folder);
    train
}

/// Starts a command that prints a line a generation, and reads so many of them.
pub(crate) fn start_and_read(command: &mut Command, lines: usize) -> (Child, BufReader<ChildStdout>) {
    let mut child = command.arg("--json").stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().expect("it starts");
    let mut output = BufReader::new(child.stdout.take().expect("a pipe"));
    let mut line = String::new();
    for _ in 0..lines {
        line.clear();
        output.read_line(&mut line).expect("text");
        assert!(line.starts_with("{\"generation\":"), "{line}");
    }
    (child, output)
}

/// Starts a command and lets it go on, unheard.
pub(crate) fn start(command: &mut Command) -> Child {
    command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("it starts")
}

/// What a command that has ended left behind.
#[derive(Debug)]
pub(crate) struct Ended {
    /// `None` if a signal ended it.
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
}

impl From<Output> for Ended {
    fn from(output: Output) -> Self {
        let ended = Self {
            code: output.status.code(),
            stdout: String::from_utf8(output.stdout).expect("the program writes UTF-8"),
            stderr: String::from_utf8(output.stderr).expect("the program writes UTF-8"),
        };
        assert!(!ended.stderr.contains("panicked"), "{}", ended.stderr);
        ended
    }
}

/// Runs a command to its end, whatever that is. No command may panic.
pub(crate) fn run(command: &mut Command) -> Ended {
    command.output().expect("the program starts").into()
}

/// Runs a command that must succeed; returns what it printed.
pub(crate) fn succeed(command: &mut Command) -> String {
    let ended = run(command);
    assert_eq!(ended.code, Some(0), "{command:?} failed:\n{}{}", ended.stdout, ended.stderr);
    ended.stdout
}

/// Runs a command that must end with exit code 1 and an error message; returns the message.
pub(crate) fn fail(command: &mut Command) -> String {
    let ended = run(command);
    assert_eq!(ended.code, Some(1), "{command:?}:\n{}{}", ended.stdout, ended.stderr);
    assert!(ended.stderr.contains("error: "), "{command:?} gives no reason: {}", ended.stderr);
    ended.stderr
}

/// The message must say all of this.
#[track_caller]
pub(crate) fn assert_says(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "{message:?} does not say {part:?}");
    }
}

/// A path as it stands in messages.
pub(crate) fn text(path: &(impl AsRef<OsStr> + ?Sized)) -> &str {
    path.as_ref().to_str().expect("temporary folders have plain names")
}
