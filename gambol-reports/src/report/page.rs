//! Puts style, script and data into the page.

use super::data::Report;
use crate::page::{CHART_SCRIPT, DATA_SCRIPT, STYLE, data, escaped, filled, policy, script};

const PAGE: &str = include_str!("assets/page.html");
const SCRIPTS: &[&str] = &[
    DATA_SCRIPT,
    include_str!("assets/clock.js"),
    include_str!("assets/terrain.js"),
    include_str!("assets/stage.js"),
    include_str!("assets/drawing.js"),
    include_str!("assets/replay.js"),
    CHART_SCRIPT,
    include_str!("assets/statistics.js"),
    include_str!("assets/species.js"),
    include_str!("assets/strip.js"),
    include_str!("assets/front.js"),
    include_str!("assets/network_layout.js"),
    include_str!("assets/network.js"),
    include_str!("assets/gait.js"),
    include_str!("assets/stages.js"),
    include_str!("assets/page.js"),
];

/// The finished page.
pub(super) fn render(report: &Report) -> String {
    let script = script(SCRIPTS);
    let values = [
        ("{{POLICY}}", policy(STYLE, &script)),
        ("{{TITLE}}", escaped(&report.title)),
        ("{{STYLE}}", STYLE.to_owned()),
        ("{{SCRIPT}}", script),
        ("{{DATA}}", data(report)),
    ];
    filled(PAGE, &values)
}
