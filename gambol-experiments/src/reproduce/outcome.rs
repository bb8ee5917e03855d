use super::{
    Cell, ClockResult, Plan, ReproduceError, ReproductionFolder, RunResult, csv, page,
    thesis::{SCENARIOS, Scenario},
};
use gambol_runs::presets::Preset;
use ne_statistics::quantile;

/// Everything there is in the folder of a reproduction, and what is missing.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// Generations of each run.
    pub generations: u64,
    /// The presets there are, those asked for first.
    pub presets: Vec<Preset>,
    /// The scenarios there are, in the thesis' order.
    pub scenarios: Vec<&'static Scenario>,
    /// Each preset on each scenario: for each scenario all presets.
    pub cells: Vec<CellOutcome>,
    /// The minutes after which timed runs were looked at.
    pub clock_minutes: Vec<f64>,
    /// How many runs were asked for, timed ones included.
    pub asked: usize,
    /// The names of the runs that were asked for and are not there.
    pub missing: Vec<String>,
}

/// The results of a preset on a scenario.
#[derive(Clone, Debug)]
pub struct CellOutcome {
    /// Which preset on which scenario.
    pub cell: Cell,
    /// The runs, by seed.
    pub runs: Vec<RunResult>,
    /// The timed run.
    pub clock: Option<ClockResult>,
}

/// Reads all results of a folder, and writes `index.html`, `results.csv`, `times.csv` and `timed.csv` into it.
///
/// # Errors
/// If a file cannot be read or written, is damaged or of another run.
pub fn write_outcome(folder: &ReproductionFolder, plan: &Plan) -> Result<Outcome, ReproduceError> {
    let outcome = read(folder, plan)?;
    folder.files.write_files(&[
        ("results.csv", csv::results(&outcome)),
        ("times.csv", csv::times(&outcome)),
        ("timed.csv", csv::timed(&outcome)),
        ("index.html", page::render(&outcome)),
    ])?;
    Ok(outcome)
}

fn read(folder: &ReproductionFolder, plan: &Plan) -> Result<Outcome, ReproduceError> {
    let is_asked = |preset: &Preset| plan.presets.iter().any(|asked| asked.name == preset.name);
    let others = plan.registry.presets.entries().filter(|preset| !is_asked(preset)).cloned();
    let mut cells = Vec::new();
    for scenario in SCENARIOS {
        for preset in plan.presets.iter().cloned().chain(others.clone()) {
            let cell = Cell::new(&preset, scenario, plan.generations, &plan.registry)?;
            let mut runs = Vec::new();
            for seed in folder.seeds(&cell)? {
                runs.extend(folder.run_result(&cell, seed)?);
            }
            let clock = folder.clock_result(&cell)?;
            cells.push(CellOutcome { cell, runs, clock });
        }
    }
    let is_there = |cell: &&CellOutcome| !cell.runs.is_empty() || cell.clock.is_some();
    let presets: Vec<Preset> = plan
        .presets
        .iter()
        .cloned()
        .chain(others)
        .filter(|preset| {
            is_asked(preset) || cells.iter().filter(is_there).any(|cell| cell.cell.preset.name == preset.name)
        })
        .collect();
    let scenarios: Vec<&'static Scenario> = SCENARIOS
        .iter()
        .filter(|scenario| {
            plan.scenarios.contains(scenario)
                || cells.iter().filter(is_there).any(|cell| cell.cell.scenario == *scenario)
        })
        .collect();
    cells.retain(|cell| {
        scenarios.contains(&cell.cell.scenario) && presets.iter().any(|preset| preset.name == cell.cell.preset.name)
    });
    let mut missing = Vec::new();
    for job in plan.jobs() {
        if !folder.has(job)? {
            missing.push(job.name());
        }
    }
    let first_clock = cells.iter().find_map(|cell| cell.clock.as_ref());
    let found = first_clock.map(|clock| clock.marks.iter().map(|mark| mark.minutes).collect());
    let clock_minutes = plan.clock_minutes.clone().or(found).unwrap_or_default();
    let asked = plan.jobs().count();
    Ok(Outcome { generations: plan.generations, presets, scenarios, cells, clock_minutes, asked, missing })
}

impl Outcome {
    /// The results of a preset on a scenario.
    pub fn of<'a>(&'a self, scenario: &'a Scenario) -> impl Iterator<Item = &'a CellOutcome> {
        self.cells.iter().filter(move |cell| cell.cell.scenario == scenario)
    }
}

impl CellOutcome {
    /// How many runs have a usable champion.
    pub fn usable(&self) -> usize {
        self.runs.iter().filter(|run| run.champion.as_ref().is_some_and(|champion| champion.usable)).count()
    }

    /// The lowest, the middle and the highest of what the plain movement is measured by, m; runs without a measure left
    /// out, `None` if that are all.
    pub fn measures(&self) -> Option<[f64; 3]> {
        let movement = self.cell.scenario.movement;
        let measured = |run: &RunResult| run.champion.as_ref()?.measure(movement);
        spread(&self.runs.iter().filter_map(measured).collect::<Vec<_>>())
    }

    /// The lowest, the middle and the highest fitness of champions.
    pub fn fitnesses(&self) -> Option<[f64; 3]> {
        let fitness = |run: &RunResult| run.champion.as_ref().map(|champion| champion.fitness);
        spread(&self.runs.iter().filter_map(fitness).collect::<Vec<_>>())
    }

    /// The middle one of the seconds the runs took.
    pub fn seconds(&self) -> Option<f64> {
        quantile(&self.runs.iter().map(|run| run.seconds).collect::<Vec<_>>(), 0.5)
    }
}

fn spread(values: &[f64]) -> Option<[f64; 3]> {
    Some([quantile(values, 0.0)?, quantile(values, 0.5)?, quantile(values, 1.0)?])
}
