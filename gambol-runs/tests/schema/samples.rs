//! Configurations in which every number of the schema stands somewhere, and every bound of a range is fine somewhere.

use crate::text_value;
use creatures::{Blueprint, Creature};
use gambol_runs::{Registry, Setup, config::RunConfig, shaping::Stages};
use ne_net::Topology;
use serde_json::{Value, json};
use std::sync::LazyLock;

/// A valid value.
pub(crate) struct Sample {
    pub(crate) name: String,
    pub(crate) value: Value,
    /// Where the schema has its schema: a JSON pointer.
    pub(crate) definition: &'static str,
    /// The library's own check of it.
    pub(crate) check: fn(&Value) -> Result<(), String>,
}

/// Made once: it reads the files of all creatures.
static REGISTRY: LazyLock<Registry> = LazyLock::new(Registry::default);

/// As the preset without anything special has it.
pub(crate) fn plain(creature: &str, movement: &str) -> RunConfig {
    let creature = creatures::find(creature).expect("shipped");
    REGISTRY.config("plain", creature, movement).expect("there is such a preset")
}

/// Reads a configuration from its text, as files are read, and builds it.
pub(crate) fn check_config(value: &Value) -> Result<(), String> {
    let config: RunConfig = serde_json::from_str(&value.to_string()).map_err(|error| error.to_string())?;
    Setup::new(&config, &REGISTRY).map_err(|error| error.to_string())?;
    Stages::new(&config, &REGISTRY).map_err(|error| error.to_string())?;
    Ok(())
}

fn check_topology(value: &Value) -> Result<(), String> {
    serde_json::from_str::<Topology>(&value.to_string()).map(drop).map_err(|error| error.to_string())
}

fn check_creature(value: &Value) -> Result<(), String> {
    let creature: Creature = serde_json::from_str(&value.to_string()).map_err(|error| error.to_string())?;
    Blueprint::new(creature).map(drop).map_err(|error| error.to_string())
}

/// Lays fields over an object: objects are merged, all else is replaced.
fn lay_over(base: &mut Value, layer: Value) {
    match (base, layer) {
        (Value::Object(base), Value::Object(layer)) => {
            for (key, value) in layer {
                lay_over(base.entry(key).or_insert(Value::Null), value);
            }
        }
        (base, layer) => *base = layer,
    }
}

/// A small configuration with these changes.
fn changed(changes: Value) -> Value {
    let mut value = text_value(&plain("biped-1", "running"));
    lay_over(
        &mut value,
        json!({ "movement": { "steps": 10 }, "controller": { "hidden": [] }, "sensors": ["torso-rotation"] }),
    );
    if changes.get("strategy").is_some() {
        value["strategy"] = Value::Null;
    }
    lay_over(&mut value, changes);
    value
}

/// A small configuration with the default settings of this strategy, but for these.
fn strategy(name: &str, changes: &Value) -> Value {
    let registry = Registry::default();
    let settings = registry.strategies.find(name).expect("there is such a strategy").settings();
    let text = serde_json::to_string(settings.settings()).expect("plain data");
    let mut settings: Value = serde_json::from_str(&text).expect("JSON");
    for (field, change) in changes.as_object().expect("fields") {
        // A choice takes the place of another.
        if change.as_object().is_some_and(|choice| choice.len() == 1) && field != "speciation" {
            settings[field] = Value::Null;
        }
        lay_over(&mut settings[field], change.clone());
    }
    changed(json!({ "strategy": { name: settings } }))
}

pub(crate) fn samples(registry: &Registry) -> Vec<Sample> {
    let configs = everyday().into_iter().chain(strategies()).chain([
        ("as told".into(), given_commands()),
        ("until the highest tier".into(), highest_tier()),
        ("stages".into(), stages()),
        ("a painted creature".into(), painted_creature([0.0, 0.0])),
        ("a topology".into(), with_topology(registry)),
    ]);
    let configs = configs.map(|(name, value)| Sample { name, value, definition: "", check: check_config });
    let topologies = topologies(registry).into_iter().map(|value| Sample {
        name: "a topology alone".into(),
        value,
        definition: "/$defs/Topology",
        check: check_topology,
    });
    // Neither stands on the ground.
    let creatures = [[99.5, 98.7], [-99.5, -100.3]].map(|place| Sample {
        name: format!("a creature at {place:?}"),
        value: painted_creature(place)["creature"].clone(),
        definition: "/$defs/Creature",
        check: check_creature,
    });
    configs.chain(topologies).chain(creatures).collect()
}

