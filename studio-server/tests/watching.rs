//! A run that is watched, paused, stepped and stopped through a page is the run it would have been.

mod common;

use common::{Outcome, Page, choice, library};
use serde_json::{Value, json};
use std::{
    fs,
    path::{Path, PathBuf},
};
use studio::{Shown, protocol::Event};

/// All files of a run but those that tell of the clock.
fn bytes(run: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let mut files: Vec<(PathBuf, Vec<u8>)> =
        ["config.json", "log.jsonl", "gallery.jsonl", "checkpoint", "champion.json"]
            .iter()
            .map(|name| (PathBuf::from(name), fs::read(run.join(name)).expect("a file of the run")))
            .collect();
    files.sort();
    files
}

#[test]
fn a_run_that_is_watched_paused_and_stepped_has_the_bytes_of_one_that_is_not() -> Outcome {
    let (alone, watched) = (tempfile::tempdir()?, tempfile::tempdir()?);
    let quiet = library(alone.path());
    let mut page = Page::new(&quiet);
    page.ask(json!({ "do": "train", "choice": choice(25) }));
    page.wait_for("ended");

    let library = library(watched.path());
    let (mut page, mut other) = (Page::new(&library), Page::new(&library));
    page.ask(json!({ "do": "train", "choice": choice(25) }));
    page.ask(json!({ "do": "pause" }));
    page.wait_for("paused");
    page.ask(json!({ "do": "show", "who": "population" }));
    page.ask(json!({ "do": "advance", "steps": 30 }));
    page.events.clear();
    page.ask(json!({ "do": "step" }));
    page.wait_for("paused");
    other.ask(json!({ "do": "open", "run": "biped-1-running" }));
    other.ask(json!({ "do": "go-on" }));
    other.ask(json!({ "do": "show", "who": "champion" }));
    page.events.retain(|event| matches!(event, Event::Generations { .. }));
    page.wait_for("ended");
    other.wait_for("ended");
    assert_eq!(other.generations(), (1..=25).collect::<Vec<_>>());
    assert_eq!(bytes(&alone.path().join("runs/biped-1-running")), bytes(&watched.path().join("runs/biped-1-running")));
    Ok(())
}

#[test]
fn a_run_that_was_stopped_goes_on_to_the_same_bytes() -> Outcome {
    let (whole, halved) = (tempfile::tempdir()?, tempfile::tempdir()?);
    let mut page = Page::new(&library(whole.path()));
    page.ask(json!({ "do": "train", "choice": choice(60) }));
    page.wait_for("ended");

    let first = library(halved.path());
    let mut page = Page::new(&first);
    page.ask(json!({ "do": "train", "choice": choice(60) }));
    page.ask(json!({ "do": "pause" }));
    page.wait_for("paused");
    // The program ends.
    first.close();
    let mut page = Page::new(&library(halved.path()));
    page.ask(json!({ "do": "open", "run": "biped-1-running" }));
    page.ask(json!({ "do": "go-on" }));
    page.wait_for("running");
    page.wait_for("ended");
    assert_eq!(page.refusals(), [""; 0]);
    let mut generations = page.generations();
    generations.dedup();
    assert_eq!(generations, (1..=60).collect::<Vec<_>>());
    assert_eq!(bytes(&whole.path().join("runs/biped-1-running")), bytes(&halved.path().join("runs/biped-1-running")));
    Ok(())
}

