use super::provenance::{Provenance, first_unlike, provenance};
use gambol_runs::Registry;
use gambol_runs::suggest;
use gambol_runs::{
    config::RunConfig,
    request::{Request, RequestError},
};
use ne_core::StopConditions;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeSet, path::PathBuf};

/// Everything needed to repeat a comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// The methods' names, in the order they are shown.
    pub methods: Vec<String>,
    /// The scenarios' names, such as `biped-1 running`, in the order they are shown.
    pub scenarios: Vec<String>,
    /// The seeds: each method has a run with each of them on each scenario.
    pub seeds: Vec<u64>,
    /// The budget of each run: evaluations, physics steps, or both, whichever is used up first.
    pub budget: StopConditions,
    /// The configuration of each method on each scenario: for each scenario those of all methods.
    pub cells: Vec<Cell>,
}

/// A method on a scenario.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Cell {
    /// The method's name.
    pub method: String,
    /// The scenario's name.
    pub scenario: String,
    /// The unit of its fitness.
    pub unit: String,
    /// The configuration of its runs, but for the seed.
    pub config: RunConfig,
    /// What the method has there, and from where.
    pub provenance: Vec<Provenance>,
}

/// One run of a plan.
#[derive(Clone, Copy, Debug)]
pub struct Job<'a> {
    /// Which method on which scenario.
    pub cell: &'a Cell,
    /// With which seed.
    pub seed: u64,
}

/// A way to search that is compared with others.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Method {
    /// What it is called in tables.
    pub name: String,
    /// The preset it starts from; otherwise the default.
    pub preset: Option<String>,
    /// The strategy, with its default settings.
    pub strategy: Option<String>,
    /// A configuration file laid over the rest.
    pub config: Option<PathBuf>,
}

/// What a user wants compared.
#[derive(Clone, Debug, Default)]
pub struct PlanRequest {
    /// The methods, at least one.
    pub methods: Vec<Method>,
    /// Names of shipped creatures or creature files, at least one.
    pub creatures: Vec<String>,
    /// Movements, at least one.
    pub movements: Vec<String>,
    /// Seeds, at least one.
    pub seeds: Vec<u64>,
    /// The budget of each run: evaluations, steps, or both.
    pub budget: StopConditions,
    /// The preset of all methods, by name: they may then differ in nothing but their strategy and its settings. Its
    /// variation is kept. None: each method has its own preset, or the default, and nothing varies.
    pub preset: Option<String>,
    /// Single settings for all runs, `key=value`.
    pub set: Vec<String>,
    /// The engine of all runs, by name; otherwise what each method says.
    pub engine: Option<String>,
    /// The variation of all runs, by name; otherwise what each method's file says, or none.
    pub variation: Option<String>,
}

/// Why a request is no plan.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PlanError {
    /// Something is missing.
    #[error("say {0}")]
    Missing(&'static str),
    /// A setting that a comparison chooses itself.
    #[error(
        "--set {0}: a comparison has seeds and a budget of its own (--first-seed, --seeds, --evaluations, --steps)"
    )]
    Own(String),
    /// The same thing twice.
    #[error("{what} \"{name}\" is there twice; give each a name of its own")]
    Twice {
        /// What it is.
        what: &'static str,
        /// Its name.
        name: String,
    },
    /// A method is not one.
    #[error("{0}")]
    Method(String),
    /// With a preset of all, a method has something that the others do not have.
    #[error(
        "{method} and {other} do not have the same {field} on {scenario}: with --preset strategies may differ in their own \
         settings alone; leave it out of the file, or give it to all with --set"
    )]
    Unlike {
        /// The method.
        method: String,
        /// The first of the methods.
        other: String,
        /// The scenario.
        scenario: String,
        /// The field of their configurations.
        field: String,
    },
    /// A method has no configuration for a scenario.
    #[error("{method} on {scenario}: {source}")]
    Request {
        /// The method.
        method: String,
        /// Creature and movement.
        scenario: String,
        /// What is wrong.
        source: Box<RequestError>,
    },
    /// A configuration has stages.
    #[error(
        "{method} on {scenario}: its configuration has stages, and what is compared are single searches: add --set stages=[], \
         and each searches for all of it at once"
    )]
    Stages {
        /// The method.
        method: String,
        /// Creature and movement.
        scenario: String,
    },
    /// Two budgets where runs are compared by their ends.
    #[error(
        "give --evaluations or --steps, not both: on {0} the fitness has terms, scores are those of the ends of runs, and runs \
         that end at one budget or the other have nothing equal"
    )]
    TwoBudgets(String),
    /// A configuration cannot run.
    #[error("{method} on {scenario}: {message}")]
    Setup {
        /// The method.
        method: String,
        /// Creature and movement.
        scenario: String,
        /// What is wrong.
        message: String,
    },
}

