//! What a new search can begin from: a run, or a champion alone.

use super::{leading, stage_runs, transfer::TransferError};
use crate::Registry;
use crate::{
    champion::{Champion, ChannelRecord},
    config::RunConfig,
    episode_parts::SetupError,
    run_folder::{FolderError, RunFolder},
    setup::Setup,
    strategies::{AnyGenome, AnyStrategy, StrategyEntry},
    topology,
};
use ne_core::{Checkpoint, Genome, Strategy};
use ne_net::Topology;
use std::path::Path;

/// What a new search can begin from.
pub(crate) struct Source {
    pub(super) name: String,
    pub(super) kind: Kind,
}

pub(super) enum Kind {
    Run { folder: RunFolder, config: Box<RunConfig>, setup: Box<Setup>, strategy: StrategyEntry },
    Champion(Box<Champion>),
}

impl Source {
    /// A run folder, or a champion file; of a run with stages, the stage it has come to.
    pub(crate) fn open(path: &Path, registry: &Registry) -> Result<Self, TransferError> {
        if !path.is_dir() {
            let name = path.display().to_string();
            let champion = Champion::read(path).map_err(FolderError::from)?;
            return Ok(Self { name, kind: Kind::Champion(Box::new(champion)) });
        }
        let folder = leading_stage_run(RunFolder::open(path)?)?;
        Self::run(folder.path().display().to_string(), folder, registry)
    }

    /// A run, under a name of its own.
    pub(crate) fn run(name: String, folder: RunFolder, registry: &Registry) -> Result<Self, TransferError> {
        if !folder.checkpoint().is_file() {
            return Err(FolderError::NotARun { path: folder.path().into(), missing: "checkpoint".into() }.into());
        }
        let config = folder.read_config()?;
        let setup = Box::new(Setup::new(&config, registry)?);
        let strategy = registry.strategies.of(&config.strategy).map_err(SetupError::from)?.clone();
        Ok(Self { name, kind: Kind::Run { folder, config: Box::new(config), setup, strategy } })
    }

    pub(super) fn strategy(&self) -> &str {
        match &self.kind {
            Kind::Run { config, .. } => config.strategy.name(),
            Kind::Champion(champion) => &champion.strategy,
        }
    }

    pub(super) fn channels(&self) -> [Vec<ChannelRecord>; 2] {
        match &self.kind {
            Kind::Run { setup, .. } => {
                [setup.inputs(), setup.outputs()].map(|channels| channels.iter().map(Into::into).collect())
            }
            Kind::Champion(champion) => [champion.inputs.clone(), champion.outputs.clone()],
        }
    }

    /// The strategy, unless it is a champion alone.
    pub(super) fn strategy_entry(&self) -> Option<&StrategyEntry> {
        match &self.kind {
            Kind::Run { strategy, .. } => Some(strategy),
            Kind::Champion(_) => None,
        }
    }

    /// Whether the search of a run has left what it had found, and there is a champion to begin at.
    pub(super) fn has_begun_anew(&self) -> Result<bool, TransferError> {
        let Kind::Run { folder, strategy, .. } = &self.kind else { return Ok(false) };
        let checkpoint = read_checkpoint(strategy, folder)?;
        let someone = checkpoint.champion.is_some() || !checkpoint.candidates.is_empty();
        Ok(checkpoint.strategy.has_begun_anew() && someone)
    }

    /// Whether the search of a run has left what it had found, and found nothing since.
    pub(super) fn has_nothing_to_transfer(&self) -> Result<bool, TransferError> {
        match &self.kind {
            Kind::Run { folder, strategy, .. } => {
                Ok(read_checkpoint(strategy, folder)?.strategy.has_nothing_to_transfer())
            }
            Kind::Champion(_) => Ok(false),
        }
    }

