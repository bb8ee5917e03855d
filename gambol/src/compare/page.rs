//! The page: one HTML file that works offline, in the look of the [report](crate::report) of a run.

use super::Analysis;

const PAGE: &str = include_str!("assets/page.html");
const STYLES: &[&str] = &[include_str!("../report/assets/style.css"), include_str!("assets/style.css")];
const SCRIPTS: &[&str] = &[
    include_str!("../report/assets/data.js"),
    include_str!("../report/assets/chart.js"),
    include_str!("assets/tables.js"),
    include_str!("assets/lines.js"),
    include_str!("assets/rows.js"),
    include_str!("assets/page.js"),
];

/// The finished page.
pub(super) fn render(analysis: &Analysis) -> String {
    // Plain data: serialising cannot fail; were it to, the page would say that it has no data.
    let data = serde_json::to_string(analysis).unwrap_or_else(|_| "null".into());
    let script = format!("(() => {{\n\"use strict\";\n{}\n}})();", SCRIPTS.join("\n"));
    // The data comes last, so that what looks like a placeholder in it stays as it is. `<` is an escape there, so that no
    // text can end the script element.
    PAGE.replace("{{STYLE}}", &STYLES.join("\n"))
        .replace("{{SCRIPT}}", &script)
        .replace("{{DATA}}", &data.replace('<', "\\u003c"))
}
