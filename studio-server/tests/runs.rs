//! What a page does with runs besides watching them: it looks for parents, sets champions beside each other, replays them in other
//! worlds, draws terrains, removes runs.

mod common;

use common::{Outcome, Page, choice, library};
use serde_json::{Value, json};
use std::fs;
use studio::{
    Group, How, Member, Shown,
    protocol::{Event, RunState},
};

/// The arena that was shown last: its place, what it shows, and its members.
fn shown(page: &Page) -> (usize, Shown, Vec<Member>) {
    let arena = |event: &Event| match event {
        Event::Arena { arena, who, members, .. } => Some((*arena, *who, members.clone())),
        _ => None,
    };
    page.events.iter().rev().find_map(arena).expect("an arena")
}

fn bred(strategy: &str, generations: u64) -> Value {
    let mut choice = choice(generations);
    choice["strategy"] = strategy.into();
    choice["set"] = json!([format!("strategy.{strategy}.population=20")]);
    choice
}

#[test]
fn who_is_bred_has_parents_and_a_family() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut page = Page::new(&library(folder.path()));
    for strategy in ["conventional", "neat"] {
        page.events.clear();
        page.ask(json!({ "do": "train", "choice": bred(strategy, 4) }));
        page.wait_for("ended");
        page.ask(json!({ "do": "show", "who": "population" }));
        let (_, who, members) = shown(&page);
        assert_eq!((who, members.len()), (Shown::Population, 20));
        let has_species = |member: &Member| matches!(member.group, Some(Group::Species(_)));
        assert!(members.iter().all(|member| member.group.is_some() && has_species(member) == (strategy == "neat")));
        let descents: Vec<_> = members.iter().map(|member| member.descent.clone().expect("it is known")).collect();
        let place = descents.iter().position(|descent| descent.parents.len() == 2).expect("a crossover in 20");
        assert_eq!(descents[place].how, How::Bred);
        assert!(descents[place].parents.iter().all(|parent| (1..=20).contains(&parent.rank)));
        // What is kept unchanged is as good as it was.
        let kept = descents.iter().find(|descent| descent.how == How::Copy).expect("an elite");
        assert_eq!(kept.parents.len(), 1);
        page.ask(json!({ "do": "show", "who": "population", "family_of": place }));
        let (_, who, family) = shown(&page);
        assert_eq!((who, family.len()), (Shown::Family, 3), "a child and its parents");
        assert_eq!(family[0], members[place]);
        let fitness: Vec<_> = descents[place].parents.iter().map(|parent| parent.fitness).collect();
        assert_eq!(family[1..].iter().map(|parent| parent.fitness).collect::<Vec<_>>(), fitness);
        assert_eq!(page.refusals(), [""; 0]);
    }
    page.ask(json!({ "do": "show", "who": "population", "family_of": 20 }));
    assert_eq!(page.refusals(), ["nothing is known of its parents"]);
    Ok(())
}

#[test]
fn a_strategy_that_breeds_nothing_has_no_families() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut page = Page::new(&library(folder.path()));
    page.ask(json!({ "do": "train", "choice": choice(2) }));
    page.wait_for("ended");
    page.ask(json!({ "do": "show", "who": "population" }));
    let (_, _, members) = shown(&page);
    assert!(members.iter().all(|member| member.group.is_none() && member.descent.is_none()));
    page.ask(json!({ "do": "show", "who": "population", "family_of": 0 }));
    assert_eq!(page.refusals(), ["nothing is known of its parents"]);
    Ok(())
}

