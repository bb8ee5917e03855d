use super::{analyse, *};
use crate::compare::testing::{clear_and_open, comparison, plan, run};

fn points(scores: &[(u64, f64)]) -> Vec<(u64, Option<f64>)> {
    scores.iter().map(|&(evaluations, score)| (evaluations, Some(score))).collect()
}

#[test]
fn scores_are_those_of_the_last_generation_within_the_budget() {
    let mut plan = plan(&["a", "b"], &["s"], 1);
    let results = [
        // Overruns the budget of 1,000: what it found there does not count.
        run("a", "s", 1, &points(&[(300, 1.0), (900, 2.0), (1200, 9.0)])),
        run("b", "s", 1, &points(&[(1000, 3.0)])),
    ];
    let analysis = analyse(&plan, &results);
    let scenario = &analysis.at_equal_evaluations.scenarios[0];
    assert_eq!(scenario.limit, Some(1000.0));
    assert_eq!([&scenario.methods[0].scores, &scenario.methods[1].scores], [&[2.0], &[3.0]]);
    // Without a budget of steps the shortest run sets it.
    assert_eq!(analysis.at_equal_steps.scenarios[0].limit, Some(10_000.0));
    assert_eq!(analysis.primary, Axis::Evaluations);
    // With one, steps come first, and a run that ended before it sets it.
    plan.budget = StopConditions { steps: Some(11_000), ..StopConditions::default() };
    let analysis = analyse(&plan, &results);
    assert_eq!((analysis.primary, analysis.at_equal_steps.scenarios[0].limit), (Axis::Steps, Some(10_000.0)));
    assert_eq!(analysis.at_equal_evaluations.scenarios[0].limit, Some(1000.0));
    assert!(analysis.caveats.iter().any(|caveat| caveat
        == "On s a run ended after 10,000 physics steps, before the budget of 11,000: scores are compared there."));
}

#[test]
fn a_clear_and_an_open_scenario() {
    let (plan, results) = clear_and_open();
    let analysis = analyse(&plan, &results);
    let [clear, open] = &analysis.at_equal_evaluations.scenarios[..] else { panic!("two scenarios") };
    let summary = clear.methods[0].summary.expect("there are scores");
    assert_eq!((summary.median, summary.lower, summary.upper), (16.75, 14.125, 19.375));
    assert_eq!((summary.mean, summary.best, summary.worst), (16.75, 22.0, 11.5));
    // All eight differences 1.5, 2, ..., 5 are above 0: p = 2 / 2⁸, twice that for two tests.
    let test = clear.pairs[0];
    assert_eq!((test.p, test.p_corrected, test.better, test.differing), (2.0 / 256.0, 4.0 / 256.0, Some(0), Some(8)));
    assert_eq!((test.shift, test.rank_biserial, test.effect), (3.25, 1.0, Effect::Large));
    let test = open.pairs[0];
    assert_eq!((test.p, test.p_corrected, test.better, test.shift), (1.0, 1.0, None, 0.0));
    assert_eq!((test.superiority, test.effect), (0.5, Effect::Negligible));
    assert_eq!(
        analysis.headline,
        [
            "Over all scenarios no difference can be claimed between strong and weak.",
            "1 of 2 paired tests on single scenarios shows a difference (p ≤ 0.05 after Holm's correction): \
             strong scores more than weak on biped running.",
        ]
    );
}

#[test]
fn over_all_scenarios_scores_are_normalised_between_the_worst_and_the_best_run() {
    let (plan, results) = clear_and_open();
    let overall = analyse(&plan, &results).at_equal_evaluations.overall.expect("scores differ");
    assert_eq!(overall.scenarios, [0, 1]);
    // By hand: pairs won on the first scenario are 51 of 64, and half of them on the second.
    let wins = (1..=8).flat_map(|x| (1..=8).map(move |y| (10.0 + 1.5 * f64::from(x), 9.0 + f64::from(y))));
    let share: f64 = wins
        .map(|(x, y)| {
            if x > y {
                1.0
            } else if x < y {
                0.0
            } else {
                0.5
            }
        })
        .sum::<f64>()
        / 64.0;
    assert_eq!(overall.pairs[0].probability.value, (share + 0.5) / 2.0);
    let [first, last] = [overall.profiles[0][0], overall.profiles[0][50]];
    assert_eq!((overall.thresholds[50], last.value), (1.0, 0.0));
    assert_eq!(first.value, 15.0 / 16.0, "all but the worst run are above 0");
    for estimate in overall.methods.iter().chain(overall.profiles.iter().flatten()) {
        let [low, high] = estimate.interval.expect("there are several seeds");
        assert!(0.0 <= low && low <= estimate.value && estimate.value <= high && high <= 1.0, "{estimate:?}");
    }
}

