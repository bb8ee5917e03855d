//! What a page can have of a run as a file: its report, its champion, what a champion is exported to.

use crate::{
    library::{Library, LibraryError},
    protocol::RunState,
};
use gambol_exports::{Format, Options, Picture};
use gambol_runs::{champion::Champion, run_folder::RunFolder, shaping};
use std::path::PathBuf;

/// What is wanted of a run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Wanted {
    /// Its report.
    Report,
    /// The file of its champion.
    Champion,
    /// Whether its champion does the same again, as JSON.
    Verify,
    /// One of the files that its champion is exported to.
    Export {
        /// The format.
        format: Format,
        /// Which of its files, from 0.
        file: usize,
    },
}

/// A file for a page.
#[derive(Clone, Debug)]
pub struct Download {
    /// The name to save it by; `None`: it is to be looked at.
    pub name: Option<String>,
    /// Its media type.
    pub media: &'static str,
    /// What is in it.
    pub bytes: Vec<u8>,
}

/// Why there is no such file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DownloadError {
    /// There is no such run, or nothing of that name can be had.
    #[error("{0}")]
    Missing(String),
    /// It cannot be made.
    #[error("{0}")]
    Failed(String),
}

impl Wanted {
    /// From an address below that of a run, such as `report` or `export/gif/0`.
    ///
    /// # Errors
    /// If nothing has this address.
    pub fn parse(address: &str) -> Result<Self, DownloadError> {
        let missing = || DownloadError::Missing(format!("there is no \"{address}\""));
        let parts: Vec<&str> = address.split('/').collect();
        Ok(match parts[..] {
            ["report"] => Self::Report,
            ["champion.json"] => Self::Champion,
            ["verify"] => Self::Verify,
            ["export", name, file] => {
                let known = Format::ALL.into_iter().find(|known| known.name() == name);
                let format = known.ok_or_else(|| DownloadError::Missing(format!("there is no format \"{name}\"")))?;
                Self::Export { format, file: file.parse().map_err(|_| missing())? }
            }
            _ => return Err(missing()),
        })
    }
}

impl Library {
    /// Makes a file of a run.
    ///
    /// # Errors
    /// If there is no such run, or it has no champion yet.
    pub fn download(&self, run: &str, wanted: &Wanted) -> Result<Download, DownloadError> {
        let folder = self.folder(run).map_err(|error: LibraryError| DownloadError::Missing(error.to_string()))?;
        match wanted {
            Wanted::Report => self.report(run, &folder).map_err(|error| failed(&*error)),
            Wanted::Champion => {
                let bytes = std::fs::read(folder.champion()).map_err(|_| failed(&NO_CHAMPION))?;
                Ok(Download { name: Some(saved_as(run, ".champion.json")), media: "application/json", bytes })
            }
            Wanted::Verify => {
                let verification = champion_of(&folder)?.verify(self.registry()).map_err(|error| failed(&error))?;
                let found = serde_json::json!({
                    "identical": verification.is_identical(),
                    "diverges_at_step": verification.diverges_at
                });
                Ok(Download { name: None, media: "application/json", bytes: found.to_string().into_bytes() })
            }
            &Wanted::Export { format, file } => {
                // Files that belong together name each other as they are saved.
                let options = Options { name: saved_as(run, ""), steps: None, picture: Picture::default() };
                let exported = gambol_exports::export(&champion_of(&folder)?, self.registry(), format, &options);
                let files = exported.map_err(|error| failed(&error))?;
                let count = files.len();
                let exported =
                    files.into_iter().nth(file).ok_or_else(|| failed(&format!("there are {count} files")))?;
                let name = Some(saved_as(run, exported.ending));
                Ok(Download { name, media: "application/octet-stream", bytes: exported.bytes })
            }
        }
    }

    fn report(&self, run: &str, folder: &RunFolder) -> Result<Download, Box<dyn std::error::Error>> {
        let modified = |path: PathBuf| std::fs::metadata(path).and_then(|file| file.modified()).ok();
        // What has ended has the report that was made then, which says why.
        let is_under_way = matches!(self.state(run), Some(RunState::Running | RunState::Paused));
        // A run with stages has the log of the latest of them, and no champion of its own before the first has ended.
        let latest = shaping::stage_runs(folder)?.pop().map(|stage_run| RunFolder::at(&stage_run.folder));
        let latest = latest.as_ref().unwrap_or(folder);
        let newest = modified(folder.champion()).max(modified(latest.champion())).max(modified(latest.log()));
        let report = modified(folder.report());
        if is_under_way || report.is_none() || report < newest {
            gambol_reports::report::write_report(folder, self.registry(), None)?;
        }
        Ok(Download { name: None, media: "text/html; charset=utf-8", bytes: std::fs::read(folder.report())? })
    }
}

const NO_CHAMPION: &str = "there is no champion yet";

fn failed(error: &(impl std::fmt::Display + ?Sized)) -> DownloadError {
    DownloadError::Failed(error.to_string())
}

fn champion_of(folder: &RunFolder) -> Result<Champion, DownloadError> {
    match folder.champion().is_file() {
        true => Champion::read(&folder.champion()).map_err(|error| failed(&error)),
        false => Err(failed(&NO_CHAMPION)),
    }
}

/// The name of a file: that of a folder may have any sign in it.
fn saved_as(run: &str, ending: &str) -> String {
    let is_plain = |sign: char| sign.is_ascii_alphanumeric() || "-_. ".contains(sign);
    format!("{run}{ending}").chars().map(|sign| if is_plain(sign) { sign } else { '_' }).collect()
}