#[test]
fn two_champions_move_beside_each_other() -> Outcome {
    let folder = tempfile::tempdir()?;
    let mut page = Page::new(&library(folder.path()));
    for creature in ["biped-1", "tetrapod-1"] {
        let mut choice = choice(3);
        choice["creature"] = creature.into();
        page.events.clear();
        page.ask(json!({ "do": "train", "choice": choice }));
        page.wait_for("ended");
    }
    page.ask(json!({ "do": "show", "who": "champion" }));
    page.ask(json!({ "do": "show", "who": "champion", "run": "biped-1-running", "arena": 1 }));
    assert_eq!(shown(&page).0, 1);
    for arena in [0, 1, 0] {
        page.ask(json!({ "do": "advance", "steps": 5, "arena": arena }));
    }
    let number = |frame: &Vec<u8>| u32::from_le_bytes(frame[..4].try_into().expect("four bytes"));
    let numbers: Vec<u32> = page.frames.iter().map(number).collect();
    assert!(numbers[0] == numbers[2] && numbers[0] != numbers[1], "each arena has its number: {numbers:?}");
    page.wait(
        "the verdict on the other",
        |event| matches!(event, Event::Beside { run, verdict: Some(_), .. } if run == "biped-1-running"),
    );
    // What was meant for something that is shown no more is not done.
    page.frames.clear();
    page.ask(json!({ "do": "advance", "steps": 5, "arena": 0, "number": numbers[1] }));
    assert_eq!(page.frames.len(), 0);
    page.ask(json!({ "do": "advance", "steps": 5, "arena": 0, "number": numbers[0] }));
    assert_eq!(page.frames.len(), 1);
    page.ask(json!({ "do": "leave", "arena": 1 }));
    page.ask(json!({ "do": "advance", "steps": 5, "arena": 1 }));
    page.ask(json!({ "do": "show", "who": "population", "run": "biped-1-running", "arena": 1 }));
    page.ask(json!({ "do": "show", "who": "champion", "arena": 2 }));
    let refusals =
        ["nothing is shown", "only the champion of another run can be shown", "there are two arenas, 0 and 1"];
    assert_eq!(page.refusals(), refusals);
    Ok(())
}

#[test]
fn a_champion_is_replayed_in_other_worlds_and_filmed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let library = library(folder.path());
    let mut page = Page::new(&library);
    page.ask(json!({ "do": "robustness" }));
    assert_eq!(page.refusals(), ["no run is open"]);
    page.ask(json!({ "do": "train", "choice": choice(40) }));
    page.wait_for("ended");
    page.ask(json!({ "do": "robustness" }));
    page.wait("the robustness", |event| matches!(event, Event::Robustness(state) if state.result.is_some()));
    let told = page.events.iter().rev().find_map(|event| match event {
        Event::Robustness(state) => Some(state.clone()),
        _ => None,
    });
    let told = told.ok_or("nothing was told")?;
    assert_eq!(told.worlds, [100, 100]);
    // As the library finds it, all at once.
    let champion = library.folder("biped-1-running")?.champion();
    let champion = gambol_runs::champion::Champion::read(&champion)?;
    let expected = gambol_runs::robust::robustness(&champion, library.registry(), &Default::default())?;
    let result = told.result.ok_or("no result")?;
    assert_eq!((result.usable_share, result.fitness_kept), (expected.usable_share, expected.fitness_kept));
    assert_eq!(result.causes, expected.causes);

    page.ask(json!({ "do": "film", "run": "biped-1-running" }));
    let Some(Event::Film { run, time_step, poses }) = page.events.last() else { return Err("no film".into()) };
    let size = champion.creature.parts.len() * 3;
    assert_eq!((run.as_str(), poses.len() % size), ("biped-1-running", 0));
    assert!(poses.len() >= 2 * size && (0.01..0.5).contains(time_step), "{} poses", poses.len() / size);
    page.ask(json!({ "do": "film", "run": "nothing" }));
    assert!(matches!(page.events.last(), Some(Event::Film { poses, .. }) if poses.is_empty()));
    Ok(())
}

