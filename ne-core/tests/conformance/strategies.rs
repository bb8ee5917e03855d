use crate::{
    Cases, assert_caught,
    common::{Climber, Weights},
};
use ne_core::{
    Evaluation, Fitness, FrontPoint, Origin, Seed, SpeciesReport, Statistic, Strategy,
    conformance::{StrategyOptions, check_strategy, genome, strategy::*},
};
use serde::{Deserialize, Serialize};
use std::sync::atomic::{AtomicU32, Ordering};

/// The toy strategy, with one flaw.
#[derive(Serialize, Deserialize)]
struct Flawed {
    inner: Climber,
    flaw: Flaw,
    asked: Vec<Weights>,
    #[serde(skip)]
    unsaved: u32,
    #[serde(skip)]
    origins: Vec<Origin>,
    failed: bool,
    extreme: bool,
    restless: f32,
    questions: u64,
}

#[derive(Clone, Copy, PartialEq, Serialize, Deserialize)]
enum Flaw {
    None,
    GivesUp,
    NameWithSpaces,
    NameCounts,
    AsksNothing,
    Dwindles,
    StatisticNan,
    StatisticComesAndGoes,
    StatisticTwice,
    OriginsOfFew,
    OrphanWithParents,
    CopyThatDiffers,
    SpeciesOfNobody,
    AskedByChance,
    IgnoresSeed,
    ForgetsInFile,
    ForgetsItsAnswer,
    ForgetsItsFront,
    CannotBeReadBack,
    CountsQuestions,
    GenomesWithNan,
    PanicsWhenAllFail,
    ShrinksWhenAllFail,
    NanAtExtremes,
}

static ASKED: AtomicU32 = AtomicU32::new(0);

impl Flawed {
    fn new(flaw: Flaw) -> Self {
        let restless = if flaw == Flaw::CannotBeReadBack { f32::INFINITY } else { 0.0 };
        let inner = Climber::new(6);
        let (asked, origins) = (Vec::new(), Vec::new());
        Self { inner, flaw, asked, unsaved: 0, origins, failed: false, extreme: false, restless, questions: 0 }
    }
}

impl Strategy for Flawed {
    type Genome = Weights;

    fn name(&self) -> &str {
        match self.flaw {
            Flaw::NameWithSpaces => "Hill Climber",
            Flaw::NameCounts if self.unsaved % 2 == 1 => "climber-1",
            _ => self.inner.name(),
        }
    }

    fn ask(&mut self, seed: Seed) -> &[Weights] {
        let generation = seed.generation_index();
        self.questions += 1;
        let seed = if self.flaw == Flaw::CountsQuestions { seed.generation(self.questions) } else { seed };
        let seed = if self.flaw == Flaw::IgnoresSeed { Seed::of_run(9).generation(generation) } else { seed };
        self.asked = self.inner.ask(seed).to_vec();
        match self.flaw {
            Flaw::AsksNothing if generation == 3 => self.asked.clear(),
            Flaw::Dwindles if generation > 4 => self.asked.truncate(5),
            Flaw::AskedByChance => self.asked[0].0[0] = ASKED.fetch_add(1, Ordering::Relaxed) as f32,
            Flaw::ForgetsInFile => self.asked[1].0[0] += self.unsaved as f32,
            Flaw::GenomesWithNan => self.asked[0].0.push(f32::NAN),
            Flaw::ShrinksWhenAllFail if self.failed => self.asked.truncate(1),
            Flaw::NanAtExtremes if self.extreme => self.asked[2].0.push(f32::NAN),
            _ => {}
        }
        let count = self.asked.len();
        self.origins = match self.flaw {
            Flaw::OriginsOfFew => vec![Origin::New; count - 1],
            Flaw::OrphanWithParents => vec![Origin::Child([0, 1]); count],
            Flaw::CopyThatDiffers if generation == 2 => vec![Origin::Copy(1); count],
            _ => Vec::new(),
        };
        &self.asked
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        self.failed = evaluations.iter().all(|evaluation| evaluation.outcome.is_err());
        self.extreme |= evaluations.iter().filter_map(Evaluation::fitness).any(|fitness| fitness.get() > 1e100);
        self.unsaved += 1;
        assert!(!(self.failed && self.flaw == Flaw::PanicsWhenAllFail), "no individual left");
        assert!(!(self.flaw == Flaw::GivesUp && seed.generation_index() == 2), "this is hopeless");
        self.inner.tell(evaluations, seed);
    }

