use super::{CompareError, ComparisonFolder, RunResult};
use std::path::{Path, PathBuf};

/// Puts the results of a comparison's parts together in a new folder, or in one that has some of them already.
///
/// # Errors
/// If the parts are not of one comparison, contradict each other, or runs are missing; nothing is written then.
pub fn merge(parts: &[PathBuf], into: &Path) -> Result<ComparisonFolder, CompareError> {
    let folders = parts.iter().map(|path| ComparisonFolder::open(path)).collect::<Result<Vec<_>, _>>()?;
    let Some((first, others)) = folders.split_first() else { return ComparisonFolder::open(into) };
    let plan = first.plan()?;
    for other in others {
        if let Some(what) = plan.difference(&other.plan()?) {
            let (first, second) = (first.path().into(), other.path().into());
            return Err(CompareError::NotTogether { first, second, what });
        }
    }
    let (mut found, mut missing) = (Vec::new(), Vec::new());
    for job in plan.jobs() {
        let mut kept: Option<(&ComparisonFolder, RunResult)> = None;
        for folder in &folders {
            let Some(result) = folder.result(&job)? else { continue };
            match &kept {
                Some((other, earlier)) if !earlier.agrees_with(&result) => {
                    let (first, second) = (other.path().into(), folder.path().into());
                    return Err(CompareError::Contradiction { run: job.name(), first, second });
                }
                Some(_) => {}
                None => kept = Some((folder, result)),
            }
        }
        match kept {
            Some((_, result)) => found.push((job, result)),
            None => missing.push(job.name()),
        }
    }
    if let Some(first) = missing.first() {
        let all = plan.jobs().count();
        return Err(CompareError::Incomplete { missing: missing.len(), all, first: first.clone() });
    }
    let merged = ComparisonFolder::create(into, &plan)?;
    found.iter().try_for_each(|(job, result)| merged.files.write_result(job, result))?;
    Ok(merged)
}