#[test]
fn a_method_that_always_wins_is_said_to() {
    let score = |method, _, seed| 3.0 - method as f64 + 0.01 * seed as f64;
    let (plan, results) = comparison(&["a", "b", "c"], &["r", "s", "t", "u"], 10, score);
    assert_eq!(
        analyse(&plan, &results).headline,
        [
            "Over all 4 scenarios a (interquartile mean 0.98, 95 % interval 0.97 to 0.98) does better than b and c.",
            "Over all 4 scenarios b (interquartile mean 0.50, 95 % interval 0.49 to 0.51) does better than c.",
            "12 of 12 paired tests on single scenarios show a difference (p ≤ 0.05 after Holm's correction): a scores \
             more than b on 4 of 4 scenarios; a scores more than c on 4 of 4 scenarios; b scores more than c on 4 of 4 \
             scenarios.",
        ]
    );
}

#[test]
fn equal_methods_are_not_told_apart() {
    let (plan, results) = comparison(&["a", "b"], &["s", "t"], 8, |_, _, seed| seed as f64);
    let analysis = analyse(&plan, &results);
    let test = analysis.at_equal_evaluations.scenarios[0].pairs[0];
    assert_eq!((test.p, test.differing, test.superiority, test.better), (1.0, Some(0), 0.5, None));
    assert_eq!(analysis.headline[0], "Over all scenarios no difference can be claimed between a and b.");
    let (plan, results) = comparison(&["a", "b"], &["s", "t"], 8, |_, _, _| 1.0);
    let analysis = analyse(&plan, &results);
    assert_eq!(analysis.at_equal_evaluations.overall, None);
    assert_eq!(
        (&*analysis.headline[0], &*analysis.caveats[1]),
        (
            "All runs of a scenario score the same: no difference can be claimed over all scenarios.",
            "On s and t all runs score the same or none has a score: left out of the overall figures.",
        )
    );
}

#[test]
fn one_method_has_nothing_to_be_compared_with() {
    let (plan, results) = comparison(&["a"], &["s"], 10, |_, _, seed| seed as f64);
    let analysis = analyse(&plan, &results);
    assert_eq!(analysis.headline, ["a is the only method: there is nothing to compare it with."]);
    assert_eq!(analysis.caveats, ["There is one scenario: nothing is said about other creatures or movements."]);
    assert!(analysis.at_equal_evaluations.overall.is_some_and(|overall| overall.pairs.is_empty()));
}

#[test]
fn few_seeds_claim_nothing() {
    let score = |method, _, seed| method as f64 * 10.0 + seed as f64;
    let (plan, results) = comparison(&["a", "b"], &["s"], 1, score);
    let analysis = analyse(&plan, &results);
    assert_eq!(analysis.headline, ["With 1 seed no difference can be claimed; the figures only describe these runs."]);
    assert_eq!(
        analysis.caveats[0],
        "There is one seed: no interval, no test. With another seed the order may be another."
    );
    let overall = analysis.at_equal_evaluations.overall.expect("scores differ");
    assert!(overall.methods.iter().all(|mean| mean.interval.is_none()) && overall.pairs[0].better.is_none());
    assert!(analysis.at_equal_evaluations.scenarios[0].pairs.is_empty());
    let (plan, results) = comparison(&["a", "b"], &["s"], 5, score);
    let analysis = analyse(&plan, &results);
    assert_eq!(analysis.headline, ["With 5 seeds no difference can be claimed; the figures only describe these runs."]);
    assert_eq!(
        analysis.caveats[0],
        "With 5 seeds the least p value a test can have is 0.0625: 6 seeds are needed for 0.05."
    );
    let (plan, results) = comparison(&["a", "b", "c"], &["s", "t"], 7, score);
    let analysis = analyse(&plan, &results);
    assert_eq!(
        analysis.caveats[0],
        "With 7 seeds the least p value a test can have is 0.0156, after Holm's correction for 6 tests 0.0938: 8 seeds \
         are needed for 0.05."
    );
    assert_eq!(
        analysis.headline.last().map(String::as_str),
        Some(
            "None of the 6 paired tests on single scenarios shows a difference (p ≤ 0.05 after Holm's correction): none can \
         be claimed there."
        )
    );
}

