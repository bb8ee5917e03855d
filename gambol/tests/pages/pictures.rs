//! What the chapters of the studio look like, beside what they looked like before.
//!
//! The pictures in *pictures* are as small as they are compared: letters are blurs in them, lest another machine's fonts be a difference.
//! After a change that is meant, write them anew and look at them:
//!
//! ```text
//! GAMBOL_PICTURES=write cargo test --release -p gambol --test pages -- "the studio looks"
//! ```

use crate::{
    browser::{Browser, ENTER, Kind, Person},
    hands::{click, is_clean, set, text, train, wait},
    home::{Home, Studio},
    likeness::{Look, Picture},
};
use std::{
    env, fs,
    path::{Path, PathBuf},
    thread,
    time::Duration,
};

/// How wide pictures are compared, px: those of a desk, those of a phone.
const WIDE: usize = 320;
const NARROW: usize = 180;

/// How tall the window is, px: nothing is below it.
const TALL: u32 = 1600;

/// How alike two pictures of the same are: the whole, and its least part. Letters that another machine draws leave 0.99 and 0.95 of it,
/// what is missing leaves 0.7 of its part at the most.
const LEAST_LIKENESS: f64 = 0.97;
const LEAST_LIKENESS_OF_A_PART: f64 = 0.8;

/// How alike they are at least where the letters are of another font, and lines may end elsewhere. Pictures of two chapters can be as alike
/// as that, so a chapter must also be more like its own picture than like any other.
const LEAST_LIKENESS_WITH_OTHER_LETTERS: f64 = 0.89;

/// How long words are in the font of texts and in that of headings, px, where the pictures were made.
const LETTERS: [f64; 2] = [448.51, 605.35];
const LENGTHS_OF_WORDS: &str = r#"["body", "h1"].map(name => {
  const context = document.createElement("canvas").getContext("2d");
  context.font = getComputedStyle(document.querySelector(name)).font;
  return context.measureText("Which of these learns to run, and how far does it come?").width;
})"#;

/// All pictures, each with a name.
const NAMES: [&str; 8] =
    ["watch", "choose", "draw-creature", "draw-ground", "play", "keep", "watch-dark", "watch-narrow"];

/// Compares what a browser shows with the pictures that are kept, or writes them.
#[expect(clippy::print_stdout, reason = "a rough comparison says so")]
pub(crate) fn look_as_they_did(program: &Path) {
    let folder = tempfile::tempdir().expect("a folder");
    let studio = Studio::start(&Home::Served, folder.path(), &["biped-1"]);
    let rests = Person { wants_rest: true, ..Person::default() };
    let browser = &mut *Kind::Chromium.start(program, rests);
    browser.visit(&studio.url, 1280);
    let lengths = browser.evaluate(LENGTHS_OF_WORDS);
    let same_letters = LETTERS
        .iter()
        .enumerate()
        .all(|(index, length)| lengths[index].as_f64().is_some_and(|here| (here / length - 1.0).abs() < 0.004));
    if !same_letters {
        println!("letters are of another font here than in the pictures, {lengths}: they are compared roughly");
    }
    let mut differences = Vec::new();
    let mut compare =
        |name: &str, picture: &[u8], width: usize| differences.extend(difference(name, picture, width, same_letters));
    train(browser, "biped-1", "running", 12);
    browser.resize(1280, TALL);
    wait(browser, "a verdict", "!document.getElementById('verdict').textContent.startsWith('Not judged')");
    from_the_start(browser);
    compare("watch", &at_rest(browser), WIDE);
    click(browser, "[data-chapter=choose]");
    compare("choose", &at_rest(browser), WIDE);
    click(browser, "[data-chapter=draw]");
    wait(browser, "no problem", "document.getElementById('draw-editor').textContent.includes('No problem')");
    compare("draw-creature", &at_rest(browser), WIDE);
    click(browser, "#draw label:has([value=ground])");
    // A box and a gap.
    for tool in ["Box", "Gap"] {
        let button = format!(
            "[...document.querySelectorAll('#draw-ground button')].find(button => button.title.startsWith('{tool}')).click()"
        );
        browser.evaluate(&button);
        browser.evaluate("document.querySelector('#draw-ground canvas').focus()");
        browser.press(ENTER);
    }
    wait(browser, "no problem", "document.getElementById('draw-ground').textContent.includes('No problem')");
    compare("draw-ground", &at_rest(browser), WIDE);
    click(browser, "[data-chapter=play]");
    wait(browser, "the champion", "document.getElementById('arena-caption').textContent.startsWith('the champion')");
    thread::sleep(Duration::from_secs(1));
    click(browser, "#play-reset");
    wait(browser, "the start", "document.querySelector('#arena-readouts dd').textContent.startsWith('0.0')");
    compare("play", &at_rest(browser), WIDE);
    click(browser, "[data-chapter=keep]");
    compare("keep", &at_rest(browser), WIDE);
    is_clean(browser, &studio);

    let dark = Person { likes_dark: true, ..rests };
    for (name, person, width, small) in [("watch-dark", dark, 1280, WIDE), ("watch-narrow", rests, 360, NARROW)] {
        let browser = &mut *Kind::Chromium.start(program, person);
        browser.visit(&studio.url, width);
        browser.resize(width, TALL);
        click(browser, "[data-chapter=keep]");
        wait(browser, "the gallery", "document.querySelector('#keep-runs button') !== null");
        click(browser, "#keep-runs button");
        wait(browser, "the run", "document.getElementById('run-state').textContent.includes('generation 12 ')");
        wait(browser, "a verdict", "!document.getElementById('verdict').textContent.startsWith('Not judged')");
        from_the_start(browser);
        compare(name, &at_rest(browser), small);
    }
    assert!(differences.is_empty(), "{}", differences.join("\n"));
}

