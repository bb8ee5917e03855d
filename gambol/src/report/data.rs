//! What the page is given: plain data, lengths in metres, angles in radians, times in seconds.

use crate::{champion::Champion, config::RunConfig, trajectory::Recording};
use creatures::Creature;
use ne_core::GenerationReport;
use ne_net::Network;
use serde::Serialize;
use serde_json::Value;
use tasks::Snapshot;

#[derive(Serialize)]
pub(super) struct Report {
    pub(super) title: String,
    pub(super) creature: Creature,
    pub(super) movement: MovementData,
    pub(super) summary: Option<Summary>,
    pub(super) history: Vec<HistoryPoint>,
    pub(super) champion: Option<ChampionData>,
    pub(super) strip: Vec<StripEntry>,
    pub(super) populations: Vec<PopulationEntry>,
    pub(super) settings: Vec<Fact>,
    pub(super) config: Value,
    pub(super) commands: Vec<Command>,
    pub(super) versions: Vec<Version>,
}

#[derive(Serialize)]
pub(super) struct MovementData {
    pub(super) name: String,
    pub(super) unit: String,
    pub(super) description: String,
}

#[derive(Serialize)]
pub(super) struct Summary {
    pub(super) fitness: Option<f64>,
    pub(super) generations: u64,
    pub(super) evaluations: u64,
    pub(super) physics_steps: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) stopped_because: Option<String>,
    pub(super) body_lengths_per_second: Option<f64>,
}

#[derive(Serialize)]
pub(super) struct HistoryPoint {
    generation: u64,
    evaluations: u64,
    failures: u64,
    best_so_far: Option<f64>,
    best: Option<f64>,
    mean: Option<f64>,
    median: Option<f64>,
    worst: Option<f64>,
    quantiles: Option<BandPoint>,
}

#[derive(Serialize)]
struct BandPoint {
    q10: f64,
    q25: f64,
    q75: f64,
    q90: f64,
}

impl From<&GenerationReport> for HistoryPoint {
    fn from(report: &GenerationReport) -> Self {
        let fitness = report.fitness;
        Self {
            generation: report.generation,
            evaluations: report.population,
            failures: report.failures,
            best_so_far: report.best_so_far.map(f64::from),
            best: fitness.map(|of| of.best),
            mean: fitness.map(|of| of.mean),
            median: fitness.map(|of| of.median),
            worst: fitness.map(|of| of.worst),
            quantiles: fitness.map(|of| BandPoint { q10: of.q10, q25: of.q25, q75: of.q75, q90: of.q90 }),
        }
    }
}

/// Poses of every part, in whole millimetres and milliradians: the first frame as it is, each later one as the
/// difference to the one before, which makes the page several times smaller.
#[derive(Serialize)]
pub(super) struct Replay {
    time_step: f32,
    frames: usize,
    parts: usize,
    data: Vec<i32>,
}

impl Replay {
    /// Every `stride`-th snapshot.
    pub(super) fn new(snapshots: &[Snapshot], time_step: f32, stride: usize) -> Self {
        let parts = snapshots.first().map_or(0, |first| first.parts.len());
        let mut last = vec![0; parts * 3];
        let mut data = Vec::new();
        for snapshot in snapshots.iter().step_by(stride) {
            let now = snapshot.parts.iter().flat_map(|part| [part.x, part.y, part.angle()]);
            for (value, last) in now.zip(&mut last) {
                let thousandths = (value * 1000.0).round() as i32;
                data.push(thousandths - *last);
                *last = thousandths;
            }
        }
        Self { time_step: time_step * stride as f32, frames: snapshots.len().div_ceil(stride), parts, data }
    }
}

#[derive(Serialize)]
pub(super) struct ChampionData {
    generation: u64,
    fitness: f64,
    replay: Replay,
    /// For each frame the parts that press on the ground, as the bits of a hexadecimal number.
    contacts: Vec<String>,
    network: Option<NetworkData>,
    /// Mean forward speed of the torso over the whole replay; for running only.
    #[serde(skip)]
    pub(super) body_lengths_per_second: Option<f64>,
}

#[derive(Serialize)]
struct NetworkData {
    layers: Vec<Vec<Neuron>>,
    /// For each pair of layers: for each target the weights of its sources, the bias last.
    weights: Vec<Vec<Vec<f32>>>,
    /// For each frame every neuron's activation, in hundredths.
    activations: Vec<Vec<i32>>,
}

#[derive(Serialize)]
struct Neuron {
    name: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    unit: Option<String>,
}

