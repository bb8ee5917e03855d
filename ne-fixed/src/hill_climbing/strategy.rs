use super::{HillClimbingSettings, state::State};
use crate::{
    Mutation, WeightVector,
    nets::{Nets, check_growth},
    ranking::best_first,
};
use ne_core::{Evaluation, Purpose, Seed, SettingError, Statistic, Strategy};
use ne_net::{Topology, TopologyMap};
use serde::{Deserialize, Serialize};

const FIRST_GENERATION: Purpose = Purpose::new("hill-climbing first generation");
const MUTATION: Purpose = Purpose::new("hill-climbing mutation");

/// Hill climbing with several tries: one parent, children that are copies of it with Gaussian noise, and the best of all
/// is the next parent; a (1+λ) evolution strategy whose deviation stays as it is.
///
/// The parent is evaluated again with its children, as its fitness in other worlds would say nothing about them. A child
/// that is as good as its parent takes its place, so that the search does not rest on a plateau; failed evaluations rank
/// below every fitness. The first generation is drawn.
///
/// # Statistics
/// - `success_share`: the share of the children last told that were at least as good as their parent; 0 before.
///
/// Source: Beyer & Schwefel, *Evolution Strategies: A Comprehensive Introduction*, Natural Computing 1, 2002, section 1
/// (the two-membered strategy, here with λ children).
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "State", try_from = "State")]
pub struct HillClimbing {
    pub(super) settings: HillClimbingSettings,
    pub(super) nets: Nets,
    /// None before the first generation was told, unless the search begins at given weights.
    pub(super) parent: Option<WeightVector>,
    /// How many of the children last told were at least as good as their parent.
    pub(super) as_good: usize,
}

impl HillClimbing {
    /// A search for weights of nets of this topology.
    ///
    /// # Errors
    /// If a setting or a width of the topology (`topology.hidden[0]`) is out of range.
    pub fn new(settings: HillClimbingSettings, topology: impl Into<Topology>) -> Result<Self, SettingError> {
        settings.validate()?;
        Ok(Self { settings, nets: Nets::new(topology)?, parent: None, as_good: 0 })
    }

    /// The same search, whose first parent is the first of these nets, the best of several. Without effect once a generation
    /// was asked.
    ///
    /// # Errors
    /// If they are not weights of this search's topology; the error names the net: `start[0]`.
    pub fn with_start(mut self, start: &[Vec<f32>]) -> Result<Self, SettingError> {
        let start = self.nets.start(start, 0.0)?;
        if self.parent.is_none() && !self.nets.asked {
            self.parent = start.into_iter().next();
        }
        Ok(self)
    }

    /// Goes on with other settings, on another task, or with nets that have grown: with its parent, in which new weights
    /// are 0.
    ///
    /// # Errors
    /// If a setting is out of range, or the growth is not from this topology to that one.
    pub fn remapped(
        self,
        settings: HillClimbingSettings,
        topology: impl Into<Topology>,
        growth: &TopologyMap,
    ) -> Result<Self, SettingError> {
        let next = Self::new(settings, topology)?;
        check_growth(growth, &self.nets.topology, &next.nets.topology)?;
        let parent = self.parent.map(|parent| parent.remapped(&next.nets.topology, growth));
        Ok(Self { parent, ..next })
    }

    /// The settings.
    pub fn settings(&self) -> &HillClimbingSettings {
        &self.settings
    }

    /// The topology of all nets.
    pub fn topology(&self) -> &Topology {
        &self.nets.topology
    }

    /// The net that has children; none before the first generation was told.
    pub fn parent(&self) -> Option<&WeightVector> {
        self.parent.as_ref()
    }
}

impl Strategy for HillClimbing {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        "hill-climbing"
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        let mut population = self.nets.make_room(self.settings.population);
        let mutation = self.settings.mutation();
        for (index, net) in population.iter_mut().enumerate() {
            let place = seed.individual(index as u64);
            let Some(parent) = &self.parent else {
                self.settings.initialization.draw(net, &mut place.stream(FIRST_GENERATION));
                continue;
            };
            net.copy_from(parent);
            if index > 0 {
                let (weights, deviation) = net.genes_mut();
                mutation.mutate(weights, deviation, 1.0, &mut place.stream(MUTATION));
                weights.iter_mut().for_each(|weight| *weight = weight.clamp(f32::MIN, f32::MAX));
            }
        }
        self.nets.ask(population)
    }

    fn tell(&mut self, evaluations: &[Evaluation], _seed: Seed) {
        debug_assert_eq!(evaluations.len(), self.nets.population.len());
        self.nets.asked = false;
        let scores: Vec<_> = evaluations.iter().map(Evaluation::fitness).collect();
        let first_generation = self.parent.is_none();
        self.as_good = match first_generation {
            true => 0,
            false => scores[1..].iter().filter(|score| **score >= scores[0]).count(),
        };
        let order = best_first(&scores);
        // The parent stands first, so of equals it comes first; a child as good goes before it.
        let best = match order[..] {
            [0, second, ..] if !first_generation && scores[second] == scores[0] => second,
            [best, ..] => best,
            [] => return,
        };
        self.parent = Some(self.nets.population[best].clone());
    }

    fn statistics(&self) -> Vec<Statistic> {
        let children = self.settings.population - 1;
        vec![Statistic::new("success_share", self.as_good as f64 / children as f64)]
    }
}