/// Goes to the first moment of the picture, which rests for those who want rest.
fn from_the_start(browser: &mut Browser) {
    assert_eq!(text(browser, "show-play"), "▶", "it rests");
    // A step that was asked for before would be taken by the one that is shown next.
    thread::sleep(Duration::from_secs(1));
    set(browser, "#show-who", "population");
    wait(
        browser,
        "the last generation",
        "document.getElementById('arena-caption').textContent.startsWith('generation 12,')",
    );
    wait(browser, "the start", "document.querySelector('#arena-readouts dd').textContent.startsWith('0.0')");
}

/// The picture, once it no longer changes.
fn at_rest(browser: &mut Browser) -> Vec<u8> {
    // Nothing is under the pointer, nothing has the focus.
    browser.point(0.0, 0.0);
    browser.evaluate("document.activeElement.blur()");
    browser.evaluate("scrollTo(0, 0)");
    let mut before = Vec::new();
    for _ in 0..40 {
        thread::sleep(Duration::from_millis(300));
        let now = browser.picture();
        if now == before {
            return now;
        }
        before = now;
    }
    panic!("the picture never rests");
}

fn kept(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/pages/pictures/{name}.png"))
}

/// How alike a picture is to each of those that are kept, as a whole.
fn likenesses(look: &Look) -> impl Iterator<Item = (&'static str, f64)> {
    let likeness =
        |name: &'static str| Some((name, Picture::read(&fs::read(kept(name)).ok()?).look().likeness(look).0));
    NAMES.into_iter().filter_map(likeness)
}

fn is_same((whole, part): (f64, f64)) -> bool {
    whole >= LEAST_LIKENESS && part >= LEAST_LIKENESS_OF_A_PART
}

/// Whether a picture is roughly as the one that is kept under its name, and less like all others: by how alike it is to each, as a whole.
fn is_recognised(name: &str, likenesses: impl IntoIterator<Item = (&'static str, f64)>) -> bool {
    let nearest = likenesses.into_iter().max_by(|one, other| one.1.total_cmp(&other.1));
    nearest.is_some_and(|(other, likeness)| other == name && likeness >= LEAST_LIKENESS_WITH_OTHER_LETTERS)
}

/// What is to be said of a picture that is not as the one that is kept.
fn difference(name: &str, picture: &[u8], width: usize, same_letters: bool) -> Option<String> {
    let picture = Picture::read(picture).shrunk(width);
    let path = kept(name);
    if env::var("GAMBOL_PICTURES").is_ok_and(|what| what == "write") {
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(&path, picture.write()).expect("a file");
        return None;
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("pictures");
    let Ok(before) = fs::read(&path) else {
        return Some(format!("{name}: there is no {}: GAMBOL_PICTURES=write writes it", path.display()));
    };
    let look = picture.look();
    let (whole, part) = Picture::read(&before).look().likeness(&look);
    let is_as_before = if same_letters { is_same((whole, part)) } else { is_recognised(name, likenesses(&look)) };
    if is_as_before {
        return None;
    }
    fs::create_dir_all(&folder).expect("a folder");
    let (old, new) = (folder.join(format!("{name}-before.png")), folder.join(format!("{name}-now.png")));
    fs::write(&old, before).expect("a file");
    fs::write(&new, picture.write()).expect("a file");
    Some(format!(
        "{name}: likeness {whole:.3}, in its least part {part:.3}; see {} and {}",
        old.display(),
        new.display()
    ))
}

/// What must be seen, each a part of a picture without which it is another: left, top, width, height.
const PARTS: [(&str, &str, [usize; 4]); 12] = [
    ("watch", "the creature", [100, 60, 60, 100]),
    ("watch", "how far it has come", [8, 28, 70, 20]),
    ("watch", "what is shown", [0, 186, 270, 24]),
    ("watch", "the one that is followed", [8, 224, 300, 14]),
    ("watch", "training", [8, 240, 300, 22]),
    ("watch", "the chart", [8, 300, 160, 60]),
    ("choose", "a creature", [80, 36, 44, 36]),
    ("choose", "the movements", [8, 80, 300, 26]),
    ("keep", "what can be done with a run", [8, 28, 300, 12]),
    ("keep", "the gallery", [8, 136, 60, 50]),
    ("draw-ground", "the numbers", [220, 50, 90, 200]),
    ("watch-narrow", "the fields", [10, 600, 120, 40]),
];

/// A picture of one chapter is none of another, nor one in the dark; one without a part is another; one whose letters have other edges is
/// the same.
pub(crate) fn are_told_apart() {
    let pictures = NAMES.map(|name| Picture::read(&fs::read(kept(name)).expect("it is kept")));
    let looks: Vec<Look> = pictures.iter().map(Picture::look).collect();
    for (index, name) in NAMES.into_iter().enumerate() {
        let softened = pictures[index].softened().look();
        let to_each: Vec<_> = NAMES.into_iter().zip(looks.iter().map(|other| other.likeness(&softened))).collect();
        for (other, likeness) in &to_each {
            let wholes = to_each.iter().map(|(kept, (whole, _))| (*kept, *whole));
            assert_eq!(is_same(*likeness), name == *other, "{name}, {other}: {likeness:?}");
            assert_eq!(is_recognised(other, wholes), name == *other, "{name}, {other}, roughly: {likeness:?}");
        }
    }
    for (name, part, place) in PARTS {
        let index = NAMES.iter().position(|other| *other == name).expect("it is kept");
        let likeness = looks[index].likeness(&pictures[index].painted_over(place).look());
        assert!(!is_same(likeness), "{name} without {part}: {likeness:?}");
    }
}
