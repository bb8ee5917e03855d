//! The strategies Gambol brings along, registered as any other.

use super::{NetStrategy, StrategyCatalogue, Transfer, expressed_net, weights_of};
use ne_core::SettingError;
use ne_fixed::{
    Ars, ArsSettings, CmaEs, CmaEsSettings, ConventionalNe, ConventionalNeSettings, Cosyne, CosyneSettings,
    HillClimbing, HillClimbingSettings, Nsga2, Nsga2Settings, OpenEs, OpenEsSettings, RandomSearch,
    RandomSearchSettings, WeightVector,
};
use ne_neat::{Neat, NeatGenome, NeatSettings};
use ne_net::Topology;
use std::sync::Arc;

impl Default for StrategyCatalogue {
    fn default() -> Self {
        let mut catalogue = Self::empty();
        let conventional = "conventional neuroevolution: a genetic algorithm over the weights of a fixed net";
        catalogue.add::<ConventionalNe>(conventional).with_alias("ga");
        let neat = "NeuroEvolution of Augmenting Topologies: the net's connections and neurons evolve with its weights";
        catalogue.add::<Neat>(neat);
        let cma_es = "covariance matrix adaptation: a normal distribution of weights that learns which way is up";
        catalogue.add::<CmaEs>(cma_es);
        catalogue.add::<OpenEs>("OpenAI's evolution strategy: gradient steps estimated from mirrored perturbations");
        catalogue.add::<Cosyne>("cooperative synapse neuroevolution: the weights of each place in the net coevolve");
        catalogue.add::<Nsga2>("NSGA-II: a front of compromises between several objectives (movement.objectives)");
        catalogue.add::<Ars>("augmented random search, V1-t: steps along the best of random directions; a baseline");
        catalogue.add::<HillClimbing>("hill climbing: one parent and its noisy copies, the best goes on; a baseline");
        catalogue.add::<RandomSearch>("random search: every net is drawn anew, nothing is learnt; a baseline");
        catalogue
    }
}

/// The schema of settings that derive theirs.
macro_rules! derived_schema {
    () => {
        #[cfg(feature = "schema")]
        fn settings_schema(generator: &mut schemars::SchemaGenerator) -> Option<schemars::Schema> {
            Some(generator.subschema_for::<Self::Settings>())
        }
    };
}

/// A search for the weights of a fixed net: all have the same ways to begin, and to go on.
macro_rules! weight_search {
    ($strategy:ty, $settings:ty, $name:literal $($more:tt)*) => {
        impl NetStrategy for $strategy {
            const NAME: &'static str = $name;

            type Settings = $settings;

            fn build(settings: &$settings, topology: &Topology) -> Result<Self, SettingError> {
                Self::new(settings.clone(), topology.clone())
            }

            fn settings(&self) -> &$settings {
                self.settings()
            }

            fn transfer(self, settings: &$settings, to: &Transfer<'_>) -> Result<Self, SettingError> {
                Self::remapped(self, settings.clone(), to.topology.clone(), to.genes)
            }

            fn fits(&self, topology: &Topology) -> bool {
                self.topology() == topology
            }

            fn begin_at(settings: &$settings, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
                Self::build(settings, topology)?.with_start(&[weights.to_vec()])
            }

            fn genome(topology: &Topology, weights: &[f32]) -> Option<WeightVector> {
                WeightVector::new(topology.clone(), weights.to_vec(), 0.0).ok()
            }

            fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
                weights_of(genome, expressed)
            }

            derived_schema!();

            $($more)*
        }
    };
}

weight_search!(ConventionalNe, ConventionalNeSettings, "conventional");
weight_search!(OpenEs, OpenEsSettings, "open-es");
weight_search!(
    Cosyne, CosyneSettings, "cosyne"

    fn has_begun_anew(&self) -> bool {
        self.has_begun_anew()
    }
);
weight_search!(Nsga2, Nsga2Settings, "nsga2");
weight_search!(Ars, ArsSettings, "ars");
weight_search!(HillClimbing, HillClimbingSettings, "hill-climbing");
weight_search!(
    CmaEs, CmaEsSettings, "cma-es"

    fn begin_about(settings: &CmaEsSettings, topology: &Topology, guess: &[f32]) -> Result<Self, SettingError> {
        Self::build(settings, topology)?.with_guess(guess)
    }

    fn has_begun_anew(&self) -> bool {
        self.has_begun_anew()
    }

    fn has_nothing_to_transfer(&self) -> bool {
        self.has_begun_anew() && self.mean().is_none()
    }
);

impl NetStrategy for Neat {
    const NAME: &'static str = "neat";
    const FINDS_TOPOLOGY: bool = true;
    const FINDS_COPIED: bool = true;

    type Settings = NeatSettings;

    fn build(settings: &NeatSettings, topology: &Topology) -> Result<Self, SettingError> {
        match topology {
            Topology::Copied(copied) => Self::of_copies(settings.clone(), Arc::clone(&copied.copies)),
            whole => Self::new(settings.clone(), whole.inputs(), whole.outputs()),
        }
    }