#[test]
fn runs_that_failed_count_with_the_worst_score_and_are_named() {
    let (plan, mut results) = comparison(&["a", "b"], &["s"], 8, |method, _, seed| (method * 10) as f64 + seed as f64);
    results[0] = run("a", "s", 1, &[(100, None), (1000, None)]);
    // Its first generation ends after the budget.
    results[3] = run("b", "s", 2, &[(1500, Some(50.0))]);
    let analysis = analyse(&plan, &results);
    let scenario = &analysis.at_equal_evaluations.scenarios[0];
    assert_eq!((&*scenario.methods[0].unscored, &*scenario.methods[1].unscored), (&[0][..], &[1][..]));
    assert_eq!((scenario.methods[0].scores[0], scenario.methods[1].scores[1], scenario.worst), (2.0, 2.0, Some(2.0)));
    assert!(analysis.caveats.contains(
        &"On s at 1,000 evaluations, 1 run of a and 1 run of b had no score yet (every evaluation had failed, or the \
          first generation was not over): counted with the worst score of all runs there, 2.0 m."
            .into()
    ));
    assert_eq!(analysis.runs[0].score_at_equal_evaluations, None, "raw data has no substitute");
    let [evaluations, ..] = &analysis.scenarios[0].curves[..] else { panic!("three axes") };
    assert_eq!((evaluations.methods[0].lower[11], evaluations.methods[0].lower.last()), (None, Some(&Some(2.75))));
}

#[test]
fn without_any_score_nothing_is_said() {
    let (plan, mut results) = comparison(&["a", "b"], &["s"], 8, |_, _, _| 1.0);
    for result in &mut results {
        result.points.iter_mut().for_each(|point| point.best = None);
    }
    let analysis = analyse(&plan, &results);
    assert_eq!(analysis.headline, ["No run has a score: nothing can be compared."]);
    assert_eq!(analysis.at_equal_evaluations.scenarios[0].methods[0].summary, None);
    assert!(analysis.scenarios[0].thresholds.is_empty());
    let nothing = analyse(&plan, &[]);
    assert_eq!(nothing.headline, analysis.headline);
    assert_eq!((nothing.runs.len(), nothing.runs[0].evaluations), (16, None));
}

#[test]
fn time_to_a_threshold_counts_runs_that_never_reach_it() {
    // The best median is 10, of b; of a only three of eight runs reach half of it, and none reaches nine tenths.
    let (plan, results) = comparison(&["a", "b"], &["s"], 8, |method, _, seed| match method {
        0 => {
            if seed <= 3 {
                6.0
            } else {
                1.0
            }
        }
        _ => 10.0,
    });
    let analysis = analyse(&plan, &results);
    let [half, most] = &analysis.scenarios[0].thresholds[..] else { panic!("two thresholds") };
    assert_eq!((half.score, half.share, most.score), (5.0, 0.5, 9.0));
    assert_eq!((half.methods[0].reached, half.methods[0].evaluations), (3, None));
    let time = half.methods[1];
    assert_eq!((time.reached, time.evaluations, time.steps, time.seconds), (8, Some(100.0), Some(1000.0), Some(1.0)));
    assert_eq!((most.methods[0].reached, most.methods[1].evaluations), (0, Some(500.0)));
    // There is no share of scores below 0.
    let (plan, results) = comparison(&["a", "b"], &["s"], 8, |_, _, seed| -(seed as f64));
    assert!(analyse(&plan, &results).scenarios[0].thresholds.is_empty());
}

