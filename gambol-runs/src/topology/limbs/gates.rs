//! Gates: the hidden neurons of the jump drive the joints for one turn of the jump clock after a press, those of the stride
//! the rest of the time.
//!
//! A search for the jump must not change the stride, and a stride in progress must not disturb the jump. So with a jump clock each
//! limb has hidden neurons for either, and two neurons of fixed weights, the gates. A gate adds [`SILENCE`] to the sums of the
//! hidden neurons it silences, which then put out 1; each joint subtracts that 1 again, times their weights.

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
