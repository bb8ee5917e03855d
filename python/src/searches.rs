//! Strategies by ask and tell: what Python's `gambol.CmaEs` and its like are made of.

use crate::{
    errors::wrong,
    progress::{self, Progress},
};
use gambol_runs::{config::StrategySettings, strategies::NetStrategy};
use ne_core::{Evaluation, Seed};
use ne_fixed::{Ars, CmaEs, ConventionalNe, Cosyne, HillClimbing, Nsga2, OpenEs, RandomSearch, WeightVector};
use ne_net::{DenseShape, GraphNeuron, GraphShape, Topology};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::{prelude::*, types::PyBytes};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A search for weights, generation by generation, as `ne_core::Evolution` does one.
#[pyclass(module = "gambol._gambol")]
pub(crate) struct Search {
    search: Box<dyn Weights>,
    about: About,
}

/// What there is to know of a search, beside the state of its strategy.
#[derive(Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct About {
    strategy: String,
    dimension: usize,
    progress: Progress<Vec<f32>>,
}

/// A file of it, in memory.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Saved<S> {
    about: About,
    /// The generation asked and not told yet, one genome after the other.
    population: Vec<f32>,
    strategy: S,
}

/// A strategy over weights, whichever it is.
trait Weights: Send + Sync {
    /// The next generation, one genome after the other.
    fn ask(&mut self, seed: Seed) -> Vec<f32>;

    /// The generation last asked, one genome after the other.
    fn population(&self) -> &[f32];

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed);

    fn statistics(&self) -> Vec<(String, f64)>;

    /// Weights and objectives of those that no other is better than in all, if the strategy searches for several.
    fn front(&self) -> Option<Vec<(Vec<f32>, Vec<f64>)>>;

    /// The state, as text.
    fn save(&self, about: &About) -> serde_json::Result<Vec<u8>>;
}

struct Held<S> {
    strategy: S,
    population: Vec<f32>,
}

impl<S: NetStrategy<Genome = WeightVector> + Sync> Weights for Held<S> {
    fn ask(&mut self, seed: Seed) -> Vec<f32> {
        self.population.clear();
        for genome in self.strategy.ask(seed) {
            self.population.extend_from_slice(genome.weights());
        }
        self.population.clone()
    }

    fn population(&self) -> &[f32] {
        &self.population
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        self.strategy.tell(evaluations, seed);
    }

    fn statistics(&self) -> Vec<(String, f64)> {
        self.strategy.statistics().into_iter().map(|statistic| (statistic.name, statistic.value)).collect()
    }

    fn front(&self) -> Option<Vec<(Vec<f32>, Vec<f64>)>> {
        let points = self.strategy.front()?.into_iter();
        Some(
            points
                .map(|point| {
                    (point.genome.weights().to_vec(), point.objectives.iter().map(|value| value.get()).collect())
                })
                .collect(),
        )
    }

    fn save(&self, about: &About) -> serde_json::Result<Vec<u8>> {
        let population = if about.progress.asked.is_some() { self.population.clone() } else { Vec::new() };
        serde_json::to_vec(&Saved { about: about.clone(), population, strategy: &self.strategy })
    }
}

type Make = fn(&StrategySettings, &Topology) -> Result<Box<dyn Weights>, String>;

/// How a strategy is made of settings, and of what was saved.
struct Maker {
    name: &'static str,
    make: Make,
    restore: fn(&[u8]) -> serde_json::Result<Search>,
}

impl Maker {
    const fn of<S: NetStrategy<Genome = WeightVector> + Sync>() -> Self {
        Self { name: S::NAME, make: make::<S>, restore: restore::<S> }
    }
}

const MAKERS: [Maker; 8] = [
    Maker::of::<CmaEs>(),
    Maker::of::<ConventionalNe>(),
    Maker::of::<OpenEs>(),
    Maker::of::<Cosyne>(),
    Maker::of::<Nsga2>(),
    Maker::of::<Ars>(),
    Maker::of::<HillClimbing>(),
    Maker::of::<RandomSearch>(),
];

fn maker(name: &str) -> PyResult<&'static Maker> {
    let known = || MAKERS.map(|maker| maker.name).join(", ");
    let found = MAKERS.iter().find(|maker| maker.name == name);
    found.ok_or_else(|| wrong(format!("there is no strategy \"{name}\" over weights; there are: {}", known())))
}

fn make<S: NetStrategy<Genome = WeightVector> + Sync>(
    settings: &StrategySettings,
    topology: &Topology,
) -> Result<Box<dyn Weights>, String> {
    let settings = settings.of::<S::Settings>(S::NAME).unwrap_or_default();
    let strategy = S::build(&settings, topology).map_err(|error| error.to_string())?;
    Ok(Box::new(Held { strategy, population: Vec::new() }))
}

fn restore<S: NetStrategy<Genome = WeightVector> + Sync>(bytes: &[u8]) -> serde_json::Result<Search> {
    let Saved { about, population, strategy } = serde_json::from_slice::<Saved<S>>(bytes)?;
    let genes = about.progress.asked.unwrap_or(0).checked_mul(about.dimension);
    if about.dimension == 0 || genes != Some(population.len()) {
        return Err(serde::de::Error::custom(progress::WRONG_SIZE));
    }
    Ok(Search { search: Box::new(Held { strategy, population }), about })
}

