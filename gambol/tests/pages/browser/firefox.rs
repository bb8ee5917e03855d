//! Firefox, by WebDriver BiDi.

use super::{DRAG, Drive, Key, Person, between, decoded, wire::Wire};
use serde_json::{Value, json};
use std::{
    fs,
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
    pub(super) fn start(program: &Path, person: Person) -> Self {
        let profile = tempfile::tempdir().expect("a folder");
        fs::write(profile.path().join("user.js"), preferences(person)).expect("a file");
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
        // The window it begins with never has the focus: fields in it do not notice that they are left.
        let window = ask("browsingContext.create", json!({ "type": "window" }));
        let context = window["context"].as_str().expect("a tab").to_owned();
        Self { process, wire, context, _profile: profile }
    }

    /// Does something in the tab.
    #[track_caller]
    fn call(&mut self, method: &str, mut parameters: Value) -> Value {
        parameters["context"] = self.context.as_str().into();
        self.wire.ask(json!({ "method": method, "params": parameters }))
    }

    fn act(&mut self, kind: &str, actions: Value) {
        self.act_with(json!({ "type": kind, "id": kind, "actions": actions }));
    }

    fn finger(&mut self, actions: Value) {
        let kind = json!({ "pointerType": "touch" });
        self.act_with(json!({ "type": "pointer", "id": "finger", "parameters": kind, "actions": actions }));
    }

    fn act_with(&mut self, source: Value) {
        self.call("input.performActions", json!({ "actions": [source] }));
    }
}

/// What a profile has for a person.
fn preferences(Person { wants_rest, likes_dark, touches }: Person) -> String {
    let mut preferences =
        vec![("ui.prefersReducedMotion", i32::from(wants_rest)), ("ui.systemUsesDarkTheme", i32::from(likes_dark))];
    if touches {
        // A coarse pointer that hovers over nothing; touch events.
        preferences.extend([("ui.primaryPointerCapabilities", 1), ("ui.allPointerCapabilities", 1)]);
        preferences.push(("dom.w3c_touch_events.enabled", 1));
    }
    preferences.iter().map(|(name, value)| format!("user_pref(\"{name}\", {value});\n")).collect()
}

fn press() -> Value {
    json!({ "type": "pointerDown", "button": 0 })
}

fn release() -> Value {
    json!({ "type": "pointerUp", "button": 0 })
}

fn to(at: [f64; 2]) -> Value {
    json!({ "type": "pointerMove", "x": at[0].round(), "y": at[1].round() })
}

impl Drive for Firefox {
    fn visit(&mut self, address: &str, width: u32) {
        self.resize(width, 800);
        self.wire.events.clear();
        self.call("browsingContext.navigate", json!({ "url": address, "wait": "complete" }));
    }

    fn resize(&mut self, width: u32, height: u32) {
        self.call("browsingContext.setViewport", json!({ "viewport": { "width": width, "height": height } }));
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
            "Enter" => "\u{e007}",
            "Escape" => "\u{e00c}",
            other => other,
        };
        let actions = ["keyDown", "keyUp"].map(|kind| json!({ "type": kind, "value": value }));
        self.act("key", json!(actions));
    }

    fn write(&mut self, text: &str) {
        let keys =
            text.chars().flat_map(|letter| ["keyDown", "keyUp"].map(|kind| json!({ "type": kind, "value": letter })));
        let keys: Vec<Value> = keys.collect();
        self.act("key", json!(keys));
    }

    fn point(&mut self, x: f64, y: f64) {
        self.act("pointer", json!([to([x, y])]));
    }

    fn click(&mut self, x: f64, y: f64) {
        self.act("pointer", json!([to([x, y]), press(), release()]));
    }

    fn drag(&mut self, from: [f64; 2], there: [f64; 2]) {
        let moves = (1..=DRAG).map(|step| to(between(from, there, step)));
        let actions: Vec<Value> = [to(from), press()].into_iter().chain(moves).chain([release()]).collect();
        self.act("pointer", json!(actions));
    }

    fn touch(&mut self, at: [f64; 2]) {
        self.finger(json!([to(at), press()]));
    }

    fn lift(&mut self) {
        self.finger(json!([release()]));
    }

    fn picture(&mut self) -> Vec<u8> {
        decoded(&self.call("browsingContext.captureScreenshot", json!({})))
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
