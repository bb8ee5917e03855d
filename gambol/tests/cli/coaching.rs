//! What the default preset adds, and the flags that ask for it: usable gaits, within a time, the same bits each time.

use crate::{
    damage::json,
    folder::assert_same_run,
    killed::kill_after,
    program::{assert_says, fail, gambol, run, succeed, text},
};
use serde_json::Value;
use std::{path::Path, process::Command, time::Instant};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The caterpillar learns to jump within a few generations. Nothing of the default preset is changed but the population,
/// which would take a test too long, and how often the champion selection sits.
fn easy(folder: &Path) -> Command {
    let mut train = gambol("train");
    train.args(["apod", "jumping", "--population", "24", "--set", "record.checkpoint_every=4", "--no-report"]);
    train.arg("--out").arg(folder);
    train
}

/// What the program printed last, as JSON.
fn result(stdout: &str) -> Value {
    let line = stdout.lines().last().expect("a result");
    serde_json::from_str::<Value>(line).expect("JSON")["result"].take()
}

fn tier(folder: &Path) -> Option<u64> {
    json(&folder.join("checkpoint"))["content"]["champion"]["tier"].as_u64()
}

#[test]
fn a_run_until_usable_ends_with_a_usable_champion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let told = succeed(easy(&path).args(["--until", "usable", "--generations", "400", "--json"]));
    assert_eq!(result(&told)["reason"], "tier", "the champion is usable before 400 generations are done");
    assert!(tier(&path) >= Some(1));
    assert_says(&succeed(gambol("gait").arg(&path)), &["apod jumping: usable"]);
    assert_says(&succeed(gambol("verify").arg(path.join("champion.json"))), &["identical: "]);
    // It has ended; with more generations it goes on, and its champion stays usable.
    let before = tier(&path);
    assert_says(&succeed(gambol("resume").arg(&path).arg("--no-report")), &["the champion has the tier asked for"]);
    let generations = result(&told)["progress"]["generations"].as_u64().ok_or("a number")? + 2;
    let mut resume = gambol("resume");
    resume.arg(&path).args(["--json", "--no-report", "--generations"]).arg(generations.to_string());
    let further = result(&succeed(&mut resume));
    assert_eq!((&further["reason"], &further["progress"]["generations"]), (&"generations".into(), &generations.into()));
    assert!(tier(&path) >= before);
    Ok(())
}

/// A run of `playing` until usable asks for the tier of 30 of 32 schedules, also where `resume` is told so.
#[test]
fn what_is_told_what_to_do_is_usable_in_many_schedules() -> Outcome {
    let folder = tempfile::tempdir()?;
    let wanted = |path: &Path| json(&path.join("config.json"))["content"]["stop"]["tier"].as_u64();
    let train = |creature: &str, movement: &str, until: &[&str]| {
        let path = folder.path().join(format!("{creature}-{movement}-{}", until.len()));
        let mut train = gambol("train");
        train.args([creature, movement, "--steps", "2000", "--population", "8", "--no-report", "--out"]);
        train.arg(&path).args(until);
        (run(&mut train).code, path)
    };
    let until = ["--until", "usable"];
    let (code, path) = train("tetrapod-1", "running", &until);
    assert_eq!((code, wanted(&path)), (Some(3), Some(1)));
    let (code, path) = train("tetrapod-1", "playing", &until);
    assert_eq!((code, wanted(&path)), (Some(3), Some(8)));
    // Where nothing varies no tier is higher than that of a single schedule.
    let (code, path) = train("tetrapod-1", "playing", &["--until", "usable", "--variation", "none"]);
    assert_eq!((code, wanted(&path)), (Some(3), Some(1)));
    // Nor is that of the preset's rules, which ask for as much of two legs.
    let (code, _) = train("biped-1", "playing", &["--variation", "none"]);
    assert_eq!(code, Some(0));
    let (code, path) = train("tetrapod-1", "playing", &[]);
    assert_eq!((code, wanted(&path)), (Some(0), None));
    let ended = run(gambol("resume").arg(&path).args(until).args(["--steps", "4000", "--no-report"]));
    assert_eq!((ended.code, wanted(&path)), (Some(3), Some(8)), "{}{}", ended.stdout, ended.stderr);
    Ok(())
}

