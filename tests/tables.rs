//! Tables of results stand in files of their own, `docs/results/*.csv`; what a document shows is what the file says.
//!
//! A table begins below the line `<!-- table: docs/results/NAME.csv -->`. `GAMBOL_WRITE_TABLES=1 cargo test -p gambol-tests tables`
//! writes all of them anew from their files.

use crate::root;
use std::{collections::BTreeSet, env, fs};

const DOCUMENTS: [&str; 6] =
    ["README.md", "docs/gaits.md", "docs/ablation.md", "docs/ppo.md", "docs/strategies.md", "docs/thesis.md"];
const MARK: &str = "<!-- table: ";

/// The cells of a line of CSV; cells with commas stand in quotation marks.
pub(crate) fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut is_quoted) = (vec![String::new()], false);
    for letter in line.chars() {
        match letter {
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(String::new()),
            _ => cells.last_mut().expect("one at least").push(letter),
        }
    }
    cells
}

/// A file as a table of Markdown.
fn table(csv: &str) -> Vec<String> {
    let row = |cells: Vec<String>| format!("| {} |", cells.join(" | "));
    let mut rows: Vec<String> = csv.lines().map(cells).map(row).collect();
    let columns = csv.lines().next().map_or(0, |header| cells(header).len());
    rows.insert(1, format!("|{}", "---|".repeat(columns)));
    rows
}

/// The document with its tables as the files have them, and which files these are.
fn with_tables(text: &str) -> (String, BTreeSet<String>) {
    let (mut written, mut files) = (Vec::new(), BTreeSet::new());
    let mut lines = text.lines().map(str::to_owned).peekable();
    while let Some(line) = lines.next() {
        let named = line.strip_prefix(MARK).and_then(|rest| rest.strip_suffix(" -->")).map(str::to_owned);
        written.push(line);
        let Some(file) = named else { continue };
        while lines.next_if(|line| line.starts_with('|')).is_some() {}
        let csv = fs::read_to_string(root().join(&file)).unwrap_or_else(|error| panic!("{file}: {error}"));
        written.extend(table(&csv));
        files.insert(file);
    }
    (written.join("\n") + "\n", files)
}

#[test]
fn tables_of_results_are_those_of_the_files() {
    let mut shown = BTreeSet::new();
    for document in DOCUMENTS {
        let path = root().join(document);
        let text = fs::read_to_string(&path).expect("a document");
        let (expected, files) = with_tables(&text);
        shown.extend(files);
        if env::var_os("GAMBOL_WRITE_TABLES").is_some() {
            fs::write(&path, &expected).expect("it can be written");
        } else if let Some((line, (found, wanted))) =
            (1..).zip(text.lines().zip(expected.lines())).find(|(_, (found, wanted))| found != wanted)
        {
            panic!(
                "{document}, line {line}: shows\n{found}\nits file says\n{wanted}\n(GAMBOL_WRITE_TABLES=1 writes it anew)"
            );
        }
        assert_eq!(text.lines().count(), expected.lines().count(), "{document}: rows");
    }
    // Folders hold raw data.
    let entries = fs::read_dir(root().join("docs/results")).expect("a folder").map(|entry| entry.expect("an entry"));
    let files = entries.filter(|entry| entry.path().is_file());
    let files = files.map(|entry| format!("docs/results/{}", entry.file_name().to_string_lossy()));
    assert_eq!(files.collect::<BTreeSet<_>>(), shown, "each file is shown, and each table has its file");
}

#[test]
fn a_table_that_differs_from_its_file_is_found() {
    assert_eq!(cells("a,\"b, c\",,d"), ["a", "b, c", "", "d"]);
    assert_eq!(table("a,b\n1,\"2, 3\"\n"), ["| a | b |", "|---|---|", "| 1 | 2, 3 |"]);
    let text = fs::read_to_string(root().join("docs/ablation.md")).expect("a document");
    let spoilt = text.replacen("10/12", "11/12", 1);
    assert_ne!(spoilt, text, "there is such a cell");
    assert_eq!(with_tables(&spoilt).0, text);
}
