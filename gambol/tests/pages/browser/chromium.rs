//! Chromium, by the DevTools protocol.

use super::{DRAG, Drive, Key, PATIENCE, Person, between, decoded, wire::Wire};
use serde_json::{Value, json};
use std::{
    path::Path,
    process::{Child, Command, Stdio},
    time::Instant,
};
use tempfile::TempDir;

/// It ends with this value.
pub(super) struct Chromium {
    process: Child,
    wire: Wire,
    /// Of the tab; none before it is there.
    session: Option<String>,
    person: Person,
    _profile: TempDir,
}

impl Drop for Chromium {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

impl Chromium {
    pub(super) fn start(program: &Path, person: Person) -> Self {
        let profile = tempfile::tempdir().expect("a folder");
        let mut process = Command::new(program)
            .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--remote-debugging-port=0"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap_or_else(|error| panic!("{}: {error}", program.display()));
        let wire = Wire::after("DevTools listening on ", "", process.stderr.take().expect("a pipe"));
        let mut browser = Self { process, wire, session: None, person, _profile: profile };
        browser.open_tab();
        browser
    }

    /// Lets the tab be as the person has it.
    fn emulate(&mut self) {
        let Person { wants_rest, likes_dark, touches } = self.person;
        let mut features = vec![
            json!({ "name": "prefers-reduced-motion", "value": if wants_rest { "reduce" } else { "no-preference" } }),
            json!({ "name": "prefers-color-scheme", "value": if likes_dark { "dark" } else { "light" } }),
        ];
        if touches {
            self.call("Emulation.setTouchEmulationEnabled", json!({ "enabled": true }));
            features.extend(
                [("hover", "none"), ("pointer", "coarse")].map(|(name, value)| json!({ "name": name, "value": value })),
            );
        }
        self.call("Emulation.setEmulatedMedia", json!({ "features": features }));
    }

    fn mouse(&mut self, kind: &str, [x, y]: [f64; 2], buttons: u32) {
        let how = json!({ "type": kind, "x": x, "y": y, "button": "left", "buttons": buttons, "clickCount": 1 });
        self.call("Input.dispatchMouseEvent", how);
    }

    #[track_caller]
    fn call(&mut self, method: &str, parameters: Value) -> Value {
        let mut message = json!({ "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = session.as_str().into();
        }
        self.wire.ask(message)
    }
}

impl Drive for Chromium {
    fn visit(&mut self, address: &str, width: u32) {
        self.resize(width, 800);
        self.wire.events.clear();
        self.call("Page.navigate", json!({ "url": address }));
        let since = Instant::now();
        while !self.wire.events.iter().any(|event| event["method"] == "Page.loadEventFired") {
            assert!(since.elapsed() < PATIENCE, "{address} is not loaded");
            self.wire.hear();
        }
    }

    fn resize(&mut self, width: u32, height: u32) {
        let touches = self.person.touches;
        let metrics = json!({ "width": width, "height": height, "deviceScaleFactor": 1, "mobile": touches });
        self.call("Emulation.setDeviceMetricsOverride", metrics);
    }

    fn open_tab(&mut self) -> Option<String> {
        let left = self.session.take();
        let target = self.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        self.session = self.call("Target.attachToTarget", attach)["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log", "Network"] {
            self.call(&format!("{domain}.enable"), json!({}));
        }
        self.emulate();
        left
    }

    fn go_to_tab(&mut self, tab: Option<String>) {
        self.session = tab;
        self.call("Page.bringToFront", json!({}));
    }

    #[track_caller]
    fn evaluate(&mut self, expression: &str) -> Value {
        let how = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = self.call("Runtime.evaluate", how);
        assert!(answer["exceptionDetails"].is_null(), "{expression}\n{}", answer["exceptionDetails"]);
        answer["result"]["value"].clone()
    }

    fn press(&mut self, Key(key, code, number): Key) {
        for kind in ["keyDown", "keyUp"] {
            let text = match key {
                "Enter" => "\r",
                _ if key.len() == 1 => key,
                _ => "",
            };
            let text = if kind == "keyDown" { text } else { "" };
            let how = json!({ "type": kind, "key": key, "code": code, "windowsVirtualKeyCode": number, "text": text });
            self.call("Input.dispatchKeyEvent", how);
        }
    }

    fn write(&mut self, text: &str) {
        for letter in text.chars() {
            self.call("Input.dispatchKeyEvent", json!({ "type": "keyDown", "key": letter, "text": letter }));
            self.call("Input.dispatchKeyEvent", json!({ "type": "keyUp", "key": letter }));
        }
    }

    fn point(&mut self, x: f64, y: f64) {
        self.mouse("mouseMoved", [x, y], 0);
    }

    fn click(&mut self, x: f64, y: f64) {
        self.mouse("mousePressed", [x, y], 1);
        self.mouse("mouseReleased", [x, y], 0);
    }

    fn drag(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.mouse("mouseMoved", from, 0);
        self.mouse("mousePressed", from, 1);
        for step in 1..=DRAG {
            self.mouse("mouseMoved", between(from, to, step), 1);
        }
        self.mouse("mouseReleased", to, 0);
    }

    fn touch(&mut self, [x, y]: [f64; 2]) {
        let finger = json!([{ "x": x, "y": y }]);
        self.call("Input.dispatchTouchEvent", json!({ "type": "touchStart", "touchPoints": finger }));
    }

    fn lift(&mut self) {
        self.call("Input.dispatchTouchEvent", json!({ "type": "touchEnd", "touchPoints": [] }));
    }

    fn picture(&mut self) -> Vec<u8> {
        decoded(&self.call("Page.captureScreenshot", json!({ "format": "png" })))
    }

    fn complaints(&self) -> Vec<String> {
        let complaint = |event: &Value| match event["method"].as_str()? {
            "Runtime.exceptionThrown" => Some(event["params"]["exceptionDetails"].to_string()),
            "Runtime.consoleAPICalled" if event["params"]["type"] == "error" => {
                Some(event["params"]["args"].to_string())
            }
            "Log.entryAdded" if event["params"]["entry"]["level"] == "error" => {
                Some(event["params"]["entry"]["text"].to_string())
            }
            _ => None,
        };
        self.wire.events.iter().filter_map(complaint).collect()
    }

    fn addresses(&self) -> Vec<String> {
        let asked = self.wire.events.iter().filter(|event| event["method"] == "Network.requestWillBeSent");
        asked.filter_map(|event| event["params"]["request"]["url"].as_str()).map(str::to_owned).collect()
    }
}
