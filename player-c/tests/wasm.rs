//! The player as a WebAssembly module, in Node and in a browser: the same bits, and small.
//!
//! Needs a cargo that builds for wasm32-unknown-unknown: the usual one if it has the target, or the one that
//! `GAMBOL_CARGO_WASM` names.
#![allow(clippy::print_stderr)]

#[path = "common/lopsided.rs"]
mod lopsided;

use lopsided::lopsided;
use std::{env, error::Error, fs, path::Path, path::PathBuf, process::Command};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Bytes.
const LARGEST: u64 = 150_000;

fn succeed(command: &mut Command) -> Result<String> {
    let output = command.output()?;
    match output.status.success() {
        true => Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        false => Err(format!("{command:?}: {}", String::from_utf8_lossy(&output.stderr)).into()),
    }
}

fn is_there(program: &str) -> bool {
    Command::new(program).arg("--version").output().is_ok_and(|output| output.status.success())
}

fn has_target() -> Result<bool> {
    let sysroot = succeed(Command::new("rustc").args(["--print", "sysroot"]))?;
    Ok(Path::new(sysroot.trim()).join("lib/rustlib/wasm32-unknown-unknown").is_dir())
}

/// The module; `None` where it cannot be built.
fn module() -> Result<Option<PathBuf>> {
    let named = env::var("GAMBOL_CARGO_WASM").ok();
    if named.is_none() && !has_target()? {
        eprintln!(
            "skipped: no target wasm32-unknown-unknown here; add it with: rustup target add wasm32-unknown-unknown"
        );
        return Ok(None);
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("wasm");
    let mut cargo = Command::new(named.unwrap_or("cargo".into()));
    cargo.args(["build", "--package", "gambol-player-c", "--profile", "player", "--locked", "--target-dir"]);
    cargo.arg(&folder).env("CARGO_BUILD_TARGET", "wasm32-unknown-unknown");
    // Of the toolchain that runs this test.
    for name in ["CARGO", "RUSTC", "RUSTUP_TOOLCHAIN", "LD_LIBRARY_PATH"] {
        cargo.env_remove(name);
    }
    succeed(cargo.current_dir(env!("CARGO_MANIFEST_DIR")))?;
    Ok(Some(folder.join("wasm32-unknown-unknown/player/gambol_player.wasm")))
}

fn file(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn fixture(name: &str, ending: &str) -> PathBuf {
    file(&format!("../player/fixtures/{name}.{ending}"))
}

#[test]
#[ignore = "builds the standard library for WebAssembly: see .ci/long"]
fn a_module_plays_to_the_bit_in_node_and_in_a_browser_and_is_small() -> Result<()> {
    let Some(module) = module()? else { return Ok(()) };
    let bytes = fs::metadata(&module)?.len();
    assert!(bytes <= LARGEST, "{bytes} bytes");
    match is_there("node") {
        true => in_node(&module)?,
        false => eprintln!("skipped: there is no Node"),
    }
    match is_there("chromium") {
        true => in_browser(&module)?,
        false => eprintln!("skipped: there is no Chromium"),
    }
    Ok(())
}

fn in_node(module: &Path) -> Result<()> {
    for name in ["all-senses", "playing"] {
        let mut node = Command::new("node");
        node.arg(file("wasm/check.mjs")).arg(module).arg(fixture(name, "player")).arg(fixture(name, "trace.csv"));
        assert_eq!(succeed(&mut node)?, "100 rows to the bit, both ways\n", "{name}");
        let lopsided = lopsided(&fixture(name, "player"))?;
        let mut node = Command::new("node");
        node.arg(file("wasm/check.mjs")).arg(module).arg(lopsided.path()).arg(fixture(name, "trace.csv"));
        assert_eq!(succeed(&mut node)?, "100 rows to the bit, one way\n", "{name}");
    }
    Ok(())
}

/// A page that has everything in it, since a browser loads no modules from files.
fn in_browser(module: &Path) -> Result<()> {
    let folder = tempfile::tempdir()?;
    for name in ["all-senses", "playing"] {
        let front = fs::read_to_string(file("wasm/gambol-player-wasm.js"))?.replace("export ", "");
        let check = fs::read_to_string(file("wasm/check.mjs"))?;
        let check = check.replace("import { load } from \"./gambol-player-wasm.js\";", "").replace("export ", "");
        let bytes = |path: &Path| Ok::<_, Box<dyn Error>>(format!("new Uint8Array({:?})", fs::read(path)?));
        let (module, player) = (bytes(module)?, bytes(&fixture(name, "player"))?);
        let trace = fs::read_to_string(fixture(name, "trace.csv"))?;
        let page = format!(
            "<!doctype html><title>check</title><p id=said></p><script type=module>{front}\n{check}\n\
             const say = (text) => document.getElementById('said').textContent = text;\n\
             check({module}, {player}, {trace:?}).then(say, say);</script>"
        );
        let path = folder.path().join(format!("{name}.html"));
        fs::write(&path, page)?;
        // On a busy machine the time that a page is given can be over before the module is compiled, and nothing was said yet.
        let mut shown = String::new();
        for _ in 0..5 {
            let mut chromium = Command::new("chromium");
            chromium.args(["--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=10000", "--dump-dom"]);
            shown = succeed(chromium.arg(format!("--user-data-dir={}", folder.path().display())).arg(&path))?;
            if !shown.contains("<p id=\"said\"></p>") {
                break;
            }
        }
        let said = shown.split_once("<p id=\"said\">").map_or("", |(_, rest)| rest);
        let said = said.split_once("</p>").map_or(said, |(said, _)| said);
        assert_eq!(said, "100 rows to the bit, both ways", "{name}");
    }
    Ok(())
}
