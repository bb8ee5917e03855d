//! The library as programs in C and C++ get it.

use std::{env, error::Error, path::Path, path::PathBuf, process::Command};

pub(crate) type Outcome = Result<(), Box<dyn Error>>;

/// What a program says; an error if it fails.
pub(crate) fn succeed(command: &mut Command) -> Result<String, Box<dyn Error>> {
    let output = command.output()?;
    let said = [output.stdout, output.stderr].concat();
    let said = String::from_utf8_lossy(&said).into_owned();
    if output.status.success() { Ok(said) } else { Err(format!("{command:?}: {said}").into()) }
}

/// The library without Rust's standard library.
pub(crate) fn library() -> Result<PathBuf, Box<dyn Error>> {
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
