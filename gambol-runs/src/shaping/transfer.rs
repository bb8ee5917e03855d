//! From what was learned to a new search: on another task, with more senses, by another strategy.

use super::guess::better_guess;
use super::source::{ChampionNet, Kind, Source, names_of, read_checkpoint};
use crate::{
    Registry,
    champion::ChannelRecord,
    config::{FrozenTopology, GeneRecord, Origin, RunConfig, StrategySettings, Transferred},
    episode_parts::SetupError,
    run_folder::FolderError,
    setup::Setup,
    strategies::{AnyGenome, AnyStrategy, StrategyCatalogue, StrategyEntry, Transfer},
};
use creatures::Channel;
use ne_core::{Genome, Seed, SettingError};
use ne_net::TopologyMap;

/// Why nothing can be transferred.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum TransferError {
    /// The run or the champion cannot be read.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// The new configuration, or that of the source, cannot be built.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The search cannot go on with these settings.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// The source has no champion.
    #[error("{source_name} has no champion yet: all evaluations failed")]
    NoChampion {
        /// The source.
        source_name: String,
    },
    /// What is asked to be transferred cannot be, from this source to this strategy.
    #[error("{0}")]
    Impossible(String),
    /// Something learned would be lost.
    #[error(
        "{}: what was learned with it would be lost; keep it, or allow it with {allow}", what.join(", ")
    )]
    Lost {
        /// Inputs, outputs or weights that the new net does not have.
        what: Vec<String>,
        /// How to allow it.
        allow: &'static str,
    },
}

/// How losses are allowed.
const ALLOW_LOSS: &str = "--allow-loss, or \"allow_loss\": true in the stage";

/// The weights of a net in that of a new search; what is new is as it is by hand.
fn carried(genes: &TopologyMap, net: &ChampionNet, setup: &Setup) -> Vec<f32> {
    let old = net.weights.iter().copied().map(Some).collect::<Vec<_>>();
    genes.transfer(&old, None).into_iter().zip(&setup.by_hand).map(|(old, &by_hand)| old.unwrap_or(by_hand)).collect()
}

/// How it is to be transferred.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct TransferOptions {
    /// What; `None`: as much as can be.
    pub(crate) transferred: Option<Transferred>,
    /// Whether inputs, outputs and weights may be given up.
    pub(crate) allow_loss: bool,
}

/// A search that can begin.
pub(crate) struct PreparedTransfer {
    /// The configuration, with the topology that is kept, and its [`Origin`].
    pub(crate) config: RunConfig,
    pub(crate) setup: Setup,
    /// Whether the new strategy does so itself.
    finds_topology: bool,
    source: Source,
    transferred: Transferred,
    genes: TopologyMap,
    inputs: TopologyMap,
    outputs: TopologyMap,
    /// The champion's weights in the new net, unless a population is transferred; of one that is held, those that are new.
    weights: Vec<f32>,
}

