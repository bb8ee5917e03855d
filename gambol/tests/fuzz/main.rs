//! Every reader of files is given damaged ones: no panic, nothing that hangs, no memory that grows without end.
//!
//! Inputs begin as the files in `corpus` and are damaged as bytes and as JSON; where a file has digests, most are made to fit
//! again, so that what lies behind them is reached. An input that does harm is saved, and belongs into the corpus.
//!
//! `cargo test -p gambol --test fuzz` takes a few seconds. `GAMBOL_FUZZ_SECONDS=60` gives each reader a minute,
//! `GAMBOL_FUZZ_INPUTS=1000000` a million inputs, `GAMBOL_FUZZ_SEED=7` others than before. `GAMBOL_WRITE_CORPUS=1` writes the
//! corpus anew, which a change of a format asks for.

mod corpus;
mod damage;
mod harness;
mod readers;

use harness::Limits;
use libtest_mimic::{Arguments, Failed, Trial};
use std::process::ExitCode;

fn main() -> ExitCode {
    if std::env::var_os("GAMBOL_WRITE_CORPUS").is_some() {
        corpus::write().expect("the corpus can be written");
    }
    let limits = Limits::from_environment();
    let trials = readers::ALL.iter().flat_map(|reader| {
        let whole = move || -> Result<(), Failed> { Ok(harness::read_corpus(reader)?) };
        let damaged = move || -> Result<(), Failed> { Ok(harness::fuzz(reader, limits)?) };
        [
            Trial::test(format!("{} of the corpus are read", reader.name), whole),
            Trial::test(format!("damaged {}", reader.name), damaged),
        ]
    });
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit_code()
}
