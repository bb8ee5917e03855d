//! `gait`: what a champion or a trajectory does, and whether it is usable.

use crate::program::{Ended, assert_says, fail, gambol, run, small_run_of, succeed, text};
use serde_json::Value;
use std::{
    fmt::Write,
    fs,
    path::{Path, PathBuf},
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const NOT_USABLE: Option<i32> = Some(3);

fn trained(folder: &Path, movement: &str) -> PathBuf {
    let path = folder.join(movement);
    succeed(small_run_of("biped-1", movement, &path, 2).args(["--preset", "thesis", "--quiet"]));
    path
}

/// What the champion of a run does for so long, as CSV.
fn trajectory(run: &Path, seconds: &str) -> Result<(PathBuf, String), std::io::Error> {
    let csv = run.join("gait.csv");
    let mut replay = gambol("replay");
    succeed(replay.arg(run.join("champion.json")).args(["--force", "--seconds", seconds, "--trajectory"]).arg(&csv));
    let text = fs::read_to_string(&csv)?;
    Ok((csv, text))
}

fn of_trajectory(csv: &Path, arguments: &[&str]) -> Ended {
    run(gambol("gait").arg(csv).args(["--creature", "biped-1"]).args(arguments))
}

fn json(printed: &str) -> Value {
    serde_json::from_str(printed).expect("JSON")
}

/// What kind of reason it is; for a cheat, which.
fn name(reason: &Value) -> String {
    let tag = reason.as_object().and_then(|reason| reason.keys().next());
    let tag = tag.map_or_else(|| reason.to_string(), String::clone);
    reason.pointer("/cheat/kind").map_or(tag, Value::to_string)
}

/// The standing start of a trajectory, then a jump at 1 s, half a metre high: all parts move as one.
fn jump(standing: &str) -> String {
    let (header, rows) = standing.split_once('\n').expect("a header");
    let start: Vec<Vec<&str>> =
        rows.lines().map(|row| row.split(',').collect()).take_while(|row: &Vec<&str>| row[0] == "0").collect();
    // As other programs write it: without speeds and torques.
    let header: Vec<&str> = header.split(',').take(7).collect();
    let mut csv = format!("{}\n", header.join(","));
    for step in 0..=250_u16 {
        let time = f64::from(step) * 0.02;
        let flight = time - 1.0;
        let height = (flight * (3.2 - 0.5 * 9.81 * flight)).max(0.0);
        for row in &start {
            let y = row[4].parse::<f64>().expect("a number") + if flight > 0.0 { height } else { 0.0 };
            let contact = if height > 0.0 && flight > 0.0 { "0" } else { row[6] };
            let _ = writeln!(csv, "{step},{time},{},{},{y},{},{contact}", row[2], row[3], row[5]);
        }
    }
    csv
}

#[test]
fn a_champion_that_has_learned_nothing_is_not_usable_and_told_why() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = trained(folder.path(), "running");
    let of_run = run(gambol("gait").arg(&path));
    assert_eq!(of_run.code, NOT_USABLE, "{}", of_run.stderr);
    let parts = ["biped-1 running: not usable:\n  ", "cost of transport", "footfalls, the last 3.0 s", "left leg"];
    assert_says(&of_run.stdout, &parts);
    let of_file = run(gambol("gait").arg(path.join("champion.json")));
    assert_eq!(of_file.stdout, of_run.stdout);
    let report = run(gambol("gait").arg(&path).arg("--json"));
    assert_eq!(report.code, NOT_USABLE);
    let report = json(&report.stdout);
    assert_eq!((&report["judged_as"], &report["verdict"]["usable"]), (&"running".into(), &false.into()));
    Ok(())
}

