use super::thesis::{self, Scenario};
use gambol_runs::{Registry, config::RunConfig, presets::Preset, suggest};
use ne_core::{SettingError, StopConditions};
use std::collections::BTreeSet;

/// What a user wants reproduced. An empty list stands for everything.
#[derive(Clone, Debug)]
pub struct Request {
    /// Names of creatures of the thesis.
    pub creatures: Vec<String>,
    /// Names of movements of the thesis.
    pub movements: Vec<String>,
    /// Names of presets; an empty list: `thesis` and `default`.
    pub presets: Vec<String>,
    /// Runs of each preset on each scenario, with seeds from 1 on; at least 1.
    pub runs: u64,
    /// Generations of each run; at least 1.
    pub generations: u64,
    /// The minutes after which a timed run of each preset on each scenario is looked at; `None`: no timed runs.
    pub clock_minutes: Option<Vec<f64>>,
}

impl Default for Request {
    fn default() -> Self {
        Self {
            creatures: Vec::new(),
            movements: Vec::new(),
            presets: Vec::new(),
            runs: thesis::RUNS,
            generations: thesis::GENERATIONS,
            clock_minutes: None,
        }
    }
}

/// Why a request is no plan.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum RequestError {
    /// A name is not known; the message has the nearest one.
    #[error("{0}")]
    Unknown(String),
    /// The same name twice.
    #[error("the {what} \"{name}\" is there twice")]
    Twice {
        /// What it is.
        what: &'static str,
        /// Its name.
        name: String,
    },
    /// A number is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// A creature that should be shipped is not.
    #[error(transparent)]
    Creature(#[from] creatures::UnknownCreature),
}

/// What is to be reproduced.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The presets.
    pub presets: Vec<Preset>,
    /// The scenarios, in the thesis' order.
    pub scenarios: Vec<&'static Scenario>,
    /// Runs of each preset on each scenario, with seeds from 1 on.
    pub runs: u64,
    /// Generations of each run.
    pub generations: u64,
    /// The minutes after which timed runs are looked at, rising; `None`: there are no timed runs.
    pub clock_minutes: Option<Vec<f64>>,
    /// Each preset on each scenario: for each preset all scenarios.
    pub cells: Vec<Cell>,
    /// What the presets are made of.
    pub registry: Registry,
}

/// A preset on a scenario.
#[derive(Clone, Debug)]
pub struct Cell {
    /// The preset.
    pub preset: Preset,
    /// The scenario.
    pub scenario: &'static Scenario,
    /// The configuration of its runs that count generations, but for their seeds.
    pub config: RunConfig,
}

/// One run of a plan.
#[derive(Clone, Copy, Debug)]
pub enum Job<'a> {
    /// So many generations with this seed.
    Run {
        /// Which preset on which scenario.
        cell: &'a Cell,
        /// With which seed.
        seed: u64,
    },
    /// So many minutes, with seed 1.
    Clock {
        /// Which preset on which scenario.
        cell: &'a Cell,
    },
}

impl Request {
    /// The plan: every name found, every number checked.
    ///
    /// # Errors
    /// Names what is not known, and what is most like it; or the number that is out of range.
    pub fn plan(&self, registry: &Registry) -> Result<Plan, RequestError> {
        let creatures = known("creature of the thesis", &self.creatures, |scenario| scenario.creature)?;
        let movements = known("movement of the thesis", &self.movements, |scenario| scenario.movement)?;
        let asked_for = |names: &[String], name: &str| names.is_empty() || names.iter().any(|asked| asked == name);
        let scenarios = thesis::SCENARIOS
            .iter()
            .filter(|scenario| asked_for(creatures, scenario.creature) && asked_for(movements, scenario.movement))
            .collect::<Vec<_>>();
        for (field, number) in [("runs", self.runs), ("generations", self.generations)] {
            SettingError::check_range(field, number as f64, 1.0, 1e6)?;
        }
        if let Some(minutes) = &self.clock_minutes {
            check_minutes(minutes)?;
        }
        let presets = self.presets(registry)?;
        let mut cells = Vec::new();
        for preset in &presets {
            for scenario in &scenarios {
                cells.push(Cell::new(preset, scenario, self.generations, registry)?);
            }
        }
        Ok(Plan {
            presets,
            scenarios,
            runs: self.runs,
            generations: self.generations,
            clock_minutes: self.clock_minutes.clone(),
            cells,
            registry: registry.clone(),
        })
    }

    fn presets(&self, registry: &Registry) -> Result<Vec<Preset>, RequestError> {
        unique("preset", &self.presets)?;
        let names = match self.presets.is_empty() {
            true => vec!["thesis", "default"],
            false => self.presets.iter().map(String::as_str).collect(),
        };
        let find = |name| registry.presets.find(name).cloned().map_err(RequestError::Unknown);
        names.into_iter().map(find).collect()
    }
}

impl Plan {
    /// All runs, the timed ones last. Those with the same seed stand together, so that what is done first makes a page.
    pub fn jobs(&self) -> impl Iterator<Item = Job<'_>> {
        let runs = (1..=self.runs).flat_map(|seed| self.cells.iter().map(move |cell| Job::Run { cell, seed }));
        let clocks = self.cells.iter().filter(|_| self.clock_minutes.is_some()).map(|cell| Job::Clock { cell });
        runs.chain(clocks)
    }
}

