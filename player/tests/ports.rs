//! The players in other languages play the fixtures as this crate does, and refuse what is damaged: `ports/tests` has a
//! program for each. What a machine does not have is skipped.
#![allow(clippy::print_stderr)]

use std::{
    env, fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

const FIXTURES: [&str; 2] = ["all-senses", "playing"];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(name)
}

/// Whether the machine has a program, and says so if it does not.
fn has(program: &str) -> bool {
    let paths = env::var_os("PATH").unwrap_or_default();
    let is_there =
        env::split_paths(&paths).any(|path| path.join(program).with_extension(env::consts::EXE_EXTENSION).is_file());
    if !is_there {
        eprintln!("skipped: no {program} on this machine");
    }
    is_there
}

/// Runs a program and asserts that it succeeds; what it printed.
fn run(command: &mut Command) -> String {
    let Output { status, stdout, stderr } = command.output().expect("the program starts");
    let (stdout, stderr) = (String::from_utf8_lossy(&stdout), String::from_utf8_lossy(&stderr));
    assert!(status.success(), "{command:?}: {status}\n{stdout}\n{stderr}");
    format!("{stdout}\n{stderr}")
}

/// Replays both traces with a program that is given the paths of a character and of its trace.
fn assert_plays(program: impl Fn() -> Command) {
    for name in FIXTURES {
        let file = folder("fixtures").join(format!("{name}.player"));
        let trace = folder("fixtures").join(format!("{name}.trace.csv"));
        let printed = run(program().args([file, trace]));
        // Some interpreters succeed where a program has failed to begin.
        assert!(printed.lines().any(|line| line == "checked"), "{name}: {printed}");
        let line = printed.lines().find(|line| line.starts_with("greatest difference"));
        eprintln!("{name}: {}", line.unwrap_or_default());
    }
}

#[test]
fn javascript() {
    if !has("node") {
        return;
    }
    assert_plays(|| {
        let mut node = Command::new("node");
        node.arg(folder("ports").join("tests").join("check.mjs"));
        node
    });
}

#[test]
fn c_sharp() {
    if !has("mcs") || !has("mono") {
        return;
    }
    let program = Path::new(env!("CARGO_TARGET_TMPDIR")).join("check.exe");
    let sources = [folder("ports").join("GambolPlayer.cs"), folder("ports").join("tests").join("Check.cs")];
    run(Command::new("mcs")
        .args(["-langversion:7", "-warnaserror"])
        .arg(format!("-out:{}", program.display()))
        .args(sources));
    assert_plays(|| {
        let mut mono = Command::new("mono");
        mono.arg(&program);
        mono
    });
}

#[test]
fn gdscript() {
    // Of version 3, for `check.gd` opens files as that does; and a server, for machines without a screen.
    if !has("godot3-server") {
        return;
    }
    // Godot writes into the folder of a project.
    let project = Path::new(env!("CARGO_TARGET_TMPDIR")).join("godot");
    fs::create_dir_all(&project).expect("a folder");
    for file in ["gambol_player.gd", "tests/check.gd"].map(|file| folder("ports").join(file)) {
        fs::copy(&file, project.join(file.file_name().expect("a file"))).expect("a copy");
    }
    assert_plays(|| {
        let mut godot = Command::new("godot3-server");
        godot.arg("--path").arg(&project).args(["--script", "check.gd"]).env("HOME", &project);
        godot
    });
}
