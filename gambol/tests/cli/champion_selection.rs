//! Where the world varies from generation to generation, the champion is the candidate that does best without
//! variation, in rapier.

use crate::{
    damage::json,
    folder::assert_same_run,
    program::{assert_says, gambol, run, small_run, succeed},
    reporting::data,
};
use serde_json::Value;
use std::{fs, path::Path};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The lines of a log.
fn log(run: &Path) -> Vec<Value> {
    let text = fs::read_to_string(run.join("log.jsonl")).expect("a log");
    text.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect()
}

#[test]
fn log_champion_and_verify_have_both_figures() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let ended = run(small_run(&path, 20).args(["--seed", "5", "--set", "record.candidates=3"]));
    let champion = &json(&path.join("champion.json"))["content"];
    let (fitness, trained) = (champion["fitness"].as_f64().ok_or("a number")?, &champion["trained"]);
    assert_eq!((&champion["trials"]["count"], &champion["variation"]["mass"]), (&1.into(), &0.0.into()));
    assert_eq!((&trained["engine"], &trained["trials"]["count"]), (&"lanes".into(), &3.into()));
    assert!(trained["variation"]["friction"].as_f64() > Some(0.19), "{trained}");
    assert_eq!(trained["diverged"], Value::Null, "lanes and rapier agree");
    assert_eq!(champion["seed"]["generation"], 0, "the run's seed");

    let log = log(&path);
    let re_evaluations: Vec<&Value> = log.iter().filter(|line| line["re_evaluation"].is_object()).collect();
    assert_eq!(re_evaluations.iter().map(|line| &line["generation"]).collect::<Vec<_>>(), [10, 20]);
    assert!(log[8]["best_so_far"].is_null());
    assert_eq!(log[19]["best_so_far"], champion["fitness"]);
    let mine = re_evaluations
        .iter()
        .find(|line| line["re_evaluation"]["judged"] == champion["fitness"])
        .ok_or("it was heard")?;
    assert_eq!(mine["re_evaluation"]["trained"], trained["fitness"]);
    // Of each of ten generations the best, two more of the last, and what the strategy recommends.
    let candidates = re_evaluations.iter().map(|line| &line["re_evaluation"]["candidates"]);
    assert_eq!(candidates.collect::<Vec<_>>(), [13, 13]);

    let in_training = trained["fitness"].as_f64().ok_or("a number")?;
    assert_says(
        &ended.stdout,
        &[&format!("best {fitness:.3} m in rapier ({in_training:.3} m in training), found in ")],
    );
    assert_says(&ended.stderr, &["generation 20/20: best ", " in training, mean ", ", champion ", " m in rapier, "]);
    let verified = succeed(gambol("verify").arg(path.join("champion.json")));
    assert_says(&verified, &[&format!("training: fitness {in_training} in lanes, in worlds that vary"), "identical: "]);
    let verified: Value =
        serde_json::from_str(&succeed(gambol("verify").arg(path.join("champion.json")).arg("--json")))?;
    assert_eq!(verified["trained"]["fitness"], trained["fitness"]);

    succeed(gambol("report").arg(&path));
    let summary = data(&fs::read_to_string(path.join("report.html"))?)["summary"].take();
    assert_eq!((&summary["fitness"], &summary["fitness_in_training"]), (&champion["fitness"], &trained["fitness"]));
    assert_eq!((&summary["judged"], &summary["warning"]), (&true.into(), &Value::Null));
    Ok(())
}

/// Short episodes alone are reason enough for a champion selection.
#[test]
fn what_shows_a_run_knows_whether_there_is_a_champion_selection() -> Outcome {
    let folder = tempfile::tempdir()?;
    for (name, training_steps, judged) in
        [("rehearsed", "training_steps=30", true), ("whole", "training_steps=null", false)]
    {
        let path = folder.path().join(name);
        let ended = run(small_run(&path, 10).args(["--variation", "none", "--set", training_steps]));
        assert_eq!(ended.stderr.contains(" in training, mean "), judged, "{}", ended.stderr);
        succeed(gambol("report").arg(&path));
        assert_eq!(data(&fs::read_to_string(path.join("report.html"))?)["summary"]["judged"], judged);
    }
    Ok(())
}

/// Between two re-evaluations the file has the candidate that would be champion. This does not change how the run goes
/// on.
#[test]
fn a_run_that_ends_between_re_evaluations_has_a_champion_and_goes_on_the_same() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (whole, grown) = (folder.path().join("whole"), folder.path().join("grown"));
    succeed(&mut small_run(&whole, 24));
    succeed(&mut small_run(&grown, 3));
    let fitness = || json(&grown.join("champion.json"))["content"]["fitness"].as_f64();
    assert!(fitness().is_some());
    assert!(json(&grown.join("checkpoint"))["content"]["champion"].is_null());
    for generations in ["9", "10", "13", "24"] {
        succeed(gambol("resume").arg(&grown).args(["--no-report", "--threads", "1", "--generations", generations]));
        // Which may be less than before: the waiting candidates are chosen by the worlds of training.
        assert!(fitness().is_some(), "after {generations} generations");
    }
    assert_same_run(&whole, &grown);
    let waiting = json(&whole.join("checkpoint"))["content"]["candidates"]["each"].as_array().map(Vec::len);
    assert_eq!(waiting, Some(4), "of generations 21 to 24");
    Ok(())
}
