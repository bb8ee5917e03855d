//! Somebody who has never seen the studio, and has a few things to do in it. What a newcomer knows is what is on the screen: the words on
//! buttons, beside fields and in texts, and the picture. What a newcomer does is pointing and typing, and each of it is counted.

use crate::{
    browser::Browser,
    home::{Home, Studio},
    likeness::Picture,
};
use serde_json::Value;
use std::{
    path::Path,
    thread,
    time::{Duration, Instant},
};

/// How many actions a task may take.
const MOST_ACTIONS: usize = 6;

/// How long a newcomer looks for something that shall be there now.
const LOOK: Duration = Duration::from_secs(3);

/// How long a newcomer waits for something that takes its time.
const PATIENCE: Duration = Duration::from_secs(90);

struct Newcomer<'a> {
    browser: &'a mut Browser,
    /// What was done for the task so far.
    done: Vec<String>,
}

/// A place on the screen, px.
#[derive(Clone, Copy, Debug)]
struct Place {
    left: f64,
    top: f64,
    width: f64,
    height: f64,
}

impl Place {
    fn middle(self) -> [f64; 2] {
        self.at(0.5, 0.5)
    }

    fn at(self, x: f64, y: f64) -> [f64; 2] {
        [self.left + x * self.width, self.top + y * self.height]
    }
}

impl<'a> Newcomer<'a> {
    fn new(browser: &'a mut Browser, studio: &Studio) -> Self {
        browser.visit(&studio.url, 1280);
        Self { browser, done: Vec::new() }
    }

    /// A task, from what is on the screen now to what is when it is done.
    fn task(&mut self, name: &str, act: impl FnOnce(&mut Self)) {
        self.done.clear();
        act(self);
        assert!(self.done.len() <= MOST_ACTIONS, "{name} takes {} actions: {:#?}", self.done.len(), self.done);
    }

    /// All words on the screen.
    fn text(&mut self) -> String {
        self.browser.evaluate("document.body.innerText").as_str().expect("text").to_owned()
    }

    /// Nothing may be refused: a newcomer would not know what to do.
    #[track_caller]
    fn did(&mut self, what: String) {
        self.done.push(what);
        let refused = self.browser.evaluate(
            "[...document.querySelectorAll('[role=alert]')].filter(notice => notice.checkVisibility()).map(notice => notice.innerText)",
        );
        assert_eq!(refused, Value::Array(Vec::new()), "after {:?}", self.done);
    }

    /// Where a thing is that has these words on it, beside it or in it. Scrolling there is looking.
    #[track_caller]
    fn find(&mut self, words: &str) -> Place {
        let since = Instant::now();
        loop {
            let found = self.browser.evaluate(&FIND.replace("WORDS", &Value::from(words).to_string()));
            if let Some(place) = found["place"].as_array() {
                let [left, top, width, height] = [0, 1, 2, 3].map(|index| place[index].as_f64().expect("a number"));
                return Place { left, top, width, height };
            }
            assert!(since.elapsed() < LOOK, "{words:?} is {}; after {:?}", found["problem"], self.done);
            thread::sleep(Duration::from_millis(50));
        }
    }

    #[track_caller]
    fn press(&mut self, words: &str) {
        let [x, y] = self.find(words).middle();
        self.browser.click(x, y);
        self.did(format!("click {words}"));
    }

    #[track_caller]
    fn write(&mut self, text: &str) {
        self.browser.write(text);
        self.did(format!("type {text}"));
    }

    #[track_caller]
    fn drag(&mut self, from: [f64; 2], to: [f64; 2]) {
        self.browser.drag(from, to);
        self.did(format!("drag from {from:?} to {to:?}"));
    }

