//! How a champion moves, as a picture for a gallery.

use crate::{library::Library, protocol::Event};
use creatures::Blueprint;
use gambol_exports::Cycle;
use gambol_runs::champion::Champion;

/// Poses a second.
const RATE: f64 = 15.0;

/// The most poses.
const MOST: usize = 60;

impl Library {
    /// One stride of a run's champion, on the spot; without poses if there is no champion, or its gait has no stride.
    pub(crate) fn film(&self, run: &str) -> Event {
        let still = Event::Film { run: run.to_owned(), time_step: 1.0 / RATE, poses: Vec::new() };
        self.try_film(run).unwrap_or(still)
    }

    fn try_film(&self, run: &str) -> Option<Event> {
        let champion = Champion::read(&self.folder(run).ok()?.champion()).ok()?;
        let blueprint = Blueprint::new(champion.creature.clone()).ok()?;
        let cycle = Cycle::of_champion(&champion, self.registry()).ok()?;
        let poses = cycle.resampled(cycle.frames(RATE).clamp(2, MOST), true);
        let time_step = cycle.seconds / poses.len() as f64;
        let parts = poses.iter().flat_map(|pose| pose.snapshot(&blueprint).parts);
        let poses = parts.flat_map(|part| [part.x, part.y, part.angle()]).collect();
        Some(Event::Film { run: run.to_owned(), time_step, poses })
    }
}
