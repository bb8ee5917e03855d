//! The counterparts of the thesis' figures: a drawing for each scenario, and its runs one by one.

use super::{
    super::{Outcome, thesis::Scenario},
    NONE, chart, colour, escaped, number, preset_name, yes,
};

/// All of them.
pub(super) fn all(outcome: &Outcome) -> String {
    outcome.scenarios.iter().map(|scenario| figure(outcome, scenario)).collect()
}

fn figure(outcome: &Outcome, scenario: &Scenario) -> String {
    let name = scenario.name();
    let cells: Vec<_> = outcome.of(scenario).filter(|cell| !cell.runs.is_empty()).collect();
    let colours: Vec<String> = cells.iter().map(|cell| colour(outcome, &cell.cell.preset.name)).collect();
    let chart = match cells.is_empty() {
        true => "<p class=\"quiet\">No run is there yet.</p>".into(),
        false => chart::draw(&cells, &colours, &format!("fitness of {name} against the generation")),
    };
    let legend: String = cells
        .iter()
        .map(|cell| {
            let name = preset_name(outcome, &cell.cell.preset.name);
            let fitness = number(cell.fitnesses().map(|[_, median, _]| median));
            format!("<span class=\"legend-entry\">{name} median of champions <b>{fitness}</b></span>")
        })
        .collect();
    let [first, second, third] = scenario.final_fitness;
    format!(
        "<figure class=\"scenario\"><figcaption><h3>{name}</h3>\
         <p class=\"quiet\">Gegendorfer 2017 after {} generations: {first:.2}, {second:.2}, {third:.2}, in its engine's unit of \
         length, which cannot be compared with metres.</p></figcaption>\
         <div class=\"legend\">{legend}</div><div class=\"chart still\">{chart}</div>{}</figure>\n",
        super::super::thesis::GENERATIONS,
        runs(outcome, scenario)
    )
}

/// The runs of a scenario one by one.
fn runs(outcome: &Outcome, scenario: &Scenario) -> String {
    let mut rows = String::new();
    for cell in outcome.of(scenario) {
        for run in &cell.runs {
            let preset = preset_name(outcome, &run.preset);
            let champion = run.champion.as_ref();
            let generation = champion.map_or_else(|| NONE.into(), |champion| champion.generation.to_string());
            let usable = yes(champion.is_some_and(|champion| champion.usable));
            let reasons = champion.map_or_else(|| "every evaluation failed".into(), |c| c.reasons.join("; "));
            rows += &format!(
                "<tr><th>{preset}</th><td>{}</td><td>{}</td><td>{generation}</td><td>{}</td><td>{usable}</td>\
                 <td class=\"words reasons\">{}</td></tr>",
                run.seed,
                number(champion.map(|champion| champion.fitness)),
                number(champion.and_then(|champion| champion.measure(scenario.movement))),
                escaped(&reasons)
            );
        }
    }
    if rows.is_empty() {
        return rows;
    }
    let measure = measure_name(scenario.movement);
    format!(
        "<details class=\"numbers\"><summary>Run by run</summary><div class=\"scroll\"><table><thead><tr><th>preset</th>\
         <th>seed</th><th>fitness</th><th>generation</th><th>{measure}</th><th>usable</th>\
         <th class=\"words\">what speaks against it</th></tr></thead><tbody>{rows}</tbody></table></div></details>"
    )
}

/// What the plain movement is measured by.
pub(super) fn measure_name(movement: &str) -> &'static str {
    if movement == "jumping" { "rise, m" } else { "distance, m" }
}
