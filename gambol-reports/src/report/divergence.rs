//! The warning that lanes and rapier diverged, which they should never do.

use ne_core::GenerationReport;

/// What to say if the engine of training and rapier disagreed at a re-evaluation of the run, or do about its champion.
pub(super) fn warning(log: &[GenerationReport], champion_diverged: bool) -> Option<String> {
    let re_evaluations = || log.iter().filter_map(|report| Some((report.generation, report.re_evaluation?)));
    let mut diverged = re_evaluations().filter(|(_, re_evaluation)| re_evaluation.diverged);
    let what = match (diverged.next(), champion_diverged) {
        (None, false) => return None,
        (Some((first, _)), _) => format!(
            "at {} of {} re-evaluations, first in generation {first}, the best candidate had another fitness in rapier than in \
             lanes, and all were judged again in rapier",
            1 + diverged.count(),
            re_evaluations().count()
        ),
        (None, true) => "the champion has another fitness in rapier than in lanes; rapier's is the one shown".into(),
    };
    Some(format!(
        "Lanes and rapier diverged: {what}. They should give the same bits, so fitnesses in training may be wrong."
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::champion_selection::ReEvaluationReport;

    fn report(generation: u64, re_evaluation: Option<bool>) -> GenerationReport {
        let heard = |diverged| ReEvaluationReport { candidates: 32, judged: None, trained: None, diverged };
        GenerationReport {
            generation,
            evaluations: 0,
            steps: 0,
            best_so_far: None,
            tier: 0,
            fitness: None,
            failures: 0,
            failure: None,
            population: 0,
            strategy: Vec::new(),
            species: Vec::new(),
            re_evaluation: re_evaluation.map(heard),
        }
    }

    #[test]
    fn nothing_is_said_while_they_agree() {
        assert_eq!(warning(&[], false), None);
        assert_eq!(warning(&[report(1, None), report(2, Some(false))], false), None);
    }

    #[test]
    fn it_is_said_where_they_diverged() {
        let log = [report(1, Some(false)), report(2, Some(true)), report(3, None), report(4, Some(true))];
        let said = warning(&log, true).expect("they diverged");
        assert!(
            said.contains("diverged: at 2 of 3 re-evaluations, first in generation 2, the best candidate"),
            "{said}"
        );
        let said = warning(&[report(1, None)], true).expect("they diverged");
        assert!(said.contains("diverged: the champion has another fitness in rapier than in lanes"), "{said}");
    }
}
