//! The JSON Schema of the configuration of a run.

use crate::{
    Registry,
    champion_selection::highest_tier_of_all,
    config::{RunConfig, StrategySettings},
};
use schemars::{JsonSchema, SchemaGenerator};
use serde_json::{Map, Value};

/// The JSON Schema (draft 2020-12) of a [`RunConfig`] as text has it, with the strategies of this registry, by name: for
/// each field its help, its type, its default where a file may leave it out, and its range.
///
/// It says what a field may be for itself; what only makes sense together with others (a rung no longer than an episode,
/// the terms there are) is for [`Setup::new`](crate::Setup::new) to check. A range whose end is another field is given as
/// wide as that field can make it.
///
/// ```
/// let schema = gambol_runs::schema::json_schema(&gambol_runs::Registry::default());
/// let time_step = &schema["$defs"]["PhysicsSettings"]["properties"]["time_step"];
/// assert_eq!((time_step["minimum"].as_f64(), time_step["maximum"].as_f64()), (Some(0.001), Some(0.05)));
/// assert_eq!(time_step["default"], 0.02);
/// ```
pub fn json_schema(registry: &Registry) -> Value {
    let mut generator = SchemaGenerator::default();
    let strategies = registry.strategies.entries().iter();
    let strategies: Map<String, Value> =
        strategies.map(|entry| (entry.name().to_owned(), entry.schema(&mut generator).to_value())).collect();
    let mut strategy = StrategySettings::json_schema(&mut generator);
    strategy.insert("properties".into(), strategies.into());
    strategy.insert("additionalProperties".into(), false.into());
    let mut schema = generator.into_root_schema_for::<RunConfig>().to_value();
    schema["$defs"][&*StrategySettings::schema_name()] = strategy.to_value();
    schema["$defs"]["StopConditions"]["properties"]["tier"]["maximum"] = highest_tier_of_all().into();
    creatures::tidy_schema(&mut schema);
    schema
}
