use super::Outcome;
use crate::{
    Registry,
    catalogue::{Catalogue, Named},
    presets::Preset,
    strategies::StrategyEntry,
};
use clap::Args;
use creatures::{Blueprint, DEFAULT_INPUT_RANGE, Motors, Senses, Sensor};
use serde::Serialize;
use serde_json::{Value, json};
use std::process::ExitCode;

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol creatures
  gambol creatures --json")]
pub(crate) struct Creatures {
    /// Print as JSON
    #[arg(long)]
    json: bool,
}

impl Creatures {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let mut rows = Vec::new();
        for entry in registry.creatures.entries() {
            let blueprint = Blueprint::new(entry.value.clone())?;
            let senses = Senses::new(
                &blueprint,
                &registry.sensors.telling(&entry.value.sensors, &blueprint)?,
                DEFAULT_INPUT_RANGE,
            )?;
            let counts =
                [blueprint.parts().len(), blueprint.hinges().len(), senses.len(), Motors::new(&blueprint).len()];
            rows.push((&entry.name, &entry.description, counts));
        }
        if self.json {
            let row = |(name, title, [parts, joints, inputs, outputs]): &(_, _, [usize; 4])| json!({ "name": name, "title": title, "parts": parts, "joints": joints, "inputs": inputs, "outputs": outputs });
            say!("{}", rows.iter().map(row).collect::<Value>())?;
        } else {
            say!("{:<12} {:<20} {:>5} {:>6} {:>6} {:>7}", "name", "", "parts", "joints", "inputs", "outputs")?;
            for (name, title, [parts, joints, inputs, outputs]) in rows {
                say!("{name:<12} {title:<20} {parts:>5} {joints:>6} {inputs:>6} {outputs:>7}")?;
            }
        }
        Ok(ExitCode::SUCCESS)
    }
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol movements
  gambol movements --json")]
pub(crate) struct Movements {
    /// Print as JSON
    #[arg(long)]
    json: bool,
}

impl Movements {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        if self.json {
            let row = |entry: &tasks::MovementEntry| json!({ "name": entry.name, "unit": entry.unit, "steps": entry.steps, "description": entry.description });
            say!("{}", registry.movements.entries().iter().map(row).collect::<Value>())?;
            return Ok(ExitCode::SUCCESS);
        }
        let line = |entry: &tasks::MovementEntry, steps: String| {
            say!("  {:<12} {:<3} {steps:<11} {}", entry.name, entry.unit, entry.description)
        };
        say!("movements")?;
        for entry in registry.movements.entries() {
            if let Some(steps) = entry.steps {
                line(entry, format!("{steps} steps"))?;
            }
        }
        say!("terms, to be added with --set 'movement.terms=[{{\"term\":NAME,\"weight\":W}}]'")?;
        for entry in registry.movements.entries().iter().filter(|entry| entry.steps.is_none()) {
            line(entry, String::new())?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol strategies
  gambol train biped-1 running --strategy neat")]
pub(crate) struct Strategies {
    /// Print as JSON
    #[arg(long)]
    json: bool,
}

impl Strategies {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        if self.json {
            let row = |entry: &StrategyEntry| json!({ "name": entry.name(), "alias": entry.alias(), "description": entry.description(), "settings": entry.settings() });
            say!("{}", registry.strategies.entries().iter().map(row).collect::<Value>())?;
            return Ok(ExitCode::SUCCESS);
        }
        for entry in registry.strategies.entries() {
            let alias = entry.alias().map_or_else(String::new, |alias| format!(" (or {alias})"));
            say!("{:<20} {}", format!("{}{alias}", entry.name()), entry.description())?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol presets
  gambol train biped-1 running --preset thesis")]
pub(crate) struct Presets {
    /// Print as JSON
    #[arg(long)]
    json: bool,
}

impl Presets {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        if self.json {
            let row = |preset: &Preset| json!({ "name": preset.name, "description": preset.description });
            say!("{}", registry.presets.entries().map(row).collect::<Value>())?;
            return Ok(ExitCode::SUCCESS);
        }
        say!("presets, as in --preset NAME; the first is the default")?;
        for preset in registry.presets.entries() {
            say!("  {:<12} {}", preset.name, preset.description)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol sensors
  gambol train biped-1 running --set 'sensors=[\"torso-rotation\",\"joint-angles\",{\"clock\":{\"period\":0.5}}]'")]
pub(crate) struct Sensors {
    /// Print as JSON
    #[arg(long)]
    json: bool,
}

impl Sensors {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        // Those of other crates are listed by their own names.
        let mut sensors = Vec::new();
        for kind in Sensor::KINDS.iter().filter(|kind| kind.name != "custom") {
            sensors.push((kind.name, serde_json::from_str(kind.example)?, kind.description));
        }
        for entry in registry.sensors.entries() {
            sensors.push((&entry.name, json!({ "custom": { "name": entry.name } }), &entry.description));
        }
        if self.json {
            let row = |(name, example, description): (&str, Value, &str)| json!({ "name": name, "example": example, "description": description });
            say!("{}", sensors.into_iter().map(row).collect::<Value>())?;
            return Ok(ExitCode::SUCCESS);
        }
        say!("sensors, as in the list `sensors` of a creature's file, or --set 'sensors=[...]'")?;
        for (_, example, description) in sensors {
            say!("  {:<48} {description}", example.to_string())?;
        }
        Ok(ExitCode::SUCCESS)
    }
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol terrains
  gambol train tetrapod-2 running --terrain gaps:0.3
  gambol train biped-1 running --terrain mixture --set terrain.seed=7")]
pub(crate) struct Terrains {
    /// Print as JSON, with the fields of a configuration
    #[arg(long)]
    json: bool,
}

impl Terrains {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let heading =
            "terrains, as in --terrain NAME or --terrain NAME:DIFFICULTY; the sizes are those at difficulty 1";
        named(&registry.terrains, (!self.json).then_some(heading), "terrain")
    }
}

#[derive(Args)]
#[command(after_help = "\
Examples:
  gambol variations
  gambol train biped-1 running --variation strong")]
pub(crate) struct Variations {
    /// Print as JSON, with the fields of a configuration
    #[arg(long)]
    json: bool,
}

impl Variations {
    pub(crate) fn run(self, registry: &Registry) -> Outcome {
        let heading = "variations of the world in training, as in --variation NAME";
        named(&registry.variations, (!self.json).then_some(heading), "variation")
    }
}

/// Lists a catalogue under this heading, or without one as JSON, with what names stand for in this field.
fn named<T: Serialize>(catalogue: &Catalogue<T>, heading: Option<&str>, field: &str) -> Outcome {
    match heading {
        None => {
            let row = |it: &Named<T>| json!({ "name": it.name, "description": it.description, field: it.value });
            say!("{}", catalogue.entries().iter().map(row).collect::<Value>())?;
        }
        Some(heading) => {
            say!("{heading}")?;
            for entry in catalogue.entries() {
                say!("  {:<12} {}", entry.name, entry.description)?;
            }
        }
    }
    Ok(ExitCode::SUCCESS)
}
