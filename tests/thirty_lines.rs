//! A movement of one's own, its training, report and verification included, is thirty lines of code.

use crate::root;
use std::fs;

/// The lines of code of a program: not blank, not a comment, not an import.
fn lines_of_code(program: &str) -> usize {
    let mut importing = false;
    let mut count = 0;
    for line in program.lines().map(str::trim) {
        importing |= line.starts_with("use ");
        if !(importing || line.is_empty() || line.starts_with("//")) {
            count += 1;
        }
        importing &= !line.ends_with(';');
    }
    count
}

#[test]
fn a_movement_of_ones_own_is_thirty_lines() {
    let path = root().join("examples/examples/custom_movement.rs");
    let program = fs::read_to_string(&path).expect("the example is there");
    // What is counted is the whole of it.
    for part in ["impl Movement for ", "check_movement(", "train_and_verify(", "fn main("] {
        assert!(program.contains(part), "{} has no `{part}`", path.display());
    }
    let lines = lines_of_code(&program);
    assert!((10..=30).contains(&lines), "{} has {lines} lines of code", path.display());
}

#[test]
fn what_is_no_code_is_not_counted() {
    let program = "//! A program.\n\nuse std::{\n    fs,\n    io,\n};\nuse a::b;\n\n/// The end.\nfn main() {\n    // Nothing.\n    f(); // Why.\n}\n";
    assert_eq!(lines_of_code(program), 3);
}
