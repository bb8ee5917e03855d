//! What a person finds out about runs in the studio: where a creature comes from, how it compares with another, what it is worth
//! elsewhere; and how runs go away.

use crate::{
    browser::{Browser, Key},
    hands::{PATIENCE, click, generation, is_clean, open, set, text, train, wait},
    home::{Home, Studio},
};
use std::{
    fs,
    path::Path,
    process::{Child, Command},
    thread,
    time::{Duration, Instant},
};

const ONE: Key = Key("1", "Digit1", 49);
const FOUR: Key = Key("4", "Digit4", 52);
const BEFORE: Key = Key("[", "BracketLeft", 219);
const NEXT: Key = Key("]", "BracketRight", 221);

/// What an expression is worth, as a number.
fn number(browser: &mut Browser, expression: &str) -> f64 {
    browser.evaluate(&format!("Number({expression})")).as_f64().unwrap_or(f64::NAN)
}

fn is_true(browser: &mut Browser, expression: &str) -> bool {
    browser.evaluate(expression) == true
}

pub(crate) fn tells_parents(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    click(browser, "[data-chapter=choose]");
    wait(browser, "the strategies", "document.getElementById('choose-strategy')?.options.length > 5");
    set(browser, "#choose-strategy", "conventional");
    train(browser, "biped-1", "running", 6);
    let caption = "document.getElementById('arena-caption').textContent";
    wait(browser, "the last generation", &format!("{caption}.startsWith('generation 6,')"));

    // Families have colours, which can be taken away.
    assert!(is_true(browser, "document.getElementById('show-colours').checkVisibility()"), "there are families");
    let colours = "document.getElementById('show-colours').getAttribute('aria-pressed')";
    for pressed in ["false", "true"] {
        click(browser, "#show-colours");
        assert_eq!(browser.evaluate(colours), pressed);
    }

    // From one to the next, by pointer and by key.
    let at =
        |browser: &mut Browser, rank: u32| assert!(text(browser, "member-text").starts_with(&format!("№ {rank} of")));
    at(browser, 1);
    click(browser, "#member-after");
    at(browser, 2);
    browser.press(NEXT);
    at(browser, 3);
    browser.press(BEFORE);
    at(browser, 2);
    let mut looked_at = 0;
    while !text(browser, "member-text").contains("bred from № ") {
        browser.press(NEXT);
        looked_at += 1;
        assert!(looked_at < 200, "none is bred: {}", text(browser, "member-text"));
    }
    assert!(text(browser, "member-text").contains("of generation 5"), "{}", text(browser, "member-text"));
    click(browser, "#member-parents");
    wait(browser, "the family", &format!("{caption} === 'one of generation 6 and where it comes from'"));
    assert!(text(browser, "member-text").starts_with("The child, in its own colours"));
    click(browser, "#member-after");
    assert!(text(browser, "member-text").contains("arent"), "{}", text(browser, "member-text"));
    wait(browser, "a family that moves", "parseFloat(document.querySelector('#arena-readouts dd').textContent) > 0.3");
    click(browser, "#member-parents");
    wait(browser, "the whole generation", &format!("{caption}.startsWith('generation 6,')"));

    // One that is pinned stays, however far training has come.
    set(browser, "#show-speed", "10");
    set(browser, "#run-more", "5000");
    click(browser, "#run-go-on");
    wait(browser, "another generation", &format!("!{caption}.startsWith('generation 6,')"));
    click(browser, "#member-pin");
    // One that was asked for before comes first.
    thread::sleep(Duration::from_millis(500));
    let pinned = text(browser, "arena-caption");
    let (since, begun) = (Instant::now(), generation(browser));
    while since.elapsed() < Duration::from_secs(3) || generation(browser) < begun + 5 {
        assert_eq!(text(browser, "arena-caption"), pinned, "it stays");
        assert!(since.elapsed() < PATIENCE, "training goes on");
        thread::sleep(Duration::from_millis(50));
    }
    click(browser, "#member-pin");
    wait(browser, "the next generation", &format!("{caption} !== '{pinned}'"));
    click(browser, "#run-stop");
    wait(browser, "the end", "document.getElementById('run-state').textContent.includes('interrupted')");
    is_clean(browser, &studio);
}