#[test]
fn a_run_is_removed_unless_it_is_trained() -> Outcome {
    let folder = tempfile::tempdir()?;
    let library = library(folder.path());
    let (mut page, mut other) = (Page::new(&library), Page::new(&common::library(folder.path())));
    page.ask(json!({ "do": "train", "choice": choice(1) }));
    page.wait_for("ended");
    page.ask(json!({ "do": "train", "choice": choice(100_000) }));
    page.ask(json!({ "do": "pause" }));
    page.wait_for("paused");
    let remove = |page: &mut Page, run: &str| {
        page.events.clear();
        page.ask(json!({ "do": "remove", "run": run }));
        page.refusals().first().map(|&reason| reason.to_owned())
    };
    let refused = "the run \"biped-1-running-2\" cannot be removed: it is being trained; stop it first";
    assert_eq!(remove(&mut page, "biped-1-running-2").as_deref(), Some(refused));
    // Nor by another program.
    let busy = remove(&mut other, "biped-1-running-2").expect("a refusal");
    assert!(busy.starts_with("the run \"biped-1-running-2\" cannot be removed"), "{busy}");
    assert_eq!(remove(&mut page, "../runs").as_deref(), Some("there is no run \"../runs\""));
    assert_eq!(remove(&mut page, "biped-1-running"), None);
    assert!(!folder.path().join("runs/biped-1-running").exists());
    page.ask(json!({ "do": "stop" }));
    page.wait_for("ended");
    assert_eq!(remove(&mut page, "biped-1-running-2"), None);
    assert_eq!(fs::read_dir(folder.path().join("runs"))?.count(), 0);
    page.events.clear();
    page.ask(json!({ "do": "step" }));
    assert_eq!(page.refusals(), ["no run is open"]);
    Ok(())
}

#[test]
fn a_drawn_creature_is_removed_and_its_runs_stay() -> Outcome {
    let folder = tempfile::tempdir()?;
    let library = library(folder.path());
    let mut page = Page::new(&library);
    let mut drawn = creatures::find("biped-1")?;
    drawn.name = "my biped".into();
    let mut choice = choice(2);
    choice["drawn"] = serde_json::to_value(&drawn)?;
    page.ask(json!({ "do": "train", "choice": choice }));
    page.wait_for("ended");
    // Another program may call a file as it likes.
    let creatures = folder.path().join("runs/creatures");
    fs::copy(creatures.join("my biped.json"), creatures.join("a copy.json"))?;
    let remove = |page: &mut Page, name: &str| {
        page.events.clear();
        page.ask(json!({ "do": "remove-creature", "name": name }));
        page.refusals().first().map(|&reason| reason.to_owned())
    };
    for name in ["biped-1", "a copy", "../creatures/my biped"] {
        let refused = format!("the creature \"{name}\" cannot be removed: none of this name was drawn here");
        assert_eq!(remove(&mut page, name), Some(refused));
    }
    assert_eq!(remove(&mut page, "my biped"), None);
    assert_eq!(fs::read_dir(creatures)?.count(), 0);
    assert!(library.kept().creatures.is_empty());
    page.events.clear();
    page.ask(json!({ "do": "go-on", "generations": 1 }));
    page.wait_for("ended");
    assert_eq!(library.folder("my biped-running")?.read_config()?.creature.name, "my biped");
    Ok(())
}

