//! People who come to the studio with what they have: a keyboard, a touch screen, a name that is none.

use crate::{
    browser::{Browser, ENTER, ESCAPE, Key, TAB},
    hands::{click, drop_file, is_clean, set, text, train, wait},
    home::{Home, Studio},
};
use serde_json::{Value, json};
use std::{fs, path::Path, process::Command, thread, time::Duration};

pub(crate) fn tours(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    wait(browser, "the creatures", "document.querySelectorAll('#choose-creature label').length > 6");
    browser.evaluate("document.getElementById('tour').focus()");
    let is_open = "document.getElementById('tour-dialog').open";
    for step in 1..=5 {
        browser.press(ENTER);
        wait(
            browser,
            &format!("step {step}"),
            &format!("document.getElementById('tour-title').textContent.startsWith('{step} of 5: ')"),
        );
        assert_eq!(browser.evaluate(is_open), true);
        let title = text(browser, "tour-title");
        let chapter = browser.evaluate("document.querySelector('nav [aria-current]').textContent");
        assert!(
            title.ends_with(chapter.as_str().and_then(|name| name.split(' ').nth(1)).expect("a chapter")),
            "{title}, {chapter}"
        );
    }
    browser.press(ENTER);
    wait(browser, "its end", &format!("!{is_open}"));
    // One who has seen enough leaves by Escape; what has the focus is what it was opened with.
    browser.evaluate("document.getElementById('tour').focus()");
    browser.press(ENTER);
    wait(browser, "the tour", is_open);
    browser.press(ESCAPE);
    wait(browser, "its end", &format!("!{is_open}"));
    assert_eq!(browser.evaluate("document.activeElement.id"), "tour");
    is_clean(browser, &studio);
}

pub(crate) fn touches(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 360);
    wait(browser, "the creatures", "document.querySelectorAll('#choose-creature label').length > 6");
    drop_file(browser, "champion.json", &playing(folder));
    wait(
        browser,
        "the champion",
        "document.getElementById('run-state').textContent.startsWith('a champion of generation')",
    );
    touch(browser, "[data-chapter=play]");
    wait(
        browser,
        "that it does what it is told",
        "document.getElementById('play-hint').textContent.startsWith('Hold')",
    );
    let buttons = "[...document.querySelectorAll('#touch button')].filter(button => button.checkVisibility()).map(button => button.getAttribute('aria-label'))";
    assert_eq!(browser.evaluate(buttons), json!(["Backwards", "Forwards", "Jump"]));
    let told = "document.querySelector('#arena-readouts div:last-child dd').textContent";
    wait(browser, "that it is told to stand", &format!("/^0\\.0/.test({told})"));
    for (button, says) in [("Forwards", "^1\\.0"), ("Backwards", "^[-−]1\\.0"), ("Jump", "^↑")] {
        press(browser, &format!("#touch [aria-label={button}]"));
        wait(browser, &format!("{button}, as long as it is held"), &format!("/{says}/.test({told})"));
        browser.lift();
        wait(browser, "that it is told to stand again", &format!("/^0\\.0/.test({told})"));
    }
    let overhang = "document.documentElement.scrollWidth - document.documentElement.clientWidth";
    assert_eq!(browser.evaluate(overhang), 0, "wider than the screen");
    assert_eq!(browser.evaluate("document.getElementById('notice').hidden"), true);
    is_clean(browser, &studio);
}

/// A champion that was trained to be played with, for a moment.
fn playing(folder: &Path) -> String {
    let trained = Command::new(env!("CARGO_BIN_EXE_gambol"))
        .args(["train", "biped-1", "playing", "--generations", "2", "--population", "16", "--set", "stages=[]"])
        .args(["--quiet", "--no-report", "--out", "playing"])
        .current_dir(folder)
        .status()
        .expect("it runs");
    assert!(trained.success());
    fs::read_to_string(folder.join("playing/champion.json")).expect("a champion")
}

/// Puts a finger on the middle of an element.
fn press(browser: &mut Browser, selector: &str) {
    let middle = format!(
        "(() => {{ const found = document.querySelector({selector:?}); found.scrollIntoView({{ block: 'center' }}); \
         const box = found.getBoundingClientRect(); return [box.left + box.width / 2, box.top + box.height / 2]; }})()"
    );
    let place = browser.evaluate(&middle);
    browser.touch([0, 1].map(|axis| place[axis].as_f64().expect("a place")));
}

