//! The warning that lanes and rapier parted, which they should never do.

use ne_core::GenerationReport;

/// What to say if the engine of training and rapier disagreed at a hearing of the run, or do about its champion.
pub(super) fn warning(log: &[GenerationReport], champion_parted: bool) -> Option<String> {
    let hearings = || log.iter().filter_map(|report| Some((report.generation, report.hearing?)));
    let mut parted = hearings().filter(|(_, hearing)| hearing.parted);
    let what = match (parted.next(), champion_parted) {
        (None, false) => return None,
        (Some((first, _)), _) => format!(
            "at {} of {} hearings, first in generation {first}, the best finalist had another fitness in rapier than in \
             lanes, and all were judged again in rapier",
            1 + parted.count(),
            hearings().count()
        ),
        (None, true) => "the champion has another fitness in rapier than in lanes; rapier's is the one shown".into(),
    };
    Some(format!(
        "Lanes and rapier parted: {what}. They should give the same bits, so fitnesses in training may be wrong."
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::HearingReport;

    fn report(generation: u64, hearing: Option<bool>) -> GenerationReport {
        let heard = |parted| HearingReport { finalists: 32, judged: None, trained: None, parted };
        GenerationReport {
            generation,
            evaluations: 0,
            steps: 0,
            best_so_far: None,
            grade: 0,
            fitness: None,
            failures: 0,
            population: 0,
            strategy: Vec::new(),
            species: Vec::new(),
            hearing: hearing.map(heard),
        }
    }

    #[test]
    fn nothing_is_said_while_they_agree() {
        assert_eq!(warning(&[], false), None);
        assert_eq!(warning(&[report(1, None), report(2, Some(false))], false), None);
    }

    #[test]
    fn it_is_said_where_they_parted() {
        let log = [report(1, Some(false)), report(2, Some(true)), report(3, None), report(4, Some(true))];
        let said = warning(&log, true).expect("they parted");
        assert!(said.contains("parted: at 2 of 3 hearings, first in generation 2, the best finalist"), "{said}");
        let said = warning(&[report(1, None)], true).expect("they parted");
        assert!(said.contains("parted: the champion has another fitness in rapier than in lanes"), "{said}");
    }
}
