//! Comparisons: every run is done once, by whichever process, and the parts give the whole.

use crate::{
    folder::read,
    program::{assert_says, fail, gambol, run, start, succeed, text},
};
use serde_json::Value;
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Two strategies, one creature, two movements, two seeds: eight runs of a blink.
fn small(out: &Path) -> Command {
    small_of(out, 100)
}

/// As [`small`], with runs of so many evaluations.
fn small_of(out: &Path, evaluations: u32) -> Command {
    let mut compare = gambol("compare");
    compare.args(["--strategies", "ga,thesis", "--creatures", "biped-1", "--movements", "running,jumping"]);
    compare.args(["--seeds", "2", "--set", "movement.steps=40", "--evaluations", &evaluations.to_string()]);
    compare.arg("--out").arg(out);
    compare
}

/// Scores without the seconds, which are the last column.
fn scores(folder: &Path) -> Vec<String> {
    let text = String::from_utf8(read(&folder.join("scores.csv"))).expect("text");
    text.lines().map(|line| line.rsplit_once(',').expect("columns").0.to_owned()).collect()
}

#[test]
fn all_runs_are_done_and_the_outcome_is_written() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("whole");
    let printed = succeed(&mut small(&out));
    assert_says(&printed, &["ga", "thesis", "biped-1 running", "biped-1 jumping", "comparison.html"]);
    assert_eq!(scores(&out).len(), 1 + 8);
    assert!(fs::read_to_string(out.join("comparison.html"))?.contains("<html"));
    assert!(fs::read_to_string(out.join("curves.csv"))?.lines().count() > 8);
    // Again: nothing is left to be done, and the same comes out.
    let before = scores(&out);
    succeed(small(&out).arg("--quiet"));
    assert_eq!(scores(&out), before);
    Ok(())
}

#[test]
fn parts_done_elsewhere_and_runs_side_by_side_give_the_whole() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    succeed(small(&path("whole")).args(["--quiet", "--at-once", "1", "--threads", "2"]));
    for part in ["1/3", "2/3", "3/3"] {
        let out = path(&part.replace('/', "-of-"));
        assert_says(&succeed(small(&out).args(["--part", part])), &["gambol merge"]);
    }
    let parts = ["1-of-3", "2-of-3", "3-of-3"].map(path);
    succeed(gambol("merge").args(&parts).arg("--out").arg(path("merged")));
    assert_eq!(scores(&path("merged")), scores(&path("whole")));

    let message = fail(gambol("merge").args(&parts[..2]).arg("--out").arg(path("gap")));
    assert_says(&message, &["2 of 8 runs are missing; the first is: ", ", seed "]);
    assert!(!path("gap").exists());
    let mut other = small(&path("other"));
    succeed(other.args(["--quiet", "--set", "movement.steps=41", "--part", "3/3"]));
    let message = fail(gambol("merge").args(&parts[..2]).arg(path("other")).arg("--out").arg(path("mixed")));
    assert_says(&message, &["are not parts of one comparison: they differ in the settings of the runs"]);
    let message = fail(gambol("merge").arg(path("nowhere")).arg("--out").arg(path("nothing")));
    assert_says(&message, &["is not the folder of a comparison"]);
    Ok(())
}

#[test]
fn killed_and_started_again_it_goes_on() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
    succeed(small_of(&whole, 2000).arg("--quiet"));
    let mut child = start(&mut small_of(&broken, 2000));
    while !broken.join("runs").exists() && child.try_wait()?.is_none() {
        std::thread::yield_now();
    }
    child.kill()?;
    child.wait()?;
    succeed(small_of(&broken, 2000).arg("--quiet"));
    assert_eq!(scores(&broken), scores(&whole));
    Ok(())
}

#[test]
fn a_changed_result_is_noticed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    succeed(small(&path("whole")).arg("--quiet"));
    let file = path("whole").join("results/ga/biped-1-running/seed-1.json");
    let text = fs::read_to_string(&file)?;
    fs::write(&file, text.replacen("\"seed\":1", "\"seed\":3", 1))?;
    let message = fail(gambol("merge").arg(path("whole")).arg("--out").arg(path("again")));
    assert_says(&message, &["seed-1.json was changed after it was written"]);
    Ok(())
}

