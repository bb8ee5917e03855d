use super::Outcome;
use crate::{Registry, run_folder::RunFolder};
use clap::Args;
use std::{
    path::{Path, PathBuf},
    process::{Command, ExitCode, Stdio},
    sync::Arc,
    thread,
    time::Duration,
};
use studio_server::Server;

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol studio                        the runs in ./runs; the first time a biped learns to run
  gambol studio runs/biped-1-running   a run, even while another process trains it
  gambol studio tetrapod-2             a creature, to be trained
  gambol studio --no-open --port 4000  for a browser that you open yourself

The page is served to this machine alone, at an address with a secret in it. Ctrl-C saves all runs and ends.")]
pub(crate) struct Studio {
    /// The folder of a run, or a creature by its name
    what: Option<String>,
    /// The folder of all runs [default: runs, or where the run lies]
    #[arg(long, value_name = "DIR")]
    runs: Option<PathBuf>,
    /// The port on 127.0.0.1; 0: any that is free
    #[arg(long, default_value_t = 0)]
    port: u16,
    /// Do not open a browser
    #[arg(long)]
    no_open: bool,
    /// Threads of each training [default: one for each core]
    #[arg(long, default_value_t = 0, hide_default_value = true)]
    #[arg(value_parser = super::thread_count(0))]
    threads: usize,
}

/// What the page opens first.
enum First {
    Run { runs: PathBuf, name: String },
    Creature(String),
}

impl Studio {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let first = self.what.as_deref().map(|what| first(what, registry)).transpose()?;
        let beside = match &first {
            Some(First::Run { runs, .. }) => runs.clone(),
            _ => "runs".into(),
        };
        let runs = self.runs.clone().unwrap_or(beside);
        if runs.exists() && !runs.is_dir() {
            return Err(format!("--runs {}: that is a file; name a folder", runs.display()).into());
        }
        let library = Arc::new(studio_server::library(registry.clone(), runs, self.threads));
        let query = match &first {
            None => String::new(),
            Some(First::Creature(name)) => format!("?creature={}", encoded(name)),
            Some(First::Run { name, .. }) => {
                library.open(name)?;
                format!("?run={}", encoded(name))
            }
        };
        let server = Server::bind(library, self.port)?;
        let url = format!("{}{query}", server.url());
        say!("The studio is at {url}")?;
        say!("Ctrl-C saves all runs and ends it.")?;
        if !self.no_open && !opened(&url) {
            say!("No browser could be opened; copy the address into one.")?;
        }
        let signal = ne_core::StopSignal::default();
        super::interrupt::stop_on_interrupt(&signal)?;
        server.run(move || {
            while !signal.is_set() {
                thread::sleep(Duration::from_millis(50));
            }
        })?;
        Ok(ExitCode::SUCCESS)
    }
}

/// What a user named: a folder, or else a creature.
fn first(what: &str, registry: &Registry) -> Result<First, Box<dyn std::error::Error>> {
    let path = Path::new(what);
    if path.is_file() {
        let page = "drop the file on the page, or train it";
        return Err(format!("{what} is a file, and the studio opens a run or a shipped creature: {page}").into());
    }
    if !path.is_dir() {
        registry.creatures.find(what)?;
        return Ok(First::Creature(what.into()));
    }
    RunFolder::open(path)?;
    let path = path.canonicalize()?;
    let (Some(runs), Some(name)) = (path.parent(), path.file_name().and_then(|name| name.to_str())) else {
        return Err(format!("{what} has no name that a page can show").into());
    };
    Ok(First::Run { runs: runs.into(), name: name.into() })
}

/// A name for an address.
fn encoded(name: &str) -> String {
    let byte = |byte: u8| match byte {
        b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' => char::from(byte).to_string(),
        _ => format!("%{byte:02X}"),
    };
    name.bytes().map(byte).collect()
}

/// Asks the system to show the page; whether there is a program that would.
fn opened(url: &str) -> bool {
    let programs: &[(&str, &[&str])] = if cfg!(target_os = "macos") {
        &[("open", &[])]
    } else if cfg!(windows) {
        &[("rundll32", &["url.dll,FileProtocolHandler"])]
    } else {
        &[("xdg-open", &[]), ("wslview", &[])]
    };
    programs.iter().any(|(program, arguments)| {
        let mut command = Command::new(program);
        command.args(*arguments).arg(url).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        command.spawn().is_ok()
    })
}
