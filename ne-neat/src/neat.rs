use crate::{
    Layout, NeatGenome, NeatSettings,
    innovation::Innovations,
    mutation::{Proposal, apply},
    speciation::{Species, assign, breeders, offspring},
};
use ne_core::{Evaluation, Fitness, Origin, Purpose, Seed, SettingError, SpeciesReport, Statistic, Strategy};
use ne_net::Copies;
use std::sync::Arc;

const FIRST_GENERATION: Purpose = Purpose::new("neat first generation");
const REPRODUCTION: Purpose = Purpose::new("neat reproduction");
const REPRESENTATIVES: Purpose = Purpose::new("neat representatives");

/// NeuroEvolution of Augmenting Topologies: nets start small; connections and neurons are added by mutation, protected
/// in species while they are new.
///
/// A generation is bred in this order:
/// 1. The species that do not stagnate share out the next generation by the mean fitness of their members.
/// 2. Species by species: first a copy of the champion, if the species is large enough; then children, each of one or two
///    of its best members, mutated.
/// 3. New connections and neurons get their numbers, individual by individual.
///
/// Once evaluated, it is divided into species by the distance to random members of the generation before.
///
/// Not in the paper: with [copies](Self::of_copies) what evolves is a small net, of a limb, say, and each individual is a whole
/// of copies of it; with [`restart`](NeatSettings::restart) the search begins anew, with nets drawn as at first, when the
/// best fitness has not been beaten for so many generations (Fukunaga, *Restart Scheduling for Genetic Algorithms*, PPSN
/// 1998). Species and innovations to come have numbers that were never given.
///
/// # Statistics
/// - `species`: how many there are;
/// - `largest_species`: the number of its members;
/// - `compatibility_threshold`: the distance within which genomes are of one species;
/// - `mean_hidden_neurons`, `max_hidden_neurons`, `mean_enabled_connections`, `max_enabled_connections`: size of the
///   genomes;
/// - `champion_hidden_neurons`, `champion_enabled_connections`: size of the generation's best genome;
/// - `stagnation_generations`: generations since the best fitness so far was beaten.
///
/// Source: Stanley & Miikkulainen, *Evolving Neural Networks through Augmenting Topologies*, Evolutionary Computation
/// 10(2), 2002.
#[derive(Clone, Debug)]
pub struct Neat {
    pub(crate) settings: NeatSettings,
    pub(crate) layout: Layout,
    /// Of what net the whole ones are made; none if it is the whole.
    pub(crate) copies: Option<Arc<Copies>>,
    pub(crate) innovations: Innovations,
    /// The first generation, best first, if it is not drawn; empty after it.
    pub(crate) start: Vec<NeatGenome>,
    /// The generation last told, with its scores: the parents of the next. Empty before the first.
    pub(crate) parents: Vec<NeatGenome>,
    pub(crate) scores: Vec<Option<Fitness>>,
    /// The species of the parents, in order of their numbers.
    pub(crate) species: Vec<Species>,
    pub(crate) next_species: u64,
    /// The distance within which genomes are of one species.
    pub(crate) threshold: f64,
    /// The generation last asked. Once told, it is a parent, and what stands here is memory to be used again.
    pub(crate) population: Vec<NeatGenome>,
    /// Whether `population` was asked and not told yet.
    pub(crate) asked: bool,
    /// The best score so far.
    pub(crate) best: Option<Fitness>,
    /// Generations since `best` was beaten.
    pub(crate) stagnation: u64,
    /// Of the generation last asked.
    pub(crate) origins: Vec<Origin>,
}

impl Neat {
    /// A search for nets with so many inputs and outputs.
    ///
    /// # Errors
    /// If a setting, `inputs` or `outputs` is out of range.
    pub fn new(settings: NeatSettings, inputs: usize, outputs: usize) -> Result<Self, SettingError> {
        let layout = settings.layout(inputs, outputs)?;
        Ok(Self {
            innovations: settings.start.innovations(&layout),
            threshold: settings.speciation.threshold,
            settings,
            layout,
            copies: None,
            start: Vec::new(),
            parents: Vec::new(),
            scores: Vec::new(),
            species: Vec::new(),
            next_species: 1,
            population: Vec::new(),
            asked: false,
            best: None,
            stagnation: 0,
            origins: Vec::new(),
        })
    }

