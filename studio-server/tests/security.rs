//! Requests that are answered, and requests that are refused.

use std::{
    io::{Read, Write},
    net::TcpStream,
    path::Path,
    sync::{Arc, mpsc},
    thread,
};
use studio_server::Server;
use tungstenite::{Message, client::IntoClientRequest};

/// A studio that ends with this value.
struct Served {
    host: String,
    secret: String,
    stop: Option<mpsc::Sender<()>>,
    thread: Option<thread::JoinHandle<()>>,
}

impl Served {
    fn new(folder: &Path) -> Self {
        let library = Arc::new(studio_server::library(Default::default(), folder.join("runs"), 1));
        let server = Server::bind(library, 0).expect("a free port");
        let url = server.url();
        let mut pieces = url.strip_prefix("http://").expect("HTTP").split('/');
        let (host, secret) = (pieces.next().expect("a host").to_owned(), pieces.next().expect("a secret").to_owned());
        let (stop, stopped) = mpsc::channel();
        let serve = move || server.run(move || _ = stopped.recv()).expect("it serves");
        Self { host, secret, stop: Some(stop), thread: Some(thread::spawn(serve)) }
    }

    /// The status and the whole answer.
    fn get(&self, path: &str, headers: &[&str]) -> (u16, String) {
        let mut stream = TcpStream::connect(&self.host).expect("it listens");
        let mut request = format!("GET {path} HTTP/1.1\r\nConnection: close\r\n");
        if !headers.iter().any(|header| header.starts_with("Host:")) {
            request.push_str(&format!("Host: {}\r\n", self.host));
        }
        headers.iter().for_each(|header| request.push_str(&format!("{header}\r\n")));
        stream.write_all(format!("{request}\r\n").as_bytes()).expect("it reads");
        let mut answer = Vec::new();
        stream.read_to_end(&mut answer).expect("it answers");
        let answer = String::from_utf8_lossy(&answer).into_owned();
        let status = answer.split(' ').nth(1).and_then(|status| status.parse().ok()).expect("a status");
        (status, answer)
    }

    fn page(&self) -> String {
        format!("/{}/", self.secret)
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        drop(self.stop.take());
        if let Some(thread) = self.thread.take() {
            thread.join().expect("it ends");
        }
    }
}

#[test]
fn the_secret_opens_the_page_and_nothing_else_does() {
    let folder = tempfile::tempdir().expect("a folder");
    let served = Served::new(folder.path());
    assert!(served.host.starts_with("127.0.0.1:"));
    let (status, page) = served.get(&served.page(), &[]);
    assert_eq!(status, 200);
    assert!(page.contains("content-security-policy: default-src 'none'; script-src 'self'"), "{page}");
    assert!(!page.contains("unsafe-inline") && page.contains("x-content-type-options: nosniff"));
    for file in ["studio.js", "studio.css"] {
        assert_eq!(served.get(&format!("{}{file}", served.page()), &[]).0, 200, "{file}");
    }
    for path in ["/", "/studio.js", "//", "/0123456789abcdef0123456789abcdef/", "/socket", &served.page()[..20]] {
        let (status, answer) = served.get(path, &[]);
        assert!(status == 403 && !answer.contains(&served.secret), "{path}: {answer}");
    }
    assert_ne!(served.secret, Served::new(folder.path()).secret);
}

#[test]
fn names_that_lead_here_from_elsewhere_are_refused() {
    let folder = tempfile::tempdir().expect("a folder");
    let served = Served::new(folder.path());
    let port = served.host.split(':').nth(1).expect("a port");
    assert_eq!(served.get(&served.page(), &[&format!("Host: localhost:{port}")]).0, 200);
    for host in ["Host: evil.example", "Host: 127.0.0.1", "Host: 127.0.0.1.evil.example:80", "Host:"] {
        assert_ne!(served.get(&served.page(), &[host]).0, 200, "{host}");
    }
    let own = format!("Origin: http://{}", served.host);
    assert_eq!(served.get(&served.page(), &[&own]).0, 200);
    for origin in ["Origin: http://evil.example", "Origin: null", &format!("Origin: https://{}", served.host)] {
        assert_eq!(served.get(&served.page(), &[origin]).0, 403, "{origin}");
    }
}

#[test]
fn a_socket_tells_where_it_comes_from() {
    let folder = tempfile::tempdir().expect("a folder");
    let served = Served::new(folder.path());
    let connect = |origin: Option<String>| {
        let mut request =
            format!("ws://{}{}socket", served.host, served.page()).into_client_request().expect("a request");
        if let Some(origin) = origin {
            request.headers_mut().insert("origin", origin.parse().expect("a header"));
        }
        tungstenite::client(request, TcpStream::connect(&served.host).expect("it listens")).map_err(|_| ())
    };
    assert!(connect(None).is_err());
    assert!(connect(Some("http://evil.example".into())).is_err());
    let (mut socket, _) = connect(Some(format!("http://{}", served.host))).expect("the page itself");
    socket.send(Message::text(r#"{"do":"look"}"#)).expect("it listens");
    let catalogue = socket.read().expect("an answer");
    assert!(catalogue.to_text().expect("text").starts_with(r#"{"is":"catalogue""#));
    for nonsense in ["", "{", "[]", r#"{"do":null}"#, "\u{0}", r#"{"do":"show","who":"everyone"}"#] {
        socket.send(Message::text(nonsense)).expect("it listens");
        let answer = socket.read().expect("an answer");
        assert!(answer.to_text().expect("text").contains(r#""is":"refused""#), "{nonsense}: {answer}");
    }
    // A message that is too long ends the connection, and nothing else.
    let _ = socket.send(Message::text("x".repeat(17 << 20)));
    assert!((0..3).any(|_| socket.read().is_err()));
    assert_eq!(served.get(&served.page(), &[]).0, 200);
}

#[test]
fn no_address_leads_out_of_the_runs() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("report.html"), "secret").expect("a file");
    std::fs::write(folder.path().join("config.json"), "secret").expect("a file");
    let served = Served::new(folder.path());
    for run in ["..", "%2e%2e", "..%2f..%2fetc", "%2fetc", "nothing", "a%00b", "..%5c.."] {
        for file in ["report", "champion.json", "verify", "export/gif/0"] {
            let (status, answer) = served.get(&format!("{}runs/{run}/{file}", served.page()), &[]);
            assert!((400..500).contains(&status) && !answer.ends_with("secret"), "{run}/{file}: {answer}");
        }
    }
}

/// A run folder may be of somebody else, and the report in it anything.
#[test]
fn what_runs_in_a_report_is_kept_from_the_studio() {
    let folder = tempfile::tempdir().expect("a folder");
    let run = folder.path().join("runs/foreign");
    std::fs::create_dir_all(&run).expect("a folder");
    for (name, text) in [("config.json", "{}"), ("log.jsonl", ""), ("report.html", "<script>hostile()</script>")] {
        std::fs::write(run.join(name), text).expect("a file");
    }
    let served = Served::new(folder.path());
    let (status, answer) = served.get(&format!("{}runs/foreign/report", served.page()), &[]);
    assert_eq!(status, 200, "{answer}");
    let policy = answer.lines().find(|line| line.to_lowercase().starts_with("content-security-policy:"));
    let policy = policy.expect("a policy");
    assert!(policy.contains("sandbox allow-scripts") && !policy.contains("allow-same-origin"), "{policy}");
}
