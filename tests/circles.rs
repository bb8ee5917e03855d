//! Modules of a crate form no circle: each can be understood from those below it.

use crate::root;
use std::{
    collections::{BTreeMap, BTreeSet},
    fs,
    path::{Path, PathBuf},
};

/// The crates of the workspace that have modules. A module is a file or a folder beside `lib.rs`.
fn crates() -> Vec<String> {
    let entries = fs::read_dir(root()).expect("a folder").map(|entry| entry.expect("an entry").path());
    let crates = entries.filter(|path| path.join("src/lib.rs").is_file());
    let mut crates: Vec<String> =
        crates.map(|path| path.file_name().expect("a name").to_string_lossy().into_owned()).collect();
    crates.sort();
    crates
}

/// Which module imports which.
type Imports = BTreeMap<String, BTreeSet<String>>;

fn rust_files(path: &Path) -> Vec<PathBuf> {
    if path.is_file() {
        return vec![path.into()];
    }
    let entries = fs::read_dir(path).expect("a folder").map(|entry| entry.expect("an entry").path());
    entries.flat_map(|entry| rust_files(&entry)).filter(|file| file.extension().is_some_and(|it| it == "rs")).collect()
}

/// The text without comments and without the tests at its end.
fn code(file: &Path) -> String {
    let text = fs::read_to_string(file).expect("a source file");
    let tests = ["#[cfg(test)]\nmod tests {", "#[cfg(test)]\npub(crate) mod tests {"];
    let product = tests.iter().fold(&text[..], |text, tests| text.split(tests).next().unwrap_or_default());
    product.lines().map(|line| line.split("//").next().unwrap_or_default()).collect::<Vec<_>>().join("\n")
}

/// The first names behind every `prefix`, also of a list in braces: `crate::{a::B, c}` names a and c.
fn first_names(code: &str, prefix: &str) -> BTreeSet<String> {
    let mut names = BTreeSet::new();
    for (place, _) in code.match_indices(prefix) {
        let rest = &code[place + prefix.len()..];
        if !rest.starts_with('{') {
            names.insert(rest.chars().take_while(|letter| letter.is_alphanumeric() || *letter == '_').collect());
            continue;
        }
        let (mut depth, mut item) = (0, String::new());
        for letter in rest.chars() {
            match letter {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 1 => {
                    names.insert(std::mem::take(&mut item));
                    continue;
                }
                _ => {}
            }
            if depth == 0 {
                names.insert(item);
                break;
            }
            if depth == 1 && letter != '{' && letter != '}' {
                item.push(letter);
            }
        }
    }
    let first = |name: String| name.trim().split("::").next().unwrap_or_default().trim().to_owned();
    names.into_iter().map(first).filter(|name| !name.is_empty()).collect()
}

/// The modules of a crate and what they import of each other. What `lib.rs` exports counts for the module it is from.
fn imports(krate: &str) -> Imports {
    let source = root().join(krate).join("src");
    let mut modules: BTreeMap<String, Vec<PathBuf>> = BTreeMap::new();
    for entry in fs::read_dir(&source).expect("a crate has sources") {
        let path = entry.expect("an entry").path();
        let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
        if name != "lib" && name != "main" {
            let is_test = |file: &PathBuf| ["tests.rs", "testing.rs"].iter().any(|name| file.ends_with(name));
            modules.entry(name).or_default().extend(rust_files(&path).into_iter().filter(|file| !is_test(file)));
        }
    }
    let mut exported: BTreeMap<String, String> = BTreeMap::new();
    let front = code(&source.join("lib.rs"));
    for statement in front.split(';').filter_map(|statement| statement.split("use ").nth(1)) {
        let (module, what) = statement.split_once("::").unwrap_or((statement, ""));
        for name in what.split(|letter: char| !(letter.is_alphanumeric() || letter == '_')) {
            exported.insert(name.into(), module.trim().into());
        }
    }
    let of_file = |file: &PathBuf| {
        let code = code(file);
        let is_top = file.parent() == Some(&source);
        let beside = if is_top { first_names(&code, "super::") } else { BTreeSet::new() };
        first_names(&code, "crate::").into_iter().chain(beside).collect::<Vec<_>>()
    };
    let known: BTreeSet<String> = modules.keys().cloned().collect();
    let module = |name: String| exported.get(&name).filter(|_| !known.contains(&name)).cloned().unwrap_or(name);
    let of_module = |(name, files): (&String, &Vec<PathBuf>)| {
        let named = files.iter().flat_map(of_file).map(module);
        (name.clone(), named.filter(|other| known.contains(other) && other != name).collect())
    };
    modules.iter().map(of_module).collect()
}

/// The modules that import themselves by way of others.
fn in_circles(imports: &Imports) -> BTreeSet<String> {
    let reaches = |start: &String| {
        let (mut seen, mut open) = (BTreeSet::new(), vec![start]);
        while let Some(module) = open.pop() {
            open.extend(imports[module].iter().filter(|next| seen.insert((*next).clone())));
        }
        seen.contains(start)
    };
    imports.keys().filter(|module| reaches(module)).cloned().collect()
}

#[test]
fn modules_form_no_circles() {
    let crates = crates();
    assert!(crates.len() >= 14, "{crates:?}");
    for krate in crates {
        let found = in_circles(&imports(&krate));
        assert!(found.is_empty(), "{krate}: a circle goes through {found:?}");
    }
}

#[test]
fn circles_are_found() {
    let code = "use crate::{a::{B, c::D}, e, F as G}; use super::{self, h}; fn f() { crate::i::j() }";
    let names = |prefix| first_names(code, prefix).into_iter().collect::<Vec<_>>().join(" ");
    assert_eq!(names("crate::"), "F as G a e i");
    let to = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect::<BTreeSet<_>>();
    let imports = [("a", to(&["b"])), ("b", to(&["c"])), ("c", to(&["a", "d"])), ("d", to(&[]))];
    let imports: Imports = imports.into_iter().map(|(name, others)| (name.to_owned(), others)).collect();
    assert_eq!(in_circles(&imports), to(&["a", "b", "c"]));
}
