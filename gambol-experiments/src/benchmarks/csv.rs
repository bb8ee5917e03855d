use super::{Counting, Measured};
use gambol_runs::texts::csv_cell;
use std::fmt::Write;

/// Every attempt as a line of CSV, below a header; what differs between equal attempts, the time, is left out.
///
/// `tested` is `all` or `best`, as the [`Counting`] has it.
pub fn attempts_csv(measured: &[Measured]) -> String {
    let mut text = String::from("task,strategy,entrant,tested,seed,evaluations,solved,hidden,connections,of_625\n");
    for measured in measured {
        let tested = match measured.counting {
            Counting::EveryCandidate => "all",
            Counting::BestOfGeneration => "best",
        };
        let (task, strategy, entrant) = (measured.task.name(), &measured.strategy, csv_cell(&measured.description));
        for attempt in &measured.attempts {
            let size = |size: Option<usize>| size.map(|size| size.to_string()).unwrap_or_default();
            let starts = attempt.generalization.map(|starts| starts.to_string()).unwrap_or_default();
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "{task},{strategy},{entrant},{tested},{},{},{},{},{},{starts}",
                attempt.seed,
                attempt.evaluations,
                attempt.solved,
                size(attempt.hidden),
                size(attempt.connections),
            );
        }
    }
    text
}