/// Whatever ended its episodes in training, and whatever it was trained with.
#[test]
fn a_trajectory_is_judged_as_the_champion_it_came_from() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (movement, preset) in
        [("running", "thesis"), ("jumping", "thesis"), ("running", "default"), ("jumping", "default")]
    {
        let path = folder.path().join(format!("{movement}-{preset}"));
        succeed(small_run_of("biped-1", movement, &path, 3).args(["--preset", preset, "--quiet"]));
        let csv = path.join("gait.csv");
        succeed(gambol("replay").arg(&path).arg("--trajectory").arg(&csv));
        let champion = run(gambol("gait").arg(&path).arg("--json"));
        let read = of_trajectory(&csv, &["--movement", movement, "--json"]);
        assert_eq!(read.code, champion.code, "{movement} {preset}: {}", read.stderr);
        let (champion, read) = (json(&champion.stdout), json(&read.stdout));
        let names = |report: &Value| -> Vec<String> {
            let reasons = report["verdict"]["reasons"].as_array().expect("a list").iter();
            // Near worlds are told of champions alone.
            reasons.map(name).filter(|name| name != "brittle").collect()
        };
        assert_eq!(names(&read), names(&champion), "{movement} {preset}");
        // Only the angles are not in the file to the bit.
        for (number, allowed) in [
            ("/duration_s", 0.0),
            ("/travel/distance_m", 0.0),
            ("/travel/cost_of_transport", 1e-5),
            ("/torso/largest_tilt_deg", 1e-3),
            ("/aloft/share", 0.0),
            ("/legs/0/duty_factor", 0.0),
            ("/joints/0/reversals_per_s", 0.0),
        ] {
            let [read, champion] = [&read, &champion].map(|report| report.pointer(number).and_then(Value::as_f64));
            assert_eq!(read.is_some(), champion.is_some(), "{movement} {preset} {number}");
            let (read, champion) = (read.unwrap_or(0.0), champion.unwrap_or(0.0));
            let difference = (read - champion).abs();
            assert!(difference <= allowed * champion.abs().max(1.0), "{movement} {preset} {number}: {read} {champion}");
        }
        assert!(champion["joints"][0]["reversals_per_s"].is_number(), "{champion}");
    }
    Ok(())
}

/// A file that holds no speeds, as those of older versions and of other programs.
#[test]
fn a_trajectory_without_speeds_is_judged_from_places() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (csv, whole) = trajectory(&trained(folder.path(), "running"), "20")?;
    let judged = |columns: usize| -> Result<Value, std::io::Error> {
        let cut = |row: &str| row.split(',').take(columns).collect::<Vec<_>>().join(",") + "\n";
        fs::write(&csv, whole.lines().map(cut).collect::<String>())?;
        Ok(json(&of_trajectory(&csv, &["--movement", "running", "--json"]).stdout))
    };
    let (places, speeds, torques) = (judged(7)?, judged(10)?, judged(11)?);
    for report in [&places, &speeds] {
        assert!(report["travel"]["cost_of_transport"].is_null(), "torques are not in the file");
        assert_eq!(report["travel"]["distance_m"], torques["travel"]["distance_m"]);
    }
    assert!(torques["travel"]["cost_of_transport"].is_number(), "{}", torques["travel"]);
    Ok(())
}

#[test]
fn a_clean_jump_is_usable() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (csv, standing) = trajectory(&trained(folder.path(), "jumping"), "1")?;
    fs::write(&csv, jump(&standing))?;
    let ended = of_trajectory(&csv, &["--movement", "jumping"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
    let alone = "biped-1 jumping: usable\n  judged alone: near worlds need the champion\n";
    assert_says(&ended.stdout, &[alone, "best jump          at 1.00 s, 0.64 s in the air"]);
    let ended = of_trajectory(&csv, &["--movement", "running"]);
    assert_eq!(ended.code, NOT_USABLE);
    assert_says(&ended.stdout, &["biped-1 running: not usable:", "the episode lasted 5.0 s", "0.00 body lengths/s"]);
    let ended = of_trajectory(&csv, &[]);
    assert_eq!(ended.code, Some(0), "what is not judged is not unusable");
    assert_says(&ended.stdout, &["biped-1: not judged"]);
    Ok(())
}

#[test]
fn a_wrong_trajectory_is_an_error_with_file_and_line() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (csv, good) = trajectory(&trained(folder.path(), "running"), "1")?;
    let refusal = |text: &str| {
        fs::write(&csv, text).expect("a folder to write to");
        fail(gambol("gait").arg(&csv).args(["--creature", "biped-1"]))
    };
    let rows: Vec<&str> = good.lines().collect();
    let without = |line: usize| {
        rows.iter()
            .enumerate()
            .filter(|&(index, _)| index + 1 != line)
            .map(|(_, row)| format!("{row}\n"))
            .collect::<String>()
    };
    let file = text(&csv);
    assert_says(&refusal(""), &[file, "line 1: expected the columns step,time_s,part"]);
    assert_says(
        &refusal(&good.replace("ground_contact", "contact")),
        &[file, "line 1: the column \"ground_contact\" is"],
    );
    assert_says(&refusal(&without(1)), &[file, "line 1: the column \"step\" is missing"]);
    assert_says(&refusal(&good.replacen("left leg", "left arm", 1)), &[file, "line 3: there is no part \"left arm\""]);
    assert_says(&refusal(&without(6)), &[file, "line 7: step 1 ends without the part \"left leg\""]);
    assert_says(
        &refusal(&good.replace("\n1,0.02,", "\n1,soon,")),
        &[file, "line 5: time_s is \"soon\", expected a finite"],
    );
    assert_says(&refusal(&good.replace("\n1,", "\n2,")), &[file, "line 5: step 2 is out of order"]);
    let time = rows[28].split(',').nth(1).expect("a time");
    let late = good.replace(&format!("\n9,{time},"), "\n9,0.19,");
    assert_says(&refusal(&late), &[file, "line 29: step 9 comes 0.0", "constant time step"]);
    assert_says(&refusal(&rows[..4].join("\n")), &[file, "a gait needs the start and at least 1 step"]);
    Ok(())
}

