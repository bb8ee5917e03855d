//! Files that are missing, empty, folders, or nothing at all: every command names the file, and none panics.

use crate::program::{assert_says, fail, gambol, text};
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Every way to hand the program a file to read.
fn readers(file: &Path) -> [Command; 6] {
    let with = |arguments: &[&str]| {
        let mut command = gambol(arguments[0]);
        command.args(&arguments[1..]);
        command
    };
    let file = text(file);
    [
        with(&["train", file, "running"]),
        with(&["train", "biped-1", "running", "--config", file]),
        with(&["check", file]),
        with(&["verify", file]),
        with(&["replay", file]),
        with(&["replay", file, "--seconds", "1"]),
    ]
}

#[test]
fn a_file_that_cannot_be_read_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let directory = folder.path().join("folder.json");
    fs::create_dir(&directory)?;
    let missing = folder.path().join("missing.json");
    for mut reader in readers(&missing) {
        assert_says(&fail(&mut reader), &["cannot read", text(&missing), "No such file"]);
    }
    // A champion may be named by the folder of its run.
    let [files @ .., verify, replay, play] = readers(&directory);
    for mut reader in files {
        assert_says(&fail(&mut reader), &["cannot read", text(&directory), "directory"]);
    }
    for mut reader in [verify, replay, play] {
        assert_says(&fail(&mut reader), &[text(&directory), "is not the folder of a run"]);
    }
    Ok(())
}

#[test]
fn a_file_that_is_not_json_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    // Bytes as a generator of random numbers gives them; the first is no beginning of JSON.
    let noise: Vec<u8> = (0..4096u64).map(|i| (i.wrapping_mul(6_364_136_223_846_793_005) >> 32) as u8 | 0x80).collect();
    let deep = "[".repeat(100_000);
    for (name, content) in [
        ("empty.json", &b""[..]),
        ("space.json", b" \n\n "),
        ("noise.json", &noise),
        ("zeros.json", &[0; 1000]),
        ("deep.json", deep.as_bytes()),
        ("picture.json", b"\x89PNG\r\n\x1a\n"),
        ("half.json", b"{\"format\": \"gambol cre"),
        ("text.json", b"once upon a time"),
        ("two.json", b"{} {}"),
    ] {
        let file = folder.path().join(name);
        fs::write(&file, content)?;
        for mut reader in readers(&file) {
            assert_says(&fail(reader.current_dir(folder.path())), &[text(&file)]);
        }
    }
    Ok(())
}

#[test]
fn json_of_another_kind_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("other.json");
    for content in ["null", "7", "\"text\"", "[]", "{\"format\": 3}", "{\"format\": \"gltf\", \"version\": 1}"] {
        fs::write(&file, content)?;
        for mut reader in readers(&file) {
            assert_says(&fail(reader.current_dir(folder.path())), &[text(&file)]);
        }
    }
    Ok(())
}
