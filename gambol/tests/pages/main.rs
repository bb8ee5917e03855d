//! Every kind of page, opened in a real browser.
//!
//! Needs Chromium (or Chrome) in the path, or the variable CHROMIUM; without it the tests are skipped, and say so. The studio is opened in
//! Firefox as well, if that is in the path, or the variable FIREFOX names it.

mod browser;
mod hands;
mod home;
mod kinds;
mod likeness;
mod newcomer;
mod pictures;
mod studio;
mod studio_ground;
mod studio_people;
mod studio_runs;

use browser::{Browser, Kind as BrowserKind, Person, RIGHT, SPACE, TAB};
use home::Home;
use kinds::{KINDS, Kind};
use libtest_mimic::{Arguments, Failed, Trial};
use serde_json::Value;
use std::{collections::BTreeSet, path::Path, process::ExitCode};

/// Widths of a phone and of a desk, px.
const WIDTHS: [u32; 2] = [360, 1280];

#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let chromium = BrowserKind::Chromium.find();
    if chromium.is_none() {
        println!("skipped, for there is no Chromium here: install it, or set CHROMIUM to its path, and call");
        println!("    cargo test -p gambol --test pages");
    }
    let ignored = chromium.is_none();
    let program = chromium.clone().unwrap_or_default();
    let trial = |name: String, check: fn(&mut Browser, &Path, &Kind), kind: &'static Kind| {
        let program = program.clone();
        let run = move || -> Result<(), Failed> {
            let folder = tempfile::tempdir()?;
            let page = (kind.make)(folder.path());
            check(&mut *BrowserKind::Chromium.start(&program, Person::default()), &page, kind);
            Ok(())
        };
        Trial::test(name, run).with_ignored_flag(ignored)
    };
    let every = KINDS.iter().map(|kind| trial(format!("the page of a {}", kind.name), check_page, kind));
    static FRONT: Kind = Kind { name: "front", make: kinds::front, plays: true };
    static HOSTILE: Kind = Kind { name: "hostile creature", make: kinds::hostile, plays: true };
    let others = [
        trial("a click on a point of a front plays it".into(), check_front, &FRONT),
        trial("names of a creature run no script".into(), check_hostile, &HOSTILE),
    ];
    let looks = {
        let program = program.clone();
        let run = move || -> Result<(), Failed> {
            pictures::look_as_they_did(&program);
            Ok(())
        };
        Trial::test("the studio looks as it did", run).with_ignored_flag(ignored)
    };
    let told_apart = Trial::test("pictures of the studio are told apart", || {
        pictures::are_told_apart();
        Ok(())
    });
    let built = Home::built();
    if built.is_none() && !ignored {
        println!("the studio as a static page is not opened: docs/studio.md says how it is built; then set");
        println!("    GAMBOL_STUDIO_PAGE to its folder");
    }
    let firefox = BrowserKind::Firefox.find();
    if firefox.is_none() {
        println!("the studio is not opened in Firefox: there is none here; install it, or set FIREFOX to its path");
    }
    let studios = [(BrowserKind::Chromium, chromium), (BrowserKind::Firefox, firefox)];
    let homes = [Some(Home::Served), built];
    let studio = studios.iter().flat_map(|(kind, program)| {
        homes.iter().flatten().flat_map(move |home| chapters(*kind, program.as_deref(), home))
    });
    let all = every.chain(others).chain([looks, told_apart]).chain(studio).collect();
    libtest_mimic::run(&arguments, all).exit_code()
}