#[test]
fn a_run_with_a_budget_of_time_ends_in_time_with_a_champion() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let began = Instant::now();
    let told = succeed(easy(&path).args(["--budget", "300ms", "--json"]));
    // A generation and a re-evaluation are finished, on a machine that may be busy; 300 generations would take far longer.
    assert!(began.elapsed().as_secs() < 60);
    let result = result(&told);
    assert_eq!(result["reason"], "minutes");
    assert!(result["progress"]["generations"].as_u64() < Some(300) && result["fitness"].is_number(), "{result}");
    assert_says(&succeed(gambol("verify").arg(path.join("champion.json"))), &["identical: "]);
    assert_eq!(json(&path.join("config.json"))["content"]["stop"]["generations"], Value::Null, "time is the budget");
    Ok(())
}

#[test]
fn the_default_preset_gives_the_same_bytes_on_any_number_of_threads_and_after_being_killed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    let train = |name: &str, threads: &str| {
        let mut train = easy(&path(name));
        // More generations than lines fit into a pipe without a reader: the run cannot end before it is killed.
        train.args(["--generations", "130", "--threads", threads]);
        train
    };
    succeed(train("one", "1").arg("--quiet"));
    succeed(train("two", "2").arg("--quiet"));
    assert_same_run(&path("one"), &path("two"));
    assert!(
        tier(&path("one")) >= Some(1),
        "the champion selection has found a usable one, so its tiers are compared too"
    );
    kill_after(&mut train("killed", "1"), &path("killed"), 9);
    succeed(gambol("resume").arg(path("killed")).args(["--threads", "2", "--no-report"]));
    assert_same_run(&path("one"), &path("killed"));
    Ok(())
}

#[test]
fn wrong_times_and_ends_are_named() -> Outcome {
    let folder = tempfile::tempdir()?;
    let train = ["train", "biped-1", "running"];
    let gaits = ["bench", "gaits"];
    for (command, flags, says) in [
        (&train[..], &["--budget", "10"][..], "'--budget <TIME>': must be a number and a unit: 500ms, 10s, 5m or 1h"),
        (&train, &["--budget", "10x"], "'--budget <TIME>': must be a number and a unit"),
        (&train, &["--budget", "x"], "'--budget <TIME>': must be"),
        (&train, &["--budget", ""], "'--budget <TIME>'"),
        (&train, &["--budget", "s"], "'--budget <TIME>': must begin with a number"),
        (&train, &["--budget", "1.2.3s"], "'--budget <TIME>': must begin with a number"),
        (&train, &["--budget=-5s"], "'--budget <TIME>': must be"),
        (&train, &["--budget", "0s"], "'--budget <TIME>': must be longer than nothing"),
        (&train, &["--budget", "10s", "--minutes", "1"], "'--budget <TIME>' cannot be used with"),
        (&train, &["--until", "perfect"], "invalid value 'perfect' for '--until <WHAT>'\n  [possible values: usable]"),
        (&gaits, &["--seconds", "0"], "'--seconds <SECONDS>': must be a number above 0"),
        (&gaits, &["--seconds", "soon"], "'--seconds <SECONDS>': must be a number above 0"),
        (&gaits, &["--seconds", "inf"], "'--seconds <SECONDS>': must be a number above 0"),
        (&gaits, &["--keep", "runs"], "--steps <STEPS>"),
        (&gaits, &["--keep", "runs", "--seconds", "1"], "cannot be used with"),
        (&gaits, &["--seconds", "1", "--steps", "1000"], "'--seconds <SECONDS>' cannot be used with"),
        (&gaits, &["--seeds", "0"], "'--seeds <SEEDS>': 0 is not in 1..=10000"),
    ] {
        let ended = run(gambol(command[0]).args(&command[1..]).args(flags).current_dir(folder.path()));
        assert_eq!(ended.code, Some(2), "{flags:?}: {}{}", ended.stdout, ended.stderr);
        assert_says(&ended.stderr, &[says]);
    }
    let bench = |flags: &[&str]| run(gambol("bench").arg("gaits").args(flags));
    for (flags, says) in [
        (&["--creatures", "bipde-1"][..], "did you mean \"biped-1\"?"),
        (&["--movements", "runing"], "did you mean \"running\"?"),
        (&["--preset", "defualt"], "did you mean \"default\"?"),
        (&["--set", "training_steps=0"], "training_steps = 0: must be from 1 to 1000000"),
        (&["--steps", "0"], "stop.steps = 0: must be at least 1"),
        (&["--set", "seed=3"], "--set seed=3: these runs have seeds and a budget of their own (--first-seed, --seeds"),
        (&["--set", "stop.generations=1"], "--set stop.generations=1: these runs have seeds and a budget of their own"),
        (&["--ablate", "the tern"], "no variant has \"the tern\" in its name"),
        (
            &["--at-once", "2"],
            "runs that count seconds are done one by one; to have --at-once, count steps: --steps 3000000",
        ),
    ] {
        let ended = bench(flags);
        assert_eq!(ended.code, Some(1), "{flags:?}: {}{}", ended.stdout, ended.stderr);
        assert_says(&ended.stderr, &[says]);
    }
    let unjudged = bench(&["--movements", "running,walking", "--creatures", "biped-1", "--steps", "20000"]);
    assert_eq!((unjudged.code, &*unjudged.stdout), (Some(1), ""), "before the first run");
    assert_says(&unjudged.stderr, &["stop.tier = a tier"]);
    // Where no gaits are judged, no champion is ever usable.
    for flags in
        [&["running", "--set", "training_steps=null", "--variation", "none"][..], &["running", "--preset", "thesis"]]
    {
        let mut train = gambol("train");
        train.args(["biped-1", "--until", "usable"]).args(flags).current_dir(folder.path());
        assert_says(
            &fail(&mut train),
            &["stop.tier = a tier (--until usable): must be null where no gaits are judged"],
        );
    }
    assert_eq!(std::fs::read_dir(folder.path())?.count(), 0, "nothing was begun");
    Ok(())
}

