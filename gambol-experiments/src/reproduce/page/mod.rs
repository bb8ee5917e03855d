//! The page: one HTML file that works offline, in the look of the [report](gambol_reports::report) of a run. It has no script:
//! tables and figures are drawn here.
//!
//! What depends on the machine stands in elements of the class `wall`; the rest is the same however the runs were done.

mod chart;
mod figures;
mod tables;

use super::{Outcome, thesis::GENERATIONS};
use gambol_reports::page::{STYLE, escaped, filled, policy};

const PAGE: &str = include_str!("../assets/page.html");
const STYLES: &[&str] = &[STYLE, include_str!("../../compare/assets/style.css"), include_str!("../assets/style.css")];

/// The finished page.
pub(super) fn render(outcome: &Outcome) -> String {
    let style = STYLES.join("\n");
    let values = [
        ("{{POLICY}}", policy(&style, "")),
        ("{{STYLE}}", style),
        ("{{LEAD}}", lead(outcome)),
        ("{{REMARKS}}", shorter(outcome) + &missing(outcome)),
        ("{{GENERATIONS}}", outcome.generations.to_string()),
        ("{{USABLE}}", tables::usable(outcome)),
        ("{{TIMED}}", tables::timed(outcome)),
        ("{{FIGURES}}", figures::all(outcome)),
    ];
    filled(PAGE, &values)
}

fn lead(outcome: &Outcome) -> String {
    let runs: usize = outcome.cells.iter().map(|cell| cell.runs.len()).sum();
    let timed = outcome.cells.iter().filter(|cell| cell.clock.is_some()).count();
    let presets: Vec<&str> = outcome.presets.iter().map(|preset| &*preset.name).collect();
    format!(
        "<strong>{runs} runs</strong> of {} generations, {timed} timed runs; scenarios: {}; presets: {}.",
        outcome.generations,
        outcome.scenarios.len(),
        presets.join(", ")
    )
}

/// That our runs are not as long as those of the thesis.
fn shorter(outcome: &Outcome) -> String {
    if outcome.generations == GENERATIONS {
        return String::new();
    }
    format!(
        "<p class=\"warning\">Our runs have {} generations. What the thesis reports of the end, and its minutes, are of \
         {GENERATIONS}.</p>",
        outcome.generations
    )
}

/// What was asked for and is not there.
fn missing(outcome: &Outcome) -> String {
    if outcome.missing.is_empty() {
        return String::new();
    }
    let names: String = outcome.missing.iter().map(|name| format!("<li>{}</li>", escaped(name))).collect();
    format!(
        "<div class=\"warning\">{} of {} runs are missing: the numbers below are of the others.</div>\
         <details class=\"other\"><summary>Which</summary><ul>{names}</ul></details>",
        outcome.missing.len(),
        outcome.asked
    )
}

/// What stands in a place without a number.
const NONE: &str = "–";

/// A number with two decimals.
fn number(value: Option<f64>) -> String {
    value.map_or_else(|| NONE.into(), |value| format!("{value:.2}"))
}

fn yes(usable: bool) -> &'static str {
    if usable { "yes" } else { "<strong>no</strong>" }
}

/// Seconds, or minutes if there are many, in an element that says that it depends on the machine.
fn wall(seconds: Option<f64>) -> String {
    let text = match seconds {
        None => NONE.into(),
        Some(seconds) if seconds < 100.0 => format!("{seconds:.1} s"),
        Some(seconds) => format!("{:.1} min", seconds / 60.0),
    };
    format!("<span class=\"wall\">{text}</span>")
}

/// The name of a preset, with its colour.
fn preset_name(outcome: &Outcome, name: &str) -> String {
    format!("<span class=\"{}\"><i class=\"swatch\"></i> preset {}</span>", colour(outcome, name), escaped(name))
}

/// The class that gives a preset its colour.
fn colour(outcome: &Outcome, name: &str) -> String {
    let place = outcome.presets.iter().position(|preset| preset.name == name).unwrap_or_default();
    format!("method-{}", place % 8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reproduce::{
        CellOutcome, ClockResult, Judged, Mark, Plan, Request, RunResult,
        plan::{Cell, Job},
    };

    fn judged(fitness: f64) -> Judged {
        let reasons = vec!["left <leg>: no touchdown".to_owned()];
        Judged { fitness, generation: 2, distance_m: Some(3.25), rise_m: None, usable: fitness > 1.0, reasons }
    }

    fn run(cell: &Cell, seed: u64) -> RunResult {
        RunResult {
            preset: cell.preset.name.clone(),
            creature: cell.scenario.creature.into(),
            movement: cell.scenario.movement.into(),
            seed,
            settings: String::new(),
            best: vec![None, Some(seed as f64), Some(2.0 * seed as f64)],
            mean: vec![None, Some(-1e6), Some(0.5)],
            champion: (seed != 3).then(|| judged(seed as f64)),
            threads: 1,
            seconds: 61.0,
        }
    }

    fn outcome(plan: &Plan, runs: u64) -> Outcome {
        let cell = |job: Job| {
            let cell = job.cell().clone();
            let mark = |&minutes: &f64| Mark { minutes, seconds: 60.0 * minutes, generations: 123, champion: None };
            let clock = plan.clock_minutes.as_ref().map(|minutes| ClockResult {
                preset: cell.preset.name.clone(),
                creature: cell.scenario.creature.into(),
                movement: cell.scenario.movement.into(),
                settings: String::new(),
                threads: 1,
                marks: minutes.iter().map(mark).collect(),
            });
            let runs = (1..=runs).map(|seed| run(&cell, seed)).collect();
            CellOutcome { cell, runs, clock }
        };
        let jobs = plan.jobs().filter(|job| matches!(job, Job::Run { seed: 1, .. }));
        Outcome {
            generations: plan.generations,
            presets: plan.presets.clone(),
            scenarios: plan.scenarios.clone(),
            cells: jobs.map(cell).collect(),
            clock_minutes: plan.clock_minutes.clone().unwrap_or_default(),
            asked: plan.jobs().count(),
            missing: if runs == 0 { plan.jobs().map(|job| job.name()).collect() } else { Vec::new() },
        }
    }

    #[test]
    fn stands_alone_with_anything_there_or_missing() {
        let plan = Request { clock_minutes: Some(vec![1.0, 2.0, 5.0]), ..Request::default() }
            .plan(&gambol_runs::Registry::default())
            .expect("a plan");
        for (clocked, runs) in [(true, 3), (false, 1), (false, 0)] {
            let plan = Plan { clock_minutes: plan.clock_minutes.clone().filter(|_| clocked), ..plan.clone() };
            let page = render(&outcome(&plan, runs));
            for reference in ["http:", "https:", "=\"//", "src=", "@import", "url(", "<script", "{{", "NaN", "inf"] {
                assert!(!page.contains(reference), "{runs} runs: the page has {reference}");
            }
            assert_eq!(page.matches("<figure").count(), 14);
            assert_eq!(page.contains("280 of 280 runs are missing"), runs == 0);
            assert_eq!(page.contains("<td>1 of 3</td>"), runs == 3, "seed 2 alone is usable, of three");
        }
    }

    #[test]
    fn words_of_others_are_escaped() {
        let plan = Request { creatures: vec!["apod".into()], ..Request::default() }
            .plan(&gambol_runs::Registry::default())
            .expect("a plan");
        let page = render(&outcome(&plan, 2));
        assert!(page.contains("left &lt;leg&gt;: no touchdown") && !page.contains("<leg>"));
    }
}
