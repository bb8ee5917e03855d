//! Runs as rows of tables.

use super::{GaitRun, Variant};
use gambol_runs::{Registry, texts::csv_cell};
use ne_statistics::quantile;
use tasks::gait::Goal;

/// The columns of [`scenario_row`].
pub const SCENARIOS: [&str; 8] =
    ["creature", "movement", "usable", "after (median)", "slowest", "speed or rise", "robust", "least robust"];
/// The columns of [`ablation_row`].
pub const ABLATION: [&str; 5] = ["variant", "usable", "median to it", "quality", "robust"];

/// What stands in a table for what was not measured, or never happened.
const UNKNOWN: &str = "–";

/// The runs of a scenario: how many are usable, the time until they were, speed or rise, and shares of perturbed worlds. The time
/// is in physics steps if `count_steps`, in seconds otherwise.
pub fn scenario_row(runs: &[GaitRun], count_steps: bool, registry: &Registry) -> [String; 8] {
    let Some(GaitRun { creature, movement, .. }) = runs.first() else { return Default::default() };
    let usable = runs.iter().filter(|run| run.usable).count();
    let middle = |numbers: Vec<f64>| quantile(&numbers, 0.5);
    let (time_unit, time_of): (_, fn(&GaitRun) -> Option<f64>) = match count_steps {
        true => (" M", |run| run.steps_to_usable.map(|steps| steps as f64 / 1e6)),
        false => (" s", |run| run.seconds_to_usable),
    };
    // A run that never was usable took longer than any.
    let times: Vec<f64> = runs.iter().map(|run| time_of(run).unwrap_or(f64::INFINITY)).collect();
    let slowest = times.iter().copied().reduce(f64::max).filter(|time| time.is_finite());
    let shown = |number: Option<f64>, unit: &str| number.map_or_else(|| UNKNOWN.into(), |n| format!("{n:.2}{unit}"));
    let quality = middle(runs.iter().filter_map(|run| run.quality).collect());
    let goal = registry.movements.rules(movement).map(|rules| rules.view().goal);
    let unit = if goal == Some(Goal::Height) { " sh" } else { " bl/s" };
    let shares: Vec<f64> = runs.iter().filter_map(|run| run.robust).collect();
    let least = shares.iter().copied().reduce(f64::min);
    let percent = |share: Option<f64>| share.map_or_else(|| UNKNOWN.into(), |share| format!("{:.0} %", 100.0 * share));
    [
        creature.clone(),
        movement.clone(),
        format!("{usable}/{}", runs.len()),
        shown(middle(times).filter(|time| time.is_finite()), time_unit),
        shown(slowest, time_unit),
        shown(quality, unit),
        percent(middle(shares)),
        percent(least),
    ]
}

/// A variant as a row of the table: how many runs are usable, the time to it, the median of the quality over that of the
/// same run of the first variant, and the mean share of perturbed worlds. `runs`: each with that of the first variant.
pub fn ablation_row(variant: &Variant, runs: &[(&GaitRun, &GaitRun)]) -> [String; 5] {
    let usable = runs.iter().filter(|(run, _)| run.usable).count();
    let steps_of =
        |run: &GaitRun| run.steps_to_usable.filter(|_| run.usable).map_or(f64::INFINITY, |steps| steps as f64);
    let steps = match quantile(&runs.iter().map(|(run, _)| steps_of(run)).collect::<Vec<_>>(), 0.5) {
        Some(steps) if steps.is_finite() => format!("{:.2} M", steps / 1e6),
        _ => UNKNOWN.into(),
    };
    let quality = |run: &GaitRun| run.quality.unwrap_or(0.0).max(0.0);
    let ratios =
        runs.iter().filter(|(_, usual)| quality(usual) > 0.0).map(|(run, usual)| quality(run) / quality(usual));
    let ratio =
        quantile(&ratios.collect::<Vec<_>>(), 0.5).map_or_else(|| UNKNOWN.into(), |ratio| format!("× {ratio:.2}"));
    let shares: Vec<f64> = runs.iter().filter_map(|(run, _)| run.robust).collect();
    let robust = match shares.len() {
        0 => UNKNOWN.into(),
        count => format!("{:.0} %", 100.0 * shares.iter().sum::<f64>() / count as f64),
    };
    [variant.name.into(), format!("{usable}/{}", runs.len()), steps, ratio, robust]
}

/// A table as CSV, without columns of which nothing is known.
pub fn csv<const COLUMNS: usize>(columns: &[&str; COLUMNS], rows: &[[String; COLUMNS]]) -> String {
    let known: Vec<usize> = (0..COLUMNS).filter(|&column| rows.iter().any(|row| row[column] != UNKNOWN)).collect();
    let line =
        |cell: &dyn Fn(usize) -> String| known.iter().map(|&column| cell(column)).collect::<Vec<_>>().join(",") + "\n";
    let head = line(&|column| csv_cell(columns[column]));
    rows.iter().fold(head, |text, row| text + &line(&|column| csv_cell(&row[column])))
}
