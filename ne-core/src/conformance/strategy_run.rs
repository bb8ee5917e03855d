use super::genome::to_json;
use super::probe::Behaviour;
use crate::{Evaluation, Failure, FrontPoint, Genome, Origin, Phenotype, Seed, SpeciesReport, Strategy};

/// What a strategy did in one generation, as text that tells every bit.
#[derive(Clone, Debug)]
pub(super) struct Told<G> {
    /// The strategy's name in this generation.
    pub(super) name: String,
    /// A few genomes as they are in memory.
    pub(super) sample: Vec<G>,
    /// All genomes as JSON.
    pub(super) genomes: Vec<String>,
    /// Inputs and outputs of each.
    pub(super) shapes: Vec<(usize, usize)>,
    /// Name and value of each.
    pub(super) statistics: Vec<(String, f64)>,
    pub(super) origins: Vec<Origin>,
    pub(super) memberships: Vec<u64>,
    pub(super) species: Vec<SpeciesReport>,
    /// The genome that the search would give as its answer.
    recommendation: Option<String>,
    /// Genome, fitness, objectives and generation of each compromise.
    front: Option<Vec<String>>,
}

/// How many genomes of a generation are kept as they are.
const SAMPLE: usize = 4;

/// Which results a strategy is told.
#[derive(Clone, Copy, Debug)]
pub(super) enum Results {
    /// A fitness by behaviour; a seventh fail.
    Ordinary,
    /// Every evaluation fails in generations 1, 4, 5 and 6; ordinary ones between.
    TotalFailures,
    /// All equal, then of huge and of tiny size, then ordinary ones.
    Extreme,
}

impl Results {
    fn evaluate<G: Genome>(self, genome: &G, index: usize, generation: u64) -> Evaluation {
        let failed = Evaluation::failed(Failure::Other { what: "a failure on purpose".into() });
        let sign = if index.is_multiple_of(2) { 1.0 } else { -1.0 };
        let ordinary = || {
            let number = index as u64 + generation;
            let evaluation = Evaluation::new(Behaviour::of(&mut genome.express(), 0.0).score()).with_steps(number);
            if number % 7 == 3 { failed.clone() } else { evaluation }
        };
        match (self, generation) {
            (Self::TotalFailures, 1 | 4..=6) => failed,
            (Self::Extreme, 1) => Evaluation::new(1.0),
            (Self::Extreme, 2) => Evaluation::new(1e300 * sign),
            (Self::Extreme, 3) => Evaluation::new(f64::MAX * sign),
            (Self::Extreme, 4) => Evaluation::new(f64::MIN_POSITIVE * sign),
            (Self::Extreme, 5) => Evaluation::new(0.0),
            _ => ordinary(),
        }
    }
}

/// One generation, as [`Evolution`](crate::Evolution) runs it.
pub(super) fn generation<S: Strategy>(
    strategy: &mut S,
    run: Seed,
    generation: u64,
    results: Results,
) -> Result<Told<S::Genome>, String> {
    let seed = run.generation(generation);
    let genomes = strategy.ask(seed).to_vec();
    let evaluations: Vec<Evaluation> =
        genomes.iter().enumerate().map(|(index, genome)| results.evaluate(genome, index, generation)).collect();
    // A strategy that asked for nothing need not understand an answer; the check of the population says so.
    if !genomes.is_empty() {
        strategy.tell(&evaluations, seed);
    }
    let shape = |genome: &S::Genome| {
        let phenotype = genome.express();
        (phenotype.inputs(), phenotype.outputs())
    };
    let compromise = |point: &FrontPoint<'_, S::Genome>| {
        let FrontPoint { genome, fitness, objectives, generation } = point;
        Ok(format!("{} {fitness:?} {objectives:?} of generation {generation}", to_json(*genome)?))
    };
    let front = strategy.front().map(|front| front.iter().map(compromise).collect::<Result<_, String>>());
    Ok(Told {
        name: strategy.name().into(),
        sample: genomes.iter().take(SAMPLE).cloned().collect(),
        shapes: genomes.iter().map(shape).collect(),
        genomes: genomes.iter().map(to_json).collect::<Result<_, _>>()?,
        statistics: strategy.statistics().into_iter().map(|statistic| (statistic.name, statistic.value)).collect(),
        origins: strategy.origins().to_vec(),
        memberships: strategy.memberships(),
        species: strategy.species(),
        recommendation: strategy.recommendation().as_ref().map(to_json).transpose()?,
        front: front.transpose()?,
    })
}

/// A whole run.
pub(super) fn run<S: Strategy>(
    mut strategy: S,
    seed: Seed,
    generations: u64,
    results: Results,
) -> Result<Vec<Told<S::Genome>>, String> {
    (1..=generations).map(|number| generation(&mut strategy, seed, number, results)).collect()
}

/// An error that says where two runs differ, if they do.
pub(super) fn same<G>(found: &[Told<G>], expected: &[Told<G>], what: &str) -> Result<(), String> {
    for (generation, (found, expected)) in (1..).zip(found.iter().zip(expected)) {
        let place = format!("{what}, generation {generation}");
        if found.genomes.len() != expected.genomes.len() {
            return Err(format!("{place}: {} genomes against {}", found.genomes.len(), expected.genomes.len()));
        }
        if let Some(index) = (0..found.genomes.len()).find(|&index| found.genomes[index] != expected.genomes[index]) {
            let (found, expected) = around_difference(&found.genomes[index], &expected.genomes[index]);
            return Err(format!("{place}, genome {index}: {found} against {expected}"));
        }
        let bits = |told: &Told<G>| -> Vec<_> {
            told.statistics.iter().map(|(name, value)| (name.clone(), value.to_bits())).collect()
        };
        if bits(found) != bits(expected) {
            return Err(format!("{place}, statistics: {:?} against {:?}", found.statistics, expected.statistics));
        }
        let further = |told: &Told<G>| {
            let Told { species, memberships, recommendation, front, .. } = told;
            [
                ("species", format!("{species:?}")),
                ("memberships", format!("{memberships:?}")),
                ("recommendation", format!("{recommendation:?}")),
                ("front", format!("{front:?}")),
            ]
        };
        for ((what, found), (_, expected)) in further(found).into_iter().zip(further(expected)) {
            if found != expected {
                let (found, expected) = around_difference(&found, &expected);
                return Err(format!("{place}, {what}: {found} against {expected}"));
            }
        }
    }
    Ok(())
}

/// Two long texts, cut down to where they differ.
fn around_difference(a: &str, b: &str) -> (String, String) {
    let common = a.chars().zip(b.chars()).take_while(|(a, b)| a == b).count();
    let cut = |text: &str| text.chars().skip(common.saturating_sub(12)).take(60).collect();
    (cut(a), cut(b))
}
