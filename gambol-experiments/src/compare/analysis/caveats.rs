//! What must not be concluded, in sentences.

use super::{Analysis, SIGNIFICANCE, standings::Standings};
use crate::compare::figures::{count, counted, decimals, listed, number, p_value};

/// Below this the bootstrap's intervals are clearly too narrow.
const ENOUGH_SEEDS: usize = 10;

/// The sentences.
pub(super) fn caveats(analysis: &Analysis) -> Vec<String> {
    let mut caveats = Vec::new();
    caveats.extend(few_seeds(analysis));
    if (2..ENOUGH_SEEDS).contains(&analysis.seeds.len()) {
        caveats.push(
            "Bootstrap intervals of so few seeds are too narrow: with 5 seeds an interval of 95 % holds the truth in \
             about 84 % (one scenario) to 91 % (ten scenarios) of cases."
                .into(),
        );
    }
    if analysis.scenarios.len() == 1 {
        caveats.push("There is one scenario: nothing is said about other creatures or movements.".into());
    }
    let shaped: Vec<&str> =
        analysis.scenarios.iter().filter(|facts| facts.shaped).map(|facts| facts.name.as_str()).collect();
    if !shaped.is_empty() {
        caveats.push(format!(
            "On {} the fitness has terms. Scores are what the champion at the end of a run comes to in the movement alone, \
             in one whole episode; the last generation of a run may go beyond the budget.",
            listed(&shaped)
        ));
    }
    caveats.extend(left_out(analysis));
    caveats.extend(unscored(analysis, analysis.primary_standings()));
    caveats.extend(ended_early(analysis, &analysis.at_equal_evaluations, analysis.budget.evaluations));
    caveats.extend(ended_early(analysis, &analysis.at_equal_steps, analysis.budget.steps));
    caveats.extend(without_threshold(analysis));
    caveats
}

/// How little even the clearest outcome could show.
fn few_seeds(analysis: &Analysis) -> Option<String> {
    let (seeds, tests) = (analysis.seeds.len(), analysis.primary_standings().tests);
    if seeds == 1 {
        return Some("There is one seed: no interval, no test. With another seed the order may be another.".into());
    }
    // With n pairs, all of one sign, p is 2 / 2ⁿ; with samples of n that do not overlap it is 2 / C(2n, n). Holm multiplies
    // the least p with the number of tests.
    let least_p = |seeds: usize| match analysis.is_paired() {
        true => 2.0 / (0..seeds).fold(1.0, |signings, _| 2.0 * signings),
        false => 2.0 / (1..=seeds).fold(1.0, |deals, place| deals * (seeds + place) as f64 / place as f64),
    };
    let corrected = |seeds| (least_p(seeds) * tests as f64).min(1.0);
    if tests == 0 || corrected(seeds) <= SIGNIFICANCE {
        return None;
    }
    let needed = (seeds..).find(|&seeds| corrected(seeds) <= SIGNIFICANCE)?;
    let least = p_value(least_p(seeds));
    Some(if tests == 1 {
        format!("With {seeds} seeds the least p value a test can have is {least}: {needed} seeds are needed for 0.05.")
    } else {
        format!(
            "With {seeds} seeds the least p value a test can have is {least}, after Holm's correction for {tests} tests \
             {}: {needed} seeds are needed for 0.05.",
            p_value(corrected(seeds))
        )
    })
}

/// Scenarios that say nothing over all.
fn left_out(analysis: &Analysis) -> Option<String> {
    let included = analysis.primary_standings().overall.as_ref().map_or(&[][..], |overall| &overall.scenarios);
    let scenarios = analysis.scenarios.iter().enumerate().filter(|(place, _)| !included.contains(place));
    let names: Vec<&str> = scenarios.map(|(_, scenario)| scenario.name.as_str()).collect();
    let which = listed(&names);
    (!names.is_empty())
        .then(|| format!("On {which} all runs score the same or none has a score: left out of the overall figures."))
}

/// Runs that count with a score they do not have.
fn unscored(analysis: &Analysis, standings: &Standings) -> Vec<String> {
    let mut sentences = Vec::new();
    for (facts, scenario) in analysis.scenarios.iter().zip(&standings.scenarios) {
        let failing: Vec<String> = analysis
            .methods
            .iter()
            .zip(&scenario.methods)
            .filter(|(_, scores)| !scores.unscored.is_empty())
            .map(|(method, scores)| format!("{} of {}", counted(scores.unscored.len(), "run", "runs"), method.name))
            .collect();
        let (Some(worst), Some(limit), false) = (scenario.worst, scenario.limit, failing.is_empty()) else { continue };
        let worst = number(worst, decimals(scenario.worst.into_iter().chain(scenario.best)));
        let (at, lacks) = match facts.shaped {
            true => (String::new(), "had no score (no champion, or one that fails without the terms)"),
            false => (
                format!(" at {} {}", count(limit), standings.axis.name()),
                "had no score yet (every evaluation had failed, or the first generation was not over)",
            ),
        };
        sentences.push(format!(
            "On {}{at}, {} {lacks}: counted with the worst score of all runs there, {worst} {}.",
            facts.name,
            listed(&failing),
            facts.unit,
        ));
    }
    sentences
}

/// Scenarios on which scores are compared before the budget was used up.
fn ended_early(analysis: &Analysis, standings: &Standings, budget: Option<u64>) -> Vec<String> {
    let Some(budget) = budget else { return Vec::new() };
    let scenarios = analysis.scenarios.iter().zip(&standings.scenarios);
    // Where the fitness has terms, runs are compared by their ends.
    let early = scenarios.filter(|(facts, _)| !facts.shaped).filter_map(|(facts, scenario)| {
        let limit = scenario.limit.filter(|&limit| limit < budget as f64)?;
        Some(format!(
            "On {} a run ended after {} {}, before the budget of {}: scores are compared there.",
            facts.name,
            count(limit),
            standings.axis.name(),
            count(budget as f64),
        ))
    });
    early.collect()
}

fn without_threshold(analysis: &Analysis) -> Option<String> {
    let scenarios = analysis.scenarios.iter().filter(|scenario| scenario.thresholds.is_empty() && !scenario.shaped);
    let names: Vec<&str> = scenarios.map(|scenario| scenario.name.as_str()).collect();
    let which = listed(&names);
    (!names.is_empty())
        .then(|| format!("On {which} no method has a median score above 0, so there is no share of it to reach."))
}
