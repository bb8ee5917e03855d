//! Stages that are given up: the run begins anew, and the best attempt goes on.

use crate::{
    damage::json,
    folder::read,
    program::{assert_says, gambol, run, succeed, text},
    shaping::{kill_after, lasting, legs, three_stages, train, write},
};
use serde_json::{Value, json};
use std::fs;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Three attempts are given up, the best is taken up again and passed; the next stage goes on from the best of all.
fn attempts() -> Value {
    let mut config = three_stages();
    let give_up = json!({ "when": { "generations": 3 }, "back_to": "run", "times": 2 });
    config["stages"] = json!([
        { "name": "run", "promotion": { "generations": 4 } },
        { "name": "feel", "add_sensors": ["joint-speeds"], "promotion": { "generations": 5 }, "give_up": give_up },
        { "name": "jump", "changes": { "movement": { "name": "jumping", "steps": 40 } }, "promotion": { "generations": 2 } }
    ]);
    config
}

#[test]
fn what_is_given_up_begins_anew_and_the_best_attempt_goes_on() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (config, run_folder) = (write(folder.path(), &attempts()), folder.path().join("run"));
    let ended = run(train(&config, &run_folder).args(["--threads", "1"]));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert_eq!(
        legs(&run_folder),
        ["01-run", "02-feel", "03-run", "04-feel", "05-run", "06-feel", "07-feel", "08-jump"]
    );
    let at = |leg: &str| run_folder.join("stages").join(leg);
    let standing = |leg: &str| {
        let champion = json(&at(leg).join("checkpoint"))["content"]["champion"].clone();
        (champion["tier"].as_u64().unwrap_or(0), champion["fitness"].as_f64().expect("a champion"))
    };
    let of = |legs: &[&'static str]| {
        legs.iter().copied().max_by(|one, other| standing(one).partial_cmp(&standing(other)).expect("numbers"))
    };
    let best = of(&["02-feel", "04-feel", "06-feel"]).expect("three");
    let best_of_all = of(&["02-feel", "04-feel", "06-feel", "07-feel"]).expect("four");
    let says = [
        "stage 1 of 3, run\nstage 2 of 3, feel: goes on with the population of 01-run (generation 4); ",
        "stage 1 of 3, run\nstage 2 of 3, feel: goes on with the population of 03-run (generation 4); ",
        "stage 1 of 3, run\nstage 2 of 3, feel: goes on with the population of 05-run (generation 4); ",
        &format!("stage 2 of 3, feel: goes on with the population of {best} (generation 3); all "),
        &format!("stage 3 of 3, jump: goes on with the population of {best_of_all} "),
    ];
    assert_says(
        &ended
            .stderr
            .lines()
            .filter(|line| line.starts_with("stage"))
            .map(|line| format!("{line}\n"))
            .collect::<String>(),
        &says,
    );
    let rule =
        "  stage 2 feel: running, until 5 generations; given up at 3 generations, to begin anew at run, 2 times\n";
    assert_says(&succeed(gambol("check").arg(&config)), &[rule]);
    let seed = |leg: &str| json(&at(leg).join("config.json"))["content"]["seed"].clone();
    assert!(seed("01-run") != seed("03-run") && seed("03-run") != seed("05-run"));
    assert_eq!(read(&run_folder.join("champion.json")), read(&at("08-jump").join("champion.json")));
    succeed(gambol("report").arg(&run_folder));
    assert_says(&fs::read_to_string(run_folder.join("report.html"))?, &["given up; another began anew"]);
    Ok(())
}

/// The run's champion is the best of those that got farthest, not the one that is on its way there.
#[test]
fn what_begins_anew_has_no_champion_of_the_run_yet() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut config = attempts();
    config["stop"] = json!({ "generations": 9 });
    let run_folder = folder.path().join("run");
    succeed(train(&write(folder.path(), &config), &run_folder).arg("--quiet"));
    assert_eq!(legs(&run_folder), ["01-run", "02-feel", "03-run"]);
    assert_eq!(read(&run_folder.join("champion.json")), read(&run_folder.join("stages/02-feel/champion.json")));
    let goes_on = folder.path().join("goes-on");
    let mut train = gambol("train");
    let sensors = ["--from", text(&run_folder), "--generations", "1", "--no-report", "--out", text(&goes_on)];
    let ended = run(train.args(["biped-1", "running"]).args(sensors));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    // 01-run had four generations, and 03-run has had two.
    let origin = json(&goes_on.join("config.json"))["content"]["origin"].clone();
    assert_eq!((&origin["transferred"], &origin["generation"]), (&json!("population"), &json!(3)));
    Ok(())
}

#[test]
fn a_run_that_begins_anew_gives_the_same_bytes_when_killed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let config = write(folder.path(), &attempts());
    let whole = folder.path().join("whole");
    succeed(train(&config, &whole).args(["--threads", "1", "--quiet"]));
    let expected = lasting(&whole);
    for lines in [8, 9, 10, 14, 18, 19, 27, 29] {
        let path = folder.path().join(format!("killed-after-{lines}"));
        kill_after(train(&config, &path).args(["--threads", "2"]), lines);
        succeed(gambol("resume").arg(&path).args(["--no-report", "--quiet"]));
        assert!(lasting(&path) == expected, "after {lines} lines");
    }
    Ok(())
}
