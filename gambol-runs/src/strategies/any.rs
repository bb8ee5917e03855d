//! Strategies and genomes without their types: made once, for all of them.

use super::{NetStrategy, Transfer};
use crate::config::StrategySettings;
use ne_core::{
    Checkpoint, Evaluation, Fitness, FrontPoint, Genome, Origin, Seed, SettingError, SpeciesReport, Statistic, Strategy,
};
use ne_net::{Network, Topology};
use serde::{Serialize, Serializer};
use std::{fmt, sync::Arc};

/// A strategy, whichever it is; it is written as that strategy itself is.
pub struct AnyStrategy(Box<dyn Erased>);

/// A genome of a strategy, whichever it is; it is written as that genome itself is.
#[derive(Clone)]
pub struct AnyGenome(Arc<dyn ErasedGenome>);

impl AnyStrategy {
    pub(super) fn new<S: NetStrategy>(strategy: S) -> Self {
        let front = front_of(&strategy);
        Self(Box::new(Held { strategy, asked: Vec::new(), front }))
    }

    /// Whether it was built with these settings.
    pub fn has_settings(&self, settings: &StrategySettings) -> bool {
        self.0.has_settings(settings)
    }

    /// As [`NetStrategy::transfer`]; the settings are those of the same strategy.
    ///
    /// # Errors
    /// As [`NetStrategy::transfer`].
    pub fn transfer(self, settings: &StrategySettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        self.0.transfer(settings, to)
    }

    /// As [`NetStrategy::fits`].
    pub fn fits(&self, topology: &Topology) -> bool {
        self.0.fits(topology)
    }

    /// As [`NetStrategy::has_begun_anew`].
    pub fn has_begun_anew(&self) -> bool {
        self.0.has_begun_anew()
    }

    /// As [`NetStrategy::has_nothing_to_transfer`].
    pub fn has_nothing_to_transfer(&self) -> bool {
        self.0.has_nothing_to_transfer()
    }
}

impl AnyGenome {
    pub(super) fn new<S: NetStrategy>(genome: S::Genome) -> Self {
        Self(Arc::new(HeldGenome::<S>(genome)))
    }

    /// As [`NetStrategy::net`].
    pub fn net(&self, expressed: bool) -> (Topology, Vec<f32>) {
        self.0.net(expressed)
    }
}

/// A checkpoint whose strategy is one of any kind.
pub(super) fn any_checkpoint<S: NetStrategy>(checkpoint: Checkpoint<S>) -> Checkpoint<AnyStrategy> {
    let Checkpoint { seed, label, progress, champion, candidates, decision, last, strategy } = checkpoint;
    let champion = champion.map(|champion| champion.map(AnyGenome::new::<S>));
    let candidates = candidates.into_iter().map(|candidate| candidate.map(AnyGenome::new::<S>)).collect();
    let strategy = AnyStrategy::new(strategy);
    Checkpoint { seed, label, progress, champion, candidates, decision, last, strategy }
}

/// What all strategies can do.
trait Erased: erased_serde::Serialize + Send {
    fn name(&self) -> &str;
    fn ask(&mut self, seed: Seed) -> &[AnyGenome];
    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed);
    fn statistics(&self) -> Vec<Statistic>;
    fn species(&self) -> Vec<SpeciesReport>;
    fn memberships(&self) -> Vec<u64>;
    fn origins(&self) -> &[Origin];
    fn recommendation(&self) -> Option<AnyGenome>;
    fn front(&self) -> Option<&[Compromise]>;
    fn has_settings(&self, settings: &StrategySettings) -> bool;
    fn transfer(self: Box<Self>, settings: &StrategySettings, to: &Transfer<'_>) -> Result<AnyStrategy, SettingError>;
    fn fits(&self, topology: &Topology) -> bool;
    fn has_begun_anew(&self) -> bool;
    fn has_nothing_to_transfer(&self) -> bool;
}

erased_serde::serialize_trait_object!(Erased);

/// A strategy, and what it has lent out with other types than its own.
struct Held<S: NetStrategy> {
    strategy: S,
    asked: Vec<AnyGenome>,
    front: Option<Vec<Compromise>>,
}

/// A [`FrontPoint`] that owns what it shows.
struct Compromise {
    genome: AnyGenome,
    fitness: Fitness,
    objectives: Vec<Fitness>,
    generation: u64,
}

impl Compromise {
    fn as_point(&self) -> FrontPoint<'_, AnyGenome> {
        let &Self { ref genome, fitness, ref objectives, generation } = self;
        FrontPoint { genome, fitness, objectives, generation }
    }
}

fn front_of<S: NetStrategy>(strategy: &S) -> Option<Vec<Compromise>> {
    let own = |point: FrontPoint<'_, S::Genome>| Compromise {
        genome: AnyGenome::new::<S>(point.genome.clone()),
        fitness: point.fitness,
        objectives: point.objectives.to_vec(),
        generation: point.generation,
    };
    Some(strategy.front()?.into_iter().map(own).collect())
}

