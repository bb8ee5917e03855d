//! Reproducing the thesis: every run is done once, by whichever process and however often it is killed, and the page
//! says what is there and what is missing.

use crate::{
    folder::{assert_same_files, read},
    program::{assert_says, fail, gambol, run, start, succeed, text},
};
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// One creature, one movement, two presets, two runs of three generations.
fn small(out: &Path) -> Command {
    let mut reproduce = reproduce(out);
    reproduce.args(["--creatures", "biped-1", "--movements", "jumping", "--runs", "2", "--generations", "3"]);
    reproduce
}

fn reproduce(out: &Path) -> Command {
    let mut reproduce = gambol("reproduce");
    reproduce.arg("thesis").arg("--out").arg(out);
    reproduce
}

/// What the page says, without what depends on the machine.
fn page(folder: &Path) -> String {
    let page = String::from_utf8(read(&folder.join("index.html"))).expect("text");
    let (_, page) = page.split_once("</style>").expect("a style");
    let mut pieces = page.split("class=\"wall\">");
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |page, piece| page + piece.split_once('<').expect("the end of the element").1)
}

#[test]
fn all_runs_are_done_and_shown_beside_the_thesis() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("whole");
    let ended = run(&mut small(&out));
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert_says(&ended.stderr, &["4/4 after ", "thesis, biped-1 jumping, seed 2: fitness "]);
    assert_says(&ended.stdout, &["4 of 4 runs are there", "index.html", "results.csv"]);
    let shown = page(&out);
    assert_says(
        &shown,
        &[
            "<strong>4 runs</strong> of 3 generations",
            "Our runs have 3 generations",
            "1.93, 2.09, 1.90",
            "<svg",
            "of 2</td>",
        ],
    );
    assert!(!shown.contains("missing"), "nothing is missing");
    let results = String::from_utf8(read(&out.join("results.csv")))?;
    let header =
        "preset,creature,movement,seed,generations,fitness,champion_generation,distance_m,rise_m,usable,reasons";
    assert_eq!(results.lines().next(), Some(header));
    let rows: Vec<&str> = results.lines().skip(1).collect();
    assert_eq!(rows.len(), 4);
    for (row, begins) in rows.iter().zip(["thesis,biped-1,jumping,1,3,", "thesis,biped-1,jumping,2,3,", "default,"]) {
        assert!(row.starts_with(begins), "{row}");
    }
    assert_eq!(String::from_utf8(read(&out.join("times.csv")))?.lines().count(), 1 + 4);

    // Again: nothing is left to be done, and the same comes out.
    let before = read(&out.join("index.html"));
    assert_eq!(succeed(small(&out).arg("--quiet")), "");
    assert!(read(&out.join("index.html")) == before);

    // With less, what is there stays; with more, the rest is added.
    let only = |arguments: &[&str]| {
        let mut command = reproduce(&out);
        command.args(["--quiet", "--generations", "3", "--creatures", "biped-1", "--movements", "jumping"]);
        succeed(command.args(arguments));
        String::from_utf8(read(&out.join("results.csv"))).expect("text")
    };
    assert_eq!(only(&["--runs", "1", "--presets", "thesis"]), results);
    let more = only(&["--runs", "3", "--presets", "thesis"]);
    assert_eq!(more.lines().count(), 1 + 5);
    assert!(rows.iter().all(|row| more.contains(row)));
    Ok(())
}

#[test]
fn parts_together_give_what_one_go_gives() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    succeed(small(&path("whole")).args(["--quiet", "--at-once", "1", "--threads", "2"]));

    let shared = path("shared");
    let printed = succeed(small(&shared).args(["--part", "1/2"]));
    assert_says(&printed, &["2 of 4 runs are there"]);
    assert_says(&page(&shared), &["2 of 4 runs are missing", "<li>default, biped-1 jumping, seed 1</li>", "of 2</td>"]);
    succeed(small(&shared).args(["--quiet", "--part", "2/2"]));
    assert_same_files(&shared, &path("whole"), &["results.csv"]);
    assert_eq!(page(&shared), page(&path("whole")));

    // On another machine: its results are copied.
    let (one, other) = (path("one"), path("other"));
    succeed(small(&one).args(["--quiet", "--part", "1/2"]));
    succeed(small(&other).args(["--quiet", "--part", "2/2"]));
    let results = |out: &Path| out.join("results/default/biped-1-jumping");
    fs::create_dir_all(results(&one))?;
    for seed in ["seed-1.json", "seed-2.json"] {
        fs::copy(results(&other).join(seed), results(&one).join(seed))?;
    }
    assert_says(&succeed(&mut small(&one)), &["4 of 4 runs are there"]);
    assert_same_files(&one, &path("whole"), &["results.csv"]);
    assert_eq!(page(&one), page(&path("whole")));
    Ok(())
}

