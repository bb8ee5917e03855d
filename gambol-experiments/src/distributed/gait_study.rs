use super::{Experiment, Failed, digest, read, temporary, write};
use crate::gaits::{GaitRun, GaitRuns, SCENARIOS, csv, scenario_row};
use gambol_runs::{Registry, config::RunConfig, judge::tier_to_reach, request::Request};
use ne_core::{StopConditions, digest::Digest};
use std::path::{Path, PathBuf};

/// How many gaits are usable, how soon, and how robust: every creature with every movement and every seed.
///
/// In its folder is a file for each run, which `gambol bench gaits --keep` knows, and `gaits.csv`, a row for each creature and
/// movement.
#[derive(Clone, Debug)]
pub struct GaitStudy {
    scenarios: Vec<RunConfig>,
    seeds: Vec<u64>,
    robust: bool,
}

/// The first of these that is there again.
fn twice<T: PartialEq>(things: &[T]) -> Option<&T> {
    things.iter().enumerate().find_map(|(index, thing)| things[..index].contains(thing).then_some(thing))
}

impl GaitStudy {
    /// `requests`: a creature and a movement each. `stop`: when a run ends; it must not count minutes. `robust`: whether each
    /// champion is replayed in 100 perturbed worlds.
    ///
    /// # Errors
    /// If a request is wrong, minutes are counted, there are no runs, or the same run is there twice.
    pub fn new(
        requests: &[Request],
        seeds: Vec<u64>,
        stop: StopConditions,
        robust: bool,
        registry: &Registry,
    ) -> Result<Self, Failed> {
        if stop.minutes.is_some() || stop.steps.is_none() {
            return Err("what a run finds in so many minutes depends on the machine: say steps".into());
        }
        let scenario = |request: &Request| {
            let config = RunConfig { stop, ..request.resolve(registry).map_err(|error| error.to_string())? };
            gambol_runs::Setup::new(&config, registry).map_err(|error| error.to_string())?;
            Ok(config)
        };
        let scenarios = requests.iter().map(scenario).collect::<Result<Vec<RunConfig>, String>>()?;
        if scenarios.is_empty() || seeds.is_empty() {
            return Err("a study needs at least one creature, one movement and one seed".into());
        }
        if let Some(seed) = twice(&seeds) {
            return Err(format!("the seed {seed} is there twice").into());
        }
        if let Some(config) = twice(&scenarios) {
            return Err(format!("{} {} is there twice", config.creature.name, config.movement.name).into());
        }
        Ok(Self { scenarios, seeds, robust })
    }

    /// The same, where runs end as soon as their gait is usable.
    ///
    /// # Errors
    /// If no gaits are judged in one of them.
    pub fn until_usable(mut self, registry: &Registry) -> Result<Self, Failed> {
        for config in &mut self.scenarios {
            config.stop.tier = Some(tier_to_reach(config, registry));
            gambol_runs::Setup::new(config, registry).map_err(|error| error.to_string())?;
        }
        Ok(self)
    }

    fn config(&self, run: usize) -> Result<RunConfig, Failed> {
        let scenario = self.scenarios.get(run / self.seeds.len().max(1));
        let scenario = scenario.ok_or_else(|| format!("there is no run {run}"))?;
        Ok(RunConfig { seed: self.seeds[run % self.seeds.len()], ..scenario.clone() })
    }

    /// Checks that a result is one of this run.
    fn check(&self, path: &Path, run: usize, result: &str) -> Result<(), Failed> {
        let (config, found) = (self.config(run)?, GaitRuns::parse(path, result)?);
        if (&found.creature, &found.movement, found.seed) != (&config.creature.name, &config.movement.name, config.seed)
        {
            return Err(format!("{} is the result of another run, not of {}", path.display(), self.name(run)).into());
        }
        Ok(())
    }

    fn file(&self, folder: &Path, run: usize) -> Result<PathBuf, Failed> {
        Ok(GaitRuns::file_of(folder, &self.config(run)?, self.robust)?)
    }

    fn kept(&self, folder: &Path, registry: &Registry) -> Result<GaitRuns, Failed> {
        Ok(GaitRuns::new(registry, 1, 1).robust(self.robust).kept_in(folder)?)
    }
}

impl Experiment for GaitStudy {
    fn runs(&self) -> usize {
        self.scenarios.len() * self.seeds.len()
    }

    fn name(&self, run: usize) -> String {
        let name =
            |config: RunConfig| format!("{} {}, seed {}", config.creature.name, config.movement.name, config.seed);
        self.config(run).map(name).unwrap_or_default()
    }

    fn digest(&self) -> Result<Digest, Failed> {
        digest(&(&self.scenarios, &self.seeds, self.robust))
    }

    fn begin(&self, folder: &Path) -> Result<(), Failed> {
        ne_core::archive::make_folder(folder)
            .map_err(|error| format!("cannot write {}: {error}", folder.display()).into())
    }

    fn is_done(&self, folder: &Path, run: usize) -> Result<bool, Failed> {
        let path = self.file(folder, run)?;
        if !path.is_file() {
            return Ok(false);
        }
        self.check(&path, run, &read(&path)?)?;
        Ok(true)
    }

    fn carry_out(&self, run: usize, registry: &Registry) -> Result<String, Failed> {
        let place = temporary()?;
        self.kept(place.path(), registry)?.of(&[self.config(run)?])?;
        read(&self.file(place.path(), run)?)
    }

    fn place(&self, folder: &Path, run: usize, result: &str) -> Result<PathBuf, Failed> {
        let path = self.file(folder, run)?;
        self.check(&path, run, result)?;
        write(&path, result)
    }

    fn agree(&self, one: &str, other: &str) -> Result<bool, Failed> {
        let timeless = |text: &str| {
            let run = GaitRuns::parse(Path::new("a result"), text)?;
            let seconds_to_usable = run.seconds_to_usable.map(|_| 0.0);
            Ok::<_, Failed>(GaitRun { seconds: 0.0, seconds_to_usable, ..run })
        };
        Ok(timeless(one)? == timeless(other)?)
    }

    fn conclude(&self, folder: &Path, registry: &Registry) -> Result<Vec<PathBuf>, Failed> {
        let mut missing = Vec::new();
        for run in 0..self.runs() {
            if !self.is_done(folder, run)? {
                missing.push(run);
            }
        }
        if let [first, ..] = missing[..] {
            let (missing, all) = (missing.len(), self.runs());
            return Err(format!("{missing} of {all} runs are missing, the first of them {}", self.name(first)).into());
        }
        let configs = (0..self.runs()).map(|run| self.config(run)).collect::<Result<Vec<_>, _>>()?;
        let runs = self.kept(folder, registry)?.of(&configs)?;
        let row = |runs: &[GaitRun]| scenario_row(runs, true, registry);
        let rows: Vec<[String; 8]> = runs.chunks(self.seeds.len().max(1)).map(row).collect();
        let path = folder.join("gaits.csv");
        write(&path, &csv(&SCENARIOS, &rows))?;
        Ok(vec![path])
    }
}