impl PlanRequest {
    /// The plan: every configuration put together and checked.
    ///
    /// # Errors
    /// If something is missing or there twice, or a configuration is wrong; the error names the method and the field.
    pub fn plan(&self, registry: &Registry) -> Result<Plan, PlanError> {
        let missing = [
            (self.methods.is_empty(), "which strategies to compare, such as --strategies ga,neat"),
            (self.creatures.is_empty(), "on which creatures, such as --creatures biped-1,apod"),
            (self.movements.is_empty(), "on which movements, such as --movements running,jumping"),
            (self.seeds.is_empty(), "how many seeds, such as --seeds 10"),
            (
                self.budget.evaluations.or(self.budget.steps).is_none(),
                "what each run may use up: --evaluations, --steps or both",
            ),
        ];
        if let Some((_, what)) = missing.into_iter().find(|(missing, _)| *missing) {
            return Err(PlanError::Missing(what));
        }
        if let (Some(preset), Some(own)) = (&self.preset, self.methods.iter().find(|method| method.preset.is_some())) {
            return Err(PlanError::Method(format!(
                "\"{}\" is a preset, and --preset {preset} gives all the same: name strategies, or leave out --preset",
                own.name
            )));
        }
        unique("the strategy", self.methods.iter().map(|method| method.name.clone()))?;
        // An alias is another name of the same.
        let entries = self.methods.iter().filter_map(|method| registry.strategies.find(method.strategy.as_ref()?));
        unique("the strategy", entries.map(|entry| entry.name().to_owned()))?;
        unique("the movement", self.movements.iter().cloned())?;
        unique("the seed", self.seeds.iter().map(u64::to_string))?;
        let mut plan = Plan {
            methods: self.methods.iter().map(|method| method.name.clone()).collect(),
            scenarios: Vec::new(),
            seeds: self.seeds.clone(),
            budget: self.budget,
            cells: Vec::new(),
        };
        for creature in &self.creatures {
            for movement in &self.movements {
                let cell = |method| self.cell(method, creature, movement, registry);
                let cells = self.methods.iter().map(cell).collect::<Result<Vec<_>, _>>()?;
                if self.preset.is_some() {
                    check_alike(&cells)?;
                }
                plan.scenarios.extend(cells.first().map(|cell| cell.scenario.clone()));
                plan.cells.extend(cells);
            }
        }
        if let (Some(_), Some(_), Some(cell)) =
            (self.budget.evaluations, self.budget.steps, plan.cells.iter().find(|cell| cell.is_shaped()))
        {
            return Err(PlanError::TwoBudgets(cell.scenario.clone()));
        }
        // Names are also folders, on systems too that do not tell capitals from small letters.
        unique("the scenario", plan.scenarios.iter().cloned())?;
        unique("the folder of the scenario", plan.scenarios.iter().map(|name| folder_name(name).to_lowercase()))?;
        unique("the folder of the strategy", plan.methods.iter().map(|name| folder_name(name).to_lowercase()))?;
        Ok(plan)
    }

    fn cell(&self, method: &Method, creature: &str, movement: &str, registry: &Registry) -> Result<Cell, PlanError> {
        if let Some(own) = self.set.iter().find(|set| is_seed_or_budget(set)) {
            return Err(PlanError::Own(own.clone()));
        }
        let request = Request {
            creature: Some(creature.into()),
            movement: Some(movement.into()),
            preset: method.preset.clone().or_else(|| self.preset.clone()),
            strategy: method.strategy.clone(),
            config: method.config.clone(),
            set: self.set.clone(),
            engine: self.engine.clone(),
            variation: self.variation.clone(),
            // A score at a budget must be that of the moment; a champion selection sits only now and then.
            // The variation of a common preset is the same for all.
            unvaried: self.preset.is_none(),
            ..Request::default()
        };
        let (method, scenario) = (method.name.clone(), format!("{creature} {movement}"));
        let config = request.resolve(registry);
        let mut config = config.map_err(|source| PlanError::Request {
            method: method.clone(),
            scenario: scenario.clone(),
            source: Box::new(source),
        })?;
        if !config.stages.is_empty() {
            return Err(PlanError::Stages { method, scenario });
        }
        config.stop = self.budget;
        // Seeds are the plan's; whole populations are not looked at in a comparison.
        config.seed = 0;
        config.record.populations_at.clear();
        let scenario = format!("{} {movement}", config.creature.name);
        let provenance = provenance(&request, &config, registry);
        match gambol_runs::Setup::new(&config, registry) {
            Ok(setup) => Ok(Cell { method, scenario, unit: setup.unit, config, provenance }),
            Err(error) => Err(PlanError::Setup { method, scenario, message: error.to_string() }),
        }
    }
}

