//! What a method had in a comparison, and from where.

use gambol_runs::{Registry, config::RunConfig, request::Request};
use serde::{Deserialize, Serialize};
use serde_json::{Map, Value};

/// A field of a method's configuration, and where its value is from.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Provenance {
    /// Its path, such as `strategy.neat.population`.
    pub field: String,
    /// Its value; `null` if it is not used.
    pub value: Value,
    /// In words: `its own defaults`, `preset plain`, `file tuned.json`, `by --set`.
    pub from: String,
}

/// What belongs to the scenario or the plan, or does not touch what a run finds.
const OTHERS: [&str; 7] = ["creature", "further_bodies", "origin", "preset", "record", "seed", "stages"];

/// Fields that are told one by one.
const OPENED: [&str; 3] = ["controller", "movement", "stop"];

/// What a strategy that finds its nets itself does not use.
const OF_GIVEN_NETS: [&str; 4] = ["hidden", "hidden_activation", "hidden_scale", "output_activation"];

/// Where every field of a method's configuration is from. `request` is what it was made of.
///
/// The request is resolved again, first bare and then with one part more each time: a field is from the last part that
/// changed it. What says the same as before it changes nothing, and is from where it was said first.
pub(super) fn provenance(request: &Request, config: &RunConfig, registry: &Registry) -> Vec<Provenance> {
    let bare = Request {
        preset: Some(config.preset.clone()),
        strategy: Some(config.strategy.name().into()),
        config: None,
        engine: None,
        variation: None,
        set: Vec::new(),
        ..request.clone()
    };
    let with_file = Request { config: request.config.clone(), ..bare.clone() };
    let with_engine = Request { engine: request.engine.clone(), ..with_file.clone() };
    let with_variation = Request { variation: request.variation.clone(), ..with_engine.clone() };
    let resolved = |request: &Request| request.resolve(registry).ok().map(|config| fields(&config));
    let Some(mut known) = resolved(&bare) else { return Vec::new() };
    let entry = registry.strategies.find(config.strategy.name());
    let defaults = entry.map(|entry| entry.settings());
    let first = |field: &str, value: &Value| {
        let key = field.strip_prefix("strategy.").and_then(|rest| rest.split_once('.')).map(|(_, key)| key);
        let default = key.and_then(|key| defaults.as_ref()?.settings().get(key));
        match field {
            _ if default == Some(value) => "its own defaults".to_owned(),
            "variation" | "training_steps" if request.unvaried => "compare: nothing varies".into(),
            _ => format!("preset {}", config.preset),
        }
    };
    let mut from: Vec<(String, String)> = Vec::new();
    from.extend(known.iter().map(|(field, value)| (field.clone(), first(field, value))));
    // Its name alone: parts of a comparison that are done elsewhere have it at other places.
    let file = request.config.as_ref().and_then(|path| path.file_name()).unwrap_or_default();
    let file = format!("file {}", file.display());
    let parts = [
        (with_file, file.as_str()),
        (with_engine, "--engine"),
        (with_variation, "--variation"),
        (request.clone(), "by --set"),
    ];
    for (part, name) in parts {
        let Some(next) = resolved(&part) else { continue };
        let changed = next.iter().filter(|(field, value)| known.get(*field) != Some(*value));
        from.extend(changed.map(|(field, _)| (field.clone(), name.to_owned())));
        known = next;
    }
    let finds_nets = entry.is_some_and(|entry| entry.finds_topology());
    let told = |(field, value): (String, Value)| {
        let ignored = finds_nets && field.strip_prefix("controller.").is_some_and(|key| OF_GIVEN_NETS.contains(&key));
        let last = from.iter().rev().find(|(of, _)| *of == field);
        let from = match last {
            _ if ignored => format!("not used: {} finds its nets itself", config.strategy.name()),
            _ if field.starts_with("stop.") => "by --evaluations or --steps".into(),
            Some((_, from)) => from.clone(),
            None => "–".into(),
        };
        Provenance { value: if ignored { Value::Null } else { value }, field, from }
    };
    fields(config).into_iter().map(told).collect()
}

/// The first field, the strategy's aside, in which two configurations differ.
pub(super) fn first_unlike(one: &RunConfig, other: &RunConfig) -> Option<String> {
    let [one, other] = [one, other].map(fields);
    let is_own = |field: &str| field.starts_with("strategy.");
    let mut names = one.keys().chain(other.keys()).filter(|field| !is_own(field));
    names.find(|field| one.get(*field) != other.get(*field)).cloned()
}