/// Counted in steps it is the same on every machine.
#[test]
fn bench_gaits_tells_every_run() -> Outcome {
    let arguments = ["--creatures", "tetrapod-1", "--movements", "jumping", "--seeds", "2", "--steps", "20000"];
    let bench = |flags: &[&str]| {
        let mut bench = gambol("bench");
        bench.arg("gaits").args(arguments).args(flags);
        succeed(&mut bench)
    };
    let runs = || -> Result<Vec<Value>, serde_json::Error> {
        let mut runs = bench(&["--json"]).lines().map(serde_json::from_str).collect::<Result<Vec<Value>, _>>()?;
        for run in &mut runs {
            assert!(run["seconds"].as_f64() > Some(0.0), "{run}");
            for clock in ["seconds", "seconds_to_usable"] {
                run.as_object_mut().expect("an object").remove(clock);
            }
        }
        Ok(runs)
    };
    let first = runs()?;
    assert_eq!(first, runs()?);
    for (run, seed) in first.iter().zip(1_u64..) {
        assert_eq!(
            (&run["creature"], &run["movement"], &run["seed"]),
            (&"tetrapod-1".into(), &"jumping".into(), &seed.into())
        );
        assert_eq!(run["usable"] == true, run["reasons"].as_array().is_some_and(Vec::is_empty), "{run}");
    }
    assert_says(&bench(&[]), &["20000 physics steps a run, or until usable, 2 seeds", "tetrapod-1", "jumping", "/2"]);
    // The same table as a file, once.
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("table.csv");
    let flags = ["--csv", file.to_str().expect("UTF-8")];
    bench(&flags);
    let table = std::fs::read_to_string(&file)?;
    let rows: Vec<Vec<&str>> = table.lines().map(|row| row.split(',').collect()).collect();
    assert_eq!(rows[0][..3], ["creature", "movement", "usable"]);
    assert!(!rows[0].contains(&"robust"), "it was not measured: {table}");
    assert_eq!((rows.len(), &rows[1][..2]), (2, &["tetrapod-1", "jumping"][..]));
    assert_eq!(rows[1].len(), rows[0].len());
    let mut again = gambol("bench");
    again.arg("gaits").args(arguments).args(flags);
    assert_says(&fail(&mut again), &["table.csv exists; say --force to overwrite it"]);
    assert_eq!(std::fs::read_to_string(&file)?, table);
    // A folder that is a file cannot be made.
    let mut on_a_file = gambol("bench");
    on_a_file.arg("gaits").args(arguments).args(["--keep", file.to_str().expect("UTF-8")]);
    assert_says(&fail(&mut on_a_file), &["cannot write", "table.csv"]);
    // Runs that are kept are not done again: their seconds are those of the first time. Two at once find the same.
    let kept = folder.path().join("kept");
    let keep = ["--json", "--at-once", "2", "--keep", kept.to_str().expect("UTF-8")];
    let all = bench(&keep);
    assert_eq!(std::fs::read_dir(&kept)?.count(), 2);
    assert_eq!(all, bench(&keep));
    let steps = |text: &str| -> Vec<Value> {
        let runs = text.lines().map(|line| serde_json::from_str(line).expect("JSON"));
        runs.map(|run: Value| run["steps"].clone()).collect()
    };
    assert_eq!(steps(&all), first.iter().map(|run| run["steps"].clone()).collect::<Vec<_>>());
    Ok(())
}

