//! `film`: gaits side by side as an animated image.

use crate::program::{assert_says, fail, gambol, small_run_of, succeed, text};
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

fn film(champions: &[&Path], out: &Path, more: &[&str]) -> Command {
    let mut film = gambol("film");
    film.args(champions)
        .arg("--out")
        .arg(out)
        .args(["--seconds", "0.4", "--width", "120", "--height", "90"])
        .args(more);
    film
}

#[test]
fn runs_and_champions_are_filmed_side_by_side() -> Outcome {
    let folder = tempfile::tempdir()?;
    let paths = ["biped-1", "apod"].map(|creature| folder.path().join(creature));
    for (path, creature) in paths.iter().zip(["biped-1", "apod"]) {
        succeed(small_run_of(creature, "running", path, 1).arg("--quiet"));
    }
    let (out, again) = (folder.path().join("film.png"), folder.path().join("again.png"));
    let champion = paths[1].join("champion.json");
    let said = succeed(&mut film(&[&paths[0], &champion], &out, &[]));
    assert_says(&said, &[text(&out), "10 frames", " kB"]);
    let image = fs::read(&out)?;
    assert!(image.starts_with(b"\x89PNG\r\n\x1a\n"), "no PNG image");
    assert_eq!(image[16..24], [258_u32.to_be_bytes(), 102_u32.to_be_bytes()].concat());
    succeed(&mut film(&[&paths[0], &paths[1]], &again, &[]));
    assert_eq!(fs::read(&again)?, image, "a run's folder and its champion give the same film");
    Ok(())
}

#[test]
fn a_film_overwrites_nothing_unasked_and_names_what_is_wrong() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(small_run_of("biped-1", "running", &path, 1).arg("--quiet"));
    let (champion, mine) = (path.join("champion.json"), folder.path().join("mine.png"));
    let before = fs::read(&champion)?;
    fs::write(&mine, "precious")?;
    assert_says(&fail(&mut film(&[&path], &mine, &[])), &[text(&mine), "exists; say --force"]);
    assert_eq!(fs::read_to_string(&mine)?, "precious");
    succeed(&mut film(&[&path], &mine, &["--force"]));
    assert_says(&fail(&mut film(&[&path], &champion, &["--force"])), &[text(&champion), "is what is to be filmed"]);
    assert_eq!(fs::read(&champion)?, before);
    let other = folder.path().join("new.gif");
    assert_says(&fail(&mut film(&[&path], &other, &[])), &["new.gif must end in .png"]);
    let new = folder.path().join("new.png");
    assert_says(&fail(&mut film(&[&path], &new, &["--columns", "17"])), &["columns: 17 is not from 1 to 16"]);
    assert_says(&fail(&mut film(&[&path], &new, &["--from", "nan"])), &["from: NaN is not from 0 to 3600"]);
    assert_says(&fail(&mut film(&[folder.path()], &new, &[])), &["is not the folder of a run"]);
    assert!(!new.exists());
    Ok(())
}