#[test]
fn a_generation_is_shown_at_once_and_moves_as_it_is_asked_to() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut page = Page::new(&library(folder.path()));
    page.ask(json!({ "do": "train", "choice": choice(3) }));
    page.wait_for("ended");
    page.ask(json!({ "do": "show", "who": "population" }));
    let arena = page.events.iter().rev().find_map(|event| match event {
        Event::Arena { arena: 0, number, who, generation, members, data } => {
            Some((*number, *who, *generation, members.clone(), data.clone()))
        }
        _ => None,
    });
    let (number, who, generation, members, data) = arena.ok_or("no arena")?;
    assert_eq!((number, who, generation, data.actors), (1, Shown::Population, 3, 16));
    let fitness: Vec<_> = members.iter().map(|member| member.fitness).collect();
    assert!(fitness.is_sorted_by(|one, other| one >= other), "the best first: {fitness:?}");
    for steps in [0, 10, 10] {
        page.ask(json!({ "do": "advance", "steps": steps }));
    }
    let counts = |frame: &[u8]| -> Vec<u32> {
        frame[..20].chunks_exact(4).map(|bytes| u32::from_le_bytes(bytes.try_into().expect("four"))).collect()
    };
    let steps: Vec<u32> = page.frames.iter().map(|frame| counts(frame)[1]).collect();
    assert_eq!(steps, [0, 10, 20]);
    let parts = data.parts as u32;
    let [shown, _, actors, shown_parts, nodes] = counts(&page.frames[2])[..] else {
        return Err("a short frame".into());
    };
    assert_eq!((shown, actors, shown_parts), (1, 16, parts));
    assert_eq!(page.frames[2].len() as u32, 4 * (5 + 16 * parts * 3 + nodes + 2 + parts));
    // The same again, in one piece.
    page.ask(json!({ "do": "show", "who": "population" }));
    page.ask(json!({ "do": "advance", "steps": 20 }));
    assert_eq!(page.frames[2][4..], page.frames[3][4..], "all but the arena's number");
    Ok(())
}

#[test]
fn a_champion_is_pushed_tilted_and_told_and_what_cannot_be_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut page = Page::new(&library(folder.path()));
    page.ask(json!({ "do": "push", "part": 0, "velocity": [1, 0] }));
    assert_eq!(page.refusals(), ["nothing is shown"]);
    page.ask(json!({ "do": "train", "choice": choice(12) }));
    page.wait_for("ended");
    page.events.clear();
    let end = |page: &mut Page, meddle: Value| {
        page.ask(json!({ "do": "show", "who": "champion" }));
        page.ask(meddle);
        page.ask(json!({ "do": "advance", "steps": 60 }));
        page.frames.last().expect("a frame")[4..].to_vec()
    };
    let still = end(&mut page, json!({ "do": "look" }));
    let meddled = [
        json!({ "do": "push", "part": 0, "velocity": [2, 1] }),
        json!({ "do": "tilt", "angle": 0.3, "factor": 1 }),
        json!({ "do": "put-box", "x": 0.4, "width": 0.2, "height": 0.2 }),
    ];
    for meddle in meddled {
        assert_ne!(end(&mut page, meddle.clone()), still, "{meddle}");
    }
    // It follows no commands: it is told in vain.
    assert_eq!(end(&mut page, json!({ "do": "tell", "speed": 1, "jump": true })), still);
    assert_eq!(page.refusals(), [""; 0]);
    let refused = [
        (json!({ "do": "push", "part": 99, "velocity": [0, 0] }), "a push must be"),
        (json!({ "do": "push", "part": 0, "velocity": [1e30, 0] }), "a push must be"),
        (json!({ "do": "tilt", "angle": 9, "factor": 1 }), "gravity can be turned"),
        (json!({ "do": "put-box", "x": 0, "width": -1, "height": 1 }), "a box must be"),
        (json!({ "do": "show", "who": "champion", "terrain": "gapps" }), "did you mean \"gaps\"?"),
        (json!({ "do": "show", "who": "champion", "friction": -1 }), "friction"),
        (json!({ "do": "open", "run": "nothing" }), "there is no run \"nothing\""),
        (json!({ "do": "dance" }), "unknown variant `dance`"),
        (
            json!({ "do": "train", "choice": { "creature": "biped-1", "movement": "runing" } }),
            "did you mean \"running\"?",
        ),
        (json!({ "do": "open-champion", "name": "mine.json", "text": "{}" }), "mine.json"),
        (json!({ "do": "keep", "creature": { "name": "x" } }), "missing field"),
    ];
    for (request, reason) in refused {
        page.events.clear();
        page.ask(request.clone());
        assert!(page.refusals().iter().any(|found| found.contains(reason)), "{request}: {:?}", page.refusals());
    }
    Ok(())
}