#[test]
fn a_champion_of_a_better_gait_may_be_worth_less() {
    let (plan, mut results) = comparison(&["a"], &["s"], 1, |_, _, _| 0.0);
    results[0] = run("a", "s", 1, &points(&[(300, 2.0), (900, 1.5)]));
    let analysis = analyse(&plan, &results);
    assert_eq!(analysis.at_equal_evaluations.scenarios[0].methods[0].scores, [1.5]);
    assert!(!analysis.caveats.iter().any(|caveat| caveat.contains("fail")), "{:?}", analysis.caveats);
}

#[test]
fn curves_reach_from_the_first_generation_to_the_end_of_the_shortest_run() {
    let (plan, mut results) = comparison(&["a"], &["s"], 2, |_, _, seed| seed as f64);
    results[1] = run("a", "s", 2, &points(&[(200, 1.0), (1200, 3.0)]));
    let analysis = analyse(&plan, &results);
    let curves = &analysis.scenarios[0].curves[0];
    assert_eq!((curves.axis, curves.limit), (Axis::Evaluations, Some(1000.0)));
    assert_eq!((curves.grid[0], curves.grid[60], curves.grid[120]), (0.0, 500.0, 1000.0));
    let median = &curves.methods[0].median;
    assert_eq!((median[23], median[24], median[60]), (None, Some(0.75), Some(1.0)));
    assert_eq!(analysis.scenarios[0].curves[2].limit, None);
}

#[test]
fn the_same_results_give_the_same_analysis_in_any_order() {
    let (plan, mut results) = clear_and_open();
    let analysis = analyse(&plan, &results);
    results.reverse();
    assert_eq!(analyse(&plan, &results), analysis);
}

#[test]
fn runs_in_one_world_are_independent_and_the_page_says_why() {
    let (mut plan, results) = comparison(&["a", "b"], &["s"], 4, |method, _, seed| (10 * method) as f64 + seed as f64);
    let test = &analyse(&plan, &results).scenarios[0].test;
    assert!(test.starts_with("Signed-rank tests of pairs: worlds vary"), "{test}");
    plan.cells.iter_mut().for_each(|cell| cell.config.variation = Default::default());
    let analysis = analyse(&plan, &results);
    assert!(analysis.scenarios[0].test.starts_with("Rank-sum tests of independent runs: worlds do not vary"));
    let standings = &analysis.at_equal_evaluations.scenarios[0];
    let test = standings.pairs[0];
    // No score of b is below one of a: 2 of C(8, 4) deals.
    assert_eq!((standings.paired, test.p, test.better, test.differing), (false, 2.0 / 70.0, Some(1), None));
    assert_eq!((test.shift, test.rank_biserial), (-10.0, -1.0));
    assert_eq!(analysis.headline, ["The rank-sum test shows a difference (p ≤ 0.05): b scores more than a on s."]);
    let (mut plan, results) = comparison(&["a", "b"], &["s"], 3, |method, _, seed| (10 * method) as f64 + seed as f64);
    plan.cells.iter_mut().for_each(|cell| cell.config.variation = Default::default());
    let caveats = analyse(&plan, &results).caveats;
    assert_eq!(caveats[0], "With 3 seeds the least p value a test can have is 0.10: 4 seeds are needed for 0.05.");
}