fn touch(browser: &mut Browser, selector: &str) {
    press(browser, selector);
    browser.lift();
}

/// What would run if it were not shown as text.
const SCRIPT: &str =
    "<img src=x onerror=\"document.body.dataset.harmed = 1\"><script>document.body.dataset.harmed = 1</script>";

pub(crate) fn shows_names(browser: &mut Browser, folder: &Path, home: &Home) {
    // A file name has no slash.
    let ground = "<img src=x onerror=document.body.dataset.harmed=1>";
    if *home == Home::Served {
        let terrain = json!({ "terrain": { "drawn": [{ "box": { "from": 1.0, "width": 0.3, "height": 0.1 } }] } });
        fs::create_dir_all(folder.join("runs/terrains")).expect("a folder");
        fs::write(folder.join(format!("runs/terrains/{ground}.json")), terrain.to_string()).expect("a file");
    }
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    train(browser, "biped-1", "running", 2);

    // A creature with hostile names, painted in hostile colours.
    let mut creature: Value = serde_json::to_value(creatures::find("biped-1").expect("it is shipped")).expect("JSON");
    creature["name"] = SCRIPT.into();
    creature["title"] = SCRIPT.into();
    creature["parts"][1]["name"] = SCRIPT.into();
    creature["parts"][1]["tag"] = SCRIPT.into();
    creature["parts"][1]["look"]["colour"] = SCRIPT.into();
    creature["parts"][1]["look"]["decorations"] = json!([
        { "form": { "ellipse": { "centre": [0, 0], "radii": [0.1, 0.1] } }, "fill": SCRIPT, "stroke": format!("red\"/>{SCRIPT}") },
        { "form": { (SCRIPT): { "centre": [0, 0] } }, "fill": "#112233" },
    ]);
    creature["joints"][0]["child"] = SCRIPT.into();
    creature["sensors"] = json!([{ "custom": { "name": SCRIPT } }, SCRIPT]);
    drop_file(browser, "creature.json", &creature.to_string());
    wait(browser, "the editor", "document.querySelector('#draw-editor .editor-problems li') !== null");
    browser.evaluate("document.querySelector('#draw-editor canvas').focus()");
    for _ in 0..2 {
        browser.press(TAB);
    }
    wait(browser, "its decorations", "document.querySelectorAll('#draw-editor .editor-decoration').length === 2");
    assert!(text(browser, "draw-editor").contains(SCRIPT), "they are shown as text");
    for option in ["#editor-decoration-0", "#editor-decoration-1"] {
        click(browser, option);
        thread::sleep(Duration::from_millis(200));
    }

    // A ground of such a name, in the folder and in the field.
    click(browser, "#draw label:has([value=ground])");
    wait(browser, "the other editor", "document.querySelector('#draw-ground canvas') !== null");
    if *home == Home::Served {
        click(browser, &format!("#draw-ground button[aria-label='Open {ground}']"));
        assert!(text(browser, "play-terrain").contains(ground), "it is shown as text");
    } else {
        browser.evaluate("document.querySelector('#draw-ground canvas').focus()");
        browser.press(Key("b", "KeyB", 66));
        browser.press(ENTER);
    }
    wait(browser, "an obstacle", "document.querySelectorAll('#draw-ground .terrain-list li').length > 0");
    set(browser, "#draw-ground .terrain-fields input[type=text]", SCRIPT);
    browser.evaluate(
        "[...document.querySelectorAll('#draw-ground button')].find(button => button.title.startsWith('Keep')).click()",
    );
    wait(
        browser,
        "that it is not kept",
        "document.querySelector('#draw-ground .editor-hint').textContent.startsWith('Not kept: ')",
    );
    for chapter in ["choose", "play", "keep", "watch"] {
        click(browser, &format!("[data-chapter={chapter}]"));
        thread::sleep(Duration::from_millis(200));
    }
    assert_eq!(browser.evaluate("document.body.dataset.harmed ?? null"), Value::Null);
    is_clean(browser, &studio);
}
