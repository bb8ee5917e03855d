//! Every strategy gets what conventional neuroevolution gets: repeatable runs, exact resumption, champions that verify.

use crate::{
    damage::json,
    folder::{assert_same_run, read},
    program::{assert_says, fail, gambol, succeed, text},
};
use std::{fs, path::Path, process::Command};

type Outcome = Result<(), Box<dyn std::error::Error>>;

const STRATEGIES: [&str; 9] =
    ["ga", "neat", "cma-es", "open-es", "cosyne", "nsga2", "ars", "hill-climbing", "random-search"];

fn small_run(strategy: &str, folder: &Path, generations: u32) -> Command {
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--strategy", strategy, "--population", "20", "--set", "movement.steps=60"]);
    train.args(["--quiet", "--generations"]).arg(generations.to_string()).arg("--out").arg(folder);
    train
}

#[test]
fn a_run_is_the_same_on_other_threads_and_after_a_pause() -> Outcome {
    for strategy in STRATEGIES {
        let folder = tempfile::tempdir()?;
        let (whole, broken) = (folder.path().join("whole"), folder.path().join("broken"));
        succeed(small_run(strategy, &whole, 12).args(["--threads", "2", "--no-report"]));
        succeed(small_run(strategy, &broken, 5).args(["--threads", "1", "--no-report"]));
        succeed(gambol("resume").arg(&broken).args([
            "--generations",
            "12",
            "--no-report",
            "--quiet",
            "--threads",
            "1",
        ]));
        assert_same_run(&whole, &broken);
        assert_says(&succeed(gambol("verify").arg(whole.join("champion.json"))), &["identical"]);
    }
    Ok(())
}

#[test]
fn another_seed_is_another_run() -> Outcome {
    for strategy in STRATEGIES {
        let folder = tempfile::tempdir()?;
        let (one, two) = (folder.path().join("one"), folder.path().join("two"));
        succeed(small_run(strategy, &one, 2).arg("--no-report"));
        succeed(small_run(strategy, &two, 2).args(["--no-report", "--seed", "2"]));
        assert_ne!(read(&one.join("log.jsonl")), read(&two.join("log.jsonl")), "{strategy}");
    }
    Ok(())
}

#[test]
fn the_report_of_every_strategy_can_be_made_and_names_it() -> Outcome {
    for strategy in STRATEGIES {
        let name = if strategy == "ga" { "conventional" } else { strategy };
        let folder = tempfile::tempdir()?;
        let run = folder.path().join("run");
        succeed(&mut small_run(strategy, &run, 4));
        let page = String::from_utf8(read(&run.join("report.html")))?;
        assert_says(&page, &[&format!("\"{name}\"")]);
        assert_eq!(json(&run.join("champion.json"))["content"]["strategy"], name);
    }
    Ok(())
}

#[test]
fn they_are_listed_and_a_misspelt_one_is_corrected() -> Outcome {
    assert_says(
        &succeed(&mut gambol("strategies")),
        &[
            "conventional (or ga)",
            "neat",
            "cma-es",
            "open-es",
            "cosyne",
            "nsga2",
            "ars",
            "hill-climbing",
            "random-search",
        ],
    );
    let listed: serde_json::Value = serde_json::from_str(&succeed(gambol("strategies").arg("--json")))?;
    assert_eq!(listed.as_array().map(Vec::len), Some(STRATEGIES.len()));
    let message = fail(gambol("train").args(["biped-1", "running", "--strategy", "naet"]));
    assert_says(&message, &["there is no strategy \"naet\"; did you mean \"neat\"?"]);
    Ok(())
}

