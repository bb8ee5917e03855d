use crate::{
    LANES,
    batch::Batch,
    controllers::Controllers,
    episode::LaneEpisode,
    workload::{Job, Workload},
};
use ne_core::{Failure, Phenotype};
use ne_net::Network;
use std::{
    ops::Range,
    sync::{PoisonError, atomic::Ordering::Relaxed},
};
use tasks::{Movement, Outcome, Snapshot, Trial, Verdict};

/// The lanes of a thread.
pub(crate) struct LanePlayer<'a, 'b> {
    episode: &'a LaneEpisode,
    workload: &'a Workload<'a, 'b>,
    batch: Batch<LANES>,
    slots: Vec<Slot<'b>>,
    done: Vec<(usize, u32, Trial)>,
}

/// A lane.
struct Slot<'b> {
    /// What is played in it.
    playing: Option<Playing<'b>>,
    /// For each trial of the workload one that knows its body, once it was played here.
    movements: Vec<Option<Box<dyn Movement>>>,
    snapshot: Snapshot,
}

struct Playing<'b> {
    individual: usize,
    /// The trial under way and those that follow.
    trials: Range<usize>,
    thinking: Thinking<'b>,
}

/// Where a controller thinks.
enum Thinking<'b> {
    InLanes,
    OfItsOwn(Box<Network>),
    Other(&'b mut dyn Phenotype),
}

impl<'a, 'b> LanePlayer<'a, 'b> {
    /// Plays until nothing is left to be handed out and all lanes are empty; the trials it has played.
    pub(crate) fn play(episode: &'a LaneEpisode, workload: &'a Workload<'a, 'b>) -> Vec<(usize, u32, Trial)> {
        let Some(Ok(settled)) = workload.trials.first().map(|&first| &workload.starts[first as usize]) else {
            return Vec::new();
        };
        workload.players.fetch_add(1, Relaxed);
        let batch = Batch::new(episode.environment(), settled, workload.controllers.topology(), episode.instructions());
        let slot =
            || Slot { playing: None, movements: vec![None; workload.trials.len()], snapshot: Snapshot::default() };
        let slots = (0..LANES).map(|_| slot()).collect();
        let mut player = Self { episode, workload, batch, slots, done: Vec::new() };
        for lane in 0..LANES {
            player.slot_next(lane);
        }
        let (mut stepped, mut played) = (0, 0);
        loop {
            let busy = player.slots.iter().filter(|slot| slot.playing.is_some()).count();
            if busy == 0 {
                break;
            }
            stepped += LANES as u64;
            played += busy as u64;
            player.step();
            for lane in 0..LANES {
                if let Some(outcome) = player.judge(lane) {
                    player.end_trial(lane, outcome);
                }
            }
        }
        workload.players.fetch_sub(1, Relaxed);
        workload.stepped.fetch_add(stepped, Relaxed);
        workload.played.fetch_add(played, Relaxed);
        player.done
    }

    fn step(&mut self) {
        let Self { batch, slots, .. } = self;
        batch.think(|lane, inputs, outputs| match &mut slots[lane].playing {
            Some(Playing { thinking: Thinking::OfItsOwn(network), .. }) => network.activate(inputs, outputs),
            Some(Playing { thinking: Thinking::Other(phenotype), .. }) => phenotype.activate(inputs, outputs),
            Some(Playing { thinking: Thinking::InLanes, .. }) | None => {}
        });
        batch.step();
    }

    /// How a lane's trial has ended, if it has.
    fn judge(&mut self, lane: usize) -> Option<Outcome> {
        let (batch, slot) = (&self.batch, &mut self.slots[lane]);
        let movement = slot.movements[slot.playing.as_ref()?.trials.start].as_mut()?;
        let (steps, time_step) = (batch.steps(lane), batch.time_step(lane));
        if let Err(failure) = batch.show(lane, &mut slot.snapshot) {
            return Some(Outcome { steps, time_step, failure: Some(failure) });
        }
        let failure = match movement.observe(&slot.snapshot) {
            Verdict::Fail(reason) => Some(Failure::Other { what: reason.into() }),
            Verdict::GoOn if steps < self.episode.steps() => return None,
            Verdict::GoOn | Verdict::End => None,
        };
        Some(Outcome { steps, time_step, failure })
    }

    /// Counts a trial, and begins the next.
    fn end_trial(&mut self, lane: usize, outcome: Outcome) {
        let workload = self.workload;
        let slot = &mut self.slots[lane];
        let Some(playing) = &mut slot.playing else { return };
        let Some(movement) = &slot.movements[playing.trials.start] else { return };
        let (individual, trial) = (playing.individual, workload.trials[playing.trials.start]);
        let ended = Trial::new(outcome, &**movement);
        playing.trials.start += 1;
        if ended.failed() {
            workload.failed[individual].fetch_min(trial, Relaxed);
            playing.trials.start = playing.trials.end;
        }
        self.done.push((individual, trial, ended));
        if playing.trials.is_empty() {
            self.slot_next(lane);
        } else {
            self.begin_trial(lane);
        }
    }

    fn slot_next(&mut self, lane: usize) {
        let workload = self.workload;
        if let Some(Playing { individual, thinking: Thinking::Other(phenotype), .. }) = self.slots[lane].playing.take()
            && let Controllers::Others(others) = workload.controllers
        {
            *others[individual].lock().unwrap_or_else(PoisonError::into_inner) = Some(phenotype);
        }
        let Some(&Job { individual, ref trials }) = workload.next() else { return };
        let thinking = match workload.controllers {
            Controllers::Nets { nets, .. } if self.batch.thinks() => {
                self.batch.load(lane, &nets[individual]);
                Thinking::InLanes
            }
            Controllers::Nets { nets, .. } => Thinking::OfItsOwn(Box::new(nets[individual].clone().into_owned())),
            Controllers::Others(others) => {
                match others[individual].lock().unwrap_or_else(PoisonError::into_inner).take() {
                    Some(phenotype) => Thinking::Other(phenotype),
                    // Each individual is in one job.
                    None => return,
                }
            }
        };
        self.slots[lane].playing = Some(Playing { individual, trials: trials.clone(), thinking });
        self.begin_trial(lane);
    }

    fn begin_trial(&mut self, lane: usize) {
        let Slot { playing: Some(Playing { trials, thinking, .. }), movements, snapshot } = &mut self.slots[lane]
        else {
            return;
        };
        match thinking {
            Thinking::InLanes => {}
            Thinking::OfItsOwn(network) => network.reset(),
            Thinking::Other(phenotype) => phenotype.reset(),
        }
        let Ok(settled) = &self.workload.starts[self.workload.trials[trials.start] as usize] else { return };
        self.batch.begin(lane, settled);
        snapshot.clone_from(&settled.snapshot);
        let bound = || {
            let mut movement = self.episode.movement.clone();
            movement.bind(&settled.body);
            movement
        };
        movements[trials.start].get_or_insert_with(bound).begin(snapshot);
    }
}
