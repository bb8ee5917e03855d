//! The studio, used as a person would use it.

use crate::{
    browser::{Browser, Key},
    hands::{click, drop_file, generation, is_clean, set, text, train, wait},
    home::{Home, Studio},
    studio_runs::remove_drawn,
};
use serde_json::Value;
use std::{fs, path::Path, process::Command, thread, time::Duration};

const ONE: Key = Key("1", "Digit1", 49);
const FOUR: Key = Key("4", "Digit4", 52);

pub(crate) fn begins(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &[]);
    browser.visit(&studio.url, 1280);
    wait(browser, "a biped that learns", "/generation \\d+/.test(document.getElementById('run-state').textContent)");
    wait(
        browser,
        "the first generation",
        "/generation \\d+, 64 creatures/.test(document.getElementById('arena-caption').textContent)",
    );
    let moved = "(() => { const shown = document.querySelector('#arena-readouts dd').textContent; return parseFloat(shown) > 0.3; })()";
    wait(browser, "a picture that moves", moved);
    wait(browser, "a usable gait", "document.getElementById('verdict').textContent === 'Usable'");
    wait(browser, "a chart", "document.querySelectorAll('#fitness-chart path').length > 1");
    click(browser, "#run-pause");
    wait(browser, "the pause", "document.getElementById('run-state').textContent.includes('training waits')");
    let before = generation(browser);
    click(browser, "#run-step");
    wait(
        browser,
        "one generation",
        &format!("document.getElementById('run-state').textContent.includes('generation {}')", before + 1),
    );
    click(browser, "#run-stop");
    wait(browser, "the end", "document.getElementById('run-state').textContent.includes('interrupted')");
    // The page is loaded anew: the run is there, and goes on.
    browser.visit(&studio.url, 1280);
    wait(
        browser,
        "the run",
        &format!("document.getElementById('run-state').textContent.includes('generation {}')", before + 1),
    );
    wait(
        browser,
        "its generation",
        "/generation \\d+, 64 creatures/.test(document.getElementById('arena-caption').textContent)",
    );
    set(browser, "#run-more", "50");
    click(browser, "#run-go-on");
    wait(
        browser,
        "more",
        &format!("document.getElementById('run-state').textContent.includes('generation {}')", before + 51),
    );
    is_clean(browser, &studio);
}

pub(crate) fn chooses(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["tetrapod-1"]);
    browser.visit(&studio.url, 1280);
    wait(
        browser,
        "the choice",
        "document.getElementById('choose-command').textContent === 'gambol train tetrapod-1 running'",
    );
    set(browser, "#settings-search", "population");
    let field = "[data-key='strategy.cma-es.population']";
    set(browser, field, "0");
    wait(
        browser,
        "what is wrong",
        "document.querySelector('.setting.wrong .problem')?.textContent.includes('population')",
    );
    assert_eq!(browser.evaluate("document.getElementById('choose-train').disabled"), true);
    set(browser, field, "16");
    wait(browser, "what is right", "!document.querySelector('.setting.wrong')");
    assert!(text(browser, "choose-command").ends_with("--set 'strategy.cma-es.population=16'"));
    assert!(text(browser, "settings-count").contains("1 is not as the preset has it"));
    click(browser, "#settings-undo");
    wait(browser, "the wrong one again", "document.querySelector('.setting.wrong') !== null");
    click(browser, "#settings-undo");
    wait(
        browser,
        "the preset",
        "document.getElementById('choose-command').textContent === 'gambol train tetrapod-1 running'",
    );
    // A number that cannot be is told, and nothing is trained with another in its place.
    set(browser, "#choose-generations", "-5");
    wait(browser, "what is wrong", "document.getElementById('choose-problem').textContent.startsWith('Generations: ')");
    assert_eq!(browser.evaluate("document.getElementById('choose-train').disabled"), true);
    set(browser, "#choose-generations", "");
    wait(browser, "what is right", "!document.getElementById('choose-train').disabled");
    // Another movement drops the settings, and undoing it brings both back.
    set(browser, "#settings-search", "population");
    set(browser, field, "16");
    wait(browser, "a setting", "document.getElementById('choose-command').textContent.includes('population=16')");
    browser.evaluate("document.querySelector('[name=movement][value=walking]').click()");
    wait(
        browser,
        "another movement",
        "document.getElementById('choose-command').textContent === 'gambol train tetrapod-1 walking'",
    );
    click(browser, "#settings-undo");
    wait(
        browser,
        "the setting again",
        "document.getElementById('choose-command').textContent \
         === \"gambol train tetrapod-1 running --set 'strategy.cma-es.population=16'\"",
    );
    train(browser, "tetrapod-2", "jumping", 3);
    let champion = folder.join("trained.json");
    fs::write(&champion, studio.kept_file(browser, "runs/tetrapod-2-jumping/champion.json")).expect("a file");
    let verified = Command::new(env!("CARGO_BIN_EXE_gambol")).arg("verify").arg(champion).output().expect("it runs");
    let complaint = String::from_utf8_lossy(&verified.stderr);
    assert!(verified.status.success(), "what was trained in the studio is not verified: {complaint}");
    is_clean(browser, &studio);
}

