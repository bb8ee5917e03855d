//! How much longer a run takes, on two threads, while a page looks at it that is drawn elsewhere: `cargo bench -p gambol-studio-server`. On a
//! machine that does something else the figures mean nothing.

#![allow(clippy::print_stdout)]

#[path = "../tests/common/mod.rs"]
mod common;

use common::{Outcome, Page, library};
use serde_json::{Value, json};
use std::{
    path::Path,
    sync::atomic::{AtomicBool, Ordering},
    thread,
    time::{Duration, Instant},
};

/// Of two runs: one that is looked at, and one that is not.
const PAIRS: usize = 7;

/// How long a page shows a generation before it shows the next.
const SHOWN: Duration = Duration::from_secs(5);

/// Two bodies, and generations for some seconds.
const RUNS: [(&str, u64); 2] = [("biped-1", 300), ("tetrapod-2", 60)];

fn choice((creature, generations): (&str, u64)) -> Value {
    json!({ "creature": creature, "movement": "running", "generations": generations, "seed": 11 })
}

/// Does what a page does that draws 60 pictures a second of the whole population, without drawing.
fn look(page: &mut Page, is_over: &AtomicBool) {
    let picture = Duration::from_secs_f64(1.0 / 60.0);
    let (mut shown, mut told) = (None::<Instant>, Instant::now());
    while !is_over.load(Ordering::Relaxed) {
        let began = Instant::now();
        if shown.is_none_or(|shown| shown.elapsed() >= SHOWN) {
            page.ask(json!({ "do": "show", "who": "population" }));
            shown = Some(began);
        }
        page.ask(json!({ "do": "advance", "steps": 1 }));
        if told.elapsed() >= Duration::from_millis(50) {
            told = began;
            let news = page.viewer.news();
            page.take(news);
        }
        page.events.clear();
        page.frames.clear();
        thread::sleep(picture.saturating_sub(began.elapsed()));
    }
}

fn seconds(folder: &Path, run: (&str, u64), is_looked_at: bool) -> Result<f64, Box<dyn std::error::Error>> {
    let library = library(folder);
    let mut page = Page::new(&library);
    let began = Instant::now();
    let run = library.train(&serde_json::from_value(choice(run))?)?;
    let is_over = AtomicBool::new(false);
    if is_looked_at {
        page.ask(json!({ "do": "open", "run": run.name() }));
        thread::scope(|scope| {
            scope.spawn(|| look(&mut page, &is_over));
            run.join();
            is_over.store(true, Ordering::Relaxed);
        });
    } else {
        run.join();
    }
    Ok(began.elapsed().as_secs_f64())
}

fn main() -> Outcome {
    for run in RUNS {
        let mut longer = Vec::new();
        for pair in 0..PAIRS {
            let folder = tempfile::tempdir()?;
            // The order changes from pair to pair.
            let first = pair % 2 == 0;
            let one = seconds(&folder.path().join("one"), run, first)?;
            let other = seconds(&folder.path().join("other"), run, !first)?;
            let (looked_at, alone) = if first { (one, other) } else { (other, one) };
            longer.push(100.0 * (looked_at / alone - 1.0));
            println!("{}: {alone:.2} s alone, {looked_at:.2} s looked at", run.0);
        }
        longer.sort_by(f64::total_cmp);
        println!("{}: {:.1} % longer, the median of {longer:.1?}", run.0, longer[PAIRS / 2]);
    }
    Ok(())
}
