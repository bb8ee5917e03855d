//! What is not ours: under which licences, from where, and what is there twice.

use crate::root;
use serde_json::Value;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    process::Command,
};

/// Licences that ask for no more than to be named.
const LICENCES: [&str; 7] = ["MIT", "MIT-0", "Apache-2.0", "BSD-2-Clause", "BSD-3-Clause", "Zlib", "Unicode-3.0"];

/// Tools of tests, which go into no program of ours, and their licences.
const TOOLS: [(&str, &str); 1] = [("cbindgen", "MPL-2.0")];

/// What is there in several versions, since those who use it have not agreed on one yet; how many, at the most.
const SEVERAL_VERSIONS: [(&str, usize); 15] = [
    ("block-buffer", 2),
    ("cpufeatures", 2),
    ("crypto-common", 2),
    ("digest", 2),
    ("foldhash", 2),
    ("getrandom", 2),
    ("glam", 4),
    ("hashbrown", 3),
    ("miniz_oxide", 2),
    ("r-efi", 2),
    ("rand", 2),
    ("rand_chacha", 2),
    ("rand_core", 2),
    ("syn", 2),
    ("winnow", 2),
];

/// Whether a licence expression can be met. Of `AND` and `OR`, `OR` is taken to bind tighter, which never allows more.
fn is_allowed(expression: &str) -> bool {
    let any =
        |choice: &str| choice.replace('/', " OR ").split(" OR ").any(|licence| LICENCES.contains(&licence.trim()));
    expression.replace(['(', ')'], "").split(" AND ").all(any)
}

#[test]
fn licences_are_on_the_list() {
    // Packages of other platforms need not be here; their licences are those of the same projects.
    let host = Command::new("rustc").arg("-vV").output().expect("the compiler runs");
    let host = String::from_utf8(host.stdout).expect("text");
    let host = host.lines().find_map(|line| line.strip_prefix("host: ")).expect("it says for what it compiles");
    let metadata = Command::new(env!("CARGO"))
        .args(["metadata", "--locked", "--filter-platform", host, "--format-version", "1"])
        .current_dir(root())
        .output()
        .expect("cargo runs");
    assert!(metadata.status.success(), "{}", String::from_utf8_lossy(&metadata.stderr));
    let metadata: Value = serde_json::from_slice(&metadata.stdout).expect("cargo writes JSON");
    let packages = metadata["packages"].as_array().expect("a list");
    assert!(packages.len() > 100, "all packages, not ours alone");
    let refused: Vec<String> = packages
        .iter()
        .filter(|package| !package["license"].as_str().is_some_and(is_allowed))
        .filter(|package| {
            !TOOLS.iter().any(|&(name, licence)| package["name"] == name && package["license"] == licence)
        })
        .map(|package| format!("{}: {}", package["name"], package["license"]))
        .collect();
    assert!(refused.is_empty(), "licences that are not on the list: {refused:?}");
}

#[test]
fn licences_are_read_as_they_are_meant() {
    for allowed in ["MIT", "Apache-2.0/MIT", "(MIT OR GPL-3.0) AND Unicode-3.0", "Unlicense OR MIT"] {
        assert!(is_allowed(allowed), "{allowed}");
    }
    for refused in ["GPL-3.0", "MIT AND GPL-3.0", "(MIT OR Apache-2.0) AND MPL-2.0", ""] {
        assert!(!is_allowed(refused), "{refused}");
    }
}

/// The value of a field of a package in the lock file.
fn field<'a>(package: &'a str, name: &str) -> Option<&'a str> {
    package.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(" = \"")?.strip_suffix('"'))
}

#[test]
fn packages_are_ours_or_from_one_registry_and_few_are_there_twice() {
    let lock = fs::read_to_string(root().join("Cargo.lock")).expect("a lock file");
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("a manifest");
    let members = manifest.split("members = [").nth(1).and_then(|rest| rest.split(']').next()).expect("a list");
    let (mut ours, mut sources, mut versions) = (0, BTreeSet::new(), BTreeMap::<&str, usize>::new());
    for package in lock.split("[[package]]").skip(1) {
        let name = field(package, "name").expect("a name");
        match field(package, "source") {
            None => ours += 1,
            Some(source) => {
                assert!(field(package, "checksum").is_some(), "{name} has no checksum");
                sources.insert(source);
            }
        }
        *versions.entry(name).or_default() += 1;
    }
    assert_eq!(ours, members.matches('"').count() / 2, "a package outside the workspace without a source");
    assert!(sources.len() == 1 && sources.iter().all(|source| source.starts_with("registry+")), "{sources:?}");
    let several: Vec<_> = versions.into_iter().filter(|&(_, count)| count > 1).collect();
    assert_eq!(several, SEVERAL_VERSIONS, "versions of one package: cargo tree --duplicates says who wants them");
}
