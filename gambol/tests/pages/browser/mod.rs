//! Browsers without a window, driven as a person would use them.

mod chromium;
mod firefox;
mod wire;

use base64::prelude::{BASE64_STANDARD, Engine as _};
use serde_json::Value;
use std::{
    env,
    path::{Path, PathBuf},
    time::Duration,
};

/// How long a page may take for anything.
const PATIENCE: Duration = Duration::from_secs(30);

/// A key that can be pressed: its name, its code, and the number that browsers know it by.
#[derive(Clone, Copy)]
pub(crate) struct Key(pub(crate) &'static str, pub(crate) &'static str, pub(crate) u32);

pub(crate) const TAB: Key = Key("Tab", "Tab", 9);
pub(crate) const SPACE: Key = Key(" ", "Space", 32);
pub(crate) const RIGHT: Key = Key("ArrowRight", "ArrowRight", 39);
pub(crate) const ENTER: Key = Key("Enter", "Enter", 13);
pub(crate) const ESCAPE: Key = Key("Escape", "Escape", 27);

/// Which browser.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Chromium or Chrome, by the DevTools protocol.
    Chromium,
    /// Firefox, by WebDriver BiDi, which it speaks by itself.
    Firefox,
}

impl Kind {
    /// The variable that names it.
    pub(crate) const fn variable(self) -> &'static str {
        match self {
            Self::Chromium => "CHROMIUM",
            Self::Firefox => "FIREFOX",
        }
    }

    /// The browser of this machine: what the variable names, or one in the path.
    pub(crate) fn find(self) -> Option<PathBuf> {
        if let Some(named) = env::var_os(self.variable()) {
            return Some(named.into());
        }
        let names: &[&str] = match self {
            Self::Chromium => &["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"],
            Self::Firefox => &["firefox-esr", "firefox"],
        };
        let folders: Vec<PathBuf> = env::split_paths(&env::var_os("PATH")?).collect();
        names.iter().find_map(|name| folders.iter().map(|folder| folder.join(name)).find(|path| path.is_file()))
    }

    /// Starts it, with one tab, for a person. It ends with the value.
    pub(crate) fn start(self, program: &Path, person: Person) -> Box<Browser> {
        match self {
            Self::Chromium => Box::new(chromium::Chromium::start(program, person)),
            Self::Firefox => Box::new(firefox::Firefox::start(program, person)),
        }
    }
}

/// What the person at the browser has told it, or has it on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Person {
    /// Nothing shall move by itself.
    pub(crate) wants_rest: bool,
    /// Light on dark.
    pub(crate) likes_dark: bool,
    /// On a screen that is touched, without a pointer.
    pub(crate) touches: bool,
}

/// How many moves a drag has.
const DRAG: u32 = 8;

/// Where a drag is after one of its moves.
fn between(from: [f64; 2], to: [f64; 2], step: u32) -> [f64; 2] {
    let share = f64::from(step) / f64::from(DRAG);
    [0, 1].map(|axis| from[axis] + (to[axis] - from[axis]) * share)
}

/// The bytes of a picture that came as text.
fn decoded(answer: &Value) -> Vec<u8> {
    BASE64_STANDARD.decode(answer["data"].as_str().expect("a picture")).expect("base64")
}

/// A browser, whichever.
pub(crate) type Browser = dyn Drive;

/// What a browser can be made to do.
pub(crate) trait Drive {
    /// Opens an address in a window of this width, px, and waits until it is loaded. What an earlier page told is forgotten.
    fn visit(&mut self, address: &str, width: u32);

    /// The same with a file.
    fn open(&mut self, page: &Path, width: u32) {
        self.visit(&format!("file://{}", page.display()), width);
    }

    /// Makes the window that large, px.
    fn resize(&mut self, width: u32, height: u32);

    /// Opens another tab, and goes to it. The one that was left.
    fn open_tab(&mut self) -> Option<String>;

    /// Goes back to a tab that was left.
    fn go_to_tab(&mut self, tab: Option<String>);

    /// What an expression is worth in the page, a promise when it is kept.
    fn evaluate(&mut self, expression: &str) -> Value;

    /// Presses a key, and lets it go.
    fn press(&mut self, key: Key);

    /// Types a text into what has the focus, key by key.
    fn write(&mut self, text: &str);

    /// Moves the pointer to a place of the window, px.
    fn point(&mut self, x: f64, y: f64);

    /// Clicks at a place of the window, px.
    fn click(&mut self, x: f64, y: f64);

    /// Presses at a place, moves to another, and lets go there.
    fn drag(&mut self, from: [f64; 2], to: [f64; 2]);

    /// Puts a finger on a place of the window, px.
    fn touch(&mut self, at: [f64; 2]);

    /// Takes the finger away.
    fn lift(&mut self);

    /// What can be seen in the window, as a PNG file.
    fn picture(&mut self) -> Vec<u8>;

    /// Errors since the page was opened: exceptions, what was written to the console as an error, what was refused.
    fn complaints(&self) -> Vec<String>;

    /// All addresses that were asked for since the page was opened.
    fn addresses(&self) -> Vec<String>;

    /// What was asked for since the page was opened, but for the page and for data that stand in addresses.
    fn requests(&self, own: &str) -> Vec<String> {
        self.addresses().into_iter().filter(|address| address != own && !address.starts_with("data:")).collect()
    }
}
