//! A run that is over can be given more; it is then the run that had so much from the start.

use crate::{
    damage::json,
    folder::{assert_same_run, assert_untouched, contents},
    program::{assert_says, fail, gambol, small_run, succeed, text},
};

type Outcome = Result<(), Box<dyn std::error::Error>>;

#[test]
fn more_generations_give_the_bytes_of_a_run_that_had_them_from_the_start() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (grown, whole) = (folder.path().join("grown"), folder.path().join("whole"));
    succeed(small_run(&whole, 12).args(["--threads", "1"]));
    succeed(&mut small_run(&grown, 4));
    for generations in ["9", "12"] {
        succeed(gambol("resume").arg(&grown).args(["--no-report", "--generations", generations]));
    }
    assert_same_run(&whole, &grown);
    Ok(())
}

#[test]
fn more_evaluations_give_the_bytes_of_a_run_that_had_them_from_the_start() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (grown, whole) = (folder.path().join("grown"), folder.path().join("whole"));
    for (path, evaluations) in [(&grown, "24"), (&whole, "56")] {
        let mut train = gambol("train");
        train.args(["biped-1", "running", "--population", "8", "--set", "movement.steps=60", "--no-report"]);
        succeed(train.args(["--evaluations", evaluations, "--out", text(path)]));
    }
    succeed(gambol("resume").arg(&grown).args(["--no-report", "--evaluations", "56"]));
    assert_same_run(&whole, &grown);
    Ok(())
}

/// A limit of an earlier call would end a run that is given more of something else.
#[test]
fn a_budget_takes_the_place_of_all_that_earlier_calls_had() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let stop = || {
        let mut stop = json(&path.join("config.json"))["content"]["stop"].take();
        stop.as_object_mut().expect("an object").retain(|_, limit| !limit.is_null());
        stop
    };
    succeed(small_run(&path, 3).args(["--minutes", "60", "--stagnation", "500"]));
    let resume = |limits: &[&str]| {
        succeed(gambol("resume").arg(&path).args(["--no-report"]).args(limits));
    };
    resume(&["--generations", "5"]);
    assert_eq!(stop(), serde_json::json!({ "generations": 5, "stagnation": 500 }));
    resume(&["--budget", "6ms"]);
    assert_eq!(stop(), serde_json::json!({ "minutes": 0.0001, "stagnation": 500 }));
    let generations = || json(&path.join("checkpoint"))["content"]["progress"]["generations"].as_u64();
    let more = generations().expect("a number") + 2;
    resume(&["--generations", &more.to_string()]);
    assert_eq!((stop().get("minutes").is_none(), generations()), (true, Some(more)));
    Ok(())
}

#[test]
fn a_run_that_is_over_says_how_to_go_on_and_stays_as_it_is() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut small_run(&path, 4));
    for reported in [false, true] {
        if reported {
            // As it would be after a run with a report.
            succeed(gambol("resume").arg(&path));
        }
        let before = contents(&path);
        let longer = "to go on, say --generations 104";
        for (more, how) in [
            (&[][..], longer),
            (&["--generations", "3"], longer),
            (&["--target", "-1000"], longer),
            (&["--evaluations", "8"], "to go on, say more --evaluations"),
            (&["--steps", "8"], "to go on, say more --steps"),
        ] {
            let mut resume = gambol("resume");
            resume.arg(&path).args(more).args((!reported).then_some("--no-report"));
            let message = fail(&mut resume);
            assert_says(&message, &[text(&path), "has ended", how]);
            assert_untouched(&path, &before);
        }
    }
    Ok(())
}

/// Killed after its last save and before its report, or with the report of an earlier end.
#[test]
fn a_run_that_is_over_and_lacks_its_report_gets_one() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut small_run(&path, 4));
    let before = contents(&path);
    assert_says(&succeed(gambol("resume").arg(&path)), &["report    ", "best ", "found in generation"]);
    let of_four = std::fs::read(path.join("report.html"))?;
    std::fs::remove_file(path.join("report.html"))?;
    assert_untouched(&path, &before);
    succeed(gambol("resume").arg(&path).args(["--generations", "6", "--no-report"]));
    std::fs::write(path.join("report.html"), of_four)?;
    succeed(gambol("resume").arg(&path).arg("--quiet"));
    assert_says(&std::fs::read_to_string(path.join("report.html"))?, &["content=\"6 generations, "]);
    Ok(())
}

#[test]
fn a_run_that_is_over_and_lacks_its_champion_gets_it_again() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(&mut small_run(&path, 4));
    let before = contents(&path);
    std::fs::remove_file(path.join("champion.json"))?;
    succeed(gambol("resume").arg(&path).args(["--no-report", "--quiet"]));
    assert_untouched(&path, &before);
    Ok(())
}

/// So that a script may ask for it again.
#[test]
fn a_run_until_usable_that_is_usable_is_no_error() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let mut train = gambol("train");
    train.args(["tetrapod-1", "running", "--until", "usable", "--no-report", "--quiet", "--out"]);
    succeed(train.arg(&path));
    for more in [&[][..], &["--until", "usable"]] {
        succeed(gambol("resume").arg(&path).args(["--no-report", "--quiet"]).args(more));
    }
    Ok(())
}