#[test]
fn killed_and_started_again_it_goes_on() -> Outcome {
    let folder = tempfile::tempdir()?;
    let long = |name: &str| {
        let mut command = reproduce(&folder.path().join(name));
        command.args(["--creatures", "biped-1", "--movements", "jumping", "--presets", "thesis"]);
        command.args(["--runs", "2", "--generations", "12", "--quiet"]);
        command
    };
    let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
    succeed(&mut long("whole"));
    // The first time before a run has ended, the second time after one has.
    let runs = broken.join("runs/thesis/biped-1-jumping");
    let results = broken.join("results/thesis/biped-1-jumping");
    for awaited in [runs.join("seed-1/checkpoint"), results.join("seed-1.json")] {
        let mut child = start(long("broken").args(["--at-once", "1"]));
        while !awaited.exists() && child.try_wait()?.is_none() {
            std::thread::yield_now();
        }
        child.kill()?;
        child.wait()?;
    }
    assert!(results.join("seed-1.json").is_file());
    succeed(&mut long("broken"));
    assert_same_files(&broken, &whole, &["results.csv"]);
    assert_eq!(page(&broken), page(&whole));
    Ok(())
}

#[test]
fn timed_runs_are_looked_at_after_minutes() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("timed");
    let small = |minutes: &str| {
        let mut command = reproduce(&out);
        command.args(["--creatures", "biped-1", "--movements", "jumping", "--presets", "thesis"]);
        command.args(["--runs", "1", "--generations", "1", "--clock", "--clock-minutes", minutes]);
        command
    };
    let without = {
        let mut command = reproduce(&out);
        command.args(["--creatures", "biped-1", "--movements", "jumping", "--presets", "thesis"]);
        command.args(["--runs", "1", "--generations", "1"]);
        succeed(&mut command)
    };
    assert_says(&without, &["1 of 1 runs are there"]);
    assert_says(&page(&out), &["There are no timed runs"]);
    assert_says(&succeed(&mut small("0.005,0.01")), &["2 of 2 runs are there"]);
    let timed = String::from_utf8(read(&out.join("timed.csv")))?;
    let rows: Vec<Vec<&str>> = timed.lines().skip(1).map(|row| row.split(',').collect()).collect();
    assert_eq!(rows.iter().map(|row| row[3]).collect::<Vec<_>>(), ["0.005", "0.01"]);
    for row in &rows {
        let (minutes, seconds): (f64, f64) = (row[3].parse()?, row[4].parse()?);
        assert!(seconds >= 60.0 * minutes, "{timed}");
    }
    let generations: Vec<u64> = rows.iter().map(|row| row[6].parse()).collect::<Result<_, _>>()?;
    assert!(0 < generations[0] && generations[0] <= generations[1], "{timed}");
    assert_says(&page(&out), &["0.005 minutes", "0.01 minutes"]);
    // It is there: the same command does nothing, and other moments are refused.
    assert_eq!(succeed(small("0.005,0.01").arg("--quiet")), "");
    assert_eq!(String::from_utf8(read(&out.join("timed.csv")))?, timed);
    assert_says(&fail(&mut small("0.005")), &["was begun with --clock-minutes 0.005,0.01, not 0.005"]);
    Ok(())
}

#[test]
fn a_folder_with_something_else_is_left_alone() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("precious"))?;
    fs::write(path("precious").join("precious.txt"), "mine")?;
    let message = fail(&mut small(&path("precious")));
    assert_says(&message, &[text(&path("precious")), "already exists and is no reproduction; choose another folder"]);
    let message = fail(&mut small(&path("precious").join("precious.txt")));
    assert_says(&message, &["precious.txt already exists and is no reproduction"]);
    Ok(())
}

