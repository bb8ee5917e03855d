//! The check that plug-in authors run in their own tests, of what a strategy over nets owes: [`check_net_strategy`]. What it has
//! in common with all checks is said in [`ne_core::conformance`].

use super::{NetStrategy, Transfer, expressed_net};
use ne_core::{
    Evaluation, Phenotype, Seed,
    conformance::{Promise, StrategyOptions, Violation, check_strategy},
};
use ne_net::{DenseShape, Network, Topology, TopologyMap};
use serde_json::Value;

/// One strategy, one name.
pub const NAME: Promise = Promise::new("strategy over nets", "`NAME` is what `name` returns");
/// Settings as a configuration has them.
pub const SETTINGS: Promise = Promise::new(
    "strategy over nets",
    "settings are an object, or nothing, read as they were written; a field that they do not have is an error, and `settings` \
     returns those it was built with",
);
/// It fits what it was built for.
pub const BUILDS: Promise = Promise::new(
    "strategy over nets",
    "with its settings it is built for nets of any topology, and fits those of this one",
);
/// Genomes are nets.
pub const NETS: Promise = Promise::new(
    "strategy over nets",
    "`net` of a genome, expressed, is the net it expresses; as it is searched, a topology and as many weights as it has, and \
     both have the inputs and outputs that were asked for",
);
/// Only some find topologies.
pub const TOPOLOGY: Promise = Promise::new(
    "strategy over nets",
    "as they are searched, its nets are of the topology it was built for, unless it says that it finds topologies",
);
/// And nets are genomes.
pub const GENOME: Promise = Promise::new(
    "strategy over nets",
    "`genome` of some weights, if it has one, is a net of these weights, and weights of another topology have none",
);
/// It may begin at a net.
pub const BEGINS: Promise = Promise::new(
    "strategy over nets",
    "what begins at or about a net is as what was built, and weights of another topology are an error",
);
/// It may go on.
pub const TRANSFERS: Promise = Promise::new(
    "strategy over nets",
    "what goes on after any generation, with the same nets, is a strategy that goes on, or an error",
);

/// All of them; it owes those of a strategy as well.
pub const PROMISES: &[Promise] = &[NAME, SETTINGS, BUILDS, NETS, TOPOLOGY, GENOME, BEGINS, TRANSFERS];

/// Generations after which a search is transferred.
const TRANSFERRED_AFTER: u64 = 3;

/// Checks a strategy that is built with these settings for small nets, with and without hidden neurons; each is checked with
/// [`check_strategy`] as well.
///
/// # Errors
/// The first promise that is not kept.
pub fn check_net_strategy<S: NetStrategy>(settings: &S::Settings, options: &StrategyOptions) -> Result<(), Violation> {
    SETTINGS.check(|| written::<S>(settings))?;
    for hidden in [vec![], vec![4]] {
        let topology: Topology = DenseShape::new(3, hidden, 2).into();
        let new = || S::build(settings, &topology).map_err(|error| error.to_string());
        let built = BUILDS.check(|| fitting(new()?, &topology))?;
        NAME.check(|| match built.name() {
            name if name == S::NAME => Ok(()),
            name => Err(format!("NAME is {:?}, name {name:?}", S::NAME)),
        })?;
        SETTINGS.check(|| built_with(built, settings).map(drop))?;
        let make = || S::build(settings, &topology).unwrap_or_else(|error| panic!("it was built before: {error}"));
        check_strategy(make, options)?;
        let genomes = NETS.check(|| Ok(S::ask(&mut new()?, Seed::of_run(options.seed).generation(1)).to_vec()))?;
        NETS.check(|| genomes.iter().try_for_each(|genome| is_net::<S>(genome, &topology)))?;
        TOPOLOGY.check(|| {
            match genomes.iter().map(|genome| S::net(genome, false).0).find(|found| *found != topology) {
                Some(found) if !S::FINDS_TOPOLOGY => Err(format!("{found:?}, built for {topology:?}")),
                _ => Ok(()),
            }
        })?;
        let weights: Vec<f32> = (0..topology.weight_count()).map(|index| 0.1 * index as f32 - 0.5).collect();
        GENOME.check(|| is_genome::<S>(&topology, &weights))?;
        BEGINS.check(|| begins(S::begin_at, settings, &topology, &weights))?;
        BEGINS.check(|| begins(S::begin_about, settings, &topology, &weights))?;
        for generations in 0..=TRANSFERRED_AFTER {
            TRANSFERS.check(|| {
                let after = |found: String| format!("after {generations} generations: {found}");
                transfers(new()?, settings, &topology, generations).map_err(after)
            })?;
        }
    }
    Ok(())
}

