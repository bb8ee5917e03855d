//! What was found, in sentences that claim no more than the numbers carry.

use super::{Analysis, FEWEST_SEEDS, standings::PairTest};
use crate::compare::figures::{counted, listed, number};

/// How many methods that do better than others are named, the highest interquartile mean first.
const MOST_WINNERS: usize = 3;
/// How many differences on single scenarios are named; the tables hold all.
const MOST_DIFFERENCES: usize = 6;

/// The sentences.
pub(super) fn headline(analysis: &Analysis) -> Vec<String> {
    let names = names(analysis);
    if let [only] = names[..] {
        return vec![format!("{only} is the only method: there is nothing to compare it with.")];
    }
    if analysis.seeds.len() < analysis.fewest_seeds() {
        let seeds = counted(analysis.seeds.len(), "seed", "seeds");
        return vec![format!("With {seeds} no difference can be claimed; the figures only describe these runs.")];
    }
    let enough = analysis.seeds.len() >= FEWEST_SEEDS;
    let over_all = if analysis.scenarios.len() > 1 && enough { overall(analysis, &names) } else { Vec::new() };
    over_all.into_iter().chain([tests(analysis, &names)]).collect()
}

fn names(analysis: &Analysis) -> Vec<&str> {
    analysis.methods.iter().map(|method| method.name.as_str()).collect()
}

/// Over all scenarios: which methods do better than which others.
fn overall(analysis: &Analysis, names: &[&str]) -> Vec<String> {
    let Some(overall) = &analysis.primary_standings().overall else {
        return vec!["All runs of a scenario score the same: no difference can be claimed over all scenarios.".into()];
    };
    let mut by_mean: Vec<usize> = (0..names.len()).collect();
    by_mean.sort_by(|&one, &other| overall.methods[other].value.total_cmp(&overall.methods[one].value));
    let mut sentences = Vec::new();
    for winner in by_mean {
        let wins = overall.pairs.iter().filter(|pair| pair.better == Some(winner));
        let beaten: Vec<&str> =
            wins.map(|pair| names[if pair.first == winner { pair.second } else { pair.first }]).collect();
        let mean = overall.methods[winner];
        if let (false, Some([low, high])) = (beaten.is_empty(), mean.interval) {
            let [mean, low, high] = [mean.value, low, high].map(|value| number(value, 2));
            sentences.push(format!(
                "Over all {} scenarios {} (interquartile mean {mean}, 95 % interval {low} to {high}) does better than {}.",
                overall.scenarios.len(),
                names[winner],
                listed(&beaten),
            ));
        }
    }
    let others = sentences.len().saturating_sub(MOST_WINNERS);
    sentences.truncate(MOST_WINNERS);
    if others > 0 {
        let others = counted(others, "other method does", "other methods do");
        sentences.push(format!("{others} better than some; the tables say than which."));
    }
    let open: Vec<String> = overall
        .pairs
        .iter()
        .filter(|pair| pair.better.is_none())
        .map(|pair| format!("between {} and {}", names[pair.first], names[pair.second]))
        .collect();
    match open.len() {
        0 => {}
        1..=3 => sentences.push(format!("Over all scenarios no difference can be claimed {}.", listed(&open))),
        many => sentences.push(format!(
            "Over all scenarios no difference can be claimed for {many} of {} pairs of methods.",
            overall.pairs.len()
        )),
    }
    sentences
}

/// On single scenarios: what the tests show.
fn tests(analysis: &Analysis, names: &[&str]) -> String {
    let standings = analysis.primary_standings();
    let mut found = Vec::new();
    for (winner, name) in names.iter().enumerate() {
        for (loser, other) in names.iter().enumerate() {
            let is_it = |test: &PairTest| {
                test.better == Some(winner) && (test.first == loser || test.second == loser) && winner != loser
            };
            let scenarios = analysis.scenarios.iter().zip(&standings.scenarios);
            let won: Vec<&str> = scenarios
                .filter(|(_, scenario)| scenario.pairs.iter().any(is_it))
                .map(|(scenario, _)| scenario.name.as_str())
                .collect();
            match won.len() {
                0 => {}
                1..=3 => found.push(format!("{name} scores more than {other} on {}", listed(&won))),
                many => found.push(format!(
                    "{name} scores more than {other} on {many} of {} scenarios",
                    analysis.scenarios.len()
                )),
            }
        }
    }
    let shown = standings.scenarios.iter().flat_map(|scenario| &scenario.pairs);
    let shown = shown.filter(|test| test.better.is_some()).count();
    let found = if found.len() > MOST_DIFFERENCES { "the tables say which".into() } else { found.join("; ") };
    let rule = "p ≤ 0.05 after Holm's correction";
    let kind = match () {
        () if analysis.is_paired() => "paired",
        () if standings.scenarios.iter().any(|scenario| scenario.paired) => "rank",
        () => "rank-sum",
    };
    match (standings.tests, shown) {
        (0, _) => "No run has a score: nothing can be compared.".into(),
        (1, 0) => format!("The {kind} test shows no difference (p > 0.05): none can be claimed."),
        (1, _) => format!("The {kind} test shows a difference (p ≤ 0.05): {found}."),
        (all, 0) => format!(
            "None of the {all} {kind} tests on single scenarios shows a difference ({rule}): none can be claimed there."
        ),
        (all, _) => {
            let shows = if shown == 1 { "shows" } else { "show" };
            format!("{shown} of {all} {kind} tests on single scenarios {shows} a difference ({rule}): {found}.")
        }
    }
}
