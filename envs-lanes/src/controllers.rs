use ne_core::Phenotype;
use ne_net::{Network, Topology};
use std::{borrow::Cow, sync::Mutex};

/// The controllers of a generation.
pub(crate) enum Controllers<'a> {
    /// Nets, of which there can be copies.
    Nets {
        nets: Vec<Cow<'a, Network>>,
        /// What they all have; then they think in lanes.
        topology: Option<Topology>,
    },
    /// Others, each of which can be in one place at a time.
    Others(Vec<Mutex<Option<&'a mut dyn Phenotype>>>),
}

impl<'a> Controllers<'a> {
    pub(crate) fn of(phenotypes: &'a mut [&mut dyn Phenotype]) -> Self {
        if phenotypes.iter().any(|phenotype| Network::of(&**phenotype).is_none()) {
            return Self::Others(phenotypes.iter_mut().map(|phenotype| Mutex::new(Some(&mut **phenotype))).collect());
        }
        let nets: Vec<_> = phenotypes.iter().filter_map(|phenotype| Network::of(&**phenotype)).collect();
        let topology = nets.first().map(|net| net.topology());
        let topology = topology.filter(|common| nets.iter().all(|net| net.topology() == *common));
        Self::Nets { nets, topology }
    }

    /// What all nets have in common; then they think in lanes.
    pub(crate) fn topology(&self) -> Option<&Topology> {
        match self {
            Self::Nets { topology, .. } => topology.as_ref(),
            Self::Others(_) => None,
        }
    }
}
