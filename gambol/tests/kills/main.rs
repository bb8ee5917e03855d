//! A run that is killed at any of its writes, and then gone on with, ends with the bytes of one that was not.
//!
//! A counter in the writers says where it is killed, so that every write has its turn: before a temporary file is made,
//! between it and its renaming, before its folder is flushed, in the middle of each line, before each folder.
//!
//! `cargo test -p gambol --test kills`; all of it with `-- --include-ignored`.

mod cases;
mod mortal;
mod runs;

use libtest_mimic::{Arguments, Trial};
use std::process::ExitCode;

fn main() -> ExitCode {
    if let Some(fate) = mortal::fate() {
        return mortal::live(fate);
    }
    let trials = cases::ALL.iter().map(|case| {
        let run = || -> Result<(), libtest_mimic::Failed> { Ok(runs::die_everywhere(case)?) };
        Trial::test(case.name, run).with_ignored_flag(case.takes_long)
    });
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit_code()
}
