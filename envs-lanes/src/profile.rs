//! Timing the parts of a step.

use crate::{
    LANES,
    batch::Batch,
    episode::LaneEpisode,
    instructions::Instructions,
    stopwatch::{Laps, Part, Profile},
};
use ne_core::{Failure, Seed};
use ne_net::Network;
use tasks::Snapshot;

/// Of so many rounds the fastest counts, for each part: the operating system interrupts the others.
const ROUNDS: u32 = 20;

impl LaneEpisode {
    /// Times the parts of `steps` steps of a full batch in which every creature has this controller. The clock is read
    /// between the parts, which slows them down a little; what reading takes is subtracted.
    ///
    /// # Errors
    /// If the creature cannot come to rest.
    pub fn profile(&self, network: &Network, steps: u32, instructions: Instructions) -> Result<Profile, Failure> {
        let settled = self.environment().settled(Seed::of_run(1))?;
        let topology = network.topology();
        let mut batch: Batch<LANES> = Batch::new(self.environment(), &settled, Some(&topology), instructions);
        for lane in 0..LANES {
            batch.load(lane, network);
            batch.begin(lane, &settled);
        }
        let mut snapshots: Vec<Snapshot> = vec![settled.snapshot.clone(); LANES];
        let mut profile = Profile { seconds: [f64::INFINITY; Part::ALL.len()] };
        for _ in 0..ROUNDS {
            let mut laps = Laps::start();
            let steps = steps.div_ceil(ROUNDS);
            for _ in 0..steps {
                batch.sense();
                laps.lap(Part::SenseAndThink);
                batch.step_timed(Some(&mut laps));
                for (lane, snapshot) in snapshots.iter_mut().enumerate() {
                    batch.show(lane, snapshot)?;
                }
                laps.lap(Part::Measure);
            }
            for (best, seconds) in profile.seconds.iter_mut().zip(laps.profile.seconds) {
                *best = best.min(seconds / (f64::from(steps) * LANES as f64));
            }
        }
        Ok(profile)
    }
}
