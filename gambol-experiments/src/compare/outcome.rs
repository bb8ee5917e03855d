use super::{Analysis, CompareError, ComparisonFolder, analyse, csv, page};

/// Analyses a comparison whose runs have all ended, and writes `comparison.html`, `medians.csv`, `scores.csv`, `curves.csv`
/// and `settings.csv` into its folder.
///
/// # Errors
/// If a run is missing, or a file cannot be read or written.
pub fn write_outcome(folder: &ComparisonFolder) -> Result<Analysis, CompareError> {
    let plan = folder.plan()?;
    let results = folder.results(&plan)?;
    let analysis = analyse(&plan, &results);
    folder.files.write_files(&[
        ("comparison.html", page::render(&analysis)),
        ("medians.csv", csv::medians(&analysis)),
        ("scores.csv", csv::scores(&analysis)),
        ("curves.csv", csv::curves(&results)),
        ("settings.csv", csv::settings(&plan)),
    ])?;
    Ok(analysis)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        compare::{RunResult, testing::clear_and_open},
        folder::PlannedRun,
    };

    #[test]
    fn writes_page_and_raw_data_when_all_runs_are_there() {
        let (plan, results) = clear_and_open();
        let place = tempfile::tempdir().expect("a folder");
        let folder = ComparisonFolder::create(place.path(), &plan).expect("a new folder");
        let missing = write_outcome(&folder).expect_err("there are no results");
        assert_eq!(missing.to_string(), "32 of 32 runs are missing; the first is: strong, biped running, seed 1");
        for (job, result) in plan.jobs().zip(&results) {
            let result = RunResult { settings: job.settings(), ..result.clone() };
            folder.files.write_result(&job, &result).expect("can be written");
        }
        let analysis = write_outcome(&folder).expect("all runs are there");
        assert_eq!(analysis, analyse(&plan, &results));
        let lines = |name: &str| {
            let text = std::fs::read_to_string(place.path().join(name)).expect("it was written");
            text.lines().count()
        };
        assert_eq!([lines("scores.csv"), lines("curves.csv")], [1 + 32, 1 + 3 * 32]);
        assert_eq!(lines("medians.csv"), 1 + plan.scenarios.len() + 1);
        assert!(lines("comparison.html") > 100);
    }
}