    /// A search for the small net that these are copies of.
    ///
    /// # Errors
    /// If a setting or a number of the copies is out of range, or the first nets would have too many neurons.
    pub fn of_copies(settings: NeatSettings, copies: Arc<Copies>) -> Result<Self, SettingError> {
        copies.validate().map_err(|error| error.within("copies"))?;
        let search = Self::new(settings, copies.small_inputs(), copies.small_outputs())?;
        let most = copies.most_neurons();
        let neurons = search.settings.start.hidden() + search.layout.outputs;
        if neurons > most {
            let allowed = format!("at most {most} neurons with {} copies of the net", copies.copies.len());
            return Err(SettingError::new("start", format!("{neurons} neurons"), allowed));
        }
        Ok(Self { copies: Some(copies), ..search })
    }

    /// The copies that make up whole nets; `None`: the nets are the whole.
    pub fn copies(&self) -> Option<&Arc<Copies>> {
        self.copies.as_ref()
    }

    /// The settings.
    pub fn settings(&self) -> &NeatSettings {
        &self.settings
    }

    /// What all genomes have in common.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Draws an individual of the first generation.
    fn draw(&self, individual: &mut NeatGenome, seed: Seed) {
        let NeatSettings { output_activation, ref hidden_activations, .. } = self.settings;
        let new_weights = self.settings.new_weights();
        let activations = (output_activation, &hidden_activations[..]);
        self.settings.start.draw(individual, new_weights, activations, &mut seed.stream(FIRST_GENERATION));
    }

    /// Writes a first generation that is not drawn: those there are, and copies of them that mutate.
    fn fill(&self, population: &mut [NeatGenome], seed: Seed) -> Vec<Proposal> {
        let NeatSettings { mutation, hidden_activations, .. } = &self.settings;
        let new_weights = self.settings.new_weights();
        let mut proposals = Vec::with_capacity(population.len());
        for (index, individual) in population.iter_mut().enumerate() {
            individual.copy_from(&self.start[index % self.start.len()]);
            proposals.push(match index < self.start.len() {
                true => Proposal::default(),
                false => {
                    let mut stream = seed.individual(index as u64).stream(REPRODUCTION);
                    mutation.mutate(individual, new_weights, hidden_activations, &mut stream)
                }
            });
        }
        proposals
    }

    /// Forgets the population, so that the next generation is drawn.
    fn begin_anew(&mut self) {
        self.parents.clear();
        self.scores.clear();
        self.species.clear();
        self.threshold = self.settings.speciation.threshold;
        (self.best, self.stagnation) = (None, 0);
    }

    /// Gives numbers to what the individuals propose.
    fn number(&mut self, population: &mut [NeatGenome], proposals: Vec<Proposal>) {
        self.innovations.begin_generation();
        for (individual, proposal) in population.iter_mut().zip(proposals) {
            apply(proposal, individual, &mut self.innovations);
        }
    }

    /// Writes the next generation, without the numbers of new structure; returns what each individual proposes.
    fn breed(&self, population: &mut [NeatGenome], origins: &mut Vec<Origin>, seed: Seed) -> Vec<Proposal> {
        let NeatSettings { speciation, reproduction, .. } = &self.settings;
        let breeders = breeders(&self.species, &self.scores, self.stagnation, speciation);
        let children = offspring(&breeders, &self.species, &self.scores, population.len(), speciation);
        let breeders: Vec<&Species> = breeders.iter().map(|&index| &self.species[index]).collect();
        let mut proposals = Vec::with_capacity(population.len());
        for (home, &children) in children.iter().enumerate() {
            let champion = breeders[home].members[0];
            for child in 0..children {
                let index = proposals.len();
                let individual = &mut population[index];
                if child == 0 && breeders[home].members.len() > reproduction.champion_above {
                    individual.copy_from(&self.parents[champion]);
                    proposals.push(Proposal::default());
                    origins.push(Origin::Copy(champion as u32));
                } else {
                    let (proposal, parents) =
                        self.reproduce(individual, home, &breeders, seed.individual(index as u64));
                    proposals.push(proposal);
                    origins.push(Origin::Child(parents));
                }
            }
        }
        proposals
    }

    /// Writes a child of the breeding species `home`; returns what it proposes, and the places of its parents.
    fn reproduce(
        &self,
        child: &mut NeatGenome,
        home: usize,
        breeders: &[&Species],
        seed: Seed,
    ) -> (Proposal, [u32; 2]) {
        let NeatSettings { reproduction, crossover, mutation, .. } = &self.settings;
        let mut stream = seed.stream(REPRODUCTION);
        let (first, second) = reproduction.parents(home, breeders, &mut stream);
        if first == second {
            child.copy_from(&self.parents[first]);
        } else {
            let fitness = self.scores[first].cmp(&self.scores[second]);
            crossover.cross(&self.parents[first], &self.parents[second], fitness, child, &mut stream);
        }
        let proposal =
            mutation.mutate(child, self.settings.new_weights(), &self.settings.hidden_activations, &mut stream);
        (proposal, [first as u32, second as u32])
    }