    /// Reads until it says so.
    #[track_caller]
    fn read<T>(&mut self, what: &str, find: impl Fn(&str) -> Option<T>) -> T {
        let since = Instant::now();
        loop {
            let text = self.text();
            if let Some(found) = find(&text) {
                return found;
            }
            assert!(since.elapsed() < PATIENCE, "never read: {what}; after {:?} it says: {text}", self.done);
            thread::sleep(Duration::from_millis(50));
        }
    }

    /// What is to be seen at a place.
    fn look(&mut self, place: Place) -> Picture {
        Picture::read(&self.browser.picture())
            .part([place.left, place.top, place.width, place.height].map(|side| side as usize))
    }

    /// How far the creature has come at which time, from its start until a time: for each tenth of a second the least and the most metres.
    fn way(&mut self, until: usize) -> Vec<Option<[f64; 2]>> {
        let mut way = Vec::new();
        let mut last = usize::MAX;
        let since = Instant::now();
        loop {
            assert!(since.elapsed() < PATIENCE, "the time stands still");
            let text = self.text();
            let (Some(time), Some(distance)) = (number(&text, "time"), number(&text, "distance")) else { continue };
            let tenth = (time * 10.0).round() as usize;
            // It has begun anew.
            if tenth < last {
                way = vec![None; until];
            }
            last = tenth;
            if tenth < until {
                let [least, most] = way[tenth].unwrap_or([distance; 2]);
                way[tenth] = Some([least.min(distance), most.max(distance)]);
            } else if way.iter().filter(|tenth| tenth.is_some()).count() > until / 2 {
                return way;
            }
        }
    }
}

/// Where a picture is of a lively colour: not the sky, the hills or the ground.
fn vivid(picture: &Picture) -> Place {
    let is_vivid = |[red, green, blue]: [f32; 3]| red.max(green).max(blue) - red.min(green).min(blue) > 80.0;
    let found = (0..picture.points.len()).filter(|&index| is_vivid(picture.points[index]));
    let (mut least, mut most) = ([f64::MAX; 2], [0.0f64; 2]);
    for place in found.map(|index| [index % picture.width, index / picture.width].map(|place| place as f64)) {
        least = [least[0].min(place[0]), least[1].min(place[1])];
        most = [most[0].max(place[0]), most[1].max(place[1])];
    }
    assert!(least[0] < most[0], "nothing vivid");
    Place { left: least[0], top: least[1], width: most[0] - least[0], height: most[1] - least[1] }
}

/// Where the ground begins: its edge is a dark line.
fn darkest_row(picture: &Picture) -> f64 {
    let light = |row: &[[f32; 3]]| row.iter().flatten().sum::<f32>();
    let rows = picture.points.chunks_exact(picture.width).map(light).enumerate();
    rows.min_by(|one, other| one.1.total_cmp(&other.1)).expect("rows").0 as f64
}

/// The number that is read after a word.
fn number(text: &str, word: &str) -> Option<f64> {
    let rest = text.split(word).nth(1)?;
    rest.split_whitespace().next()?.replace('−', "-").parse().ok()
}

/// The generation that training has come to.
fn generation(text: &str) -> Option<u32> {
    let rest = text.split("training · generation ").nth(1)?;
    rest.split_whitespace().next()?.replace(',', "").parse().ok()
}

pub(crate) fn changes_the_population(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &[]);
    let mut newcomer = Newcomer::new(browser, &studio);
    newcomer.read("a first creature that learns", generation);
    newcomer.task("changing the population", |person| {
        person.press("Choose");
        person.press("Search");
        person.write("population");
        person.press("population");
        person.write("20");
        person.press("Train");
        person.read("the population", |text| text.contains(", 20 creatures").then_some(()));
    });
}

