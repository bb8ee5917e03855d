use super::{Analysis, CompareError, ComparisonFolder, analyse, csv, page};
use ne_core::archive;

/// Analyses a comparison whose runs have all ended, and writes `comparison.html`, `scores.csv` and `curves.csv` into its
/// folder.
///
/// # Errors
/// If a run is missing, or a file cannot be read or written.
pub fn write_outcome(folder: &ComparisonFolder) -> Result<Analysis, CompareError> {
    let plan = folder.plan()?;
    let results = folder.results(&plan)?;
    let analysis = analyse(&plan, &results);
    let files = [
        (folder.page(), page::render(&analysis)),
        (folder.path().join("scores.csv"), csv::scores(&analysis)),
        (folder.path().join("curves.csv"), csv::curves(&results)),
    ];
    for (path, text) in files {
        archive::write_whole(&path, text.as_bytes()).map_err(|source| CompareError::Write { path, source })?;
    }
    Ok(analysis)
}
