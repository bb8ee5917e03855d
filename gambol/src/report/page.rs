//! Puts style, script and data into the page.

use super::data::Report;

const PAGE: &str = include_str!("assets/page.html");
const STYLE: &str = include_str!("assets/style.css");
const SCRIPTS: &[&str] = &[
    include_str!("assets/data.js"),
    include_str!("assets/clock.js"),
    include_str!("assets/terrain.js"),
    include_str!("assets/stage.js"),
    include_str!("assets/drawing.js"),
    include_str!("assets/replay.js"),
    include_str!("assets/chart.js"),
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
    // Plain data: serialising cannot fail; were it to, the page would say that it has no data.
    let data = serde_json::to_string(report).unwrap_or_else(|_| "null".into());
    let script = format!("(() => {{\n\"use strict\";\n{}\n}})();", SCRIPTS.join("\n"));
    // `<` as an escape, so that no text in the data can end the script element.
    let values = [
        ("{{TITLE}}", escaped(&report.title)),
        ("{{STYLE}}", STYLE.to_owned()),
        ("{{SCRIPT}}", script),
        ("{{DATA}}", data.replace('<', "\\u003c")),
    ];
    filled(PAGE, &values)
}

/// Replaces each placeholder in one pass, so that a value which looks like a placeholder stays as it is.
fn filled(template: &str, values: &[(&str, String)]) -> String {
    let mut page = String::new();
    let mut rest = template;
    while let Some(start) = rest.find("{{") {
        page.push_str(&rest[..start]);
        rest = &rest[start..];
        match values.iter().find(|(placeholder, _)| rest.starts_with(placeholder)) {
            Some((placeholder, value)) => {
                page.push_str(value);
                rest = &rest[placeholder.len()..];
            }
            None => {
                page.push_str("{{");
                rest = &rest[2..];
            }
        }
    }
    page + rest
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_that_look_like_placeholders_stay() {
        let values = [("{{A}}", "{{B}}".to_owned()), ("{{B}}", "b".to_owned())];
        assert_eq!(filled("<{{A}}|{{B}}|{{C}}>", &values), "<{{B}}|b|{{C}}>");
    }

    #[test]
    fn titles_are_escaped() {
        assert_eq!(escaped("<b> & \"c\""), "&lt;b&gt; &amp; &quot;c&quot;");
    }
}