pub(crate) fn plays(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    train(browser, "biped-1", "running", 12);
    browser.press(FOUR);
    wait(browser, "the champion", "document.getElementById('arena-caption').textContent.startsWith('the champion')");
    assert!(text(browser, "play-hint").contains("runs by itself"));
    click(browser, "#play-box");
    click(browser, "#play-push");
    set(browser, "#play-tilt", "30");
    set(browser, "#play-terrain", "steps");
    wait(browser, "the champion again", "parseFloat(document.querySelector('#arena-readouts dd').textContent) > 0.5");
    assert_eq!(text(browser, "play-tilt-value"), "30°");
    click(browser, "#play-learned");
    assert_eq!(text(browser, "play-tilt-value"), "0°");
    // The keys are the champion's.
    assert_eq!(browser.evaluate("document.activeElement.id"), "arena-canvas");
    browser.press(ONE);
    wait(browser, "the generation", "document.getElementById('arena-caption').textContent.includes('creatures')");
    assert_eq!(browser.evaluate("document.getElementById('notice').hidden"), true);
    is_clean(browser, &studio);
}

pub(crate) fn draws(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["tetrapod-1"]);
    browser.visit(&studio.url, 1280);
    click(browser, "[data-chapter=draw]");
    wait(browser, "the editor", "document.querySelector('.editor-canvas') !== null");
    wait(browser, "its problems", "document.querySelector('.editor').textContent.includes('No problem')");
    let name = "[...document.querySelectorAll('.editor input')].find(field => field.type === 'text')";
    let rename = format!(
        "(() => {{ const field = {name}; field.value = 'my piano'; \
         for (const kind of ['input', 'change']) field.dispatchEvent(new Event(kind, {{ bubbles: true }})); }})()"
    );
    browser.evaluate(&rename);
    browser.evaluate("document.querySelector('.editor-canvas').focus()");
    browser.press(Key("k", "KeyK", 75));
    wait(browser, "a training of it", "document.getElementById('run-state').textContent.includes('generation')");
    wait(browser, "its gait", "document.getElementById('verdict').textContent === 'Usable'");
    assert!(!studio.file(browser, "runs/creatures/my piano.json").is_empty());
    assert!(text(browser, "run-command").contains("runs/creatures/my piano.json'"));
    // It is removed; another is chosen, and its run stays.
    remove_drawn(browser, &studio, "my piano", "runs/creatures/my piano.json");
    assert_eq!(
        browser.evaluate("[...document.getElementsByName('creature')].some(({ value }) => value === 'my piano')"),
        false
    );
    assert_eq!(browser.evaluate("document.querySelector('[name=creature]:checked')?.value !== undefined"), true);
    wait(browser, "its run", "document.querySelector(\"[data-run='my piano-running']\") !== null");
    // A creature that is begun anew gets a name that none has, and what was drawn can be had back.
    click(browser, "[data-chapter=draw]");
    browser.evaluate(&rename.replace("my piano", "my-creature"));
    browser.evaluate("document.querySelector('.editor-canvas').focus()");
    browser.press(Key("k", "KeyK", 75));
    wait(browser, "its training", "document.getElementById('run-command').textContent.includes('my-creature.json')");
    click(browser, "[data-chapter=draw]");
    browser.evaluate("[...document.querySelectorAll('.editor button')].find(button => button.textContent.trim().startsWith('New')).click()");
    wait(browser, "a free name", &format!("{name}.value === 'my-creature 2'"));
    click(browser, "[data-chapter=keep]");
    browser.evaluate("document.getElementById('keep-draw').click()");
    wait(browser, "another", &format!("{name}.value === 'my-creature'"));
    browser.evaluate("document.querySelector('.editor-canvas').focus()");
    browser.evaluate(
        "document.activeElement.dispatchEvent(new KeyboardEvent('keydown', { key: 'z', ctrlKey: true, bubbles: true }))",
    );
    wait(browser, "what was drawn before", &format!("{name}.value === 'my-creature 2'"));
    // The page is loaded anew: what was being drawn is still there.
    browser.evaluate(&rename.replace("my piano", "half a piano"));
    browser.visit(&studio.url, 1280);
    click(browser, "[data-chapter=draw]");
    wait(browser, "the draft", &format!("{name}?.value === 'half a piano'"));
    assert_eq!(browser.evaluate("document.getElementById('notice').hidden"), true);
    is_clean(browser, &studio);
}

