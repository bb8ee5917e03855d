//! What can be said of a comparison: a pure function from a plan and its results to plain data, which the page, the
//! table in the terminal and the CSV files only show.
//!
//! Its one decision: **what is compared is fixed by the plan, not by the outcome.** The plan's budget says which score
//! the headline speaks of ([`Analysis::primary`]), every pair of methods is tested on every scenario, and all those
//! tests are corrected together, as are those over all scenarios. What the data cannot say is said as well ([`Analysis::caveats`]).

mod caveats;
mod curves;
mod headline;
mod overall;
mod standings;
#[cfg(test)]
mod tests;
mod threshold;
mod trace;

pub use curves::{Curves, MethodCurve};
pub use overall::{Estimate, Improvement, Overall};
pub use standings::{Effect, MethodScores, PairTest, ScenarioStandings, Standings, Summary};
pub use threshold::{Threshold, TimeToThreshold};
pub use trace::Axis;

use super::{Cell, Plan, Provenance, RunResult};
use ne_core::StopConditions;
use serde::Serialize;
use trace::Traces;

/// A p value or one less an interval's confidence: from here on a difference is claimed.
const SIGNIFICANCE: f64 = 0.05;
/// With fewer seeds no signed-rank test can reach [`SIGNIFICANCE`], and nothing is claimed of pairs or over all scenarios.
const FEWEST_SEEDS: usize = 6;
/// The same for rank-sum tests of single scenarios.
const FEWEST_SEEDS_UNPAIRED: usize = 4;

/// What can be said of a comparison. Methods and scenarios are in the plan's order, and pairs refer to methods by their
/// place in it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Analysis {
    /// The methods.
    pub methods: Vec<MethodFacts>,
    /// The scenarios.
    pub scenarios: Vec<ScenarioFacts>,
    /// The seeds.
    pub seeds: Vec<u64>,
    /// The budget of each run.
    pub budget: StopConditions,
    /// What the headline's scores are equal in: evaluations if the budget is one of evaluations, otherwise steps.
    pub primary: Axis,
    /// What was found, in sentences.
    pub headline: Vec<String>,
    /// What must not be concluded, in sentences.
    pub caveats: Vec<String>,
    /// Scores when all runs of a scenario have used up equally many evaluations.
    pub at_equal_evaluations: Standings,
    /// Scores when all runs of a scenario have used up equally many physics steps. Here as there, scenarios whose fitness has
    /// terms have scores only where the plan's budget is of this kind.
    pub at_equal_steps: Standings,
    /// All runs: scenario by scenario, there method by method, there seed by seed.
    pub runs: Vec<RunFacts>,
}

/// A method, as a reader wants to know it.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodFacts {
    /// Its name.
    pub name: String,
    /// The name of its strategy.
    pub strategy: String,
}

/// A scenario, and how the best scores rose there.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ScenarioFacts {
    /// Its name.
    pub name: String,
    /// The unit of its scores.
    pub unit: String,
    /// Whether a fitness there has terms. Then scores are what champions come to without them.
    pub shaped: bool,
    /// Which test is made, and why, in a sentence.
    pub test: String,
    /// What all methods have alike there, and from where.
    pub alike: Vec<Provenance>,
    /// What each method has besides.
    pub own: Vec<Vec<Provenance>>,
    /// The curves over evaluations, steps and seconds.
    pub curves: Vec<Curves>,
    /// How long it took to reach shares of the best median score; none if that is not above 0.
    pub thresholds: Vec<Threshold>,
}

/// A run. Totals are `None` if the run is missing.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct RunFacts {
    /// The method's name.
    pub method: String,
    /// The scenario's name.
    pub scenario: String,
    /// The seed.
    pub seed: u64,
    /// The best fitness at the end of the run, terms included.
    pub fitness: Option<f64>,
    /// The score at equal evaluations; `None` if it had none by then.
    pub score_at_equal_evaluations: Option<f64>,
    /// The score at equal physics steps; `None` if it had none by then.
    pub score_at_equal_steps: Option<f64>,
    /// Evaluations of the whole run.
    pub evaluations: Option<u64>,
    /// Physics steps of the whole run.
    pub steps: Option<u64>,
    /// Seconds of the whole run.
    pub seconds: Option<f64>,
}

impl Analysis {
    /// The standings the headline speaks of.
    pub fn primary_standings(&self) -> &Standings {
        if self.primary == Axis::Steps { &self.at_equal_steps } else { &self.at_equal_evaluations }
    }

    /// Whether runs with the same seed are pairs on every scenario.
    fn is_paired(&self) -> bool {
        self.primary_standings().scenarios.iter().all(|scenario| scenario.paired)
    }

