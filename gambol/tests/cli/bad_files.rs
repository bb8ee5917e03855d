//! Files that are missing, empty, folders, or nothing at all: every command names the file, and none panics.

use crate::program::{assert_says, fail, gambol, run, small_run, succeed, text};
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

/// A file that an editor has begun with a byte order mark, a pipe, the name of a folder.
#[cfg(unix)]
#[test]
fn what_is_read_as_it_is_and_what_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let marked = folder.path().join("marked.json");
    fs::write(&marked, "\u{feff}{\"creature\": \"biped-1\", \"movement\": {\"name\": \"running\"}}")?;
    succeed(gambol("check").arg(&marked));
    for command in [&["check"][..], &["gait", "--creature", "biped-1"]] {
        let mut piped = gambol(command[0]);
        piped.args(&command[1..]).arg("/dev/stdin").stdin(std::process::Stdio::piped());
        assert_says(&fail(&mut piped), &["/dev/stdin is a pipe, and is read more than once: give a file"]);
    }
    let run = folder.path().join("run");
    succeed(&mut small_run(&run, 1));
    let message = fail(gambol("export").arg(&run).args(["--to", "svg", "--out"]).arg(folder.path().join("new/")));
    assert_says(&message, &["new/: that is the name of a folder; name a file"]);
    Ok(())
}

#[test]
fn what_the_studio_cannot_open_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("creature.json");
    fs::write(&file, "{}")?;
    let message = fail(gambol("studio").arg("--no-open").arg(&file));
    assert_says(&message, &["creature.json is a file, and the studio opens a run or a shipped creature"]);
    let message = fail(gambol("studio").args(["--no-open", "--runs"]).arg(&file));
    assert_says(&message, &["creature.json: that is a file; name a folder"]);
    Ok(())
}

#[test]
fn a_negative_number_is_out_of_range_and_no_unknown_flag() {
    for arguments in [&["train", "biped-1", "running", "--seed", "-5"][..], &["studio", "--port", "-1"]] {
        let ended = run(gambol(arguments[0]).args(&arguments[1..]));
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        assert_says(&ended.stderr, &["invalid value '-"]);
        assert!(!ended.stderr.contains("-- -"), "{}", ended.stderr);
    }
}
