use crate::{
    StateError, WeightVector,
    ranking::best_first,
    state_error::{Genes, generation},
};
use ne_core::{Evaluation, Fitness, SettingError};
use ne_net::{Topology, TopologyMap};

/// The nets of a search for weights: their topology, and the generation last asked.
#[derive(Clone, Debug)]
pub(crate) struct Nets {
    pub(crate) topology: Topology,
    /// The generation last asked. Once told, what stands here is memory to be used again.
    pub(crate) population: Vec<WeightVector>,
    /// Whether `population` was asked and not told yet.
    pub(crate) asked: bool,
}

impl Nets {
    /// No nets of this topology yet.
    pub(crate) fn new(topology: impl Into<Topology>) -> Result<Self, SettingError> {
        let topology = topology.into();
        topology.validate().map_err(|error| error.within("topology"))?;
        Ok(Self { topology, population: Vec::new(), asked: false })
    }

    /// Room for the next generation; individuals hold whatever they held.
    pub(crate) fn make_room(&mut self, size: usize) -> Vec<WeightVector> {
        let mut population = std::mem::take(&mut self.population);
        population.resize_with(size, || WeightVector::zero(self.topology.clone()));
        population
    }

    /// The net at this centre of a search; none before there is one.
    pub(crate) fn at(&self, centre: &[f64]) -> Option<WeightVector> {
        (!centre.is_empty()).then(|| WeightVector::rounded(&self.topology, centre))
    }

    /// Asks the next generation.
    pub(crate) fn ask(&mut self, population: Vec<WeightVector>) -> &[WeightVector] {
        self.population = population;
        self.asked = true;
        &self.population
    }

    /// The generation was told: it becomes the parents, with its scores.
    pub(crate) fn tell(&mut self, evaluations: &[Evaluation], parents: &mut Parents) {
        debug_assert_eq!(evaluations.len(), self.population.len());
        std::mem::swap(&mut parents.nets, &mut self.population);
        parents.start.clear();
        self.asked = false;
        parents.scores.clear();
        parents.scores.extend(evaluations.iter().map(Evaluation::fitness));
    }

    /// The generation asked and not told yet.
    pub(crate) fn waiting(&self) -> &[WeightVector] {
        if self.asked { &self.population } else { &[] }
    }

    /// The same, for a checkpoint.
    pub(crate) fn saved<'a, T: From<&'a WeightVector>>(&'a self) -> Vec<T> {
        self.waiting().iter().map(T::from).collect()
    }

    /// Goes on with a generation of `size` from a checkpoint.
    pub(crate) fn load<G: Into<Genes>>(&mut self, asked: Vec<G>, size: usize) -> Result<(), StateError> {
        self.population = generation("asked", asked, size, &self.topology)?;
        self.asked = !self.population.is_empty();
        Ok(())
    }

    /// Individuals that a search is to begin with.
    pub(crate) fn start(&self, start: &[Vec<f32>], deviation: f32) -> Result<Vec<WeightVector>, SettingError> {
        check_start(start, &self.topology)?;
        Ok(start
            .iter()
            .map(|weights| WeightVector::checked(self.topology.clone(), weights.clone(), deviation))
            .collect())
    }
}

/// Checks the weights of nets that a search is to begin with.
pub(crate) fn check_start(start: &[Vec<f32>], topology: &Topology) -> Result<(), SettingError> {
    start.iter().enumerate().try_for_each(|(index, weights)| {
        let wrong = |error| SettingError::new(format!("start[{index}]"), error, "weights of the net");
        topology.check_weights(weights).map_err(wrong)
    })
}

/// Checks that a growth is from one topology to the other.
pub(crate) fn check_growth(growth: &TopologyMap, old: &Topology, new: &Topology) -> Result<(), SettingError> {
    let (found, expected) =
        ([growth.old_weight_count(), growth.weight_count()], [old.weight_count(), new.weight_count()]);
    if found == expected {
        return Ok(());
    }
    let found = format!("from {} to {} weights", found[0], found[1]);
    Err(SettingError::new("growth", found, format!("from {} to {}, as the topologies have", expected[0], expected[1])))
}

/// What the next generation of a search comes from.
#[derive(Clone, Debug, Default)]
pub(crate) struct Parents {
    /// The first generation, best first, if it is not drawn; empty after it.
    pub(crate) start: Vec<WeightVector>,
    /// The generation last told. Empty before the first, and where it is dropped once its children are bred.
    pub(crate) nets: Vec<WeightVector>,
    /// What came of it.
    pub(crate) scores: Vec<Option<Fitness>>,
}

impl Parents {
    /// What a search on another task begins with, best first, in nets that have grown.
    pub(crate) fn remapped(&self, topology: &Topology, growth: &TopologyMap) -> Self {
        let best: Vec<&WeightVector> = match self.nets.is_empty() {
            true => self.start.iter().collect(),
            false => best_first(&self.scores).into_iter().map(|index| &self.nets[index]).collect(),
        };
        let start = best.into_iter().map(|net| net.remapped(topology, growth)).collect();
        Self { start, ..Self::default() }
    }
}

/// Makes the individual at this place of a first generation: one of those it begins with, a copy of one that has mutated, or
/// drawn if there is none.
pub(crate) fn begin(
    start: &[WeightVector],
    index: usize,
    individual: &mut WeightVector,
    draw: impl FnOnce(&mut WeightVector),
    mutate: impl FnOnce(&mut WeightVector),
) {
    if start.is_empty() {
        return draw(individual);
    }
    individual.copy_from(&start[index % start.len()]);
    if index >= start.len() {
        mutate(individual);
    }
}