    fn statistics(&self) -> Vec<Statistic> {
        let mut statistics = self.inner.statistics();
        match self.flaw {
            Flaw::StatisticNan => statistics.push(Statistic::new("ratio", f64::from(self.unsaved / 8) / 0.0)),
            Flaw::StatisticComesAndGoes if self.unsaved == 3 => drop(statistics.pop()),
            Flaw::StatisticTwice => statistics.extend(statistics.clone()),
            _ => {}
        }
        statistics
    }

    fn origins(&self) -> &[Origin] {
        &self.origins
    }

    fn memberships(&self) -> Vec<u64> {
        if self.flaw == Flaw::SpeciesOfNobody { vec![1; self.asked.len()] } else { Vec::new() }
    }

    fn recommendation(&self) -> Option<Weights> {
        let generations = self.unsaved as f32;
        (self.flaw == Flaw::ForgetsItsAnswer).then(|| Weights(vec![generations; self.asked[0].0.len()]))
    }

    fn front(&self) -> Option<Vec<FrontPoint<'_, Weights>>> {
        let (fitness, generation) = (Fitness::new(1.0).expect("a number"), self.unsaved.into());
        let point = || FrontPoint { genome: &self.asked[0], fitness, objectives: &[], generation };
        (self.flaw == Flaw::ForgetsItsFront).then(|| vec![point()])
    }

    fn species(&self) -> Vec<SpeciesReport> {
        let best = None;
        if self.flaw == Flaw::SpeciesOfNobody { vec![SpeciesReport { id: 2, size: 1, best }] } else { Vec::new() }
    }
}

#[test]
fn broken_strategies_are_caught() {
    let check = |flaw: Flaw| check_strategy(|| Flawed::new(flaw), &StrategyOptions::default());
    assert_eq!(check(Flaw::None), Ok(()));
    let cases: Cases<'_> = vec![
        (RUNS, "gives up", check(Flaw::GivesUp)),
        (NAME, "name with spaces", check(Flaw::NameWithSpaces)),
        (NAME, "name counts", check(Flaw::NameCounts)),
        (POPULATION, "asks nothing", check(Flaw::AsksNothing)),
        (POPULATION, "dwindles", check(Flaw::Dwindles)),
        (SHAPE, "genomes of two shapes", check_strategy(|| Mixed(Vec::new()), &StrategyOptions::default())),
        (STATISTICS, "a statistic is NaN", check(Flaw::StatisticNan)),
        (STATISTICS, "a statistic comes and goes", check(Flaw::StatisticComesAndGoes)),
        (STATISTICS, "a statistic twice", check(Flaw::StatisticTwice)),
        (DESCENT, "fewer origins than genomes", check(Flaw::OriginsOfFew)),
        (DESCENT, "parents of the first generation", check(Flaw::OrphanWithParents)),
        (DESCENT, "copies that differ", check(Flaw::CopyThatDiffers)),
        (DESCENT, "species without members", check(Flaw::SpeciesOfNobody)),
        (DETERMINISTIC, "asks by chance of its own", check(Flaw::AskedByChance)),
        (USES_SEED, "ignores the seed", check(Flaw::IgnoresSeed)),
        (RESUMES, "forgets in a file", check(Flaw::ForgetsInFile)),
        (RESUMES, "forgets its answer in a file", check(Flaw::ForgetsItsAnswer)),
        (RESUMES, "forgets its front in a file", check(Flaw::ForgetsItsFront)),
        (RESUMES, "cannot be read back", check(Flaw::CannotBeReadBack)),
        (REPEATS, "counts what it is asked", check(Flaw::CountsQuestions)),
        (genome::SURVIVES_A_FILE, "genomes with NaN", check(Flaw::GenomesWithNan)),
        (OUTLIVES_FAILURE, "panics when all fail", check(Flaw::PanicsWhenAllFail)),
        (OUTLIVES_FAILURE, "shrinks when all fail", check(Flaw::ShrinksWhenAllFail)),
        (OUTLIVES_EXTREMES, "NaN at extremes", check(Flaw::NanAtExtremes)),
    ];
    assert_caught(&cases, PROMISES);
}

/// Asks for puppets of two shapes.
#[derive(Serialize, Deserialize)]
struct Mixed(Vec<ne_core::conformance::Puppet>);

impl Strategy for Mixed {
    type Genome = ne_core::conformance::Puppet;

    fn name(&self) -> &str {
        "mixed"
    }

    fn ask(&mut self, seed: Seed) -> &[Self::Genome] {
        let puppet = |outputs| Self::Genome::new(2, outputs, seed.generation_index());
        self.0 = vec![puppet(1), puppet(2)];
        &self.0
    }

    fn tell(&mut self, _: &[Evaluation], _: Seed) {}
}