    fn settings(&self) -> &NeatSettings {
        self.settings()
    }

    fn transfer(self, settings: &NeatSettings, to: &Transfer<'_>) -> Result<Self, SettingError> {
        let copies = match to.topology {
            Topology::Copied(copied) => Some(Arc::clone(&copied.copies)),
            _ => None,
        };
        if copies.is_some() != self.copies().is_some() {
            let told = |is_some| if is_some { "a net for each limb" } else { "one net" };
            let (found, allowed) = (told(copies.is_some()), told(self.copies().is_some()));
            let allowed = format!("{allowed}, as before: a net that neat has found for the one is none for the other");
            return Err(SettingError::new("controller.modular", found, allowed));
        }
        Self::remapped(self, settings.clone(), copies, to.inputs, to.outputs)
    }

    fn fits(&self, topology: &Topology) -> bool {
        match topology {
            Topology::Copied(copied) => self.copies() == Some(&copied.copies),
            whole => {
                let layout = self.layout();
                self.copies().is_none() && (layout.inputs, layout.outputs) == (whole.inputs(), whole.outputs())
            }
        }
    }

    fn begin_at(_: &NeatSettings, _: &Topology, _: &[f32]) -> Result<Self, SettingError> {
        Err(SettingError::new("strategy", "neat", "one that searches the weights of a given net"))
    }

    /// It finds its topology itself.
    fn genome(_: &Topology, _: &[f32]) -> Option<NeatGenome> {
        None
    }

    fn net(genome: &NeatGenome, _: bool) -> (Topology, Vec<f32>) {
        expressed_net(genome)
    }

    derived_schema!();
}

/// It learns nothing, so that it can neither begin at a net nor go on with what it knows.
impl NetStrategy for RandomSearch {
    const NAME: &'static str = "random-search";

    type Settings = RandomSearchSettings;

    fn build(settings: &RandomSearchSettings, topology: &Topology) -> Result<Self, SettingError> {
        Self::new(settings.clone(), topology.clone())
    }

    fn settings(&self) -> &RandomSearchSettings {
        self.settings()
    }

    fn fits(&self, topology: &Topology) -> bool {
        self.topology() == topology
    }

    /// What others have found it does not go on from.
    fn genome(_: &Topology, _: &[f32]) -> Option<WeightVector> {
        None
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        weights_of(genome, expressed)
    }

    derived_schema!();
}

#[cfg(test)]
mod tests {
    use super::*;
    use ne_core::{Evaluation, Seed, Strategy};
    use ne_net::DenseShape;

    #[test]
    fn a_strategy_that_takes_a_place_has_its_alias_or_one_of_its_own() {
        let mut catalogue = StrategyCatalogue::default();
        let entry = catalogue.add::<ConventionalNe>("another of this name");
        assert_eq!(entry.alias(), Some("ga"));
        entry.with_alias("classic");
        let named =
            |catalogue: &StrategyCatalogue, alias: &str| catalogue.find(alias).map(|entry| entry.name().to_owned());
        assert_eq!(named(&catalogue, "classic").as_deref(), Some("conventional"));
        assert_eq!(named(&catalogue, "ga"), None);
    }

    fn of_width(hidden: usize) -> Topology {
        DenseShape::new(3, vec![hidden], 2).into()
    }

    fn fits<S: NetStrategy>() -> [bool; 2] {
        let strategy = S::build(&S::Settings::default(), &of_width(4)).expect("valid");
        [strategy.fits(&of_width(4)), strategy.fits(&of_width(5))]
    }

    #[test]
    fn searches_of_weights_fit_their_own_topology_and_no_other_of_as_many_inputs_and_outputs() {
        for fits in [
            fits::<ConventionalNe>(),
            fits::<OpenEs>(),
            fits::<Cosyne>(),
            fits::<Nsga2>(),
            fits::<Ars>(),
            fits::<HillClimbing>(),
            fits::<CmaEs>(),
            fits::<RandomSearch>(),
        ] {
            assert_eq!(fits, [true, false]);
        }
        assert_eq!(fits::<Neat>(), [true, true], "it finds its own");
    }

    /// A stage after such a search goes on from the champion.
    #[test]
    fn a_search_by_cosyne_that_has_restarted_says_so() {
        let settings = CosyneSettings { restart: Some(2), ..CosyneSettings::default() };
        let mut strategy = <Cosyne as NetStrategy>::build(&settings, &of_width(4)).expect("valid");
        let has_begun_anew = (1..=4).map(|number| {
            let seed = Seed::of_run(1).generation(number);
            let size = strategy.ask(seed).len();
            strategy.tell(&vec![Evaluation::new(1.0); size], seed);
            NetStrategy::has_begun_anew(&strategy)
        });
        assert_eq!(has_begun_anew.collect::<Vec<_>>(), [false, false, false, true]);
    }
}