fn everyday() -> Vec<(String, Value)> {
    let all_sensors = json!([
        "torso-rotation",
        { "rangefinder": { "angles": [-30, 0], "length": 3 } },
        { "clock": { "period": 1 } },
        { "next-gap": { "length": 4 } },
        { "landing-clock": { "period": 1 } },
        { "commanded-speed": { "top": 3 } },
        "jump-command",
        { "stride-clock": { "period": 0.5, "top": 3 } },
        { "jump-clock": { "period": 0.5 } },
    ]);
    let obstacles = json!([
        { "gaps": { "width": 0.1, "spacing": 1 } },
        { "hurdles": { "height": 0.1, "spacing": 1 } },
        { "stairs": { "rise": 0.1, "tread": 0.5, "spacing": 1 } },
        { "slopes": { "degrees": 10, "spacing": 1 } },
        { "rough": { "height": 0.1, "spacing": 1 } },
    ]);
    let origin = json!({
        "source": "elsewhere", "transferred": "champion", "strategy": "cma-es", "generation": 1, "weights_kept": 1,
        "weights_new": 1, "weights_lost": 1,
    });
    let variation = json!({
        "friction": 0.1, "mass": 0.1, "torque": 0.1, "start_pose": 0.05, "bumps": 0.02, "gravity": 0.1, "torso_spin": 0.1,
        "pushes": 0.1, "solver_iterations": [1, 4],
    });
    let stop = json!({
        "generations": 3, "evaluations": 3, "steps": 3, "minutes": 1.5, "target": 1.0, "tier": 1, "stagnation": 3,
    });
    let factors = |factor: f64| {
        let two = [factor; 2];
        changed(json!({ "variation": {
            "motor_gain": two, "joint_frequency": two, "contact_frequency": two, "contact_damping": two,
        } }))
    };
    let water = |water: Value| {
        let mut value = text_value(&plain("apod", "swimming"));
        lay_over(&mut value, json!({ "physics": { "water": water } }));
        value
    };
    vec![
        ("little".into(), changed(json!({ "controller": { "hidden": [3] } }))),
        ("little in two layers".into(), changed(json!({ "controller": { "hidden": [1, 1] } }))),
        (
            "all the physics".into(),
            changed(json!({ "physics": { "contact_frequency": 61, "contact_damping_ratio": 9 } })),
        ),
        (
            "much".into(),
            changed(json!({
                "controller": { "actuation": { "angle": { "gain": 10 } } },
                "training_steps": 100,
                "trials": { "count": 4 },
                "stop": stop,
                "commands": { "random": {
                    "still": 1, "hold": [2, 5], "speeds": [0.5, 1.5], "standing": 0.25, "backwards": 0, "jumps": 0.3, "press": 0.2,
                } },
                "terrain": { "obstacles": obstacles, "difficulty": 0.5, "seed": 1, "length": 10, "run_up": 1, "jitter": 0.3 },
                "sensors": all_sensors,
                "origin": origin,
            })),
        ),
        (
            "drawn box".into(),
            changed(json!({ "terrain": { "drawn": [{ "box": { "from": 2, "width": 1, "height": 0.2 } }] } })),
        ),
        ("drawn gap".into(), changed(json!({ "terrain": { "drawn": [{ "gap": { "from": 2, "width": 0.5 } }] } }))),
        (
            "drawn slope".into(),
            changed(json!({ "terrain": { "drawn": [{ "slope": { "from": 2, "width": 50, "rise": -0.5 } }] } })),
        ),
        (
            "drawn terrain".into(),
            changed(json!({ "terrain": { "drawn": [
            { "box": { "from": 2, "width": 1, "height": 0.2 } }, { "gap": { "from": 4, "width": 0.5 } },
            { "slope": { "from": 6, "width": 2, "rise": -0.5 } },
        ] } })),
        ),
        (
            "rungs".into(),
            changed(json!({
                "trials": { "count": 4 },
                "rungs": [{ "steps": 5, "trials": 2, "share": 0.5 }],
            })),
        ),
        (
            "rungs as long as can be".into(),
            changed(json!({
                "movement": { "steps": 1_000_000 },
                "trials": { "count": 1000 },
                "rungs": [{ "steps": 1000, "trials": 1, "share": 0.5 }, { "steps": 1000, "share": 0.5, "trials": 1000 }],
            })),
        ),
        ("varied".into(), changed(json!({ "variation": variation }))),
        (
            "varied by factors".into(),
            changed(json!({ "variation": {
                "time_step": [0.9, 1.1], "motor_gain": [0.9, 1.1], "joint_frequency": [0.9, 1.1],
                "contact_frequency": [0.9, 1.1], "contact_damping": [0.9, 1.1],
            } })),
        ),
        ("varied by small factors".into(), factors(0.1)),
        ("varied by large factors".into(), factors(100.0)),
        (
            "varied by shares".into(),
            changed(json!({ "variation": {
                "time_step": 0.1, "motor_gain": 0.1, "joint_frequency": 0.1, "contact_frequency": 0.1, "contact_damping": 0.1,
            } })),
        ),
        ("in water".into(), water(json!({ "density": 100, "drag": 1, "slip": 0.05 }))),
        ("in thin water".into(), water(json!({ "drag": 1, "slip": 0 }))),
        ("in thick water".into(), water(json!({ "drag": 10, "slip": 0.05 }))),
    ]
}

