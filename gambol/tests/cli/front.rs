//! Searches for several objectives: the front in the run's folder, its report, its points played.

use crate::{
    damage::{edit, edit_and_seal, flip, json, raise_version, truncate},
    folder::{LASTING, assert_same_files, read},
    killed::kill_after,
    program::{assert_says, fail, gambol, long_run, small_run, succeed, text},
    reporting::{assert_stands_alone, data},
};
use gambol::Registry;
use gambol::{Setup, front::Front, run_folder::RunFolder};
use ne_core::{Seed, Task};
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const OBJECTIVES: &str = r#"movement.objectives=[{"term":"running"},{"term":"energy","weight":-0.5}]"#;

/// A small run for speed against energy.
fn train(folder: &Path, generations: u32) -> Command {
    train_many(folder, generations, 8)
}

/// The same with so many individuals.
fn train_many(folder: &Path, generations: u32, population: u32) -> Command {
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--strategy", "nsga2", "--set", OBJECTIVES, "--set", "movement.steps=60"]);
    train.args(["--quiet", "--no-report", "--population", &population.to_string()]);
    train.args(["--generations", &generations.to_string(), "--out"]).arg(folder);
    train
}

#[track_caller]
fn assert_same_front_and_run(one: &Path, other: &Path) {
    assert_same_files(one, other, &[&LASTING[..], &["front.json"]].concat());
}

#[test]
fn a_front_is_the_same_on_other_threads_and_after_a_pause() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [whole, broken] = ["whole", "broken"].map(|name| folder.path().join(name));
    succeed(train(&whole, 14).args(["--threads", "2"]));
    succeed(train(&broken, 5).args(["--threads", "1"]));
    assert_eq!(json(&broken.join("front.json"))["content"]["generation"], 5);
    succeed(gambol("resume").arg(&broken).args(["--generations", "14", "--no-report", "--quiet", "--threads", "1"]));
    assert_same_front_and_run(&whole, &broken);
    Ok(())
}

#[test]
fn a_run_that_is_killed_and_resumed_gives_the_same_front() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [whole, killed] = ["whole", "killed"].map(|name| folder.path().join(name));
    let long = |folder: &Path| {
        let mut train = long_run(folder);
        train.args(["--strategy", "nsga2", "--set", OBJECTIVES, "--set", "record.checkpoint_every=7"]);
        train
    };
    succeed(long(&whole).args(["--quiet", "--threads", "1"]));
    kill_after(long(&killed).args(["--threads", "2"]), &killed, 12);
    succeed(gambol("resume").arg(&killed).args(["--threads", "2", "--no-report", "--quiet"]));
    assert_same_front_and_run(&whole, &killed);
    Ok(())
}

#[test]
fn lanes_and_rapier_find_the_same_front() -> Outcome {
    let folder = tempfile::tempdir()?;
    let [lanes, rapier] = ["lanes", "rapier"].map(|engine| {
        let path = folder.path().join(engine);
        succeed(train(&path, 5).args(["--engine", engine]));
        path
    });
    assert_same_files(&lanes, &rapier, &["front.json", "log.jsonl"]);
    Ok(())
}

/// Of a run with stages the front is that of the latest.
#[test]
fn a_point_of_a_run_with_stages_is_one_of_its_latest_stage() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let stages = r#"stages=[{"name":"run","promotion":{"generations":3}},{"name":"go-on"}]"#;
    succeed(train(&path, 6).args(["--set", stages]));
    let [of_run, of_stage] = [path.clone(), path.join("stages/02-go-on")]
        .map(|path| succeed(gambol("replay").arg(path).args(["--point", "1"])));
    assert_eq!(of_run, of_stage);
    Ok(())
}

/// Each number in the file is what the task of training gives again, and no individual in it dominates another.
#[test]
fn a_front_holds_what_was_measured() -> Outcome {
    for parents_again in ["true", "false"] {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("run");
        let again = format!("strategy.nsga2.parents_again={parents_again}");
        succeed(train_many(&path, 6, 24).args(["--set", &again, "--set", "trials.count=1"]));
        let run = RunFolder::open(&path)?;
        let (config, front) = (run.read_config()?, Front::read(&run.front())?);
        let setup = Setup::new(&config, &Registry::default())?;
        let names: Vec<_> = front.objectives.iter().map(|objective| (&*objective.name, &*objective.unit)).collect();
        assert_eq!(names, [("running", "m"), ("energy", "J")]);
        assert_eq!(front.objectives[1].weight, -0.5);
        assert!(front.points.len() > 1, "only one point");
        for point in &front.points {
            let seed = Seed::of_run(config.seed).generation(point.generation);
            let evaluation = setup.task.evaluate(&mut point.network.clone(), seed);
            assert_eq!(evaluation.fitness(), Some(point.fitness));
            assert_eq!(evaluation.objectives().as_ref(), Some(&point.objectives));
            assert_eq!(evaluation.objectives[1], -0.5 * measured(&setup, point, seed));
        }
        for pair in front.points.windows(2) {
            assert!(pair[0].objectives[0] > pair[1].objectives[0] && pair[0].objectives[1] < pair[1].objectives[1]);
        }
    }
    Ok(())
}

/// The energy of a point's first trial.
fn measured(setup: &Setup, point: &gambol::front::SavedPoint, seed: Seed) -> f64 {
    let mut energy = 0.0;
    let mut watcher = |moment: &tasks::Moment<'_>| energy = moment.snapshot.motor_work;
    setup.episode.play(&mut point.network.clone(), seed.trial(0), &mut watcher);
    energy
}