impl PreparedTransfer {
    /// Prepares a search with the new configuration. Nothing is written.
    ///
    /// # Errors
    /// If the new configuration is not valid, or something learned would be lost that may not be.
    pub(crate) fn prepare(
        source: Source,
        to: &RunConfig,
        how: TransferOptions,
        registry: &Registry,
    ) -> Result<Self, TransferError> {
        let from = source.strategy_entry();
        let entry = registry.strategies.of(&to.strategy).map_err(SetupError::from)?;
        let transferred = match (how.transferred, from) {
            (Some(transferred), _) => transferred,
            (None, Some(from)) => match usual(from, entry) {
                Transferred::Population if source.has_begun_anew()? => Transferred::Champion,
                transferred => transferred,
            },
            (None, None) => Transferred::Topology,
        };
        check_possible(&source.name, from, transferred, entry)?;
        if transferred == Transferred::Population && source.has_nothing_to_transfer()? {
            let message = format!(
                "the search of {} has just begun anew and has nothing to transfer: transfer the champion",
                source.name
            );
            return Err(TransferError::Impossible(message));
        }
        let mut config = to.clone();
        if let (Kind::Run { config: from, .. }, None, true) =
            (&source.kind, &to.topology, transferred != Transferred::Nothing)
        {
            // What is held is free again, unless the search itself goes on.
            let kept = from.topology.as_ref();
            config.topology =
                kept.filter(|kept| kept.genes.is_empty() || transferred == Transferred::Population).cloned();
        }
        let net = match transferred {
            Transferred::Champion | Transferred::Held => Some(source.champion(false)?),
            Transferred::Topology => Some(source.champion(true)?),
            Transferred::Population | Transferred::Nothing => None,
        };
        let before = source.channels();
        if transferred == Transferred::Topology
            && let Some(net) = &net
        {
            let [inputs, outputs] = before.each_ref().map(|channels| names_of(channels));
            config.topology = Some(FrozenTopology { inputs, outputs, net: net.topology.clone(), genes: Vec::new() });
        }
        if let Some(frozen) = &config.topology {
            // The body's channels are known once it is built; the net has to wait for them.
            let bare = Setup::new(&RunConfig { topology: None, ..config.clone() }, registry)?;
            // What is lost from the source's is refused below, by name.
            let allow_loss = how.allow_loss || to.topology.is_none();
            config.topology = Some(frozen.remapped(bare.inputs(), bare.outputs(), allow_loss));
        }
        let mut setup = Setup::new(&config, registry)?;
        let [inputs, outputs] = [0, 1].map(|which| match &source.kind {
            Kind::Run { setup: old, .. } => TopologyMap::by_name(&old.searched[which], &setup.searched[which]),
            Kind::Champion(_) => TopologyMap::by_name(&names_of(&before[which]), &setup.searched[which]),
        });
        let genes = match (&source.kind, &net) {
            (_, Some(net)) => TopologyMap::by_name(&net.names, &setup.weight_names),
            (Kind::Run { setup: old, .. }, None) => TopologyMap::by_name(&old.weight_names, &setup.weight_names),
            (Kind::Champion(_), None) => TopologyMap::none(setup.topology.weight_count()),
        };
        let mut weights = net.as_ref().map_or_else(Vec::new, |net| carried(&genes, net, &setup));
        let finds_topology = entry.finds_topology();
        if transferred == Transferred::Held {
            check_new(&genes)?;
            let [inputs, outputs] = [setup.inputs(), setup.outputs()].map(channel_names);
            let is_new = |gene: usize| genes.origins()[gene].is_none();
            let net = setup.topology.held(&weights, is_new).map_err(|error| error.within("controller"))?;
            let records = setup.weight_names.iter().zip(&weights).enumerate();
            let records = records.map(|(gene, (name, &weight))| GeneRecord {
                name: name.clone(),
                held: (!is_new(gene)).then_some(weight),
            });
            config.topology = Some(FrozenTopology { inputs, outputs, net, genes: records.collect() });
            weights =
                weights.into_iter().enumerate().filter(|&(gene, _)| is_new(gene)).map(|(_, weight)| weight).collect();
            setup = Setup::new(&config, registry)?;
        }
        let mut departure =
            Self { config, setup, finds_topology, source, transferred, genes, inputs, outputs, weights };
        let origin = departure.origin(net.as_ref())?;
        if !how.allow_loss && transferred != Transferred::Nothing {
            departure.check_lost(&origin)?;
        }
        departure.config.origin = Some(origin);
        Ok(departure)
    }

    /// The search.
    ///
    /// # Errors
    /// If it cannot go on with these settings.
    pub(crate) fn search(&self, strategies: &StrategyCatalogue) -> Result<AnyStrategy, TransferError> {
        let (settings, topology) = (&self.config.strategy, &self.setup.topology);
        let begun = match (self.transferred, &self.source.kind) {
            (Transferred::Population, Kind::Run { folder, strategy, setup, .. }) => {
                let (genes, inputs, outputs) = (&self.genes, &self.inputs, &self.outputs);
                let search = read_checkpoint(strategy, folder)?.strategy;
                if !search.fits(&setup.topology) {
                    let what = "the nets that it searches";
                    return Err(FolderError::Foreign { path: folder.checkpoint(), what }.into());
                }
                return Ok(search.transfer(settings, &Transfer { topology, genes, inputs, outputs })?);
            }
            (Transferred::Nothing, _) => strategies.build(settings, topology),
            // Nothing is known of what is new: the strategy begins where it likes.
            (Transferred::Held, _) if self.weights.iter().all(|&weight| weight == 0.0) => {
                strategies.build(settings, topology)
            }
            (Transferred::Held, _) => {
                let express = |weights: &[f32]| Some(strategies.genome(settings, topology, weights)?.express());
                let guess = better_guess(&self.weights, express, &self.setup.task, Seed::of_run(self.config.seed));
                strategies.begin_about(settings, topology, &guess)
            }
            _ => strategies.begin_at(settings, topology, &self.weights),
        };
        Ok(begun.map_err(SetupError::from)?)
    }