/// The fields of a configuration by their paths.
fn fields(config: &RunConfig) -> Map<String, Value> {
    let mut fields = Map::new();
    // Plain data can be written; were it not, there would be no fields.
    let Value::Object(whole) = serde_json::to_value(config).unwrap_or_default() else { return fields };
    for (name, value) in whole {
        match value {
            _ if OTHERS.contains(&name.as_str()) => {}
            _ if name == "strategy" => {
                let (name, settings) = (config.strategy.name(), config.strategy.settings().iter());
                fields.extend(settings.map(|(key, value)| (format!("strategy.{name}.{key}"), value.clone())));
            }
            Value::Object(inner) if OPENED.contains(&name.as_str()) => {
                fields.extend(inner.into_iter().map(|(key, value)| (format!("{name}.{key}"), value)));
            }
            value => {
                fields.insert(name, value);
            }
        }
    }
    // Files leave out what is empty; that there are no terms is worth telling.
    fields.entry("movement.terms").or_insert_with(|| Value::Array(Vec::new()));
    // No budget of that kind.
    fields.retain(|field, value| !(field.starts_with("stop.") && value.is_null()));
    fields
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::compare::{Method, Plan, PlanError, PlanRequest};
    use ne_core::StopConditions;

    fn plan(methods: &[&str], preset: Option<&str>, set: &[&str]) -> Result<Plan, PlanError> {
        let registry = Registry::default();
        let method = |text: &&str| Method::parse(text, &registry);
        PlanRequest {
            methods: methods.iter().map(method).collect::<Result<_, _>>()?,
            creatures: vec!["biped-1".into()],
            movements: vec!["jumping".into()],
            seeds: vec![1],
            budget: StopConditions { evaluations: Some(100), ..StopConditions::default() },
            preset: preset.map(String::from),
            set: set.iter().map(|&set| set.into()).collect(),
            ..PlanRequest::default()
        }
        .plan(&registry)
    }

    /// Where a field of a method is from, and its value.
    fn from(plan: &Plan, method: usize, field: &str) -> (String, Value) {
        let had = plan.cells[method].provenance.iter().find(|had| had.field == field).expect(field);
        (had.from.clone(), had.value.clone())
    }

    #[test]
    fn every_field_says_where_it_is_from() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("tuned.json");
        std::fs::write(&file, r#"{"strategy": {"neat": {"population": 40}}}"#).expect("written");
        let tuned = format!("tuned={}", file.display());
        let plan = plan(&["cma-es", &tuned], Some("plain"), &["controller.input_range=2"]).expect("a plan");
        assert_eq!(from(&plan, 0, "strategy.cma-es.population").0, "its own defaults");
        assert_eq!(from(&plan, 1, "strategy.neat.population"), ("file tuned.json".into(), 40.into()));
        assert_eq!(from(&plan, 1, "strategy.neat.recurrent").0, "its own defaults");
        assert_eq!(from(&plan, 0, "controller.hidden"), ("preset plain".into(), serde_json::json!([10])));
        assert_eq!(from(&plan, 1, "controller.hidden"), ("not used: neat finds its nets itself".into(), Value::Null));
        assert_eq!(from(&plan, 0, "controller.input_range"), ("by --set".into(), serde_json::json!(2.0)));
        assert_eq!(from(&plan, 0, "movement.terms"), ("preset plain".into(), serde_json::json!([])));
        assert_eq!(from(&plan, 0, "stop.evaluations").1, 100);
        let alone = self::plan(&["cma-es"], None, &[]).expect("a plan");
        assert_eq!(from(&alone, 0, "variation").0, "compare: nothing varies");
        assert_eq!(from(&alone, 0, "strategy.cma-es.population").0, "preset default", "tuned for gaits");
    }

    #[test]
    fn with_a_preset_all_have_the_same_but_for_their_strategies() {
        let all = ["ga", "neat", "cma-es", "open-es", "cosyne", "ars", "hill-climbing", "random-search"];
        for preset in ["plain", "shaped"] {
            let plan = plan(&all, Some(preset), &[]).expect("a plan");
            let Some((first, others)) = plan.cells.split_first() else { panic!("eight cells") };
            for cell in others {
                assert_eq!(first_unlike(&first.config, &cell.config), None, "{preset}: {}", cell.method);
            }
            for cell in &plan.cells {
                assert_eq!(cell.is_shaped(), preset == "shaped");
                assert_eq!(cell.shares_worlds(), preset == "shaped");
                assert_eq!(cell.config.controller.modular, first.config.controller.modular, "NEAT too");
                let entry = Registry::default().strategies.of(&cell.config.strategy).expect("known").settings();
                assert_eq!(cell.config.strategy, entry, "its own defaults");
            }
        }
    }

    #[test]
    fn what_is_not_alike_is_refused_and_named() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("large.json");
        std::fs::write(&file, r#"{"controller": {"hidden": [30]}}"#).expect("written");
        let large = format!("large={}", file.display());
        let error = plan(&["ga", &large], Some("plain"), &[]).expect_err("not alike").to_string();
        assert!(error.starts_with("large and ga do not have the same controller.hidden on biped-1 jumping"), "{error}");
        assert!(plan(&["ga", &large], None, &[]).is_ok(), "without a preset each may have its own");
        let error = plan(&["ga", "thesis"], Some("plain"), &[]).expect_err("two presets").to_string();
        assert!(error.starts_with("\"thesis\" is a preset, and --preset plain gives all the same"), "{error}");
    }
}
