//! The tables: which champions are usable at the end and how long it takes, and the counterparts of the thesis' tables
//! 5.1 and 5.2.

use super::{
    super::{
        CellOutcome, ClockResult, Judged, Outcome,
        thesis::{GENERATIONS, Scenario},
    },
    NONE,
    figures::measure_name,
    number, preset_name, wall, yes,
};

/// Usable runs, distances and wall clock at the end, for each movement.
pub(super) fn usable(outcome: &Outcome) -> String {
    movements(outcome).into_iter().map(|movement| usable_of(outcome, movement)).collect()
}

fn usable_of(outcome: &Outcome, movement: &str) -> String {
    let mut rows = String::new();
    for scenario in of_movement(outcome, movement) {
        rows += &format!(
            "<tr><th>{}</th><td class=\"words\">Gegendorfer 2017</td><td>{}</td><td>{NONE}</td><td>{NONE}</td>\
             <td>{:.0} min</td></tr>",
            scenario.creature,
            yes(scenario.usable),
            scenario.minutes
        );
        for cell in outcome.of(scenario) {
            let [low, median, high] = match cell.measures() {
                Some(measures) => measures.map(|metres| number(Some(metres))),
                None => [NONE; 3].map(String::from),
            };
            rows += &format!(
                "<tr class=\"ours\"><th></th><td class=\"words\">{}</td><td>{}</td><td>{median}</td><td>{low} to {high}</td>\
                 <td>{}</td></tr>",
                preset_name(outcome, &cell.cell.preset.name),
                share_usable(cell),
                wall(cell.seconds())
            );
        }
    }
    let (measure, generations) = (measure_name(movement), outcome.generations);
    table(
        movement,
        &format!(
            "<tr><th>creature</th><th class=\"words\">source</th><th>usable</th><th>{measure}: median</th><th>lowest \
             to highest</th><th>wall clock for {generations} generations</th></tr>"
        ),
        &rows,
    )
}

/// Counterparts of tables 5.1 and 5.2: timed runs, beside the runs of all generations.
pub(super) fn timed(outcome: &Outcome) -> String {
    let note = match outcome.cells.iter().any(|cell| cell.clock.is_some()) {
        true => threads(outcome),
        false => {
            "<p class=\"intro\">There are no timed runs: <code>--clock</code> adds them. They take as many minutes \
                  each as the last moment they are looked at.</p>"
                .into()
        }
    };
    let tables: String = movements(outcome).into_iter().map(|movement| timed_of(outcome, movement)).collect();
    note + &tables
}

fn timed_of(outcome: &Outcome, movement: &str) -> String {
    let minutes = &outcome.clock_minutes;
    let mut groups = String::from("<tr><th></th><th></th>");
    let mut head = String::from("<tr><th>creature</th><th class=\"words\">source</th>");
    for minutes in minutes {
        let plural = if *minutes == 1.0 { "" } else { "s" };
        groups += &format!("<th colspan=\"4\">{minutes} minute{plural}</th>");
        head += &format!("<th>generations</th><th>fitness</th><th>{}</th><th>usable</th>", measure_name(movement));
    }
    groups += &format!("<th colspan=\"3\">{} generations</th></tr>", outcome.generations);
    head += &format!("<th>fitness</th><th>{}</th><th>usable</th></tr>", measure_name(movement));
    let mut rows = String::new();
    for scenario in of_movement(outcome, movement) {
        rows += &thesis_row(scenario, minutes);
        for cell in outcome.of(scenario) {
            rows += &our_row(outcome, cell, minutes);
        }
    }
    table(movement, &(groups + &head), &rows)
}