    /// The source's champion in the new search, for which it may be too good to be lost; `None` where what is searched for is not its
    /// whole net, or the strategy has no genome for it.
    ///
    /// # Errors
    /// If a file of the source cannot be read.
    pub(crate) fn champion(&self, strategies: &StrategyCatalogue) -> Result<Option<AnyGenome>, TransferError> {
        let weights = match self.transferred {
            Transferred::Nothing | Transferred::Held => return Ok(None),
            Transferred::Champion | Transferred::Topology => self.weights.clone(),
            Transferred::Population if self.finds_topology => return Ok(None),
            Transferred::Population => match self.source.champion(false) {
                Ok(net) => carried(&TopologyMap::by_name(&net.names, &self.setup.weight_names), &net, &self.setup),
                Err(TransferError::NoChampion { .. }) => return Ok(None),
                Err(error) => return Err(error),
            },
        };
        Ok(strategies.genome(&self.config.strategy, &self.setup.topology, &weights))
    }

    fn origin(&self, net: Option<&ChampionNet>) -> Result<Origin, TransferError> {
        let generation = match (&self.source.kind, net) {
            (_, Some(net)) => net.generation,
            (Kind::Run { folder, .. }, None) => folder.read_standing()?.progress.generations,
            (Kind::Champion(champion), None) => champion.generation,
        };
        let counts_weights = !self.finds_topology && self.transferred != Transferred::Nothing;
        let counted = |count: usize| if counts_weights { count } else { 0 };
        let before = self.source.channels();
        let after = [self.setup.inputs(), self.setup.outputs()];
        // A population goes on with the inputs and outputs of the nets that are searched for.
        let (old, new) = match (&self.source.kind, self.transferred) {
            (Kind::Run { setup, .. }, Transferred::Population) => (setup.searched.clone(), self.setup.searched.clone()),
            _ => (before.each_ref().map(|channels| names_of(channels)), after.map(channel_names)),
        };
        let lost = lost(&old, &new);
        let rescaled = before.iter().zip(after).flat_map(|(before, after)| {
            let is_rescaled = |old: &&ChannelRecord| {
                after.iter().any(|channel| channel.name == old.name && channel.range != old.range)
            };
            before.iter().filter(is_rescaled).map(|old| old.name.clone()).collect::<Vec<_>>()
        });
        let rescaled = rescaled.collect();
        Ok(Origin {
            source: self.source.name.clone(),
            transferred: self.transferred,
            strategy: self.source.strategy().into(),
            generation,
            weights_kept: counted(self.genes.weight_count() - self.genes.gained()),
            weights_new: counted(self.genes.gained()),
            weights_lost: counted(self.genes.lost().len()),
            new_inputs: missing(&new[0], &old[0]),
            new_outputs: missing(&new[1], &old[1]),
            lost,
            rescaled,
        })
    }

    fn check_lost(&self, origin: &Origin) -> Result<(), TransferError> {
        let mut what: Vec<String> = origin.lost.iter().map(|name| format!("\"{name}\"")).collect();
        if what.is_empty() && origin.weights_lost > 0 {
            what.push(format!("{} of {} weights", origin.weights_lost, self.genes.old_weight_count()));
        }
        match what.is_empty() {
            true => Ok(()),
            false => Err(TransferError::Lost { what, allow: ALLOW_LOSS }),
        }
    }
}