#[test]
fn a_file_may_name_a_strategy_and_only_the_settings_that_differ() -> Outcome {
    let folder = tempfile::tempdir()?;
    let (file, run) = (folder.path().join("neat.json"), folder.path().join("run"));
    std::fs::write(
        &file,
        r#"{"strategy": {"neat": {"recurrent": true, "population": 20}}, "movement": {"steps": 60}}"#,
    )?;
    let train = |more: &[&str]| {
        let mut train = gambol("train");
        train.args(["biped-1", "running", "--quiet", "--no-report", "--generations", "1", "--config"]).arg(&file);
        train.args(more);
        train
    };
    succeed(train(&[]).arg("--out").arg(&run));
    let neat = &json(&run.join("config.json"))["content"]["strategy"]["neat"];
    assert_eq!((&neat["recurrent"], &neat["population"]), (&true.into(), &20.into()));
    // What is said on the command line wins, also over a file that says another strategy.
    let other = folder.path().join("other");
    succeed(train(&["--strategy", "ga", "--population", "6"]).arg("--out").arg(&other));
    assert_eq!(json(&other.join("config.json"))["content"]["strategy"]["conventional"]["population"], 6);
    Ok(())
}

/// After `train biped-1 running`: a strategy, a setting, and what the message says.
#[rustfmt::skip]
const WRONG: &[(&str, &str, &str)] = &[
    ("neat", "mutation.add_node=2",                 "strategy.neat.mutation.add_node = 2: must be from 0 to 1"),
    ("neat", "population=8",                        "strategy.neat.speciation.target.species = 5: must be at least 1 and at most 4, half of"),
    ("neat", "speciation.threshold=-1",             "strategy.neat.speciation.threshold = -1: must be from 0.001 to 1000"),
    ("neat", "hidden_activations=[\"tanhh\"]",      "strategy.neat.hidden_activations[0]: unknown variant `tanhh`"),
    ("neat", "hidden_activations=[\"tanhh\"]",      "did you mean `tanh`?"),
    ("cma-es", "step_size=0",                       "strategy.cma-es.step_size = 0: must be from 0.000001 to 1000"),
    ("cma-es", "population=1",                      "strategy.cma-es.population = 1: must be from 2 to 1000000"),
    ("cma-es", "restart=bopop",                     "did you mean `bipop`?"),
    ("open-es", "population=3",                     "strategy.open-es.population = 3: must be even, from 2 to 1000000"),
    ("open-es", "adam.momentum=1",                  "strategy.open-es.adam.momentum = 1: must be from 0 to below 1"),
    ("cma-es", "step_size=1e-10",                   "strategy.cma-es.step_size = 0.0000000001: must be from 0.000001 to 1000"),
    ("open-es", "deviation=1e-300",                 "must be from 0.000001 to 1000"),
    ("cosyne", "parents=0",                         "strategy.cosyne.parents = 0: must be above 0 and at most 1"),
    ("cosyne", "popultion=3",                       "did you mean `population`?"),
    ("ars", "population=3",                         "strategy.ars.population = 3: must be even, from 2 to 1000000"),
    ("ars", "top_directions=0",                     "strategy.ars.top_directions = 0: must be above 0 and at most 1"),
    ("hill-climbing", "mutation_rate=2",            "strategy.hill-climbing.mutation_rate = 2: must be from 0 to 1"),
    ("random-search", "population=0",               "strategy.random-search.population = 0: must be from 1 to 1000000"),
    ("nsga2", "population=3",                       "strategy.nsga2.population = 3: must be from 4 to 10000"),
    ("nsga2", "parents_agian=false",                "did you mean `parents_again`?"),
];

#[test]
fn a_wrong_setting_is_named_with_its_range() {
    for (strategy, setting, says) in WRONG {
        let mut train = gambol("train");
        train.args(["biped-1", "running", "--strategy", strategy, "--set", &format!("strategy.{strategy}.{setting}")]);
        assert_says(&fail(&mut train), &[says]);
    }
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--strategy", "ga", "--set", "strategy.neat.recurrent=true"]);
    assert_says(&fail(&mut train), &["the strategy is \"conventional\"; choose the other one with --strategy neat"]);
}

/// Three inputs and two outputs for the biped, in a file; `what` is changed in it.
fn topology(file: &Path, what: &str, into: &str) -> Command {
    let text = r#"{"topology": {"inputs": ["rotation of torso", "angle of left leg", "angle of right leg"],
        "outputs": ["speed of left leg", "speed of right leg"], "net": {"graph": {"inputs": 3, "recurrent": false,
        "neurons": [{"activation": "tanh", "bias": true, "sources": [0]},
                    {"activation": "tanh", "bias": true, "sources": [3, 1]}], "outputs": [3, 4]}}}}"#;
    assert!(text.contains(what), "{what}");
    std::fs::write(file, text.replacen(what, into, 1)).expect("a file");
    let mut train = gambol("train");
    train.args(["biped-1", "running", "--preset", "thesis", "--strategy", "cma-es", "--config"]).arg(file);
    train
}