/// The steps are those of all stages. A gait that is usable in a stage before the one the run is for does not count.
#[test]
fn bench_gaits_trains_a_movement_with_stages() -> Outcome {
    let stages = |second: &str| {
        format!(r#"stages=[{{"name":"a","promotion":{{"generations":30}}}},{{"name":"b","changes":{second}}}]"#)
    };
    let told = |second: &str, more: &[&str]| -> Result<Value, serde_json::Error> {
        let mut bench = gambol("bench");
        bench.args([
            "gaits",
            "--creatures",
            "tetrapod-1",
            "--movements",
            "running",
            "--first-seed",
            "5",
            "--seeds",
            "1",
        ]);
        serde_json::from_str(&succeed(bench.args(["--json", "--set", &stages(second)]).args(more)))
    };
    let gaps = r#"{"terrain":"gaps:0.1"}"#;
    // Usable after ten generations; the second stage is of the same gaits on another ground.
    let both = told(gaps, &["--steps", "3000000"])?;
    assert_eq!((&both["usable"], both["steps_to_usable"] == both["steps"]), (&true.into(), true), "{both}");
    assert!(both["generations"].as_u64() > Some(30), "{both}");
    let first = told(gaps, &["--steps", "150000"])?;
    assert!(first["generations"].as_u64() < Some(30), "{first}");
    assert_eq!((&first["usable"], &first["steps_to_usable"]), (&false.into(), &Value::Null), "{first}");
    assert_says(
        &first["reasons"].to_string(),
        &["the run ended in a stage before the one that learns what the run is for"],
    );
    // So it is with `train`, which says why.
    let folder = tempfile::tempdir()?;
    let mut train = gambol("train");
    train.args(["tetrapod-1", "running", "--until", "usable", "--steps", "150000", "--no-report", "--out"]);
    train.arg(folder.path().join("run")).args(["--set", &stages(gaps)]);
    let ended = run(&mut train);
    assert_eq!(ended.code, Some(3), "{}{}", ended.stdout, ended.stderr);
    assert_says(
        &ended.stdout,
        &["usable, in ", "; but the run ended in a stage before the one that learns what the run is for"],
    );
    // Where the second stage is of the same task, it does.
    let same = told("{}", &["--steps", "3000000"])?;
    assert_eq!((&same["usable"], same["generations"].as_u64() < Some(30)), (&true.into(), true), "{same}");
    Ok(())
}

/// The stages are those of the preset. That a body moves as it is told says nothing of jumps.
#[test]
fn bench_gaits_trains_playing() -> Outcome {
    let mut bench = gambol("bench");
    bench.args(["gaits", "--creatures", "tetrapod-1", "--movements", "playing", "--seeds", "1", "--json"]);
    bench.args(["--steps", "3000", "--set", "training_steps=20", "--set", "strategy.cma-es.population=8"]);
    let told: Value = serde_json::from_str(&succeed(&mut bench))?;
    assert!(told["steps"].as_u64() >= Some(3000), "{told}");
    assert_eq!((&told["usable"], &told["steps_to_usable"]), (&false.into(), &Value::Null));
    let why = "the run ended in a stage before the one that learns what the run is for";
    assert_says(&told["reasons"].to_string(), &["told to move at", why]);
    Ok(())
}

/// What the limbs share is a topology like any other: kept by a champion, searched anew, and drawn.
#[test]
fn the_net_of_limbs_can_be_kept_and_left_out() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    succeed(easy(&path("limbs")).args(["--generations", "2", "--quiet"]));
    let champion = path("limbs").join("champion.json");
    let mut train = easy(&path("again"));
    train.args(["--generations", "2", "--quiet", "--topology-from", text(&champion)]);
    succeed(&mut train);
    let whole =
        ["--generations", "2", "--quiet", "--set", "controller.modular=null", "--set", "controller.actuation=speed"];
    succeed(easy(&path("whole")).args(whole));
    for name in ["limbs", "again", "whole"] {
        assert_says(&succeed(gambol("verify").arg(path(name).join("champion.json"))), &["identical: "]);
    }
    let shape = |name: &str| json(&path(name).join("champion.json"))["content"]["network"]["shape"].take();
    assert_eq!(shape("limbs"), shape("again"));
    assert_ne!(shape("limbs"), shape("whole"));
    Ok(())
}
