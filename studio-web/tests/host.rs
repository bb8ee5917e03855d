//! What a worker trains between the messages of its pages is the run it would have been.

use gambol_runs::{
    Registry,
    request::Request,
    training::{TrainOptions, train},
};
use serde_json::{Value, json};
use std::{
    fs,
    path::{Path, PathBuf},
    time::Duration,
};
use studio::{
    Reply, Shown,
    protocol::{Event, RunState},
};
use studio_web::{Helper, Host, desk::Errand};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const PAGE: u32 = 1;
const GENERATIONS: u64 = 12;
const SET: &str = "strategy.cma-es.population=16";

fn host(folder: &Path) -> Host {
    let mut host = Host::new(Registry::default(), folder.join("runs"));
    host.join(PAGE, true);
    host
}

fn ask(host: &mut Host, request: Value) -> Vec<Event> {
    events(host.answer(PAGE, &request.to_string()))
}

fn events(replies: Vec<Reply>) -> Vec<Event> {
    let event = |reply| match reply {
        Reply::Event(event) => Some(*event),
        Reply::Frame(_) => None,
    };
    replies.into_iter().filter_map(event).collect()
}

fn begin(host: &mut Host) {
    let choice =
        json!({ "creature": "biped-1", "movement": "running", "generations": GENERATIONS, "seed": 7, "set": [SET] });
    let told = ask(host, json!({ "do": "train", "choice": choice }));
    assert!(matches!(told[0], Event::Opened(_)), "{told:?}");
}

fn work(host: &mut Host, turns: usize) {
    for _ in 0..turns {
        host.work();
    }
}

/// Works until the run has ended. What the page was told.
fn finish(host: &mut Host) -> Vec<Event> {
    let mut told = Vec::new();
    loop {
        let wait = host.work();
        told.extend(events(host.news(PAGE)));
        if told.iter().any(|event| matches!(event, Event::State(RunState::Ended { .. }))) {
            return told;
        }
        let broken = told.iter().any(|event| matches!(event, Event::State(RunState::Broken { .. })));
        assert!(wait.is_some() && !broken, "it does not end: {told:?}");
    }
}

/// The files of a run that are the same for the same run, and what is in them.
fn bytes(run: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    ["config.json", "log.jsonl", "champion.json", "checkpoint", "gallery.jsonl"]
        .map(|name| (PathBuf::from(name), fs::read(run.join(name)).expect("a file of the run")))
        .into()
}

fn trained_alone(folder: &Path) -> Outcome {
    let registry = Registry::default();
    let request = Request {
        creature: Some("biped-1".into()),
        movement: Some("running".into()),
        set: vec![SET.into()],
        ..Request::default()
    };
    let mut config = request.resolve(&registry)?;
    (config.seed, config.stop.generations) = (7, Some(GENERATIONS));
    let options = TrainOptions { threads: 1, registry, signal: Default::default(), on_generation: &mut |_| {} };
    train(&config, folder, options)?;
    Ok(())
}

#[test]
fn a_run_between_messages_has_the_same_bytes() -> Outcome {
    let (alone, between, halved) = (tempfile::tempdir()?, tempfile::tempdir()?, tempfile::tempdir()?);
    trained_alone(&alone.path().join("run"))?;
    let expected = bytes(&alone.path().join("run"));

    let mut worker = host(between.path());
    begin(&mut worker);
    for _ in 0..4 {
        worker.work();
        ask(&mut worker, json!({ "do": "show", "who": "population" }));
    }
    ask(&mut worker, json!({ "do": "pause" }));
    work(&mut worker, 4);
    ask(&mut worker, json!({ "do": "step" }));
    work(&mut worker, 2);
    ask(&mut worker, json!({ "do": "go-on" }));
    finish(&mut worker);
    assert!(bytes(&between.path().join("runs/biped-1-running")) == expected);

    // The tab dies: nothing is told to anybody, and nothing is saved.
    let mut worker = host(halved.path());
    begin(&mut worker);
    work(&mut worker, 8);
    drop(worker);
    let mut worker = host(halved.path());
    let opened = ask(&mut worker, json!({ "do": "open", "run": "biped-1-running" }));
    assert!(matches!(opened[0], Event::Opened(_)), "{opened:?}");
    ask(&mut worker, json!({ "do": "go-on" }));
    finish(&mut worker);
    assert!(bytes(&halved.path().join("runs/biped-1-running")) == expected);
    Ok(())
}

#[test]
fn helpers_change_no_byte() -> Outcome {
    let (alone, helped) = (tempfile::tempdir()?, tempfile::tempdir()?);
    trained_alone(&alone.path().join("run"))?;
    let mut worker = host(helped.path());
    let mut helpers = [Helper::default(), Helper::default(), Helper::default()];
    (0..3).for_each(|helper| worker.desk().welcome(helper));
    begin(&mut worker);
    let (mut done, mut underway) = (0, Vec::new());
    let ended = |worker: &mut Host| {
        events(worker.news(PAGE)).iter().any(|event| matches!(event, Event::State(RunState::Ended { .. })))
    };
    while !ended(&mut worker) {
        worker.work();
        underway.extend(std::iter::from_fn(|| worker.desk().errand()));
        // The last that was sent comes back first; now and then a helper goes with what it has, and another comes.
        let Some((number, errand)) = underway.pop() else { continue };
        done += 1;
        if done % 7 == 0 {
            worker.desk().dismiss(number);
            worker.desk().welcome(number);
            // It begins anew, and is told everything.
            helpers[number as usize] = Helper::default();
            continue;
        }
        let errand: Errand = serde_json::from_str(&serde_json::to_string(&errand)?)?;
        let found = helpers[number as usize].run(errand).ok_or("it knows the configuration")?;
        worker.desk().bring(number, serde_json::from_str(&serde_json::to_string(&found)?)?);
    }
    assert!(done > 20, "helpers did {done} pieces");
    assert!(bytes(&helped.path().join("runs/biped-1-running")) == bytes(&alone.path().join("run")));
    Ok(())
}