/// A run that goes on until its champion has the highest tier.
fn highest_tier() -> Value {
    let creature = creatures::find("tetrapod-2").expect("shipped");
    let mut value = text_value(&REGISTRY.config("default", creature, "playing").expect("there is such a preset"));
    lay_over(&mut value, json!({ "stop": { "tier": 23 } }));
    value
}

fn given_commands() -> Value {
    changed(json!({ "commands": { "given": [{ "time": 0, "speed": 1 }, { "time": 4, "speed": 1, "jump": true }] } }))
}

fn stages() -> Value {
    let rules = json!([
        "usable",
        { "tier": 1 },
        { "fitness": 20 },
        { "share": { "fitness": 20, "of": 0.5 } },
        { "measurement": { "name": "duration", "at_least": 1 } },
        { "measurement": { "name": "duration", "at_most": 1 } },
        { "stagnation": 30 },
        { "generations": 30 },
        { "evaluations": 30 },
        { "steps": 30 },
        { "not": { "generations": 30 } },
    ]);
    let give_up = json!({ "when": { "generations": 50 }, "back_to": "first", "times": 2 });
    changed(json!({
        "variation": { "friction": 0.1 },
        "stages": [{ "name": "first", "promotion": { "any": rules } }, { "name": "second", "give_up": give_up }],
    }))
}

/// So far from the usual place, m.
fn painted_creature([x, y]: [f64; 2]) -> Value {
    let mut value = changed(json!({}));
    let decorations = json!([
        { "form": { "ellipse": { "centre": [0, 0], "radii": [0.1, 0.1], "angle": 1 } }, "width": 0.01 },
        { "form": { "rectangle": { "centre": [0, 0], "size": [0.1, 0.1], "corner_radius": 0.01, "angle": 1 } } },
        { "form": { "polygon": { "points": [[0, 0], [1, 0], [0, 1]] } } },
        { "form": { "line": { "points": [[0, 0], [1, 0]] } } },
    ]);
    let look = json!({ "layer": 1, "corner_radius": 0.01, "opacity": 0.5, "decorations": decorations });
    value["creature"] = json!({
        "format": "gambol creature",
        "version": 1,
        "name": "sample",
        "parts": [
            {
                "name": "torso", "tag": "torso", "density": 10, "friction": 1, "position": [x, y + 1.0], "angle": 0,
                "shape": { "box": { "width": 1, "height": 0.2 } }, "look": look,
            },
            {
                "name": "leg", "tag": "leg", "density": 10, "position": [x, y + 0.6],
                "shape": { "capsule": { "length": 0.6, "radius": 0.05 } },
            },
            { "name": "ball", "tag": "ball", "density": 10, "position": [x + 0.5, y + 1.1], "shape": { "circle": { "radius": 0.1 } } },
        ],
        "joints": [
            {
                "parent": "torso", "child": "leg", "anchor": [x, y + 0.9], "limits": [-60, 60],
                "motor": { "top_speed": 5, "top_torque": 50 },
            },
            { "parent": "torso", "child": "ball", "anchor": [x + 0.5, y + 1.1], "limits": [-60, 60] },
        ],
    });
    value
}

