//! The example for games and the judges, in the engines that are on this machine.
#![allow(clippy::print_stderr)]

mod common;

use common::{Outcome, library, succeed};
use std::{error::Error, fs, path::Path, path::PathBuf, process::Command};

/// An example that is longer is not read.
const MOST_LINES: usize = 60;

fn here() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn character() -> PathBuf {
    here().join("../player/fixtures/playing.player")
}

/// Whether a compiler finds an engine's header.
fn has(compiler: &str, header: &str, folder: &Path) -> Result<bool, Box<dyn Error>> {
    let source = folder.join(format!("{compiler}.cpp"));
    fs::write(&source, format!("#include <{header}>\n"))?;
    let found = Command::new(compiler).arg("-fsyntax-only").arg(&source).output();
    Ok(found.is_ok_and(|output| output.status.success()))
}

fn build(compiler: &str, name: &str, libraries: &[&str], folder: &Path) -> Result<PathBuf, Box<dyn Error>> {
    let program = folder.join(name).with_extension("");
    let mut compile = Command::new(compiler);
    compile.args(["-Wall", "-Wextra", "-Werror", "-O2", "-I"]).arg(here().join("include"));
    compile.arg(here().join("engines").join(name)).arg(library()?).args(libraries).arg("-o").arg(&program);
    succeed(&mut compile)?;
    Ok(program)
}

/// Two seconds of a judge's trajectory: all there, all finite, upright, and off to where it is told to go.
fn check_judge(judge: &Path, law: &str, folder: &Path) -> Outcome {
    let (out, commands) = (folder.join("gait.csv"), folder.join("commands"));
    fs::write(&commands, "0 1 0\n1 1 1\n1.2 1 0\n")?;
    let mut play = Command::new(judge);
    play.arg(character()).arg(&out).arg(format!("commands={}", commands.display()));
    succeed(play.args(["seconds=2", "rate=60", "substeps=4", law]))?;
    let text = fs::read_to_string(&out)?;
    let mut lines = text.lines();
    let columns = lines.next().unwrap_or_default().split(',').count();
    let parts = lines.clone().filter(|line| line.starts_with("0,")).count();
    assert_eq!((columns, lines.clone().count()), (12, (2 * 60 + 1) * parts), "{law}");
    assert!(parts > 1, "{law}");
    for line in lines {
        let fields: Vec<&str> = line.split(',').collect();
        assert_eq!(fields.len(), columns, "{line}");
        for field in fields.iter().enumerate().filter_map(|(column, field)| (column != 2).then_some(field)) {
            assert!(field.parse::<f64>()?.is_finite(), "{line}");
        }
        let (time, told_to_jump): (f64, u8) = (fields[1].parse()?, fields[11].parse()?);
        assert_eq!(told_to_jump, u8::from((1.0..1.199).contains(&time)), "{line}");
    }
    let refused = Command::new(judge).arg(character()).arg(&out).arg("no-such=1").output()?;
    assert_eq!(refused.status.code(), Some(1));
    Ok(())
}

#[test]
fn the_example_is_short() -> Outcome {
    let example = fs::read_to_string(here().join("engines/box2d.cpp"))?;
    let lines = example.lines().count();
    assert!(lines <= MOST_LINES, "{lines} lines");
    let longest = example.lines().map(|line| line.chars().count()).max().unwrap_or(0);
    assert!(longest <= 120, "a line of {longest} characters");
    Ok(())
}

#[cfg(unix)]
#[test]
fn a_character_plays_in_box2d() -> Outcome {
    let folder = tempfile::tempdir()?;
    // Box2D 3 has no such header.
    if !has("g++", "box2d/b2_world.h", folder.path())? {
        eprintln!("skipped: no Box2D on this machine");
        return Ok(());
    }
    let example = build("g++", "box2d.cpp", &["-lbox2d"], folder.path())?;
    let said = succeed(Command::new(&example).arg(character()).args(["2", "1"]))?;
    assert_eq!(said.lines().count(), 5, "{said}");
    assert!(said.starts_with("0.0 s: torso at 0.00 m"), "{said}");
    let judge = build("g++", "judge_box2d.cpp", &["-lbox2d"], folder.path())?;
    ["motor=top", "motor=gain", "motor=torques"].iter().try_for_each(|law| check_judge(&judge, law, folder.path()))
}

#[cfg(unix)]
#[test]
fn a_character_plays_in_chipmunk() -> Outcome {
    let folder = tempfile::tempdir()?;
    if !has("gcc", "chipmunk/chipmunk.h", folder.path())? {
        eprintln!("skipped: no Chipmunk on this machine");
        return Ok(());
    }
    let judge = build("gcc", "judge_chipmunk.c", &["-lchipmunk", "-lm"], folder.path())?;
    ["motor=top", "motor=gain", "motor=torques"].iter().try_for_each(|law| check_judge(&judge, law, folder.path()))
}
