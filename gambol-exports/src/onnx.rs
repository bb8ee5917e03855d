//! A champion's net as an ONNX model, for every program that computes nets.
//!
//! What a program has to know besides, to sense and to move a body as the net expects it, are metadata.

mod activations;
mod graph;
mod net;
mod protobuf;

use crate::ExportError;
use creatures::{Actuation, Channel, Drive, Probe};
use envs_rapier::RapierEnvironment;
use gambol_runs::{Registry, champion::Champion, judge::Judge};
use ne_core::Seed;
use ne_net::Network;
use player::source_record;
use protobuf::Message;
use serde_json::{Value, json};

/// The versions of the file's format and of the operations; programs from 2022 on know both.
const FORMAT: u64 = 8;
const OPERATIONS: u64 = 17;

const DESCRIPTION: &str = "\
The net of a creature. Call it every time_step seconds. An input is (value - middle) * factor, and no further from 0 \
than input_range; the metadata `inputs` lists what each value is, in words and as the source, index, first and second of \
the player's specification, and `rest_height` is how high the torso rests. An output is limited to -1 to 1. With the \
actuation `speed` it asks its motor for output * top_speed. With `angle` the target is output * the larger of its limits' \
sizes, limited to them, and the motor is asked for gain * (target - angle), no faster than top_speed. Angles of joints are \
against those of the start pose. The metadata `outputs` list limits and top speeds; rad, rad/s.";

pub(crate) fn of(champion: &Champion, registry: &Registry) -> Result<Vec<u8>, ExportError> {
    let judge = Judge::new(champion.episode_parts(), registry)?;
    let world = judge.environment();
    let metadata = [
        ("creature", champion.creature.name.clone()),
        ("movement", champion.movement.name.clone()),
        ("time_step", world.settings().time_step.to_string()),
        ("input_range", world.senses().input_range().to_string()),
        ("rest_height", rest_height(world)?.to_string()),
        ("body_length", world.blueprint().body_length().to_string()),
        ("inputs", inputs(world).to_string()),
        ("outputs", outputs(world).to_string()),
    ];
    let actuation = match world.motors().actuation() {
        Actuation::Speed => vec![("actuation", "speed".into())],
        Actuation::Angle { gain } => vec![("actuation", "angle".into()), ("gain", gain.to_string())],
    };
    model(&champion.network, &[metadata.as_slice(), &actuation].concat())
}

/// A model of a net.
fn model(network: &Network, metadata: &[(&str, String)]) -> Result<Vec<u8>, ExportError> {
    let graph = net::graph(&network.view(), network.weights())?;
    let operations = Message::default().text(1, "").number(2, OPERATIONS);
    let model = Message::default()
        .number(1, FORMAT)
        .text(2, "Gambol")
        .text(3, env!("CARGO_PKG_VERSION"))
        .text(6, DESCRIPTION)
        .message(7, graph.into_message())
        .message(8, operations);
    let entry = |(key, value): &(&str, String)| Message::default().text(1, key).text(2, value);
    Ok(metadata.iter().map(entry).fold(model, |model, entry| model.message(14, entry)).into_bytes())
}

/// What each input is, and how it is scaled.
fn inputs(world: &RapierEnvironment) -> Value {
    let senses = world.senses();
    let input = |(channel, probe): (&Channel, &Probe)| {
        let mut input = described(channel);
        input["middle"] = short(probe.middle);
        input["factor"] = short(probe.factor);
        if let Some((source, index, first, second)) = source_record(probe.source) {
            input["source"] = source.into();
            input["index"] = index.into();
            input["first"] = short(first);
            input["second"] = short(second);
        }
        input
    };
    senses.channels().iter().zip(senses.probes()).map(input).collect()
}

fn outputs(world: &RapierEnvironment) -> Value {
    let output = |(channel, drive): (&Channel, &Drive)| {
        let mut output = described(channel);
        output["limits"] = drive.limits.map(short).into_iter().collect();
        output["top_speed"] = short(drive.top_speed);
        output
    };
    world.motors().channels().iter().zip(world.motors().drives()).map(output).collect()
}

/// Height of the torso's centre at rest, m.
fn rest_height(world: &RapierEnvironment) -> Result<f32, ExportError> {
    let settled = world.settled(Seed::of_run(0)).map_err(|failure| ExportError::Failed { failure })?;
    Ok(settled.rest.height())
}

fn described(channel: &Channel) -> Value {
    json!({ "name": channel.name, "unit": channel.unit, "range": channel.range.map(short) })
}

/// No more digits than give the number back.
fn short(number: f32) -> Value {
    number.to_string().parse::<f64>().map_or(Value::Null, Value::from)
}
