use super::{Nsga2Settings, state::State};
use crate::{
    Crossover, Mutation, WeightVector,
    diversity::diversity,
    nets::{Nets, begin, check_growth},
};
use ne_core::{
    Evaluation, Fitness, FrontPoint, Purpose, Seed, Selector, SettingError, Statistic, Strategy,
    pareto::{self, Point, Rank},
};
use ne_net::{Topology, TopologyMap};
use rand::RngExt;
use serde::{Deserialize, Serialize};
use std::cmp::Reverse;

const FIRST_GENERATION: Purpose = Purpose::new("nsga2 first generation");
const PARENTS: Purpose = Purpose::new("nsga2 parents");
const REPRODUCTION: Purpose = Purpose::new("nsga2 reproduction");

/// NSGA-II: searches for compromises between objectives, such as speed and energy, that cannot all be had at once. What
/// it finds is not one best individual but a [front](Strategy::front) of them.
///
/// From a generation that was evaluated the next is made in these steps:
/// 1. parents and children together are sorted into fronts of which none dominates another within
///    ([`pareto::fronts`]);
/// 2. front by front they become the next parents; of the front that no longer fits, the individuals with most room to
///    themselves ([`pareto::crowding`]), so that the whole front stays in sight; of equals, those with the lower index;
/// 3. children are bred by parents that win tournaments: the earlier front is better, in one front the roomier place.
///
/// A task without objectives is optimised by its fitness as the only one. Failed evaluations rank below everything, as
/// does one of which an objective is no finite number.
///
/// # Statistics
/// - `front_size`: how many different points the first front of the parents has;
/// - `hypervolume`: the area the front dominates, in the product of the objectives' units, seen from the lowest values
///   of the first generation in which an individual succeeded; what is worse than that in an objective adds nothing. 0
///   unless there are two objectives;
/// - `diversity`: the standard deviation of a gene over the parents, mean of all genes, in units of the weights.
///
/// Source: Deb, Pratap, Agarwal & Meyarivan, *A Fast and Elitist Multiobjective Genetic Algorithm: NSGA-II*, IEEE
/// Transactions on Evolutionary Computation 6(2), 2002, section III. Crossover and mutation are this crate's;
/// tournaments are drawn with replacement; see also [`Nsga2Settings::parents_again`].
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "State", try_from = "State")]
pub struct Nsga2 {
    pub(super) settings: Nsga2Settings,
    pub(super) nets: Nets,
    /// The first generation, best first, if it is not drawn; empty after it.
    pub(super) start: Vec<WeightVector>,
    /// The survivors of the generation last told, best first. Empty before the first.
    pub(super) parents: Vec<Parent>,
    /// What the hypervolume is seen from: the lowest value of each objective in the first generation that had any.
    pub(super) reference: Option<Vec<Fitness>>,
}

/// An individual that was evaluated.
#[derive(Clone, Debug)]
pub(super) struct Parent {
    pub(super) genome: WeightVector,
    /// `None` if the evaluation failed.
    pub(super) scores: Option<Scores>,
    /// In which generation, from 1.
    pub(super) generation: u64,
}

/// What a successful evaluation came to.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Scores {
    pub(super) fitness: Fitness,
    pub(super) objectives: Vec<Fitness>,
}

impl Parent {
    fn point(&self) -> Point<'_> {
        self.scores.as_ref().map(|scores| &scores.objectives[..])
    }
}

impl Nsga2 {
    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range.
    pub fn new(settings: Nsga2Settings, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, nets: Nets::new(topology)?, start: Vec::new(), parents: Vec::new(), reference: None })
    }

    /// The search whose first generation has nets of these weights, best first, in place of drawn ones. If they are more
    /// than a generation, the last are left out; if they are fewer, copies of them that have mutated fill it up. Without
    /// effect once a generation was told.
    ///
    /// # Errors
    /// If they are not weights of this search's topology; the error names the net: `start[3]`.
    pub fn with_start(self, start: &[Vec<f32>]) -> Result<Self, SettingError> {
        let start = self.nets.start(start, self.settings.mutation.initial_deviation())?;
        Ok(Self { start, ..self })
    }

    /// Goes on with other settings, on another task, or with nets that have grown: the survivors of the generation last
    /// told are the first generation, best first, and what is new in their nets begins with weights of 0.
    ///
    /// # Errors
    /// If a setting is out of range, or the growth is not from this topology to that one.
    pub fn remapped(
        self,
        settings: Nsga2Settings,
        topology: impl Into<Topology>,
        growth: &TopologyMap,
    ) -> Result<Self, SettingError> {
        let next = Self::new(settings, topology)?;
        check_growth(growth, &self.nets.topology, &next.nets.topology)?;
        let survivors: Vec<&WeightVector> = match self.parents.is_empty() {
            true => self.start.iter().collect(),
            false => self.parents.iter().map(|parent| &parent.genome).collect(),
        };
        let start = survivors.into_iter().map(|genome| genome.remapped(&next.nets.topology, growth)).collect();
        Ok(Self { start, ..next })
    }

    /// The settings.
    pub fn settings(&self) -> &Nsga2Settings {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.nets.topology
    }

    /// An individual of the first generation.
    fn first(&self, index: usize, seed: Seed) -> WeightVector {
        let mut individual = WeightVector::zero(self.nets.topology.clone());
        let draw = |individual: &mut WeightVector| {
            self.settings.initialization.draw(individual, &mut seed.stream(FIRST_GENERATION));
            *individual.genes_mut().1 = self.settings.mutation.initial_deviation();
        };
        let mutate = |individual: &mut WeightVector| {
            let (weights, deviation) = individual.genes_mut();
            self.settings.mutation.mutate(weights, deviation, 1.0, &mut seed.stream(REPRODUCTION));
        };
        begin(&self.start, index, &mut individual, draw, mutate);
        individual
    }

    /// The indices of the parents of so many children, two for each.
    fn select_parents(&self, children: usize, seed: Seed) -> Vec<usize> {
        let points: Vec<Point<'_>> = self.parents.iter().map(Parent::point).collect();
        let scores = tournament_scores(&points, &pareto::ranks(&points));
        let mut chosen = Vec::with_capacity(2 * children);
        self.settings.selection.select(&scores, 2 * children, &mut seed.stream(PARENTS), &mut chosen);
        chosen
    }

    /// The child of two parents.
    fn breed(&self, parents: &[usize], seed: Seed) -> WeightVector {
        let [first, second] = [parents[0], parents[1]].map(|parent| &self.parents[parent].genome);
        let (mut child, mut stream) = (first.clone(), seed.stream(REPRODUCTION));
        let crossed = stream.random::<f64>() < self.settings.crossover_rate;
        let (weights, deviation) = child.genes_mut();
        if crossed {
            self.settings.crossover.cross(first.weights(), second.weights(), weights, &mut stream);
            *deviation = 0.5 * (first.mutation_deviation() + second.mutation_deviation());
        }
        self.settings.mutation.mutate(weights, deviation, 1.0, &mut stream);
        child
    }

    /// The members of the first front, no two equal in all objectives, from the best in the first objective on.
    fn first_front(&self) -> Vec<(&Parent, &Scores)> {
        let points: Vec<Point<'_>> = self.parents.iter().map(Parent::point).collect();
        let first = pareto::fronts(&points).into_iter().next().unwrap_or_default();
        let member = |index: usize| Some((&self.parents[index], self.parents[index].scores.as_ref()?));
        let mut front: Vec<_> = first.into_iter().filter_map(member).collect();
        front.sort_by_key(|(_, scores)| Reverse(&scores.objectives));
        front.dedup_by_key(|(_, scores)| &scores.objectives);
        front
    }
}

