use super::{ConventionalNeSettings, state::State};
use crate::{
    Crossover, CrossoverChoice, Mutation, MutationChoice, Setting, WeightVector,
    diversity::diversity,
    nets::{Nets, Parents, begin, check_growth},
};
use ne_core::{Evaluation, Fitness, Origin, Purpose, Seed, Selection, Selector, SettingError, Statistic, Strategy};
use ne_net::{Topology, TopologyMap};
use rand::RngExt;
use serde::Deserialize;
use std::cmp::Reverse;

const FIRST_GENERATION: Purpose = Purpose::new("conventional-ne first generation");
const PARENTS: Purpose = Purpose::new("conventional-ne parents");
const REPRODUCTION: Purpose = Purpose::new("conventional-ne reproduction");

/// Conventional neuroevolution: a generational genetic algorithm over the weights of a net of fixed topology.
///
/// A generation consists of, in this order:
/// 1. the elites, best first, unchanged (of equals those with the lower index);
/// 2. children: two parents are selected; with the crossover rate the child is their crossover, else a copy of the
///    first; then it mutates;
/// 3. the immigrants, drawn like the first generation.
///
/// Failed evaluations rank below every fitness. A child's mutation deviation (see
/// [`SelfAdaptiveMutation`](crate::SelfAdaptiveMutation)) starts as the mean of its parents'.
///
/// Selection, crossover and mutation can be types of your own in place of the choices this crate offers.
///
/// # Statistics
/// - `mutation_strength`: what mutations are multiplied by, 1 unless the population stagnates;
/// - `mutation_deviation`: mean of the individuals' deviations, in units of the weights; 0 unless self-adaptive;
/// - `stagnation_generations`: generations since the best fitness so far was beaten;
/// - `diversity`: the standard deviation of a gene over the population, mean of all genes, in units of the weights;
/// - `distinct_parents`: how many individuals were selected to breed the generation; 0 for the first.
///
/// Source: Holland, *Adaptation in Natural and Artificial Systems*, 1975; for nets Montana & Davis, *Training
/// Feedforward Neural Networks Using Genetic Algorithms*, IJCAI 1989.
#[derive(Clone, Debug, Deserialize)]
#[serde(try_from = "State<S, C, M>", bound(deserialize = "S: Setting, C: Setting, M: Setting"))]
pub struct ConventionalNe<S = Selection, C = CrossoverChoice, M = MutationChoice> {
    pub(super) settings: ConventionalNeSettings<S, C, M>,
    pub(super) nets: Nets,
    pub(super) parents: Parents,
    /// The best score so far.
    pub(super) best: Option<Fitness>,
    /// Generations since `best` was beaten.
    pub(super) stagnation: u64,
    pub(super) distinct_parents: usize,
    /// Of the generation last asked.
    pub(super) origins: Vec<Origin>,
}

impl<S: Setting, C: Setting, M: Setting> ConventionalNe<S, C, M> {
    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range.
    pub fn new(settings: ConventionalNeSettings<S, C, M>, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self {
            settings,
            nets: Nets::new(topology)?,
            parents: Parents::default(),
            best: None,
            stagnation: 0,
            distinct_parents: 0,
            origins: Vec::new(),
        })
    }

    /// The settings.
    pub fn settings(&self) -> &ConventionalNeSettings<S, C, M> {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.nets.topology
    }

    /// The search whose first generation has nets of these weights, best first, in place of drawn ones. If they are more
    /// than a generation, the last are left out; if they are fewer, copies of them that have mutated fill it up. Without
    /// effect once a generation was asked.
    ///
    /// # Errors
    /// If they are not weights of this search's topology; the error names the net: `start[3]`.
    pub fn with_start(mut self, start: &[Vec<f32>]) -> Result<Self, SettingError>
    where
        M: Mutation,
    {
        self.parents.start = self.nets.start(start, self.settings.mutation.initial_deviation())?;
        Ok(self)
    }

    /// Goes on with other settings, on another task, or with nets that have grown: the population last told is the first
    /// generation, best first, and what is new in its nets begins with weights of 0. Between ask and tell
    /// it is the generation asked, in its order.
    ///
    /// # Errors
    /// If a setting is out of range, or the growth is not from this topology to that one.
    pub fn remapped(
        self,
        settings: ConventionalNeSettings<S, C, M>,
        topology: impl Into<Topology>,
        growth: &TopologyMap,
    ) -> Result<Self, SettingError> {
        let next = Self::new(settings, topology)?;
        check_growth(growth, &self.nets.topology, &next.nets.topology)?;
        let parents = match self.nets.waiting() {
            [] => self.parents.remapped(&next.nets.topology, growth),
            asked => Parents {
                start: asked.iter().map(|net| net.remapped(&next.nets.topology, growth)).collect(),
                ..Parents::default()
            },
        };
        Ok(Self { parents, ..next })
    }

    /// What mutations are multiplied by now: 1 unless the population stagnates.
    pub fn mutation_strength(&self) -> f64 {
        self.settings.stagnation_boost.map_or(1.0, |boost| boost.strength(self.stagnation))
    }
}

impl<S: Setting + Selector, C: Crossover, M: Mutation> ConventionalNe<S, C, M> {
    /// Draws the weights of an individual as in the first generation.
    fn draw(&self, individual: &mut WeightVector, seed: Seed) {
        self.settings.initialization.draw(individual, &mut seed.stream(FIRST_GENERATION));
        *individual.genes_mut().1 = self.settings.mutation.initial_deviation();
    }