#[test]
fn scores_of_a_shaped_fitness_are_those_of_the_movement_alone() {
    let (mut plan, mut results) =
        comparison(&["a", "b"], &["s"], 8, |method, _, seed| (10 * method) as f64 + seed as f64);
    for cell in &mut plan.cells {
        cell.config.movement.terms = vec![tasks::TermSpec::new("energy", -1.0)];
    }
    // By its fitness b is ahead, by the movement a.
    for result in &mut results {
        result.bare = Some(if result.method == "a" { 20.0 } else { 3.0 } + result.seed as f64);
    }
    results[0].bare = None;
    // Its champion was first known after the budget.
    results[2].points = run("a", "s", 2, &[(900, None), (1020, Some(1.0))]).points;
    let analysis = analyse(&plan, &results);
    let (facts, scenario) = (&analysis.scenarios[0], &analysis.at_equal_evaluations.scenarios[0]);
    assert!(facts.shaped && facts.thresholds.is_empty());
    assert_eq!(scenario.methods[0].scores[1..], [22.0, 23.0, 24.0, 25.0, 26.0, 27.0, 28.0]);
    assert_eq!(scenario.methods[0].unscored, [0], "its champion fails without terms");
    assert_eq!([scenario.methods[0].with_terms, scenario.methods[1].with_terms], [Some(4.5), Some(14.5)]);
    assert_eq!(scenario.pairs[0].better, Some(0));
    assert_eq!(analysis.runs[1].fitness, Some(1.0));
    assert_eq!(analysis.runs[1].score_at_equal_evaluations, Some(22.0));
    let says = |text: &str| analysis.caveats.iter().any(|caveat| caveat.starts_with(text));
    assert!(says("On s the fitness has terms. Scores are what the champion"), "{:?}", analysis.caveats);
    assert!(says("On s, 1 run of a had no score (no champion, or one that fails"), "{:?}", analysis.caveats);
    // The ends of runs are equal in what the plan has a budget of, and in nothing else.
    let other = &analysis.at_equal_steps;
    assert_eq!((other.scenarios[0].limit, other.tests, &other.overall), (None, 0, &None));
    assert_eq!(other.scenarios[0].methods[0].scores, [0.0; 0]);
    assert_eq!(analysis.runs[1].score_at_equal_steps, None);
}

/// What is claimed over all scenarios is corrected for the number of pairs.
#[test]
fn many_equal_methods_are_not_told_apart_over_all_scenarios() {
    // Scores that have nothing to do with the method, as a hash would deal them.
    let score = |method: usize, scenario: usize, seed: u64| {
        let mut bits = method as u64 * 0x1_0000 + scenario as u64 * 0x100 + seed;
        for factor in [0x9e37_79b9_7f4a_7c15_u64, 0xbf58_476d_1ce4_e5b9, 0x94d0_49bb_1331_11eb] {
            bits = (bits ^ (bits >> 29)).wrapping_mul(factor);
        }
        (bits >> 40) as f64
    };
    let names = ["a", "b", "c", "d", "e", "f", "g", "h"];
    let (plan, results) = comparison(&names, &["r", "s", "t", "u"], 6, score);
    let overall = analyse(&plan, &results).at_equal_evaluations.overall.expect("scores differ");
    assert_eq!(overall.pairs.len(), 28);
    assert!(overall.pairs.iter().all(|pair| pair.better.is_none() && pair.p <= pair.p_corrected));
    // So that it is the correction that keeps them from being told apart.
    assert!(overall.pairs.iter().any(|pair| pair.p <= 0.05), "{:?}", overall.pairs);
}

#[test]
fn methods_that_are_not_named_are_counted() {
    let score = |method, _, seed| 9.0 - method as f64 + 0.01 * seed as f64;
    let (plan, results) = comparison(&["a", "b", "c", "d", "e", "f"], &["r", "s", "t", "u"], 10, score);
    let headline = analyse(&plan, &results).headline;
    assert_eq!(headline[3], "2 other methods do better than some; the tables say than which.");
}

#[test]
fn what_is_alike_is_told_once_and_what_is_not_for_each() {
    let (mut plan, results) = comparison(&["a", "b"], &["s"], 2, |_, _, _| 1.0);
    let had = |field: &str, value: u32, from: &str| Provenance {
        field: field.into(),
        value: value.into(),
        from: from.into(),
    };
    plan.cells[0].provenance = vec![had("x", 1, "preset plain"), had("y", 2, "its own defaults")];
    plan.cells[1].provenance = vec![had("x", 1, "preset plain"), had("y", 2, "file b.json")];
    let facts = &analyse(&plan, &results).scenarios[0];
    assert_eq!(facts.alike, [had("x", 1, "preset plain")]);
    assert_eq!(facts.own, [[had("y", 2, "its own defaults")], [had("y", 2, "file b.json")]]);
}