impl<'a> Job<'a> {
    /// What a run is called: `thesis, biped-1 running, seed 3`.
    pub fn name(&self) -> String {
        match self {
            Self::Run { cell, seed } => format!("{}, seed {seed}", cell.name()),
            Self::Clock { cell } => format!("{}, timed", cell.name()),
        }
    }

    /// Which preset on which scenario.
    pub fn cell(&self) -> &'a Cell {
        match self {
            Self::Run { cell, .. } | Self::Clock { cell } => cell,
        }
    }
}

impl Cell {
    /// What it is called: `thesis, biped-1 running`.
    pub fn name(&self) -> String {
        format!("{}, {}", self.preset.name, self.scenario.name())
    }

    /// A preset on a scenario, with runs of so many generations.
    pub(super) fn new(
        preset: &Preset,
        scenario: &'static Scenario,
        generations: u64,
        registry: &Registry,
    ) -> Result<Self, creatures::UnknownCreature> {
        let creature = creatures::find(scenario.creature)?;
        let mut config = registry.configure(preset, creature, scenario.movement);
        config.stop = StopConditions { generations: Some(generations), ..StopConditions::default() };
        // Whole populations are not used here.
        config.record.populations_at.clear();
        Ok(Self { preset: preset.clone(), scenario, config })
    }
}

/// Checks names against those of the thesis' scenarios.
fn known<'a>(
    what: &'static str,
    names: &'a [String],
    name_of: fn(&Scenario) -> &'static str,
) -> Result<&'a [String], RequestError> {
    let mut known: Vec<&str> = Vec::new();
    for name in thesis::SCENARIOS.iter().map(name_of) {
        if !known.contains(&name) {
            known.push(name);
        }
    }
    if let Some(name) = names.iter().find(|name| !known.contains(&name.as_str())) {
        return Err(RequestError::Unknown(suggest::unknown(what, name, &known)));
    }
    unique(what, names)?;
    Ok(names)
}

fn unique(what: &'static str, names: &[String]) -> Result<(), RequestError> {
    let mut seen = BTreeSet::new();
    match names.iter().find(|name| !seen.insert(*name)) {
        Some(name) => Err(RequestError::Twice { what, name: name.clone() }),
        None => Ok(()),
    }
}

/// Moments to look at a timed run: at least one, each later than the one before.
fn check_minutes(minutes: &[f64]) -> Result<(), SettingError> {
    for &minutes in minutes {
        SettingError::check_range("clock-minutes", minutes, 0.001, 1440.0)?;
    }
    if minutes.is_empty() || !minutes.is_sorted_by(|earlier, later| earlier < later) {
        let found = minutes.iter().map(f64::to_string).collect::<Vec<_>>().join(",");
        return Err(SettingError::new("clock-minutes", found, "at least one, each later than the one before"));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refused(request: &Request) -> String {
        request.plan(&Registry::default()).expect_err("it must be refused").to_string()
    }

    #[test]
    fn the_whole_has_every_run_once() {
        let plan = Request { clock_minutes: Some(vec![1.0, 5.0]), ..Request::default() }
            .plan(&Registry::default())
            .expect("a plan");
        let names: BTreeSet<String> = plan.jobs().map(|job| job.name()).collect();
        assert_eq!((plan.jobs().count(), names.len()), (14 * 2 * 11, 14 * 2 * 11));
        assert!(names.contains("default, decapod-2 jumping, seed 10") && names.contains("thesis, apod running, timed"));
    }

    #[test]
    fn what_is_wrong_is_said() {
        let names = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
        let creatures = |list| Request { creatures: names(list), ..Request::default() };
        assert_eq!(
            refused(&creatures(&["bipde-1"])),
            "there is no creature of the thesis \"bipde-1\"; did you mean \"biped-1\"? (there are: apod, biped-1, \
             biped-2, tetrapod-1, tetrapod-2, decapod-1, decapod-2)"
        );
        assert_eq!(refused(&creatures(&["apod", "apod"])), "the creature of the thesis \"apod\" is there twice");
        let movements = Request { movements: names(&["runing"]), ..Request::default() };
        assert!(refused(&movements).contains("did you mean \"running\"?"));
        let presets = Request { presets: names(&["theses"]), ..Request::default() };
        assert!(refused(&presets).contains("there is no preset \"theses\"; did you mean \"thesis\"?"));
        let presets = Request { presets: names(&["thesis", "thesis"]), ..Request::default() };
        assert_eq!(refused(&presets), "the preset \"thesis\" is there twice");
        let clock = |minutes: &[f64]| Request { clock_minutes: Some(minutes.into()), ..Request::default() };
        for minutes in [&[][..], &[5.0, 1.0], &[1.0, 1.0]] {
            assert!(refused(&clock(minutes)).contains("each later than the one before"));
        }
        for minutes in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(refused(&clock(&[minutes])).contains("clock-minutes"));
        }
        assert!(refused(&Request { runs: 0, ..Request::default() }).contains("runs = 0"));
        assert!(refused(&Request { generations: 0, ..Request::default() }).contains("generations = 0"));
    }
}
