//! Killing, going on, comparing.

use crate::{
    cases::Case,
    mortal::{DEAD, program},
};
use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
    sync::atomic::{AtomicUsize, Ordering},
    thread,
};

/// A run has at least so many writes; were there fewer, the counter would miss some.
const WRITES: usize = 25;

/// So many of the last writes are those of the end of a run, its report among them.
const OF_THE_END: usize = 12;

/// Lets the command die at each of its writes, one after the other; goes on each time, and compares what is there in the end
/// with what an undisturbed one has written.
///
/// # Errors
/// Says after which death what is wrong.
pub(crate) fn die_everywhere(case: &Case) -> Result<(), String> {
    let place = tempfile::tempdir().map_err(|error| error.to_string())?;
    let prepare = |name: String| -> Result<PathBuf, String> {
        let folder = place.path().join(name);
        fs::create_dir(&folder).map_err(|error| error.to_string())?;
        for (name, text) in case.files {
            fs::write(folder.join(name), text).map_err(|error| error.to_string())?;
        }
        for command in case.before {
            succeed(&folder, command)?;
        }
        Ok(folder)
    };
    let undisturbed = prepare("undisturbed".into())?;
    let writes = succeed(&undisturbed, case.command)?;
    if writes < WRITES {
        return Err(format!("it has only {writes} writes"));
    }
    let expected = lasting(&undisturbed.join("run"));
    let next = AtomicUsize::new(1);
    let worker = || -> Result<(), String> {
        loop {
            let fate = next.fetch_add(1, Ordering::Relaxed);
            if fate > writes {
                return Ok(());
            }
            let folder = prepare(format!("dies-at-{fate}"))?;
            let after = |error: String| format!("killed at write {fate} of {writes}: {error}");
            if !dies(fate, &folder, case.command).map_err(after)? {
                return Err(after("it lives".into()));
            }
            // Reports take most of the time: every day only those of the end are made, and some of the others.
            let reports = case.takes_long || fate + OF_THE_END > writes || fate.is_multiple_of(10);
            go_on(&folder, case, reports).map_err(after)?;
            compare(&lasting(&folder.join("run")), &expected).map_err(after)?;
            if reports || !case.resumes {
                check_page(&folder.join("run"), &undisturbed.join("run"), case.page).map_err(after)?;
            }
            fs::remove_dir_all(&folder).map_err(|error| error.to_string())?;
        }
    };
    thread::scope(|scope| {
        let workers = [scope.spawn(worker), scope.spawn(worker)];
        workers.into_iter().try_for_each(|worker| worker.join().unwrap_or_else(|_| Err("a worker panicked".into())))
    })
}

/// Whether it has died; else it has done all it had to.
fn dies(fate: usize, folder: &Path, command: &[&str]) -> Result<bool, String> {
    let output = program(fate, folder, command).output().map_err(|error| error.to_string())?;
    match output.status.code() {
        Some(DEAD) => Ok(true),
        Some(0) => Ok(false),
        code => Err(format!("{command:?} ended with {code:?}: {}", String::from_utf8_lossy(&output.stderr))),
    }
}

/// Gives the number of its writes.
fn succeed(folder: &Path, command: &[&str]) -> Result<usize, String> {
    let output = program(0, folder, command).output().map_err(|error| error.to_string())?;
    let told = String::from_utf8_lossy(&output.stdout);
    match told.lines().last().and_then(|line| line.parse().ok()).filter(|_| output.status.success()) {
        Some(writes) => Ok(writes),
        None => Err(format!("{command:?}: {}", String::from_utf8_lossy(&output.stderr))),
    }
}

/// What a user would do: resume the run, or begin it again if there is none yet.
fn go_on(folder: &Path, case: &Case, reports: bool) -> Result<(), String> {
    let quiet: &[&str] = if reports || !case.resumes { &[] } else { &["--no-report"] };
    if !case.resumes || !folder.join("run/config.json").is_file() {
        return succeed(folder, &[case.command, quiet].concat()).map(drop);
    }
    let resumed = succeed(folder, &[&["resume", "run", "--quiet", "--threads", "1"], quiet].concat());
    match resumed {
        // All was done but to bring the name of the report to the disk.
        Err(error) if error.contains("has ended") => {
            check_page(&folder.join("run"), &folder.join("run"), case.page).map_err(|_| error)
        }
        resumed => resumed.map(drop),
    }
}

/// The files of a run or a comparison that are a function of its configuration, by their paths in it; and every temporary file.
fn lasting(folder: &Path) -> BTreeMap<PathBuf, Vec<u8>> {
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let (path, name) = (entry.path(), PathBuf::from(entry.file_name()));
        if path.is_dir() {
            found.extend(lasting(&path).into_iter().map(|(inner, bytes)| (name.join(inner), bytes)));
        } else if !has_wall_clock(&path) {
            found.insert(name, fs::read(&path).unwrap_or_default());
        }
    }
    found
}

fn has_wall_clock(path: &Path) -> bool {
    let is_result = path.components().any(|part| part.as_os_str() == "results");
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    is_result || name == "timing.jsonl" || name.ends_with(".html") || name.ends_with(".csv")
}

fn compare(found: &BTreeMap<PathBuf, Vec<u8>>, expected: &BTreeMap<PathBuf, Vec<u8>>) -> Result<(), String> {
    if !found.keys().eq(expected.keys()) {
        return Err(format!("files: {:?}, and not {:?}", found.keys(), expected.keys()));
    }
    match found.iter().find(|(path, bytes)| expected[*path] != **bytes) {
        Some((path, _)) => Err(format!("{} differs", path.display())),
        None => Ok(()),
    }
}

/// The page is there, and shows a run that has gone as far.
fn check_page(run: &Path, undisturbed: &Path, page: &str) -> Result<(), String> {
    let state = |folder: &Path| -> Result<String, String> {
        let page = fs::read_to_string(folder.join(page)).map_err(|error| format!("{page}: {error}"))?;
        Ok(page.lines().find(|line| line.contains("gambol-run")).unwrap_or_default().to_owned())
    };
    let (found, expected) = (state(run)?, state(undisturbed)?);
    if found == expected { Ok(()) } else { Err(format!("the page says {found}, and not {expected}")) }
}