#[test]
fn a_result_in_the_place_of_another_is_noticed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let whole = folder.path().join("whole");
    succeed(small(&whole).arg("--quiet"));
    let place = whole.join("results/ga/biped-1-running");
    fs::copy(place.join("seed-1.json"), place.join("seed-2.json"))?;
    let message = fail(gambol("merge").arg(&whole).arg("--out").arg(folder.path().join("again")));
    assert_says(&message, &["seed-2.json is the result of another run (ga, biped-1 running, seed 1), not of ga"]);
    Ok(())
}

#[test]
fn two_processes_share_the_work() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, shared) = (folder.path().join("whole"), folder.path().join("shared"));
    succeed(small_of(&whole, 1000).arg("--quiet"));
    let mut other = start(&mut small_of(&shared, 1000));
    let ended = run(small_of(&shared, 1000).arg("--quiet"));
    let other = other.wait()?;
    // The plan may be written by one while the other looks: then one has to be called again. Neither breaks a run.
    assert!(ended.code == Some(0) || other.success(), "{}", ended.stderr);
    succeed(small_of(&shared, 1000).arg("--quiet"));
    assert_eq!(scores(&shared), scores(&whole));
    Ok(())
}

#[test]
fn while_others_are_at_work_there_is_no_comparison_and_that_is_no_success() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("shared");
    // No machine comes to its end before it is killed.
    let endless = || {
        let mut compare = small_of(&out, 1_000_000_000);
        compare.args(["--at-once", "8", "--threads", "1"]);
        compare
    };
    let mut other = start(&mut endless());
    let log = |run: &str| out.join("runs").join(run).join("log.jsonl");
    let runs = ["ga", "thesis"].iter().flat_map(|strategy| {
        ["running", "jumping"]
            .iter()
            .flat_map(move |movement| (1..=2).map(move |seed| format!("{strategy}/biped-1-{movement}/seed-{seed}")))
    });
    for run in runs {
        while !log(&run).is_file() {
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
    }
    let ended = run(&mut endless());
    let killed = other.kill();
    other.wait()?;
    killed?;
    assert_eq!(ended.code, Some(4), "{}{}", ended.stdout, ended.stderr);
    assert_says(&ended.stdout, &["8 runs are being done by other processes; when they have ended, repeat the command"]);
    assert!(!out.join("comparison.html").exists());
    Ok(())
}

#[test]
fn with_a_preset_all_are_alike_and_it_is_told_what_they_had() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (preset, test, hidden) in
        [("plain", "Rank-sum tests of independent runs", 10), ("shaped", "Signed-rank tests of pairs", 4)]
    {
        let out = folder.path().join(preset);
        let mut compare = gambol("compare");
        compare.args(["--strategies", "neat,random-search", "--preset", preset, "--creatures", "biped-1"]);
        compare.args(["--movements", "jumping", "--seeds", "2", "--first-seed", "1001", "--evaluations", "200"]);
        let printed = succeed(compare.args(["--set", "movement.steps=40", "--out"]).arg(&out));
        assert_says(&printed, &[test]);
        assert_eq!(printed.contains("median with terms"), preset == "shaped");
        assert!(scores(&out)[1].starts_with("neat,biped-1 jumping,1001,"), "{:?}", scores(&out));
        let had = fs::read_to_string(out.join("settings.csv"))?;
        assert_says(&had, &["neat,biped-1 jumping,strategy.neat.population,", ",its own defaults", ",by --set"]);
        assert_says(&had, &["neat,biped-1 jumping,controller.hidden,null,not used: neat finds its nets itself"]);
        assert_says(&had, &[&format!("random-search,biped-1 jumping,controller.hidden,[{hidden}],preset {preset}")]);
    }
    // By the fitness, a champion of the shaped runs need not score what it comes to without terms.
    let rows = scores(&folder.path().join("shaped"));
    let differs = |row: &String| {
        let cells: Vec<&str> = row.split(',').collect();
        cells[3] != cells[5]
    };
    assert!(rows[1..].iter().any(differs), "{rows:?}");
    Ok(())
}

