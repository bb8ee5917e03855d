//! `export`: a champion as files for games and other programs.

use crate::program::{WITHOUT_SELECTION, assert_says, fail, gambol, small_run_of, succeed, text};
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn export(champion: &Path, format: &str, out: &Path, more: &[&str]) -> Command {
    let mut export = gambol("export");
    export.arg(champion).args(["--to", format]).arg("--out").arg(out).args(more);
    export
}

#[test]
fn a_champion_is_exported_to_every_format_and_nothing_is_overwritten() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    let mut train = gambol("train");
    train.args(["tetrapod-2", "running", "--until", "usable", "--quiet", "--no-report", "--out"]).arg(&run);
    succeed(&mut train);
    for (format, begins) in [
        ("player", &b"GAMBOLPL"[..]),
        ("trace", b"step,seconds,commanded_speed,jump,part0.x"),
        ("csv", b"step,time_s,part"),
        ("gif", b"GIF89a"),
        ("apng", b"\x89PNG\r\n\x1a\n"),
        ("svg", b"<svg "),
        ("gltf", b"{"),
        ("dragonbones", b"{"),
        ("onnx", b""),
    ] {
        let out = folder.path().join(format);
        assert_says(&succeed(&mut export(&run, format, &out, &[])), &[format, text(&out), " bytes"]);
        let bytes = fs::read(&out)?;
        assert!(bytes.starts_with(begins) && bytes.len() > 1000, "{format}");
        assert_says(&fail(&mut export(&run, format, &out, &[])), &[text(&out), "exists; say --force"]);
        // The champion's file gives the same, every time.
        succeed(&mut export(&run.join("champion.json"), format, &out, &["--force"]));
        assert!(fs::read(&out)? == bytes, "{format}");
    }
    let (atlas, sheet) = (folder.path().join("sheet.json"), folder.path().join("sheet.png"));
    assert_says(&succeed(&mut export(&run, "sprites", &atlas, &["--rate", "8"])), &[text(&atlas), text(&sheet)]);
    assert!(fs::read_to_string(&atlas)?.contains("\"image\": \"sheet.png\"") && sheet.exists());
    fs::remove_file(&atlas)?;
    assert_says(&fail(&mut export(&run, "sprites", &atlas, &[])), &[text(&sheet), "exists; say --force"]);
    assert!(!atlas.exists());
    let same = folder.path().join("same.png");
    assert_says(
        &fail(&mut export(&run, "sprites", &same, &[])),
        &["must not be called like the file beside it; .json is usual"],
    );
    character_for_dragonbones(&run, folder.path())
}

/// Three files that find each other by their names.
fn character_for_dragonbones(run: &Path, folder: &Path) -> Outcome {
    let file = |name: &str| folder.join(name);
    let (skeleton, atlas, sheet) = (file("hero_ske.json"), file("hero_tex.json"), file("hero_tex.png"));
    fs::create_dir(&sheet)?;
    let said = fail(&mut export(run, "dragonbones", &skeleton, &["--force"]));
    assert_says(&said, &["cannot write", text(&sheet), "it is a folder"]);
    fs::remove_dir(&sheet)?;
    fs::write(&sheet, "mine")?;
    let said = fail(&mut export(run, "dragonbones", &skeleton, &[]));
    assert_says(&said, &[text(&sheet), "exists; say --force"]);
    assert!(!skeleton.exists() && !atlas.exists() && fs::read_to_string(&sheet)? == "mine");
    let said = succeed(&mut export(run, "dragonbones", &skeleton, &["--force", "--size", "500"]));
    assert_says(&said, &[text(&skeleton), text(&atlas), text(&sheet)]);
    assert!(fs::read(&sheet)?.starts_with(b"\x89PNG"));
    assert!(fs::read_to_string(&atlas)?.contains("\"imagePath\":\"hero_tex.png\""));
    assert!(fs::read_to_string(&skeleton)?.contains("\"armature\""));
    let mut in_folder = gambol("export");
    in_folder.current_dir(folder).arg(run).args(["--to", "dragonbones"]);
    succeed(&mut in_folder);
    for ending in ["_ske.json", "_tex.json", "_tex.png"] {
        assert!(file(&format!("tetrapod-2-running{ending}")).exists(), "{ending}");
    }
    Ok(())
}

#[test]
fn what_cannot_be_exported_is_said_and_leaves_nothing() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    succeed(small_run_of("biped-1", "jumping", &run, 1).args(WITHOUT_SELECTION).arg("--quiet"));
    let (champion, out) = (run.join("champion.json"), folder.path().join("out"));
    for format in ["gif", "apng", "svg", "sprites", "gltf", "dragonbones"] {
        let said = fail(&mut export(&run, format, &out, &[]));
        assert_says(&said, &[text(&champion), "its gait has no cycle to make a loop of"]);
    }
    let before = fs::read(&champion)?;
    assert_says(&fail(&mut export(&run, "csv", &champion, &["--force"])), &["is what is to be exported"]);
    assert_says(
        &fail(&mut export(&run, "csv", &out, &["--seconds", "0"])),
        &["--seconds = 0: must be from 1 to 1000000 steps of the physics"],
    );
    assert_says(
        &fail(&mut export(&run, "csv", &folder.path().join("no/where"), &[])),
        &["cannot write", "there is no folder"],
    );
    for (format, option, value) in
        [("csv", "--size", "64"), ("player", "--seconds", "1"), ("gif", "--seconds", "1"), ("gltf", "--rate", "12")]
    {
        let said = fail(&mut export(&run, format, &out, &[option, value]));
        assert_says(&said, &[&format!("{option} has no effect on {format}")]);
    }
    assert_says(&fail(&mut export(&run, "gif", &out, &["--size", "0"])), &["--size: 0 is not from 16 to 2048"]);
    assert!(fs::read(&champion)? == before && !out.exists());
    let damaged = folder.path().join("damaged.json");
    fs::write(&damaged, String::from_utf8(before)?.replacen("\"generation\": ", "\"generation\": 1", 1))?;
    assert_says(
        &fail(&mut export(&damaged, "player", &out, &[])),
        &[text(&damaged), "was changed after it was written"],
    );
    assert!(!out.exists());
    Ok(())
}