/// Checks that a stage could go on from another, before there is anything to transfer.
///
/// # Errors
/// If what is asked to be transferred cannot be, or inputs or outputs would be lost that may not be, or that the strategy cannot
/// give up.
pub(super) fn check_planned(
    (from_settings, before): (&StrategySettings, &Setup),
    (to_settings, after): (&StrategySettings, &Setup),
    how: TransferOptions,
    strategies: &StrategyCatalogue,
) -> Result<(), TransferError> {
    let from = strategies.of(from_settings).map_err(SetupError::from)?;
    let to = strategies.of(to_settings).map_err(SetupError::from)?;
    let transferred = how.transferred.unwrap_or_else(|| usual(from, to));
    check_possible("the stage before", Some(from), transferred, to)?;
    let (old, new) = match transferred {
        Transferred::Population => (before.searched.clone(), after.searched.clone()),
        _ => (
            [before.inputs(), before.outputs()].map(channel_names),
            [after.inputs(), after.outputs()].map(channel_names),
        ),
    };
    let genes = TopologyMap::by_name(&before.weight_names, &after.weight_names);
    // The genomes of a strategy that finds topologies, and the net of a champion that is taken as it is, are not the planned one.
    let matters = transferred != Transferred::Topology && !from.finds_topology();
    if !how.allow_loss && transferred != Transferred::Nothing {
        let mut what: Vec<String> = lost(&old, &new).iter().map(|name| format!("\"{name}\"")).collect();
        let lost = genes.lost().len();
        if what.is_empty() && lost > 0 && matters {
            what.push(format!("{lost} of {} weights", genes.old_weight_count()));
        }
        if !what.is_empty() {
            return Err(TransferError::Lost { what, allow: ALLOW_LOSS });
        }
    }
    if transferred == Transferred::Held {
        check_new(&genes)?;
    }
    if transferred != Transferred::Population {
        return Ok(());
    }
    let [inputs, outputs] = [0, 1].map(|which| TopologyMap::by_name(&old[which], &new[which]));
    let transfer = Transfer { topology: &after.topology, genes: &genes, inputs: &inputs, outputs: &outputs };
    // A search that has not begun shows whether it could go on with the other nets.
    let search = strategies.build(from_settings, &before.topology).map_err(SetupError::from)?;
    search.transfer(from_settings, &transfer)?;
    Ok(())
}

/// The inputs and outputs of the old net that the new one has not; one of either kind may have the same name.
fn lost(old: &[Vec<String>; 2], new: &[Vec<String>; 2]) -> Vec<String> {
    let of_kind = |(kind, (old, new)): (_, (&Vec<String>, &Vec<String>))| {
        missing(old, new).into_iter().map(move |name| format!("{kind} {name}"))
    };
    ["input", "output"].into_iter().zip(old.iter().zip(new)).flat_map(of_kind).collect()
}

/// Checks that something is left to be searched for where all that was learned is held.
fn check_new(genes: &TopologyMap) -> Result<(), TransferError> {
    match genes.gained() {
        0 => Err(TransferError::Impossible(
            "the champion is held, and the new net has no weights but those of the champion: add a sensor, or transfer the \
             champion"
                .into(),
        )),
        _ => Ok(()),
    }
}

fn channel_names(channels: &[Channel]) -> Vec<String> {
    channels.iter().map(|channel| channel.name.clone()).collect()
}

/// Those of the names that are not among the others.
fn missing(names: &[String], others: &[String]) -> Vec<String> {
    names.iter().filter(|name| !others.contains(name)).cloned().collect()
}

/// What is transferred from a run by default.
fn usual(from: &StrategyEntry, to: &StrategyEntry) -> Transferred {
    match from {
        from if from.name() == to.name() => Transferred::Population,
        from if from.finds_topology() => Transferred::Topology,
        _ => Transferred::Champion,
    }
}

/// Checks that something can be transferred; `from` is `None` for a champion file.
fn check_possible(
    source: &str,
    from: Option<&StrategyEntry>,
    transferred: Transferred,
    to: &StrategyEntry,
) -> Result<(), TransferError> {
    let message = match (transferred, from) {
        (Transferred::Population, None) => {
            format!("{source} is one champion, and no population: name the folder of its run")
        }
        (Transferred::Population, Some(from)) if from.name() != to.name() => format!(
            "a population of {} is none of {}: transfer the champion or its topology, or keep the strategy",
            from.name(),
            to.name()
        ),
        (Transferred::Champion | Transferred::Held | Transferred::Topology, _) if to.finds_topology() => format!(
            "{0} goes on from a population of its own, and from no single net: choose another strategy, or go on from a \
             run with {0}",
            to.name()
        ),
        (Transferred::Champion | Transferred::Held, None) => format!(
            "{source} holds a net, and not the genes it was made from: transfer its topology, or name the folder of its run"
        ),
        (Transferred::Champion | Transferred::Held, Some(from)) if from.finds_topology() => {
            format!("a net that {} has found is transferred with its topology", from.name())
        }
        _ => return Ok(()),
    };
    Err(TransferError::Impossible(message))
}