pub(crate) fn keeps(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    train(browser, "biped-1", "running", 60);
    click(browser, "[data-chapter=keep]");
    wait(browser, "the gallery", "document.querySelectorAll('#keep-runs button').length === 1");
    click(browser, "#keep-verify");
    wait(browser, "the proof", "document.getElementById('keep-result').textContent.startsWith('Identical')");
    let said = |browser: &mut Browser, format: &str| {
        browser.evaluate(&format!("[...document.querySelectorAll('#keep-exports button')].find(button => button.textContent === {format:?}).click()"));
        wait(browser, format, "!document.getElementById('keep-result').textContent.includes('being made')");
        text(browser, "keep-result")
    };
    assert_eq!(said(browser, "player"), "biped-1-running.player is saved.");
    assert_eq!(said(browser, "csv"), "biped-1-running.csv is saved.");
    if *home == Home::Served {
        let report =
            browser.evaluate("fetch(document.getElementById('keep-report').href).then(answer => answer.text())");
        assert!(report.as_str().is_some_and(|page| page.contains("<title>")), "the report");
    } else {
        click(browser, "#keep-report");
        wait(
            browser,
            "the report",
            "document.getElementById('keep-result').textContent === 'biped-1-running.html is saved.'",
        );
    }
    // A champion from a file, and one that is none.
    let champion = String::from_utf8(studio.file(browser, "runs/biped-1-running/champion.json")).expect("text");
    drop_file(browser, "champion.json", &champion);
    wait(
        browser,
        "the champion",
        "document.getElementById('run-state').textContent.startsWith('a champion of generation')",
    );
    drop_file(browser, "damaged.json", &champion.replacen("0.", "1.", 1));
    wait(browser, "a refusal", "!document.getElementById('notice').hidden");
    drop_file(browser, "nothing.json", "{");
    wait(browser, "another", "document.querySelector('#notice p').textContent.startsWith('nothing.json')");
    assert_eq!(browser.complaints(), [""; 0], "errors");
}

