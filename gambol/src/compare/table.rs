//! The outcome as text, for a terminal.

use super::{
    Analysis,
    analysis::{Axis, Estimate, ScenarioFacts, ScenarioStandings, Threshold},
    figures::{count, counted, decimals, listed, number, p_value},
};
use std::fmt::Write;

/// What was found, and the tables behind it: scores and tests of each scenario, then all scenarios together. Of the scores
/// at equal evaluations and at equal steps it shows the [primary](Analysis::primary).
pub fn render(analysis: &Analysis) -> String {
    let mut text = heading(analysis);
    for sentence in &analysis.headline {
        text += &format!("{sentence}\n");
    }
    let standings = analysis.primary_standings();
    for (facts, scenario) in analysis.scenarios.iter().zip(&standings.scenarios) {
        text += &scenario_tables(analysis, facts, scenario, standings.axis);
    }
    text += &overall_tables(analysis);
    if !analysis.caveats.is_empty() {
        text += "\nMind\n";
    }
    for sentence in &analysis.caveats {
        text += &format!("  {sentence}\n");
    }
    text
}

fn heading(analysis: &Analysis) -> String {
    let counts = [
        counted(analysis.methods.len(), "method", "methods"),
        counted(analysis.scenarios.len(), "scenario", "scenarios"),
        counted(analysis.seeds.len(), "seed", "seeds"),
    ];
    let budget = [(analysis.budget.evaluations, Axis::Evaluations), (analysis.budget.steps, Axis::Steps)];
    let budget: Vec<String> = budget
        .iter()
        .filter_map(|(budget, axis)| Some(format!("{} {}", count((*budget)? as f64), axis.name())))
        .collect();
    let budget = if budget.is_empty() { String::new() } else { format!("; a run has {}", budget.join(" or ")) };
    format!("{}{budget}\n", listed(&counts))
}

fn scenario_tables(analysis: &Analysis, facts: &ScenarioFacts, scenario: &ScenarioStandings, axis: Axis) -> String {
    let limit = scenario.limit.map_or_else(|| "–".into(), count);
    let mut text = format!("\n{}, {}, at {limit} {}\n", facts.name, facts.unit, axis.name());
    let places = decimals(scenario.worst.into_iter().chain(scenario.best));
    let show = |value: f64| number(value, places);
    let mut header = ["method", "median", "quartiles", "mean", "best", "worst"].map(String::from).to_vec();
    header.extend(facts.thresholds.iter().map(|threshold| format!("to {}", show(threshold.score))));
    let mut rows = vec![header];
    for (place, (method, scores)) in analysis.methods.iter().zip(&scenario.methods).enumerate() {
        let mut row = vec![method.name.clone()];
        match scores.summary {
            None => row.extend((0..5).map(|_| "–".into())),
            Some(of) => row.extend([
                show(of.median),
                format!("{} to {}", show(of.lower), show(of.upper)),
                show(of.mean),
                show(of.best),
                show(of.worst),
            ]),
        }
        row.extend(facts.thresholds.iter().map(|threshold| time(threshold, place, axis, analysis.seeds.len())));
        rows.push(row);
    }
    text += &aligned(&rows);
    let name = |place: usize| &analysis.methods[place].name;
    let mut rows = vec![["pair", "shift", "p", "p (Holm)", "A12", "effect", ""].map(String::from).to_vec()];
    for pair in &scenario.pairs {
        rows.push(vec![
            format!("{} – {}", name(pair.first), name(pair.second)),
            show(pair.shift),
            p_value(pair.p),
            p_value(pair.p_corrected),
            number(pair.superiority, 2),
            pair.effect.name().into(),
            pair.better
                .map_or_else(|| "no difference claimed".into(), |better| format!("{} scores more", name(better))),
        ]);
    }
    if rows.len() > 1 {
        text += &aligned(&rows);
    }
    text
}

/// What half of the runs needed, and how many got there if not all did.
fn time(threshold: &Threshold, method: usize, axis: Axis, seeds: usize) -> String {
    let time = threshold.methods[method];
    let median = if axis == Axis::Steps { time.steps } else { time.evaluations };
    let median = median.map_or_else(|| "–".into(), count);
    if time.reached == seeds { median } else { format!("{median} ({} of {seeds})", time.reached) }
}

fn overall_tables(analysis: &Analysis) -> String {
    let Some(overall) = &analysis.primary_standings().overall else { return String::new() };
    let interval = |estimate: &Estimate| {
        estimate.interval.map_or_else(|| "–".into(), |ends| ends.map(|end| number(end, 2)).join(" to "))
    };
    let row = |name: String, estimate: &Estimate| vec![name, number(estimate.value, 2), interval(estimate)];
    let scenarios = counted(overall.scenarios.len(), "scenario", "scenarios");
    let mut text = format!("\nOver {scenarios}, scores from 0 (worst run) to 1 (best run)\n");
    let mut rows = vec![["method", "interquartile mean", "95 %"].map(String::from).to_vec()];
    rows.extend(analysis.methods.iter().zip(&overall.methods).map(|(method, mean)| row(method.name.clone(), mean)));
    text += &aligned(&rows);
    let mut rows = vec![["pair", "first better, probability", "95 %"].map(String::from).to_vec()];
    let name = |place: usize| &analysis.methods[place].name;
    let pairs = overall.pairs.iter();
    rows.extend(pairs.map(|pair| row(format!("{} – {}", name(pair.first), name(pair.second)), &pair.probability)));
    if rows.len() > 1 {
        text += &aligned(&rows);
    }
    text
}

/// Columns as wide as they need to be: the first to the left, the others to the right, a last one of words to the left.
fn aligned(rows: &[Vec<String>]) -> String {
    let columns = rows.first().map_or(0, Vec::len);
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let mut text = String::new();
    for row in rows {
        let mut line = String::from(" ");
        for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
            // A column without a title holds words.
            let is_words = column == 0 || rows[0][column].is_empty();
            // Writing to a string cannot fail.
            let _ = if is_words { write!(line, " {cell:<width$} ") } else { write!(line, " {cell:>width$} ") };
        }
        text += line.trim_end();
        text.push('\n');
    }
    text
}
