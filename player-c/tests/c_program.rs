//! A C program that plays golden traces to the bit, is small, and gives back all its memory.
#![allow(clippy::print_stderr)]

mod common;
#[path = "common/lopsided.rs"]
mod lopsided;

use common::{Outcome, library, succeed};
use lopsided::lopsided;
use std::{ffi::OsStr, fs, path::Path, process::Command};

/// What the library may add to a program, in bytes.
const LARGEST: u64 = 100_000;

/// For a program that is shipped, and for one whose use of memory is watched.
const SMALL: &[&str] = &["-Os", "-s", "-Wl,--gc-sections"];
const WATCHED: &[&str] = &["-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

fn compile(how: &[&str], source: &Path, program: &Path, libraries: &[&OsStr]) -> Outcome {
    let mut cc = Command::new("cc");
    cc.args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-I"]);
    cc.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("include"))
        .args(how)
        .arg(source)
        .args(libraries)
        .arg("-o")
        .arg(program);
    succeed(&mut cc).map(|_| ())
}

#[cfg(unix)]
#[test]
fn a_c_program_plays_to_the_bit_and_is_small() -> Outcome {
    let (folder, here) = (tempfile::tempdir()?, Path::new(env!("CARGO_MANIFEST_DIR")));
    let (program, empty) = (folder.path().join("check"), folder.path().join("empty"));
    let library = library()?;
    compile(SMALL, &here.join("tests/check.c"), &program, &[library.as_os_str(), OsStr::new("-lm")])?;
    assert_plays(&program)?;
    let nothing = folder.path().join("nothing.c");
    fs::write(&nothing, "#include <stdio.h>\nint main(void) { return printf(\"%g\", 0.0) < 0; }\n")?;
    compile(SMALL, &nothing, &empty, &[])?;
    let added = fs::metadata(&program)?.len() - fs::metadata(&empty)?.len();
    assert!(added <= LARGEST, "the player and the check add {added} bytes to a program");
    Ok(())
}

fn assert_plays(program: &Path) -> Outcome {
    for name in ["all-senses", "playing"] {
        let file =
            |ending: &str| Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../player/fixtures/{name}.{ending}"));
        let said = succeed(Command::new(program).arg(file("player")).arg(file("trace.csv")))?;
        assert_eq!(said, "100 rows to the bit, both ways\n", "{name}");
        let lopsided = lopsided(&file("player"))?;
        let said = succeed(Command::new(program).arg(lopsided.path()).arg(file("trace.csv")))?;
        assert_eq!(said, "100 rows to the bit, one way\n", "{name}");
    }
    Ok(())
}

/// Leaks, memory that is used after it was given back, and what C leaves undefined end this program with a message.
#[cfg(target_os = "linux")]
#[test]
fn memory_is_given_back_and_used_as_it_may_be() -> Outcome {
    let (folder, here) = (tempfile::tempdir()?, Path::new(env!("CARGO_MANIFEST_DIR")));
    let (probe, nothing) = (folder.path().join("probe"), folder.path().join("nothing.c"));
    fs::write(&nothing, "int main(void) { return 0; }\n")?;
    if compile(WATCHED, &nothing, &probe, &[]).is_err() {
        eprintln!("skipped: this compiler has no sanitisers");
        return Ok(());
    }
    let program = folder.path().join("watched");
    compile(WATCHED, &here.join("tests/check.c"), &program, &[library()?.as_os_str(), OsStr::new("-lm")])?;
    assert_plays(&program)
}
