//! The raw data as CSV, and the table in short, for documents.

use super::{
    Analysis, Plan, Provenance, RunResult,
    analysis::Estimate,
    figures::{decimals, number},
};
use gambol_runs::texts::csv_cell;
use std::fmt::Write;

/// A row for each run:
/// `method,scenario,seed,score_at_equal_evaluations,score_at_equal_steps,fitness,evaluations,steps,seconds`, where `fitness`
/// has the terms in it.
///
/// A score is empty if the run had none by then; nothing is put in its place here.
pub(super) fn scores(analysis: &Analysis) -> String {
    let mut text = String::from(
        "method,scenario,seed,score_at_equal_evaluations,score_at_equal_steps,fitness,evaluations,steps,seconds\n",
    );
    for run in &analysis.runs {
        let name = [&run.method, &run.scenario].map(|name| csv_cell(name)).join(",");
        let scores = [run.score_at_equal_evaluations, run.score_at_equal_steps].map(field).join(",");
        let (evaluations, steps, seconds) = (field(run.evaluations), field(run.steps), field(run.seconds));
        // Writing to a string cannot fail.
        let fitness = field(run.fitness);
        let _ = writeln!(text, "{name},{},{scores},{fitness},{evaluations},{steps},{seconds}", run.seed);
    }
    text
}

/// A row for each scenario, with the median score of each method, and one for the interquartile means over all scenarios.
pub(super) fn medians(analysis: &Analysis) -> String {
    let names = analysis.methods.iter().map(|method| csv_cell(&method.name));
    let mut rows = vec![std::iter::once("scenario".into()).chain(names).collect::<Vec<String>>()];
    let standings = analysis.primary_standings();
    for (facts, scenario) in analysis.scenarios.iter().zip(&standings.scenarios) {
        let places = decimals(scenario.worst.into_iter().chain(scenario.best));
        let median = |median: Option<f64>| median.map_or_else(String::new, |median| number(median, places));
        let medians = scenario.methods.iter().map(|scores| median(scores.summary.map(|summary| summary.median)));
        let name = csv_cell(&format!("{}, {}", facts.name, facts.unit));
        rows.push(std::iter::once(name).chain(medians).collect());
    }
    if let Some(overall) = &standings.overall {
        let mean = |mean: &Estimate| match mean.interval {
            Some([low, high]) => {
                let [value, low, high] = [mean.value, low, high].map(|value| number(value, 2));
                format!("{value} ({low} to {high})")
            }
            None => number(mean.value, 2),
        };
        rows.push(std::iter::once("interquartile mean".into()).chain(overall.methods.iter().map(mean)).collect());
    }
    rows.iter().map(|row| row.join(",") + "\n").collect()
}

/// A row for each field of each method on each scenario: `method,scenario,field,value,from`.
pub(super) fn settings(plan: &Plan) -> String {
    let mut text = String::from("method,scenario,field,value,from\n");
    for cell in &plan.cells {
        for Provenance { field, value, from } in &cell.provenance {
            let row = [&cell.method, &cell.scenario, field, &value.to_string(), from].map(|name| csv_cell(name));
            text += &row.join(",");
            text.push('\n');
        }
    }
    text
}

/// A row for each point of each run: `method,scenario,seed,evaluations,steps,seconds,best`.
///
/// `best` is empty while every evaluation had failed.
pub(super) fn curves(results: &[RunResult]) -> String {
    let mut text = String::from("method,scenario,seed,evaluations,steps,seconds,best\n");
    for run in results {
        let name = [&run.method, &run.scenario].map(|name| csv_cell(name)).join(",");
        for point in &run.points {
            let (evaluations, steps, seconds, best) =
                (point.evaluations, point.steps, point.seconds, field(point.best));
            let _ = writeln!(text, "{name},{},{evaluations},{steps},{seconds},{best}", run.seed);
        }
    }
    text
}

fn field(value: Option<impl ToString>) -> String {
    value.map_or_else(String::new, |value| value.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{
        analyse,
        testing::{comparison, plan, run},
    };

    #[test]
    fn medians_are_those_of_each_method_and_scenario() {
        let (plan, results) = comparison(&["a", "b"], &["s", "t"], 6, |method, scenario, seed| {
            (10 * scenario + method) as f64 + seed as f64 / 10.0
        });
        let text = medians(&analyse(&plan, &results));
        let rows: Vec<&str> = text.lines().collect();
        assert_eq!((rows.len(), rows[0]), (4, "scenario,a,b"));
        let cells = |row: &str| row.rsplitn(3, ',').map(str::to_owned).collect::<Vec<_>>();
        assert_eq!(cells(rows[1])[..2], ["1.35", "0.35"], "seeds from 1 to 6: {text}");
        assert_eq!(cells(rows[2])[..2], ["11.35", "10.35"]);
        assert!(rows[3].starts_with("interquartile mean,0.") && rows[3].contains(" to "), "{}", rows[3]);
    }

    #[test]
    fn raw_data_has_no_substitutes_and_is_csv_cell() {
        let plan = plan(&["a, \"b\""], &["s"], 2);
        let name = "a, \"b\"";
        let results = [
            run(name, "s", 1, &[(500, None), (900, Some(1.5)), (1200, Some(2.0))]),
            run(name, "s", 2, &[(1100, None)]),
        ];
        assert_eq!(
            scores(&analyse(&plan, &results)),
            "method,scenario,seed,score_at_equal_evaluations,score_at_equal_steps,fitness,evaluations,steps,seconds\n\
             \"a, \"\"b\"\"\",s,1,1.5,1.5,2,1200,12000,12\n\
             \"a, \"\"b\"\"\",s,2,,,,1100,11000,11\n"
        );
        assert_eq!(
            curves(&results),
            "method,scenario,seed,evaluations,steps,seconds,best\n\
             \"a, \"\"b\"\"\",s,1,500,5000,5,\n\
             \"a, \"\"b\"\"\",s,1,900,9000,9,1.5\n\
             \"a, \"\"b\"\"\",s,1,1200,12000,12,2\n\
             \"a, \"\"b\"\"\",s,2,1100,11000,11,\n"
        );
    }

    #[test]
    fn a_run_that_is_missing_has_empty_fields() {
        let text = scores(&analyse(&plan(&["a"], &["s"], 1), &[]));
        assert_eq!(text.lines().nth(1), Some("a,s,1,,,,,,"));
    }
}
