//! The checks pass what is right, and name the promise that a deliberately broken implementation breaks.

#[path = "../common/mod.rs"]
mod common;
mod environments;
mod good;
mod movements;
mod rules;

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
