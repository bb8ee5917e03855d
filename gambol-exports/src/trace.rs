//! Golden traces: what a player must give again.

use crate::{ExportError, character};
use creatures::Source;
use envs_rapier::RapierEnvironment;
use gambol_runs::{Registry, champion::Champion, judge::Judge};
use ne_core::{Failure, Phenotype, Seed};
use std::fmt::{Display, Write};
use tasks::Environment;

/// A row for each step: when it is, what the body is told, where each part is, what is measured outside of it, and then what
/// a player makes of that: the inputs of the net, its outputs, and the speeds that the motors are asked for.
pub(crate) fn of(champion: &Champion, registry: &Registry, steps: Option<u32>) -> Result<Vec<u8>, ExportError> {
    let judge = Judge::new(champion.episode_parts(), registry)?;
    // What cannot be played has no trace.
    let character = character::of(champion, judge.environment())?;
    character.to_bytes()?;
    let steps = steps.unwrap_or(judge.steps());
    let mut trace = header(judge.environment(), character.outside().count());
    rows(judge.environment().clone(), champion, steps, &mut trace)
        .map_err(|failure| ExportError::Failed { failure })?;
    Ok(trace.into_bytes())
}

fn header(world: &RapierEnvironment, outside: usize) -> String {
    let mut columns: Vec<String> = ["step", "seconds", "commanded_speed", "jump"].map(String::from).to_vec();
    for part in 0..world.blueprint().parts().len() {
        let fields = ["x", "y", "cos", "sin", "vx", "vy", "spin", "touching"];
        columns.extend(fields.map(|field| format!("part{part}.{field}")));
    }
    let mut numbered = |name: &str, count: usize| columns.extend((0..count).map(|index| format!("{name}{index}")));
    numbered("outside", outside);
    numbered("input", world.inputs());
    numbered("output", world.outputs());
    numbered("speed", world.outputs());
    let mut header = columns.join(",");
    header.push('\n');
    header
}

fn rows(mut world: RapierEnvironment, champion: &Champion, steps: u32, trace: &mut String) -> Result<(), Failure> {
    let mut network = champion.network.clone();
    let (mut sensed, mut wanted) = (vec![0.0; world.inputs()], vec![0.0; world.outputs()]);
    let is_outside =
        |source: &Source| matches!(source, Source::Ray { .. } | Source::GapDistance { .. } | Source::GapWidth { .. });
    let probes = world.senses().probes().iter().map(|probe| probe.source);
    let outside: Vec<Source> = probes.filter(is_outside).collect();
    network.reset();
    world.reset(Seed::of_run(0))?;
    for step in 0..steps {
        world.sense(&mut sensed);
        network.activate(&sensed, &mut wanted);
        world.act(&wanted);
        let snapshot = world.snapshot();
        let command = snapshot.command;
        let mut row = Row(trace);
        row.first(step).then([snapshot.time, command.speed]).then([u8::from(command.jump)]);
        for part in &snapshot.parts {
            row.then([part.x, part.y, part.cos, part.sin, part.vx, part.vy, part.spin]);
            row.then([u8::from(part.touching)]);
        }
        row.then(outside.iter().map(|&source| world.measure(source)));
        row.then(sensed.iter().copied()).then(wanted.iter().copied()).then(world.asked_speeds().iter().copied()).end();
        world.step()?;
    }
    Ok(())
}

/// A line of comma-separated numbers, as short as gives them back to the bit.
struct Row<'a>(&'a mut String);

impl Row<'_> {
    fn first(&mut self, number: impl Display) -> &mut Self {
        // A string takes everything.
        let _ = write!(self.0, "{number}");
        self
    }

    fn then<N: Display>(&mut self, numbers: impl IntoIterator<Item = N>) -> &mut Self {
        for number in numbers {
            let _ = write!(self.0, ",{number}");
        }
        self
    }

    fn end(&mut self) {
        self.0.push('\n');
    }
}
