//! Every path the documents name exists, and what should be listed in them is.
//!
//! A path is what stands in backticks and begins with the name of something in the workspace's folder, such as
//! `ne-core/src/lib.rs`, and where a link goes that is not an address, seen from the folder of the document.

use crate::root;
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

/// The documents beside the workspace's manifest, and those in `docs`.
fn documents() -> Vec<PathBuf> {
    let beside = ["README.md", "ARCHITECTURE.md", "CONTRIBUTING.md"].map(|name| root().join(name));
    let in_docs = files(&root().join("docs"), "md");
    assert!(!in_docs.is_empty(), "there are documents in docs");
    beside.into_iter().chain(in_docs).collect()
}

/// The files with this ending in a folder.
fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("a readable folder").path());
    entries.filter(|path| path.extension().is_some_and(|found| found == ending)).collect()
}

/// Names of files and folders beside the workspace's manifest, those of crates included that are gone by now. Where runs
/// go by default is left out: the documents name runs that a reader may make.
fn beginnings() -> BTreeSet<String> {
    let manifest = fs::read_to_string(root().join("Cargo.toml")).expect("there is a manifest");
    let (_, members) = manifest.split_once("members = [").expect("there are members");
    let (members, _) = members.split_once(']').expect("the list ends");
    let members = members.split('"').skip(1).step_by(2).map(str::to_owned);
    let entries = fs::read_dir(root())
        .expect("a folder")
        .map(|entry| entry.expect("a readable folder").file_name().into_string().expect("plain names"));
    members.chain(entries).filter(|name| name != "runs").collect()
}

/// What stands in backticks in a text, blocks of code left out.
fn quoted(text: &str) -> Vec<&str> {
    let mut in_block = false;
    let mut found = Vec::new();
    for line in text.lines() {
        if line.trim_start().starts_with("```") {
            in_block = !in_block;
        } else if !in_block {
            found.extend(line.split('`').skip(1).step_by(2));
        }
    }
    found
}

/// Where the links of a text go, without the section.
fn linked(text: &str) -> impl Iterator<Item = &str> {
    let targets = text.split("](").skip(1).filter_map(|rest| rest.split([')', '#', ' ']).next());
    targets.filter(|target| !target.is_empty() && !target.contains(':'))
}

/// The paths among quoted words. `src/*.rs` stands for its folder.
fn paths<'a>(text: &'a str, beginnings: &BTreeSet<String>) -> Vec<&'a str> {
    let is_path = |word: &&str| {
        let first = word.split('/').next().unwrap_or_default();
        let looks_like_one =
            word.contains('/') || [".rs", ".md", ".json", ".toml"].iter().any(|end| word.ends_with(end));
        looks_like_one && !word.contains(char::is_whitespace) && beginnings.contains(first)
    };
    let folder = |word: &'a str| word.split_once('*').map_or(word, |(before, _)| before);
    quoted(text).into_iter().filter(is_path).map(folder).collect()
}

#[test]
fn every_path_in_the_documents_exists() {
    let beginnings = beginnings();
    let mut missing = Vec::new();
    for document in documents() {
        let text = fs::read_to_string(&document).unwrap_or_else(|error| panic!("{}: {error}", document.display()));
        let quoted = paths(&text, &beginnings).into_iter().map(|path| (path, root().join(path)));
        let linked = linked(&text).map(|path| (path, document.with_file_name(path)));
        let named = quoted.chain(linked).filter(|(_, place)| !place.exists());
        missing.extend(named.map(|(path, _)| format!("{}: {path}", document.display())));
    }
    assert!(missing.is_empty(), "named, but not there:\n{}", missing.join("\n"));
}

/// The name by which a link finds a heading: lower case, hyphens for spaces, no other signs.
fn anchor(heading: &str) -> String {
    let letters = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = |letter: &char| letter.is_alphanumeric() || " -_".contains(*letter);
    letters.chars().filter(kept).map(|letter| if letter == ' ' { '-' } else { letter }).collect()
}

/// Where links to a document can lead: its headings, and places with a name of their own.
fn anchors(text: &str) -> BTreeSet<String> {
    let headings = text.lines().filter(|line| line.starts_with('#')).map(anchor);
    let named = text.split("id=\"").skip(1).filter_map(|rest| rest.split('"').next()).map(str::to_owned);
    headings.chain(named).collect()
}

#[test]
fn every_section_that_a_link_names_exists() {
    let read = |path: &Path| fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let mut missing = Vec::new();
    let mut links = 0;
    for document in documents() {
        let text = read(&document);
        let targets = text.split("](").skip(1).filter_map(|rest| rest.split([')', ' ']).next());
        for (path, section) in targets.filter(|target| !target.contains(':')).filter_map(|link| link.split_once('#')) {
            let target = if path.is_empty() { document.clone() } else { document.with_file_name(path) };
            if target.extension().is_some_and(|ending| ending == "md") {
                links += 1;
                if !anchors(&read(&target)).contains(section) {
                    missing.push(format!("{}: {path}#{section}", document.display()));
                }
            }
        }
    }
    assert!(links >= 30, "only {links} links to sections");
    assert!(missing.is_empty(), "named, but not there:\n{}", missing.join("\n"));
}

#[test]
fn every_example_is_in_the_table_of_the_readme() {
    let readme = fs::read_to_string(root().join("README.md")).expect("it is there");
    let (_, section) = readme.split_once("\n## Examples\n").expect("a section of examples");
    let (section, _) = section.split_once("\n## ").expect("its end");
    let rows = section.lines().filter_map(|line| line.strip_prefix("| `")?.split('`').next());
    let listed: BTreeSet<String> = rows.map(str::to_owned).collect();
    let name = |path: PathBuf| path.file_stem().and_then(|name| name.to_str()).expect("a plain name").to_owned();
    let there: BTreeSet<String> = files(&root().join("examples/examples"), "rs").into_iter().map(name).collect();
    assert_eq!(listed, there);
}

/// The architecture is drawn with the paths of the code; were none found, the test above would promise nothing.
#[test]
fn paths_are_found_where_they_stand() {
    let text = "see `ne-core/src/lib.rs`, `tasks/src/*.rs`, `cargo test -p gambol-tasks`, `config.json`, `f32/f64` and\n\
                ```\n`ne-core/in/a/block`\n```\n[here](docs/x.md#part), [there](https://example.org), [below](#below)";
    assert_eq!(paths(text, &beginnings()), ["ne-core/src/lib.rs", "tasks/src/"]);
    assert_eq!(linked(text).collect::<Vec<_>>(), ["docs/x.md"]);
    assert_eq!(anchor("## What `usable` means, and why"), "what-usable-means-and-why");
    let architecture = fs::read_to_string(root().join("ARCHITECTURE.md")).expect("it is there");
    assert!(paths(&architecture, &beginnings()).len() >= 10, "ARCHITECTURE.md names hardly any path");
}
