//! The check of strategies over nets passes the built-in ones, and names the promise that a deliberately broken one breaks.

use gambol_runs::strategies::{
    NetStrategy, Transfer,
    conformance::{self, check_net_strategy},
    weights_of,
};
use ne_core::{Evaluation, Seed, SettingError, Strategy, conformance::Promise};
use ne_fixed::{
    Ars, CmaEs, ConventionalNe, Cosyne, HillClimbing, HillClimbingSettings, Nsga2, OpenEs, RandomSearch, WeightVector,
};
use ne_neat::Neat;
use ne_net::{DenseShape, Topology};
use serde::{Deserialize, Serialize, de::DeserializeOwned};

#[test]
fn the_built_in_strategies_pass() {
    fn check<S: NetStrategy>() {
        check_net_strategy::<S>(&S::Settings::default(), &Default::default())
            .unwrap_or_else(|violation| panic!("{}: {violation}", S::NAME));
    }
    check::<ConventionalNe>();
    check::<Neat>();
    check::<CmaEs>();
    check::<OpenEs>();
    check::<Cosyne>();
    check::<Nsga2>();
    check::<Ars>();
    check::<HillClimbing>();
    check::<RandomSearch>();
}

/// Hill climbing, with settings of its own and one flaw.
#[derive(Serialize, Deserialize)]
struct Flawed<T, const FLAW: u8> {
    climbing: HillClimbing,
    settings: T,
}

const NONE: u8 = 0;
const ANOTHER_NAME: u8 = 1;
const DEFAULT_SETTINGS: u8 = 2;
const FITS_NOTHING: u8 = 3;
const REFUSES_HIDDEN_NEURONS: u8 = 4;
const HALVES_EXPRESSED: u8 = 5;
const LOSES_A_WEIGHT: u8 = 6;
const FINDS_A_TOPOLOGY: u8 = 7;
const NEGATES: u8 = 8;
const GENOME_OF_FEWER: u8 = 9;
const BEGINS_WITH_FEWER: u8 = 10;
const BEGINS_WITH_DEFAULTS: u8 = 11;
const PANICS_IN_TRANSFER: u8 = 12;
const TRANSFERS_TO_DEFAULTS: u8 = 13;

impl<T: NetSettings, const FLAW: u8> Strategy for Flawed<T, FLAW> {
    type Genome = WeightVector;

    fn name(&self) -> &str {
        if FLAW == ANOTHER_NAME { "climbing" } else { Self::NAME }
    }

    fn ask(&mut self, seed: Seed) -> &[WeightVector] {
        self.climbing.ask(seed)
    }

    fn tell(&mut self, evaluations: &[Evaluation], seed: Seed) {
        self.climbing.tell(evaluations, seed);
    }
}

/// What the settings of a strategy over nets are.
trait NetSettings: Clone + Default + PartialEq + Serialize + DeserializeOwned + Send + 'static {}

impl<T: Clone + Default + PartialEq + Serialize + DeserializeOwned + Send + 'static> NetSettings for T {}

impl<T: NetSettings, const FLAW: u8> Flawed<T, FLAW> {
    fn of(settings: &T, climbing: HillClimbing) -> Self {
        Self { climbing, settings: settings.clone() }
    }

    /// As many weights as the topology has, of those given.
    fn padded(topology: &Topology, weights: &[f32]) -> Vec<f32> {
        (0..topology.weight_count()).map(|index| weights.get(index).copied().unwrap_or(0.0)).collect()
    }
}

impl<T: NetSettings, const FLAW: u8> NetStrategy for Flawed<T, FLAW> {
    const NAME: &'static str = "flawed";

    type Settings = T;

    fn build(settings: &T, topology: &Topology) -> Result<Self, SettingError> {
        let has_hidden = topology.weight_count() > 8;
        if FLAW == REFUSES_HIDDEN_NEURONS && has_hidden {
            return Err(SettingError::new("hidden", 4, "none"));
        }
        let settings_kept = if FLAW == DEFAULT_SETTINGS { &T::default() } else { settings };
        Ok(Self::of(settings_kept, HillClimbing::new(HillClimbingSettings::default(), topology.clone())?))
    }

    fn settings(&self) -> &T {
        &self.settings
    }

    fn fits(&self, topology: &Topology) -> bool {
        FLAW != FITS_NOTHING && self.climbing.topology() == topology
    }

    fn begin_at(settings: &T, topology: &Topology, weights: &[f32]) -> Result<Self, SettingError> {
        let weights = if FLAW == BEGINS_WITH_FEWER { Self::padded(topology, weights) } else { weights.to_vec() };
        let Self { climbing, settings } = Self::build(settings, topology)?;
        let settings = if FLAW == BEGINS_WITH_DEFAULTS { T::default() } else { settings };
        Ok(Self::of(&settings, climbing.with_start(&[weights])?))
    }

