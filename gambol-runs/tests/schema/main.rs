//! The JSON Schema of a configuration: what it says is what the library accepts.

mod bounds;
mod samples;

use gambol_runs::{Registry, config::RunConfig, schema::json_schema, strategies::StrategyCatalogue};
use serde_json::{Value, json};

/// A configuration as a file has it.
fn text_value(config: &RunConfig) -> Value {
    let text = serde_json::to_string(config).expect("plain data");
    serde_json::from_str(&text).expect("JSON")
}

fn validator(registry: &Registry) -> jsonschema::Validator {
    jsonschema::validator_for(&json_schema(registry)).expect("the schema is one")
}

fn errors(validator: &jsonschema::Validator, value: &Value) -> Vec<String> {
    validator.iter_errors(value).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

#[test]
fn what_presets_give_keeps_to_the_schema() {
    let registry = Registry::default();
    let validator = validator(&registry);
    for file in creatures::shipped() {
        let creature = creatures::find(file.name).expect("shipped");
        for movement in ["running", "jumping", "playing"] {
            for preset in registry.presets.entries() {
                let config = registry.configure(preset, creature.clone(), movement);
                let errors = errors(&validator, &text_value(&config));
                assert!(errors.is_empty(), "{}, {movement}, {}: {errors:?}", file.name, preset.name);
            }
        }
    }
}

#[test]
fn default_settings_of_strategies_keep_to_the_schema() {
    let registry = Registry::default();
    let validator = validator(&registry);
    let schema = json_schema(&registry);
    let strategies = &schema["$defs"]["StrategySettings"]["properties"];
    assert_eq!(strategies.as_object().expect("strategies").len(), registry.strategies.entries().len());
    for entry in registry.strategies.entries() {
        let mut config = samples::plain("biped-1", "running");
        config.strategy = entry.settings();
        let value = text_value(&config);
        let errors = errors(&validator, &value);
        assert!(errors.is_empty(), "{}: {errors:?}", entry.name());
        let settings = &strategies[entry.name()];
        assert_eq!(settings["default"], value["strategy"][entry.name()], "{}", entry.name());
        assert_eq!(settings["description"], entry.description());
        assert!(settings["$ref"].is_string(), "{} has a schema of its own", entry.name());
    }
}

#[test]
fn strategies_are_those_of_the_registry() {
    let mut strategies = StrategyCatalogue::empty();
    strategies.add::<ne_fixed::CmaEs>("the only one");
    let registry = Registry { strategies, ..Registry::default() };
    let validator = validator(&registry);
    let mut config = text_value(&samples::plain("biped-1", "running"));
    assert_eq!(errors(&validator, &config), Vec::<String>::new());
    config["strategy"] = json!({ "random-search": {} });
    assert!(!validator.is_valid(&config), "not in this registry");
}

#[test]
fn the_schema_catches_slips() {
    let validator = validator(&Registry::default());
    let slips: [fn(&mut Value); 12] = [
        |config| config["sead"] = json!(2),
        |config| config["physics"]["time_step"] = json!(0.0),
        |config| config["physics"]["gravity"] = json!("9.81"),
        |config| config["engine"] = json!("unreal"),
        |config| config["strategy"] = json!("cma-es"),
        |config| config["strategy"] = json!({}),
        |config| config["strategy"] = json!({ "cma": {} }),
        |config| config["strategy"] = json!({ "cma-es": {}, "neat": {} }),
        |config| config["strategy"] = json!({ "cma-es": { "step": 0.5 } }),
        |config| config["variation"]["bumps"] = json!(0.005),
        |config| config["variation"]["time_step"] = json!([1.1, 1.2]),
        |config| config["controller"]["actuation"] = json!({ "angle": { "gain": 100 } }),
    ];
    for (index, slip) in slips.iter().enumerate() {
        let mut config = text_value(&samples::plain("biped-1", "running"));
        assert_eq!(errors(&validator, &config), Vec::<String>::new());
        slip(&mut config);
        assert!(!validator.is_valid(&config), "slip {index}");
    }
}

#[test]
fn every_setting_tells_what_it_is() {
    let schema = json_schema(&Registry::default());
    let mut silent = Vec::new();
    let mut look = |name: &str, object: &Value| {
        for (field, schema) in object["properties"].as_object().into_iter().flatten() {
            if !schema["description"].is_string() {
                silent.push(format!("{name}.{field}"));
            }
        }
    };
    look("RunConfig", &schema);
    for (name, definition) in schema["$defs"].as_object().expect("definitions") {
        look(name, definition);
    }
    assert!(silent.is_empty(), "{silent:?}");
    // None of it is in the language of Rust's documentation.
    let text = schema.to_string();
    for mark in ["](", "```", "::new"] {
        assert!(!text.contains(mark), "{mark}");
    }
}
