//! The results as CSV.

use super::{Judged, Outcome};
use gambol_runs::texts::csv_cell;
use std::fmt::Write;

/// A row for each run: `preset,creature,movement,seed,generations`, then
/// `fitness,champion_generation,distance_m,rise_m,usable,reasons` of its champion.
///
/// What a run does not have is empty. Reasons are separated by semicolons.
pub(super) fn results(outcome: &Outcome) -> String {
    let mut text = String::from("preset,creature,movement,seed,generations,");
    text += JUDGED;
    for run in outcome.cells.iter().flat_map(|cell| &cell.runs) {
        let name = [run.preset.as_str(), &run.creature, &run.movement].join(",");
        let (seed, generations) = (run.seed, run.best.len());
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{name},{seed},{generations},{}", judged(run.champion.as_ref()));
    }
    text
}

/// A row for each run: `preset,creature,movement,seed,threads,seconds`.
pub(super) fn times(outcome: &Outcome) -> String {
    let mut text = String::from("preset,creature,movement,seed,threads,seconds\n");
    for run in outcome.cells.iter().flat_map(|cell| &cell.runs) {
        let name = [run.preset.as_str(), &run.creature, &run.movement].join(",");
        let _ = writeln!(text, "{name},{},{},{}", run.seed, run.threads, run.seconds);
    }
    text
}

/// A row for each moment of each timed run: as [`results`], with `minutes,seconds,threads` in place of the seed.
pub(super) fn timed(outcome: &Outcome) -> String {
    let mut text = String::from("preset,creature,movement,minutes,seconds,threads,generations,");
    text += JUDGED;
    for clock in outcome.cells.iter().filter_map(|cell| cell.clock.as_ref()) {
        let name = [clock.preset.as_str(), &clock.creature, &clock.movement].join(",");
        for mark in &clock.marks {
            let (minutes, seconds, generations) = (mark.minutes, mark.seconds, mark.generations);
            let champion = judged(mark.champion.as_ref());
            let _ = writeln!(text, "{name},{minutes},{seconds},{},{generations},{champion}", clock.threads);
        }
    }
    text
}

const JUDGED: &str = "fitness,champion_generation,distance_m,rise_m,usable,reasons\n";

fn judged(champion: Option<&Judged>) -> String {
    let Some(champion) = champion else { return ",,,,no,every evaluation failed".into() };
    let Judged { fitness, generation, distance_m, rise_m, usable, reasons } = champion;
    let [distance, rise] = [distance_m, rise_m].map(|metres| metres.map_or_else(String::new, |m| m.to_string()));
    let usable = if *usable { "yes" } else { "no" };
    format!("{fitness},{generation},{distance},{rise},{usable},{}", csv_cell(&reasons.join("; ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_champion_is_six_fields() {
        let mut champion = Judged {
            fitness: 1.5,
            generation: 3,
            distance_m: Some(2.25),
            rise_m: None,
            usable: false,
            reasons: vec!["slow, \"very\"".into(), "tilted".into()],
        };
        assert_eq!(judged(Some(&champion)), "1.5,3,2.25,,no,\"slow, \"\"very\"\"; tilted\"");
        champion.reasons.clear();
        champion.usable = true;
        assert_eq!(judged(Some(&champion)), "1.5,3,2.25,,yes,");
        assert_eq!(judged(None).matches(',').count(), 5);
    }
}
