//! What the page is given: plain data, lengths in metres, angles in radians, times in seconds.

use super::{
    front::FrontData,
    gait::GaitData,
    history::{HistoryPoint, SpeciesHistory, StatisticHistory},
    stages::StageData,
};
use crate::page::{ground::GroundData, network::NetworkData};
use creatures::{Creature, Terrain};
use envs_rapier::PhysicsSettings;
use gambol_runs::{Registry, champion::Champion, config::RunConfig, strategies::StrategyEntry, trajectory::Recording};
use serde::Serialize;
use serde_json::Value;
use tasks::Snapshot;

#[derive(Serialize)]
pub(super) struct Report {
    pub(super) title: String,
    pub(super) creature: Creature,
    pub(super) movement: MovementData,
    pub(super) summary: Option<Summary>,
    /// The way through the stages, of a run that has some.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub(super) stages: Vec<StageData>,
    pub(super) history: Vec<HistoryPoint>,
    pub(super) species: Vec<SpeciesHistory>,
    pub(super) statistics: Vec<StatisticHistory>,
    pub(super) champion: Option<ChampionData>,
    /// What champions move on; `None` for flat ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) ground: Option<GroundData>,
    /// How the champion moves; `None` if there is nothing to measure.
    pub(super) gait: Option<GaitData>,
    /// The compromises found, if the search was for several objectives.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) front: Option<FrontData>,
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
    /// The champion's fitness in training, if that is another.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) fitness_in_training: Option<f64>,
    /// Whether a champion selection chose the champion, so that the best of a generation is not it.
    pub(super) judged: bool,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) warning: Option<String>,
    pub(super) generations: u64,
    pub(super) evaluations: u64,
    pub(super) physics_steps: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) stopped_because: Option<String>,
    pub(super) body_lengths_per_second: Option<f64>,
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
    network: NetworkData,
    /// Mean forward speed of the torso over the whole replay, of a gait that is judged by the way it makes.
    #[serde(skip)]
    pub(super) body_lengths_per_second: Option<f64>,
}

