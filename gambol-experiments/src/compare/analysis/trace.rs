use crate::compare::{Cell, Plan, Point, RunResult};
use ne_statistics::Curve;
use serde::Serialize;

/// What a run uses up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// Evaluations.
    Evaluations,
    /// Physics steps.
    Steps,
    /// Seconds of wall clock.
    Seconds,
}

impl Axis {
    /// All, in the order they are shown.
    pub const ALL: [Self; 3] = [Self::Evaluations, Self::Steps, Self::Seconds];

    /// What it is called, in the plural.
    pub fn name(self) -> &'static str {
        match self {
            Self::Evaluations => "evaluations",
            Self::Steps => "physics steps",
            Self::Seconds => "seconds",
        }
    }

    fn of(self, point: &Point) -> f64 {
        match self {
            Self::Evaluations => point.evaluations as f64,
            Self::Steps => point.steps as f64,
            Self::Seconds => point.seconds,
        }
    }
}

/// A run as a curve over each axis.
pub(super) struct Trace {
    curves: [Option<Curve>; 3],
    first: Option<Point>,
    last: Option<Point>,
    /// Of a run whose fitness has terms: what its champion comes to without them.
    bare: Option<Option<f64>>,
}

impl Trace {
    fn new(result: Option<&RunResult>, is_shaped: bool) -> Self {
        let points = result.map_or(&[][..], |result| &result.points);
        Self {
            curves: Axis::ALL.map(|axis| curve(points, axis)),
            first: points.first().copied(),
            last: points.last().copied(),
            bare: is_shaped.then(|| result.and_then(|result| result.bare)),
        }
    }

    /// How far the run came; `None` if it is missing.
    pub(super) fn last(&self) -> Option<&Point> {
        self.last.as_ref()
    }

    /// The champion's score over what was spent; `None` if the run is missing or its file has numbers that no run has.
    pub(super) fn curve(&self, axis: Axis) -> Option<&Curve> {
        self.curves[axis as usize].as_ref()
    }

    /// The score when `limit` was spent: the best fitness at the end of the last generation that was over by then. If the
    /// fitness has terms, in its place what the champion at the end of the run comes to without them.
    pub(super) fn score(&self, axis: Axis, limit: f64) -> Option<f64> {
        self.bare.unwrap_or_else(|| self.curve(axis)?.value_at(limit))
    }

    /// Whether its fitness has terms.
    pub(super) fn is_shaped(&self) -> bool {
        self.bare.is_some()
    }

    /// The curve to draw: one without any score lies at `substitute` from the first generation on.
    pub(super) fn drawn(&self, axis: Axis, substitute: f64) -> Option<Curve> {
        let curve = self.curve(axis)?;
        if curve.first_reaching(f64::NEG_INFINITY).is_some() {
            return Some(curve.clone());
        }
        Curve::new(vec![(axis.of(self.first.as_ref()?), substitute)], curve.end()).ok()
    }
}

/// The runs of a plan.
pub(super) struct Traces {
    scenarios: Vec<Vec<Vec<Trace>>>,
}

impl Traces {
    pub(super) fn new(plan: &Plan, results: &[RunResult]) -> Self {
        let trace = |method: &str, scenario: &str, seed| {
            let is_it = |run: &&RunResult| run.method == method && run.scenario == scenario && run.seed == seed;
            let cell = plan.cells.iter().find(|cell| cell.method == method && cell.scenario == scenario);
            Trace::new(results.iter().find(is_it), cell.is_some_and(Cell::is_shaped))
        };
        let seeds =
            |method: &str, scenario: &str| plan.seeds.iter().map(|&seed| trace(method, scenario, seed)).collect();
        let methods = |scenario: &str| plan.methods.iter().map(|method| seeds(method, scenario)).collect();
        Self { scenarios: plan.scenarios.iter().map(|scenario| methods(scenario)).collect() }
    }

    pub(super) fn scenarios(&self) -> usize {
        self.scenarios.len()
    }

    /// The runs of each method on a scenario.
    pub(super) fn methods(&self, scenario: usize) -> &[Vec<Trace>] {
        &self.scenarios[scenario]
    }

    /// The runs of a method on a scenario, a run for each seed.
    pub(super) fn runs(&self, scenario: usize, method: usize) -> &[Trace] {
        &self.scenarios[scenario][method]
    }
}

/// The fitness of the champion. `None` without points, and if they are not those of a run.
fn curve(points: &[Point], axis: Axis) -> Option<Curve> {
    let end = axis.of(points.last()?);
    let mut best: Vec<(f64, f64)> = Vec::new();
    for point in points {
        let Some(score) = point.best else { continue };
        // A generation may use up no steps, or less time than a clock can tell.
        match best.last_mut().filter(|last| last.0 == axis.of(point)) {
            Some(last) => last.1 = score,
            None => best.push((axis.of(point), score)),
        }
    }
    Curve::new(best, end).ok()
}
