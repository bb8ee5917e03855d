//! Puts style, script and data into the page.

use super::data::{Report, Summary};
use crate::page::{
    CHART_SCRIPT, CLOCK_SCRIPT, DATA_SCRIPT, DRAWING_SCRIPT, NETWORK_SCRIPT, STAGE_SCRIPT, STYLE, TERRAIN_SCRIPT, data,
    escaped, filled, policy, script,
};

const PAGE: &str = include_str!("assets/page.html");
const SCRIPTS: &[&str] = &[
    DATA_SCRIPT,
    CLOCK_SCRIPT,
    TERRAIN_SCRIPT,
    STAGE_SCRIPT,
    DRAWING_SCRIPT,
    include_str!("assets/replay.js"),
    CHART_SCRIPT,
    include_str!("assets/statistics.js"),
    include_str!("assets/species.js"),
    include_str!("assets/strip.js"),
    include_str!("assets/front.js"),
    NETWORK_SCRIPT,
    include_str!("assets/gait.js"),
    include_str!("assets/stages.js"),
    include_str!("assets/page.js"),
];

/// How the page says where the run stood that it shows.
pub(super) fn state(generations: u64, has_ended: bool) -> String {
    format!("{generations} generations, {}", if has_ended { "ended" } else { "under way" })
}

fn state_of(report: &Report) -> String {
    let state = |summary: &Summary| state(summary.generations, summary.stopped_because.is_some());
    report.summary.as_ref().map_or_else(String::new, state)
}

/// Whether a page shows a run in this state; `beginning` is the page's first lines.
pub(super) fn shows(beginning: &str, state: &str) -> bool {
    beginning.contains(&format!("<meta name=\"gambol-run\" content=\"{state}\">"))
}

/// The finished page.
pub(super) fn render(report: &Report) -> String {
    let script = script(SCRIPTS);
    let values = [
        ("{{STATE}}", state_of(report)),
        ("{{POLICY}}", policy(STYLE, &script)),
        ("{{TITLE}}", escaped(&report.title)),
        ("{{STYLE}}", STYLE.to_owned()),
        ("{{SCRIPT}}", script),
        ("{{DATA}}", data(report)),
    ];
    filled(PAGE, &values)
}