#[test]
fn a_drawn_terrain_is_kept_and_trained_on() -> Outcome {
    let folder = tempfile::tempdir()?;
    let library = library(folder.path());
    let mut page = Page::new(&library);
    let step = json!({ "box": { "from": 1, "width": 1, "height": 0.05 } });
    let terrain = json!({ "drawn": [step, { "slope": { "from": 3, "width": 1, "rise": 0.2 } }] });
    page.ask(json!({ "do": "check-terrain", "terrain": terrain, "number": 4 }));
    assert!(matches!(page.events.last(), Some(Event::Checked { number: 4, problems }) if problems.is_empty()));
    page.ask(json!({ "do": "keep-terrain", "name": "my hills", "terrain": terrain }));
    let kept = library.catalogue().terrains.into_iter().find(|terrain| terrain.name == "my hills").ok_or("kept")?;
    assert_eq!(kept.drawn.map(|drawn| drawn.len()), Some(2));
    let mut choice = choice(2);
    choice["terrain"] = "my hills".into();
    page.ask(json!({ "do": "train", "choice": choice }));
    page.wait_for("ended");
    assert_eq!(library.folder("biped-1-running")?.read_config()?.terrain.drawn.len(), 2);
    page.ask(json!({ "do": "show", "who": "champion", "terrain": "my hills" }));
    page.ask(json!({ "do": "keep-terrain", "name": "my hills", "terrain": { "drawn": [step] } }));
    assert_eq!(page.refusals(), [""; 0]);
    assert_eq!(library.kept().terrains, ["my hills"], "in place of the one before");
    let long = "x".repeat(65);
    for name in ["../mine", "a/b", "", "..", "x\u{0}", "gaps", &long] {
        page.events.clear();
        page.ask(json!({ "do": "keep-terrain", "name": name, "terrain": terrain }));
        assert_eq!(page.refusals().len(), 1, "{name:?}");
    }
    for (terrain, reason) in [
        (json!({ "drawn": [] }), "nothing is drawn yet"),
        (json!({ "drawn": [step, step] }), "drawn[1].box.from = 1: must be at least 2, where drawn[0] ends"),
        (json!({ "dawn": [step] }), "unknown field `dawn`"),
    ] {
        page.events.clear();
        page.ask(json!({ "do": "keep-terrain", "name": "other", "terrain": terrain }));
        assert!(page.refusals().iter().any(|found| found.contains(reason)), "{reason}: {:?}", page.refusals());
    }
    assert_eq!(fs::read_dir(folder.path().join("runs/terrains"))?.count(), 1);

    // What was trained on it stays.
    page.events.clear();
    page.ask(json!({ "do": "remove-terrain", "name": "my hills" }));
    assert_eq!(page.refusals(), [""; 0]);
    assert!(library.kept().terrains.is_empty());
    assert_eq!(library.folder("biped-1-running")?.read_config()?.terrain.drawn.len(), 2);
    for name in ["my hills", "gaps", "../biped-1-running/config"] {
        page.events.clear();
        page.ask(json!({ "do": "remove-terrain", "name": name }));
        let refused = format!("the terrain \"{name}\" cannot be removed: none of this name was drawn here");
        assert_eq!(page.refusals(), [refused]);
    }
    Ok(())
}

#[test]
fn a_page_begins_with_the_latest_run_or_with_a_biped_that_learns_to_run() -> Outcome {
    let folder = tempfile::tempdir()?;
    let library = library(folder.path());
    let runs = folder.path().join("runs");
    let opened = |page: &Page| {
        page.events.iter().rev().find_map(|event| match event {
            Event::Opened(opened) => Some(opened.run.clone()),
            _ => None,
        })
    };
    let mut page = Page::new(&library);
    page.ask(json!({ "do": "open-latest" }));
    assert_eq!(opened(&page).as_deref(), Some("biped-1-running"));
    page.ask(json!({ "do": "stop" }));
    page.wait_for("ended");
    let mut later = choice(2);
    later["creature"] = "tetrapod-1".into();
    page.events.clear();
    page.ask(json!({ "do": "train", "choice": later }));
    page.wait_for("ended");
    let is_latest = |path: &str, seconds: u64| {
        let file = fs::File::options().append(true).open(runs.join(path).join("config.json"))?;
        file.set_modified(std::time::SystemTime::now() + std::time::Duration::from_secs(seconds))
    };
    // What is no run is passed over, though it is the latest.
    fs::create_dir(runs.join("broken"))?;
    fs::write(runs.join("broken/config.json"), "{}")?;
    is_latest("broken", 60)?;
    for (run, seconds) in [("tetrapod-1-running", 20), ("biped-1-running", 40)] {
        is_latest(run, seconds)?;
        let mut page = Page::new(&library);
        page.ask(json!({ "do": "open-latest" }));
        assert_eq!((opened(&page).as_deref(), page.refusals()), (Some(run), vec![]));
    }
    Ok(())
}