#[test]
fn a_tuning_goes_on_and_gives_a_file_that_compare_takes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("tune");
    let tune = |more: &[&str]| {
        let mut tune = gambol("tune");
        tune.args(["hill-climbing", "--creatures", "biped-1", "--movements", "jumping", "--trials", "3"]);
        tune.args(["--seeds", "2", "--evaluations", "100", "--set", "movement.steps=40", "--quiet"]).args(more);
        tune
    };
    let best = succeed(tune(&[]).arg("--out").arg(&out));
    assert_eq!(best, fs::read_to_string(out.join("tuned.json"))?);
    assert_says(&best, &["\"strategy\"", "\"hill-climbing\"", "\"mutation_deviation\""]);
    assert_eq!(succeed(tune(&[]).arg("--out").arg(&out)), best, "nothing is left to be done");
    let message = fail(tune(&["--spread", "2"]).arg("--out").arg(&out));
    assert_says(&message, &["holds another tuning", "trial-001.json"]);
    let other = folder.path().join("other");
    fs::create_dir(&other)?;
    fs::write(other.join("tuned.json"), "mine")?;
    assert_says(&fail(tune(&[]).arg("--out").arg(&other)), &["is not empty and holds no tuning"]);
    assert_eq!((fs::read_to_string(other.join("tuned.json"))?.as_str(), fs::read_dir(&other)?.count()), ("mine", 1));
    let mut compare = gambol("compare");
    compare.args(["--strategies", &format!("tuned={},ga", text(&out.join("tuned.json"))), "--preset", "plain"]);
    compare.args(["--creatures", "biped-1", "--movements", "jumping", "--seeds", "1", "--evaluations", "50"]);
    let whole = folder.path().join("whole");
    succeed(compare.args(["--quiet", "--set", "movement.steps=40", "--out"]).arg(&whole));
    assert_says(&fs::read_to_string(whole.join("settings.csv"))?, &["tuned,biped-1 jumping,strategy.hill-climbing."]);
    assert_says(&fail(tune(&[]).args(["--preset", "plian", "--out"]).arg(&whole)), &["did you mean \"plain\"?"]);
    Ok(())
}

