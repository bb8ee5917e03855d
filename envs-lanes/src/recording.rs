use crate::{LANES, LaneEngine, LaneEnvironment, batch::Batch, instructions::Instructions};
use envs_core::Settled;
use ne_core::{Failure, Phenotype};
use ne_net::Network;
use tasks::{Environment, Outcome, Snapshot};

/// A controller to be played in a world.
#[derive(Clone, Copy)]
pub struct Play<'a> {
    /// The controller.
    pub network: &'a Network,
    /// What it begins with: the creature at rest in its world.
    pub start: &'a Settled<LaneEngine>,
    /// The longest it lasts, in steps.
    pub steps: u32,
}

/// Plays controllers, [`LANES`] of them at once, and shows every moment of each: `observe` is given the index of the play
/// and where its creature is, at the start and after each step, and says whether to go on with that play. Moments of a
/// play come in order; those of different plays take turns.
///
/// The worlds may differ in all that [`LaneEnvironment::settled`] and [`LaneEnvironment::under`] can vary; each must be
/// one of the creature, the senses and the motors of `environment`. Nets of one topology think in lanes; where topologies
/// differ each thinks for itself.
///
/// Tells how each play ended. A controller of another shape fails before it is shown.
pub fn play(
    environment: &LaneEnvironment,
    plays: &[Play<'_>],
    mut observe: impl FnMut(usize, &Snapshot) -> bool,
) -> Vec<Outcome> {
    play_all(environment, plays, &mut observe)
}

/// The same for any observer, so that the lanes are compiled once, here.
fn play_all(environment: &LaneEnvironment, plays: &[Play<'_>], observe: Observer<'_>) -> Vec<Outcome> {
    let failure = |play: &Play<'_>| check_shape(environment, play.network).err();
    let begun = |play: &Play<'_>| Outcome { steps: 0, time_step: play.start.time_step, failure: failure(play) };
    let mut outcomes: Vec<Outcome> = plays.iter().map(begun).collect();
    let mut waiting: Vec<usize> = (0..plays.len()).filter(|&index| outcomes[index].failure.is_none()).collect();
    let topology = waiting.first().map(|&first| plays[first].network.topology());
    let common = topology.filter(|common| waiting.iter().all(|&index| plays[index].network.topology() == *common));
    // Level ground and any other are not stepped together.
    while let Some(&first) = waiting.first() {
        let first = plays[first].start;
        let is_like = |&index: &usize| plays[index].start.engine.is_like(&first.engine);
        let (alike, others): (Vec<usize>, Vec<usize>) = waiting.into_iter().partition(is_like);
        let batch = Batch::new(environment, first, common.as_ref(), Instructions::best());
        let slots = (0..LANES).map(|_| None).collect();
        Recorder { plays, batch, slots, waiting: alike.into_iter() }.play(observe, &mut outcomes);
        waiting = others;
    }
    outcomes
}

fn check_shape(environment: &LaneEnvironment, network: &Network) -> Result<(), Failure> {
    let (inputs, outputs) = (environment.inputs(), environment.outputs());
    let (found_inputs, found_outputs) = (network.inputs(), network.outputs());
    if (found_inputs, found_outputs) == (inputs, outputs) {
        Ok(())
    } else {
        Err(Failure::ShapeMismatch { found_inputs, found_outputs, inputs, outputs })
    }
}

type Observer<'a> = &'a mut dyn FnMut(usize, &Snapshot) -> bool;

/// Plays going on side by side.
struct Recorder<'a> {
    plays: &'a [Play<'a>],
    batch: Batch<LANES>,
    slots: Vec<Option<Slot>>,
    waiting: std::vec::IntoIter<usize>,
}

/// A play in a lane.
struct Slot {
    play: usize,
    /// The controller, if it thinks for itself.
    network: Option<Network>,
    snapshot: Snapshot,
}

impl Recorder<'_> {
    fn play(&mut self, observe: Observer<'_>, outcomes: &mut [Outcome]) {
        for lane in 0..LANES {
            self.slot_next(lane, observe);
        }
        while self.slots.iter().any(Option::is_some) {
            let slots = &mut self.slots;
            self.batch.think(|lane, inputs, outputs| {
                if let Some(network) = slots[lane].as_mut().and_then(|slot| slot.network.as_mut()) {
                    network.activate(inputs, outputs);
                }
            });
            self.batch.step();
            for lane in 0..LANES {
                let Some(slot) = &mut self.slots[lane] else { continue };
                let (steps, time_step) = (self.batch.steps(lane), self.batch.time_step(lane));
                let failure = self.batch.show(lane, &mut slot.snapshot).err();
                let goes_on = failure.is_none() && observe(slot.play, &slot.snapshot);
                if !goes_on || steps >= self.plays[slot.play].steps {
                    outcomes[slot.play] = Outcome { steps, time_step, failure };
                    self.slot_next(lane, observe);
                }
            }
        }
    }

    /// Begins the next play that lasts longer than its start.
    fn slot_next(&mut self, lane: usize, observe: Observer<'_>) {
        self.slots[lane] = None;
        for index in self.waiting.by_ref() {
            let Play { network, start, steps } = self.plays[index];
            if !observe(index, &start.snapshot) || steps == 0 {
                continue;
            }
            self.batch.load(lane, network);
            self.batch.begin(lane, start);
            let network = (!self.batch.thinks()).then(|| {
                let mut network = network.clone();
                network.reset();
                network
            });
            self.slots[lane] = Some(Slot { play: index, network, snapshot: start.snapshot.clone() });
            return;
        }
    }
}