impl ChampionData {
    pub(super) fn new(champion: &Champion, recording: &Recording, body_length: f32) -> Self {
        let time_step = champion.physics.time_step;
        let ends = recording.snapshots.first().zip(recording.snapshots.last());
        let speed = ends
            .filter(|(_, last)| champion.movement.name == "running" && last.time > 0.0)
            .map(|(first, last)| f64::from((last.torso().x - first.torso().x) / last.time / body_length));
        Self {
            body_lengths_per_second: speed,
            generation: champion.generation,
            fitness: champion.fitness.get(),
            replay: Replay::new(&recording.snapshots, time_step, 1),
            contacts: recording.snapshots.iter().map(contact_bits).collect(),
            network: network_data(champion, recording),
        }
    }
}

/// Bit i of the number is part i.
fn contact_bits(snapshot: &Snapshot) -> String {
    let digit = |parts: &[tasks::PartState]| {
        let bits = parts.iter().rev().fold(0, |bits, part| bits * 2 + u32::from(part.touching));
        char::from_digit(bits, 16).unwrap_or('0')
    };
    snapshot.parts.chunks(4).rev().map(digit).collect()
}

fn network_data(champion: &Champion, recording: &Recording) -> Option<NetworkData> {
    let Network::Dense(net) = &champion.network else { return None };
    let shape = net.shape();
    let mut weights = net.weights();
    let mut matrices = Vec::new();
    for (sources, targets) in shape.connections() {
        let (layer, rest) = weights.split_at((sources + 1) * targets);
        matrices.push(layer.chunks(sources + 1).map(<[f32]>::to_vec).collect());
        weights = rest;
    }
    let channels = |channels: &[crate::champion::ChannelRecord]| {
        let neuron = |channel: &crate::champion::ChannelRecord| Neuron {
            name: channel.name.clone(),
            unit: Some(channel.unit.clone()),
        };
        channels.iter().map(neuron).collect::<Vec<_>>()
    };
    let mut layers = vec![channels(&champion.inputs)];
    for &width in &shape.hidden {
        layers.push((1..=width).map(|index| Neuron { name: format!("hidden {index}"), unit: None }).collect());
    }
    layers.push(channels(&champion.outputs));
    let hundredths = |frame: &Vec<f32>| frame.iter().map(|value| (value * 100.0).round() as i32).collect();
    let activations = recording.activations.iter().map(hundredths).collect();
    Some(NetworkData { layers, weights: matrices, activations })
}

#[derive(Serialize)]
pub(super) struct StripEntry {
    pub(super) generation: u64,
    pub(super) fitness: Option<f64>,
    pub(super) replay: Replay,
}

#[derive(Serialize)]
pub(super) struct PopulationEntry {
    pub(super) generation: u64,
    pub(super) members: Vec<PopulationMember>,
}

#[derive(Serialize)]
pub(super) struct PopulationMember {
    pub(super) fitness: Option<f64>,
    pub(super) replay: Replay,
}

#[derive(Serialize)]
pub(super) struct Fact {
    label: String,
    value: String,
}

impl Fact {
    pub(super) fn new(label: &str, value: impl ToString) -> Self {
        Self { label: label.into(), value: value.to_string() }
    }
}

#[derive(Serialize)]
pub(super) struct Command {
    pub(super) what: String,
    pub(super) command: String,
}

#[derive(Serialize)]
pub(super) struct Version {
    name: String,
    version: String,
}

/// The settings a reader asks for first; the rest is in the configuration.
pub(super) fn settings(config: &RunConfig) -> Vec<Fact> {
    let terms: Vec<String> =
        config.movement.terms.iter().map(|term| format!("{} × {}", term.weight, term.term)).collect();
    let movement = [vec![config.movement.name.clone()], terms].concat().join(" + ");
    let hidden: Vec<String> = config.controller.hidden.iter().map(ToString::to_string).collect();
    let mut facts = vec![
        Fact::new("Creature", &config.creature.name),
        Fact::new("Movement", movement),
        Fact::new("Preset", &config.preset),
        Fact::new("Strategy", config.strategy.name()),
        Fact::new("Hidden layers", if hidden.is_empty() { "none".into() } else { hidden.join(", ") }),
        Fact::new("Trials", config.trials.count),
        Fact::new("Time step", format!("{} s", config.physics.time_step)),
        Fact::new("Seed", config.seed),
    ];
    facts.extend(config.strategy.population().map(|population| Fact::new("Population", population)));
    facts
}

pub(super) fn versions() -> Vec<Version> {
    let version = |name: &str, version: &str| Version { name: name.into(), version: version.into() };
    vec![version("gambol", env!("CARGO_PKG_VERSION")), version("rapier2d", envs_rapier::RAPIER_VERSION)]
}