pub(crate) fn shows_two(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    train(browser, "biped-1", "running", 12);
    train(browser, "tetrapod-1", "running", 8);
    wait(browser, "the other run", "document.querySelector('#show-beside option[value=biped-1-running]') !== null");
    set(browser, "#show-beside", "biped-1-running");
    let seconds = "parseFloat(document.querySelector('#beside-readouts dd').textContent)";
    let is_shown = "document.getElementById('beside-stage').checkVisibility()";
    wait(browser, "the other champion", is_shown);
    wait(browser, "that it moves", &format!("{seconds} > 0.5"));
    let before = browser.evaluate("document.getElementById('beside-readouts').textContent");
    wait(browser, "that it goes on", &format!("{seconds} > 1"));
    assert_ne!(browser.evaluate("document.getElementById('beside-readouts').textContent"), before);
    assert!(text(browser, "beside-caption").ends_with(" · running"), "{}", text(browser, "beside-caption"));
    let verdict = text(browser, "beside-verdict");
    assert!(["Usable", "Not usable yet"].contains(&&*verdict), "{verdict}");
    let reasons = browser.evaluate("document.querySelectorAll('#beside-against li').length");
    assert_eq!(reasons == 0, verdict == "Usable", "{reasons} reasons below");
    // Both begin again together.
    click(browser, "#show-again");
    wait(
        browser,
        "both from the start",
        &format!("{seconds} < 0.5 && parseFloat(document.querySelector('#arena-readouts dd').textContent) < 0.5"),
    );

    browser.press(FOUR);
    wait(browser, "the champion alone", &format!("!({is_shown})"));
    wait(browser, "the champion", "document.getElementById('arena-caption').textContent.startsWith('the champion')");
    browser.press(ONE);
    wait(browser, "the other again", is_shown);
    wait(browser, "that it moves again", &format!("{seconds} > 0.5"));
    set(browser, "#show-beside", "");
    wait(browser, "nothing", &format!("!({is_shown})"));
    is_clean(browser, &studio);
}

pub(crate) fn replays_elsewhere(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    train(browser, "biped-1", "running", 40);
    click(browser, "[data-chapter=keep]");
    click(browser, "#keep-robust");
    let result = "document.getElementById('keep-result').textContent";
    wait(
        browser,
        "that it is under way",
        &format!("{result}.startsWith('Replayed in ') || {result}.startsWith('Usable in ')"),
    );
    wait(browser, "the result", &format!("/^Usable in \\d+\u{a0}% of 100 worlds/.test({result})"));
    let worlds = "[...document.querySelectorAll('#keep-robustness tr')].slice(1).reduce((sum, row) => sum + Number(row.cells[1].textContent), 0)";
    assert!(number(browser, worlds) >= 100.0, "each world has a cause: {}", text(browser, "keep-robustness"));
    // It stays while another chapter is open.
    browser.press(ONE);
    click(browser, "[data-chapter=keep]");
    thread::sleep(Duration::from_millis(300));
    assert!(text(browser, "keep-result").starts_with("Usable in "), "{}", text(browser, "keep-result"));
    is_clean(browser, &studio);
}

/// What the picture of the first run in the gallery looks like.
const PORTRAIT: &str = "document.querySelector('#keep-runs canvas').toDataURL()";

pub(crate) fn moves_pictures(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    train(browser, "biped-1", "running", 12);
    click(browser, "[data-chapter=keep]");
    wait(browser, "the gallery", "document.querySelectorAll('#keep-runs canvas').length === 1");
    for moment in ["first", "second", "third"] {
        let before = browser.evaluate(PORTRAIT).as_str().unwrap_or_default().to_owned();
        wait(browser, &format!("a {moment} move"), &format!("{PORTRAIT} !== {before:?}"));
    }
    is_clean(browser, &studio);
}

/// For somebody who wants rest, a picture moves only while it is pointed at or has the focus.
pub(crate) fn keeps_pictures_still(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    assert!(is_true(browser, "matchMedia('(prefers-reduced-motion: reduce)').matches"), "the browser was told");
    train(browser, "biped-1", "running", 12);
    click(browser, "[data-chapter=keep]");
    wait(browser, "the gallery", "document.querySelectorAll('#keep-runs canvas').length === 1");
    browser.point(1.0, 1.0);
    // Drawn, and the film there, if it were asked for.
    thread::sleep(Duration::from_secs(1));
    let before = browser.evaluate(PORTRAIT).as_str().unwrap_or_default().to_owned();
    let since = Instant::now();
    while since.elapsed() < Duration::from_secs(2) {
        assert!(is_true(browser, &format!("{PORTRAIT} === {before:?}")), "it moves");
    }
    browser.evaluate("document.querySelector('#keep-runs button').focus()");
    wait(browser, "a move while it has the focus", &format!("{PORTRAIT} !== {before:?}"));
    browser.evaluate("document.activeElement.blur()");
    wait(browser, "its first pose again", &format!("{PORTRAIT} === {before:?}"));
    is_clean(browser, &studio);
}

