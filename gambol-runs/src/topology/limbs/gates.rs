//! Gates: after a press, the hidden neurons of the jump drive the joints for one turn of the longest jump clock, those of the
//! stride the rest of the time. A jump has three phases, each with hidden neurons of its own.
//!
//! A search for the jump must not change the stride, and a stride in progress must not disturb the jump. And what is right in
//! one phase is wrong in the next: a leg in front goes farther to the front in a crouch, and back in a push-off. One set of hidden neurons
//! that hears the clock has to learn such products; with phases, told by the gates alone, each set may answer its senses simply, as the states of a
//! hand-made controller do (Yin, Loken & van de Panne, *SIMBICON: Simple Biped Locomotion Control*, SIGGRAPH 2007).
//!
//! So there are neurons of fixed weights, the gates. A gate adds [`SILENCE`] to the sums of the hidden neurons it silences, which
//! then put out 1; each joint subtracts that 1 again, times their weights.
//!
//! | phase | from the press on |
//! |---|---|
//! | crouch | half a turn of the shortest jump clock |
//! | push-off | the rest of that turn |
//! | landing | the rest of the turn of the longest; none if there is one clock |

use super::modules::Phase;
use crate::config::ControllerSettings;
use creatures::{Senses, Source};
use ne_net::{Activation, GraphNeuron, SharedWeight};

/// The neurons that say whose turn it is: 1 while it is, else 0.
#[derive(Clone, Debug)]
pub(super) struct Gates {
    /// Of the jump.
    pub(super) jumping: usize,
    /// The phases of the jump, in order, each with the gate that is open while it is not its turn.
    pub(super) phases: Vec<(Phase, usize)>,
}

/// What is added to the sum of a neuron that is to be silent: more than any sum it could have.
pub(super) const SILENCE: f32 = 1000.0;

/// The sum of a gate that is open or closed: a logistic neuron puts out 2·10⁻⁹ where it is closed.
const CLOSED: f32 = 20.0;

/// Where the swell of the longest jump clock, which goes from 0 to 1 and back, ends the stride.
const OPENS: f32 = 0.005;

/// Where the swell of the shortest one is when its turn ends; also when it has hardly begun, and the stride not ended.
const ENDS: f32 = 0.015;

/// In the first half of a turn, but not at rest, sine + 0.2 × swell is more than this: for 0.31 s of 0.6.
const CROUCHES: f32 = 0.1;
const SWELL_OF_CROUCH: f32 = 0.2;

/// How far from where it opens a gate is wide open.
const SHARP: f32 = 0.05;
const SHARP_ENDS: f32 = 0.005;

impl Gates {
    /// The gates of a controller with jump clocks; their neurons are added to those of the net, which has none yet. `None`: there is
    /// no jump clock, or nothing that could be silenced.
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
        let swells = || (0..senses.len()).filter_map(|input| Some((input, period(input)?)));
        let (long, longest) = swells().max_by(|one, other| one.1.total_cmp(&other.1))?;
        let (short, shortest) = swells().min_by(|one, other| one.1.total_cmp(&other.1))?;
        if controller.hidden.iter().sum::<usize>() == 0 || !is_silenced(controller.hidden_activation) {
            return None;
        }
        let mut gate = |threshold: f32, sources: &[(usize, f32)]| {
            let heard = sources.iter().map(|&(source, _)| source).collect();
            neurons.push(GraphNeuron { activation: Activation::Logistic, bias: true, sources: heard });
            weights.push(SharedWeight::fixed(threshold));
            weights.extend(sources.iter().map(|&(_, weight)| SharedWeight::fixed(weight)));
            senses.len() + neurons.len() - 1
        };
        let weigh = |input: usize, weight: f32| (input, weight / senses.probes()[input].factor);
        let steep = CLOSED / OPENS;
        let jumping = gate(-CLOSED, &[weigh(long, steep)]);
        let striding = gate(CLOSED, &[weigh(long, -steep)]);
        // The sine comes before the swell.
        let steep = CLOSED / SHARP;
        let begins = gate(-steep * CROUCHES, &[weigh(short - 1, steep), weigh(short, steep * SWELL_OF_CROUCH)]);
        // Those that hear the clocks stand side by side: players compute them at once.
        let steep = CLOSED / SHARP_ENDS;
        let ends = (longest > shortest).then(|| gate(steep * ENDS, &[weigh(short, -steep)]));
        // Of gates, which are 0 or 1, one that is open if any of these is, and one that is open if this one is closed or that one open.
        let any = |gates: &[usize]| gates.iter().map(|&gate| (gate, 2.0 * CLOSED)).collect::<Vec<_>>();
        let unless = |closed: usize, open: usize| [(closed, -2.0 * CLOSED), (open, 2.0 * CLOSED)];
        let not_crouching = gate(CLOSED, &unless(begins, striding));
        let Some(ends) = ends else {
            let not_pushing = gate(-CLOSED, &any(&[striding, begins]));
            return Some(Self { jumping, phases: vec![(Phase::Crouch, not_crouching), (Phase::PushOff, not_pushing)] });
        };
        let not_pushing = gate(-CLOSED, &any(&[striding, begins, ends]));
        let not_landing = gate(CLOSED, &unless(ends, striding));
        Some(Self {
            jumping,
            phases: vec![(Phase::Crouch, not_crouching), (Phase::PushOff, not_pushing), (Phase::Landing, not_landing)],
        })
    }
}

/// Whether a neuron puts out 1 where its sum is large.
fn is_silenced(activation: Activation) -> bool {
    activation.apply(SILENCE) == 1.0
}
