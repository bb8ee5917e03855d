//! What a program that embeds the traits alone depends on.

use std::{collections::BTreeSet, process::Command};

/// Every crate of `default-features = false`, and why it is there. A crate more is a decision: every program that
/// embeds the traits pays for it.
const ALLOWED: &[(&str, &str)] = &[
    ("ne-core", "this crate"),
    ("rand", "the traits of random generators, by which selectors and plug-ins draw"),
    ("rand_core", "its core"),
    ("rand_chacha", "the generator behind every stream: the same numbers on every platform"),
    ("ppv-lite86", "its arithmetic"),
    ("zerocopy", "the arithmetic's casts"),
    ("serde", "genomes and strategies are data that can be saved"),
    ("serde_core", "its core"),
    ("serde_derive", "its derive macros, at build time"),
    ("thiserror", "typed errors"),
    ("thiserror-impl", "its derive macro, at build time"),
    ("syn", "the macros read Rust, at build time"),
    ("quote", "the macros write Rust, at build time"),
    ("proc-macro2", "the macros' tokens, at build time"),
    ("unicode-ident", "the macros' identifiers, at build time"),
];

#[test]
fn the_traits_alone_depend_on_what_is_written_here() {
    let tree = Command::new(env!("CARGO"))
        .args(["tree", "-p", "ne-core", "--no-default-features", "-e", "normal", "--prefix", "none"])
        .args(["--format", "{p}", "--offline", "--locked"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .expect("cargo runs");
    assert!(tree.status.success(), "{}", String::from_utf8_lossy(&tree.stderr));
    let text = String::from_utf8_lossy(&tree.stdout);
    let found: BTreeSet<&str> = text.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let allowed: BTreeSet<&str> = ALLOWED.iter().map(|(name, _)| *name).collect();
    let (new, gone): (Vec<_>, Vec<_>) = (found.difference(&allowed).collect(), allowed.difference(&found).collect());
    assert!(new.is_empty(), "not on the list: {new:?}");
    assert!(gone.is_empty(), "on the list, but no longer needed: {gone:?}");
}