    fn transfer(self, settings: &T, to: &Transfer<'_>) -> Result<Self, SettingError> {
        assert!(FLAW != PANICS_IN_TRANSFER, "on purpose");
        let settings = if FLAW == TRANSFERS_TO_DEFAULTS { &T::default() } else { settings };
        let climbing = self.climbing.remapped(HillClimbingSettings::default(), to.topology.clone(), to.genes)?;
        Ok(Self::of(settings, climbing))
    }

    fn genome(topology: &Topology, weights: &[f32]) -> Option<WeightVector> {
        let weights = match FLAW {
            NEGATES => weights.iter().map(|weight| -weight).collect(),
            GENOME_OF_FEWER => Self::padded(topology, weights),
            _ => weights.to_vec(),
        };
        WeightVector::new(topology.clone(), weights, 0.0).ok()
    }

    fn net(genome: &WeightVector, expressed: bool) -> (Topology, Vec<f32>) {
        let (topology, mut weights) = weights_of(genome, expressed);
        match FLAW {
            HALVES_EXPRESSED if expressed => weights.iter_mut().for_each(|weight| *weight *= 0.5),
            LOSES_A_WEIGHT if !expressed => weights.truncate(weights.len() - 1),
            FINDS_A_TOPOLOGY if !expressed => {
                let found: Topology = DenseShape::new(topology.inputs(), vec![1], topology.outputs()).into();
                return (found.clone(), vec![0.0; found.weight_count()]);
            }
            _ => {}
        }
        (topology, weights)
    }
}

/// Settings that are read strictly.
#[derive(Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Strict {
    caution: f64,
}

/// Settings in which a misspelt field goes unnoticed.
#[derive(Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default)]
struct Lax {
    caution: f64,
}

/// Settings of which a field is not read again.
#[derive(Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
struct Forgetful {
    #[serde(skip_deserializing)]
    caution: f64,
}

/// A setting without a name.
#[derive(Clone, Default, PartialEq, Serialize, Deserialize)]
struct Caution(f64);

#[test]
fn broken_strategies_are_caught() {
    use conformance::*;

    fn found<const FLAW: u8>() -> Result<(), (Promise, String)> {
        found_with::<Strict, FLAW>(Strict { caution: 0.5 })
    }
    fn found_with<T: NetSettings, const FLAW: u8>(settings: T) -> Result<(), (Promise, String)> {
        let checked = check_net_strategy::<Flawed<T, FLAW>>(&settings, &Default::default());
        checked.map_err(|violation| (violation.promise, violation.found))
    }

    assert_eq!(found::<NONE>(), Ok(()));
    assert_eq!(found_with::<(), NONE>(()), Ok(()));
    let cases = [
        (NAME, "NAME is \"flawed\", name \"climbing\"", found::<ANOTHER_NAME>()),
        (SETTINGS, "read with a field named no-such-setting", found_with::<_, NONE>(Lax { caution: 0.5 })),
        (SETTINGS, "is not read", found_with::<_, NONE>(Forgetful { caution: 0.5 })),
        (SETTINGS, "they are written as 0.5", found_with::<_, NONE>(Caution(0.5))),
        (SETTINGS, "`settings` returns others", found::<DEFAULT_SETTINGS>()),
        (BUILDS, "it does not fit", found::<FITS_NOTHING>()),
        (BUILDS, "hidden = 4", found::<REFUSES_HIDDEN_NEURONS>()),
        (NETS, "the genome expresses", found::<HALVES_EXPRESSED>()),
        (NETS, "weights", found::<LOSES_A_WEIGHT>()),
        (TOPOLOGY, "built for", found::<FINDS_A_TOPOLOGY>()),
        (GENOME, "given were", found::<NEGATES>()),
        (GENOME, "there is one of 7 weights in place of 8", found::<GENOME_OF_FEWER>()),
        (BEGINS, "it begins with 7 weights in place of 8", found::<BEGINS_WITH_FEWER>()),
        (BEGINS, "`settings` returns others", found::<BEGINS_WITH_DEFAULTS>()),
        (TRANSFERS, "after 0 generations: ", found::<TRANSFERS_TO_DEFAULTS>()),
        (TRANSFERS, "on purpose", found::<PANICS_IN_TRANSFER>()),
    ];
    for (promise, says, found) in &cases {
        let (broken, text) = found.as_ref().expect_err(says);
        assert_eq!(broken, promise, "{says}: {text}");
        assert!(text.contains(says), "{says}: {text}");
    }
    for promise in PROMISES {
        assert!(cases.iter().any(|(broken, ..)| broken == promise), "no case breaks {promise:?}");
    }
}
