//! What a strategy owes.

use super::{
    Promise, Violation, check_genome,
    genome::{from_json, to_json},
    strategy_run::{Results, Told, generation, run, same},
};
use crate::{Origin, Seed, Strategy};
use serde::de::DeserializeOwned;
use std::collections::BTreeSet;

/// It can be run at all.
pub const RUNS: Promise = Promise::new("strategy", "it answers `ask` and `tell` in turns, generation after generation");
/// A name that can be typed.
pub const NAME: Promise =
    Promise::new("strategy", "a name of lower-case letters, digits and hyphens that never changes");
/// The population is never empty.
pub const POPULATION: Promise =
    Promise::new("strategy", "`ask` gives at least one genome, and as many each time unless it says otherwise");
/// One shape.
pub const SHAPE: Promise = Promise::new("strategy", "all genomes express phenotypes of one shape");
/// Numbers for logs.
pub const STATISTICS: Promise = Promise::new(
    "strategy",
    "statistics are finite and have the same names, once each, in the same order each generation",
);
/// Parents and species.
pub const DESCENT: Promise = Promise::new(
    "strategy",
    "origins and memberships are one for each genome or none; parents are of the generation before, copies like them; \
     species are as large as their members are many",
);
/// The same again.
pub const DETERMINISTIC: Promise = Promise::new("strategy", "the same seed and results give the same run");
/// Chance comes from the seed.
pub const USES_SEED: Promise = Promise::new("strategy", "another seed gives another run, unless it says otherwise");
/// Saved and loaded it goes on.
pub const RESUMES: Promise =
    Promise::new("strategy", "saved after any `tell` and loaded again, it goes on as if it had not been");
/// A run that was saved between `ask` and `tell` asks again.
pub const REPEATS: Promise = Promise::new(
    "strategy",
    "saved after any `ask`, loaded and asked again with the same seed, it gives the same genomes and goes on as if it had not been",
);
/// Bad news.
pub const OUTLIVES_FAILURE: Promise =
    Promise::new("strategy", "when every evaluation of a generation fails, it goes on and keeps its other promises");
/// Strange news.
pub const OUTLIVES_EXTREMES: Promise =
    Promise::new("strategy", "with equal, huge and tiny fitnesses it goes on and keeps its other promises");

/// All of them; its genomes owe those of a genome as well.
pub const PROMISES: &[Promise] = &[
    RUNS,
    NAME,
    POPULATION,
    SHAPE,
    STATISTICS,
    DESCENT,
    DETERMINISTIC,
    USES_SEED,
    RESUMES,
    REPEATS,
    OUTLIVES_FAILURE,
    OUTLIVES_EXTREMES,
];

/// How a strategy is checked, and which promises it does not make.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StrategyOptions {
    /// The seed of the runs; another run uses the next.
    pub seed: u64,
    /// Generations of each run, at least 2; default 8.
    pub generations: u64,
    /// Whether the population's size may change from generation to generation; default no.
    pub size_varies: bool,
    /// Whether the strategy takes no chances, so that every seed gives the same run; default no.
    pub ignores_seed: bool,
}

impl Default for StrategyOptions {
    fn default() -> Self {
        Self { seed: 1, generations: 8, size_varies: false, ignores_seed: false }
    }
}

/// Checks a strategy on runs of a few generations. `make` builds one that has not been asked yet, and must build the
/// same each time.
///
/// There is no task: the fitness of a genome is the distance of its behaviour from an arbitrary one, and every seventh
/// evaluation fails. The genomes of the first and the last generation are checked with [`check_genome`].
///
/// # Errors
/// The first promise that is not kept.
pub fn check_strategy<S: Strategy<Genome: DeserializeOwned> + DeserializeOwned>(
    make: impl Fn() -> S,
    options: &StrategyOptions,
) -> Result<(), Violation> {
    let StrategyOptions { ignores_seed, size_varies, .. } = *options;
    let (seed, generations) = (Seed::of_run(options.seed), options.generations.max(2));
    let plain = RUNS.check(|| run(make(), seed, generations, Results::Ordinary))?;
    NAME.check(|| names(&plain))?;
    DETERMINISTIC.check(|| {
        let again = run(make(), seed, generations, Results::Ordinary)?;
        same(&again, &plain, "the same seed again against first")
    })?;
    POPULATION.check(|| populations(&plain, size_varies))?;
    SHAPE.check(|| shapes(&plain))?;
    STATISTICS.check(|| statistics(&plain))?;
    DESCENT.check(|| descent(&plain))?;
    plain.first().into_iter().chain(plain.last()).try_for_each(|told| check_genome(&told.sample))?;
    RESUMES.check(|| {
        let resumed = run_reloading(make(), seed, generations, false)?;
        same(&resumed, &plain, "saved and loaded after every generation, against uninterrupted")
    })?;
    REPEATS.check(|| {
        let resumed = run_reloading(make(), seed, generations, true)?;
        same(&resumed, &plain, "saved, loaded and asked again in every generation, against uninterrupted")
    })?;
    USES_SEED.check(|| {
        let other = run(make(), Seed::of_run(options.seed.wrapping_add(1)), generations, Results::Ordinary)?;
        let differs = other.iter().zip(&plain).any(|(other, plain)| other.genomes != plain.genomes);
        if differs || ignores_seed { Ok(()) } else { Err(format!("the same {generations} generations")) }
    })?;
    let outlives = |results: Results| {
        let told = run(make(), seed, generations.max(8), results)?;
        populations(&told, size_varies)?;
        shapes(&told)?;
        statistics(&[&plain[..1], &told].concat())?;
        readable::<S>(&told)
    };
    OUTLIVES_FAILURE.check(|| outlives(Results::TotalFailures))?;
    OUTLIVES_EXTREMES.check(|| outlives(Results::Extreme))
}