pub(crate) fn fits(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    for width in [360, 1280, 3840] {
        browser.visit(&studio.url, width);
        train(browser, "biped-1", "running", 2);
        for chapter in ["watch", "choose", "draw", "play", "keep"] {
            click(browser, &format!("[data-chapter={chapter}]"));
            thread::sleep(Duration::from_millis(200));
            let overhang = "document.documentElement.scrollWidth - document.documentElement.clientWidth";
            assert_eq!(browser.evaluate(overhang), 0, "{chapter} is wider than {width} px");
            let unnamed = "[...document.querySelectorAll('main > section:not([hidden]) :is(button, input, select, textarea, a)')] \
                .filter(control => control.checkVisibility() && !(control.textContent.trim() || control.labels?.length \
                || control.getAttribute('aria-label') || control.title)).length";
            assert_eq!(browser.evaluate(unnamed), 0, "{chapter}: controls without a name");
        }
    }
    is_clean(browser, &studio);
}

pub(crate) fn hostile(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    let mut creature: Value = serde_json::to_value(creatures::find("biped-1").expect("it is shipped")).expect("JSON");
    let script =
        "<img src=x onerror=\"document.body.dataset.harmed = 1\"><script>document.body.dataset.harmed = 1</script>";
    creature["title"] = script.into();
    creature["parts"][1]["name"] = script[..64].into();
    creature["joints"][0]["child"] = script[..64].into();
    creature["name"] = "hostile".into();
    fs::create_dir_all(folder.join("runs/creatures")).expect("a folder");
    fs::write(folder.join("runs/creatures/hostile.json"), creature.to_string()).expect("a file");
    browser.visit(&studio.url, 1280);
    train(browser, "hostile", "running", 2);
    for chapter in ["draw", "play", "keep", "watch"] {
        click(browser, &format!("[data-chapter={chapter}]"));
        thread::sleep(Duration::from_millis(300));
    }
    assert!(text(browser, "arena-title").starts_with("<img"), "it is shown as text");
    assert_eq!(browser.evaluate("document.body.dataset.harmed ?? null"), Value::Null);
    is_clean(browser, &studio);
}

/// What was trained on the page is what the command line beside it trains.
pub(crate) fn repeats(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    let trained = [("biped-1", "running", 12), ("tetrapod-2", "jumping", 8), ("decapod-1", "running", 6)];
    for (creature, movement, generations) in trained {
        train(browser, creature, movement, generations);
        let command = text(browser, "run-command");
        let arguments: Vec<&str> = command.split_whitespace().skip(1).collect();
        let native = folder.join(format!("native-{creature}"));
        let trained = Command::new(env!("CARGO_BIN_EXE_gambol"))
            .args(arguments)
            .args(["--quiet", "--no-report", "--out"])
            .arg(&native)
            .status()
            .expect("it runs");
        assert!(trained.success(), "{command}");
        for name in ["config.json", "log.jsonl", "champion.json", "checkpoint", "gallery.jsonl"] {
            let there = studio.file(browser, &format!("runs/{creature}-{movement}/{name}"));
            assert!(there == fs::read(native.join(name)).expect("a file of the run"), "{creature}: another {name}");
        }
    }
    is_clean(browser, &studio);
}

/// Two tabs see the same run, and what one does the other hears of.
pub(crate) fn is_shared(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &[]);
    browser.visit(&studio.url, 1280);
    wait(browser, "a biped that learns", "/generation \\d+/.test(document.getElementById('run-state').textContent)");
    let first = browser.open_tab();
    browser.visit(&studio.url, 1280);
    wait(
        browser,
        "the same biped",
        "/training · generation \\d+/.test(document.getElementById('run-state').textContent)",
    );
    click(browser, "#run-pause");
    wait(browser, "the pause", "document.getElementById('run-state').textContent.includes('training waits')");
    browser.go_to_tab(first);
    wait(
        browser,
        "the pause in the other",
        "document.getElementById('run-state').textContent.includes('training waits')",
    );
    assert_eq!(browser.evaluate("document.querySelectorAll('#fitness-chart path').length > 1"), true);
    is_clean(browser, &studio);
}

