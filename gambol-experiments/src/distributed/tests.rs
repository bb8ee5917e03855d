use super::*;
use crate::{
    compare::{ComparisonFolder, Method, PlanRequest, WorkOptions, work},
    reproduce,
    tune::{TuneRequest, Tuning},
    work::Part,
};
use gambol_runs::request::Request;
use ne_core::StopConditions;

fn comparison() -> crate::compare::Plan {
    let registry = Registry::default();
    let method = |name| Method::parse(name, &registry).expect("a strategy");
    let request = PlanRequest {
        methods: vec![method("ga"), method("cma-es")],
        creatures: vec!["apod".into()],
        movements: vec!["running".into()],
        seeds: vec![1, 2],
        budget: StopConditions { evaluations: Some(64), ..StopConditions::default() },
        set: vec!["movement.steps=30".into()],
        ..PlanRequest::default()
    };
    request.plan(&registry).expect("a plan")
}

fn reproduction(presets: &[&str]) -> reproduce::Plan {
    let request = reproduce::Request {
        creatures: vec!["apod".into()],
        movements: vec!["running".into()],
        presets: presets.iter().map(|&preset| preset.to_owned()).collect(),
        runs: 2,
        generations: 1,
        clock_minutes: None,
    };
    request.plan(&Registry::default()).expect("a plan")
}

fn gaits(steps: Option<u64>) -> Result<GaitStudy, Failed> {
    let request = Request { creature: Some("apod".into()), movement: Some("running".into()), ..Request::default() };
    let stop = StopConditions { steps, ..StopConditions::default() };
    GaitStudy::new(&[request], vec![1, 2], stop, false, &Registry::default())
}

#[test]
fn a_study_has_runs_and_none_of_them_twice() {
    let request = Request { creature: Some("apod".into()), movement: Some("running".into()), ..Request::default() };
    let requests = [request.clone(), request];
    let stop = StopConditions { steps: Some(1000), ..StopConditions::default() };
    for (count, seeds, says) in [
        (1, vec![3, 3], "the seed 3 is there twice"),
        (2, vec![1], "apod running is there twice"),
        (0, vec![1], "at least one creature"),
        (1, vec![], "at least one creature"),
    ] {
        let refused = GaitStudy::new(&requests[..count], seeds, stop, false, &Registry::default()).err();
        let refused = refused.map(|error| error.to_string()).unwrap_or_default();
        assert!(refused.contains(says), "{refused:?}");
    }
}

#[test]
fn a_study_until_usable_ends_each_run_at_the_tier_of_its_movement() {
    let registry = Registry::default();
    for (movement, tier) in [("running", 1), ("playing", 8)] {
        let request =
            Request { creature: Some("tetrapod-1".into()), movement: Some(movement.into()), ..Request::default() };
        let study = |tier| {
            let stop = StopConditions { steps: Some(1000), tier, ..StopConditions::default() };
            GaitStudy::new(std::slice::from_ref(&request), vec![1], stop, false, &registry).expect("a study")
        };
        let digest = |study: GaitStudy| study.digest().expect("a digest");
        assert_eq!(
            digest(study(None).until_usable(&registry).expect("it is judged")),
            digest(study(Some(tier))),
            "{movement}"
        );
        assert_ne!(digest(study(None)), digest(study(Some(tier))), "{movement}");
    }
}

#[test]
fn a_study_until_usable_of_what_is_not_judged_is_refused() {
    let request = Request { creature: Some("apod".into()), movement: Some("standing".into()), ..Request::default() };
    let stop = StopConditions { steps: Some(1000), ..StopConditions::default() };
    let study = GaitStudy::new(&[request], vec![1], stop, false, &Registry::default()).expect("a study");
    let refused = study.until_usable(&Registry::default()).expect_err("standing is not judged").to_string();
    assert!(refused.contains("stop.tier = a tier (--until usable): must be null where no gaits"), "{refused}");
}

fn tuning(draw_seed: u64) -> Tuning {
    let plan = PlanRequest {
        creatures: vec!["apod".into()],
        movements: vec!["running".into()],
        seeds: vec![1],
        budget: StopConditions { evaluations: Some(64), ..StopConditions::default() },
        preset: Some("plain".into()),
        set: vec!["movement.steps=30".into()],
        ..PlanRequest::default()
    };
    let request = TuneRequest { strategy: "cma-es".into(), trials: 3, draw_seed, spread: 4.0, plan };
    request.tuning(&Registry::default()).expect("trials")
}

