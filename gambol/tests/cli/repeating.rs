//! The same configuration gives the same bytes.

use crate::{
    folder::{assert_same_run, read},
    program::{gambol, small_run, small_run_of, succeed},
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn the_same_seed_gives_the_same_bytes_on_any_number_of_threads() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (creature, movement) in [("biped-1", "running"), ("apod", "jumping")] {
        let path = |threads: &str| folder.path().join(format!("{creature}-{threads}"));
        for threads in ["1", "2", "8"] {
            succeed(small_run_of(creature, movement, &path(threads), 6).args(["--seed", "7", "--threads", threads]));
        }
        assert_same_run(&path("1"), &path("2"));
        assert_same_run(&path("1"), &path("8"));
    }
    Ok(())
}

#[test]
fn watching_a_run_does_not_change_it() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |manner: &str| folder.path().join(manner);
    for manner in ["--quiet", "--json"] {
        succeed(small_run(&path(manner), 4).arg(manner));
    }
    assert_same_run(&path("--quiet"), &path("--json"));
    Ok(())
}

#[test]
fn another_seed_gives_another_run() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |seed: &str| folder.path().join(seed);
    for seed in ["1", "2"] {
        succeed(small_run(&path(seed), 3).args(["--seed", seed]));
    }
    for name in ["log.jsonl", "champion.json"] {
        assert_ne!(read(&path("1").join(name)), read(&path("2").join(name)), "{name}");
    }
    Ok(())
}

/// Trials that differ draw random numbers of their own; they repeat as well.
#[test]
fn the_configuration_of_a_run_repeats_it() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (first, again) = (folder.path().join("first"), folder.path().join("again"));
    let mut train = small_run_of("tetrapod-1", "running", &first, 5);
    train.args(["--seed", "3", "--preset", "thesis", "--set", "trials.count=2", "--set", "variation.friction=0.3"]);
    succeed(train.args(["--set", r#"movement.terms=[{"term":"energy","weight":-0.001}]"#]));
    let config = first.join("config.json");
    succeed(gambol("train").arg("--config").arg(config).arg("--out").arg(&again).args([
        "--threads",
        "1",
        "--no-report",
    ]));
    assert_same_run(&first, &again);
    Ok(())
}
