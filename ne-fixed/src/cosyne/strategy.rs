use super::{CosyneSettings, cauchy, permutation::shuffle_marked, state::State};
use crate::{
    Crossover, WeightVector,
    diversity::diversity,
    nets::{Nets, Parents, begin, check_growth},
    ranking::best_first,
};
use ne_core::{Evaluation, Fitness, Purpose, Seed, SettingError, Statistic, Strategy};
use ne_net::{Topology, TopologyMap};
use rand::RngExt;
use serde::{Deserialize, Serialize};

const FIRST_GENERATION: Purpose = Purpose::new("cosyne first generation");
const REPRODUCTION: Purpose = Purpose::new("cosyne reproduction");
const PERMUTATION: Purpose = Purpose::new("cosyne permutation");

/// Cooperative synapse neuroevolution (CoSyNE): each weight of the net has a subpopulation of its own, and weights of
/// all subpopulations meet in ever new nets.
///
/// The population is a table: a row is a net, a column is the subpopulation of one weight. From a generation that was
/// evaluated the next is made in these steps:
/// 1. the nets are put in order, best first;
/// 2. pairs of different parents, drawn from the best quarter, have children by crossover and mutation with Cauchy
///    noise; the children take the place of the worst nets;
/// 3. in each subpopulation, weights are marked by chance ([`Permutation`](crate::Permutation)), and those marked change
///    places among each other.
///
/// Failed evaluations rank below every fitness; of equals those with the lower index are better.
///
/// Not in the paper: with [`restart`](CosyneSettings::restart) the search begins anew, with weights drawn as at first, when
/// the best fitness has not been beaten for so many generations (Fukunaga, *Restart Scheduling for Genetic Algorithms*, PPSN
/// 1998). A small population that has converged to a bad place does not leave it.
///
/// # Statistics
/// - `diversity`: the standard deviation of a gene over the population, mean of all genes, in units of the weights;
/// - `marked_share`: the expected share of the weights that are marked after the generation last told, of the nets that are
///   kept.
///
/// Source: Gomez, Schmidhuber & Miikkulainen, *Accelerated Neural Evolution through Cooperatively Coevolved Synapses*,
/// JMLR 9, 2008, algorithm 1.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "State", try_from = "State")]
pub struct Cosyne {
    pub(super) settings: CosyneSettings,
    pub(super) nets: Nets,
    pub(super) parents: Parents,
    /// The best score since the search began, and the generations since it was beaten; known only where it may begin anew.
    pub(super) best: Option<Fitness>,
    pub(super) stagnation: u64,
    pub(super) has_begun_anew: bool,
}

impl Cosyne {
    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range.
    pub fn new(settings: CosyneSettings, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        settings.validate()?;
        let (nets, parents) = (Nets::new(topology)?, Parents::default());
        Ok(Self { settings, nets, parents, best: None, stagnation: 0, has_begun_anew: false })
    }

    /// The settings.
    pub fn settings(&self) -> &CosyneSettings {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.nets.topology
    }

    /// Whether a restart has left what the search had found.
    pub fn has_begun_anew(&self) -> bool {
        self.has_begun_anew
    }

    /// The search whose first generation has nets of these weights, best first, in place of drawn ones. If they are more
    /// than a generation, the last are left out; if they are fewer, copies of them with Cauchy noise fill it up. Without
    /// effect once a generation was told.
    ///
    /// # Errors
    /// If they are not weights of this search's topology; the error names the net: `start[3]`.
    pub fn with_start(mut self, start: &[Vec<f32>]) -> Result<Self, SettingError> {
        self.parents.start = self.nets.start(start, 0.0)?;
        Ok(self)
    }

    /// Goes on with other settings, on another task, or with nets that have grown: the population last told is the first
    /// generation, best first, and what is new in its nets begins with weights of 0.
    ///
    /// # Errors
    /// If a setting is out of range, or the growth is not from this topology to that one.
    pub fn remapped(
        self,
        settings: CosyneSettings,
        topology: impl Into<Topology>,
        growth: &TopologyMap,
    ) -> Result<Self, SettingError> {
        let next = Self::new(settings, topology)?;
        check_growth(growth, &self.nets.topology, &next.nets.topology)?;
        Ok(Self { parents: self.parents.remapped(&next.nets.topology, growth), ..next })
    }