/// Removes something that was drawn, which is all there is of the kind, in the chapter *Keep*.
pub(crate) fn remove_drawn(browser: &mut Browser, studio: &Studio, name: &str, file: &str) {
    click(browser, "[data-chapter=keep]");
    let line = format!("#keep-drawn button[aria-label='Remove {name}']");
    wait(browser, "its line", &format!("document.querySelector(\"{line}\") !== null"));
    click(browser, &line);
    wait(browser, "the question", "document.getElementById('remove-dialog').open");
    assert_eq!(text(browser, "remove-title"), format!("Remove {name}?"));
    assert!(!studio.file(browser, file).is_empty());
    click(browser, "#remove-yes");
    wait(browser, "that nothing drawn is left", "document.getElementById('keep-drawn').hidden");
    let since = Instant::now();
    while !studio.file(browser, file).is_empty() {
        assert!(since.elapsed() < PATIENCE, "{file} is still there: {}", text(browser, "notice"));
        thread::sleep(Duration::from_millis(50));
    }
}

pub(crate) fn removes(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    train(browser, "biped-1", "running", 3);
    train(browser, "tetrapod-1", "running", 3);
    click(browser, "[data-chapter=keep]");
    let runs = |browser: &mut Browser| number(browser, "document.querySelectorAll('#keep-runs button').length");
    wait(browser, "both runs", "document.querySelectorAll('#keep-runs button').length === 2");
    let is_asked = "document.getElementById('remove-dialog').open";
    click(browser, "#keep-remove");
    wait(browser, "the question", is_asked);
    assert_eq!(text(browser, "remove-title"), "Remove tetrapod-1-running?");
    click(browser, "#remove-no");
    thread::sleep(Duration::from_millis(300));
    assert!(!is_true(browser, is_asked) && runs(browser) == 2.0, "it was kept");
    assert!(!studio.file(browser, "runs/tetrapod-1-running/config.json").is_empty());

    let remove = |browser: &mut Browser, run: &str| {
        click(browser, "#keep-remove");
        wait(browser, "the question", is_asked);
        click(browser, "#remove-yes");
        let since = Instant::now();
        for name in ["config.json", "log.jsonl", "champion.json"] {
            while !studio.file(browser, &format!("runs/{run}/{name}")).is_empty() {
                assert!(since.elapsed() < PATIENCE, "{name} of {run} is still there: {}", text(browser, "notice"));
                thread::sleep(Duration::from_millis(50));
            }
        }
        // The folder goes after its files.
        while *home == Home::Served && folder.join("runs").join(run).exists() {
            assert!(since.elapsed() < PATIENCE, "the folder of {run} is still there");
            thread::sleep(Duration::from_millis(50));
        }
    };
    remove(browser, "tetrapod-1-running");
    wait(browser, "the other run", "document.getElementById('keep-title').textContent === 'biped-1-running'");
    wait(browser, "that one alone", "document.querySelectorAll('#keep-runs button').length === 1");
    browser.press(ONE);
    wait(browser, "its name", "document.getElementById('arena-title').textContent.startsWith('The Gentleman')");
    wait(browser, "its generation", "document.getElementById('arena-caption').textContent.startsWith('generation 3,')");
    click(browser, "[data-chapter=keep]");
    if *home == Home::Served {
        // Somebody has been faster.
        fs::remove_dir_all(folder.join("runs/biped-1-running")).expect("it is there");
    }
    remove(browser, "biped-1-running");
    if *home == Home::Served {
        let notice = "document.querySelector('#notice p').textContent";
        wait(browser, "a notice", &format!("{notice} === 'there is no run \"biped-1-running\"'"));
        click(browser, "#notice button");
    }
    wait(browser, "that nothing is there", "document.getElementById('keep-empty').checkVisibility()");
    assert!(!is_true(browser, "document.getElementById('keep-open').checkVisibility()"), "nothing is open");
    browser.press(ONE);
    assert_eq!(text(browser, "arena-title"), "No run is open");
    assert_eq!(text(browser, "arena-caption"), "", "and nothing is shown");
    // And a new one begins.
    train(browser, "biped-1", "running", 2);
    assert_eq!(browser.evaluate("document.getElementById('notice').hidden"), true);
    is_clean(browser, &studio);
}

/// The names of the runs that the gallery shows.
const SHOWN: &str =
    "[...document.querySelectorAll('#keep-runs > li:not([hidden]) b')].map(name => name.textContent).join()";