#[test]
fn a_verdict_does_not_hold_up_the_first_picture() -> Outcome {
    let folder = tempfile::tempdir()?;
    let opened = || {
        let mut runs = host(folder.path());
        ask(&mut runs, json!({ "do": "open", "run": "run" }));
        assert!(runs.work().is_some_and(|wait| wait > Duration::ZERO), "nothing else is to be done");
        assert!(verdict(&mut runs).is_none(), "it was judged before anything could be shown");
        runs
    };
    trained_alone(&folder.path().join("runs/run"))?;

    // It goes to the first helper that comes.
    let mut runs = opened();
    runs.desk().welcome(2);
    assert_eq!(runs.work().map(|wait| wait > Duration::ZERO), Some(true));
    let (helper, errand) = runs.desk().errand().ok_or("there is an errand")?;
    assert!(helper == 2 && matches!(errand, Errand::Judge { .. }), "{errand:?}");
    runs.desk().bring(helper, Helper::default().run(errand).ok_or("it judges")?);
    runs.work();
    let from_the_helper = verdict(&mut runs).ok_or("it was brought")?;

    // Where none comes, it is judged here.
    let mut runs = opened();
    let from_here = loop {
        std::thread::sleep(runs.work().ok_or("it waits for nothing")?);
        if let Some(verdict) = verdict(&mut runs) {
            break verdict;
        }
    };
    assert_eq!(from_here, from_the_helper);
    Ok(())
}

fn verdict(runs: &mut Host) -> Option<Value> {
    let told = events(runs.news(PAGE)).into_iter().map(|event| serde_json::to_value(event).expect("an event"));
    told.into_iter().find(|event| event["is"] == "verdict")
}

#[test]
fn what_moves_can_be_elsewhere() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut runs = host(folder.path());
    begin(&mut runs);
    finish(&mut runs);
    let mut arena = Host::new(Registry::default(), folder.path().join("nothing"));
    arena.join(PAGE, false);
    for (who, named) in [(Shown::Population, "population"), (Shown::Champion, "champion")] {
        let told = ask(&mut runs, json!({ "do": "show", "who": named, "arena": 1 }));
        let scene = serde_json::to_value(&told[0])?;
        assert_eq!(scene["is"], "scene");
        let entered = ask(&mut arena, json!({ "do": "enter", "scene": scene["scene"], "arena": scene["arena"] }));
        assert!(matches!(&entered[0], Event::Arena { who: shown, .. } if *shown == who), "{entered:?}");
        let advance = json!({ "do": "advance", "steps": 60, "arena": 1 }).to_string();
        assert!(matches!(arena.answer(PAGE, &advance)[..], [Reply::Frame(_)]));
    }
    // Each has a world of its own, so there is an end to them.
    let told = ask(&mut runs, json!({ "do": "show", "who": "champion" }));
    let mut scene = serde_json::to_value(&told[0])?["scene"].take();
    scene["entrants"] = vec![scene["entrants"][0].clone(); 1100].into();
    let entered = ask(&mut arena, json!({ "do": "enter", "scene": scene }));
    assert!(matches!(&entered[0], Event::Arena { data, members, .. } if data.actors == 1000 && members.len() == 1000));
    Ok(())
}

#[test]
fn files_have_addresses() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut worker = host(folder.path());
    begin(&mut worker);
    let why = |worker: &Host, address: &str| worker.download(address).expect_err(address).to_string();
    worker.work();
    assert_eq!(why(&worker, "runs/biped-1-running/verify"), "there is no champion yet");
    finish(&mut worker);
    let verified = worker.download("runs/biped-1-running/verify")?;
    assert_eq!(serde_json::from_slice::<Value>(&verified.bytes)?["identical"], true);
    let champion = worker.download("runs/biped%2d1-running/champion.json")?;
    assert_eq!(champion.name.as_deref(), Some("biped-1-running.champion.json"));
    assert!(champion.bytes == fs::read(folder.path().join("runs/biped-1-running/champion.json"))?);
    let report = worker.download("runs/biped-1-running/report")?;
    assert!(String::from_utf8(report.bytes)?.contains("</html>"));
    assert_eq!(why(&worker, "runs/none/report"), "there is no run \"none\"");
    assert_eq!(why(&worker, "runs/..%2fruns%2fbiped-1-running/report"), "there is no run \"../runs/biped-1-running\"");
    assert_eq!(why(&worker, "elsewhere"), "there is no \"elsewhere\"");
    assert_eq!(why(&worker, "runs/biped-1-running/secret"), "there is no \"secret\"");
    assert_eq!(why(&worker, "runs/biped-1-running/export/gof/0"), "there is no format \"gof\"");
    assert_eq!(why(&worker, "runs/biped-1-running/export/player/9"), "there are 1 files");
    Ok(())
}

#[test]
fn what_is_no_message_is_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut worker = host(folder.path());
    for message in ["", "{", "[]", "{\"do\":\"dance\"}", "{\"do\":\"enter\",\"scene\":{}}", "\u{fffd}"] {
        assert!(matches!(events(worker.answer(PAGE, message))[..], [Event::Refused { .. }]), "{message}");
    }
    assert!(worker.answer(PAGE + 1, "{\"do\":\"look\"}").is_empty(), "a page that never came");
    worker.leave(PAGE);
    assert!(worker.news(PAGE).is_empty());
}
