//! A page of each kind, made by the program from runs of a blink.

use serde_json::{Value, json};
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

/// A kind of page.
pub(crate) struct Kind {
    pub(crate) name: &'static str,
    /// Makes it in a folder; gives where it is.
    pub(crate) make: fn(&Path) -> PathBuf,
    /// Whether it plays a champion, with the controls for that.
    pub(crate) plays: bool,
}

pub(crate) const KINDS: [Kind; 9] = [
    Kind { name: "run", make: run, plays: true },
    Kind { name: "run of NEAT", make: neat, plays: true },
    Kind { name: "stages", make: stages, plays: true },
    Kind { name: "front", make: front, plays: true },
    Kind { name: "terrain", make: terrain, plays: true },
    Kind { name: "swimming", make: swimming, plays: true },
    Kind { name: "replay", make: replay, plays: true },
    Kind { name: "comparison", make: comparison, plays: false },
    Kind { name: "reproduction", make: reproduction, plays: false },
];

/// Arguments of a run whose generations take milliseconds.
const SMALL: [&str; 8] =
    ["--population", "12", "--generations", "12", "--set", "movement.steps=100", "--set", "training_steps=null"];

#[track_caller]
fn gambol(arguments: &[&str], out: &Path) -> PathBuf {
    let mut program = Command::new(env!("CARGO_BIN_EXE_gambol"));
    program.args(arguments).arg("--out").arg(out).arg("--quiet").env_remove("GAMBOL_LOG").stdin(Stdio::null());
    let ended = program.output().expect("it starts");
    assert!(ended.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&ended.stderr));
    out.into()
}

fn trained(folder: &Path, arguments: &[&str]) -> PathBuf {
    gambol(&[&["train"], arguments, &SMALL].concat(), &folder.join("run")).join("report.html")
}

fn run(folder: &Path) -> PathBuf {
    trained(folder, &["biped-2", "running"])
}

fn neat(folder: &Path) -> PathBuf {
    trained(folder, &["apod", "running", "--strategy", "neat"])
}

pub(crate) fn front(folder: &Path) -> PathBuf {
    let objectives = r#"movement.objectives=[{"term":"running"},{"term":"energy","weight":-0.5}]"#;
    trained(folder, &["tetrapod-1", "running", "--strategy", "nsga2", "--set", objectives])
}

fn terrain(folder: &Path) -> PathBuf {
    trained(folder, &["tetrapod-2", "running", "--terrain", "mixture"])
}

fn swimming(folder: &Path) -> PathBuf {
    trained(folder, &["apod", "swimming"])
}

fn replay(folder: &Path) -> PathBuf {
    trained(folder, &["biped-1", "jumping", "--no-report"]);
    let page = folder.join("replay.html");
    let mut program = Command::new(env!("CARGO_BIN_EXE_gambol"));
    let ended = program.arg("replay").arg(folder.join("run")).arg("--html").arg(&page).output().expect("it starts");
    assert!(ended.status.success(), "{}", String::from_utf8_lossy(&ended.stderr));
    page
}

fn configured(folder: &Path, config: &Value) -> PathBuf {
    let path = folder.join("config.json");
    fs::write(&path, config.to_string()).expect("a temporary folder");
    let out = folder.join("run");
    gambol(&["train", "--config", path.to_str().expect("a plain path")], &out).join("report.html")
}

fn stages(folder: &Path) -> PathBuf {
    configured(
        folder,
        &json!({
            "creature": "biped-1",
            "movement": { "name": "running", "steps": 60 },
            "strategy": { "cma-es": { "population": 8 } },
            "stop": { "generations": 20 },
            "stages": [
                { "name": "run", "promotion": { "generations": 8 } },
                { "name": "jump", "changes": { "movement": { "name": "jumping", "steps": 40 } } }
            ]
        }),
    )
}

/// A creature whose names are scripts.
pub(crate) fn hostile(folder: &Path) -> PathBuf {
    let script = "</script><script>window.hostile=1</script>";
    let image = "<img src=x onerror=window.hostile=1>";
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../creatures/shipped/biped-1.json");
    let text = fs::read_to_string(shipped).expect("it is there");
    let mut creature: Value = serde_json::from_str(&text).expect("JSON");
    // The name is a file's as well: letters, digits and little else. Title and parts may be called anything.
    creature["title"] = format!("{image}{{{{SCRIPT}}}}").into();
    let names = [1, 2].map(|part| creature["parts"][part]["name"].as_str().expect("a name").to_owned());
    let quoted = |name: &str| json!(name).to_string();
    let renamed =
        creature.to_string().replace(&quoted(&names[0]), &quoted(image)).replace(&quoted(&names[1]), &quoted(script));
    let path = folder.join("hostile.json");
    fs::write(&path, renamed).expect("a temporary folder");
    trained(folder, &[path.to_str().expect("a plain path"), "running"])
}

fn comparison(folder: &Path) -> PathBuf {
    let compare = ["compare", "--strategies", "ga,neat,cma-es", "--creatures", "biped-1,apod", "--seeds", "3"];
    let small = ["--set", "movement.steps=40", "--evaluations", "300"];
    gambol(&[&compare[..], &small].concat(), &folder.join("comparison")).join("comparison.html")
}

fn reproduction(folder: &Path) -> PathBuf {
    let small = ["--creatures", "biped-1", "--movements", "jumping", "--runs", "2", "--generations", "3"];
    gambol(&[&["reproduce", "thesis"], &small[..]].concat(), &folder.join("thesis")).join("index.html")
}
