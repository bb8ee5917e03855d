//! Writes a run down while it goes on.

use crate::{
    champion::Champion,
    config::RunConfig,
    front::Front,
    run_folder::{
        ChampionStanding, FolderError, FolderLock, GalleryEntry, GalleryKind, GalleryMember, RunFolder, Timing,
        lines::{Kept, LineFile},
    },
    setup::Setup,
    strategies::AnyStrategy,
};
use ne_core::{
    Evaluation, Evolution, Generation, GenerationReport, Genome, Observer, ObserverError, Progress, Seed, Strategy,
    TieredFitness, promotion::Decision,
};
use ne_net::Network;
use std::{cmp::Reverse, time::Instant};

/// So many individuals of a population are in the gallery at most: a report shows fewer, and a line is made in memory.
pub(crate) const GALLERY_MEMBERS: usize = 1000;

/// The observer that fills a run folder.
///
/// Lines are appended each generation; checkpoint, champion and front are brought up to date every few generations,
/// after the lines they belong to are on the disk.
pub(crate) struct Recorder {
    folder: RunFolder,
    lock: FolderLock,
    log: LineFile,
    gallery: LineFile,
    timing: LineFile,
    last: Instant,
    /// The generation of the champion in the file, once we have written it.
    written: Option<u64>,
}

/// The run that is written down.
#[derive(Clone, Copy)]
pub(crate) struct Recorded<'a> {
    pub(crate) config: &'a RunConfig,
    pub(crate) setup: &'a Setup,
}

/// The observer of a generation: records it, then calls a function.
pub(crate) struct Recording<'a> {
    pub(crate) recorder: &'a mut Recorder,
    pub(crate) run: Recorded<'a>,
    pub(crate) called: &'a mut dyn FnMut(&Generation<'_, AnyStrategy>),
}

/// The lines of an earlier run as far as its checkpoint goes: checked, and nothing changed on the disk yet.
pub(crate) struct EarlierLines {
    log: Kept,
    gallery: Kept,
    timing: Kept,
}

impl EarlierLines {
    /// Checks the lines of a run that stands here.
    pub(crate) fn check(
        folder: &RunFolder,
        config: &RunConfig,
        progress: &Progress,
        champion: Option<TieredFitness>,
    ) -> Result<Self, FolderError> {
        let generations = usize::try_from(progress.generations).unwrap_or(usize::MAX);
        let (log, reports) = Kept::check::<GenerationReport>(&folder.log(), generations)?;
        // The log tells which lines the gallery must have: the generation of each and, of a champion, the fitness.
        let mut best = None;
        let mut expected = Vec::new();
        for report in &reports {
            let champion = report.best_so_far.map(|fitness| TieredFitness { tier: report.tier, fitness });
            if champion > best {
                expected.push((report.generation, report.best_so_far));
            }
            if config.record.populations_at.contains(&report.generation) {
                expected.push((report.generation, None));
            }
            best = champion;
        }
        if let Some(last) = reports.last()
            && ((last.evaluations, last.steps) != (progress.evaluations, progress.steps) || best != champion)
        {
            return Err(FolderError::ForeignLog { path: folder.log(), generation: last.generation });
        }
        let (gallery, entries) = Kept::check::<GalleryEntry>(&folder.gallery(), expected.len())?;
        let told = |entry: &GalleryEntry| {
            let champion = entry.members.first().filter(|_| entry.kind == GalleryKind::Champion);
            (entry.generation, champion.and_then(|champion| champion.fitness))
        };
        if let Some(place) = entries.iter().zip(&expected).position(|(entry, expected)| told(entry) != *expected) {
            let message = "it is of another run than the log".into();
            return Err(FolderError::Line { path: folder.gallery(), line: place + 1, message });
        }
        let (timing, _) = Kept::check::<Timing>(&folder.timing(), generations)?;
        Ok(Self { log, gallery, timing })
    }
}

/// Checks that the files of lines have all that they had when the checkpoint was written.
///
/// # Errors
/// If a line is damaged or missing; the error names file and line.
pub fn check_lines(folder: &RunFolder, config: &RunConfig) -> Result<(), FolderError> {
    let standing = folder.read_standing()?;
    let foreign = |what| Err(FolderError::Foreign { path: folder.checkpoint(), what });
    if standing.seed != Seed::of_run(config.seed) {
        return foreign("the seed");
    }
    if standing.label != config.label() {
        return foreign("its settings");
    }
    let champion = standing.champion.map(|ChampionStanding { tier, fitness, .. }| TieredFitness { tier, fitness });
    EarlierLines::check(folder, config, &standing.progress, champion).map(drop)
}

/// The champion of a run with this configuration, if it has one.
///
/// # Errors
/// If the file cannot be read, is damaged, is the champion of another run, or older than that of the checkpoint.
pub fn read_champion(folder: &RunFolder, config: &RunConfig) -> Result<Option<Champion>, FolderError> {
    let path = folder.champion();
    if !path.is_file() {
        return Ok(None);
    }
    let champion = Champion::read(&path)?;
    if let Some(what) = champion.differs_from(config) {
        return Err(FolderError::ForeignChampion { path, what });
    }
    // A run with stages has a checkpoint for each.
    if folder.checkpoint().is_file()
        && let Some(ChampionStanding { generation: expected, .. }) = folder.read_standing()?.champion
        && champion.generation < expected
    {
        return Err(FolderError::OldChampion { path, found: champion.generation, expected });
    }
    Ok(Some(champion))
}

