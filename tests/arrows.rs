//! Arrows point down only: which crate of the workspace may use which.

use crate::root;
use serde_json::Value;
use std::{collections::BTreeSet, process::Command};

/// Each crate and those it may use. Fewer is fine; one more is a change of the architecture, to be drawn there first.
#[rustfmt::skip]
const ARROWS: &[(&str, &[&str])] = &[
    ("gambol-field-path", &[]),
    ("gambol-creatures", &["gambol-field-path"]),
    ("ne-core",         &["gambol-field-path"]),
    ("ne-net",          &["ne-core"]),
    ("ne-fixed",        &["ne-core", "ne-net"]),
    ("ne-statistics",   &["ne-core"]),
    ("gambol-tasks",           &["ne-core"]),
    ("envs-core",       &["ne-core", "gambol-tasks", "gambol-creatures"]),
    ("envs-rapier",     &["ne-core", "gambol-tasks", "gambol-creatures", "envs-core"]),
    ("envs-lanes",      &["ne-core", "ne-net", "gambol-tasks", "gambol-creatures", "envs-core"]),
    ("ne-neat",         &["ne-core", "ne-net"]),
    ("gambol-runs",     &["ne-core", "ne-net", "ne-fixed", "ne-neat", "gambol-tasks", "gambol-creatures", "envs-core", "envs-rapier", "envs-lanes"]),
    ("gambol-reports",  &["ne-core", "ne-net", "ne-neat", "gambol-tasks", "gambol-creatures", "envs-core", "envs-rapier", "gambol-runs"]),
    ("gambol-player",   &["ne-core", "ne-net", "gambol-creatures"]),
    ("gambol-player-c", &["gambol-player"]),
    ("gambol-exports",  &["ne-core", "ne-net", "gambol-tasks", "gambol-creatures", "envs-rapier", "gambol-runs", "gambol-reports", "gambol-player"]),
    ("gambol-studio",   &["ne-core", "ne-net", "gambol-tasks", "gambol-creatures", "envs-core", "envs-rapier", "gambol-runs", "gambol-reports", "gambol-exports"]),
    ("gambol-studio-server", &["gambol-runs", "gambol-studio"]),
    ("gambol-studio-web", &["ne-core", "gambol-runs", "gambol-studio"]),
    ("gambol-experiments", &["ne-core", "ne-net", "ne-fixed", "ne-neat", "ne-statistics", "gambol-tasks", "gambol-creatures", "envs-core", "envs-rapier", "gambol-runs", "gambol-reports"]),
    ("gambol",          &["ne-core", "ne-net", "ne-statistics", "gambol-tasks", "gambol-creatures", "envs-core", "envs-rapier", "envs-lanes", "gambol-runs", "gambol-reports", "gambol-exports", "gambol-experiments", "gambol-studio-server"]),
    // Nothing is built on these; what they use is for their examples and tests.
    ("gambol-examples", &[]),
    ("own-program",     &["gambol", "ne-core", "ne-fixed", "ne-net", "gambol-tasks", "gambol-creatures", "envs-core"]),
    ("gambol-tests",    &[]),
];

/// The one crate that knows the engine.
const PHYSICS: (&str, &str) = ("envs-rapier", "rapier2d");

/// A dependency that a manifest names.
struct Arrow {
    from: String,
    to: String,
    /// Neither for tests and benchmarks nor for a build script.
    is_normal: bool,
}

fn arrows() -> Vec<Arrow> {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--no-deps", "--offline", "--format-version", "1"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let metadata: Value = serde_json::from_slice(&output.stdout).expect("cargo writes JSON");
    let text = |value: &Value| value.as_str().expect("a text").to_owned();
    let list = |value: &Value| value.as_array().expect("a list").clone();
    let packages = list(&metadata["packages"]).into_iter();
    packages
        .flat_map(|package| {
            let from = text(&package["name"]);
            let mut arrows = vec![];
            for dependency in list(&package["dependencies"]) {
                let is_normal = dependency["kind"].is_null();
                arrows.push(Arrow { from: from.clone(), to: text(&dependency["name"]), is_normal });
            }
            assert!(!arrows.is_empty(), "{from} needs nothing at all?");
            arrows
        })
        .collect()
}

#[test]
fn crates_use_only_those_below_them() {
    let arrows = arrows();
    let crates: BTreeSet<&str> = arrows.iter().map(|arrow| &*arrow.from).collect();
    let drawn: BTreeSet<&str> = ARROWS.iter().map(|(name, _)| *name).collect();
    assert_eq!(crates, drawn, "every crate of the workspace has its place in the drawing");
    for Arrow { from, to, .. } in arrows.iter().filter(|arrow| arrow.is_normal && crates.contains(&*arrow.to)) {
        let allowed = ARROWS.iter().any(|(name, below)| name == from && below.contains(&&**to));
        assert!(allowed, "{from} must not depend on {to}: see ARCHITECTURE.md");
    }
}

#[test]
fn one_crate_knows_the_physics_engine() {
    let (knower, engine) = PHYSICS;
    let knowing: BTreeSet<String> =
        arrows().into_iter().filter(|arrow| arrow.to == engine).map(|arrow| arrow.from).collect();
    assert_eq!(knowing, BTreeSet::from([knower.to_owned()]), "another engine must be able to take {engine}'s place");
}