impl<S: NetStrategy> Serialize for Held<S> {
    fn serialize<R: Serializer>(&self, serializer: R) -> Result<R::Ok, R::Error> {
        self.strategy.serialize(serializer)
    }
}

impl<S: NetStrategy> Erased for Held<S> {
    fn name(&self) -> &str {
        self.strategy.name()
    }

    fn ask(&mut self, seed: Seed) -> &[AnyGenome] {
        self.asked.clear();
        self.asked.extend(self.strategy.ask(seed).iter().cloned().map(AnyGenome::new::<S>));
        &self.asked
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        self.strategy.tell(evaluations, seed);
        self.front = front_of(&self.strategy);
    }

    fn statistics(&self) -> Vec<Statistic> {
        self.strategy.statistics()
    }

    fn species(&self) -> Vec<SpeciesReport> {
        self.strategy.species()
    }

    fn memberships(&self) -> Vec<u64> {
        self.strategy.memberships()
    }

    fn origins(&self) -> &[Origin] {
        self.strategy.origins()
    }

    fn recommendation(&self) -> Option<AnyGenome> {
        self.strategy.recommendation().map(AnyGenome::new::<S>)
    }

    fn front(&self) -> Option<&[Compromise]> {
        self.front.as_deref()
    }

    fn has_settings(&self, settings: &StrategySettings) -> bool {
        settings.of::<S::Settings>(S::NAME).is_some_and(|settings| settings == *self.strategy.settings())
    }

    fn transfer(self: Box<Self>, settings: &StrategySettings, to: &Transfer<'_>) -> Result<AnyStrategy, SettingError> {
        let of_its_kind = settings.of::<S::Settings>(S::NAME);
        let settings = of_its_kind
            .ok_or_else(|| SettingError::new("strategy", settings.name(), format!("{} with its settings", S::NAME)))?;
        Ok(AnyStrategy::new(self.strategy.transfer(&settings, to)?))
    }

    fn fits(&self, topology: &Topology) -> bool {
        self.strategy.fits(topology)
    }

    fn has_begun_anew(&self) -> bool {
        self.strategy.has_begun_anew()
    }

    fn has_nothing_to_transfer(&self) -> bool {
        self.strategy.has_nothing_to_transfer()
    }
}

impl Strategy for AnyStrategy {
    type Genome = AnyGenome;

    fn name(&self) -> &str {
        self.0.name()
    }

    fn ask(&mut self, seed: Seed) -> &[AnyGenome] {
        self.0.ask(seed)
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        self.0.tell(evaluations, seed);
    }

    fn statistics(&self) -> Vec<Statistic> {
        self.0.statistics()
    }

    fn species(&self) -> Vec<SpeciesReport> {
        self.0.species()
    }

    fn memberships(&self) -> Vec<u64> {
        self.0.memberships()
    }

    fn origins(&self) -> &[Origin] {
        self.0.origins()
    }

    fn recommendation(&self) -> Option<AnyGenome> {
        self.0.recommendation()
    }

    fn front(&self) -> Option<Vec<FrontPoint<'_, AnyGenome>>> {
        Some(self.0.front()?.iter().map(Compromise::as_point).collect())
    }
}

impl Serialize for AnyStrategy {
    fn serialize<R: Serializer>(&self, serializer: R) -> Result<R::Ok, R::Error> {
        self.0.serialize(serializer)
    }
}

impl fmt::Debug for AnyStrategy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("AnyStrategy").field(&self.name()).finish()
    }
}

/// What all genomes can do.
trait ErasedGenome: erased_serde::Serialize + Send + Sync {
    fn express(&self) -> Network;
    fn net(&self, expressed: bool) -> (Topology, Vec<f32>);
}

erased_serde::serialize_trait_object!(ErasedGenome);

/// A genome of a strategy of this type.
struct HeldGenome<S: NetStrategy>(S::Genome);

impl<S: NetStrategy> Serialize for HeldGenome<S> {
    fn serialize<R: Serializer>(&self, serializer: R) -> Result<R::Ok, R::Error> {
        self.0.serialize(serializer)
    }
}

impl<S: NetStrategy> ErasedGenome for HeldGenome<S> {
    fn express(&self) -> Network {
        self.0.express().into()
    }

    fn net(&self, expressed: bool) -> (Topology, Vec<f32>) {
        S::net(&self.0, expressed)
    }
}

impl Genome for AnyGenome {
    type Phenotype = Network;

    fn express(&self) -> Network {
        self.0.express()
    }
}

impl Serialize for AnyGenome {
    fn serialize<R: Serializer>(&self, serializer: R) -> Result<R::Ok, R::Error> {
        self.0.serialize(serializer)
    }
}

impl fmt::Debug for AnyGenome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("AnyGenome").field(&self.express()).finish()
    }
}