#[test]
fn results_that_are_not_what_they_should_be_are_noticed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    succeed(small(&out).arg("--quiet"));
    let of = |preset: &str, seed: u64| out.join(format!("results/{preset}/biped-1-jumping/seed-{seed}.json"));
    let whole = fs::read_to_string(of("thesis", 1))?;
    let with = |content: &str, says: &[&str]| -> Outcome {
        fs::write(of("thesis", 1), content)?;
        assert_says(&fail(&mut small(&out)), says);
        Ok(())
    };
    with(&whole.replacen("\"seed\":1", "\"seed\":7", 1), &["seed-1.json was changed after it was written"])?;
    with(&whole[..whole.len() / 2], &["seed-1.json is damaged or not a file of Gambol"])?;
    let misplaced =
        "is the result of another run (default, biped-1 jumping, seed 2), not of thesis, biped-1 jumping, seed 1";
    with(&fs::read_to_string(of("default", 2))?, &["seed-1.json", misplaced])?;
    with(&fs::read_to_string(out.join("reproduction.json"))?, &["is a \"gambol reproduction\" file, expected a"])?;
    fs::write(of("thesis", 1), &whole)?;
    succeed(small(&out).arg("--quiet"));
    fs::write(out.join("reproduction.json"), "{")?;
    assert_says(&fail(&mut small(&out)), &["reproduction.json is damaged or not a file of Gambol"]);
    Ok(())
}

#[test]
fn a_run_that_was_begun_with_other_settings_is_noticed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    succeed(small(&out).args(["--quiet", "--presets", "thesis", "--part", "2/2"]));
    let run: PathBuf = out.join("runs/thesis/biped-1-jumping/seed-1");
    let mut other = gambol("train");
    other.args(["biped-1", "jumping", "--preset", "thesis", "--population", "8", "--generations", "1", "--no-report"]);
    succeed(other.arg("--quiet").arg("--out").arg(&run));
    let message = fail(small(&out).args(["--presets", "thesis"]));
    assert_says(
        &message,
        &[text(&run), "is the folder of another run: its config.json has another \"record\"", "move it away"],
    );
    // As it says.
    fs::remove_dir_all(&run)?;
    assert_says(&succeed(small(&out).args(["--presets", "thesis"])), &["2 of 2 runs are there"]);
    Ok(())
}

#[test]
fn requests_that_make_no_sense_are_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    for (arguments, says) in [
        (&["--creatures", "bipde-1"][..], "no creature of the thesis \"bipde-1\"; did you mean \"biped-1\"?"),
        (&["--creatures", "apod,apod"], "the creature of the thesis \"apod\" is there twice"),
        (&["--movements", "jumpin"], "no movement of the thesis \"jumpin\"; did you mean \"jumping\"?"),
        (&["--presets", "theses"], "there is no preset \"theses\"; did you mean \"thesis\"?"),
        (&["--presets", "default,default"], "the preset \"default\" is there twice"),
        (&["--clock", "--clock-minutes", "5,1"], "each later than the one before"),
        (&["--clock", "--clock-minutes", "0"], "clock-minutes = 0"),
        (&["--clock", "--clock-minutes", "NaN"], "clock-minutes = NaN"),
    ] {
        assert_says(&fail(reproduce(&out).args(arguments)), &[says]);
    }
    for (arguments, says) in [
        (&["--part", "0/3"][..], "must be a number and how many parts there are, such as 3/20"),
        (&["--part", "4/3"], "such as 3/20"),
        (&["--runs", "0"], "0 is not in 1..=1000"),
        (&["--generations", "0"], "0 is not in 1..=1000000"),
        (&["--clock-minutes", "1,2"], "--clock"),
        (&["--clock", "--clock-minutes", "soon"], "'soon'"),
        (&["--threads", "0"], "0 is not in 1..=1024"),
    ] {
        let ended = run(reproduce(&out).args(arguments));
        assert_eq!(ended.code, Some(2), "{arguments:?}: {}", ended.stderr);
        assert_says(&ended.stderr, &[says]);
    }
    assert!(!out.exists(), "nothing was made");
    let ended = run(gambol("reproduce").arg("theses"));
    assert_eq!(ended.code, Some(2));
    assert_says(&ended.stderr, &["thesis"]);
    Ok(())
}

#[test]
fn other_generations_need_another_folder() -> Outcome {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let one = |generations: &str| {
        let mut command = reproduce(&out);
        command.args(["--creatures", "biped-1", "--movements", "jumping", "--presets", "thesis", "--runs", "1"]);
        command.args(["--quiet", "--generations", generations]);
        command
    };
    succeed(&mut one("1"));
    assert_says(&fail(&mut one("2")), &["was begun with --generations 1, not 2; choose another folder with --out"]);
    Ok(())
}