#[test]
fn requests_that_make_no_sense_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let compare = |arguments: &[&str]| {
        let mut compare = gambol("compare");
        compare.args(["--creatures", "biped-1", "--evaluations", "10", "--out"]).arg(&out).args(arguments);
        compare
    };
    for (arguments, says) in [
        (&["--strategies", "gaa"][..], "there is no strategy or preset \"gaa\"; did you mean \"ga\"?"),
        (&["--strategies", "../x=y.json"], "\"../x\" is no name for a strategy"),
        (&["--strategies", "ga,ga"], "the strategy \"ga\" is there twice"),
        (&["--strategies", "ga,conventional"], "the strategy \"conventional\" is there twice"),
        (&["--strategies", "ga", "--movements", "running,running"], "the movement \"running\" is there twice"),
        (&["--strategies", "ga", "--creatures", "biped-1"], "the scenario \"biped-1 running\" is there twice"),
        (&["--strategies", "ga", "--creatures", "bipde-2"], "did you mean \"biped-2\"?"),
        (&["--strategies", "ga", "--movements", "runing"], "did you mean \"running\"?"),
        (&["--strategies", "ga", "--set", "seed=7"], "--set seed=7: a comparison has seeds and a budget of its own"),
        (&["--strategies", "ga", "--set", "stop.generations=1"], "--set stop.generations=1: a comparison has"),
        (&["--strategies", "ga", "--set", "strategy.ga.population=5"], "\"ga\" is called \"conventional\""),
        (&["--strategies", "ga,mine=missing.json"], "mine on biped-1 running: cannot read missing.json"),
        (&["--strategies", "ga", "--set", "strategy.conventional.elites=50"], "strategy.conventional.elites = 50"),
        (&["--strategies", "ga,cma-es", "--set", "strategy.cma-es.population=20"], "ga on biped-1 running: --set"),
        (&["--strategies", "ga", "--engine", "rapeir"], "there is no engine \"rapeir\"; did you mean \"rapier\"?"),
        (&["--strategies", "ga", "--variation", "non"], "there is no variation \"non\"; did you mean \"none\"?"),
        (&["--strategies", "ga", "--set", "movement.steps=0"], "ga on biped-1 running: movement.steps = 0"),
        (
            &["--strategies", "ga", "--steps", "900"],
            "give --evaluations or --steps, not both: on biped-1 running the fitness",
        ),
    ] {
        assert_says(&fail(&mut compare(arguments)), &[says]);
    }
    for (arguments, says) in [
        (&["--strategies", "ga", "--part", "0/3"][..], "must be a number and how many parts there are, such as 3/20"),
        (&["--strategies", "ga", "--part", "4/3"], "such as 3/20"),
        (&["--strategies", "ga", "--seeds", "0"], "0 is not in 1.."),
    ] {
        let ended = run(&mut compare(arguments));
        assert_eq!(ended.code, Some(2), "{}", ended.stderr);
        assert_says(&ended.stderr, &[says]);
    }
    assert!(!out.exists(), "nothing was made");

    fs::create_dir(&out)?;
    fs::write(out.join("precious.txt"), "mine")?;
    let message = fail(&mut compare(&["--strategies", "ga"]));
    assert_says(&message, &[text(&out), "already exists and is no comparison"]);
    let begun = folder.path().join("begun");
    succeed(small(&begun).arg("--quiet"));
    let message = fail(&mut small_of(&begun, 200));
    assert_says(&message, &["holds another comparison (the budget)"]);
    Ok(())
}

#[test]
fn what_is_learned_in_stages_is_compared_without_them() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("playing");
    let playing = || {
        let mut compare = gambol("compare");
        compare.args(["--strategies", "ga,cma-es", "--creatures", "biped-1", "--movements", "playing", "--seeds", "2"]);
        compare.args(["--evaluations", "100", "--set", "movement.steps=40"]).arg("--out").arg(&out);
        compare
    };
    let message = "error: ga on biped-1 playing: its configuration has stages, and what is compared are single searches: add --set \
                   stages=[], and each searches for all of it at once";
    assert_says(&fail(&mut playing()), &[message]);
    assert!(!out.exists());
    assert_says(&succeed(playing().args(["--set", "stages=[]"])), &["biped-1 playing", "comparison.html"]);
    Ok(())
}

/// Of thirteen generations the tenth is the last that is re-evaluated, and then the end is. A run whose last generation went beyond the
/// budget would be scored without the latter, so that no run is scored with it.
#[test]
fn in_varied_worlds_a_score_is_that_of_the_last_re_evaluation_before_the_end() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("varied");
    let mut compare = gambol("compare");
    compare.args(["--strategies", "ga", "--creatures", "biped-1", "--movements", "running", "--seeds", "3"]);
    compare.args(["--preset", "plain", "--variation", "light", "--set", "movement.steps=60", "--evaluations", "650"]);
    succeed(compare.arg("--out").arg(&out));
    let mut champions_are_better = 0;
    for line in scores(&out).iter().skip(1) {
        let columns: Vec<&str> = line.split(',').collect();
        let run = out.join("runs/ga/biped-1-running").join(format!("seed-{}", columns[2]));
        let log = fs::read_to_string(run.join("log.jsonl"))?;
        let last: Value = serde_json::from_str(log.lines().last().expect("thirteen generations"))?;
        assert_eq!(columns[3].parse::<f64>()?, last["best_so_far"].as_f64().expect("a number"), "{line}");
        let champion: Value = serde_json::from_slice(&read(&run.join("champion.json")))?;
        champions_are_better += u32::from(champion["content"]["fitness"].as_f64() > last["best_so_far"].as_f64());
    }
    assert!(champions_are_better > 0, "the end was never re-evaluated");
    Ok(())
}