#[test]
fn each_point_can_be_replayed_saved_and_verified() -> Outcome {
    let folder = tempfile::tempdir()?;
    // With and without a champion selection's world of its own.
    for (name, more) in [("varied", &[][..]), ("plain", &["--preset", "thesis"])] {
        let path = folder.path().join(name);
        succeed(train_many(&path, 4, 16).args(more));
        let points = json(&path.join("front.json"))["content"]["points"].as_array().map_or(0, Vec::len);
        let mut shown = vec![1, points];
        shown.dedup();
        for point in shown {
            let [csv, saved] = ["csv", "json"].map(|end| folder.path().join(format!("{name}-{point}.{end}")));
            let mut replay = gambol("replay");
            replay.arg(&path).arg("--point").arg(point.to_string()).arg("--trajectory").arg(&csv);
            let printed = succeed(replay.arg("--save").arg(&saved));
            assert_says(&printed, &[text(&csv), text(&saved), "biped-1 running: "]);
            assert!(read(&csv).starts_with(b"step,time_s,part,"));
            assert_says(&succeed(gambol("verify").arg(&saved)), &["identical"]);
            assert_eq!(json(&saved)["content"]["strategy"], "nsga2");
            // The saved champion moves as the point does.
            let again = folder.path().join(format!("{name}-{point}-again.csv"));
            succeed(gambol("replay").arg(&saved).arg("--trajectory").arg(&again));
            assert_eq!(read(&csv), read(&again));
        }
    }
    Ok(())
}

#[test]
fn a_point_that_is_not_there_is_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut train(&path, 2));
    let points = json(&path.join("front.json"))["content"]["points"].as_array().map_or(0, Vec::len);
    let replay = |path: &Path, point: &str| fail(gambol("replay").arg(path).args(["--point", point]));
    for point in ["0".to_owned(), (points + 1).to_string()] {
        assert_says(&replay(&path, &point), &[&format!("--point {point}: must be from 1 to {points}")]);
    }
    assert_says(&replay(&path.join("champion.json"), "1"), &["is not the folder of a run: it has no config.json"]);
    let other = folder.path().join("other");
    succeed(&mut small_run(&other, 1));
    assert!(!other.join("front.json").exists());
    assert_says(&replay(&other, "1"), &[text(&other), "has no front.json: cma-es looks for no front"]);
    Ok(())
}

#[test]
fn the_report_has_the_points_spread_along_the_front_and_plays_them() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut train_many(&path, 6, 200));
    succeed(gambol("report").arg(&path));
    let page = fs::read_to_string(path.join("report.html"))?;
    assert_stands_alone(&page);
    let (page, file) = (data(&page), json(&path.join("front.json")));
    let (front, saved) = (&page["front"], &file["content"]["points"]);
    let expected = serde_json::json!([
        { "name": "running", "unit": "m", "less_is_better": false },
        { "name": "energy", "unit": "J", "less_is_better": true },
    ]);
    assert_eq!(front["objectives"], expected);
    let points = front["points"].as_array().ok_or("no points")?;
    let total = saved.as_array().map_or(0, Vec::len);
    assert_eq!((&front["total"], points.len()), (&total.into(), total.min(40)));
    assert_eq!((&points[0]["number"], &points[points.len() - 1]["number"]), (&1.into(), &total.into()));
    for point in points {
        let number = point["number"].as_u64().and_then(|number| usize::try_from(number).ok()).ok_or("no number")?;
        let saved = &saved[number - 1]["objectives"];
        assert_eq!(point["values"][0], saved[0]);
        assert_eq!(point["values"][1].as_f64(), saved[1].as_f64().map(|weighed| weighed / -0.5 + 0.0));
        assert!(point["replay"]["frames"].as_u64() > Some(1));
    }
    assert!(page["statistics"].as_array().is_some_and(|all| all.iter().any(|one| one["name"] == "hypervolume")));
    assert!(page["settings"].to_string().contains("1 × running, -0.5 × energy"));
    Ok(())
}

#[test]
fn a_search_for_the_fitness_alone_has_nothing_to_choose_between() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(small_run(&path, 3).args(["--quiet", "--strategy", "nsga2"]));
    let front = json(&path.join("front.json"))["content"].take();
    assert_eq!(front["objectives"], serde_json::json!([{ "name": "fitness", "unit": "m", "weight": 1.0 }]));
    assert_eq!(front["points"].as_array().map(Vec::len), Some(1));
    succeed(gambol("report").arg(&path));
    assert!(data(&fs::read_to_string(path.join("report.html"))?)["front"].is_null());
    Ok(())
}

#[test]
fn a_damaged_front_is_an_error_that_names_the_file_and_resuming_writes_it_anew() -> Outcome {
    type Damage = fn(&Path);
    let damages: [(Damage, &str); 5] = [
        (|path| truncate(path, 100), "is damaged or not a file of Gambol"),
        (|path| flip(path, read(path).len() / 2, 0), ""),
        (raise_version, "has version 3, this Gambol reads version 2"),
        (|path| edit(path, |content| content["generation"] = 9.into()), "was changed after it was written"),
        (
            |path| edit_and_seal(path, |content| content["points"][0]["objectives"] = serde_json::json!([1.0])),
            "field points[0].objectives: found 1 numbers, expected 2",
        ),
    ];
    let folder = tempfile::tempdir()?;
    for (index, (damage, says)) in damages.into_iter().enumerate() {
        let path = folder.path().join(index.to_string());
        succeed(&mut train(&path, 3));
        let file = path.join("front.json");
        damage(&file);
        assert_says(&fail(gambol("report").arg(&path)), &[text(&file), says]);
        assert_says(&fail(gambol("replay").arg(&path).args(["--point", "1"])), &[text(&file), says]);
        succeed(gambol("resume").arg(&path).args(["--generations", "4", "--quiet"]));
        assert_eq!(Front::read(&file)?.generation, 4);
    }
    Ok(())
}