#[test]
fn a_topology_that_is_no_net_is_refused() -> Outcome {
    let folder = tempfile::tempdir()?;
    let file = folder.path().join("topology.json");
    for (what, into, says) in [
        (
            "[0]}",
            "[4]}",
            "neurons[0].sources[0] = 4: must be below 3, the node of this neuron: a net that is not recurrent",
        ),
        ("[3, 1]", "[3, 9]", "neurons[1].sources[1] = 9: must be below 5, the number of nodes"),
        ("[3, 1]", "[1, 1]", "neurons[1].sources[1] = 1: must be listed once"),
        ("\"tanh\"", "\"tan\"", "topology.net.graph.neurons[0].activation: unknown variant `tan`"),
        ("\"outputs\": [3, 4]", "\"outputs\": [3, 0]", "outputs[1] = 0: must be a neuron, from 3 to 4"),
        ("\"rotation of torso\", ", "", "topology.inputs = 2 names: must be 3 names"),
        ("rotation of torso", "mood", "only the topology has \"mood\", only the creature has \"rotation of torso\""),
    ] {
        assert_says(&fail(&mut topology(&file, what, into)), &[says]);
    }
    Ok(())
}

#[test]
fn the_weights_of_a_found_topology_can_be_searched() -> Outcome {
    let folder = tempfile::tempdir()?;
    let found = folder.path().join("found");
    succeed(small_run("neat", &found, 6).arg("--no-report"));
    let champion = found.join("champion.json");
    for strategy in ["ga", "cma-es", "open-es", "cosyne", "nsga2"] {
        let run = folder.path().join(strategy);
        succeed(small_run(strategy, &run, 3).arg("--topology-from").arg(&champion));
        let (old, new) = (json(&champion), json(&run.join("champion.json")));
        assert_eq!(new["content"]["network"]["shape"], old["content"]["network"]["shape"], "{strategy}");
        assert_ne!(new["content"]["network"]["weights"], old["content"]["network"]["weights"], "{strategy}");
        assert_says(&succeed(gambol("verify").arg(run.join("champion.json"))), &["identical"]);
        // The folder alone repeats it.
        let again = folder.path().join(format!("{strategy}-again"));
        let config = run.join("config.json");
        succeed(gambol("train").args(["--quiet", "--no-report", "--config"]).arg(config).arg("--out").arg(&again));
        assert_eq!(read(&run.join("champion.json")), read(&again.join("champion.json")), "{strategy}");
    }
    Ok(())
}