fn thesis_row(scenario: &Scenario, minutes: &[f64]) -> String {
    let mut row = format!("<tr><th>{}</th><td class=\"words\">Gegendorfer 2017</td>", scenario.creature);
    for &minutes in minutes {
        row += &match scenario.after(minutes) {
            Some(Some(timed)) => format!(
                "<td>{}</td><td>{:.2}</td><td>{NONE}</td><td>{}</td>",
                timed.generations,
                timed.fitness,
                yes(timed.usable)
            ),
            Some(None) => "<td colspan=\"4\">not reached</td>".into(),
            None => format!("<td colspan=\"4\">{NONE}</td>"),
        };
    }
    let (best, usable) = (scenario.best_final_fitness(), yes(scenario.usable));
    row + &format!(
        "<td title=\"after {GENERATIONS} generations\">{best:.2}</td><td>{NONE}</td><td>{usable}</td></tr>\n"
    )
}

fn our_row(outcome: &Outcome, cell: &CellOutcome, minutes: &[f64]) -> String {
    let preset = preset_name(outcome, &cell.cell.preset.name);
    let movement = cell.cell.scenario.movement;
    let mut row = format!("<tr class=\"ours\"><th></th><td class=\"words\">{preset}</td>");
    for &minutes in minutes {
        let mark = cell.clock.as_ref().and_then(|clock: &ClockResult| {
            // Moments are compared as they were written.
            clock.marks.iter().find(|mark| mark.minutes == minutes)
        });
        row += &match mark {
            None => format!("<td colspan=\"4\">{NONE}</td>"),
            Some(mark) => {
                let champion = mark.champion.as_ref();
                let usable = yes(champion.is_some_and(|champion| champion.usable));
                let [fitness, measure] = fitness_and_measure(champion, movement);
                format!(
                    "<td class=\"wall\">{}</td><td class=\"wall\">{fitness}</td><td class=\"wall\">{measure}</td>\
                     <td class=\"wall\">{usable}</td>",
                    mark.generations
                )
            }
        };
    }
    let best = cell.runs.iter().filter_map(|run| run.champion.as_ref());
    let best = best.max_by(|one, other| one.fitness.total_cmp(&other.fitness));
    let [fitness, measure] = fitness_and_measure(best, movement);
    row + &format!("<td>{fitness}</td><td>{measure}</td><td>{}</td></tr>\n", share_usable(cell))
}

fn fitness_and_measure(champion: Option<&Judged>, movement: &str) -> [String; 2] {
    [champion.map(|champion| champion.fitness), champion.and_then(|champion| champion.measure(movement))].map(number)
}

/// How many runs of how many are usable.
fn share_usable(cell: &CellOutcome) -> String {
    match cell.runs.len() {
        0 => NONE.into(),
        runs => format!("{} of {runs}", cell.usable()),
    }
}

/// On how many threads the timed runs ran.
fn threads(outcome: &Outcome) -> String {
    let mut counts: Vec<usize> =
        outcome.cells.iter().filter_map(|cell| cell.clock.as_ref()).map(|clock| clock.threads).collect();
    counts.sort_unstable();
    counts.dedup();
    let words: Vec<String> = counts
        .into_iter()
        .map(|threads| match threads {
            0 => "as many threads as there are cores".into(),
            1 => "one thread".into(),
            threads => format!("{threads} threads"),
        })
        .collect();
    format!(
        "<p class=\"intro\">Our timed runs ran one by one, on <span class=\"wall\">{}</span>; those of the thesis on one \
         thread of a Core i5-4670K at 3.4 GHz, in 2017.</p>",
        words.join(" or ")
    )
}

fn table(movement: &str, head: &str, rows: &str) -> String {
    let mut name = movement.to_owned();
    if let Some(first) = name.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    format!("<h3>{name}</h3><div class=\"scroll\"><table><thead>{head}</thead><tbody>{rows}</tbody></table></div>\n")
}

/// The movements there are, in the thesis' order.
fn movements(outcome: &Outcome) -> Vec<&'static str> {
    let mut movements: Vec<&str> = outcome.scenarios.iter().map(|scenario| scenario.movement).collect();
    movements.dedup();
    movements
}

fn of_movement<'a>(outcome: &'a Outcome, movement: &'a str) -> impl Iterator<Item = &'static Scenario> + 'a {
    outcome.scenarios.iter().copied().filter(move |scenario| scenario.movement == movement)
}
