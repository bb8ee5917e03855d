//! NEAT by ask and tell: what Python's `gambol.Neat` and `gambol.NeatGenome` are made of.

use crate::{
    champions::Net,
    errors::wrong,
    progress::{self, Progress},
};
use ne_core::{Fitness, Genome as _, Strategy as _};
use ne_neat::{Neat, NeatGenome, NeatSettings};
use ne_net::{DenseShape, Network, Topology};
use numpy::PyReadonlyArray1;
use pyo3::{prelude::*, types::PyBytes};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A genome. It does not change.
#[pyclass(module = "gambol._gambol", frozen, eq)]
#[derive(Clone, PartialEq)]
pub(crate) struct Genes(NeatGenome);

#[pymethods]
impl Genes {
    /// The genes of its neurons: number, activation, bias.
    fn nodes(&self) -> PyResult<Vec<(u32, String, f32)>> {
        let gene = |node: &ne_neat::NodeGene| {
            let activation = serde_json::to_value(node.activation).map_err(wrong)?;
            Ok((node.id, activation.as_str().unwrap_or_default().to_owned(), node.bias))
        };
        self.0.nodes().iter().map(gene).collect()
    }

    /// The genes of its connections: innovation number, source, target, weight, whether it is expressed.
    fn connections(&self) -> Vec<(u32, u32, u32, f32, bool)> {
        let gene = |gene: &ne_neat::ConnectionGene| (gene.innovation, gene.from, gene.to, gene.weight, gene.enabled);
        self.0.connections().iter().map(gene).collect()
    }

    /// How many inputs and outputs it has, and how many sources, among which may be a bias node.
    fn layout(&self) -> (usize, usize, usize) {
        (self.0.layout().inputs, self.0.layout().outputs, self.0.layout().sources())
    }

    /// Its net.
    fn net(&self) -> Net {
        Net::from(Network::Graph(self.0.express()))
    }

    /// In the language of Graphviz.
    fn dot(&self, inputs: Vec<String>, outputs: Vec<String>) -> String {
        let [inputs, outputs] = [&inputs, &outputs].map(|names| names.iter().map(String::as_str).collect::<Vec<_>>());
        self.0.to_dot(&inputs, &outputs)
    }

    /// Its JSON.
    fn text(&self) -> PyResult<String> {
        serde_json::to_string(&self.0).map_err(wrong)
    }

    /// A genome from its JSON.
    #[staticmethod]
    fn of_text(text: &str) -> PyResult<Self> {
        serde_json::from_str(text).map(Self).map_err(wrong)
    }
}

/// A search for nets of any graph.
#[pyclass(module = "gambol._gambol")]
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct NeatSearch {
    strategy: Neat,
    progress: Progress<NeatGenome>,
    /// The generation that was asked and not told yet.
    asked: Vec<NeatGenome>,
}

#[pymethods]
impl NeatSearch {
    /// `settings`: a JSON object laid over the defaults.
    #[new]
    fn new(inputs: usize, outputs: usize, seed: u64, settings: &str) -> PyResult<Self> {
        let topology = Topology::Dense(Arc::new(DenseShape::new(inputs, Vec::new(), outputs)));
        let settings = progress::settings("neat", settings, &topology)?;
        let settings = settings.of::<NeatSettings>("neat").unwrap_or_default();
        let strategy = Neat::new(settings, inputs, outputs).map_err(wrong)?;
        Ok(Self { strategy, progress: Progress::new(seed), asked: Vec::new() })
    }

    /// The next generation; until it is told, the same again.
    fn ask(&mut self, py: Python<'_>) -> Vec<Genes> {
        let Self { strategy, progress, asked } = self;
        if progress.asked.is_none() {
            let seed = progress.seed();
            *asked = py.detach(|| strategy.ask(seed).to_vec());
            progress.asked = Some(asked.len());
        }
        asked.iter().cloned().map(Genes).collect()
    }

    /// The fitness of each of the generation last asked, in its order; NaN for an evaluation that failed.
    fn tell(&mut self, py: Python<'_>, fitness: PyReadonlyArray1<'_, f64>) -> PyResult<()> {
        let Self { strategy, progress, asked } = self;
        let seed = progress.seed();
        let evaluations = progress.told(fitness, None, |index| asked[index].clone())?;
        py.detach(|| strategy.tell(&evaluations, seed));
        asked.clear();
        Ok(())
    }

    /// The best so far: genome, fitness and generation, from 1.
    fn best(&self) -> Option<(Genes, f64, u64)> {
        let best = self.progress.best.as_ref()?;
        Some((Genes(best.genome.clone()), best.fitness.get(), best.generation))
    }

    /// The species of the generation last told: number, size, and the best fitness of each.
    fn species(&self) -> Vec<(u64, u64, Option<f64>)> {
        let species = self.strategy.species().into_iter();
        species.map(|species| (species.id, species.size, species.best.map(Fitness::get))).collect()
    }

    /// The number of the species of each individual of the generation last told.
    fn memberships(&self) -> Vec<u64> {
        self.strategy.memberships()
    }

    /// What the strategy says of itself.
    fn statistics(&self) -> Vec<(String, f64)> {
        self.strategy.statistics().into_iter().map(|statistic| (statistic.name, statistic.value)).collect()
    }

    /// Its whole state.
    fn save<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let saved = py.detach(|| serde_json::to_vec(self)).map_err(wrong)?;
        Ok(PyBytes::new(py, &saved))
    }

    /// A search from what was saved.
    #[staticmethod]
    fn restore(py: Python<'_>, saved: &[u8]) -> PyResult<Self> {
        let damaged = |error: serde_json::Error| wrong(format!("the state of neat: {error}"));
        let search: Self = py.detach(|| serde_json::from_slice(saved)).map_err(damaged)?;
        match search.progress.asked.unwrap_or(0) == search.asked.len() {
            true => Ok(search),
            false => Err(damaged(serde::de::Error::custom(progress::WRONG_SIZE))),
        }
    }

    /// How many generations have been told.
    #[getter]
    fn generations(&self) -> u64 {
        self.progress.generations
    }
}