/// Does the runs from the last to the first, each twice, and one of them as a stranger.
fn is_done_anywhere(experiment: &dyn Experiment) {
    let registry = Registry::default();
    let place = tempfile::tempdir().expect("a folder");
    let folder = place.path().join("whole");
    experiment.begin(&folder).expect("a new folder");
    for run in (0..experiment.runs()).rev() {
        assert!(!experiment.is_done(&folder, run).expect("readable"));
        let result = experiment.carry_out(run, &registry).expect("can be done");
        let again = experiment.carry_out(run, &registry).expect("can be done again");
        assert!(experiment.agree(&result, &again).expect("results"), "{}", experiment.name(run));
        let other = (run + 1) % experiment.runs();
        experiment.place(&folder, other, &result).expect_err("it is of another run");
        let path = experiment.place(&folder, run, &result).expect("can be written");
        assert!(path.starts_with(&folder) && path.is_file());
        experiment.place(&folder, run, &again).expect("a second time");
        assert!(experiment.is_done(&folder, run).expect("readable"));
    }
    experiment.begin(&folder).expect("it is there");
    let written = experiment.conclude(&folder, &registry).expect("all runs are there");
    assert!(!written.is_empty() && written.iter().all(|path| path.is_file()));
    let missing = experiment.carry_out(experiment.runs(), &registry).expect_err("there are fewer");
    assert_eq!(missing.to_string(), format!("there is no run {}", experiment.runs()));
    assert!(experiment.agree("", "").is_err());
}

#[test]
fn every_experiment_is_done_anywhere() {
    is_done_anywhere(&comparison());
    is_done_anywhere(&reproduction(&["thesis"]));
    is_done_anywhere(&gaits(Some(2_000)).expect("a study"));
    is_done_anywhere(&tuning(1));
}

#[test]
fn a_study_of_gaits_with_missing_runs_is_not_concluded_and_does_none_of_them() {
    let study = gaits(Some(2_000)).expect("a study");
    let (registry, place) = (Registry::default(), tempfile::tempdir().expect("a folder"));
    study.begin(place.path()).expect("a new folder");
    let result = study.carry_out(0, &registry).expect("can be done");
    let path = study.place(place.path(), 0, &result).expect("can be written");
    let (all, first) = (study.runs(), study.name(1));
    let error = study.conclude(place.path(), &registry).expect_err("there are more").to_string();
    assert_eq!(error, format!("{} of {all} runs are missing, the first of them {first}", all - 1));
    assert!(!study.is_done(place.path(), 1).expect("readable"));
    std::fs::write(&path, "{}").expect("can be written");
    let damaged = study.is_done(place.path(), 0).expect_err("no result").to_string();
    assert!(damaged.contains(&path.display().to_string()), "{damaged}");
}

#[test]
fn runs_done_elsewhere_are_those_done_here() {
    let plan = comparison();
    let place = tempfile::tempdir().expect("a folder");
    let here = ComparisonFolder::create(&place.path().join("here"), &plan).expect("a new folder");
    let options = WorkOptions {
        part: Part::ALL,
        at_once: 2,
        threads: 1,
        registry: Registry::default(),
        signal: Default::default(),
        on_run: &|_| {},
    };
    assert_eq!(work(&here, &plan, &options).expect("can be done"), 0);
    for (run, job) in plan.jobs().enumerate() {
        let here = read(&here.files.result_file(&job)).expect("it was done");
        let elsewhere = plan.carry_out(run, &options.registry).expect("can be done");
        assert!(plan.agree(&here, &elsewhere).expect("results"));
    }
    let others = [plan.carry_out(0, &options.registry), plan.carry_out(1, &options.registry)];
    let [one, other] = others.map(|result| result.expect("can be done"));
    assert!(!plan.agree(&one, &other).expect("results"), "two runs are not the same");
}

#[test]
fn experiments_are_told_apart() {
    let digest = |experiment: &dyn Experiment| experiment.digest().expect("plain data").to_string();
    assert_eq!(digest(&comparison()), digest(&comparison()));
    assert_ne!(digest(&comparison()), digest(&crate::compare::Plan { seeds: vec![1, 3], ..comparison() }));
    assert_ne!(digest(&reproduction(&["thesis"])), digest(&reproduction(&["default"])));
    assert_eq!(digest(&tuning(1)), digest(&tuning(1)), "wherever its files were");
    assert_ne!(digest(&tuning(1)), digest(&tuning(2)));
    let [one, other] = [1_000, 2_000].map(|steps| gaits(Some(steps)).expect("a study"));
    assert_ne!(digest(&one), digest(&other));
}

#[test]
fn a_study_without_steps_is_refused() {
    let error = gaits(None).expect_err("seconds depend on the machine").to_string();
    assert_eq!(error, "what a run finds in so many minutes depends on the machine: say steps");
}
