//! What the default preset adds to a bare search for a movement: reward shaping, a controller and senses.
//!
//! Each piece is a setting of the run like any other, so it can be changed or left out one by one; what each is worth is
//! measured in `docs/ablation.md`. [`DefaultsCatalogue::add`] registers what is known of a movement, of Gambol's own and
//! of yours alike; a movement without an entry gets a controller, and no terms.

mod apply;
mod jumping;
mod playing;
mod running;
mod standing;
mod swimming;
#[cfg(test)]
mod tests;
mod walking;

pub(crate) use apply::follow_clock;
pub use apply::{apply, steps};

use crate::config::{LimbPhases, StageSettings};
use envs_rapier::Variation;
use serde_json::{Map, Value};
use std::{collections::BTreeMap, fmt, sync::Arc};
use tasks::{Commands, TermSpec};

/// What is known of a body before it moves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BodyFacts {
    /// Legs that carry it as it starts; 0 for one that crawls, or lies on its back.
    pub legs: usize,
    /// Legs that it has, whatever it starts on.
    pub limbs: usize,
    /// Motors of the leg that has the fewest; 0 without legs.
    pub joints: usize,
    /// Height of the torso's centre in the start pose, m.
    pub height: f32,
    /// The period of the clock that its file asks for, s.
    pub clock: Option<f32>,
}

impl BodyFacts {
    /// The time of a stride, s, that takes so many seconds where the torso is carried at 0.8 m: legs swing like pendulums, and
    /// their time goes with the root of the height. A round number, since it stands in files.
    pub fn pendulum(&self, seconds: f32) -> f32 {
        let period = seconds * libm::sqrtf(self.height / 0.8).clamp(0.7, 1.4);
        libm::roundf(100.0 * period) / 100.0
    }
}

/// What the default preset sets for a movement and a body.
#[derive(Clone, Debug, PartialEq)]
pub struct MovementDefaults {
    /// Steps of the champion's episode; `None`: the movement's own number.
    pub steps: Option<u32>,
    /// Steps of an episode of training; `None`: as many.
    pub training_steps: Option<u32>,
    /// Terms added to the fitness.
    pub terms: Vec<TermSpec>,
    /// How limbs share a net; `None`: one net moves all joints.
    pub modular: Option<LimbPhases>,
    /// Hidden neurons of a limb, or of the one net.
    pub hidden: usize,
    /// Gain of the motors' angle law, 1/s.
    pub gain: f32,
    /// Period of the clock that the net senses, unless the creature's file has one, s.
    pub period: f32,
    /// Whether that clock begins anew at every landing.
    pub from_landing: bool,
    /// What the body is told to do, which it then hears, and strides by; `None`: nothing.
    pub commands: Option<Commands>,
    /// Whether the body feels how it stands: contacts of its feet, velocity and height of its torso.
    pub stands: bool,
    /// Trials of an evaluation in training; `None`: as many as any movement has.
    pub trials: Option<u32>,
    /// The stages in which it is learned; empty: it is learned in one.
    pub stages: Vec<StageSettings>,
    /// A run ends after so many steps, in place of the preset's generations; `None`: as the preset has it.
    pub most_steps: Option<u64>,
    /// In place of the preset's variation between trials.
    pub variation: Option<Variation>,
    /// In place of the strategy's own settings of these names, where it has them.
    pub strategy: Map<String, Value>,
}

impl MovementDefaults {
    /// What there is for a movement of which nothing is known: a controller, and no terms.
    pub fn unknown(body: &BodyFacts) -> Self {
        let walks = body.legs > 0;
        Self {
            steps: None,
            training_steps: None,
            terms: Vec::new(),
            modular: Some(LimbPhases::Alternating),
            hidden: 4,
            gain: if walks { 10.0 } else { 20.0 },
            period: if walks { body.pendulum(0.5) } else { 0.5 },
            from_landing: false,
            commands: None,
            stands: walks,
            trials: None,
            stages: Vec::new(),
            most_steps: None,
            variation: None,
            strategy: Map::new(),
        }
    }
}

type Make = Arc<dyn Fn(&BodyFacts) -> MovementDefaults + Send + Sync>;

/// What the default preset adds for which movement. The default has what there is for the built-in ones.
#[derive(Clone)]
pub struct DefaultsCatalogue {
    makers: BTreeMap<String, Make>,
}

impl Default for DefaultsCatalogue {
    fn default() -> Self {
        let mut catalogue = Self { makers: BTreeMap::new() };
        for like_a_run in ["running", "climbing", "carrying"] {
            catalogue.add(like_a_run, running::running);
        }
        catalogue
            .add("backwards", running::backwards)
            .add("cruising", running::cruising)
            .add("walking", walking::walking)
            .add("jumping", jumping::jumping)
            .add("long-jump", jumping::long_jump)
            .add("hopping", jumping::hopping)
            .add("standing", standing::standing)
            .add("getting-up", standing::getting_up)
            .add("playing", playing::playing)
            .add("swimming", swimming::swimming);
        catalogue
    }
}

impl DefaultsCatalogue {
    /// Says what the default preset adds for the movement of this name, in place of what there was.
    pub fn add(
        &mut self,
        movement: &str,
        make: impl Fn(&BodyFacts) -> MovementDefaults + Send + Sync + 'static,
    ) -> &mut Self {
        self.makers.insert(movement.into(), Arc::new(make));
        self
    }

    /// The movements of which something is known.
    pub fn movements(&self) -> impl Iterator<Item = &str> {
        self.makers.keys().map(String::as_str)
    }

    /// What it adds for a movement and a body.
    pub fn of(&self, movement: &str, body: &BodyFacts) -> MovementDefaults {
        self.makers.get(movement).map_or_else(|| MovementDefaults::unknown(body), |make| make(body))
    }
}

impl fmt::Debug for DefaultsCatalogue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(self.makers.keys()).finish()
    }
}

/// Terms by name and weight.
fn terms(named: &[(&str, f64)]) -> Vec<TermSpec> {
    named.iter().map(|&(term, weight)| TermSpec::new(term, weight)).collect()
}

/// A term with one more of its settings.
fn with(mut term: TermSpec, field: &str, value: impl Into<serde_json::Value>) -> TermSpec {
    term.settings.insert(field.into(), value.into());
    term
}
