use super::{
    standings::Standings,
    trace::{Axis, Trace, Traces},
};
use ne_statistics::{Curve, Quartiles, pointwise_quartiles};
use serde::Serialize;

/// How many steps a curve is drawn in.
const STEPS: u32 = 120;

/// How the best scores on a scenario rose.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Curves {
    /// Over what.
    pub axis: Axis,
    /// Where scores are compared; `None` for seconds.
    pub limit: Option<f64>,
    /// Where the curves have a point.
    pub grid: Vec<f64>,
    /// Each method.
    pub methods: Vec<MethodCurve>,
}

/// The best score so far of a method's runs at each point of the grid: `None` until every run has finished a generation
/// without failing, and from where the first run has ended.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct MethodCurve {
    /// A quarter of the runs are at most this.
    pub lower: Vec<Option<f64>>,
    /// Half of the runs are at most this.
    pub median: Vec<Option<f64>>,
    /// Three quarters of the runs are at most this.
    pub upper: Vec<Option<f64>>,
}

impl Curves {
    /// The curves over each axis. `standings`: those at equal evaluations and at equal steps.
    pub(super) fn of_scenario(traces: &Traces, scenario: usize, standings: [&Standings; 2]) -> Vec<Self> {
        let worst = standings.iter().find_map(|standings| standings.scenarios[scenario].worst).unwrap_or_default();
        let curves = |axis| {
            let of_method =
                |runs: &Vec<Trace>| -> Vec<Curve> { runs.iter().filter_map(|run| run.drawn(axis, worst)).collect() };
            let methods: Vec<Vec<Curve>> = traces.methods(scenario).iter().map(of_method).collect();
            let ends = methods.iter().filter_map(|curves| curves.iter().map(Curve::end).reduce(f64::min));
            let grid = grid(ends.reduce(f64::max).unwrap_or_default());
            let standings = standings.iter().find(|standings| standings.axis == axis);
            Self {
                axis,
                limit: standings.and_then(|standings| standings.scenarios[scenario].limit),
                methods: methods.iter().map(|curves| MethodCurve::new(curves, &grid)).collect(),
                grid,
            }
        };
        Axis::ALL.map(curves).into()
    }
}

impl MethodCurve {
    fn new(curves: &[Curve], grid: &[f64]) -> Self {
        let quartiles = pointwise_quartiles(curves, grid);
        let each = |value: fn(Quartiles) -> f64| quartiles.iter().map(|at| at.map(value)).collect();
        Self { lower: each(|at| at.lower), median: each(|at| at.median), upper: each(|at| at.upper) }
    }
}

/// From 0 to exactly `end`.
fn grid(end: f64) -> Vec<f64> {
    let inner = (0..STEPS).map(|step| end * f64::from(step) / f64::from(STEPS));
    inner.chain([end]).collect()
}