/// A net of the kind a configuration has by itself, frozen.
fn frozen(config: &RunConfig, registry: &Registry) -> Value {
    let setup = Setup::new(config, registry).expect("valid");
    let names =
        |channels: &[creatures::Channel]| channels.iter().map(|channel| channel.name.clone()).collect::<Vec<_>>();
    let text = serde_json::to_string(&setup.topology).expect("plain data");
    let net: Value = serde_json::from_str(&text).expect("JSON");
    json!({ "inputs": names(setup.inputs()), "outputs": names(setup.outputs()), "net": net })
}

fn with_topology(registry: &Registry) -> Value {
    let mut config = plain("biped-1", "running");
    config.controller.hidden = vec![2];
    let mut value = text_value(&config);
    value["topology"] = frozen(&config, registry);
    value
}

/// Topologies of all kinds, as small and as large as can be.
fn topologies(registry: &Registry) -> Vec<Value> {
    let dense = |inputs: usize, hidden: Value, outputs: usize| json!({ "dense": { "inputs": inputs, "hidden": hidden, "outputs": outputs, "hidden_scale": 3 } });
    let graph = |inputs: usize| {
        json!({
            "inputs": inputs,
            "recurrent": false,
            "neurons": [{ "activation": "tanh", "bias": true, "sources": [0] }],
            "outputs": [inputs],
        })
    };
    let shared = json!({ "shared": {
        "net": {
            "inputs": 1,
            "recurrent": false,
            "neurons": [{ "activation": "tanh", "bias": true, "sources": [0] }, { "activation": "tanh", "bias": true, "sources": [1] }],
            "outputs": [2],
        },
        "groups": [3, 0],
        "weights": [
            { "sum": [[0, 1]] },
            { "sine": { "genes": [0, 1], "factor": 1, "phase": 0, "phase_genes": [[2, 1]] } },
            { "cosine": { "genes": [0, 1], "factor": 1, "phase": 0, "phase_genes": [] } },
            { "affine": { "constant": 1, "terms": [[0, 1]] } },
        ],
    } });
    let copied = |inputs: usize| {
        let copy = |sign: f64| json!({ "senses": [{ "constant": 0, "sources": [[0, 1]] }], "sign": sign });
        json!({ "copied": {
            "small": graph(1),
            "copies": { "inputs": inputs, "outputs": [[0, 0], [1, 0]], "copies": [copy(1.0), copy(-1.0)] },
        } })
    };
    let mut topologies = vec![dense(1, json!([1]), 1), json!({ "graph": graph(1) }), json!({ "graph": graph(4096) })];
    topologies.extend([shared, copied(1), copied(4096)]);
    // As runs have them.
    for preset in ["default", "plain"] {
        let creature = creatures::find("tetrapod-1").expect("shipped");
        let mut config = registry.config(preset, creature, "running").expect("there is such a preset");
        topologies.push(frozen(&config, registry)["net"].clone());
        config.strategy = registry.strategies.find("neat").expect("there is such a strategy").settings();
        topologies.push(frozen(&config, registry)["net"].clone());
    }
    topologies
}