    /// Writes a child of two of the parents, which stand in `order`, best first.
    fn breed(&self, child: &mut WeightVector, order: &[usize], seed: Seed) {
        let CosyneSettings { crossover, mutation_rate, mutation_scale, .. } = &self.settings;
        let (count, mut stream) = (self.settings.parent_count(), seed.stream(REPRODUCTION));
        let first = stream.random_range(0..count);
        let second = (first + stream.random_range(1..count)) % count;
        let parent = |place: usize| self.parents.nets[order[place]].weights();
        let (genes, _) = child.genes_mut();
        crossover.cross(parent(first), parent(second), genes, &mut stream);
        cauchy::mutate(genes, *mutation_rate, *mutation_scale, &mut stream);
    }

    /// In each subpopulation, marked weights change places; children, which come last, are not marked by fitness.
    fn permute(&self, table: &mut [WeightVector], order: &[usize], seed: Seed) {
        let scores: Vec<_> = order.iter().map(|&index| self.parents.scores[index]).collect();
        let mut probabilities = self.settings.permutation.probabilities(&scores, self.nets.topology.weight_count());
        let kept = table.len() - self.settings.offspring_count();
        probabilities[kept..].fill(self.settings.permutation.of_children());
        for gene in 0..self.nets.topology.weight_count() {
            let places = shuffle_marked(&probabilities, &mut seed.individual(gene as u64).stream(PERMUTATION));
            let column: Vec<f32> = places.into_iter().map(|place| table[place].weights()[gene]).collect();
            table.iter_mut().zip(column).for_each(|(net, weight)| net.genes_mut().0[gene] = weight);
        }
    }
}

impl Strategy for Cosyne {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "cosyne"
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let size = self.settings.population;
        if self.settings.restart.is_some_and(|patience| self.stagnation >= patience) {
            self.parents = Parents::default();
            (self.best, self.stagnation, self.has_begun_anew) = (None, 0, true);
        }
        let mut population = self.nets.make_room(size);
        let place = |index: usize| seed.individual(index as u64);
        if self.parents.nets.is_empty() {
            let CosyneSettings { initialization, mutation_rate, mutation_scale, .. } = &self.settings;
            for (index, individual) in population.iter_mut().enumerate() {
                let draw = |individual: &mut WeightVector| {
                    initialization.draw(individual, &mut place(index).stream(FIRST_GENERATION));
                };
                let mutate = |individual: &mut WeightVector| {
                    let mut stream = place(index).stream(REPRODUCTION);
                    cauchy::mutate(individual.genes_mut().0, *mutation_rate, *mutation_scale, &mut stream);
                };
                begin(&self.parents.start, index, individual, draw, mutate);
            }
        } else {
            let order = best_first(&self.parents.scores);
            let kept = size - self.settings.offspring_count();
            population
                .iter_mut()
                .zip(&order[..kept])
                .for_each(|(net, &index)| net.copy_from(&self.parents.nets[index]));
            for (index, child) in population.iter_mut().enumerate().skip(kept) {
                self.breed(child, &order, place(index));
            }
            self.permute(&mut population, &order, seed);
        }
        self.nets.ask(population)
    }

    fn tell(&mut self, evaluations: &[Evaluation], _seed: Seed) {
        self.nets.tell(evaluations, &mut self.parents);
        if self.settings.restart.is_some() {
            let best = self.parents.scores.iter().copied().max().flatten();
            self.stagnation = if best > self.best { 0 } else { self.stagnation + 1 };
            self.best = self.best.max(best);
        }
    }

    fn statistics(&self) -> Vec<Statistic> {
        let scores: Vec<_> = best_first(&self.parents.scores).iter().map(|&index| self.parents.scores[index]).collect();
        let mut marked = self.settings.permutation.probabilities(&scores, self.nets.topology.weight_count());
        // The others are replaced by children.
        marked.truncate(self.settings.population - self.settings.offspring_count());
        vec![
            Statistic::new("diversity", diversity(&self.parents.nets)),
            Statistic::new("marked_share", marked.iter().sum::<f64>() / marked.len().max(1) as f64),
        ]
    }
}
