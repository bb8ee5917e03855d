//! What there is: the folder of all runs, the creatures drawn here, and the runs that are trained here.

mod drawn;

use crate::{
    choice::ChoiceError,
    protocol::{Catalogue, Choice, Described, ExportFormat, NamedThing, RunEntry, RunState, TerrainChoice},
    session::{Means, Session, SessionError},
    training::{self, Plan},
};
use creatures::Creature;
use gambol_exports::Format;
use gambol_runs::{
    Registry,
    champion::Champion,
    run_folder::{FolderError, NewFolder, RunFolder},
};
use std::{
    collections::BTreeMap,
    ffi::OsStr,
    fs,
    path::{Component, Path, PathBuf},
    sync::{Arc, Mutex, MutexGuard, PoisonError},
    time::SystemTime,
};

/// The most runs that a gallery shows.
const MOST_RUNS: usize = 200;

/// The runs and creatures that all pages of a studio share.
pub struct Library {
    registry: Registry,
    runs: PathBuf,
    means: Means,
    sessions: Mutex<BTreeMap<String, Arc<Session>>>,
}

/// Why a run cannot be opened or begun.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum LibraryError {
    /// There is no run of this name.
    #[error("there is no run \"{0}\"")]
    NoRun(String),
    /// What was chosen cannot be trained.
    #[error(transparent)]
    Choice(#[from] ChoiceError),
    /// A folder cannot be made or read.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The run cannot be shown or begun.
    #[error(transparent)]
    Session(#[from] SessionError),
    /// A drawn creature cannot be kept.
    #[error("the creature cannot be kept: {0}")]
    Keep(String),
    /// A drawn terrain cannot be kept.
    #[error("the terrain cannot be kept: {0}")]
    KeepTerrain(String),
    /// A run, or what was drawn, cannot be removed.
    #[error("the {what} \"{name}\" cannot be removed: {reason}")]
    Remove {
        /// "run", "creature" or "terrain".
        what: &'static str,
        /// Its name.
        name: String,
        /// Why.
        reason: String,
    },
}

impl Library {
    /// Over the runs in a folder, which need not be there yet.
    pub fn new(registry: Registry, runs: PathBuf, means: Means) -> Self {
        Self { registry, runs, means, sessions: Mutex::default() }
    }

    /// What can be named.
    pub fn registry(&self) -> &Registry {
        &self.registry
    }

    /// What there is to choose from.
    pub fn catalogue(&self) -> Catalogue {
        let registry = &self.registry;
        let thing = |name: &str, description: &str| NamedThing { name: name.into(), description: description.into() };
        let movements = registry.movements.entries().iter().filter(|movement| movement.steps.is_some());
        let drawn = self.drawn_creatures();
        let (runs, more_runs) = self.gallery();
        let shipped = registry.creatures.entries().iter().map(|entry| entry.value.clone());
        let is_drawn = |creature: &Creature| drawn.iter().any(|drawn| drawn.name == creature.name);
        Catalogue {
            drawn: drawn.iter().map(|creature| creature.name.clone()).collect(),
            creatures: shipped.filter(|creature| !is_drawn(creature)).chain(drawn.clone()).collect(),
            movements: movements.map(|movement| thing(&movement.name, &movement.description)).collect(),
            presets: registry.presets.entries().map(|preset| thing(&preset.name, &preset.description)).collect(),
            strategies: registry
                .strategies
                .entries()
                .iter()
                .map(|entry| thing(entry.name(), entry.description()))
                .collect(),
            terrains: self.terrain_choices(),
            variations: registry
                .variations
                .entries()
                .iter()
                .map(|entry| thing(&entry.name, &entry.description))
                .collect(),
            formats: Format::ALL
                .iter()
                .map(|format| ExportFormat { name: format.name(), endings: format.endings() })
                .collect(),
            runs,
            more_runs,
        }
    }

    /// The runs, the latest first, and how many more there are.
    fn gallery(&self) -> (Vec<RunEntry>, usize) {
        let runs = self.latest_first();
        let sessions = self.sessions();
        let entry = |(_, run, path): (_, String, PathBuf)| {
            let folder = RunFolder::at(&path);
            let config = folder.read_config().ok()?;
            let fitness = Champion::read(&folder.champion()).ok().map(|champion| champion.fitness.get());
            let is_running = sessions.get(&run).is_some_and(|session| session.is_training());
            Some(RunEntry { run, creature: config.creature, movement: config.movement.name, fitness, is_running })
        };
        let more = runs.len().saturating_sub(MOST_RUNS);
        (runs.into_iter().take(MOST_RUNS).filter_map(entry).collect(), more)
    }

    /// When each run was configured, its name and its folder, the latest first.
    fn latest_first(&self) -> Vec<(SystemTime, String, PathBuf)> {
        let Ok(entries) = fs::read_dir(&self.runs) else { return Vec::new() };
        let changed = |path: &Path| fs::metadata(path.join("config.json")).and_then(|file| file.modified()).ok();
        let mut runs: Vec<_> = entries
            .flatten()
            .filter_map(|entry| Some((changed(&entry.path())?, entry.file_name().into_string().ok()?, entry.path())))
            .collect();
        runs.sort_by(|one, other| other.cmp(one));
        runs
    }

    fn terrain_choices(&self) -> Vec<TerrainChoice> {
        let shipped = self.registry.terrains.entries().iter().map(|entry| TerrainChoice {
            name: entry.name.clone(),
            description: entry.description.clone(),
            drawn: None,
        });
        let drawn = self.drawn_terrains().into_iter().map(|(name, terrain)| TerrainChoice {
            name,
            description: "drawn here".into(),
            drawn: Some(terrain.drawn),
        });
        shipped.chain(drawn).collect()
    }

    /// Removes a run with all that is in its folder.
    ///
    /// # Errors
    /// If there is none, it is being trained, here or by another process, or its folder cannot be removed.
    pub fn remove(&self, run: &str) -> Result<(), LibraryError> {
        let folder = self.folder(run)?;
        let failed = |error: &dyn std::fmt::Display| cannot_remove("run", run, error);
        let mut sessions = self.sessions();
        if sessions.get(run).is_some_and(|session| session.is_training()) {
            return Err(failed(&"it is being trained; stop it first"));
        }
        let lock = folder.lock().map_err(|error| failed(&error))?;
        fs::remove_dir_all(folder.path()).map_err(|error| failed(&error))?;
        drop(lock);
        sessions.remove(run);
        Ok(())
    }

    /// What a choice comes to, or what is wrong with it.
    pub fn describe(&self, choice: &Choice) -> Described {
        let (registry, kept) = (self.registry_with_drawn(), self.kept());
        match self.source(choice) {
            Ok(from) => choice.describe(&registry, from.as_deref(), &kept),
            Err(error) => {
                let (problem, command) = (Some(error.to_string()), choice.command(&kept));
                Described { config: None, preset: None, problem, command }
            }
        }
    }

    /// The folder of the run that a choice goes on from, as the command line names it.
    fn source(&self, choice: &Choice) -> Result<Option<PathBuf>, LibraryError> {
        let Some(run) = &choice.from else { return Ok(None) };
        self.folder(run).map(|folder| Some(folder.path().to_owned()))
    }

    /// Begins a run in a new folder.
    ///
    /// # Errors
    /// If what was chosen cannot be trained, or there is no room for the folder.
    pub fn train(&self, choice: &Choice) -> Result<Arc<Session>, LibraryError> {
        let registry = self.registry_with_drawn();
        let from = self.source(choice)?;
        let config = choice.resolve(&registry, from.as_deref())?;
        if let Some(drawn) = choice.drawn_creature()? {
            self.keep(&drawn)?;
        }
        let folder = NewFolder::make(&self.runs, &config)?;
        let name = name_of(folder.path());
        let command = choice.command(&self.kept());
        let place = RunFolder::at(folder.path());
        let session = Session::new(name.clone(), place, config, command, self.registry.clone(), self.means.clone())?;
        training::start(&session, Plan::Begin { folder, from })?;
        self.sessions().insert(name, Arc::clone(&session));
        Ok(session)
    }

    /// The run in the folder of this name.
    ///
    /// # Errors
    /// If there is none, or it cannot be read.
    pub fn open(&self, run: &str) -> Result<Arc<Session>, LibraryError> {
        let folder = self.folder(run)?;
        let mut sessions = self.sessions();
        if let Some(session) = sessions.get(run) {
            return Ok(Arc::clone(session));
        }
        let session = Session::open(run.to_owned(), folder, self.registry.clone(), self.means.clone())?;
        sessions.insert(run.to_owned(), Arc::clone(&session));
        Ok(session)
    }

    /// The latest run that can be opened.
    pub fn latest(&self) -> Option<Arc<Session>> {
        self.latest_first().iter().find_map(|(_, run, _)| self.open(run).ok())
    }

    /// The folder of a run: one in the folder of all runs, whatever its name says.
    ///
    /// # Errors
    /// If there is none.
    pub fn folder(&self, run: &str) -> Result<RunFolder, LibraryError> {
        let none = || LibraryError::NoRun(run.to_owned());
        let mut components = Path::new(run).components();
        let (Some(Component::Normal(name)), None) = (components.next(), components.next()) else { return Err(none()) };
        if name != OsStr::new(run) {
            return Err(none());
        }
        let path = self.runs.join(name);
        // A link must not lead elsewhere. On the disk of a browser there are none, and nothing can follow them.
        if !cfg!(target_family = "wasm") {
            let real = path.canonicalize().map_err(|_| none())?;
            let runs = self.runs.canonicalize().map_err(|_| none())?;
            if real.parent() != Some(&*runs) {
                return Err(none());
            }
        }
        RunFolder::open(&path).map_err(|_| none())
    }

    /// Asks all runs that are trained here to save and end, and waits for them.
    pub fn close(&self) {
        let sessions: Vec<Arc<Session>> = self.sessions().values().cloned().collect();
        sessions.iter().for_each(|session| session.stop());
        sessions.iter().for_each(|session| session.join());
    }

    /// How a run of this name stands, if it was opened here.
    pub fn state(&self, run: &str) -> Option<RunState> {
        self.sessions().get(run).map(|session| session.state())
    }

    fn sessions(&self) -> MutexGuard<'_, BTreeMap<String, Arc<Session>>> {
        self.sessions.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

fn cannot_remove(what: &'static str, name: &str, reason: &dyn std::fmt::Display) -> LibraryError {
    LibraryError::Remove { what, name: name.into(), reason: reason.to_string() }
}

fn name_of(path: &Path) -> String {
    path.file_name().map_or_else(String::new, |name| name.to_string_lossy().into_owned())
}