impl ChampionData {
    pub(super) fn new(champion: &Champion, recording: &Recording, body_length: f32, covers_distance: bool) -> Self {
        let time_step = champion.physics.time_step;
        let ends = recording.snapshots.first().zip(recording.snapshots.last());
        let speed = ends
            .filter(|(_, last)| covers_distance && last.time > 0.0)
            .map(|(first, last)| f64::from((last.torso().x - first.torso().x) / last.time / body_length));
        Self {
            body_lengths_per_second: speed,
            generation: champion.generation,
            fitness: champion.fitness.get(),
            replay: Replay::new(&recording.snapshots, time_step, 1),
            contacts: recording.snapshots.iter().map(contact_bits).collect(),
            network: NetworkData::new(&champion.network, &champion.inputs, &champion.outputs, &recording.activations),
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
    /// What they move on; `None` for flat ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub(super) ground: Option<GroundData>,
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
pub(super) fn settings(config: &RunConfig, registry: &Registry) -> Vec<Fact> {
    let terms: Vec<String> =
        config.movement.terms.iter().map(|term| format!("{} × {}", term.weight, term.term)).collect();
    let movement = [vec![config.movement.name.clone()], terms].concat().join(" + ");
    let mut facts = vec![
        Fact::new("Creature", &config.creature.name),
        Fact::new("Movement", movement),
        Fact::new("Preset", &config.preset),
        Fact::new("Strategy", config.strategy.name()),
        Fact::new("Engine", config.engine.name()),
        Fact::new("Trials", config.trials.count),
        Fact::new("Variation", registry.variations.name_of(&config.variation).unwrap_or("of its own")),
        Fact::new("Terrain", terrain(&config.terrain, &config.physics)),
        Fact::new("Time step", format!("{} s", config.physics.time_step)),
        Fact::new("Seed", config.seed),
    ];
    facts.insert(4, topology(config, registry));
    if !config.movement.objectives.is_empty() {
        let objectives = config.movement.objectives.iter().map(|term| format!("{} × {}", term.weight, term.term));
        facts.insert(2, Fact::new("Objectives", objectives.collect::<Vec<_>>().join(", ")));
    }
    if !config.further_bodies.is_empty() {
        let names: Vec<&str> = config.further_bodies.iter().map(|further_body| further_body.name.as_str()).collect();
        facts.insert(1, Fact::new("further_bodies in training", names.join(", ")));
    }
    facts.extend(config.strategy.population().map(|population| Fact::new("Population", population)));
    facts
}

/// The kinds of obstacles and how hard they are, or that there is no ground.
pub(super) fn terrain(terrain: &Terrain, physics: &PhysicsSettings) -> String {
    if physics.water.is_some() {
        return "water".into();
    }
    let kinds: Vec<&str> = terrain.obstacles.iter().map(|obstacles| obstacles.kind().name()).collect();
    match kinds.is_empty() {
        true if terrain.is_flat() => "flat".into(),
        true => format!("drawn, {} obstacles", terrain.drawn.len()),
        false => format!("{}, difficulty {}, seed {}", kinds.join(" + "), terrain.difficulty, terrain.seed),
    }
}

/// What is settled about the net before the run.
fn topology(config: &RunConfig, registry: &Registry) -> Fact {
    let entry = registry.strategies.of(&config.strategy).ok();
    let finds_topology = entry.is_some_and(StrategyEntry::finds_topology);
    let is_copied = entry.is_some_and(StrategyEntry::finds_copied) && config.controller.modular.is_some();
    match &config.topology {
        _ if finds_topology => {
            let kind = match config.strategy.settings().get("recurrent").and_then(Value::as_bool) {
                Some(true) => ", recurrent",
                Some(false) => ", feed-forward",
                None => "",
            };
            let copied = if is_copied { ", copied for each limb" } else { "" };
            Fact::new("Topology", format!("evolves{kind}{copied}"))
        }
        Some(frozen) => Fact::new("Topology", format!("frozen: {}", frozen.net)),
        None => {
            let hidden: Vec<String> = config.controller.hidden.iter().map(ToString::to_string).collect();
            Fact::new("Hidden layers", if hidden.is_empty() { "none".into() } else { hidden.join(", ") })
        }
    }
}

pub(super) fn versions() -> Vec<Version> {
    let version = |name: &str, version: &str| Version { name: name.into(), version: version.into() };
    vec![version("gambol", env!("CARGO_PKG_VERSION")), version("rapier2d", envs_rapier::RAPIER_VERSION)]
}

#[cfg(test)]
mod tests {
    use super::*;
    use gambol_runs::{
        config::{FrozenTopology, StrategySettings},
        request::Request,
    };
    use ne_neat::NeatSettings;
    use ne_net::DenseShape;

    fn neat(recurrent: bool) -> StrategySettings {
        StrategySettings::new("neat", &NeatSettings { recurrent, ..NeatSettings::default() })
    }

    #[test]
    fn settings_say_of_the_net_what_the_strategy_leaves_settled() {
        let request =
            Request { creature: Some("biped-1".into()), movement: Some("running".into()), ..Request::default() };
        let mut base = request.resolve(&Registry::default()).expect("a configuration");
        base.controller.hidden = vec![10];
        let said = |change: fn(&mut RunConfig)| {
            let mut config = base.clone();
            change(&mut config);
            let facts = settings(&config, &Registry::default()).into_iter().map(|fact| (fact.label, fact.value));
            facts.filter(|(label, _)| label == "Topology" || label == "Hidden layers").collect::<Vec<_>>()
        };
        let fact = |label: &str, value: &str| vec![(label.to_owned(), value.to_owned())];
        assert_eq!(said(|_| {}), fact("Hidden layers", "10"));
        assert_eq!(said(|config| config.controller.hidden.clear()), fact("Hidden layers", "none"));
        assert_eq!(said(|config| config.controller.hidden = vec![4, 3]), fact("Hidden layers", "4, 3"));
        assert_eq!(said(|config| config.strategy = neat(false)), fact("Topology", "evolves, feed-forward"));
        assert_eq!(said(|config| config.strategy = neat(true)), fact("Topology", "evolves, recurrent"));
        let frozen = |config: &mut RunConfig| {
            let net = DenseShape::new(3, vec![2], 4).into();
            config.topology = Some(FrozenTopology { inputs: Vec::new(), outputs: Vec::new(), net, genes: Vec::new() });
        };
        assert_eq!(said(frozen), fact("Topology", "frozen: 3-2-4"));
    }
}