#[test]
fn neat_finds_one_net_for_all_limbs() -> Outcome {
    let folder = tempfile::tempdir()?;
    let path = |name: &str| folder.path().join(name);
    let train = |name: &str, creature: &str, generations: &str| {
        let mut train = gambol("train");
        train.args([creature, "running", "--strategy", "neat", "--population", "12", "--generations", generations]);
        train.args(["--set", "movement.steps=60", "--quiet", "--out"]).arg(path(name));
        train
    };
    let stop = |train: &mut Command| succeed(train.arg("--no-report"));
    stop(train("whole", "tetrapod-2", "9").args(["--threads", "2"]));
    stop(train("broken", "tetrapod-2", "4").args(["--threads", "1"]));
    succeed(gambol("resume").arg(path("broken")).args(["--generations", "9", "--no-report", "--quiet"]));
    assert_same_run(&path("whole"), &path("broken"));
    assert_says(&succeed(gambol("verify").arg(path("whole"))), &["identical"]);
    // Every leg has as many weights: copies of one net.
    let shape = json(&path("whole").join("champion.json"))["content"]["network"]["shape"].clone();
    let neurons = shape["neurons"].as_array().map_or(0, Vec::len);
    assert!(neurons >= 8 && neurons.is_multiple_of(4), "{neurons} neurons");
    // What it knows is of use to a body with more legs, whose parts have other names.
    let hexapod = concat!(env!("CARGO_MANIFEST_DIR"), "/../examples/creatures/hexapod.json");
    succeed(train("hexapod", hexapod, "2").arg("--allow-loss").arg("--from").arg(path("whole")));
    let legs = json(&path("hexapod").join("champion.json"))["content"]["outputs"].as_array().map_or(0, Vec::len);
    assert!(legs > 8, "{legs} motors");
    let report = fs::read_to_string(path("hexapod").join("report.html"))?;
    assert_says(&report, &["evolves, feed-forward, copied for each limb"]);
    let message = fail(
        train("one-net", "tetrapod-2", "2")
            .args(["--set", "controller.modular=null", "--allow-loss", "--from"])
            .arg(path("whole")),
    );
    assert_says(
        &message,
        &[
            "controller.modular = one net: must be a net for each limb, as before: a net that neat has found for the one",
        ],
    );
    assert!(!path("one-net").exists());
    // What legs that act together hear besides would be lost.
    stop(train("together", "tetrapod-2", "2").args(["--set", "controller.modular=together"]));
    let message = fail(
        train("alternating", "tetrapod-2", "2")
            .args(["--set", "controller.modular=alternating", "--from"])
            .arg(path("together")),
    );
    assert_says(&message, &[", by place\"", "what was learned with it would be lost"]);
    // A checkpoint of another body is none of this run.
    fs::copy(path("hexapod").join("checkpoint"), path("whole").join("checkpoint"))?;
    let message = fail(gambol("resume").arg(path("whole")).args(["--generations", "20", "--no-report"]));
    assert_says(&message, &["the nets that it searches"]);
    Ok(())
}

#[test]
fn a_topology_for_another_creature_is_refused_with_what_differs() -> Outcome {
    let folder = tempfile::tempdir()?;
    let found = folder.path().join("found");
    succeed(small_run("neat", &found, 1).args(["--preset", "thesis", "--no-report"]));
    let champion = found.join("champion.json");
    let train = |creature: &str, strategy: &str| {
        let mut train = gambol("train");
        train
            .args([creature, "running", "--preset", "thesis", "--strategy", strategy, "--topology-from"])
            .arg(&champion);
        train
    };
    let message = fail(&mut train("biped-2", "cma-es"));
    assert_says(
        &message,
        &["the topology does not fit the creature: it has 3 inputs, the creature has 5", "only the creature has"],
    );
    let message = fail(&mut train("biped-1", "neat"));
    assert_says(&message, &["topology: neat finds its own, and cannot keep one"]);
    let message = fail(gambol("train").args(["biped-2", "running", "--topology-from"]).arg(&found));
    assert_says(&message, &["the topology does not fit the creature"]);
    let message = fail(gambol("train").args(["biped-1", "running", "--topology-from", "nowhere.json"]));
    assert_says(&message, &["nowhere.json"]);
    let config = found.join("config.json");
    let message = fail(gambol("train").args(["biped-1", "running", "--topology-from", text(&config)]));
    assert_says(&message, &["config.json"]);
    Ok(())
}

#[test]
fn searches_too_large_for_any_machine_are_refused_at_once() {
    for (arguments, says) in [
        (
            &["--strategy", "cma-es", "--set", "strategy.cma-es.covariance=full", "--set", "controller.hidden=[2000]"]
                [..],
            "strategy.cma-es.covariance = full for 12002 weights: must be separable for nets of more than 4096 weights",
        ),
        (
            &["--strategy", "cosyne", "--population", "100000", "--set", "controller.hidden=[500,500]"],
            "strategy.cosyne.population = 100000: must be at most 1058 for nets of 253502 weights",
        ),
        (
            &[
                "--strategy",
                "neat",
                "--population",
                "1000000",
                "--set",
                "strategy.neat.start={\"hidden-layer\":{\"neurons\":4096}}",
            ],
            "strategy.neat.population = 1000000: must be at most 3275, since each starts with up to 20486 connections",
        ),
    ] {
        let train = ["biped-1", "running", "--preset", "thesis"];
        assert_says(&fail(gambol("train").args(train).args(arguments)), &[says]);
    }
}