fn written<S: NetStrategy>(settings: &S::Settings) -> Result<(), String> {
    let written = serde_json::to_value(settings).map_err(|error| error.to_string())?;
    let read: S::Settings =
        serde_json::from_value(written.clone()).map_err(|error| format!("{written} is not read: {error}"))?;
    if read != *settings {
        return Err(format!("{written} is read as something else"));
    }
    let mut fields = match &written {
        Value::Object(fields) => fields.clone(),
        // Of a strategy without settings.
        Value::Null => return Ok(()),
        _ => return Err(format!("they are written as {written}")),
    };
    fields.insert("no-such-setting".into(), Value::from(1));
    match serde_json::from_value::<S::Settings>(Value::Object(fields)) {
        Ok(_) => Err("they are read with a field named no-such-setting".into()),
        Err(_) => Ok(()),
    }
}

fn built_with<S: NetStrategy>(strategy: S, settings: &S::Settings) -> Result<S, String> {
    if strategy.settings() == settings { Ok(strategy) } else { Err("`settings` returns others".into()) }
}

fn fitting<S: NetStrategy>(strategy: S, topology: &Topology) -> Result<S, String> {
    if strategy.fits(topology) { Ok(strategy) } else { Err(format!("it does not fit {topology:?}")) }
}

fn is_net<S: NetStrategy>(genome: &S::Genome, asked: &Topology) -> Result<(), String> {
    let shape = |topology: &Topology| (topology.inputs(), topology.outputs());
    let expressed = S::net(genome, true);
    let of_genome = expressed_net(genome);
    if expressed != of_genome {
        return Err(format!("{expressed:?}, the genome expresses {of_genome:?}"));
    }
    for (topology, weights) in [expressed, S::net(genome, false)] {
        topology.check_weights(&weights).map_err(|error| error.to_string())?;
        let network: Network = topology.network(&weights);
        for found in [shape(&topology), (network.inputs(), network.outputs())] {
            if found != shape(asked) {
                return Err(format!("(inputs, outputs) are {found:?}, asked for were {:?}", shape(asked)));
            }
        }
    }
    Ok(())
}

fn is_genome<S: NetStrategy>(topology: &Topology, weights: &[f32]) -> Result<(), String> {
    let Some(genome) = S::genome(topology, weights) else { return Ok(()) };
    is_net::<S>(&genome, topology)?;
    let found = S::net(&genome, false);
    if found != (topology.clone(), weights.to_vec()) {
        return Err(format!("{found:?}, given were {weights:?}"));
    }
    match S::genome(topology, &weights[1..]) {
        Some(_) => Err(format!("there is one of {} weights in place of {}", weights.len() - 1, weights.len())),
        None => Ok(()),
    }
}

/// How a search begins with some weights.
type Begin<S> = fn(&<S as NetStrategy>::Settings, &Topology, &[f32]) -> Result<S, ne_core::SettingError>;

fn begins<S: NetStrategy>(
    begin: Begin<S>,
    settings: &S::Settings,
    topology: &Topology,
    weights: &[f32],
) -> Result<(), String> {
    let Ok(strategy) = begin(settings, topology, weights) else { return Ok(()) };
    if begin(settings, topology, &weights[1..]).is_ok() {
        return Err(format!("it begins with {} weights in place of {}", weights.len() - 1, weights.len()));
    }
    goes_on(strategy, settings, topology)
}

fn transfers<S: NetStrategy>(
    mut strategy: S,
    settings: &S::Settings,
    topology: &Topology,
    generations: u64,
) -> Result<(), String> {
    (1..=generations).for_each(|number| generation(&mut strategy, number));
    let same =
        |count: usize| TopologyMap::new((0..count).map(Some).collect(), count).map_err(|error| error.to_string());
    let (genes, inputs, outputs) =
        (same(topology.weight_count())?, same(topology.inputs())?, same(topology.outputs())?);
    let to = Transfer { topology, genes: &genes, inputs: &inputs, outputs: &outputs };
    match strategy.transfer(settings, &to) {
        Ok(strategy) => goes_on(strategy, settings, topology),
        Err(_) => Ok(()),
    }
}

/// It is as one that was built, and runs.
fn goes_on<S: NetStrategy>(strategy: S, settings: &S::Settings, topology: &Topology) -> Result<(), String> {
    let mut strategy = fitting(built_with(strategy, settings)?, topology)?;
    for number in 1..=2 {
        generation(&mut strategy, number);
    }
    let genomes = strategy.ask(Seed::of_run(1).generation(3));
    if genomes.is_empty() {
        return Err("it asks for no genomes".into());
    }
    genomes.iter().try_for_each(|genome| is_net::<S>(genome, topology))
}

fn generation<S: NetStrategy>(strategy: &mut S, number: u64) {
    let seed = Seed::of_run(1).generation(number);
    let size = strategy.ask(seed).len();
    let evaluations: Vec<Evaluation> = (0..size).map(|index| Evaluation::new((index % 5) as f64)).collect();
    strategy.tell(&evaluations, seed);
}