#[pymethods]
impl Search {
    /// `layers`: inputs, hidden layers and outputs of a dense net whose weights are searched for; `None`: `dimension` numbers
    /// that are all alike. `settings`: a JSON object laid over the strategy's defaults.
    #[new]
    fn new(
        name: &str,
        dimension: Option<usize>,
        layers: Option<Vec<usize>>,
        seed: u64,
        settings: &str,
    ) -> PyResult<Self> {
        let maker = maker(name)?;
        let topology = match (dimension, layers) {
            (Some(dimension), None) => numbers(dimension)?,
            (None, Some(layers)) => net(&layers)?,
            _ => return Err(wrong("say either the dimension or the layers of a net")),
        };
        topology.validate().map_err(|error| wrong(error.within("layers")))?;
        let settings = progress::settings(maker.name, settings, &topology)?;
        let search = (maker.make)(&settings, &topology).map_err(wrong)?;
        let (strategy, dimension) = (maker.name.to_owned(), topology.weight_count());
        Ok(Self { search, about: About { strategy, dimension, progress: Progress::new(seed) } })
    }

    /// The next generation: float32[population, dimension]; until it is told, the same again.
    fn ask<'py>(&mut self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let Self { search, about: About { dimension, progress, .. } } = self;
        let seed = progress.seed();
        let genes = match progress.asked {
            Some(_) => search.population().to_vec(),
            None => py.detach(|| search.ask(seed)),
        };
        let count = genes.len() / *dimension;
        progress.asked = Some(count);
        PyArray1::from_vec(py, genes).reshape([count, *dimension])
    }

    /// The results of the generation last asked, in its order: a fitness each, NaN for an evaluation that failed, and the
    /// objectives, if there are any.
    fn tell(
        &mut self,
        py: Python<'_>,
        fitness: PyReadonlyArray1<'_, f64>,
        objectives: Option<PyReadonlyArray2<'_, f64>>,
    ) -> PyResult<()> {
        let Self { search, about: About { dimension, progress, .. } } = self;
        let seed = progress.seed();
        let genome = |index| search.population()[index * *dimension..][..*dimension].to_vec();
        let evaluations = progress.told(fitness, objectives, genome)?;
        py.detach(|| search.tell(&evaluations, seed));
        Ok(())
    }

    /// The best so far: weights, fitness and generation, from 1.
    fn best<'py>(&self, py: Python<'py>) -> Option<(Bound<'py, PyArray1<f32>>, f64, u64)> {
        let best = self.about.progress.best.as_ref()?;
        Some((PyArray1::from_slice(py, &best.genome), best.fitness.get(), best.generation))
    }

    /// Weights and objectives of those that no other is better than in all; `None` if the strategy does not search for several.
    fn front(&self) -> Option<Vec<(Vec<f32>, Vec<f64>)>> {
        self.search.front()
    }

    /// What the strategy says of itself.
    fn statistics(&self) -> Vec<(String, f64)> {
        self.search.statistics()
    }

    /// Its whole state.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let saved = py.detach(|| self.search.save(&self.about)).map_err(wrong)?;
        Ok(PyBytes::new(py, &saved))
    }

    /// A search from what was saved.
    #[staticmethod]
    fn restore(py: Python<'_>, name: &str, saved: &[u8]) -> PyResult<Self> {
        let maker = maker(name)?;
        py.detach(|| (maker.restore)(saved)).map_err(|error| wrong(format!("the state of {name}: {error}")))
    }

    /// How many generations have been told.
    #[getter]
    fn generations(&self) -> u64 {
        self.about.progress.generations
    }

    /// How many numbers a genome has.
    #[getter]
    fn dimension(&self) -> usize {
        self.about.dimension
    }

    /// The strategy's name.
    #[getter]
    fn name(&self) -> &str {
        &self.about.strategy
    }
}

/// Numbers that are all alike: the weights of neurons without biases, as few as there can be.
fn numbers(dimension: usize) -> PyResult<Topology> {
    if !(1..=GraphShape::MAX_WEIGHTS).contains(&dimension) {
        return Err(wrong(format!("dimension = {dimension}: must be from 1 to {}", GraphShape::MAX_WEIGHTS)));
    }
    let inputs = dimension.min(GraphShape::MAX_WIDTH);
    let neuron = |from| GraphNeuron {
        activation: ne_net::Activation::Tanh,
        bias: false,
        sources: (0..inputs.min(dimension - from)).collect(),
    };
    let neurons: Vec<GraphNeuron> = (0..dimension).step_by(inputs).map(neuron).collect();
    Ok(Topology::Graph(Arc::new(GraphShape { inputs, recurrent: false, neurons, outputs: vec![inputs] })))
}

/// A dense net with these layers, inputs first.
fn net(layers: &[usize]) -> PyResult<Topology> {
    let [inputs, hidden @ .., outputs] = layers else {
        return Err(wrong("layers: must be at least two, the inputs and the outputs"));
    };
    Ok(Topology::Dense(Arc::new(DenseShape::new(*inputs, hidden.to_vec(), *outputs))))
}