/// What is tried of the studio: a name, how, and by whom.
type Chapter = (&'static str, fn(&mut Browser, &Path, &Home), Person);

const ANYBODY: Person = Person { wants_rest: false, likes_dark: false, touches: false };

const EVERYWHERE: [Chapter; 21] = [
    ("begins with a biped that learns to run", studio::begins, ANYBODY),
    ("trains what is chosen", studio::chooses, ANYBODY),
    ("lets a champion be played with", studio::plays, ANYBODY),
    ("trains what is drawn", studio::draws, ANYBODY),
    ("keeps, verifies and exports", studio::keeps, ANYBODY),
    ("fits a phone and a wall, and names its controls", studio::fits, ANYBODY),
    ("trains what the command line trains", studio::repeats, ANYBODY),
    ("is the same in two tabs", studio::is_shared, ANYBODY),
    ("tells who was bred from whom", studio_runs::tells_parents, ANYBODY),
    ("shows two champions side by side", studio_runs::shows_two, ANYBODY),
    ("replays a champion in other worlds", studio_runs::replays_elsewhere, ANYBODY),
    ("has a gallery that moves", studio_runs::moves_pictures, ANYBODY),
    (
        "has a gallery that rests for who wants rest",
        studio_runs::keeps_pictures_still,
        Person { wants_rest: true, ..ANYBODY },
    ),
    ("removes runs for good", studio_runs::removes, ANYBODY),
    ("finds a run by its words, and the open one in its address", studio_runs::finds, ANYBODY),
    ("trains on a ground that is drawn", studio_ground::draws, ANYBODY),
    ("gives a tour by keyboard", studio_people::tours, ANYBODY),
    ("is played with by touch", studio_people::touches, Person { touches: true, ..ANYBODY }),
    ("shows names of parts, paint and grounds as they are", studio_people::shows_names, ANYBODY),
    ("lets a newcomer change the population", newcomer::changes_the_population, ANYBODY),
    ("lets a newcomer draw a tripod, train it, push it and export a GIF", newcomer::draws_a_tripod, ANYBODY),
];
const SERVED: [Chapter; 2] = [
    ("does nothing that a creature's name says", studio::hostile, ANYBODY),
    ("follows a run that another process trains", studio_runs::follows, ANYBODY),
];
const STATIC: [Chapter; 1] = [("lets runs and champions travel", studio::travels, ANYBODY)];

/// The chapters of the studio, in a browser and a home.
fn chapters(kind: BrowserKind, program: Option<&Path>, home: &Home) -> Vec<Trial> {
    let others: &[Chapter] = if *home == Home::Served { &SERVED } else { &STATIC };
    let chapters = EVERYWHERE.iter().chain(others).copied();
    let place = match home {
        Home::Served => "the studio",
        Home::Static(_) => "the studio as a static page",
    };
    let place = if kind == BrowserKind::Firefox { format!("{place}, in Firefox,") } else { place.to_owned() };
    let is_there = program.is_some();
    let program = program.unwrap_or(Path::new("")).to_owned();
    let trial = |(name, check, person): Chapter| {
        let (program, home) = (program.clone(), home.clone());
        let run = move || -> Result<(), Failed> {
            check(&mut *kind.start(&program, person), tempfile::tempdir()?.path(), &home);
            Ok(())
        };
        Trial::test(format!("{place} {name}"), run).with_ignored_flag(!is_there)
    };
    chapters.map(trial).collect()
}

/// What holds for every page.
fn check_page(browser: &mut Browser, page: &Path, kind: &Kind) {
    for width in WIDTHS {
        browser.open(page, width);
        assert_eq!(texts(&browser.evaluate(BLANK_CANVASES)), [""; 0], "canvases without a drawing, {width} px");
        assert_eq!(texts(&browser.evaluate(CROPPED_PICTURES)), [""; 0], "pictures that are cut off, {width} px");
        let overhang = "document.documentElement.scrollWidth - document.documentElement.clientWidth";
        assert_eq!(browser.evaluate(overhang), 0, "wider than {width} px");
        check_keyboard(browser);
        if kind.plays {
            check_replay(browser);
        }
        assert_eq!(browser.complaints(), [""; 0], "errors, {width} px");
        assert_eq!(browser.requests(&format!("file://{}", page.display())), [""; 0], "requests, {width} px");
    }
    let headings = browser.evaluate("[...document.querySelectorAll('h1')].map(heading => heading.textContent.trim())");
    assert!(texts(&headings).iter().any(|heading| !heading.is_empty()), "a page has a heading");
}

/// The replay plays, pauses, steps and is scrubbed.
fn check_replay(browser: &mut Browser) {
    browser.evaluate("document.getElementById('replay-canvas').scrollIntoView({ block: 'center' })");
    let seen = browser.evaluate(PLACES_WHILE_PLAYING);
    let seen: BTreeSet<&str> = seen.as_array().expect("a list").iter().filter_map(Value::as_str).collect();
    assert!(seen.len() >= 3, "it plays: {seen:?}");
    let label = "document.getElementById('replay-play').getAttribute('aria-label')";
    browser.evaluate("document.getElementById('replay-play').focus()");
    assert_eq!(browser.evaluate(label), "Pause");
    browser.press(SPACE);
    assert_eq!(browser.evaluate(label), "Play", "the space bar pauses");
    let place = "Number(document.getElementById('replay-scrub').value)";
    let rewind = "(() => { const scrub = document.getElementById('replay-scrub'); scrub.focus(); scrub.value = 0; \
                  scrub.dispatchEvent(new Event('input')); })()";
    browser.evaluate(rewind);
    browser.press(RIGHT);
    assert_eq!(browser.evaluate(place).as_f64(), Some(1.0), "an arrow key scrubs");
    browser.evaluate("document.activeElement.blur()");
    browser.press(RIGHT);
    let after = "new Promise(done => requestAnimationFrame(() => requestAnimationFrame(() => \
                 done(Number(document.getElementById('replay-scrub').value)))))";
    assert_eq!(browser.evaluate(after).as_f64(), Some(2.0), "an arrow key steps");
}

/// Everything that can be used is reached with the Tab key.
fn check_keyboard(browser: &mut Browser) {
    let wanted = browser.evaluate(USABLE);
    browser.evaluate("scrollTo(0, 0); document.activeElement.blur()");
    // What can be scrolled has the focus once as well.
    for _ in 0..2 * wanted.as_u64().unwrap_or(0) + 10 {
        browser.press(TAB);
        browser.evaluate("document.activeElement.dataset.reached = 1");
    }
    assert_eq!(texts(&browser.evaluate(UNREACHED)), [""; 0], "not reached with the keyboard");
}

fn check_front(browser: &mut Browser, page: &Path, _: &Kind) {
    browser.open(page, 1280);
    browser.evaluate("document.getElementById('front-chart').scrollIntoView({ block: 'center' })");
    let points = browser.evaluate("document.querySelectorAll('.front-point').length").as_u64().expect("a number");
    assert!(points >= 2, "a front of {points}");
    for index in [points - 1, 0] {
        let place = format!(
            "(() => {{ const box = document.querySelectorAll('.front-point')[{index}].getBoundingClientRect(); \
             return [box.x + box.width / 2, box.y + box.height / 2]; }})()"
        );
        let place = browser.evaluate(&place);
        browser.click(place[0].as_f64().expect("a number"), place[1].as_f64().expect("a number"));
        let chosen = browser.evaluate("document.getElementById('front-chart').getAttribute('aria-valuenow')");
        assert_eq!(chosen, (index + 1).to_string());
        let note = browser.evaluate("document.getElementById('front-note').textContent");
        assert!(note.as_str().is_some_and(|note| note.starts_with(&format!("Point {}", index + 1))), "{note}");
    }
    assert_eq!(browser.complaints(), [""; 0]);
}

fn check_hostile(browser: &mut Browser, page: &Path, _: &Kind) {
    browser.open(page, 1280);
    assert!(browser.evaluate("typeof window.hostile").as_str() == Some("undefined"), "a script of the creature ran");
    assert_eq!(browser.evaluate("document.querySelectorAll('img[src=x]').length"), 0);
    let heading = browser.evaluate("document.body.textContent.includes('window.hostile=1')");
    assert_eq!(heading, true, "the names are shown as they are");
    assert_eq!(browser.complaints(), [""; 0]);
    assert_eq!(browser.requests(&format!("file://{}", page.display())), [""; 0]);
    // Were one to slip in, the policy would stop it.
    browser.evaluate(
        "(() => { const script = document.createElement('script'); script.textContent = 'window.hostile=1'; \
         document.body.append(script); })()",
    );
    assert!(browser.evaluate("typeof window.hostile").as_str() == Some("undefined"), "the policy allows scripts");
}

fn texts(list: &Value) -> Vec<String> {
    let list = list.as_array().expect("a list");
    list.iter().map(|text| text.as_str().unwrap_or_default().to_owned()).collect()
}

/// Canvases that can be seen and stay of one colour for two seconds.
const BLANK_CANVASES: &str = r#"(async () => {
  const blank = [];
  for (const canvas of document.querySelectorAll("canvas")) {
    if (!canvas.offsetParent) continue;
    canvas.scrollIntoView({ block: "center" });
    let drawn = false;
    for (let tries = 0; tries < 40 && !drawn; tries += 1) {
      await new Promise(done => setTimeout(done, 50));
      if (!canvas.width || !canvas.height) continue;
      const pixels = new Uint32Array(canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.buffer);
      drawn = pixels.some(pixel => pixel !== pixels[0]);
    }
    if (!drawn) blank.push(canvas.id || canvas.parentElement.className);
  }
  return blank;
})()"#;