    /// Moves the threshold towards the number of species aimed at.
    fn adjust_threshold(&mut self) {
        let Some(target) = self.settings.speciation.target else { return };
        if self.species.len() > target.species {
            self.threshold += target.step;
        } else if self.species.len() < target.species {
            // Never up, even if a step is larger than the threshold.
            self.threshold = (self.threshold - target.step).max(target.step.min(self.threshold));
        }
    }
}

impl Strategy for Neat {
    type Genome = NeatGenome;

    fn name(&self) -> &str {
        "neat"
    }

    fn ask(&mut self, seed: Seed) -> &[NeatGenome] {
        if self.settings.restart.is_some_and(|patience| self.stagnation >= patience) {
            self.begin_anew();
        }
        let mut population = std::mem::take(&mut self.population);
        population.resize_with(self.settings.population, || NeatGenome::blank(self.layout, self.copies.clone()));
        let mut origins = Vec::with_capacity(population.len());
        if self.parents.is_empty() && !self.start.is_empty() {
            let proposals = self.fill(&mut population, seed);
            self.number(&mut population, proposals);
        } else if self.parents.is_empty() {
            for (individual, index) in population.iter_mut().zip(0..) {
                self.draw(individual, seed.individual(index));
            }
        } else {
            let proposals = self.breed(&mut population, &mut origins, seed);
            self.number(&mut population, proposals);
        }
        origins.resize(population.len(), Origin::New);
        (self.population, self.origins) = (population, origins);
        self.asked = true;
        &self.population
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        debug_assert_eq!(evaluations.len(), self.population.len());
        let distance = (&self.settings.speciation.compatibility, self.threshold);
        let mut stream = seed.stream(REPRESENTATIVES);
        assign(&mut self.species, &mut self.next_species, &self.parents, &self.population, distance, &mut stream);
        self.adjust_threshold();
        std::mem::swap(&mut self.parents, &mut self.population);
        self.start.clear();
        self.asked = false;
        self.innovations.end_generation();
        self.scores.clear();
        self.scores.extend(evaluations.iter().map(Evaluation::fitness));
        self.species.iter_mut().for_each(|species| species.tell(&self.scores));
        let best = self.scores.iter().copied().max().flatten();
        self.stagnation = if best > self.best { 0 } else { self.stagnation + 1 };
        self.best = self.best.max(best);
    }

    fn statistics(&self) -> Vec<Statistic> {
        let size = |count: fn(&NeatGenome) -> usize| -> (f64, f64, f64) {
            let counts = || self.parents.iter().map(|parent| count(parent) as f64);
            let mean = counts().sum::<f64>() / self.parents.len().max(1) as f64;
            // Of equals the first.
            let champion = (0..self.parents.len()).rev().max_by_key(|&index| self.scores[index]);
            (mean, counts().fold(0.0, f64::max), champion.map_or(0.0, |index| count(&self.parents[index]) as f64))
        };
        let hidden = size(NeatGenome::hidden_count);
        let enabled = size(NeatGenome::enabled_count);
        let largest = self.species.iter().map(|species| species.members.len()).max().unwrap_or(0);
        vec![
            Statistic::new("species", self.species.len() as f64),
            Statistic::new("largest_species", largest as f64),
            Statistic::new("compatibility_threshold", self.threshold),
            Statistic::new("mean_hidden_neurons", hidden.0),
            Statistic::new("max_hidden_neurons", hidden.1),
            Statistic::new("mean_enabled_connections", enabled.0),
            Statistic::new("max_enabled_connections", enabled.1),
            Statistic::new("champion_hidden_neurons", hidden.2),
            Statistic::new("champion_enabled_connections", enabled.2),
            Statistic::new("stagnation_generations", self.stagnation as f64),
        ]
    }

    fn species(&self) -> Vec<SpeciesReport> {
        let report = |species: &Species| SpeciesReport {
            id: species.id,
            size: species.members.len() as u64,
            best: species.champion_score(&self.scores),
        };
        self.species.iter().map(report).collect()
    }

    fn memberships(&self) -> Vec<u64> {
        let mut memberships = vec![0; self.parents.len()];
        for species in &self.species {
            species.members.iter().for_each(|&member| memberships[member] = species.id);
        }
        memberships
    }

    fn origins(&self) -> &[Origin] {
        &self.origins
    }
}