#[test]
fn what_does_not_go_together_is_an_error() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = trained(folder.path(), "running");
    let (csv, _) = trajectory(&path, "1")?;
    assert_says(&fail(gambol("gait").arg(&csv)), &[text(&csv), "whose trajectory", "--creature NAME or FILE"]);
    assert_says(&fail(gambol("gait").arg(&path).args(["--movement", "running"])), &["--movement is for trajectories"]);
    let missing = folder.path().join("none.csv");
    assert_says(&fail(gambol("gait").arg(&missing).args(["--creature", "apod"])), &["cannot read", text(&missing)]);
    assert_says(&fail(gambol("gait").arg(&csv).args(["--creature", "bipde-1"])), &["did you mean \"biped-1\"?"]);
    assert_says(&fail(gambol("gait").arg(folder.path())), &[text(folder.path()), "is not the folder of a run"]);
    let flying = fail(gambol("gait").arg(&csv).args(["--creature", "biped-1", "--movement", "flying"]));
    assert_says(&flying, &["there is no movement whose gaits are judged \"flying\"", "running, jumping"]);
    Ok(())
}

/// The file is a PNG image as wide as a sheet.
#[track_caller]
fn assert_is_sheet(path: &Path) -> Vec<u8> {
    let image = fs::read(path).expect("a sheet");
    assert!(image.starts_with(b"\x89PNG\r\n\x1a\n"), "no PNG image");
    assert_eq!(image[16..20], 1440_u32.to_be_bytes());
    image
}

#[test]
fn a_sheet_shows_a_champion_a_run_and_a_trajectory() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = trained(folder.path(), "jumping");
    let sheet = |name: &str| folder.path().join(name);
    let ended = run(gambol("gait").arg(&path).arg("--sheet").arg(sheet("run.png")));
    assert_eq!(ended.code, NOT_USABLE, "{}", ended.stderr);
    assert_says(&ended.stdout, &["biped-1 jumping: not usable", "\ncontact sheet: ", text(&sheet("run.png"))]);
    let ended = run(gambol("gait").arg(path.join("champion.json")).arg("--json").arg("--sheet").arg(sheet("file.png")));
    assert_eq!(ended.code, NOT_USABLE, "{}", ended.stderr);
    assert!(json(&ended.stdout).is_object());
    assert_eq!(assert_is_sheet(&sheet("run.png")), assert_is_sheet(&sheet("file.png")));
    let (csv, _) = trajectory(&path, "5")?;
    for (name, movement) in [("judged.png", &["--movement", "jumping"][..]), ("measured.png", &[])] {
        let ended = of_trajectory(&csv, &[movement, &["--sheet", text(&sheet(name))]].concat());
        assert_says(&ended.stdout, &["contact sheet: "]);
        assert_is_sheet(&sheet(name));
    }
    Ok(())
}

#[test]
fn a_sheet_overwrites_nothing_unasked_and_names_a_file_it_cannot_write() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = trained(folder.path(), "running");
    let champion = path.join("champion.json");
    let before = fs::read(&champion)?;
    let gait = |sheet: &Path, more: &[&str]| {
        let mut gait = gambol("gait");
        gait.arg(&path).arg("--sheet").arg(sheet).args(more);
        gait
    };
    let mine = folder.path().join("mine.png");
    fs::write(&mine, "precious")?;
    assert_says(&fail(&mut gait(&mine, &[])), &[text(&mine), "exists; say --force"]);
    assert_eq!(fs::read_to_string(&mine)?, "precious");
    assert_eq!(run(&mut gait(&mine, &["--force"])).code, NOT_USABLE);
    assert_is_sheet(&mine);
    assert_says(&fail(&mut gait(&champion, &["--force"])), &[text(&champion), "is what is to be measured"]);
    assert_eq!(fs::read(&champion)?, before);
    let nowhere = folder.path().join("none").join("sheet.png");
    assert_says(&fail(&mut gait(&nowhere, &[])), &["cannot write", text(&nowhere)]);
    let ended = run(gambol("gait").arg(&path).arg("--force"));
    assert_eq!(ended.code, Some(2));
    assert_says(&ended.stderr, &["--sheet"]);
    Ok(())
}
