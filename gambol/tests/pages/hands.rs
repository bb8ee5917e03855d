//! What a person does in the studio, again and again.

use crate::{browser::Browser, home::Studio};
use serde_json::Value;
use std::{
    thread,
    time::{Duration, Instant},
};

/// How long a chapter may take for anything.
pub(crate) const PATIENCE: Duration = Duration::from_secs(90);

/// Waits until an expression is true.
#[track_caller]
pub(crate) fn wait(browser: &mut Browser, what: &str, expression: &str) {
    let since = Instant::now();
    while browser.evaluate(expression) != true {
        if since.elapsed() > PATIENCE {
            let says = browser.evaluate("document.body.innerText");
            panic!("{what} never came; the page says: {says}\n{:?}", browser.complaints());
        }
        thread::sleep(Duration::from_millis(50));
    }
}

pub(crate) fn text(browser: &mut Browser, id: &str) -> String {
    browser.evaluate(&format!("document.getElementById('{id}').textContent")).as_str().unwrap_or_default().to_owned()
}

/// How often in a row an element must be found at the same place before it is pressed: a page that still loads moves what it has.
const RESTS: usize = 6;

/// Presses the middle of an element as a pointer would, once the element rests and nothing lies over it.
#[track_caller]
pub(crate) fn click(browser: &mut Browser, selector: &str) {
    let middle = format!(
        "(() => {{ const found = document.querySelector({selector:?}); found.scrollIntoView({{ block: 'center' }}); \
         const box = found.getBoundingClientRect(); \
         const at = [box.left + box.width / 2, box.top + box.height / 2]; \
         return [...at, found.contains(document.elementFromPoint(...at))]; }})()"
    );
    let since = Instant::now();
    let (mut place, mut rests) = (Value::Null, 0);
    while rests < RESTS {
        assert!(since.elapsed() < PATIENCE, "{selector} cannot be pressed: {place}");
        thread::sleep(Duration::from_millis(40));
        let now = browser.evaluate(&middle);
        rests = if now == place && now[2] == true { rests + 1 } else { 0 };
        place = now;
    }
    // A press that misses is told at once, not by what never comes.
    browser.evaluate(&format!(
        "(() => {{ window.pressed = null; \
         window.addEventListener('pointerdown', \
             event => {{ window.pressed = !!event.target.closest({selector:?}); }}, {{ capture: true, once: true }}); }})()"
    ));
    let at = |index: usize| place[index].as_f64().expect("a place");
    browser.click(at(0), at(1));
    assert_ne!(browser.evaluate("window.pressed"), false, "the press of {selector} missed");
}

/// Sets a field, and tells the page.
pub(crate) fn set(browser: &mut Browser, selector: &str, value: &str) {
    browser.evaluate(&format!(
        "(() => {{ const field = document.querySelector({selector:?}); field.value = {value:?}; \
         for (const kind of ['input', 'change']) field.dispatchEvent(new Event(kind, {{ bubbles: true }})); }})()"
    ));
}

/// Neither errors nor requests to anybody else.
#[track_caller]
pub(crate) fn is_clean(browser: &Browser, studio: &Studio) {
    assert_eq!(browser.complaints(), [""; 0], "errors");
    let elsewhere: Vec<String> = browser.requests(&studio.url);
    let elsewhere =
        elsewhere.iter().filter(|address| !address.starts_with(studio.origin()) && !address.starts_with("blob:"));
    assert_eq!(elsewhere.count(), 0, "requests to others");
}

/// A short training, begun by pointing.
pub(crate) fn train(browser: &mut Browser, creature: &str, movement: &str, generations: u32) {
    click(browser, "[data-chapter=choose]");
    wait(browser, "the creatures", "document.querySelectorAll('#choose-creature label').length > 6");
    browser.evaluate(&format!("document.querySelector('#choose-creature input[value={creature:?}]').click()"));
    browser.evaluate(&format!("document.querySelector('#choose-movement input[value={movement:?}]').click()"));
    set(browser, "#choose-generations", &generations.to_string());
    wait(
        browser,
        "the command",
        &format!(
            "[{creature:?}, {movement:?}, '--generations {generations}'].every(word => \
             document.getElementById('choose-command').textContent.includes(word))"
        ),
    );
    click(browser, "#choose-train");
    let ended = format!(
        "/the generations were done · generation {generations} /.test(document.getElementById('run-state').textContent) \
         && document.getElementById('run-command').textContent === document.getElementById('choose-command').textContent"
    );
    wait(browser, "the end", &ended);
}

/// Drops a file on the page.
pub(crate) fn drop_file(browser: &mut Browser, name: &str, text: &str) {
    browser.evaluate(&format!(
        "(() => {{ const data = new DataTransfer(); data.items.add(new File([{}], {name:?})); \
         document.dispatchEvent(new DragEvent('drop', {{ dataTransfer: data, cancelable: true }})); }})()",
        Value::from(text)
    ));
}

/// The generation that is told in the line of a run's state.
pub(crate) fn generation(browser: &mut Browser) -> u32 {
    let state = text(browser, "run-state");
    let digits = state.split("generation ").nth(1).unwrap_or_default().chars().take_while(char::is_ascii_digit);
    digits.collect::<String>().parse().unwrap_or(0)
}

/// Opens a run from the gallery.
pub(crate) fn open(browser: &mut Browser, run: &str) {
    click(browser, "[data-chapter=keep]");
    let card = format!("#keep-runs button[data-run='{run}']");
    wait(browser, "its card", &format!("document.querySelector(\"{card}\") !== null"));
    click(browser, &card);
    wait(browser, "the run", &format!("document.getElementById('keep-title').textContent === '{run}'"));
}