impl Recorder {
    /// Goes on after these lines; whatever the files hold beyond them is dropped.
    pub(crate) fn new(folder: RunFolder, lock: FolderLock, earlier: EarlierLines) -> Result<Self, FolderError> {
        let EarlierLines { log, gallery, timing } = earlier;
        let (log, gallery, timing) = (log.open()?, gallery.open()?, timing.open()?);
        Ok(Self { folder, lock, log, gallery, timing, last: Instant::now(), written: None })
    }

    /// The last save: brings everything to the disk, lines first, then champion and front, then the checkpoint, which says
    /// that it is the last.
    ///
    /// `champion`: what the champion file is to have, which may be one that the checkpoint does not know of.
    pub(crate) fn finish<S: Strategy>(
        &mut self,
        run: Recorded<'_>,
        evolution: &Evolution<S>,
        champion: Option<&ne_core::Champion<S::Genome>>,
    ) -> Result<(), FolderError>
    where
        <S::Genome as Genome>::Phenotype: Into<Network>,
    {
        let _span = tracing::debug_span!("checkpoint").entered();
        self.sync()?;
        self.write_champion(run, evolution.strategy().name(), champion)?;
        self.write_front(run, evolution.strategy(), evolution.progress().generations)?;
        Ok(evolution.write_last_checkpoint(&self.folder.checkpoint())?)
    }

    /// Whether there is a champion, and its file is up to date.
    pub(crate) fn has_champion(&self) -> bool {
        self.written.is_some()
    }

    /// To be done before anything is written by its path.
    fn sync(&mut self) -> Result<(), FolderError> {
        self.lock.check(self.folder.path())?;
        self.log.sync()?;
        self.gallery.sync()?;
        Ok(self.timing.sync()?)
    }

    fn write_champion<G: Genome>(
        &mut self,
        run: Recorded<'_>,
        strategy: &str,
        champion: Option<&ne_core::Champion<G>>,
    ) -> Result<(), FolderError>
    where
        G::Phenotype: Into<Network>,
    {
        let Some(champion) = champion.filter(|champion| self.written != Some(champion.generation)) else {
            return Ok(());
        };
        Champion::new(run.config, run.setup, strategy, champion).write(&self.folder.champion())?;
        self.written = Some(champion.generation);
        Ok(())
    }

    /// Nothing, for a strategy that knows no front.
    fn write_front<S: Strategy>(&self, run: Recorded<'_>, strategy: &S, generation: u64) -> Result<(), FolderError>
    where
        <S::Genome as Genome>::Phenotype: Into<Network>,
    {
        match strategy.front() {
            Some(points) => Ok(Front::new(generation, &run.setup.objectives, &points).write(&self.folder.front())?),
            None => Ok(()),
        }
    }

    fn keep(&mut self, generation: u64, kind: GalleryKind, members: Vec<GalleryMember>) -> Result<(), FolderError> {
        Ok(self.gallery.write(&GalleryEntry { generation, kind, members })?)
    }

    fn record<S: Strategy>(&mut self, run: Recorded<'_>, event: &Generation<'_, S>) -> Result<(), FolderError>
    where
        <S::Genome as Genome>::Phenotype: Into<Network>,
    {
        let generation = event.report.generation;
        self.log.write(event.report)?;
        if let Some(champion) = event.champion.filter(|_| event.improved) {
            let member = GalleryMember { fitness: Some(champion.fitness), network: champion.genome.express().into() };
            self.keep(generation, GalleryKind::Champion, vec![member])?;
        }
        if run.config.record.populations_at.contains(&generation) {
            let member = |(genome, evaluation): (&S::Genome, &Evaluation)| GalleryMember {
                fitness: evaluation.fitness(),
                network: genome.express().into(),
            };
            let kept = spread_by_rank(event.evaluations).into_iter();
            let members = kept.map(|index| member((&event.genomes[index], &event.evaluations[index]))).collect();
            self.keep(generation, GalleryKind::Population, members)?;
        }
        let seconds = self.last.elapsed().as_secs_f64();
        self.last = Instant::now();
        self.timing.write(&Timing { generation, seconds })?;
        // A stage that is passed or left is saved once it has ended, with the champion that goes on from it.
        let goes_on = event.decision == Decision::Stay;
        if goes_on && generation.is_multiple_of(run.config.record.checkpoint_every) {
            let _span = tracing::debug_span!("checkpoint").entered();
            self.sync()?;
            self.write_champion(run, event.strategy.name(), event.champion)?;
            self.write_front(run, event.strategy, generation)?;
            event.write_checkpoint(&self.folder.checkpoint())?;
        }
        Ok(())
    }
}

/// The indices of those individuals that are kept of a population: all of one that is not too large, else from the best to the worst, evenly.
fn spread_by_rank(evaluations: &[Evaluation]) -> Vec<usize> {
    let mut indices: Vec<usize> = (0..evaluations.len()).collect();
    if evaluations.len() > GALLERY_MEMBERS {
        indices.sort_by_key(|&index| Reverse(evaluations[index].fitness()));
        let last = evaluations.len() - 1;
        indices = (0..GALLERY_MEMBERS).map(|place| indices[place * last / (GALLERY_MEMBERS - 1)]).collect();
        indices.sort_unstable();
    }
    indices
}

impl Observer<AnyStrategy> for Recording<'_> {
    fn generation(&mut self, event: &Generation<'_, AnyStrategy>) -> Result<(), ObserverError> {
        self.recorder.record(self.run, event)?;
        (self.called)(event);
        Ok(())
    }
}
