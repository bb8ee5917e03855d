//! The generations for the page: fitnesses, species, and what the strategy says of itself. Only the first is a row for
//! each generation; the others are a column for each species and each number, which is several times shorter.

use ne_core::{Fitness, GenerationReport};
use serde::Serialize;
use std::collections::BTreeMap;

#[derive(Serialize)]
pub(super) struct HistoryPoint {
    generation: u64,
    evaluations: u64,
    failures: u64,
    best_so_far: Option<f64>,
    best: Option<f64>,
    mean: Option<f64>,
    median: Option<f64>,
    worst: Option<f64>,
    quantiles: Option<BandPoint>,
}

#[derive(Serialize)]
struct BandPoint {
    q10: f64,
    q25: f64,
    q75: f64,
    q90: f64,
}

/// The rows of the chart. The last has the champion's fitness: it may have been chosen between two re-evaluations.
pub(super) fn points(log: &[GenerationReport], champion: Option<Fitness>) -> Vec<HistoryPoint> {
    let mut points: Vec<HistoryPoint> = log.iter().map(HistoryPoint::from).collect();
    if let (Some(last), Some(fitness)) = (points.last_mut(), champion) {
        last.best_so_far = Some(f64::from(fitness));
    }
    points
}

impl HistoryPoint {
    /// The same row, so many generations later.
    pub(super) fn after(self, generations: u64) -> Self {
        Self { generation: self.generation + generations, ..self }
    }
}

impl From<&GenerationReport> for HistoryPoint {
    fn from(report: &GenerationReport) -> Self {
        let fitness = report.fitness;
        Self {
            generation: report.generation,
            evaluations: report.population,
            failures: report.failures,
            best_so_far: report.best_so_far.map(f64::from),
            best: fitness.map(|of| of.best),
            mean: fitness.map(|of| of.mean),
            median: fitness.map(|of| of.median),
            worst: fitness.map(|of| of.worst),
            quantiles: fitness.map(|of| BandPoint { q10: of.q10, q25: of.q25, q75: of.q75, q90: of.q90 }),
        }
    }
}

/// A species from its first row of the history to its last.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct SpeciesHistory {
    id: u64,
    /// The index of its first row of the history.
    start: usize,
    /// Its members in each row from there.
    sizes: Vec<u64>,
    /// Its best fitness in each row from there, rounded; `None` if all its evaluations failed.
    best: Vec<Option<f64>>,
}

/// The species of a run, in order of their ids.
pub(super) fn species(log: &[GenerationReport]) -> Vec<SpeciesHistory> {
    let mut histories = BTreeMap::new();
    for (row, report) in log.iter().enumerate() {
        for species in &report.species {
            let history = histories.entry(species.id).or_insert_with(|| SpeciesHistory {
                id: species.id,
                start: row,
                sizes: Vec::new(),
                best: Vec::new(),
            });
            // A species that is away for a while has no members then.
            history.sizes.resize(row - history.start, 0);
            history.best.resize(row - history.start, None);
            history.sizes.push(species.size);
            history.best.push(species.best.map(Fitness::get).map(rounded));
        }
    }
    histories.into_values().collect()
}

/// A number the strategy reports, in each row of the history.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct StatisticHistory {
    name: String,
    /// Rounded; `None` where it was not reported.
    values: Vec<Option<f64>>,
}

/// The strategy's statistics, in the order in which they are first reported.
pub(super) fn statistics(log: &[GenerationReport]) -> Vec<StatisticHistory> {
    let mut histories: Vec<StatisticHistory> = Vec::new();
    for (row, report) in log.iter().enumerate() {
        for statistic in &report.strategy {
            let known = histories.iter().position(|history| history.name == statistic.name);
            let index = known.unwrap_or_else(|| {
                histories.push(StatisticHistory { name: statistic.name.clone(), values: vec![None; log.len()] });
                histories.len() - 1
            });
            histories[index].values[row] = Some(rounded(statistic.value));
        }
    }
    histories
}

/// Six significant digits: three more than the page shows, so that rounding twice hardly ever shows.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{SpeciesReport, Statistic};

    fn report(species: &[(u64, u64, f64)], statistics: &[(&str, f64)]) -> GenerationReport {
        let report = |&(id, size, best): &(u64, u64, f64)| SpeciesReport { id, size, best: Fitness::new(best).ok() };
        GenerationReport {
            generation: 1,
            evaluations: 10,
            steps: 0,
            best_so_far: None,
            tier: 0,
            fitness: None,
            failures: 0,
            failure: None,
            population: 10,
            strategy: statistics.iter().map(|&(name, value)| Statistic::new(name, value)).collect(),
            species: species.iter().map(report).collect(),
            re_evaluation: None,
        }
    }

    #[test]
    fn the_last_row_knows_a_champion_chosen_between_two_re_evaluations() {
        let log = [report(&[], &[]), report(&[], &[])];
        let champions = |champion: Option<Fitness>| points(&log, champion).iter().map(|row| row.best_so_far).collect();
        let found: Vec<Option<f64>> = champions(Fitness::new(3.5).ok());
        assert_eq!(found, [None, Some(3.5)]);
        let found: Vec<Option<f64>> = champions(None);
        assert_eq!(found, [None, None]);
    }

    #[test]
    fn species_become_columns_from_their_first_generation_to_their_last() {
        let log = [
            report(&[(1, 10, 0.5)], &[]),
            report(&[(1, 4, 0.25), (2, 6, f64::NAN)], &[]),
            report(&[(2, 10, 1.0)], &[]),
            report(&[(1, 3, 2.0), (2, 7, 1.0 / 3.0)], &[]),
        ];
        let best = vec![Some(0.5), Some(0.25), None, Some(2.0)];
        let first = SpeciesHistory { id: 1, start: 0, sizes: vec![10, 4, 0, 3], best };
        let second =
            SpeciesHistory { id: 2, start: 1, sizes: vec![6, 10, 7], best: vec![None, Some(1.0), Some(0.333_333)] };
        assert_eq!(species(&log), [first, second]);
        assert_eq!(species(&[report(&[], &[])]), []);
    }

    #[test]
    fn statistics_become_columns_as_long_as_the_history() {
        let log = [
            report(&[], &[("deviation", 0.123_456_7), ("population", 30.0)]),
            report(&[], &[("deviation", -1_234_567.8)]),
            report(&[], &[("restarts", 1e-9), ("deviation", 0.0)]),
        ];
        let column =
            |name: &str, values: [Option<f64>; 3]| StatisticHistory { name: name.into(), values: values.into() };
        let expected = [
            column("deviation", [Some(0.123_457), Some(-1_234_570.0), Some(0.0)]),
            column("population", [Some(30.0), None, None]),
            column("restarts", [None, None, Some(1e-9)]),
        ];
        assert_eq!(statistics(&log), expected);
    }
}