fn names<G>(run: &[Told<G>]) -> Result<(), String> {
    for told in run {
        well_formed(&told.name, '-')?;
        if told.name != run[0].name {
            return Err(format!("{} first, {} later", run[0].name, told.name));
        }
    }
    Ok(())
}

fn populations<G>(run: &[Told<G>], size_varies: bool) -> Result<(), String> {
    let first = run[0].genomes.len();
    for (generation, told) in (1..).zip(run) {
        match told.genomes.len() {
            0 => return Err(format!("no genomes in generation {generation}")),
            size if size != first && !size_varies => {
                return Err(format!("{size} genomes in generation {generation}, {first} in the first"));
            }
            _ => {}
        }
    }
    Ok(())
}

fn shapes<G>(run: &[Told<G>]) -> Result<(), String> {
    let Some(first) = run.iter().flat_map(|told| &told.shapes).next() else { return Ok(()) };
    for (generation, told) in (1..).zip(run) {
        if let Some(index) = told.shapes.iter().position(|shape| shape != first) {
            let found = told.shapes[index];
            return Err(format!(
                "(inputs, outputs) = {found:?} in generation {generation}, genome {index}; {first:?} before"
            ));
        }
    }
    Ok(())
}

fn statistics<G>(run: &[Told<G>]) -> Result<(), String> {
    let names = |told: &Told<G>| -> Vec<String> { told.statistics.iter().map(|(name, _)| name.clone()).collect() };
    let first = names(&run[0]);
    first.iter().try_for_each(|name| well_formed(name, '_'))?;
    if first.iter().collect::<BTreeSet<_>>().len() < first.len() {
        return Err(format!("a name twice: {first:?}"));
    }
    for told in run {
        if names(told) != first {
            return Err(format!("names {:?}, first {first:?}", names(told)));
        }
        if let Some((name, value)) = told.statistics.iter().find(|(_, value)| !value.is_finite()) {
            return Err(format!("{name} is {value}"));
        }
    }
    Ok(())
}

fn descent<G>(run: &[Told<G>]) -> Result<(), String> {
    let none: &[String] = &[];
    for (generation, told) in (1..).zip(run) {
        let before = if generation == 1 { none } else { &run[generation - 2].genomes };
        let size = told.genomes.len();
        for (what, count) in [("origins", told.origins.len()), ("memberships", told.memberships.len())] {
            if count != 0 && count != size {
                return Err(format!("{count} {what} of {size} genomes in generation {generation}"));
            }
        }
        for (origin, genome) in told.origins.iter().zip(&told.genomes) {
            if let Some(place) = origin.parents().find(|&place| place >= before.len()) {
                return Err(format!("a parent at place {place} of {} before generation {generation}", before.len()));
            }
            if let Origin::Copy(place) = *origin
                && before[place as usize] != *genome
            {
                return Err(format!("in generation {generation} a copy is not like the one at place {place}"));
            }
        }
        for species in told.species.iter().filter(|_| !told.memberships.is_empty()) {
            let members = told.memberships.iter().filter(|&&id| id == species.id).count() as u64;
            if members != species.size {
                return Err(format!("species {} has {} individuals, and {members} members", species.id, species.size));
            }
        }
    }
    Ok(())
}

/// Numbers that are not finite become `null` in JSON and cannot be read back.
fn readable<S: Strategy<Genome: DeserializeOwned>>(run: &[Told<S::Genome>]) -> Result<(), String> {
    let mut genomes = run.iter().flat_map(|told| &told.genomes);
    genomes.try_for_each(|text| from_json::<S::Genome>(text).map(drop))
}

/// A run whose strategy is written and read back before each generation; or in each once it was asked, to be asked again.
fn run_reloading<S: Strategy<Genome: DeserializeOwned> + DeserializeOwned>(
    mut strategy: S,
    seed: Seed,
    generations: u64,
    once_asked: bool,
) -> Result<Vec<Told<S::Genome>>, String> {
    let mut run = Vec::new();
    for number in 1..=generations {
        if once_asked {
            strategy.ask(seed.generation(number));
        }
        let saved = to_json(&strategy)?;
        strategy = from_json(&saved).map_err(|error| format!("generation {number}: {error}"))?;
        run.push(generation(&mut strategy, seed, number, Results::Ordinary)?);
    }
    Ok(run)
}

fn well_formed(name: &str, separator: char) -> Result<(), String> {
    let fits = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == separator;
    if !name.is_empty() && name.chars().all(fits) { Ok(()) } else { Err(format!("the name {name:?}")) }
}
