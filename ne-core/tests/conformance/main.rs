//! The conformance kit passes what is right, and names the promise that a deliberately broken implementation breaks.
#![cfg(feature = "evolution")]

#[path = "../common/mod.rs"]
mod common;
mod genomes;
mod good;
mod phenotypes;
mod promises;
mod selectors;
mod strategies;
mod tasks;

use ne_core::conformance::{Promise, Violation};

/// Broken implementations: the promise each breaks, which it is, and how the check judges it.
type Cases<'a> = Vec<(Promise, &'a str, Result<(), Violation>)>;

/// Every case is said to break its promise, and every promise is broken by at least one.
fn assert_caught(cases: &Cases<'_>, promises: &[Promise]) {
    for (promise, name, result) in cases {
        match result {
            Ok(()) => panic!("{name}: not caught"),
            Err(violation) => assert_eq!(violation.promise, *promise, "{name}: {violation}"),
        }
    }
    for promise in promises {
        assert!(cases.iter().any(|(broken, ..)| broken == promise), "no case breaks {promise:?}");
    }
}
