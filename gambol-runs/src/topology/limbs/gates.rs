//! Two nets in one, of which each has the body for a while: from a press on the jump clock's turn is the jump's, all else the stride's.
//!
//! What a body does while it strides is no good while it jumps, and what is changed for the jump must not change the stride. So
//! with a jump clock each limb has hidden neurons for the stride and others for the jump, and two neurons of fixed weights
//! silence those whose turn it is not: they add so much to their sums that they put out 1 whatever they hear, and what that
//! makes in a joint they take away again.

use crate::config::ControllerSettings;
use creatures::{Senses, Source};
use ne_net::{Activation, GraphNeuron, SharedWeight};

/// The neurons that say whose turn it is: 1 while it is, else 0.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gates {
    /// Of the jump.
    pub(super) jumping: usize,
    /// Of the stride.
    pub(super) striding: usize,
}

/// What is added to the sum of a neuron that is to be silent: more than any sum it could have.
pub(super) const SILENCE: f32 = 1000.0;

/// The sum of a gate before the press: a logistic neuron puts out 2·10⁻⁹.
const CLOSED: f32 = 20.0;

/// Where the swell of the jump clock, which goes from 0 to 1 and back, opens the gate.
const OPENS: f32 = 0.005;

impl Gates {
    /// The gates of a controller with a jump clock, of several the longest; their neurons are added to those of the net, which
    /// has none yet.
    pub(super) fn add(
        senses: &Senses,
        controller: &ControllerSettings,
        neurons: &mut Vec<GraphNeuron>,
        weights: &mut Vec<SharedWeight>,
    ) -> Option<Self> {
        let period = |input: usize| match senses.probes()[input].source {
            Source::JumpSwell { period } => Some(period),
            _ => None,
        };
        let swells = (0..senses.len()).filter_map(|input| Some((input, period(input)?)));
        let (swell, _) = swells.max_by(|one, other| one.1.total_cmp(&other.1))?;
        if controller.hidden.iter().sum::<usize>() == 0 || !is_silenced(controller.hidden_activation) {
            return None;
        }
        let opening = CLOSED / (OPENS * senses.probes()[swell].factor);
        let mut gate = |sign: f32| {
            neurons.push(GraphNeuron { activation: Activation::Logistic, bias: true, sources: vec![swell] });
            weights.extend([SharedWeight::fixed(-sign * CLOSED), SharedWeight::fixed(sign * opening)]);
            senses.len() + neurons.len() - 1
        };
        Some(Self { jumping: gate(1.0), striding: gate(-1.0) })
    }
}

/// Whether a neuron puts out 1 where its sum is large.
fn is_silenced(activation: Activation) -> bool {
    activation.apply(SILENCE) == 1.0
}
