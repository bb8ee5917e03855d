//! What the tests of the studio have in common.

#![allow(dead_code, reason = "each test uses some of it")]

use serde_json::{Value, json};
use std::{
    path::Path,
    sync::Arc,
    thread,
    time::{Duration, Instant},
};
use studio::{
    Library, Reply, Viewer,
    protocol::{Event, RunState},
};

pub(crate) type Outcome = Result<(), Box<dyn std::error::Error>>;

/// How long a test waits for anything.
const PATIENCE: Duration = Duration::from_secs(60);

/// A page, without a browser.
pub(crate) struct Page {
    pub(crate) viewer: Viewer,
    pub(crate) events: Vec<Event>,
    pub(crate) frames: Vec<Vec<u8>>,
}

impl Page {
    pub(crate) fn new(library: &Arc<Library>) -> Self {
        Self { viewer: Viewer::new(Arc::clone(library)), events: Vec::new(), frames: Vec::new() }
    }

    pub(crate) fn ask(&mut self, request: Value) {
        let replies = self.viewer.answer(&request.to_string());
        self.take(replies);
    }

    pub(crate) fn take(&mut self, replies: Vec<Reply>) {
        for reply in replies {
            match reply {
                Reply::Event(event) => self.events.push(*event),
                Reply::Frame(frame) => self.frames.push(frame),
            }
        }
    }

    pub(crate) fn wait(&mut self, what: &str, is_there: impl Fn(&Event) -> bool) {
        let since = Instant::now();
        while !self.events.iter().any(&is_there) {
            assert!(since.elapsed() < PATIENCE, "{what} never came: {:?}", self.refusals());
            let news = self.viewer.news();
            self.take(news);
            thread::sleep(Duration::from_millis(5));
        }
    }

    pub(crate) fn wait_for(&mut self, state: &str) {
        self.wait(state, |event| matches!(event, Event::State(found) if name(found) == state));
    }

    pub(crate) fn generations(&self) -> Vec<u64> {
        let rows = self.events.iter().filter_map(|event| match event {
            Event::Generations { rows } => Some(rows.iter().map(|row| row.generation)),
            _ => None,
        });
        rows.flatten().collect()
    }

    pub(crate) fn refusals(&self) -> Vec<&str> {
        fn refusal(event: &Event) -> Option<&str> {
            match event {
                Event::Refused { reason, .. } => Some(reason),
                _ => None,
            }
        }
        self.events.iter().filter_map(refusal).collect()
    }

    pub(crate) fn opened(&self) -> String {
        let opened = |event: &Event| match event {
            Event::Opened(opened) => Some(opened.run.clone()),
            _ => None,
        };
        self.events.iter().rev().find_map(opened).expect("a run is open")
    }
}

pub(crate) fn name(state: &RunState) -> &'static str {
    match state {
        RunState::Running => "running",
        RunState::Paused => "paused",
        RunState::Ended { .. } => "ended",
        RunState::Broken { .. } => "broken",
    }
}

pub(crate) fn library(folder: &Path) -> Arc<Library> {
    Arc::new(studio_server::library(Default::default(), folder.join("runs"), 2))
}

pub(crate) fn choice(generations: u64) -> Value {
    json!({ "creature": "biped-1", "movement": "running", "generations": generations, "seed": 7, "set": ["strategy.cma-es.population=16"] })
}
