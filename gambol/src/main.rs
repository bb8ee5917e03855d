//! The program: a thin layer over the library. Each command is a file in `commands`.
#![allow(clippy::print_stdout, clippy::print_stderr)]

mod commands;

use clap::Parser;
use std::{io, process::ExitCode};

fn main() -> ExitCode {
    let log = tracing_subscriber::EnvFilter::try_from_env("GAMBOL_LOG").unwrap_or_else(|_| "warn".into());
    tracing_subscriber::fmt().with_env_filter(log).with_writer(std::io::stderr).init();
    match commands::Program::parse().command.run() {
        Ok(code) => code,
        // Whoever read our output has seen enough.
        Err(error)
            if error.downcast_ref::<io::Error>().is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe) =>
        {
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}