    /// The net of the champion: its topology, its weights, and their names; expressed, or with its genes as they are
    /// searched.
    pub(super) fn champion(&self, expressed: bool) -> Result<ChampionNet, TransferError> {
        let [inputs, outputs] = self.channels().map(|channels| names_of(&channels));
        match &self.kind {
            Kind::Champion(champion) => {
                let topology = champion.network.topology();
                let names = topology::of_weights(&topology, &inputs, &outputs);
                let weights = champion.network.weights().to_vec();
                Ok(ChampionNet { topology, weights, names, generation: champion.generation })
            }
            Kind::Run { folder, config, setup, strategy } => {
                let found = read_champion(strategy, folder, expressed)?;
                let (topology, weights, generation) =
                    found.ok_or_else(|| TransferError::NoChampion { source_name: self.name.clone() })?;
                if let Some(frozen) = config.topology.as_ref().filter(|frozen| !expressed && !frozen.genes.is_empty()) {
                    // The whole net: what is held, and what was found.
                    let mut found = weights.into_iter();
                    let whole = frozen.genes.iter().filter_map(|gene| gene.held.or_else(|| found.next()));
                    let names = frozen.genes.iter().map(|gene| gene.name.clone()).collect();
                    return Ok(ChampionNet { topology, weights: whole.collect(), names, generation });
                }
                let names = match topology == setup.topology {
                    true => setup.weight_names.clone(),
                    false => topology::of_weights(&topology, &inputs, &outputs),
                };
                Ok(ChampionNet { topology, weights, names, generation })
            }
        }
    }
}

pub(super) struct ChampionNet {
    pub(super) topology: Topology,
    pub(super) weights: Vec<f32>,
    pub(super) names: Vec<String>,
    pub(super) generation: u64,
}

pub(super) fn names_of(channels: &[ChannelRecord]) -> Vec<String> {
    channels.iter().map(|channel| channel.name.clone()).collect()
}

/// The folder that a run is to be gone on from: of one with stages, that of the stage run whose champion is the run's.
///
/// # Errors
/// If a file of a stage run cannot be read.
pub(super) fn leading_stage_run(folder: RunFolder) -> Result<RunFolder, FolderError> {
    if folder.checkpoint().is_file() {
        return Ok(folder);
    }
    let stage_runs = stage_runs(&folder)?;
    let stage_run = leading(&stage_runs).or(stage_runs.last());
    Ok(stage_run.map_or(folder, |stage_run| RunFolder::at(&stage_run.folder)))
}

pub(super) fn read_checkpoint(
    strategy: &StrategyEntry,
    folder: &RunFolder,
) -> Result<Checkpoint<AnyStrategy>, TransferError> {
    Ok(strategy.read_checkpoint(&folder.checkpoint()).map_err(FolderError::from)?)
}

/// Reads the champion out of a checkpoint: its topology and weights, and the generation it was found in.
///
/// It is the one in the champion file, which may still wait there for a re-evaluation, or be what the strategy recommends. If a
/// kill has diverged the two files, it is the champion of the checkpoint, or the best that waits for the first re-evaluation.
fn read_champion(
    strategy: &StrategyEntry,
    folder: &RunFolder,
    expressed: bool,
) -> Result<Option<(Topology, Vec<f32>, u64)>, TransferError> {
    let Checkpoint { champion, candidates, strategy: search, progress, .. } = read_checkpoint(strategy, folder)?;
    let file = folder.champion();
    let written = file.is_file().then(|| Champion::read(&file)).transpose().map_err(FolderError::from)?;
    let is_written = |genome: &AnyGenome, generation: u64| {
        let is_it = |written: &Champion| written.generation == generation && written.network == genome.express();
        written.as_ref().is_some_and(is_it)
    };
    let kept = candidates.iter().find(|candidate| is_written(&candidate.genome, candidate.generation));
    let kept = kept.map(|candidate| (candidate.genome.clone(), candidate.generation));
    let recommended = search.recommendation().map(|genome| (genome, progress.generations));
    let kept = kept.or(recommended.filter(|(genome, generation)| is_written(genome, *generation)));
    let heard = champion.map(|champion| (champion.genome, champion.generation));
    // Of equals the first.
    let waiting = candidates.into_iter().rev().max_by_key(|candidate| candidate.fitness);
    let best = kept.or(heard).or_else(|| waiting.map(|candidate| (candidate.genome, candidate.generation)));
    Ok(best.map(|(genome, generation)| {
        let (topology, weights) = genome.net(expressed);
        (topology, weights, generation)
    }))
}