/// Pictures that are larger than what they stand in, or not there.
const CROPPED_PICTURES: &str = r#"(async () => {
  const cropped = [];
  for (const picture of document.querySelectorAll("img")) {
    if (!picture.checkVisibility()) continue;
    await picture.decode().catch(() => {});
    const { clientWidth, clientHeight } = picture.parentElement;
    const fits = picture.naturalWidth > 0 && picture.width <= clientWidth + 1 && picture.height <= clientHeight + 1;
    if (!fits) cropped.push(`${picture.alt}: ${picture.width} x ${picture.height} in ${clientWidth} x ${clientHeight}`);
  }
  return cropped;
})()"#;

/// Where the replay is, over a second.
const PLACES_WHILE_PLAYING: &str = r#"(async () => {
  const button = document.getElementById("replay-play");
  if (button.getAttribute("aria-label") !== "Pause") button.click();
  const places = [];
  for (let index = 0; index < 10; index += 1) {
    await new Promise(done => setTimeout(done, 100));
    places.push(document.getElementById("replay-scrub").value);
  }
  return places;
})()"#;

/// Marks what can be used; gives how much there is. Of radio buttons of one name the Tab key reaches one.
const USABLE: &str = r#"(() => {
  const groups = new Set();
  let count = 0;
  for (const item of document.querySelectorAll("a[href], button, input, select, summary, textarea, [tabindex='0']")) {
    if (item.disabled || !item.checkVisibility({ visibilityProperty: true })) continue;
    if (item.type === "radio") {
      if (groups.has(item.name)) continue;
      groups.add(item.name);
      item.dataset.group = item.name;
    }
    item.dataset.usable = 1;
    count += 1;
  }
  return count;
})()"#;

/// What was marked and had no focus, by what it is called.
const UNREACHED: &str = r#"[...document.querySelectorAll("[data-usable]")].filter(item => {
  if (item.dataset.reached) return false;
  const group = item.dataset.group;
  return !group || ![...document.getElementsByName(group)].some(other => other.dataset.reached);
}).map(item => item.id || item.getAttribute("aria-label") || item.textContent.trim().slice(0, 40) || item.outerHTML.slice(0, 80))"#;
