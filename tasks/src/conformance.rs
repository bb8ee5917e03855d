//! Checks that plug-in authors run in their own tests, for the contracts of this crate.
