//! Chromium without a window, driven by the DevTools protocol.

use serde_json::{Value, json};
use std::{
    env,
    io::{BufRead, BufReader, ErrorKind},
    net::TcpStream,
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    time::{Duration, Instant},
};
use tempfile::TempDir;
use tungstenite::{Message, WebSocket, client, error::Error};

/// Programs that will do, by their names.
const NAMES: [&str; 4] = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
/// How long a page may take for anything.
const PATIENCE: Duration = Duration::from_secs(30);

/// A key that can be pressed: its name, its code, and the number that browsers know it by.
#[derive(Clone, Copy)]
pub(crate) struct Key(pub(crate) &'static str, pub(crate) &'static str, pub(crate) u32);

pub(crate) const TAB: Key = Key("Tab", "Tab", 9);
pub(crate) const SPACE: Key = Key(" ", "Space", 32);
pub(crate) const RIGHT: Key = Key("ArrowRight", "ArrowRight", 39);

/// A browser with one tab. It ends with this value.
pub(crate) struct Browser {
    process: Child,
    socket: WebSocket<TcpStream>,
    /// Of the tab; none before it is there.
    session: Option<String>,
    calls: u64,
    /// All that the tab has told unasked.
    events: Vec<Value>,
    _profile: TempDir,
}

impl Drop for Browser {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// The browser of this machine: what the variable CHROMIUM names, or one in the path.
pub(crate) fn find() -> Option<PathBuf> {
    if let Some(named) = env::var_os("CHROMIUM") {
        return Some(named.into());
    }
    let folders: Vec<PathBuf> = env::split_paths(&env::var_os("PATH")?).collect();
    NAMES.iter().find_map(|name| folders.iter().map(|folder| folder.join(name)).find(|path| path.is_file()))
}

impl Browser {
    pub(crate) fn start(program: &Path) -> Self {
        let profile = tempfile::tempdir().expect("a folder");
        let mut process = Command::new(program)
            .args(["--headless=new", "--no-sandbox", "--disable-gpu", "--no-first-run", "--remote-debugging-port=0"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .arg(format!("--user-data-dir={}", profile.path().display()))
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap_or_else(|error| panic!("{}: {error}", program.display()));
        let mut lines = BufReader::new(process.stderr.take().expect("a pipe")).lines();
        let address = loop {
            let line = lines.next().expect("a browser tells its address").expect("text");
            if let Some(address) = line.strip_prefix("DevTools listening on ") {
                break address.trim().to_owned();
            }
        };
        // Its other messages are read too, lest the pipe fill up.
        std::thread::spawn(move || lines.for_each(drop));
        let host = address.strip_prefix("ws://").and_then(|rest| rest.split('/').next()).expect("an address");
        let stream = TcpStream::connect(host).expect("it listens");
        let (socket, _) = client(&address, stream).expect("a web socket");
        socket.get_ref().set_read_timeout(Some(Duration::from_millis(50))).expect("a timeout");
        let mut browser = Self { process, socket, session: None, calls: 0, events: Vec::new(), _profile: profile };
        browser.open_tab();
        browser
    }

    /// Opens a file in a window of this width, px, and waits until it is loaded. What an earlier page told is forgotten.
    pub(crate) fn open(&mut self, page: &Path, width: u32) {
        self.visit(&format!("file://{}", page.display()), width);
    }

    /// The same with an address.
    pub(crate) fn visit(&mut self, address: &str, width: u32) {
        let metrics = json!({ "width": width, "height": 800, "deviceScaleFactor": 1, "mobile": false });
        self.call("Emulation.setDeviceMetricsOverride", metrics);
        self.events.clear();
        self.call("Page.navigate", json!({ "url": address }));
        let since = Instant::now();
        while !self.events.iter().any(|event| event["method"] == "Page.loadEventFired") {
            assert!(since.elapsed() < PATIENCE, "{address} is not loaded");
            self.hear();
        }
    }

    /// Opens another tab, and goes to it. The one that was left.
    pub(crate) fn open_tab(&mut self) -> Option<String> {
        let left = self.session.take();
        let target = self.call("Target.createTarget", json!({ "url": "about:blank" }));
        let attach = json!({ "targetId": target["targetId"], "flatten": true });
        self.session = self.call("Target.attachToTarget", attach)["sessionId"].as_str().map(str::to_owned);
        for domain in ["Page", "Runtime", "Log", "Network"] {
            self.call(&format!("{domain}.enable"), json!({}));
        }
        left
    }

    /// Goes back to a tab that was left.
    pub(crate) fn go_to_tab(&mut self, session: Option<String>) {
        self.session = session;
        self.call("Page.bringToFront", json!({}));
    }

    /// What an expression is worth in the page, a promise when it is kept.
    #[track_caller]
    pub(crate) fn evaluate(&mut self, expression: &str) -> Value {
        let how = json!({ "expression": expression, "awaitPromise": true, "returnByValue": true });
        let answer = self.call("Runtime.evaluate", how);
        assert!(answer["exceptionDetails"].is_null(), "{expression}\n{}", answer["exceptionDetails"]);
        answer["result"]["value"].clone()
    }

    pub(crate) fn press(&mut self, Key(key, code, number): Key) {
        for kind in ["keyDown", "keyUp"] {
            let text = if key.len() == 1 && kind == "keyDown" { key } else { "" };
            let how = json!({ "type": kind, "key": key, "code": code, "windowsVirtualKeyCode": number, "text": text });
            self.call("Input.dispatchKeyEvent", how);
        }
    }

    pub(crate) fn click(&mut self, x: f64, y: f64) {
        for kind in ["mousePressed", "mouseReleased"] {
            let how = json!({ "type": kind, "x": x, "y": y, "button": "left", "clickCount": 1 });
            self.call("Input.dispatchMouseEvent", how);
        }
    }

    /// Errors since the page was opened: exceptions, what was written to the console as an error, what was refused.
    pub(crate) fn complaints(&self) -> Vec<String> {
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
        self.events.iter().filter_map(complaint).collect()
    }

    /// What was asked for since the page was opened, but for the page and for data that stand in addresses.
    pub(crate) fn requests(&self, own: &str) -> Vec<String> {
        let asked = self.events.iter().filter(|event| event["method"] == "Network.requestWillBeSent");
        let addresses = asked.filter_map(|event| event["params"]["request"]["url"].as_str());
        addresses.filter(|address| *address != own && !address.starts_with("data:")).map(str::to_owned).collect()
    }

    fn call(&mut self, method: &str, parameters: Value) -> Value {
        self.calls += 1;
        let id = self.calls;
        let mut message = json!({ "id": id, "method": method, "params": parameters });
        if let Some(session) = &self.session {
            message["sessionId"] = session.as_str().into();
        }
        self.socket.send(Message::text(message.to_string())).expect("the browser listens");
        let since = Instant::now();
        loop {
            assert!(since.elapsed() < PATIENCE, "{method} takes too long");
            let Some(answer) = self.hear() else { continue };
            if answer["id"] == id {
                assert!(answer["error"].is_null(), "{method}: {}", answer["error"]);
                return answer["result"].clone();
            }
        }
    }

    /// The next answer, if there is one soon; events are kept.
    fn hear(&mut self) -> Option<Value> {
        let message = match self.socket.read() {
            Ok(message) => message,
            Err(Error::Io(error)) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::TimedOut) => {
                return None;
            }
            Err(error) => panic!("the browser: {error}"),
        };
        let value: Value = serde_json::from_str(message.to_text().ok()?).ok()?;
        if value["id"].is_null() {
            self.events.push(value);
            return None;
        }
        Some(value)
    }
}