/// A run goes out as a file and comes in again; a champion is an address.
pub(crate) fn travels(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &["biped-1"]);
    browser.visit(&studio.url, 1280);
    train(browser, "biped-1", "running", 8);
    click(browser, "[data-chapter=keep]");
    wait(browser, "the gallery", "document.querySelectorAll('#keep-runs button').length === 1");
    browser.evaluate("URL.createObjectURL = blob => { window.saved = blob; return 'blob:nothing'; }");
    click(browser, "#keep-pack");
    wait(
        browser,
        "the file",
        "document.getElementById('keep-result').textContent.startsWith('biped-1-running.tar is saved')",
    );
    let digits = browser.evaluate(
        "window.saved.arrayBuffer().then(bytes => [...new Uint8Array(bytes)].map(byte => byte.toString(16).padStart(2, '0')).join(''))",
    );
    let digits = digits.as_str().expect("text").as_bytes();
    let byte = |pair: &[u8]| u8::from_str_radix(std::str::from_utf8(pair).expect("digits"), 16).expect("a byte");
    let tar: Vec<u8> = digits.chunks(2).map(byte).collect();
    fs::write(folder.join("run.tar"), &tar).expect("a file");
    let unpacked = Command::new("tar").args(["xf", "run.tar"]).current_dir(folder).status().expect("there is tar");
    assert!(unpacked.success());
    let resumed = Command::new(env!("CARGO_BIN_EXE_gambol"))
        .args(["resume", "biped-1-running", "--generations", "10", "--quiet", "--no-report"])
        .current_dir(folder)
        .status()
        .expect("it runs");
    assert!(resumed.success(), "a run of the page goes on in the program");
    browser.evaluate(
        "(() => { const data = new DataTransfer(); data.items.add(new File([window.saved], 'mine.tar')); \
         document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true })); })()",
    );
    wait(browser, "the run again", "document.getElementById('keep-title').textContent === 'biped-1-running-2'");
    for name in ["config.json", "log.jsonl", "champion.json", "checkpoint"] {
        let (one, other) = (format!("runs/biped-1-running/{name}"), format!("runs/biped-1-running-2/{name}"));
        wait(browser, "it is kept", "new Promise(resolve => setTimeout(() => resolve(true), 1500))");
        assert!(studio.file(browser, &one) == studio.file(browser, &other), "{name}");
    }
    browser.evaluate(
        "(() => { const data = new DataTransfer(); data.items.add(new File(['nothing'], 'wrong.tar')); \
         document.dispatchEvent(new DragEvent('drop', { dataTransfer: data, cancelable: true })); })()",
    );
    wait(
        browser,
        "a refusal",
        "document.querySelector('#notice p').textContent.startsWith('wrong.tar: there is no run in it')",
    );
    browser.evaluate(
        "Object.defineProperty(navigator, 'clipboard', { value: { writeText: async text => { window.copied = text; } } })",
    );
    click(browser, "#keep-link");
    wait(browser, "the link", "document.getElementById('keep-result').textContent.includes('is copied')");
    let link = browser.evaluate("window.copied").as_str().expect("text").to_owned();
    // Only the part after the sign changes, which loads nothing anew.
    browser.visit("about:blank", 1280);
    browser.visit(&link, 1280);
    wait(
        browser,
        "the champion",
        "document.getElementById('run-state').textContent.startsWith('a champion of generation')",
    );
    wait(browser, "that moves", "parseFloat(document.querySelector('#arena-readouts dd').textContent) > 0.3");
    browser.visit("about:blank", 1280);
    browser.visit(&format!("{}x", &link[..link.len() - 9]), 1280);
    wait(browser, "a damaged link", "!document.getElementById('notice').hidden");
}
