use super::Outcome;
use crate::{Registry, strategies::StrategyEntry};
use clap::Args;
use creatures::{Blueprint, DEFAULT_INPUT_RANGE, Motors, Senses, TERRAINS, TerrainEntry};
use serde_json::json;
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
    pub(crate) fn run(self) -> Outcome {
        let mut rows = Vec::new();
        for shipped in creatures::shipped() {
            let blueprint = Blueprint::from_json(shipped.json)?;
            let senses = Senses::new(&blueprint, &blueprint.creature().sensors, DEFAULT_INPUT_RANGE)?;
            let counts =
                [blueprint.parts().len(), blueprint.hinges().len(), senses.len(), Motors::new(&blueprint).len()];
            rows.push((shipped.name, blueprint.creature().title.clone(), counts));
        }
        if self.json {
            let row = |(name, title, [parts, joints, inputs, outputs]): &(_, _, [usize; 4])| json!({ "name": name, "title": title, "parts": parts, "joints": joints, "inputs": inputs, "outputs": outputs });
            say!("{}", rows.iter().map(row).collect::<serde_json::Value>())?;
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
            say!("{}", registry.movements.entries().iter().map(row).collect::<serde_json::Value>())?;
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
            say!("{}", registry.strategies.entries().iter().map(row).collect::<serde_json::Value>())?;
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
  gambol terrains
  gambol train tetrapod-2 running --terrain gaps:0.3
  gambol train biped-1 running --terrain mixture --set terrain.seed=7")]
pub(crate) struct Terrains {
    /// Print as JSON, with the fields of a configuration
    #[arg(long)]
    json: bool,
}

impl Terrains {
    pub(crate) fn run(self) -> Outcome {
        if self.json {
            let row = |entry: &TerrainEntry| json!({ "name": entry.name, "description": entry.description, "terrain": entry.terrain() });
            say!("{}", TERRAINS.iter().map(row).collect::<serde_json::Value>())?;
            return Ok(ExitCode::SUCCESS);
        }
        say!("terrains, as in --terrain NAME or --terrain NAME:DIFFICULTY; the sizes are those at difficulty 1")?;
        for entry in TERRAINS {
            say!("  {:<12} {}", entry.name, entry.description)?;
        }
        Ok(ExitCode::SUCCESS)
    }
}
