//! The report: one file that needs nothing else.

use crate::program::{gambol, small_run, succeed};
use serde_json::Value;
use std::fs;

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// The page refers to nothing outside itself. The name of SVG looks like an address, but is never fetched.
#[track_caller]
pub(crate) fn assert_stands_alone(page: &str) {
    let page = page.replace("http://www.w3.org/2000/svg", "");
    for reference in ["http:", "https:", "=\"//", "src=", "@import", "url(/", "url(\"", "fetch("] {
        assert!(!page.contains(reference), "the page has a reference: {reference}");
    }
}

/// The data in the page.
#[track_caller]
pub(crate) fn data(page: &str) -> Value {
    let (_, rest) = page.split_once(r#"<script type="application/json" id="run">"#).expect("a place for data");
    let (data, _) = rest.split_once("</script>").expect("its end");
    serde_json::from_str(data).expect("JSON")
}

#[test]
fn a_report_stands_alone_and_holds_the_run() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    // With the thesis' preset nothing ends an episode early.
    let mut train = small_run(&path, 4);
    succeed(train.args(["--preset", "thesis", "--quiet", "--set", "record.populations_at=[1,3,9]"]));
    succeed(gambol("report").arg(&path));
    let page = fs::read_to_string(path.join("report.html"))?;
    assert_stands_alone(&page);
    let data = data(&page);
    assert_eq!(data["history"].as_array().map(Vec::len), Some(4));
    assert_eq!(data["champion"]["replay"]["frames"], 61);
    assert_eq!(data["config"]["seed"], 1);
    let gait = &data["gait"];
    assert_eq!((&gait["judged_as"], &gait["verdict"]["usable"]), (&"running".into(), &false.into()));
    assert_eq!(gait["window"], serde_json::json!({ "from_s": 30.0, "to_s": gait["duration_s"] }));
    assert_eq!(gait["legs"].as_array().map(Vec::len), Some(2));
    let sheet = gait["sheet"].as_str().expect("a contact sheet");
    assert!(sheet.starts_with("data:image/png;base64,iVBORw0KGgo"), "{}", &sheet[..60]);
    assert!(sheet.len() < 200_000, "{} bytes", sheet.len());
    let reasons = |list: &Value| list.as_array().map(Vec::len);
    assert_eq!(reasons(&gait["against"]), reasons(&gait["verdict"]["reasons"]));
    assert!(data["strip"].as_array().is_some_and(|strip| !strip.is_empty()));
    let populations = data["populations"].as_array().expect("a list");
    assert_eq!(populations.len(), 2, "generations 1 and 3");
    Ok(())
}

#[test]
fn a_report_of_neat_holds_the_net_it_found_its_species_and_its_numbers() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--strategy", "neat", "--population", "20", "--set", "movement.steps=60"]);
    succeed(train.args(["--quiet", "--generations", "6", "--out"]).arg(&path));
    let page = fs::read_to_string(path.join("report.html"))?;
    assert_stands_alone(&page);
    let data = data(&page);
    let network = &data["champion"]["network"];
    let nodes = network["nodes"].as_array().map(Vec::len).expect("a list");
    assert!(network["connections"].as_array().is_some_and(|connections| !connections.is_empty()));
    let activations = network["activations"].as_array().expect("a list");
    assert_eq!(data["champion"]["replay"]["frames"], activations.len());
    assert!(activations.iter().all(|frame| frame.as_array().map(Vec::len) == Some(nodes)));
    let species = data["species"].as_array().expect("a list");
    for row in 0..6_usize {
        let size = |species: &Value| {
            let row = row.checked_sub(usize::try_from(species["start"].as_u64()?).ok()?)?;
            species["sizes"][row].as_u64()
        };
        let members: u64 = species.iter().filter_map(size).sum();
        assert_eq!(members, 20, "generation {}", row + 1);
    }
    let statistics = data["statistics"].as_array().expect("a list");
    assert!(statistics.iter().any(|statistic| statistic["name"] == "compatibility_threshold"));
    assert!(statistics.iter().all(|statistic| statistic["values"].as_array().map(Vec::len) == Some(6)));
    Ok(())
}

#[test]
fn a_run_without_species_has_none_in_its_report() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = folder.path().join("run");
    succeed(small_run(&path, 2).arg("--quiet"));
    succeed(gambol("report").arg(&path));
    let data = data(&fs::read_to_string(path.join("report.html"))?);
    assert_eq!(data["species"], serde_json::json!([]));
    assert!(data["statistics"].as_array().is_some_and(|statistics| !statistics.is_empty()));
    Ok(())
}

/// What a creature's author writes is shown, and never run.
#[test]
fn text_from_a_creature_file_cannot_break_the_page() -> Outcome {
    let folder = tempfile::tempdir()?;
    let creature = folder.path().join("sly.json");
    let sly = "</script><script src=\\\"https://evil\\\">{{DATA}}";
    let json = creatures::shipped()[0].json.replacen("\"title\": \"", &format!("\"title\": \"{sly}"), 1);
    fs::write(&creature, json)?;
    let path = folder.path().join("run");
    let mut train = gambol("train");
    train.arg(&creature).args(["running", "--population", "4", "--set", "movement.steps=20", "--generations", "1"]);
    succeed(train.arg("--out").arg(&path));
    let page = fs::read_to_string(path.join("report.html"))?;
    assert!(!page.contains("<script src"), "the title became a script");
    assert!(data(&page)["creature"]["title"].as_str().is_some_and(|title| title.starts_with("</script>")));
    Ok(())
}