/// Another process shares nothing but the folder.
#[test]
fn a_run_that_another_process_trains_is_followed() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (mut trainer, mut watcher) = (Page::new(&library(folder.path())), Page::new(&library(folder.path())));
    trainer.ask(json!({ "do": "train", "choice": choice(30) }));
    trainer.ask(json!({ "do": "pause" }));
    trainer.wait_for("paused");
    watcher.ask(json!({ "do": "open", "run": "biped-1-running" }));
    trainer.ask(json!({ "do": "go-on" }));
    let last =
        |event: &Event| matches!(event, Event::Generations { rows } if rows.iter().any(|row| row.generation == 30));
    watcher.wait("the last generation", last);
    watcher.wait("a verdict", |event| matches!(event, Event::Verdict(_)));
    trainer.wait_for("ended");
    let is_told = |event: &Event| matches!(event, Event::State(RunState::Ended { reason }) if reason == "saved, after 30 generations");
    watcher.wait("how far it is", is_told);
    assert_eq!(watcher.generations(), (1..=30).collect::<Vec<_>>());
    assert_eq!(watcher.refusals(), [""; 0]);
    Ok(())
}

/// Two programs that have one folder open do not train a run both.
#[test]
fn two_studios_on_one_folder_do_not_train_one_run() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (mut one, mut other) = (Page::new(&library(folder.path())), Page::new(&library(folder.path())));
    one.ask(json!({ "do": "train", "choice": choice(100_000) }));
    one.ask(json!({ "do": "pause" }));
    one.wait_for("paused");
    other.ask(json!({ "do": "open", "run": "biped-1-running" }));
    other.ask(json!({ "do": "go-on", "generations": 5 }));
    other.wait_for("broken");
    let broken = other.events.iter().find_map(|event| match event {
        Event::State(RunState::Broken { reason }) => Some(reason.clone()),
        _ => None,
    });
    let broken = broken.ok_or("no reason")?;
    assert!(broken.starts_with("another gambol is at work in"), "{broken}");
    one.ask(json!({ "do": "stop" }));
    one.wait_for("ended");
    Ok(())
}

#[test]
fn a_run_goes_on_from_another() -> Outcome {
    let folder = tempfile::tempdir()?;
    let library = library(folder.path());
    let mut page = Page::new(&library);
    page.ask(json!({ "do": "train", "choice": choice(4) }));
    page.wait_for("ended");
    let mut next = choice(3);
    (next["movement"], next["from"]) = ("jumping".into(), "biped-1-running".into());
    page.events.clear();
    page.ask(json!({ "do": "train", "choice": next }));
    page.wait_for("ended");
    let config = library.folder("biped-1-jumping")?.read_config()?;
    let origin = config.origin.ok_or("it came from nowhere")?;
    assert!(origin.source.ends_with("biped-1-running") && origin.weights_kept > 0, "{origin:?}");
    let described = |page: &mut Page, choice: &Value| {
        page.ask(json!({ "do": "describe", "choice": choice }));
        match page.events.last() {
            Some(Event::Described(described)) => (described.command.clone(), described.problem.clone()),
            _ => panic!("it is not described"),
        }
    };
    let (command, problem) = described(&mut page, &next);
    assert!(command.contains(" --from ") && command.contains("biped-1-running"), "{command}");
    assert_eq!(problem, None);
    // Another body would lose what was learned; another folder is none.
    next["creature"] = "decapod-1".into();
    let (_, problem) = described(&mut page, &next);
    assert!(problem.as_ref().is_some_and(|problem| problem.contains("would be lost")), "{problem:?}");
    next["from"] = "../elsewhere".into();
    assert_eq!(described(&mut page, &next).1.as_deref(), Some("there is no run \"../elsewhere\""));
    Ok(())
}
