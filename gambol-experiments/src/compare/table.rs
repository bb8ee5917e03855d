//! The outcome as text, for a terminal.

use super::{
    Analysis,
    analysis::{Axis, Estimate, Overall, ScenarioFacts, ScenarioStandings, Threshold},
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

/// The interquartile mean of each method over all scenarios; empty if scores differ on none.
pub fn overall(analysis: &Analysis) -> String {
    analysis.primary_standings().overall.as_ref().map_or_else(String::new, |overall| means(analysis, overall))
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
    let at = if facts.shaped { "at the end of runs of" } else { "at" };
    let mut text = format!("\n{}, {}, {at} {limit} {}\n", facts.name, facts.unit, axis.name());
    let places = decimals(scenario.worst.into_iter().chain(scenario.best));
    let show = |value: f64| number(value, places);
    let mut header = ["method", "median", "quartiles", "mean", "best", "worst"].map(String::from).to_vec();
    if facts.shaped {
        header.push("median with terms".into());
    }
    header.extend(facts.thresholds.iter().map(|threshold| format!("reaches {}", show(threshold.score))));
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
        if facts.shaped {
            row.push(scores.with_terms.map_or_else(|| "–".into(), show));
        }
        row.extend(facts.thresholds.iter().map(|threshold| time(threshold, place, axis, analysis.seeds.len())));
        rows.push(row);
    }
    text += &aligned(&rows);
    if scenario.pairs.is_empty() {
        return text;
    }
    text += &format!("  {}\n", facts.test);
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
    text += &aligned(&rows);
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
    let mut text = means(analysis, overall);
    let mut rows = vec![["pair", "first better, probability", "95 %", "p", "p (Holm)", ""].map(String::from).to_vec()];
    let name = |place: usize| &analysis.methods[place].name;
    let claimed = |better: Option<usize>| {
        better.map_or_else(|| "no difference claimed".into(), |better| format!("{} does better", name(better)))
    };
    rows.extend(overall.pairs.iter().map(|pair| {
        let mut row = row(format!("{} – {}", name(pair.first), name(pair.second)), &pair.probability);
        row.extend([p_value(pair.p), p_value(pair.p_corrected), claimed(pair.better)]);
        row
    }));
    if rows.len() > 1 {
        text += &aligned(&rows);
    }
    text
}

fn means(analysis: &Analysis, overall: &Overall) -> String {
    let scenarios = counted(overall.scenarios.len(), "scenario", "scenarios");
    let mut rows = vec![["method", "interquartile mean", "95 %"].map(String::from).to_vec()];
    rows.extend(analysis.methods.iter().zip(&overall.methods).map(|(method, mean)| row(method.name.clone(), mean)));
    format!("\nOver {scenarios}, scores from 0 (worst run) to 1 (best run)\n{}", aligned(&rows))
}

/// A name, a number and its interval.
fn row(name: String, estimate: &Estimate) -> Vec<String> {
    let interval = estimate.interval.map_or_else(|| "–".into(), |ends| ends.map(|end| number(end, 2)).join(" to "));
    vec![name, number(estimate.value, 2), interval]
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{
        analyse,
        testing::{clear_and_open, comparison},
    };

    /// Golden, to be read.
    #[test]
    fn a_clear_and_an_open_scenario() {
        let (plan, results) = clear_and_open();
        let expected = "\
2 methods, 2 scenarios and 8 seeds; a run has 1,000 evaluations
Over all scenarios no difference can be claimed between strong and weak.
1 of 2 paired tests on single scenarios shows a difference (p ≤ 0.05 after Holm's correction): strong scores more than weak on biped running.

biped running, m, at 1,000 evaluations
  method  median     quartiles  mean  best  worst  reaches 8.4  reaches 15.1
  strong    16.8  14.1 to 19.4  16.8  22.0   11.5          100  500 (5 of 8)
  weak      13.5  11.8 to 15.2  13.5  17.0   10.0          500    – (2 of 8)
  Signed-rank tests of pairs: worlds vary, drawn from seed and generation, so that runs with the same seed meet the same worlds in the same generations.
  pair           shift       p  p (Holm)   A12  effect
  strong – weak    3.2  0.0078    0.0156  0.77   large  strong scores more

apod running, m, at 1,000 evaluations
  method  median     quartiles  mean  best  worst  reaches 2.56  reaches 4.61
  strong    5.12  4.69 to 5.56  5.12  6.00   4.25           100  500 (6 of 8)
  weak      5.12  4.69 to 5.56  5.12  6.00   4.25           100  500 (6 of 8)
  Signed-rank tests of pairs: worlds vary, drawn from seed and generation, so that runs with the same seed meet the same worlds in the same generations.
  pair           shift     p  p (Holm)   A12      effect
  strong – weak   0.00  1.00      1.00  0.50  negligible  no difference claimed

Over 2 scenarios, scores from 0 (worst run) to 1 (best run)
  method  interquartile mean          95 %
  strong                0.53  0.33 to 0.74
  weak                  0.37  0.21 to 0.53
  pair           first better, probability          95 %     p  p (Holm)
  strong – weak                       0.63  0.45 to 0.85  0.25      0.25  no difference claimed

Mind
  Bootstrap intervals of so few seeds are too narrow: with 5 seeds an interval of 95 % holds the truth in about 84 % (one scenario) to 91 % (ten scenarios) of cases.
";
        assert_eq!(render(&analyse(&plan, &results)), expected);
    }

    #[test]
    fn without_scores_and_with_one_run_there_are_dashes() {
        let (plan, results) = comparison(&["a"], &["s"], 1, |_, _, _| 1.0);
        let text = render(&analyse(&plan, &results));
        assert!(text.starts_with("1 method, 1 scenario and 1 seed; a run has 1,000 evaluations\n"), "{text}");
        let text = render(&analyse(&plan, &[]));
        assert!(text.contains("s, m, at – evaluations\n"), "{text}");
        assert!(text.contains("  a            –          –     –     –      –\n"), "{text}");
    }
}