pub(crate) fn draws_a_tripod(browser: &mut Browser, folder: &Path, home: &Home) {
    let studio = Studio::start(home, folder, &[]);
    let mut newcomer = Newcomer::new(browser, &studio);
    newcomer.read("a first creature that learns", generation);
    newcomer.task("drawing a tripod", |person| {
        person.press("Draw");
        person.press("New");
        person.read("what to do", |text| text.contains("Drag from the body down to the ground").then_some(()));
        let canvas = person.find("The creature");
        let sight = person.look(canvas);
        let (body, ground) = (vivid(&sight), darkest_row(&sight));
        for share in [0.15, 0.5, 0.85] {
            let [x, y] = body.at(share, 0.5);
            let x = canvas.left + x;
            person.drag([x, canvas.top + y], [x, canvas.top + ground]);
        }
        person.read("a body with three legs", |text| text.contains("No problem. 4 parts, 3 hinges.").then_some(()));
    });
    newcomer.task("training it", |person| {
        person.press("Train it");
        person.read("its training", |text| text.contains("my-creature · running").then_some(()));
        person.read("twenty generations", |text| generation(text).filter(|&generation| generation >= 20));
        person.read("a verdict", |text| text.lines().any(|line| line == "Usable").then_some(()));
        person.press("Stop and save");
        person.read("the end", |text| text.contains("interrupted").then_some(()));
    });
    newcomer.task("pushing it", |person| {
        person.press("Play");
        person.read("the champion", |text| text.contains("the champion, of generation").then_some(()));
        let alone = person.way(35);
        person.press("Begin again");
        person.press("Push it");
        let pushed = person.way(35);
        let apart = alone.iter().zip(&pushed).filter_map(|(alone, pushed)| {
            let ([least, most], [short, far]) = ((*alone)?, (*pushed)?);
            Some((short - most).max(least - far))
        });
        let apart = apart.fold(0.0, f64::max);
        assert!(apart > 0.2, "a push moves it by no more than {apart} m: {alone:?}, {pushed:?}");
    });
    newcomer.task("exporting a GIF", |person| {
        person.press("Keep");
        person.press("gif");
        person.read("the file", |text| text.contains("my-creature-running.gif is saved.").then_some(()));
    });
}

/// The place of the one control that is called so and can be used now; else what is the matter.
const FIND: &str = r#"(() => {
  const wanted = WORDS.toLowerCase();
  const words = node => {
    const copy = node.cloneNode(true);
    for (const other of copy.querySelectorAll("kbd, select, input, textarea, [aria-hidden=true]")) other.remove();
    return copy.textContent;
  };
  const nameOf = control => {
    const name = control.getAttribute("aria-label") || (control.labels?.length ? words(control.labels[0]) : "")
      || control.placeholder || words(control);
    return name.trim().replace(/\s+/g, " ").toLowerCase();
  };
  // A choice that is drawn as its label is seen there.
  const shownAs = control => ["radio", "checkbox"].includes(control.type) && control.labels.length ? control.labels[0] : control;
  const isSeen = thing => thing.checkVisibility({ opacityProperty: true, visibilityProperty: true }) && thing.offsetWidth > 0;
  const controls = [...document.querySelectorAll("button, a[href], summary, input, select, textarea, canvas")]
    .filter(control => isSeen(shownAs(control)));
  const isPart = name => (" " + name.replace(/[^\p{L}\p{N}]+/gu, " ") + " ").includes(" " + wanted + " ");
  const exact = controls.filter(control => nameOf(control) === wanted);
  const found = exact.length ? exact : controls.filter(control => isPart(nameOf(control)));
  if (found.length !== 1) return { problem: `there ${found.length} times; there are: ${controls.map(nameOf).join(" | ")}` };
  const [control] = found;
  if (control.disabled || control.getAttribute("aria-disabled") === "true") return { problem: "disabled" };
  const shown = shownAs(control);
  shown.scrollIntoView({ block: "center", behavior: "instant" });
  const { left, top, width, height } = shown.getBoundingClientRect();
  const on = document.elementFromPoint(left + width / 2, top + height / 2);
  if (!on || !shown.contains(on)) return { problem: `covered by ${on?.outerHTML.slice(0, 80)}` };
  return { place: [left, top, width, height] };
})()"#;
