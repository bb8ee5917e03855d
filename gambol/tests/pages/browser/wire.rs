//! Questions and answers over a web socket.

use super::PATIENCE;
use serde_json::Value;
use std::{
    io::{BufRead, BufReader, ErrorKind, Read},
    net::TcpStream,
    time::{Duration, Instant},
};
use tungstenite::{Message, WebSocket, client, error::Error};

/// A connection to a browser.
pub(super) struct Wire {
    socket: WebSocket<TcpStream>,
    calls: u64,
    /// All that the browser has told unasked.
    pub(super) events: Vec<Value>,
}

impl Wire {
    /// Over the address that a browser prints after these words, with a path behind it.
    pub(super) fn after(words: &str, path: &str, output: impl Read + Send + 'static) -> Self {
        let mut lines = BufReader::new(output).lines();
        let address = loop {
            let line = lines.next().expect("a browser tells its address").expect("text");
            if let Some(address) = line.strip_prefix(words) {
                break format!("{}{path}", address.trim());
            }
        };
        // Its other messages are read too, lest the pipe fill up.
        std::thread::spawn(move || lines.for_each(drop));
        let host = address.strip_prefix("ws://").and_then(|rest| rest.split('/').next()).expect("an address");
        let stream = TcpStream::connect(host).expect("it listens");
        let (socket, _) = client(&address, stream).expect("a web socket");
        socket.get_ref().set_read_timeout(Some(Duration::from_millis(50))).expect("a timeout");
        Self { socket, calls: 0, events: Vec::new() }
    }

    /// Sends a question, and waits for its answer.
    #[track_caller]
    pub(super) fn ask(&mut self, mut question: Value) -> Value {
        self.calls += 1;
        question["id"] = self.calls.into();
        self.socket.send(Message::text(question.to_string())).expect("the browser listens");
        let since = Instant::now();
        loop {
            assert!(since.elapsed() < PATIENCE, "{} takes too long", question["method"]);
            let Some(answer) = self.hear() else { continue };
            if answer["id"] == self.calls {
                assert!(answer["error"].is_null(), "{}: {answer}", question["method"]);
                return answer["result"].clone();
            }
        }
    }

    /// The next answer, if there is one soon; events are kept.
    pub(super) fn hear(&mut self) -> Option<Value> {
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
