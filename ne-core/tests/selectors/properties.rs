use crate::{scores, select, tally};
use ne_core::{Fitness, RankSelector, Roulette, Selection, StochasticUniversal, Tournament, Truncation};
use proptest::prelude::*;

fn any_selection() -> impl Strategy<Value = Selection> {
    prop_oneof![
        Just(Selection::Roulette(Roulette {})),
        Just(Selection::StochasticUniversal(StochasticUniversal {})),
        (1.0..=2.0).prop_map(|pressure| Selection::Rank(RankSelector { pressure })),
        (1..20_usize).prop_map(|size| Selection::Tournament(Tournament { size })),
        (0.001..=1.0).prop_map(|share| Selection::Truncation(Truncation { share })),
    ]
}

/// Any scores: ordinary ones, any finite bits at all, failures.
fn any_scores() -> impl Strategy<Value = Vec<Option<Fitness>>> {
    let score = prop_oneof![
        4 => -10.0..10.0_f64,
        2 => any::<f64>(),
        1 => Just(0.0),
        2 => Just(f64::NAN),
    ];
    prop::collection::vec(score.prop_map(|value| Fitness::new(value).ok()), 0..30)
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(2000) })]

    #[test]
    fn as_many_as_asked_in_range_and_no_failure_without_need(
        selection in any_selection(), scores in any_scores(), count in 0..60_usize, run in any::<u64>(),
    ) {
        let chosen = select(&selection, &scores, count, run);
        prop_assert_eq!(chosen.len(), if scores.is_empty() { 0 } else { count });
        let any_score = scores.iter().any(Option::is_some);
        for index in chosen {
            prop_assert!(index < scores.len());
            prop_assert!(scores[index].is_some() || !any_score);
        }
    }

    #[test]
    fn the_same_stream_gives_the_same_choice(
        selection in any_selection(), scores in any_scores(), count in 0..60_usize, run in any::<u64>(),
    ) {
        prop_assert_eq!(select(&selection, &scores, count, run), select(&selection, &scores, count, run));
    }

    /// The bound for which Baker invented it: each is chosen its expected number of times, rounded down or up.
    #[test]
    fn stochastic_universal_has_the_least_spread(
        weights in prop::collection::vec(0..1000_u32, 1..30), count in 1..100_usize, run in any::<u64>(),
    ) {
        prop_assume!(weights.iter().any(|&weight| weight > 0));
        let values: Vec<f64> = weights.iter().copied().map(f64::from).collect();
        let total: f64 = values.iter().sum();
        let tally = tally(&StochasticUniversal {}, &scores(&values), count, run);
        for (value, times) in values.iter().zip(tally) {
            let expected = count as f64 * value / total;
            // An expected number within rounding of an integer may fall on either side of it.
            let (low, high) = ((expected - 1e-9).floor(), (expected + 1e-9).ceil());
            prop_assert!((low..=high).contains(&(times as f64)), "{times} times, {expected} expected");
        }
    }

    /// Windowing: with negative fitnesses, adding a constant changes nothing.
    #[test]
    fn roulette_does_not_see_a_shift_below_zero(
        values in prop::collection::vec(-1000..0_i32, 1..20), shift in 0..1000_i32, run in any::<u64>(),
    ) {
        let shifted = |by: i32| scores(&values.iter().map(|value| f64::from(value - by)).collect::<Vec<_>>());
        prop_assert_eq!(select(&Roulette {}, &shifted(0), 50, run), select(&Roulette {}, &shifted(shift), 50, run));
    }

    /// Ranks see the order alone.
    #[test]
    fn rank_tournament_and_truncation_do_not_see_distances(
        values in prop::collection::vec(-50.0..50.0_f64, 1..20), run in any::<u64>(),
    ) {
        let stretched: Vec<f64> = values.iter().map(|value| value.powi(3) * 1e3 + 7.0).collect();
        // Rounding may make two different numbers equal; then the order did change.
        prop_assume!(same_order(&values, &stretched));
        for selection in [
            Selection::Rank(RankSelector::default()),
            Selection::Tournament(Tournament::default()),
            Selection::Truncation(Truncation::default()),
        ] {
            prop_assert_eq!(select(&selection, &scores(&values), 50, run), select(&selection, &scores(&stretched), 50, run));
        }
    }

    #[test]
    fn truncation_takes_from_the_best_share_alone(
        values in prop::collection::vec(-50..50_i32, 1..40), percent in 1..=100_u32, run in any::<u64>(),
    ) {
        let values: Vec<f64> = values.into_iter().map(f64::from).collect();
        let parents = (values.len() * percent as usize).div_ceil(100);
        let mut sorted = values.clone();
        sorted.sort_by(|a, b| b.total_cmp(a));
        let truncation = Truncation { share: f64::from(percent) / 100.0 };
        let tally = tally(&truncation, &scores(&values), 400, run);
        prop_assert!(tally.iter().filter(|&&times| times > 0).count() <= parents);
        for (value, times) in values.iter().zip(tally) {
            prop_assert!(times == 0 || *value >= sorted[parents - 1]);
        }
    }
}

/// Where there is nothing to choose by, all have the same chance.
#[test]
fn a_generation_that_failed_as_a_whole_goes_on_with_many_parents() {
    for selection in [
        Selection::Roulette(Roulette {}),
        Selection::StochasticUniversal(StochasticUniversal {}),
        Selection::Rank(RankSelector::default()),
        Selection::Tournament(Tournament::default()),
        Selection::Truncation(Truncation { share: 1.0 }),
    ] {
        let chosen = select(&selection, &[None; 20], 200, 7);
        let parents: std::collections::BTreeSet<usize> = chosen.into_iter().collect();
        assert!(parents.len() > 10, "{selection:?}: {parents:?}");
    }
}

fn same_order(a: &[f64], b: &[f64]) -> bool {
    (0..a.len()).all(|i| (0..i).all(|j| a[i].total_cmp(&a[j]) == b[i].total_cmp(&b[j])))
}
