//! The pieces of the default preset, left out one by one or replaced.

use creatures::{Actuation, Sensor};
use envs_rapier::Variation;
use gambol_runs::{
    config::{LimbPhases, RunConfig, RungSettings},
    strategies::StrategyCatalogue,
};
use ne_net::Activation;

/// A change to a configuration.
pub struct Variant {
    /// What is different.
    pub name: &'static str,
    /// Makes the change.
    pub change: fn(&mut RunConfig),
}

/// All variants; the first changes nothing.
pub const VARIANTS: &[Variant] = &[
    Variant { name: "the default preset", change: |_| {} },
    Variant {
        name: "one net for the whole body",
        change: |config| {
            config.controller.modular = None;
            config.controller.hidden = vec![10];
        },
    },
    Variant { name: "limbs begin together", change: |config| config.controller.modular = Some(LimbPhases::Together) },
    Variant {
        name: "limbs begin alternating",
        change: |config| config.controller.modular = Some(LimbPhases::Alternating),
    },
    Variant {
        name: "no clock",
        change: |config| {
            keep_sensors(config, |sensor| !matches!(sensor, Sensor::Clock { .. } | Sensor::LandingClock { .. }));
        },
    },
    Variant { name: "a clock that begins anew at landings", change: |config| set_landing(config, true) },
    Variant { name: "a clock that does not hear landings", change: |config| set_landing(config, false) },
    Variant { name: "a clock of 0.5 s", change: |config| set_period(config, 0.5) },
    Variant {
        name: "no foot contacts",
        change: |config| keep_sensors(config, |sensor| *sensor != Sensor::FootContacts),
    },
    Variant { name: "no torso spin", change: |config| keep_sensors(config, |sensor| *sensor != Sensor::TorsoSpin) },
    Variant {
        name: "no torso velocity and height",
        change: |config| {
            keep_sensors(config, |sensor| !matches!(sensor, Sensor::TorsoVelocity | Sensor::TorsoHeight));
        },
    },
    Variant { name: "outputs are speeds", change: |config| config.controller.actuation = Actuation::Speed },
    Variant { name: "no hidden neurons", change: |config| config.controller.hidden = Vec::new() },
    Variant { name: "12 hidden neurons a limb", change: |config| config.controller.hidden = vec![12] },
    Variant {
        name: "rational tanh",
        change: |config| {
            config.controller.hidden_activation = Activation::RationalTanh;
            config.controller.output_activation = Activation::RationalTanh;
        },
    },
    Variant { name: "without the term headway", change: |config| drop_term(config, "headway") },
    Variant { name: "without the term footfalls", change: |config| drop_term(config, "footfalls") },
    Variant { name: "without the term upright", change: |config| drop_term(config, "upright") },
    Variant { name: "without the term posture", change: |config| drop_term(config, "posture") },
    Variant { name: "without the term slip", change: |config| drop_term(config, "slip") },
    Variant { name: "without the term haste", change: |config| drop_term(config, "haste") },
    Variant { name: "without the term rhythm", change: |config| drop_term(config, "rhythm") },
    Variant { name: "without the term vibration", change: |config| drop_term(config, "vibration") },
    Variant { name: "without the term no-exploits", change: |config| drop_term(config, "no-exploits") },
    Variant { name: "without the term idleness", change: |config| drop_term(config, "idleness") },
    Variant { name: "without the term leap", change: |config| drop_term(config, "leap") },
    Variant { name: "without the term landing", change: |config| drop_term(config, "landing") },
    Variant { name: "no terms at all", change: |config| config.movement.terms.clear() },
    Variant { name: "whole episodes in training", change: |config| config.training_steps = config.movement.steps },
    Variant { name: "a rung of half the steps", change: |config| run_rungs(config, &[2]) },
    Variant { name: "rungs of a quarter and half the steps", change: |config| run_rungs(config, &[4, 2]) },
    Variant { name: "no variation", change: |config| config.variation = Variation::default() },
    Variant { name: "light variation", change: |config| config.variation = Variation::light() },
    Variant { name: "bumpy variation", change: |config| config.variation = Variation::bumpy() },
    Variant { name: "strong variation", change: |config| config.variation = Variation::strong() },
    Variant { name: "one trial", change: |config| config.trials.count = 1 },
    Variant { name: "five trials", change: |config| config.trials.count = 5 },
    Variant { name: "motors as soft as in the thesis", change: |config| config.physics.motor_gain = 20.0 },
    Variant { name: "population 16", change: |config| config.strategy.set_population(16) },
    Variant { name: "population 256", change: |config| config.strategy.set_population(256) },
    Variant { name: "full covariance", change: |config| set_cma(config, "covariance", "full") },
    Variant { name: "no restarts", change: |config| set_cma(config, "restart", "none") },
    Variant { name: "restarts as in IPOP", change: |config| set_cma(config, "restart", "ipop") },
    Variant { name: "restarts as in BIPOP", change: |config| set_cma(config, "restart", "bipop") },
    Variant { name: "steps that begin with 0.5", change: |config| set_cma(config, "step_size", 0.5) },
    Variant { name: "steps that begin with 0.2", change: |config| set_cma(config, "step_size", 0.2) },
    Variant {
        name: "weights that stay small",
        change: |config| {
            set_cma(config, "greatest_growth", 1.0);
            set_cma(config, "mean_decay", 0.01);
        },
    },
    Variant {
        name: "weights that may grow",
        change: |config| {
            set_cma(config, "greatest_growth", 1e4);
            set_cma(config, "mean_decay", 0.0);
        },
    },
    Variant { name: "one start", change: |config| set_cma(config, "starts", 1) },
    Variant { name: "starts of 20 generations", change: |config| set_cma(config, "start_generations", 20) },
    Variant { name: "conventional neuroevolution", change: |config| search_with(config, "conventional") },
    Variant { name: "OpenAI-ES", change: |config| search_with(config, "open-es") },
    Variant { name: "CoSyNE", change: |config| search_with(config, "cosyne") },
    Variant { name: "NEAT", change: |config| search_with(config, "neat") },
];

