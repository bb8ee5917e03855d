//! The table of the classic tasks follows from the raw data: `docs/results/classic.csv` from
//! `docs/results/classic/attempts.csv`, which `gambol bench strategies --csv` prints.
//!
//! `GAMBOL_WRITE_TABLES=1 cargo test -p gambol-tests classic` writes the columns that are measured anew; rows and what papers
//! report are written by hand.

use crate::{root, tables::cells};
use std::{env, fs};

const TABLE: &str = "docs/results/classic.csv";
const ATTEMPTS: &str = "docs/results/classic/attempts.csv";

/// One attempt: of which row of the table, which candidates were tested, and what it came to.
struct Attempt {
    row: [String; 2],
    tested: String,
    evaluations: f64,
    is_solved: bool,
    of_625: Option<f64>,
}

fn attempts() -> Vec<Attempt> {
    let text = fs::read_to_string(root().join(ATTEMPTS)).expect("the raw data");
    let attempt = |line: &str| {
        let cells = cells(line);
        let [task, strategy, entrant, tested, _seed, evaluations, solved, _hidden, _connections, of_625] = &cells[..]
        else {
            panic!("{line}: ten cells")
        };
        let preset = entrant.strip_prefix("NeatSettings::").map(|preset| format!("{strategy}, {preset}"));
        Attempt {
            row: [task.replace('-', " "), preset.unwrap_or_else(|| strategy.clone())],
            tested: tested.clone(),
            evaluations: evaluations.parse().expect("a number"),
            is_solved: solved == "true",
            of_625: of_625.parse().ok(),
        }
    };
    text.lines().skip(1).map(attempt).collect()
}

/// A whole number with commas between thousands.
fn grouped(number: f64) -> String {
    let digits = format!("{number:.0}");
    let groups: Vec<&str> =
        digits.as_bytes().rchunks(3).rev().map(|group| str::from_utf8(group).expect("digits")).collect();
    groups.join(",")
}

/// Mean evaluations and how many attempts solved the task, unless all of 50 did; the mean of the starts held.
fn measured(attempts: &[Attempt], row: &[String], tested: &str) -> [String; 2] {
    let mine = || attempts.iter().filter(|attempt| attempt.row == row && attempt.tested == tested);
    let mean = |values: Vec<f64>| {
        let count = values.len();
        (count > 0).then(|| grouped((values.iter().sum::<f64>() / count as f64).round()))
    };
    let (count, solved) = (mine().count(), mine().filter(|attempt| attempt.is_solved).count());
    let evaluations = match mean(mine().map(|attempt| attempt.evaluations).collect()) {
        None => "–".into(),
        Some(mean) if solved == 0 => format!("none of {count} ({mean})"),
        Some(mean) => format!("{mean}, {solved} of {count}"),
    };
    [evaluations, mean(mine().filter_map(|attempt| attempt.of_625).collect()).unwrap_or_else(|| "–".into())]
}

#[test]
fn the_table_follows_from_the_attempts() {
    let attempts = attempts();
    let text = fs::read_to_string(root().join(TABLE)).expect("the table");
    let row = |line: &str| {
        let mut cells = cells(line);
        let [all, _] = measured(&attempts, &cells[..2], "all");
        let [best, of_625] = measured(&attempts, &cells[..2], "best");
        cells.splice(2..5, [all, best, of_625]);
        let quoted = |cell: String| if cell.contains(',') { format!("\"{cell}\"") } else { cell };
        cells.into_iter().map(quoted).collect::<Vec<_>>().join(",")
    };
    let header = text.lines().next().expect("a header").to_owned();
    let rows: Vec<String> = text.lines().skip(1).map(row).collect();
    let expected = format!("{header}\n{}\n", rows.join("\n"));
    if env::var_os("GAMBOL_WRITE_TABLES").is_some() {
        fs::write(root().join(TABLE), expected).expect("it can be written");
    } else {
        assert_eq!(text, expected, "(GAMBOL_WRITE_TABLES=1 writes it anew)");
    }
    for attempt in &attempts {
        assert!(rows.iter().any(|line| cells(line)[..2] == attempt.row), "{:?} is shown", attempt.row);
    }
}

#[test]
fn numbers_are_grouped_by_thousands() {
    assert_eq!([grouped(7.0), grouped(1234.0), grouped(123_456.0)], ["7", "1,234", "123,456"]);
}