#[test]
fn what_is_told_to_move_moves() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut page = Page::new(&library(folder.path()));
    let mut choice = choice(3);
    choice["movement"] = "playing".into();
    choice["set"] = json!(["strategy.cma-es.population=16", "stages=[]"]);
    page.ask(json!({ "do": "train", "choice": choice }));
    page.wait_for("ended");
    let mut end = |told: Value| {
        page.ask(json!({ "do": "show", "who": "champion" }));
        page.ask(told);
        page.ask(json!({ "do": "advance", "steps": 40 }));
        page.frames.last().expect("a frame")[4..].to_vec()
    };
    let tell = |speed: f32, jump: bool| json!({ "do": "tell", "speed": speed, "jump": jump });
    let (stands, goes, jumps) = (end(tell(0.0, false)), end(tell(1.0, false)), end(tell(0.0, true)));
    assert!(stands != goes && stands != jumps && goes != jumps, "what it is told is heard");
    Ok(())
}

#[test]
fn names_lead_to_no_folder_but_the_runs() -> Outcome {
    let folder = tempfile::tempdir()?;
    let library = library(folder.path());
    let mut page = Page::new(&library);
    page.ask(json!({ "do": "train", "choice": choice(1) }));
    page.wait_for("ended");
    let run = page.opened();
    assert!(library.folder(&run).is_ok());
    // A run, but elsewhere.
    fs::create_dir(folder.path().join("elsewhere"))?;
    fs::copy(folder.path().join("runs").join(&run).join("config.json"), folder.path().join("elsewhere/config.json"))?;
    let absolute = folder.path().join("elsewhere").display().to_string();
    for name in [
        "../elsewhere",
        "..",
        ".",
        "",
        "/",
        "./biped-1-running",
        "biped-1-running/",
        "biped-1-running/../../elsewhere",
        &absolute,
    ] {
        assert!(library.folder(name).is_err(), "{name}");
    }
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink(folder.path().join("elsewhere"), folder.path().join("runs/link"))?;
        assert!(library.folder("link").is_err(), "a link leads elsewhere");
    }
    Ok(())
}

#[test]
fn a_drawn_creature_is_kept_and_trained() -> Outcome {
    let folder = tempfile::tempdir()?;
    let library = library(folder.path());
    let mut page = Page::new(&library);
    let mut drawn = serde_json::to_value(creatures::find("tetrapod-1")?)?;
    drawn["name"] = "mine".into();
    page.ask(json!({ "do": "check", "creature": drawn, "number": 3 }));
    assert!(matches!(page.events.last(), Some(Event::Checked { number: 3, problems }) if problems.is_empty()));
    let mut choice = choice(1);
    choice["drawn"] = drawn.clone();
    page.ask(json!({ "do": "train", "choice": choice }));
    page.wait_for("ended");
    assert_eq!(page.opened(), "mine-running");
    let kept: Value = serde_json::from_slice(&fs::read(folder.path().join("runs/creatures/mine.json"))?)?;
    assert_eq!(kept["name"], "mine");
    assert!(library.catalogue().drawn.contains(&"mine".to_owned()));
    // A name that would be a path is none.
    for name in ["../mine", "a/b", "", "..", "x\u{0}", "biped-1"] {
        drawn["name"] = name.into();
        page.events.clear();
        page.ask(json!({ "do": "keep", "creature": drawn }));
        assert_eq!(page.refusals().len(), 1, "{name:?}");
    }
    assert_eq!(fs::read_dir(folder.path().join("runs/creatures"))?.count(), 1);
    Ok(())
}