/// Checks that methods on a scenario differ in their strategy alone.
fn check_alike(cells: &[Cell]) -> Result<(), PlanError> {
    let Some((first, others)) = cells.split_first() else { return Ok(()) };
    for cell in others {
        if let Some(field) = first_unlike(&first.config, &cell.config) {
            let (method, other, scenario) = (cell.method.clone(), first.method.clone(), cell.scenario.clone());
            return Err(PlanError::Unlike { method, other, scenario, field });
        }
    }
    Ok(())
}

impl Cell {
    /// Whether terms are added to its movement's score, so that its fitness is not that score.
    pub fn is_shaped(&self) -> bool {
        !self.config.movement.terms.is_empty()
    }

    /// Whether the worlds of its runs vary, or what bodies are told, drawn from the seed of the run and the number of the generation,
    /// whatever the strategy.
    pub fn shares_worlds(&self) -> bool {
        self.config.varies()
    }
}

impl Plan {
    /// All runs. Those with the same seed stand together, so that what is done first can be compared first.
    pub fn jobs(&self) -> impl Iterator<Item = Job<'_>> {
        self.seeds.iter().flat_map(|&seed| self.cells.iter().map(move |cell| Job { cell, seed }))
    }
}

impl Job<'_> {
    /// The run's configuration.
    pub fn config(&self) -> RunConfig {
        RunConfig { seed: self.seed, ..self.cell.config.clone() }
    }

    /// What a file of the run is called: `neat, biped-1 running, seed 3`.
    pub fn name(&self) -> String {
        format!("{}, {}, seed {}", self.cell.method, self.cell.scenario, self.seed)
    }
}

impl Method {
    /// A strategy's name or alias (`neat`, `ga`), a preset's (`thesis`), or a name and a configuration file
    /// (`large=large.json`).
    ///
    /// # Errors
    /// If there is no such strategy or preset, or the name cannot be that of a folder.
    pub fn parse(text: &str, registry: &Registry) -> Result<Self, PlanError> {
        let none = Self { name: text.into(), preset: None, strategy: None, config: None };
        if let Some((name, file)) = text.split_once('=') {
            check_name(name)?;
            return Ok(Self { name: name.into(), config: Some(file.into()), ..none });
        }
        if registry.strategies.find(text).is_some() {
            return Ok(Self { strategy: Some(text.into()), ..none });
        }
        if registry.presets.find(text).is_ok() {
            return Ok(Self { preset: Some(text.into()), ..none });
        }
        let mut known = registry.strategies.names();
        known.extend(registry.presets.entries().map(|preset| &*preset.name));
        let hint = "; or give it a name and a configuration file, NAME=FILE";
        Err(PlanError::Method(suggest::unknown("strategy or preset", text, &known) + hint))
    }
}

/// Whether an assignment `key=value` is of a seed or a budget, which experiments of many runs have of their own.
pub fn is_seed_or_budget(assignment: &str) -> bool {
    assignment.split(['=', '.']).next().is_some_and(|field| matches!(field.trim(), "seed" | "stop"))
}

/// What the folder of a scenario or strategy is called.
pub(super) fn folder_name(name: &str) -> String {
    let safe = |letter: char| if letter.is_alphanumeric() || "-_.".contains(letter) { letter } else { '-' };
    name.chars().map(safe).collect()
}

/// A method's name is also that of a folder.
fn check_name(name: &str) -> Result<(), PlanError> {
    let fits = |letter: char| letter.is_ascii_alphanumeric() || "-_.".contains(letter);
    if !name.is_empty() && name.chars().all(fits) && !name.starts_with('.') {
        return Ok(());
    }
    Err(PlanError::Method(format!(
        "\"{name}\" is no name for a strategy: use letters, digits, hyphens, dots and underscores"
    )))
}

fn unique(what: &'static str, names: impl Iterator<Item = String>) -> Result<(), PlanError> {
    let mut seen = BTreeSet::new();
    for name in names {
        if !seen.insert(name.clone()) {
            return Err(PlanError::Twice { what, name });
        }
    }
    Ok(())
}
