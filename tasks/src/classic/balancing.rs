use super::{Dynamics, OutputRange, State, number};
use ne_core::{Evaluation, Failure, Phenotype, SettingError};
use std::iter;

/// The decisions after which a task is solved: half an hour and three minutes.
pub(super) const SOLVED: u32 = 100_000;

/// The measurement that counts the decisions held.
const HELD: &str = "held";

/// The cart must stay within this distance of the middle of the track, m.
const TRACK: f64 = 2.4;

/// The force of a full output, N.
const FULL_FORCE: f64 = 10.0;

/// What inputs are divided by: position (the length of the track, m), velocity (m/s), angle (rad), angular velocity
/// (rad/s). The numbers of the programs that were published with the papers.
const SCALES: [f64; 4] = [4.8, 2.0, 0.52, 2.0];

/// The constant input. The number of those programs, too.
const BIAS: f64 = 0.5;

/// A controller at work on a cart with poles: what it sees, what its output does and when it has failed.
#[derive(Clone, Debug)]
pub(super) struct Balancing<const N: usize> {
    pub(super) dynamics: Dynamics<N>,
    /// A pole must not lean further, rad.
    pub(super) failure_angle: f64,
    /// Whether the controller sees velocities.
    pub(super) velocities: bool,
    /// Whether the last input is constant.
    pub(super) bias_input: bool,
    /// The range of the output, from full force to the left to full force to the right.
    pub(super) output_range: OutputRange,
}

/// How long the poles were balanced.
#[derive(Debug)]
pub(super) struct Balanced {
    /// Decisions after which cart and poles were still within their limits.
    pub(super) held: u32,
    /// Decisions made: one more than were held, unless all were or an output was no number.
    pub(super) decisions: u32,
    /// The output that is no number and ended it, if one did.
    pub(super) failure: Option<Failure>,
}

impl<const N: usize> Balancing<N> {
    pub(super) fn inputs(&self) -> usize {
        (1 + N) * if self.velocities { 2 } else { 1 } + usize::from(self.bias_input)
    }

    /// Balances from `start` until it fails, for at most `decisions` decisions, and shows `watch` the state after each
    /// one that was held. The phenotype has the right shape.
    pub(super) fn balance(
        &self,
        phenotype: &mut dyn Phenotype,
        start: State<N>,
        decisions: u32,
        mut watch: impl FnMut(&State<N>),
    ) -> Balanced {
        phenotype.reset();
        let mut state = start;
        let mut inputs = vec![0.0; self.inputs()];
        for held in 0..decisions {
            let mut output = [0.0];
            self.sense(&state, &mut inputs);
            phenotype.activate(&inputs, &mut output);
            let output = match number(output) {
                Ok(output) => output,
                Err(failure) => return Balanced { held, decisions: held, failure: Some(failure) },
            };
            let force = FULL_FORCE * self.output_range.to_minus_one_to_one(output);
            state = self.dynamics.decision(&state, force);
            if !self.stands(&state) {
                return Balanced { held, decisions: held + 1, failure: None };
            }
            watch(&state);
        }
        Balanced { held: decisions, decisions, failure: None }
    }

    fn sense(&self, state: &State<N>, inputs: &mut [f32]) {
        let cart = (state.position, state.velocity, SCALES[0], SCALES[1]);
        let poles = (0..N).map(|index| (state.angles[index], state.angular_velocities[index], SCALES[2], SCALES[3]));
        let mut inputs = inputs.iter_mut();
        let mut tell = |value: f64| {
            if let Some(input) = inputs.next() {
                *input = value as f32;
            }
        };
        for (position, velocity, position_scale, velocity_scale) in iter::once(cart).chain(poles) {
            tell(position / position_scale);
            if self.velocities {
                tell(velocity / velocity_scale);
            }
        }
        if self.bias_input {
            tell(BIAS);
        }
    }

    /// Whether cart and poles are within their limits; NaN is not.
    fn stands(&self, state: &State<N>) -> bool {
        state.position.abs() <= TRACK && state.angles.iter().all(|angle| angle.abs() <= self.failure_angle)
    }
}

impl Balanced {
    /// The evaluation with this fitness, unless the balancing failed.
    pub(super) fn evaluation(self, fitness: f64) -> Evaluation {
        let mut evaluation = match self.failure {
            Some(failure) => return Evaluation::failed(failure).with_steps(self.decisions.into()),
            None => Evaluation::new(fitness).with_steps(self.decisions.into()),
        };
        evaluation.measurements.insert(HELD, self.held.into());
        evaluation
    }
}

/// Whether an evaluation succeeded and tells of so many decisions held.
pub(super) fn has_held(evaluation: &Evaluation, decisions: u32) -> bool {
    evaluation.outcome.is_ok() && evaluation.measurements.get(HELD) == Some(decisions.into())
}

/// Checks a start angle against the failure angle, both in degrees. Upright is refused: doing nothing would hold it.
pub(super) fn check_start_angle(start_angle: f64, failure_angle: f64) -> Result<(), SettingError> {
    SettingError::check_range("start_angle", start_angle, 0.1, failure_angle)
}