pub(crate) fn finds(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    let gallery = |browser: &mut Browser, runs: u32| {
        click(browser, "[data-chapter=keep]");
        wait(browser, "the gallery", &format!("document.querySelectorAll('#keep-runs button').length === {runs}"));
    };
    for creature in ["biped-1", "tetrapod-1", "biped-2", "decapod-1"] {
        train(browser, creature, "running", 1);
    }
    gallery(browser, 4);
    let is_searched = "document.getElementById('keep-search').checkVisibility()";
    assert!(!is_true(browser, is_searched), "four are seen at a glance");
    train(browser, "tetrapod-2", "jumping", 1);
    gallery(browser, 5);
    assert!(is_true(browser, is_searched));
    for (words, shown) in [
        ("tetrapod", "tetrapod-2-jumping,tetrapod-1-running"),
        (" JUMP tetra", "tetrapod-2-jumping"),
        ("gallop", ""),
        ("decapod-1", "decapod-1-running"),
    ] {
        set(browser, "#keep-search", words);
        assert_eq!(browser.evaluate(SHOWN), shown, "{words}");
        assert_eq!(is_true(browser, "document.getElementById('keep-none').checkVisibility()"), shown.is_empty());
    }
    set(browser, "#keep-search", "");
    assert!(browser.evaluate(SHOWN).as_str().is_some_and(|shown| shown.split(',').count() == 5));

    // The page is loaded anew: what was open is, though others are later.
    let load_anew = |browser: &mut Browser, run: &str| {
        let address = browser.evaluate("location.href.split('#')[0]");
        let address = address.as_str().expect("an address").replace("tetrapod-1-running", run);
        browser.visit(&address, 1280);
    };
    open(browser, "tetrapod-1-running");
    load_anew(browser, "tetrapod-1-running");
    let is_open = |run: &str| format!("document.getElementById('keep-title').textContent === '{run}'");
    wait(browser, "the run", &is_open("tetrapod-1-running"));
    wait(browser, "its generation", "document.getElementById('arena-caption').textContent.startsWith('generation 1,')");
    gallery(browser, 5);
    wait(browser, "its exports", "document.querySelectorAll('#keep-exports button').length > 5");
    click(browser, "[data-chapter=watch]");
    let mut latest = "tetrapod-2-jumping";
    // In a browser, training ends with the page.
    if *home == Home::Served {
        latest = "tetrapod-1-running";
        set(browser, "#run-more", "5000");
        click(browser, "#run-go-on");
        wait(browser, "more", "/generation \\d\\d/.test(document.getElementById('run-state').textContent)");
        set(browser, "#run-pace", "shown");
        wait(browser, "the pause", "document.getElementById('run-state').textContent.includes('training waits')");
        load_anew(browser, "tetrapod-1-running");
        wait(browser, "the run", &is_open("tetrapod-1-running"));
        assert_eq!(browser.evaluate("document.getElementById('run-pace').value"), "shown");
        let before = generation(browser);
        wait(
            browser,
            "the next",
            &format!("document.getElementById('run-state').textContent.includes('generation {}')", before + 1),
        );
        click(browser, "#run-stop");
        wait(browser, "the end", "document.getElementById('run-state').textContent.includes('interrupted')");
    }
    // What the address names is not there: the latest is, and the page says so.
    load_anew(browser, "nothing");
    wait(browser, "the latest", &is_open(latest));
    // Also where the page begins with the gallery, which is there before.
    let address = browser.evaluate("location.href.split('?')[0] + '?run=nothing#/keep'");
    browser.visit(address.as_str().expect("an address"), 1280);
    wait(browser, "the latest", &is_open(latest));
    assert_eq!(browser.evaluate("document.querySelector('#notice p').textContent"), "there is no run \"nothing\"");
    wait(browser, "the gallery", "document.querySelectorAll('#keep-runs button').length === 5");
    is_clean(browser, &studio);
}

/// A process that ends with this value.
struct Elsewhere(Child);

impl Drop for Elsewhere {
    fn drop(&mut self) {
        // It may have ended by itself.
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A run that another process trains.
pub(crate) fn follows(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    let training = Command::new(env!("CARGO_BIN_EXE_gambol"))
        .args([
            "train",
            "biped-1",
            "running",
            "--generations",
            "100000",
            "--quiet",
            "--no-report",
            "--out",
            "runs/elsewhere",
        ])
        .current_dir(folder)
        .spawn()
        .expect("it runs");
    let _training = Elsewhere(training);
    let since = Instant::now();
    while !folder.join("runs/elsewhere/champion.json").exists() {
        assert!(since.elapsed() < PATIENCE, "it never begins");
        thread::sleep(Duration::from_millis(50));
    }
    browser.visit(&studio.url, 1280);
    open(browser, "elsewhere");
    wait(browser, "its chart", "document.querySelectorAll('#fitness-chart path').length > 1");
    wait(browser, "a creature of it", "document.getElementById('arena-caption').textContent.startsWith('generation ')");
    for _ in 0..3 {
        let before = generation(browser);
        wait(
            browser,
            "a later generation",
            &format!("/generation (\\d+)/.exec(document.getElementById('run-state').textContent)?.[1] > {before}"),
        );
    }
    assert_eq!(browser.evaluate("document.getElementById('notice').hidden"), true);
    is_clean(browser, &studio);
}
