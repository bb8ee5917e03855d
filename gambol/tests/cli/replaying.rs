//! `replay`: trajectories and pages of a champion.

use crate::{
    program::{assert_says, fail, gambol, small_run_of, succeed, text},
    reporting::{assert_stands_alone, data},
};
use std::{
    fs,
    path::{Path, PathBuf},
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// What a run is judged in, and a step.
const JUDGED_STEPS: usize = 3000;
const STEP_SECONDS: f64 = 0.02;

fn trained(folder: &Path, creature: &str) -> PathBuf {
    let path = folder.join("run");
    // Nothing ends its episodes early, and its net is a plain one.
    succeed(small_run_of(creature, "running", &path, 2).args(["--preset", "thesis", "--quiet"]));
    path.join("champion.json")
}

/// The rows of a trajectory of so many seconds, columns apart.
fn trajectory(champion: &Path, seconds: Option<&str>) -> Result<Vec<Vec<String>>, std::io::Error> {
    let csv = champion.with_file_name(format!("{}.csv", seconds.unwrap_or("whole")));
    let mut replay = gambol("replay");
    replay.arg(champion).arg("--trajectory").arg(&csv);
    succeed(replay.args(seconds.map(|seconds| ["--seconds", seconds]).into_iter().flatten()));
    let text = fs::read_to_string(csv)?;
    let (header, rows) = text.split_once('\n').expect("a header");
    assert_eq!(
        header,
        "step,time_s,part,x_m,y_m,angle_rad,ground_contact,vx_m_per_s,vy_m_per_s,spin_rad_per_s,motor_torque_n_m"
    );
    Ok(rows.lines().map(|row| row.split(',').map(str::to_owned).collect()).collect())
}

#[test]
fn a_trajectory_has_a_row_for_each_step_and_part() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "tetrapod-1");
    let rows = trajectory(&champion, None)?;
    let parts = ["torso", "left front leg", "right front leg", "left hind leg", "right hind leg"].len();
    assert_eq!(rows.len(), (JUDGED_STEPS + 1) * parts);
    for (index, row) in rows.iter().enumerate() {
        let (step, part) = (index / parts, index % parts);
        let [number, time, name, x, y, angle, contact, speeds @ .., torque] = &row[..] else {
            panic!("{row:?} has not eleven columns")
        };
        assert_eq!(number.parse::<usize>()?, step);
        assert!((time.parse::<f64>()? - step as f64 * STEP_SECONDS).abs() < 1e-4, "{row:?}");
        assert_eq!(*name, rows[part][2], "parts come in the same order at every step");
        assert_eq!(speeds.len(), 3);
        assert_eq!(torque.is_empty(), part == 0, "each leg has a motor: {row:?}");
        assert!(torque.is_empty() || torque.parse::<f64>()?.is_finite());
        for value in [x, y].into_iter().chain(speeds) {
            assert!(value.parse::<f64>()?.abs() < 100.0, "{row:?}");
        }
        assert!(angle.parse::<f64>()?.abs() <= std::f64::consts::PI + 1e-6, "{row:?}");
        assert!(["0", "1"].contains(&contact.as_str()), "{row:?}");
    }
    assert!(rows.iter().any(|row| row[6] == "1"), "it stands on the ground");
    Ok(())
}

#[test]
fn a_replay_can_be_shorter_or_longer_and_begins_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "biped-1");
    let whole = trajectory(&champion, None)?;
    let (short, long) = (trajectory(&champion, Some("0.5"))?, trajectory(&champion, Some("65"))?);
    assert_eq!((short.len(), whole.len(), long.len()), (26 * 3, 3001 * 3, 3251 * 3));
    assert_eq!(short[..], long[..short.len()]);
    assert_eq!(whole[..], long[..whole.len()]);
    Ok(())
}

#[test]
fn a_replay_says_what_it_reached_in_which_time() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "biped-1");
    assert_says(&succeed(gambol("replay").arg(&champion)), &["biped-1 running: ", " m in 1.20 s"]);
    for seconds in ["0", "-1", "NaN", "inf", "1e9"] {
        let message = fail(gambol("replay").arg(&champion).arg(format!("--seconds={seconds}")));
        assert_says(&message, &["--seconds", "from 1 to 1000000 steps"]);
    }
    Ok(())
}