/// Strategies with every choice that has numbers, and with the largest of those on which others depend.
fn strategies() -> Vec<(String, Value)> {
    let mut samples: Vec<(&str, Value)> = vec![
        ("ars", json!({})),
        ("cma-es", json!({ "population": 8, "least_deviation": 1e-9 })),
        ("cma-es", json!({ "step_size": 1000, "least_deviation": 0.1 })),
        ("cma-es", json!({ "greatest_growth": 1, "mean_decay": 0.5 })),
        (
            "conventional",
            json!({ "stagnation_boost": { "patience": 10, "factor": 1.5, "limit": 4 }, "elites": 0, "population": 1_000_000 }),
        ),
        ("conventional", json!({ "elites": 0 })),
        ("cosyne", json!({ "restart": 60 })),
        ("hill-climbing", json!({})),
        ("nsga2", json!({})),
        ("open-es", json!({ "deviation": 1000 })),
        ("open-es", json!({ "least_deviation": 1e-6 })),
        ("random-search", json!({})),
        ("neat", json!({ "restart": 8 })),
        ("neat", json!({ "population": 1_000_000 })),
        ("neat", json!({ "speciation": { "target": null } })),
        (
            "neat",
            json!({ "start": { "partly-connected": { "share": 0.5 } }, "new_weights": { "gaussian": { "deviation": 0.5 } } }),
        ),
        ("neat", json!({ "start": { "hidden-layer": { "neurons": 2 } } })),
    ];
    let minimum = f64::from_bits(1);
    let mutations = [
        json!({ "uniform": { "rate": 0.1, "limit": 0.1 } }),
        json!({ "self-adaptive": { "rate": 0.1, "initial": 0.3, "minimum": minimum, "maximum": 1000, "learning_rate": 1 } }),
        json!({ "self-adaptive": { "initial": minimum, "minimum": minimum, "maximum": 1 } }),
        json!({ "self-adaptive": { "initial": 1000, "minimum": 1, "maximum": 1000 } }),
        json!({ "distributed": { "rate": 0.1, "distribution": { "normal": { "deviation": 0.5 } } } }),
        json!({ "distributed": { "rate": 0.1, "distribution": { "cauchy": { "scale": 0.5 } } } }),
        json!({ "distributed": { "rate": 0.1, "distribution": { "exponential": { "mean": 0.5 } } } }),
        json!({ "distributed": { "rate": 0.1, "distribution": { "log-normal": { "median": 0.5, "spread": 1 } } } }),
    ];
    samples.extend(mutations.map(|mutation| ("conventional", json!({ "mutation": mutation }))));
    let selections = [
        json!({ "rank": { "pressure": 1.5 } }),
        json!({ "truncation": { "share": 0.5 } }),
        json!({ "roulette": {} }),
        json!({ "stochastic-universal": {} }),
    ];
    samples.extend(selections.map(|selection| ("conventional", json!({ "selection": selection }))));
    samples.into_iter().map(|(name, changes)| (format!("{name}: {changes}"), strategy(name, &changes))).collect()
}

/// So many of something.
fn many(count: usize, item: impl Fn(usize) -> Value) -> Value {
    (0..count).map(item).collect()
}

/// A configuration with a list of so many items.
type WithList = fn(usize) -> Value;

/// Lists, by where the schema has them.
pub(crate) const LISTS: &[(&str, WithList)] = &[
    ("/properties/rungs", |count| changed(json!({ "rungs": many(count, |_| json!({ "steps": 5, "share": 0.5 })) }))),
    ("/properties/further_bodies", |count| {
        let creature = text_value(&plain("biped-1", "running"))["creature"].clone();
        changed(json!({ "further_bodies": many(count, |_| creature.clone()) }))
    }),
    ("/properties/sensors", |count| {
        changed(json!({ "sensors": many(count, |index| json!({ "clock": { "period": index + 1 } })) }))
    }),
    ("/$defs/ControllerSettings/properties/hidden", |count| {
        changed(json!({ "controller": { "hidden": many(count, |_| json!(1)) } }))
    }),
    ("/$defs/Terrain/properties/obstacles", |count| {
        changed(json!({ "terrain": { "obstacles": many(count, |_| json!({ "hurdles": {} })) } }))
    }),
    ("/$defs/Terrain/properties/drawn", |count| {
        let gap = |index: usize| json!({ "gap": { "from": 2 * index, "width": 0.5 } });
        changed(json!({ "terrain": { "drawn": many(count, gap) } }))
    }),
    ("/$defs/Commands/oneOf/given", |count| {
        changed(json!({ "commands": { "given": many(count, |index| json!({ "time": index })) } }))
    }),
    ("/$defs/MovementSpec/properties/objectives", |count| {
        let terms = ["energy", "slip", "upright", "vibration", "idleness"];
        changed(json!({ "movement": { "objectives": many(count, |index| json!({ "term": terms[index] })) } }))
    }),
    ("/$defs/PromotionRule/oneOf/any", |count| {
        changed(
            json!({ "stages": [{ "name": "only", "promotion": { "any": many(count, |_| json!({ "steps": 1 })) } }] }),
        )
    }),
    ("/$defs/PromotionRule/oneOf/all", |count| {
        changed(
            json!({ "stages": [{ "name": "only", "promotion": { "all": many(count, |_| json!({ "steps": 1 })) } }] }),
        )
    }),
    ("/$defs/NeatSettings/properties/hidden_activations", |count| {
        strategy("neat", &json!({ "hidden_activations": many(count, |_| json!("tanh")) }))
    }),
];
