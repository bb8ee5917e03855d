//! What all pages have in common: their look, their charts, and how data and text get into them.

pub mod ground;
pub mod network;

use base64::{Engine, engine::general_purpose::STANDARD};
use sha2::{Digest, Sha256};

/// The style of all pages.
pub const STYLE: &str = include_str!("assets/style.css");

/// The script that reads a page's data and formats numbers; first of all scripts.
pub const DATA_SCRIPT: &str = include_str!("assets/data.js");

/// The script of clocks, and of the one loop that draws.
pub const CLOCK_SCRIPT: &str = include_str!("assets/clock.js");

/// The script of ground that is not flat.
pub const TERRAIN_SCRIPT: &str = include_str!("assets/terrain.js");

/// The script of stages: camera and scenery.
pub const STAGE_SCRIPT: &str = include_str!("assets/stage.js");

/// The script that draws creatures.
pub const DRAWING_SCRIPT: &str = include_str!("assets/drawing.js");

/// The script of nets at work.
pub const NETWORK_SCRIPT: &str = concat!(include_str!("assets/network_layout.js"), include_str!("assets/network.js"));

/// The script of charts.
pub const CHART_SCRIPT: &str = include_str!("assets/chart.js");

/// Scripts as one, in a scope of their own.
pub fn script(parts: &[&str]) -> String {
    format!("(() => {{\n\"use strict\";\n{}\n}})();", parts.join("\n"))
}

/// The Content-Security-Policy of a page: a browser applies this style and runs this script, shows pictures that the page
/// itself has, and asks the network for nothing. `script`: empty if the page has none.
pub fn policy(style: &str, script: &str) -> String {
    let hash = |text: &str| format!("'sha256-{}'", STANDARD.encode(Sha256::digest(text)));
    let scripts = if script.is_empty() { "'none'".to_owned() } else { hash(script) };
    format!("default-src 'none'; style-src {}; script-src {scripts}; img-src data:", hash(style))
}

/// Data for a script element: `<` is an escape in it, so that no text can end the element.
pub fn data(data: &impl serde::Serialize) -> String {
    // Plain data: serialising cannot fail; were it to, the page would say that it has no data.
    serde_json::to_string(data).unwrap_or_else(|_| "null".into()).replace('<', "\\u003c")
}

/// Replaces each placeholder in one pass, so that a value which looks like a placeholder stays as it is.
pub fn filled(template: &str, values: &[(&str, String)]) -> String {
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

/// Text for the content or an attribute of an element.
pub fn escaped(text: &str) -> String {
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
    fn a_policy_names_what_is_there_by_its_hash() {
        // SHA-256 of nothing and of "abc", as FIPS 180 has them.
        let abc = "'sha256-ungWv48Bz+pBQUDeXa4iI7ADYaOWF3qctBD/YfIAFa0='";
        let (none, both) = (policy("abc", ""), policy("abc", "abc"));
        assert_eq!(none, format!("default-src 'none'; style-src {abc}; script-src 'none'; img-src data:"));
        assert_eq!(both, format!("default-src 'none'; style-src {abc}; script-src {abc}; img-src data:"));
    }

    #[test]
    fn titles_are_escaped() {
        assert_eq!(escaped("<b> & \"c\""), "&lt;b&gt; &amp; &quot;c&quot;");
    }
}