    /// The places of the best parents, best first.
    fn elites(&self) -> Vec<usize> {
        let count = self.settings.elites;
        if count == 0 {
            return Vec::new();
        }
        let mut order: Vec<usize> = (0..self.parents.nets.len()).collect();
        let rank = |&index: &usize| (Reverse(self.parents.scores[index]), index);
        order.select_nth_unstable_by_key(count - 1, rank);
        order.truncate(count);
        order.sort_unstable_by_key(rank);
        order
    }

    /// Children of parents that are selected two for each. A parent's weights are dropped once its last child is bred: two whole
    /// generations of a large population are more than its evaluation needs.
    fn children(&mut self, count: usize, seed: Seed, mut add: impl FnMut(WeightVector, Origin)) {
        let mut chosen = Vec::with_capacity(2 * count);
        let mut stream = seed.stream(PARENTS);
        self.settings.selection.select(&self.parents.scores, 2 * count, &mut stream, &mut chosen);
        assert_eq!(chosen.len(), 2 * count, "number of parents the selector chose");
        let mut uses = vec![0_u32; self.parents.nets.len()];
        chosen.iter().for_each(|&parent| uses[parent] += 1);
        self.distinct_parents = uses.iter().filter(|&&uses| uses > 0).count();
        let others = self.parents.nets.iter_mut().zip(&uses).filter(|&(_, &uses)| uses == 0);
        others.for_each(|(other, _)| other.drop_weights());
        let strength = self.mutation_strength() as f32;
        for (index, parents) in (self.settings.elites..).zip(chosen.chunks_exact(2)) {
            let (child, origin) = self.breed(parents, strength, seed.individual(index as u64));
            add(child, origin);
            for &parent in parents {
                uses[parent] -= 1;
                if uses[parent] == 0 {
                    self.parents.nets[parent].drop_weights();
                }
            }
        }
    }

    /// The child of two parents, or of the first alone.
    fn breed(&self, parents: &[usize], strength: f32, seed: Seed) -> (WeightVector, Origin) {
        let (first, second) = (&self.parents.nets[parents[0]], &self.parents.nets[parents[1]]);
        let mut stream = seed.stream(REPRODUCTION);
        let mut child = first.clone();
        let mut origin = Origin::Child([parents[0] as u32; 2]);
        if stream.random::<f64>() < self.settings.crossover_rate {
            child = WeightVector::zero(self.nets.topology.clone());
            let (weights, deviation) = child.genes_mut();
            self.settings.crossover.cross(first.weights(), second.weights(), weights, &mut stream);
            *deviation = 0.5 * (first.mutation_deviation() + second.mutation_deviation());
            origin = Origin::Child([parents[0] as u32, parents[1] as u32]);
        }
        let (weights, deviation) = child.genes_mut();
        self.settings.mutation.mutate(weights, deviation, strength, &mut stream);
        (child, origin)
    }
}

impl<S: Setting + Selector, C: Crossover, M: Mutation> Strategy for ConventionalNe<S, C, M> {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "conventional"
    }

    /// Its parents are gone once a generation is bred. So a generation that is asked again before it was told is the same,
    /// whatever the seed.
    ///
    /// # Panics
    /// If a selector of your own does not choose as many parents as it is asked for.
    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        if self.nets.asked {
            return &self.nets.population;
        }
        let ConventionalNeSettings { population: size, elites, immigrants, .. } = self.settings;
        let is_first = self.parents.nets.is_empty();
        let mut population = Vec::with_capacity(size);
        let mut origins = Vec::with_capacity(size);
        if !is_first {
            for place in self.elites() {
                population.push(self.parents.nets[place].clone());
                origins.push(Origin::Copy(place as u32));
            }
            self.children(size - elites - immigrants, seed, |child, origin| {
                population.push(child);
                origins.push(origin);
            });
            self.parents.nets = Vec::new();
        }
        origins.resize(size, Origin::New);
        self.origins = origins;
        // In later generations these are immigrants, which are drawn.
        let start = if is_first { self.parents.start.as_slice() } else { &[] };
        for index in population.len()..size {
            let place = seed.individual(index as u64);
            let draw = |individual: &mut WeightVector| self.draw(individual, place);
            let mutate = |individual: &mut WeightVector| {
                let (weights, deviation) = individual.genes_mut();
                self.settings.mutation.mutate(weights, deviation, 1.0, &mut place.stream(REPRODUCTION));
            };
            let mut individual = WeightVector::zero(self.nets.topology.clone());
            begin(start, index, &mut individual, draw, mutate);
            population.push(individual);
        }
        self.nets.ask(population)
    }

    fn tell(&mut self, evaluations: &[Evaluation], _seed: Seed) {
        self.nets.tell(evaluations, &mut self.parents);
        let best = self.parents.scores.iter().copied().max().flatten();
        self.stagnation = if best > self.best { 0 } else { self.stagnation + 1 };
        self.best = self.best.max(best);
    }

    fn origins(&self) -> &[Origin] {
        &self.origins
    }

    fn statistics(&self) -> Vec<Statistic> {
        let deviations: f64 = self.parents.nets.iter().map(|parent| f64::from(parent.mutation_deviation())).sum();
        vec![
            Statistic::new("mutation_strength", self.mutation_strength()),
            Statistic::new("mutation_deviation", deviations / self.parents.nets.len().max(1) as f64),
            Statistic::new("stagnation_generations", self.stagnation as f64),
            Statistic::new("diversity", diversity(&self.parents.nets)),
            Statistic::new("distinct_parents", self.distinct_parents as f64),
        ]
    }
}