/// One number for each place in the order of ranks, so that any selector can compare them; equal ranks have equal
/// numbers, failures none.
fn tournament_scores(points: &[Point<'_>], ranks: &[Rank]) -> Vec<Option<Fitness>> {
    let mut ascending = ranks.to_vec();
    ascending.sort_unstable();
    ascending.dedup();
    let score = |rank: &Rank| Fitness::new(ascending.partition_point(|other| other < rank) as f64).ok();
    points.iter().zip(ranks).map(|(point, rank)| point.and_then(|_| score(rank))).collect()
}

impl Strategy for Nsga2 {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "nsga2"
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let size = self.settings.population;
        let place = |index: usize| seed.individual(index as u64);
        let population = if self.parents.is_empty() {
            (0..size).map(|index| self.first(index, place(index))).collect()
        } else {
            let kept = if self.settings.parents_again { self.parents.len() } else { 0 };
            let parents = self.parents[..kept].iter().map(|parent| parent.genome.clone());
            let chosen = self.select_parents(size - kept, seed);
            let children = (kept..).zip(chosen.chunks_exact(2)).map(|(index, pair)| self.breed(pair, place(index)));
            parents.chain(children).collect()
        };
        self.nets.ask(population)
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        debug_assert_eq!(evaluations.len(), self.nets.population.len());
        self.start.clear();
        self.nets.asked = false;
        let generation = seed.generation_index();
        let told =
            std::mem::take(&mut self.nets.population).into_iter().zip(evaluations).map(|(genome, evaluation)| {
                let scores = evaluation.fitness().zip(evaluation.objectives());
                let scores = scores.map(|(fitness, objectives)| Scores { fitness, objectives });
                Parent { genome, scores, generation }
            });
        let mut pool = std::mem::take(&mut self.parents);
        if self.settings.parents_again {
            pool.clear();
        }
        pool.extend(told);
        let points: Vec<Point<'_>> = pool.iter().map(Parent::point).collect();
        if self.reference.is_none() {
            self.reference = lowest(&points);
        }
        let ranks = pareto::ranks(&points);
        let mut order: Vec<usize> = (0..pool.len()).collect();
        order.sort_by_key(|&index| Reverse(ranks[index]));
        order.truncate(self.settings.parent_count());
        let mut pool: Vec<Option<Parent>> = pool.into_iter().map(Some).collect();
        self.parents = order.into_iter().filter_map(|index| pool[index].take()).collect();
    }

    fn statistics(&self) -> Vec<Statistic> {
        let front = self.first_front();
        let points: Vec<Point<'_>> = front.iter().map(|(parent, _)| parent.point()).collect();
        let area = self.reference.as_ref().map_or(0.0, |reference| pareto::hypervolume(&points, reference));
        let genomes: Vec<WeightVector> = self.parents.iter().map(|parent| parent.genome.clone()).collect();
        vec![
            Statistic::new("front_size", front.len() as f64),
            Statistic::new("hypervolume", area),
            Statistic::new("diversity", diversity(&genomes)),
        ]
    }

    fn front(&self) -> Option<Vec<FrontPoint<'_, WeightVector>>> {
        let front = self.first_front().into_iter();
        let front = front.map(|(Parent { genome, generation, .. }, Scores { fitness, objectives })| FrontPoint {
            genome,
            fitness: *fitness,
            objectives,
            generation: *generation,
        });
        Some(front.collect())
    }
}

/// The lowest value of each objective, if any individual succeeded.
fn lowest(points: &[Point<'_>]) -> Option<Vec<Fitness>> {
    points
        .iter()
        .copied()
        .flatten()
        .map(<[Fitness]>::to_vec)
        .reduce(|lowest, values| lowest.into_iter().zip(values).map(|(lowest, value)| lowest.min(value)).collect())
}
