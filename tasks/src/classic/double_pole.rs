use super::{
    Benchmark, Dynamics, OutputRange, State,
    balancing::{Balancing, SOLVED, check_start_angle, has_held},
    damping::Damping,
};
use ne_core::{Evaluation, Phenotype, Seed, SettingError, Task};
use serde::{Deserialize, Serialize};

/// A pole must not lean further, degrees.
const FAILURE_ANGLE: f64 = 36.0;

/// Decisions of an evaluation with the fitness "damping".
const DAMPING_DECISIONS: u32 = 1_000;

/// The settings of [`DoublePole`].
///
/// Two presets: [`with_velocities`](Self::with_velocities) and [`without_velocities`](Self::without_velocities). A file
/// states every field, since what a missing one means would depend on the preset.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DoublePoleSettings {
    /// Whether the controller sees velocities. If not, it needs a memory.
    pub velocities: bool,
    /// What an evaluation is worth.
    pub fitness: PoleFitness,
    /// How far the long pole leans at the start, degrees, from 0.1 to 36.
    pub start_angle: f64,
    /// Whether a constant input follows the others, for nets without biases of their own. Without any bias a net of odd
    /// activations is an odd function, and the task far easier.
    pub bias_input: bool,
    /// The range of the controller's output.
    pub output_range: OutputRange,
}

/// What an evaluation of [`DoublePole`] is worth.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum PoleFitness {
    /// The decisions held, of 100,000.
    Survival,
    /// 0.1 · t / 1,000 + 0.9 · f, where t are the decisions held, of 1,000, and f is 0 if t < 100 and else
    /// 0.75 / Σ (abs(x) + abs(ẋ) + abs(θ₁) + abs(θ̇₁)) over the last 100 of them, in m, m/s, rad and rad/s.
    ///
    /// It rewards calm: swinging to and fro holds the poles without a memory, and tells nothing of the velocities.
    ///
    /// Source: Gruau, Whitley & Pyeatt, *A Comparison between Cellular Encoding and Direct Encoding for Genetic Neural
    /// Networks*, Genetic Programming 1996.
    Damping,
}

impl PoleFitness {
    /// The decisions of an evaluation.
    fn decisions(self) -> u32 {
        match self {
            Self::Survival => SOLVED,
            Self::Damping => DAMPING_DECISIONS,
        }
    }
}

impl DoublePoleSettings {
    /// The start angle of Gomez, Schmidhuber & Miikkulainen (2008), degrees; that of the presets.
    pub const START_ANGLE_2008: f64 = 4.0;

    /// The start angle of Stanley & Miikkulainen (2002), degrees, as the paper has it; the program published with it starts at
    /// 0.07 rad, 4°. From 1° the task is another than from 4°.
    pub const START_ANGLE_2002: f64 = 1.0;

    /// The controller sees velocities: fitness survival, start angle 4°, no bias input, outputs from 0 to 1.
    pub fn with_velocities() -> Self {
        Self {
            velocities: true,
            fitness: PoleFitness::Survival,
            start_angle: Self::START_ANGLE_2008,
            bias_input: false,
            output_range: OutputRange::ZeroToOne,
        }
    }

    /// The controller sees no velocities: fitness damping, start angle 4°, no bias input, outputs from 0 to 1.
    pub fn without_velocities() -> Self {
        Self { velocities: false, fitness: PoleFitness::Damping, ..Self::with_velocities() }
    }

    /// Checks the ranges.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        check_start_angle(self.start_angle, FAILURE_ANGLE)
    }
}

/// Two poles, of 1 m and of 0.1 m, side by side on a cart, to be kept upright by pushing the cart.
///
/// | | |
/// |---|---|
/// | inputs | x / 4.8 m, ẋ / 2 m/s; for the long pole and then the short one θ / 0.52 rad, θ̇ / 2 rad/s |
/// | | without velocities only x, θ₁ and θ₂, scaled alike; at the end a constant 0.5 if there is a bias input |
/// | output | the force, −10 to 10 N over the output's range |
/// | failure | the cart is more than 2.4 m from the middle, or a pole leans by more than 36° |
/// | fitness | [`PoleFitness`] |
/// | solved | 100,000 decisions are held from the start angle |
/// | steps | decisions made |
/// | measurements | `held`, decisions held |
///
/// With the fitness survival the evaluation itself shows whether the task is solved. With damping, an individual that
/// holds its 1,000 decisions is a candidate and is tested for 100,000. The papers also ask of a solution without
/// velocities that it be general: see [`generalization`](Self::generalization).
///
/// A decision lasts 0.02 s. The cart starts at rest in the middle, the short pole upright. The seed changes nothing. The
/// equations of motion are at [`Dynamics`].
///
/// Source: as for [`CartPole`](super::CartPole).
#[derive(Clone, Debug)]
pub struct DoublePole {
    settings: DoublePoleSettings,
    pub(super) balancing: Balancing<2>,
}

impl DoublePole {
    /// The task with these settings.
    ///
    /// # Errors
    /// If a setting is out of range.
    pub fn new(settings: DoublePoleSettings) -> Result<Self, SettingError> {
        settings.validate()?;
        let balancing = Balancing {
            dynamics: Dynamics::TWO_POLES,
            failure_angle: FAILURE_ANGLE.to_radians(),
            velocities: settings.velocities,
            bias_input: settings.bias_input,
            output_range: settings.output_range,
        };
        Ok(Self { settings, balancing })
    }

    /// Its settings.
    pub fn settings(&self) -> &DoublePoleSettings {
        &self.settings
    }

    fn start(&self) -> State<2> {
        State::leaning(self.settings.start_angle)
    }
}

impl Task for DoublePole {
    fn inputs(&self) -> usize {
        self.balancing.inputs()
    }

    fn outputs(&self) -> usize {
        1
    }

    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        if let Err(failure) = self.check_shape(phenotype) {
            return Evaluation::failed(failure);
        }
        let decisions = self.settings.fitness.decisions();
        let mut damping = Damping::new();
        let balanced = self.balancing.balance(phenotype, self.start(), decisions, |state| damping.watch(state));
        let held = f64::from(balanced.held);
        let fitness = match self.settings.fitness {
            PoleFitness::Survival => held,
            PoleFitness::Damping => 0.1 * held / f64::from(decisions) + 0.9 * damping.calm(balanced.held),
        };
        balanced.evaluation(fitness)
    }
}

impl Benchmark for DoublePole {
    fn name(&self) -> &str {
        if self.settings.velocities { "double-pole" } else { "double-pole-without-velocities" }
    }

    fn is_candidate(&self, evaluation: &Evaluation) -> bool {
        has_held(evaluation, self.settings.fitness.decisions())
    }

    fn is_solved(&self, phenotype: &mut dyn Phenotype, evaluation: &Evaluation) -> bool {
        if !self.is_candidate(evaluation) || self.check_shape(phenotype).is_err() {
            return false;
        }
        match self.settings.fitness {
            PoleFitness::Survival => true,
            PoleFitness::Damping => self.balancing.balance(phenotype, self.start(), SOLVED, |_| ()).held == SOLVED,
        }
    }
}