fn keep_sensors(config: &mut RunConfig, keep: fn(&Sensor) -> bool) {
    if let Some(sensors) = &mut config.sensors {
        sensors.retain(keep);
    }
}

/// Has the clock begin anew at landings, or not.
fn set_landing(config: &mut RunConfig, from_landing: bool) {
    for sensor in config.sensors.iter_mut().flatten() {
        if let Sensor::Clock { period } | Sensor::LandingClock { period } = *sensor {
            *sensor = if from_landing { Sensor::LandingClock { period } } else { Sensor::Clock { period } };
        }
    }
}

/// Of the clock, s, and of the rhythm that goes with it.
fn set_period(config: &mut RunConfig, seconds: f32) {
    for sensor in config.sensors.iter_mut().flatten() {
        if let Sensor::Clock { period } | Sensor::LandingClock { period } = sensor {
            *period = seconds;
        }
    }
    for term in config.movement.terms.iter_mut().filter(|term| term.term == "rhythm") {
        term.settings.insert("period".into(), seconds.into());
    }
}

fn drop_term(config: &mut RunConfig, name: &str) {
    config.movement.terms.retain(|term| term.term != name);
}

/// Rungs that are so many times shorter than training; half of the individuals in one go on.
fn run_rungs(config: &mut RunConfig, shorter: &[u32]) {
    let Some(steps) = config.training_steps.or(config.movement.steps) else { return };
    let rung = |times: &u32| RungSettings { steps: Some((steps / times).max(1)), trials: None, share: 0.5 };
    config.rungs = shorter.iter().map(rung).collect();
}

fn search_with(config: &mut RunConfig, name: &str) {
    if let Some(entry) = StrategyCatalogue::default().find(name) {
        config.strategy = entry.settings();
    }
}

/// Changes a choice of CMA-ES by its name in files.
fn set_cma(config: &mut RunConfig, field: &str, choice: impl Into<serde_json::Value>) {
    if config.strategy.name() == "cma-es" {
        config.strategy.set(field, choice);
    }
}
