//! The functions that a worker calls, and the one by which it is called back.
//!
//! Text and bytes go through memory: what a worker says lies in the [`room`] that it asked for before.

#![allow(unsafe_code)]

use crate::{Helper, Host};
use ne_core::field_path;
use std::cell::RefCell;
use studio::{DownloadError, Reply};

thread_local! {
    static HOST: RefCell<Option<Host>> = const { RefCell::new(None) };
    static HELPER: RefCell<Helper> = RefCell::default();
    static ROOM: RefCell<Vec<u8>> = const { RefCell::new(Vec::new()) };
}

/// What is sent to a page.
#[repr(u32)]
enum Kind {
    /// A message, as text.
    Event = 0,
    /// What is to be seen, as numbers.
    Frame = 1,
    /// What was asked for by an address: first what it is, as JSON, then its bytes.
    About = 2,
    File = 3,
    /// For a helper: a piece that is to be evaluated.
    Errand = 4,
    /// From a helper: its evaluations.
    Found = 5,
}

#[link(wasm_import_module = "page")]
unsafe extern "C" {
    /// Bytes for a page; they lie there until this returns.
    fn send(page: u32, kind: u32, bytes: *const u8, length: usize);
}

fn send_to(page: u32, kind: Kind, bytes: &[u8]) {
    // SAFETY: the worker reads these bytes before it returns, and keeps none.
    unsafe { send(page, kind as u32, bytes.as_ptr(), bytes.len()) }
}

fn with_host<T>(act: impl FnOnce(&mut Host) -> T) -> T {
    HOST.with_borrow_mut(|host| act(host.get_or_insert_with(|| Host::new(Default::default(), "runs".into()))))
}

fn room_as_text() -> String {
    String::from_utf8_lossy(&ROOM.take()).into_owned()
}

fn send_all(page: u32, replies: Vec<Reply>) {
    for reply in replies {
        match reply {
            Reply::Frame(bytes) => send_to(page, Kind::Frame, &bytes),
            // What cannot be written is no message.
            Reply::Event(event) => send_to(page, Kind::Event, &serde_json::to_vec(&event).unwrap_or_default()),
        }
    }
}

/// Room for so many bytes, for the next call.
#[unsafe(no_mangle)]
pub extern "C" fn room(length: usize) -> *mut u8 {
    ROOM.with_borrow_mut(|room| {
        *room = vec![0; length];
        room.as_mut_ptr()
    })
}

/// A page comes.
#[unsafe(no_mangle)]
pub extern "C" fn join(page: u32, shows_scenes: u32) {
    with_host(|host| host.join(page, shows_scenes != 0));
}

/// A page goes.
#[unsafe(no_mangle)]
pub extern "C" fn leave(page: u32) {
    with_host(|host| host.leave(page));
}

/// A message of a page, in the room.
#[unsafe(no_mangle)]
pub extern "C" fn ask(page: u32) {
    let message = room_as_text();
    send_all(page, with_host(|host| host.answer(page, &message)));
}

/// What is new is sent to a page.
#[unsafe(no_mangle)]
pub extern "C" fn news(page: u32) {
    send_all(page, with_host(|host| host.news(page)));
}

/// The file at the address in the room.
#[unsafe(no_mangle)]
pub extern "C" fn get(page: u32) {
    let address = room_as_text();
    let (about, bytes) = match with_host(|host| host.download(&address)) {
        Ok(download) => (serde_json::json!({ "name": download.name, "media": download.media }), download.bytes),
        Err(error @ DownloadError::Missing(_)) => (serde_json::json!({ "missing": error.to_string() }), Vec::new()),
        Err(error) => (serde_json::json!({ "failed": error.to_string() }), Vec::new()),
    };
    send_to(page, Kind::About, about.to_string().as_bytes());
    send_to(page, Kind::File, &bytes);
}

/// A helper comes.
#[unsafe(no_mangle)]
pub extern "C" fn helper_comes(helper: u32) {
    with_host(|host| host.desk().welcome(helper));
    send_errands();
}

/// A helper goes.
#[unsafe(no_mangle)]
pub extern "C" fn helper_goes(helper: u32) {
    with_host(|host| host.desk().dismiss(helper));
}

/// What a helper has found, in the room.
#[unsafe(no_mangle)]
pub extern "C" fn helper_brings(helper: u32) {
    if let Ok(found) = field_path::from_slice(&ROOM.take()) {
        with_host(|host| host.desk().bring(helper, found));
    }
    send_errands();
}

fn send_errands() {
    while let Some((helper, errand)) = with_host(|host| host.desk().errand()) {
        send_to(helper, Kind::Errand, &serde_json::to_vec(&errand).unwrap_or_default());
    }
}

/// In a helper: an errand, in the room.
#[unsafe(no_mangle)]
pub extern "C" fn help() {
    let Ok(errand) = field_path::from_slice(&ROOM.take()) else { return };
    if let Some(found) = HELPER.with_borrow_mut(|helper| helper.run(errand)) {
        send_to(0, Kind::Found, &serde_json::to_vec(&found).unwrap_or_default());
    }
}

/// Does a bit of what there is to do. The milliseconds until there is more; below 0: nothing is to be done.
#[unsafe(no_mangle)]
pub extern "C" fn work() -> f64 {
    let wait = with_host(|host| host.work());
    send_errands();
    wait.map_or(-1.0, |wait| wait.as_secs_f64() * 1000.0)
}
