//! The page: one HTML file that works offline, in the look of the [report](gambol_reports::report) of a run.

use super::Analysis;
use gambol_reports::page::{CHART_SCRIPT, DATA_SCRIPT, STYLE, data, filled, policy, script};

const PAGE: &str = include_str!("assets/page.html");
const STYLES: &[&str] = &[STYLE, include_str!("assets/style.css")];
const SCRIPTS: &[&str] = &[
    DATA_SCRIPT,
    CHART_SCRIPT,
    include_str!("assets/tables.js"),
    include_str!("assets/lines.js"),
    include_str!("assets/rows.js"),
    include_str!("assets/page.js"),
];

/// The finished page.
pub(super) fn render(analysis: &Analysis) -> String {
    let (style, script) = (STYLES.join("\n"), script(SCRIPTS));
    let values = [
        ("{{POLICY}}", policy(&style, &script)),
        ("{{STYLE}}", style),
        ("{{SCRIPT}}", script),
        ("{{DATA}}", data(analysis)),
    ];
    filled(PAGE, &values)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{
        analyse,
        testing::{clear_and_open, comparison},
    };
    use serde_json::Value;

    /// The data in a page.
    fn data(page: &str) -> Value {
        let (_, rest) = page.split_once(r#"<script type="application/json" id="run">"#).expect("a place for data");
        let (data, _) = rest.split_once("</script>").expect("its end");
        serde_json::from_str(data).expect("JSON")
    }

    #[test]
    fn stands_alone_and_holds_the_analysis() {
        let (plan, results) = clear_and_open();
        let analysis = analyse(&plan, &results);
        let page = render(&analysis);
        // The name of SVG looks like an address, but is never fetched.
        let text = page.replace("http://www.w3.org/2000/svg", "");
        for reference in ["http:", "https:", "=\"//", "src=", "@import", "url(/", "url(\"", "fetch(", "{{"] {
            assert!(!text.contains(reference), "the page has a reference: {reference}");
        }
        let data = data(&page);
        assert_eq!(data, serde_json::to_value(&analysis).expect("serialises"));
        assert_eq!(data["at_equal_evaluations"]["scenarios"][0]["pairs"][0]["better"], 0);
        assert_eq!(data["primary"], "evaluations");
    }

    #[test]
    fn places_that_the_script_looks_up_are_there() {
        let script = SCRIPTS[SCRIPTS.len() - 1];
        for lookup in script.split("getElementById(").skip(1) {
            let (name, _) = lookup.split_once(')').expect("the end of the name");
            assert!(PAGE.contains(&format!("id={name}")), "{name}");
        }
    }

    #[test]
    fn names_cannot_break_the_page() {
        let sly = "</script><script src=\"https://evil\">{{DATA}}";
        let (plan, results) = comparison(&[sly], &[sly], 2, |_, _, seed| seed as f64);
        let page = render(&analyse(&plan, &results));
        assert!(!page.contains("<script src"), "the name became a script");
        assert_eq!(data(&page)["methods"][0]["name"], sly);
    }
}
