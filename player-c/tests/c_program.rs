//! A C program that plays golden traces to the bit, and is small.

use std::{env, error::Error, ffi::OsStr, fs, path::Path, path::PathBuf, process::Command};

type Outcome = Result<(), Box<dyn Error>>;

/// What the library may add to a program, in bytes.
const LARGEST: u64 = 100_000;

fn succeed(command: &mut Command) -> Result<String, Box<dyn Error>> {
    let output = command.output()?;
    let said = [output.stdout, output.stderr].concat();
    let said = String::from_utf8_lossy(&said).into_owned();
    if output.status.success() { Ok(said) } else { Err(format!("{command:?}: {said}").into()) }
}

/// The library without Rust's standard library.
fn library() -> Result<PathBuf, Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("freestanding");
    let mut cargo = Command::new(env::var_os("CARGO").unwrap_or("cargo".into()));
    cargo.args([
        "build",
        "--package",
        "gambol-player-c",
        "--profile",
        "player",
        "--locked",
        "--offline",
        "--target-dir",
    ]);
    cargo.arg(&folder).env("RUSTFLAGS", "--cfg gambol_freestanding").env_remove("CARGO_ENCODED_RUSTFLAGS");
    succeed(cargo.current_dir(env!("CARGO_MANIFEST_DIR")))?;
    Ok(folder.join("player/libgambol_player.a"))
}

fn compile(source: &Path, program: &Path, libraries: &[&OsStr]) -> Outcome {
    let mut cc = Command::new("cc");
    cc.args(["-std=c11", "-Wall", "-Wextra", "-Werror", "-Os", "-s", "-Wl,--gc-sections", "-I"]);
    cc.arg(Path::new(env!("CARGO_MANIFEST_DIR")).join("include")).arg(source).args(libraries).arg("-o").arg(program);
    succeed(&mut cc).map(|_| ())
}

#[cfg(unix)]
#[test]
fn a_c_program_plays_to_the_bit_and_is_small() -> Outcome {
    let (folder, here) = (tempfile::tempdir()?, Path::new(env!("CARGO_MANIFEST_DIR")));
    let (program, empty) = (folder.path().join("check"), folder.path().join("empty"));
    let library = library()?;
    compile(&here.join("tests/check.c"), &program, &[library.as_os_str(), OsStr::new("-lm")])?;
    for name in ["all-senses", "playing"] {
        let file = |ending: &str| here.join(format!("../player/fixtures/{name}.{ending}"));
        let said = succeed(Command::new(&program).arg(file("player")).arg(file("trace.csv")))?;
        assert_eq!(said, "100 rows to the bit\n", "{name}");
    }
    let nothing = folder.path().join("nothing.c");
    fs::write(&nothing, "#include <stdio.h>\nint main(void) { return printf(\"%g\", 0.0) < 0; }\n")?;
    compile(&nothing, &empty, &[])?;
    let added = fs::metadata(&program)?.len() - fs::metadata(&empty)?.len();
    assert!(added <= LARGEST, "the player and the check add {added} bytes to a program");
    Ok(())
}