#[test]
fn what_has_terms_of_other_units_is_a_fitness() -> Outcome {
    let folder = tempfile::tempdir()?;
    let run = folder.path().join("run");
    let mut train = gambol("train");
    train.args(["biped-1", "jumping", "--preset", "default", "--generations", "10", "--no-report", "--quiet"]);
    succeed(train.arg("--out").arg(&run));
    assert_says(&succeed(gambol("replay").arg(&run)), &["biped-1 jumping: fitness "]);
    Ok(())
}

#[test]
fn a_page_shows_the_replay_and_needs_no_network() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "biped-1");
    let page = folder.path().join("gait.html");
    let printed = succeed(gambol("replay").arg(&champion).arg("--html").arg(&page).args(["--seconds", "2"]));
    assert_says(&printed, &[text(&page)]);
    let page = fs::read_to_string(page)?;
    assert_stands_alone(&page);
    let data = data(&page);
    assert_eq!(data["creature"]["name"], "biped-1");
    assert!(data["gait"]["verdict"]["usable"].is_boolean());
    let replay = &data["champion"]["replay"];
    assert_eq!((&replay["frames"], &replay["parts"]), (&101.into(), &3.into()));
    // Else it is what is judged.
    let whole = folder.path().join("whole.html");
    succeed(gambol("replay").arg(&champion).arg("--html").arg(&whole));
    let whole = crate::reporting::data(&fs::read_to_string(whole)?);
    assert_eq!(whole["champion"]["replay"]["frames"], JUDGED_STEPS + 1);
    assert_eq!(whole["gait"]["duration_s"].as_f64().map(|seconds| seconds.round()), Some(60.0));
    assert_eq!(replay["data"].as_array().map(Vec::len), Some(101 * 3 * 3));
    Ok(())
}

#[test]
fn a_place_that_cannot_be_written_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "biped-1");
    for option in ["--html", "--trajectory"] {
        let file = folder.path().join("missing/file");
        assert_says(&fail(gambol("replay").arg(&champion).arg(option).arg(&file)), &["cannot write", text(&file)]);
    }
    Ok(())
}

#[test]
fn a_replay_never_takes_the_place_of_its_champion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "biped-1");
    let before = fs::read(&champion)?;
    for flag in ["--trajectory", "--html"] {
        let message = fail(gambol("replay").arg(&champion).arg(flag).arg(&champion).arg("--force"));
        assert_says(&message, &[text(&champion), "is the champion itself"]);
    }
    assert_eq!(fs::read(&champion)?, before);
    Ok(())
}

#[test]
fn the_net_is_drawn_as_a_graph() -> Outcome {
    let folder = tempfile::tempdir()?;
    let champion = trained(folder.path(), "biped-1");
    let file = folder.path().join("net.dot");
    assert_says(&succeed(gambol("replay").arg(&champion).arg("--dot").arg(&file)), &[text(&file)]);
    let drawing = fs::read_to_string(&file)?;
    assert!(drawing.starts_with("digraph network {") && drawing.ends_with("}\n"));
    // Three inputs, ten hidden neurons, two outputs, each layer fully connected with the next.
    assert_eq!(drawing.matches(" -> ").count(), 3 * 10 + 10 * 2);
    assert_eq!(drawing.matches("shape=box").count(), 3 + 2);
    assert_eq!(drawing.matches("bias").count(), 10 + 2);
    assert!(!drawing.contains("dashed"), "nothing leads back in a dense net");
    let message = fail(gambol("replay").arg(&champion).arg("--dot").arg(&file));
    assert_says(&message, &[text(&file), "exists; say --force to overwrite it"]);
    let message = fail(gambol("replay").arg(&champion).arg("--force").arg("--dot").arg(&file).arg("--html").arg(&file));
    assert_says(&message, &["cannot be both the page and the drawing"]);
    Ok(())
}
