//! Writes a run down while it goes on.

use crate::{
    champion::Champion,
    config::RunConfig,
    front::Front,
    run_folder::{
        FolderError, GalleryEntry, GalleryKind, GalleryMember, RunFolder, Timing,
        lines::{Kept, LineFile},
    },
    setup::Setup,
};
use ne_core::{
    Evaluation, Evolution, Generation, GenerationReport, Genome, Observer, ObserverError, Strategy, TieredFitness,
    promotion::Decision,
};
use ne_net::Network;
use std::time::Instant;

/// The observer that fills a run folder.
///
/// Lines are appended each generation; checkpoint, champion and front are brought up to date every few generations,
/// after the lines they belong to are on the disk.
pub(crate) struct Recorder<'a> {
    folder: &'a RunFolder,
    config: &'a RunConfig,
    setup: &'a Setup,
    log: LineFile,
    gallery: LineFile,
    timing: LineFile,
    last: Instant,
    /// The generation of the champion in the file, once we have written it.
    written: Option<u64>,
    called: &'a mut dyn FnMut(&GenerationReport),
}

/// The lines of an earlier run as far as its checkpoint goes: checked, and nothing changed on the disk yet.
pub(crate) struct EarlierLines {
    log: Kept,
    gallery: Kept,
    timing: Kept,
}

impl EarlierLines {
    /// Checks the lines of the first `generations` generations.
    pub(crate) fn check(folder: &RunFolder, config: &RunConfig, generations: u64) -> Result<Self, FolderError> {
        let generations = usize::try_from(generations).unwrap_or(usize::MAX);
        let (log, reports) = Kept::check::<GenerationReport>(&folder.log(), generations)?;
        // The log tells how many lines the gallery must have.
        let mut best = None;
        let mut entries = 0;
        for report in &reports {
            let champion = report.best_so_far.map(|fitness| TieredFitness { tier: report.tier, fitness });
            entries += usize::from(champion > best);
            entries += usize::from(config.record.populations_at.contains(&report.generation));
            best = champion;
        }
        let (gallery, _) = Kept::check::<GalleryEntry>(&folder.gallery(), entries)?;
        let (timing, _) = Kept::check::<Timing>(&folder.timing(), generations)?;
        Ok(Self { log, gallery, timing })
    }
}

impl<'a> Recorder<'a> {
    /// Goes on after these lines; whatever the files hold beyond them is dropped.
    pub(crate) fn new(
        folder: &'a RunFolder,
        config: &'a RunConfig,
        setup: &'a Setup,
        earlier: EarlierLines,
        called: &'a mut dyn FnMut(&GenerationReport),
    ) -> Result<Self, FolderError> {
        let EarlierLines { log, gallery, timing } = earlier;
        let (log, gallery, timing) = (log.open()?, gallery.open()?, timing.open()?);
        Ok(Self { folder, config, setup, log, gallery, timing, last: Instant::now(), written: None, called })
    }

    /// Brings everything to the disk: lines first, then champion and front, then checkpoint.
    ///
    /// `champion`: what the champion file is to have, which may be one that the checkpoint does not know of.
    pub(crate) fn save<S: Strategy>(
        &mut self,
        evolution: &Evolution<S>,
        champion: Option<&ne_core::Champion<S::Genome>>,
    ) -> Result<(), FolderError>
    where
        <S::Genome as Genome>::Phenotype: Into<Network>,
    {
        let _span = tracing::debug_span!("checkpoint").entered();
        self.sync()?;
        self.write_champion(evolution.strategy().name(), champion)?;
        self.write_front(evolution.strategy(), evolution.progress().generations)?;
        Ok(evolution.write_checkpoint(&self.folder.checkpoint())?)
    }

    /// Whether there is a champion, and its file is up to date.
    pub(crate) fn has_champion(&self) -> bool {
        self.written.is_some()
    }

    fn sync(&mut self) -> Result<(), FolderError> {
        self.log.sync()?;
        self.gallery.sync()?;
        Ok(self.timing.sync()?)
    }

    fn write_champion<G: Genome>(
        &mut self,
        strategy: &str,
        champion: Option<&ne_core::Champion<G>>,
    ) -> Result<(), FolderError>
    where
        G::Phenotype: Into<Network>,
    {
        let Some(champion) = champion.filter(|champion| self.written != Some(champion.generation)) else {
            return Ok(());
        };
        Champion::new(self.config, self.setup, strategy, champion).write(&self.folder.champion())?;
        self.written = Some(champion.generation);
        Ok(())
    }

    /// Nothing, for a strategy that knows no front.
    fn write_front<S: Strategy>(&self, strategy: &S, generation: u64) -> Result<(), FolderError>
    where
        <S::Genome as Genome>::Phenotype: Into<Network>,
    {
        match strategy.front() {
            Some(points) => Ok(Front::new(generation, &self.setup.objectives, &points).write(&self.folder.front())?),
            None => Ok(()),
        }
    }

    fn keep(&mut self, generation: u64, kind: GalleryKind, members: Vec<GalleryMember>) -> Result<(), FolderError> {
        Ok(self.gallery.write(&GalleryEntry { generation, kind, members })?)
    }

    fn record<S: Strategy>(&mut self, event: &Generation<'_, S>) -> Result<(), FolderError>
    where
        <S::Genome as Genome>::Phenotype: Into<Network>,
    {
        let generation = event.report.generation;
        self.log.write(event.report)?;
        if let Some(champion) = event.champion.filter(|_| event.improved) {
            let member = GalleryMember { fitness: Some(champion.fitness), network: champion.genome.express().into() };
            self.keep(generation, GalleryKind::Champion, vec![member])?;
        }
        if self.config.record.populations_at.contains(&generation) {
            let member = |(genome, evaluation): (&S::Genome, &Evaluation)| GalleryMember {
                fitness: evaluation.fitness(),
                network: genome.express().into(),
            };
            let members = event.genomes.iter().zip(event.evaluations).map(member).collect();
            self.keep(generation, GalleryKind::Population, members)?;
        }
        let seconds = self.last.elapsed().as_secs_f64();
        self.last = Instant::now();
        self.timing.write(&Timing { generation, seconds })?;
        // A stage that is passed or left is saved once it has ended, with the champion that goes on from it.
        let goes_on = event.decision == Decision::Stay;
        if goes_on && generation.is_multiple_of(self.config.record.checkpoint_every) {
            let _span = tracing::debug_span!("checkpoint").entered();
            self.sync()?;
            self.write_champion(event.strategy.name(), event.champion)?;
            self.write_front(event.strategy, generation)?;
            event.write_checkpoint(&self.folder.checkpoint())?;
        }
        Ok(())
    }
}

impl<S: Strategy> Observer<S> for &mut Recorder<'_>
where
    <S::Genome as Genome>::Phenotype: Into<Network>,
{
    fn generation(&mut self, event: &Generation<'_, S>) -> Result<(), ObserverError> {
        self.record(event)?;
        (self.called)(event.report);
        Ok(())
    }
}
