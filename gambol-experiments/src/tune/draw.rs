use gambol_runs::config::StrategySettings;
use ne_core::{Purpose, RandomStream, Seed};
use rand::RngExt;
use serde_json::Value;

const DRAW: Purpose = Purpose::new("tune draw");

/// Settings with every number of the defaults multiplied by a factor of its own, drawn log-uniformly from 1/`spread` to
/// `spread`. Whole numbers stay whole and at least 1; 0 stays 0; names and switches stay as they are.
///
/// Whether the result is in range is not known here. `attempt` is another draw for the same trial.
pub fn draw(defaults: &StrategySettings, spread: f64, seed: u64, trial: u32, attempt: u32) -> StrategySettings {
    let place = Seed::of_run(seed).individual(trial.into()).trial(attempt);
    let mut stream = place.stream(DRAW);
    let mut drawn = defaults.clone();
    // A map in the order of its keys: the same numbers in every run.
    for (key, value) in defaults.settings() {
        drawn.set(key, changed(value, spread, &mut stream));
    }
    drawn
}

fn changed(value: &Value, spread: f64, stream: &mut RandomStream) -> Value {
    match value {
        Value::Array(values) => values.iter().map(|value| changed(value, spread, stream)).collect(),
        Value::Object(fields) => {
            fields.iter().map(|(key, value)| (key.clone(), changed(value, spread, stream))).collect()
        }
        Value::Number(number) => {
            let exponent = 2.0 * stream.random::<f64>() - 1.0;
            let factor = libm::pow(spread, exponent);
            match number.as_u64() {
                Some(0) => value.clone(),
                Some(whole) => (libm::round(whole as f64 * factor).max(1.0) as u64).into(),
                // Four digits, so that files are read by people too.
                None => number.as_f64().map_or(value.clone(), |number| rounded(number * factor).into()),
            }
        }
        other => other.clone(),
    }
}

/// With four significant digits.
fn rounded(number: f64) -> f64 {
    format!("{number:.3e}").parse().unwrap_or(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_fixed::CmaEsSettings;
    use proptest::prelude::*;
    use serde_json::json;

    proptest! {
        #[test]
        fn numbers_stay_within_the_spread_and_the_rest_stays(seed: u64, trial in 1..1000u32, spread in 1.1..20.0) {
            let settings = json!({ "a": 10, "b": 0.25, "c": { "d": [3.5, "name", true, null, 0] } });
            let drawn = draw(&StrategySettings::new("mine", &settings), spread, seed, trial, 0);
            let value = |path: &str| json!(drawn.settings()).pointer(path).cloned().unwrap_or_default();
            let number = |path: &str| value(path).as_f64().expect("a number");
            let within = |number: f64, of: f64| (of / spread * 0.99..=of * spread * 1.01).contains(&number);
            prop_assert!(value("/a").is_u64() && number("/a") >= 1.0 && number("/a") <= 10.0 * spread + 0.5);
            prop_assert!(within(number("/b"), 0.25) && within(number("/c/d/0"), 3.5));
            prop_assert_eq!(value("/c/d/1"), "name");
            prop_assert_eq!((value("/c/d/2"), value("/c/d/3"), value("/c/d/4")), (true.into(), Value::Null, 0.into()));
            prop_assert_eq!(&drawn, &draw(&StrategySettings::new("mine", &settings), spread, seed, trial, 0));
        }
    }

    #[test]
    fn trials_and_attempts_differ() {
        let defaults = StrategySettings::new("cma-es", &CmaEsSettings::default());
        let drawn = |trial, attempt| draw(&defaults, 4.0, 1, trial, attempt);
        assert_ne!(drawn(1, 0), drawn(2, 0));
        assert_ne!(drawn(1, 0), drawn(1, 1));
    }
}
