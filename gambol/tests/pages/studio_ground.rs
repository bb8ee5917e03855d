//! A ground that is drawn in the studio: by pointer, trained on, opened again, played on.

use crate::{
    browser::Browser,
    hands::{click, is_clean, set, text, train, wait},
    home::{Home, Studio},
    studio_runs::remove_drawn,
};
use std::{fs, path::Path, process::Command};

const EDITOR: &str = "document.getElementById('draw-ground')";

/// Presses a button of the editor, by its word.
#[track_caller]
fn press(browser: &mut Browser, word: &str) {
    let mark = format!(
        "(() => {{ const all = [...{EDITOR}.querySelectorAll('button')]; \
         all.forEach(button => delete button.dataset.wanted); \
         const found = all.filter(button => (button.querySelector('.editor-word') ?? button).textContent.trim() === {word:?}); \
         found.forEach(button => {{ button.dataset.wanted = 1; }}); return found.length; }})()"
    );
    assert_eq!(browser.evaluate(&mark), 1, "buttons with the word {word}");
    click(browser, "#draw-ground [data-wanted]");
}

/// Draws from one place of the canvas to another, in shares of its width and height.
fn draw(browser: &mut Browser, from: [f64; 2], to: [f64; 2]) {
    let canvas = "(() => { const canvas = document.querySelector('#draw-ground canvas'); canvas.scrollIntoView({ block: 'center' }); \
                  const { left, top, width, height } = canvas.getBoundingClientRect(); return [left, top, width, height]; })()";
    let place = browser.evaluate(canvas);
    let [left, top, width, height] = [0, 1, 2, 3].map(|index| place[index].as_f64().expect("a number"));
    let at = |[x, y]: [f64; 2]| [left + x * width, top + y * height];
    browser.drag(at(from), at(to));
}

/// What lies on the ground, from left to right.
fn obstacles(browser: &mut Browser) -> Vec<String> {
    let list = browser.evaluate(&format!(
        "[...{EDITOR}.querySelector('.terrain-list').querySelectorAll('button')].map(button => button.textContent.split(' ')[0])"
    ));
    list.as_array().expect("a list").iter().map(|name| name.as_str().unwrap_or_default().to_owned()).collect()
}

fn open_editor(browser: &mut Browser) {
    click(browser, "[data-chapter=draw]");
    wait(browser, "the editors", "document.querySelector('.editor-canvas') !== null");
    click(browser, "#draw label:has([value=ground])");
    wait(browser, "that of grounds", &format!("{EDITOR}.querySelector('canvas')?.checkVisibility() === true"));
}

pub(crate) fn draws(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    // How long it is to be trained is chosen first.
    train(browser, "biped-1", "running", 6);
    open_editor(browser);
    // The ground begins at four fifths of the height.
    press(browser, "Box");
    draw(browser, [0.40, 0.80], [0.44, 0.77]);
    press(browser, "Gap");
    draw(browser, [0.52, 0.80], [0.55, 0.80]);
    press(browser, "Slope");
    draw(browser, [0.62, 0.80], [0.80, 0.72]);
    assert_eq!(obstacles(browser), ["Box", "Gap", "Slope"]);
    wait(
        browser,
        "no problem",
        &format!("{EDITOR}.querySelector('.editor-problems').textContent.includes('No problem')"),
    );
    set(browser, "#draw-ground .terrain-fields input[type=text]", "my hurdles");
    press(browser, "Keep");
    wait(browser, "that it is kept", &format!("{EDITOR}.textContent.includes('“my hurdles” is kept.')"));
    assert!(!studio.file(browser, "runs/terrains/my hurdles.json").is_empty());

    press(browser, "Train on it");
    let command = "document.getElementById('run-command').textContent";
    wait(browser, "a run on it", &format!("{command}.includes('--config')"));
    wait(browser, "its end", "document.getElementById('run-state').textContent.includes('done · generation 6 ')");
    is_what_its_command_trains(browser, folder, &studio);

    // The page is loaded anew: the ground is still drawn, and is opened again after another was begun.
    browser.visit(&studio.url, 1280);
    open_editor(browser);
    wait(browser, "what is kept", &format!("{EDITOR}.textContent.includes('my hurdles')"));
    assert_eq!(obstacles(browser), ["Box", "Gap", "Slope"]);
    press(browser, "New");
    assert_eq!(obstacles(browser), [""; 0]);
    click(browser, "#draw-ground button[aria-label='Open my hurdles']");
    assert_eq!(obstacles(browser), ["Box", "Gap", "Slope"]);
    // Without a run there is no champion to play on it.
    let run = "[data-run='biped-1-running-2']";
    click(browser, "[data-chapter=keep]");
    wait(browser, "the run", &format!("document.querySelector(\"{run}\") !== null"));
    click(browser, run);
    wait(browser, "a champion", "document.getElementById('arena-title').textContent.startsWith('The Gentleman')");
    click(browser, "[data-chapter=draw]");
    press(browser, "Play on it");
    wait(browser, "the champion", "document.getElementById('arena-caption').textContent.startsWith('the champion')");
    assert_eq!(browser.evaluate("document.getElementById('play-terrain').value"), "my hurdles");
    wait(browser, "that it moves", "parseFloat(document.querySelector('#arena-readouts dd').textContent) > 0.5");
    assert_eq!(browser.evaluate("document.getElementById('notice').hidden"), true);
    // It is removed, and nothing that could name it is left; the run on it stays.
    remove_drawn(browser, &studio, "my hurdles", "runs/terrains/my hurdles.json");
    for list in ["choose-terrain", "play-terrain"] {
        let named =
            format!("[...document.getElementById('{list}').options].some(({{ value }}) => value === 'my hurdles')");
        assert_eq!(browser.evaluate(&named), false, "{list} still offers it");
        assert_eq!(browser.evaluate(&format!("document.getElementById('{list}').value")), "");
    }
    assert_eq!(browser.evaluate(&format!("document.querySelector(\"{run}\") !== null")), true);
    assert_eq!(browser.evaluate("document.getElementById('notice').hidden"), true);
    is_clean(browser, &studio);
}

/// The command below the run, given to a shell where the drawn ground lies as it does here, trains the same to the byte.
fn is_what_its_command_trains(browser: &mut Browser, folder: &Path, studio: &Studio) {
    let command = text(browser, "run-command");
    let arguments = command.strip_prefix("gambol ").expect("a command");
    let elsewhere = folder.join("elsewhere");
    let ground = "runs/terrains/my hurdles.json";
    fs::create_dir_all(elsewhere.join("runs/terrains")).expect("a folder");
    fs::write(elsewhere.join(ground), studio.file(browser, ground)).expect("a file");
    let line = format!("\"$GAMBOL\" {arguments} --quiet --no-report --out native");
    let trained = Command::new("sh")
        .args(["-c", &line])
        .env("GAMBOL", env!("CARGO_BIN_EXE_gambol"))
        .current_dir(&elsewhere)
        .status()
        .expect("it runs");
    assert!(trained.success(), "{command}");
    for name in ["config.json", "log.jsonl", "champion.json"] {
        let there = studio.file(browser, &format!("runs/biped-1-running-2/{name}"));
        assert!(there == fs::read(elsewhere.join("native").join(name)).expect("a file of the run"), "another {name}");
    }
}
