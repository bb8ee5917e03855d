//! The two homes of the studio: served by the program, and a static page.

use crate::{browser::Browser, hands::PATIENCE};
use std::{
    env, fs,
    io::{BufRead, BufReader, Write},
    net::{TcpListener, TcpStream},
    path::{Path, PathBuf},
    process::{Child, Command, Stdio},
    thread,
    time::{Duration, Instant},
};

/// Where the studio lives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Home {
    /// Served by the program.
    Served,
    /// A static page, built into this folder.
    Static(PathBuf),
}

impl Home {
    /// The static page that the variable `GAMBOL_STUDIO_PAGE` names.
    pub(crate) fn built() -> Option<Self> {
        env::var_os("GAMBOL_STUDIO_PAGE").map(|folder| Self::Static(folder.into()))
    }
}

/// A studio over the runs in a folder, or of one browser; it ends with this value.
pub(crate) struct Studio {
    process: Option<Child>,
    folder: PathBuf,
    pub(crate) url: String,
}

impl Studio {
    /// `arguments`: as on the command line.
    pub(crate) fn start(home: &Home, folder: &Path, arguments: &[&str]) -> Self {
        match home {
            Home::Served => Self::served(folder, arguments),
            Home::Static(page) => {
                let query = arguments.first().map_or_else(String::new, |creature| format!("?creature={creature}"));
                Self { process: None, folder: folder.into(), url: format!("{}{query}", serve(page)) }
            }
        }
    }

    fn served(folder: &Path, arguments: &[&str]) -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_gambol"))
            .args(["studio", "--no-open", "--threads", "1"])
            .args(arguments)
            .current_dir(folder)
            .stdout(Stdio::piped())
            .spawn()
            .expect("the studio starts");
        let mut lines = BufReader::new(process.stdout.take().expect("a pipe")).lines();
        let first = lines.next().expect("it tells its address").expect("text");
        let url = first.strip_prefix("The studio is at ").expect("an address").to_owned();
        thread::spawn(move || lines.for_each(drop));
        Self { process: Some(process), folder: folder.into(), url }
    }

    pub(crate) fn origin(&self) -> &str {
        let end = self.url.match_indices('/').nth(2).map_or(self.url.len(), |(end, _)| end);
        &self.url[..end]
    }

    /// A file of the studio that there is to be. A browser keeps what is trained a moment after it tells of it.
    pub(crate) fn kept_file(&self, browser: &mut Browser, path: &str) -> Vec<u8> {
        let since = Instant::now();
        loop {
            let bytes = self.file(browser, path);
            if !bytes.is_empty() {
                return bytes;
            }
            assert!(since.elapsed() < PATIENCE, "there is no {path}");
            thread::sleep(Duration::from_millis(50));
        }
    }

    /// A file of the studio, such as *runs/biped-1-running/log.jsonl*; empty if there is none.
    pub(crate) fn file(&self, browser: &mut Browser, path: &str) -> Vec<u8> {
        if self.process.is_some() {
            return fs::read(self.folder.join(path)).unwrap_or_default();
        }
        let read = format!(
            r#"(async () => {{
              const done = request => new Promise((resolve, reject) => {{
                request.onsuccess = () => resolve(request.result);
                request.onerror = () => reject(request.error);
              }});
              const database = await done(indexedDB.open("gambol studio"));
              const record = await done(database.transaction("disk").objectStore("disk").get("/{path}"));
              database.close();
              return [...(record?.bytes || [])].map(byte => byte.toString(16).padStart(2, "0")).join("");
            }})()"#
        );
        let digits = browser.evaluate(&read);
        let digits = digits.as_str().expect("text").as_bytes();
        let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).expect("digits"), 16).expect("a byte");
        digits.chunks(2).map(byte).collect()
    }
}

impl Drop for Studio {
    fn drop(&mut self) {
        // It may have ended by itself.
        if let Some(process) = &mut self.process {
            let _ = process.kill();
            let _ = process.wait();
        }
    }
}

/// Serves the files in a folder from now on, at an address of its own: what one browser keeps is kept for its address.
fn serve(folder: &Path) -> String {
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    let address = format!("http://{}/", listener.local_addr().expect("an address"));
    let folder = folder.to_owned();
    thread::spawn(move || {
        for stream in listener.incoming().flatten() {
            let folder = folder.clone();
            thread::spawn(move || answer(stream, &folder));
        }
    });
    address
}

fn answer(mut stream: TcpStream, folder: &Path) {
    let mut lines = BufReader::new(&stream).lines().map_while(Result::ok);
    let first = lines.next().unwrap_or_default();
    lines.take_while(|line| !line.is_empty()).for_each(drop);
    let path = first.split(' ').nth(1).unwrap_or("/").split('?').next().unwrap_or("/");
    let name = if path == "/" { "index.html" } else { path.trim_start_matches('/') };
    let media = match name.rsplit('.').next() {
        Some("html") => "text/html",
        Some("css") => "text/css",
        Some("js") => "text/javascript",
        Some("wasm") => "application/wasm",
        _ => "application/octet-stream",
    };
    let (status, bytes) = match fs::read(folder.join(name)) {
        Ok(bytes) if !name.contains("..") => ("200 OK", bytes),
        _ => ("404 Not Found", Vec::new()),
    };
    let head = format!(
        "HTTP/1.1 {status}\r\nContent-Type: {media}\r\nContent-Length: {}\r\nConnection: close\r\n\r\n",
        bytes.len()
    );
    // A browser that has gone wants nothing more.
    let _ = stream.write_all(head.as_bytes()).and_then(|()| stream.write_all(&bytes));
}