    /// With fewer seeds nothing is claimed of single scenarios.
    fn fewest_seeds(&self) -> usize {
        if self.is_paired() { FEWEST_SEEDS } else { FEWEST_SEEDS_UNPAIRED }
    }
}

/// Analyses the results of a plan. A run that is missing or not usable counts as one without a score.
pub fn analyse(plan: &Plan, results: &[RunResult]) -> Analysis {
    let traces = Traces::new(plan, results);
    let paired: Vec<bool> = plan.scenarios.iter().map(|name| cells(plan, name).all(Cell::shares_worlds)).collect();
    let at_equal_evaluations = Standings::new(&traces, Axis::Evaluations, plan.budget.evaluations, &paired);
    let at_equal_steps = Standings::new(&traces, Axis::Steps, plan.budget.steps, &paired);
    let primary =
        if plan.budget.evaluations.is_none() && plan.budget.steps.is_some() { Axis::Steps } else { Axis::Evaluations };
    let standings = if primary == Axis::Steps { &at_equal_steps } else { &at_equal_evaluations };
    let scenarios = plan.scenarios.iter().enumerate().map(|(index, name)| ScenarioFacts {
        name: name.clone(),
        unit: cells(plan, name).next().map_or_else(String::new, |cell| cell.unit.clone()),
        shaped: cells(plan, name).any(Cell::is_shaped),
        test: (if paired[index] { PAIRED } else { UNPAIRED }).into(),
        alike: alike(plan, name),
        own: cells(plan, name).map(|cell| own(cell, &alike(plan, name))).collect(),
        curves: Curves::of_scenario(&traces, index, [&at_equal_evaluations, &at_equal_steps]),
        thresholds: Threshold::of_scenario(&traces, index, standings),
    });
    let mut analysis = Analysis {
        methods: plan.methods.iter().map(|name| method_facts(plan, name)).collect(),
        scenarios: scenarios.collect(),
        seeds: plan.seeds.clone(),
        budget: plan.budget,
        primary,
        headline: Vec::new(),
        caveats: Vec::new(),
        runs: run_facts(plan, &traces, [&at_equal_evaluations, &at_equal_steps]),
        at_equal_evaluations,
        at_equal_steps,
    };
    analysis.headline = headline::headline(&analysis);
    analysis.caveats = caveats::caveats(&analysis);
    analysis
}

const PAIRED: &str = "Signed-rank tests of pairs: worlds vary, drawn from seed and generation, so that runs with the same \
                      seed meet the same worlds in the same generations.";
const UNPAIRED: &str = "Rank-sum tests of independent runs: worlds do not vary, so that runs with the same seed share \
                        nothing but its number.";

/// The methods on a scenario.
fn cells<'a>(plan: &'a Plan, scenario: &'a str) -> impl Iterator<Item = &'a Cell> {
    plan.cells.iter().filter(move |cell| cell.scenario == scenario)
}

/// What all methods have alike on a scenario.
fn alike(plan: &Plan, scenario: &str) -> Vec<Provenance> {
    let Some(first) = cells(plan, scenario).next() else { return Vec::new() };
    let has_it = |had: &&Provenance| cells(plan, scenario).all(|cell| cell.provenance.contains(had));
    first.provenance.iter().filter(has_it).cloned().collect()
}

/// What a method has besides.
fn own(cell: &Cell, alike: &[Provenance]) -> Vec<Provenance> {
    cell.provenance.iter().filter(|had| !alike.contains(had)).cloned().collect()
}

fn method_facts(plan: &Plan, name: &str) -> MethodFacts {
    let config = plan.cells.iter().find(|cell| cell.method == name).map(|cell| &cell.config);
    let strategy = config.map_or_else(String::new, |config| config.strategy.name().into());
    MethodFacts { name: name.into(), strategy }
}

fn run_facts(plan: &Plan, traces: &Traces, standings: [&Standings; 2]) -> Vec<RunFacts> {
    let mut runs = Vec::new();
    for (scenario, scenario_name) in plan.scenarios.iter().enumerate() {
        for (method, method_name) in plan.methods.iter().enumerate() {
            for (trace, &seed) in traces.runs(scenario, method).iter().zip(&plan.seeds) {
                let [at_evaluations, at_steps] =
                    standings.map(|standings| trace.score(standings.axis, standings.scenarios[scenario].limit?));
                runs.push(RunFacts {
                    method: method_name.clone(),
                    scenario: scenario_name.clone(),
                    seed,
                    fitness: trace.last().and_then(|last| last.best),
                    score_at_equal_evaluations: at_evaluations,
                    score_at_equal_steps: at_steps,
                    evaluations: trace.last().map(|last| last.evaluations),
                    steps: trace.last().map(|last| last.steps),
                    seconds: trace.last().map(|last| last.seconds),
                });
            }
        }
    }
    runs
}
