//! Firefox, by WebDriver BiDi.

use super::{Drive, Key, wire::Wire};
use serde_json::{Value, json};
use std::{
    path::Path,
    process::{Child, Command, Stdio},
};
use tempfile::TempDir;

/// It ends with this value.
pub(super) struct Firefox {
    process: Child,
    wire: Wire,
    /// The tab.
    context: String,
    _profile: TempDir,
}

impl Drop for Firefox {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Firefox {
    pub(super) fn start(program: &Path) -> Self {
        let profile = tempfile::tempdir().expect("a folder");
        let mut process = Command::new(program)
            .args(["--headless", "--no-remote", "--remote-debugging-port=0", "--profile"])
            .arg(profile.path())
            .arg("about:blank")
            .env("HOME", profile.path())
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap_or_else(|error| panic!("{}: {error}", program.display()));
        let output = process.stderr.take().expect("a pipe");
        let mut wire = Wire::after("WebDriver BiDi listening on ", "/session", output);
        let mut ask = |method: &str, parameters: Value| wire.ask(json!({ "method": method, "params": parameters }));
        ask("session.new", json!({ "capabilities": {} }));
        ask("session.subscribe", json!({ "events": ["log.entryAdded", "network.beforeRequestSent"] }));
        let tree = ask("browsingContext.getTree", json!({}));
        let context = tree["contexts"][0]["context"].as_str().expect("a tab").to_owned();
        Self { process, wire, context, _profile: profile }
    }

    /// Does something in the tab.
    #[track_caller]
    fn call(&mut self, method: &str, mut parameters: Value) -> Value {
        parameters["context"] = self.context.as_str().into();
        self.wire.ask(json!({ "method": method, "params": parameters }))
    }

    fn act(&mut self, kind: &str, actions: Value) {
        let source = json!({ "type": kind, "id": kind, "actions": actions });
        self.call("input.performActions", json!({ "actions": [source] }));
    }
}

impl Drive for Firefox {
    fn visit(&mut self, address: &str, width: u32) {
        self.call("browsingContext.setViewport", json!({ "viewport": { "width": width, "height": 800 } }));
        self.wire.events.clear();
        self.call("browsingContext.navigate", json!({ "url": address, "wait": "complete" }));
    }

    fn open_tab(&mut self) -> Option<String> {
        let created = self.wire.ask(json!({ "method": "browsingContext.create", "params": { "type": "tab" } }));
        let context = created["context"].as_str().expect("a tab").to_owned();
        Some(std::mem::replace(&mut self.context, context))
    }

    fn go_to_tab(&mut self, tab: Option<String>) {
        self.context = tab.expect("a tab that was left");
        self.call("browsingContext.activate", json!({}));
    }

    #[track_caller]
    fn evaluate(&mut self, expression: &str) -> Value {
        // As text: BiDi has an encoding of its own for values.
        let expression = format!("(async () => JSON.stringify(await ({expression})) ?? 'null')()");
        let target = json!({ "context": self.context });
        let how = json!({ "expression": expression, "target": target, "awaitPromise": true });
        let answer = self.wire.ask(json!({ "method": "script.evaluate", "params": how }));
        assert!(answer["type"] == "success", "{expression}\n{}", answer["exceptionDetails"]);
        let text = answer["result"]["value"].as_str().expect("text");
        serde_json::from_str(text).expect("JSON")
    }

    fn press(&mut self, Key(key, _, _): Key) {
        let value = match key {
            "Tab" => "\u{e004}",
            "ArrowRight" => "\u{e014}",
            other => other,
        };
        let actions = ["keyDown", "keyUp"].map(|kind| json!({ "type": kind, "value": value }));
        self.act("key", json!(actions));
    }

    fn click(&mut self, x: f64, y: f64) {
        let actions = json!([
            { "type": "pointerMove", "x": x.round(), "y": y.round() },
            { "type": "pointerDown", "button": 0 },
            { "type": "pointerUp", "button": 0 },
        ]);
        self.act("pointer", actions);
    }

    fn complaints(&self) -> Vec<String> {
        let entries = self.wire.events.iter().filter(|event| event["method"] == "log.entryAdded");
        let errors = entries.filter(|event| event["params"]["level"] == "error");
        errors.map(|event| event["params"]["text"].to_string()).collect()
    }

    fn addresses(&self) -> Vec<String> {
        let asked = self.wire.events.iter().filter(|event| event["method"] == "network.beforeRequestSent");
        asked.filter_map(|event| event["params"]["request"]["url"].as_str()).map(str::to_owned).collect()
    }
}
