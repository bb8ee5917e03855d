//! Builds the studio as a static page into a folder, which any server of files can then serve.
//!
//! ```text
//! rustup target add wasm32-wasip1
//! cargo run --release -p gambol-studio-web --bin build_page -- FOLDER
//! ```

#![allow(clippy::print_stdout, clippy::print_stderr)]

use gambol_runs::Registry;
use std::{
    env,
    error::Error,
    fs,
    path::{Path, PathBuf},
    process::{Command, ExitCode},
};

/// What the worker runs, before the module.
const WORKER: [&str; 6] = [
    MODULE,
    include_str!("../../page/disk.js"),
    include_str!("../../page/wasi.js"),
    include_str!("../../page/store.js"),
    include_str!("../../page/tar.js"),
    include_str!("../../page/host.js"),
];
/// What both do.
const MODULE: &str = include_str!("../../page/module.js");
const HOME: &str = include_str!("../../page/workers.js");

/// The page runs what lies beside it, and asks nothing else of the network.
const POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data: blob:; \
    connect-src 'self'; worker-src 'self'; base-uri 'none'; form-action 'none'";

const TARGET: &str = "wasm32-wasip1";

fn main() -> ExitCode {
    let mut arguments = env::args_os().skip(1);
    let (Some(folder), None) = (arguments.next(), arguments.next()) else {
        eprintln!("usage: build_page FOLDER");
        return ExitCode::from(2);
    };
    match build(Path::new(&folder)) {
        Ok(()) => {
            println!("The page is in {}; any server of files can serve it.", Path::new(&folder).display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn build(folder: &Path) -> Result<(), Box<dyn Error>> {
    let module = module()?;
    fs::create_dir_all(folder)?;
    fs::copy(module, folder.join("studio.wasm"))?;
    let head = "<meta charset=\"utf-8\">";
    let policy = format!("{head}\n<meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">");
    fs::write(folder.join("index.html"), studio::page::PAGE.replacen(head, &policy, 1))?;
    fs::write(folder.join("studio.css"), studio::page::styles())?;
    fs::write(folder.join("schema.json"), gambol_runs::schema::json_schema(&Registry::default()).to_string())?;
    fs::write(folder.join("studio.js"), lean(&studio::page::scripts(&format!("{MODULE}\n{HOME}"))))?;
    fs::write(folder.join("worker.js"), lean(&format!("\"use strict\";\n{}", WORKER.join("\n"))))?;
    Ok(())
}

/// A script without indents, and without lines that are comments: what is sent through a network, and not read.
fn lean(script: &str) -> String {
    let lines = script.lines().map(str::trim_start).filter(|line| !line.is_empty() && !line.starts_with("//"));
    lines.collect::<Vec<_>>().join("\n")
}

/// Builds the module, with the cargo that the variable `GAMBOL_CARGO_WASI` names, or the usual one.
fn module() -> Result<PathBuf, Box<dyn Error>> {
    let cargo = env::var_os("GAMBOL_CARGO_WASI").unwrap_or_else(|| "cargo".into());
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().ok_or("the workspace is not there")?;
    let target = env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), PathBuf::from);
    let status = Command::new(&cargo)
        .current_dir(root)
        .env("CARGO_BUILD_TARGET", TARGET)
        // Not every cargo passes on that the profile strips all names: they would be a fifth of what is loaded.
        .env("RUSTFLAGS", "-C target-feature=+simd128 -C strip=symbols")
        .args([
            "build",
            "--locked",
            "--profile",
            "web",
            "--no-default-features",
            "--lib",
            "--package",
            "gambol-studio-web",
        ])
        .status()
        .map_err(|error| format!("{} cannot be run: {error}", Path::new(&cargo).display()))?;
    if !status.success() {
        return Err(format!("the module was not built; the target is added with: rustup target add {TARGET}").into());
    }
    Ok(target.join(TARGET).join("web/studio_web.wasm"))
}
