//! The environments of a stage, with their seeds, their ends and their new beginnings.

use crate::{layout::Layout, stage::Stage};
use envs_lanes::DrivenEnd;
use ne_core::{Failure, Seed};
use std::sync::Arc;
use tasks::Snapshot;

/// When an environment whose episode has ended begins the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Autoreset {
    /// In the step after, whose action is ignored.
    NextStep,
    /// In the same step.
    SameStep,
    /// When it is told to.
    Disabled,
}

/// So many worlds in a row in which a creature cannot come to rest mean that there is none in which it can.
const MOST_TRIES: u32 = 100;

/// Environments that are stepped together.
pub(crate) struct Group {
    stage: Box<dyn Stage>,
    places: Vec<Place>,
    /// The number of its first environment.
    first: usize,
    /// What is shown of what is sensed; `None`: all of it, as it is.
    layout: Option<Arc<Layout>>,
    /// What one creature senses.
    senses: Vec<f32>,
}

/// An environment.
#[derive(Clone, Copy, Default)]
struct Place {
    seed: u64,
    /// The episodes of a seed are its trials.
    episode: u32,
    over: bool,
}

/// What a step writes: rows of the arrays, one for each environment of a group.
pub(crate) struct Rows<'a> {
    pub(crate) observations: &'a mut [f32],
    /// Where observations go that another episode's take the place of.
    pub(crate) last_observations: &'a mut [f32],
    pub(crate) rewards: &'a mut [f64],
    pub(crate) terminated: &'a mut [bool],
    pub(crate) truncated: &'a mut [bool],
}

/// An episode that has ended.
pub(crate) struct Finished {
    pub(crate) environment: usize,
    /// The fitness, or why there is none.
    pub(crate) outcome: Result<f64, Failure>,
}

impl Group {
    /// `inputs`: how many numbers a creature senses.
    pub(crate) fn new(
        stage: Box<dyn Stage>,
        first: usize,
        count: usize,
        layout: Option<Arc<Layout>>,
        inputs: usize,
    ) -> Self {
        let place = Place { over: true, ..Place::default() };
        Self { stage, places: vec![place; count], first, layout, senses: vec![0.0; inputs] }
    }

    /// How many environments it has.
    pub(crate) fn len(&self) -> usize {
        self.places.len()
    }

    /// Begins an episode in an environment: the first of a seed, or the next of the one it has.
    pub(crate) fn reset(&mut self, place: usize, seed: Option<u64>) -> Result<(), Failure> {
        match seed {
            Some(seed) => {
                self.places[place] = Place { seed, episode: 0, over: true };
                self.begin(place)
            }
            None => self.begin_next(place),
        }
    }

    fn begin_next(&mut self, place: usize) -> Result<(), Failure> {
        self.places[place].episode = self.places[place].episode.wrapping_add(1);
        self.begin(place)
    }

    fn begin(&mut self, index: usize) -> Result<(), Failure> {
        let place = &mut self.places[index];
        let mut tries = 1;
        while let Err(failure) = self.stage.begin(index, place.world()) {
            if tries == MOST_TRIES {
                return Err(failure);
            }
            tries += 1;
            place.episode = place.episode.wrapping_add(1);
        }
        place.over = false;
        Ok(())
    }

    /// The environments whose episode has ended.
    pub(crate) fn over(&self) -> impl Iterator<Item = usize> + '_ {
        self.places.iter().enumerate().filter(|(_, place)| place.over).map(|(index, _)| self.first + index)
    }

    /// What all sense now.
    pub(crate) fn observe(&mut self, observations: &mut [f32]) {
        self.stage.sense();
        let shown = observations.len() / self.places.len();
        for (place, row) in observations.chunks_exact_mut(shown).enumerate() {
            match &self.layout {
                None => self.stage.read(place, row),
                Some(layout) => {
                    self.stage.read(place, &mut self.senses);
                    layout.arrange(&self.senses, row);
                }
            }
            // After a failure.
            row.iter_mut().filter(|input| !input.is_finite()).for_each(|input| *input = 0.0);
        }
    }

    /// A step of all; `actions` has a row for each.
    pub(crate) fn step(
        &mut self,
        actions: &[f32],
        rows: &mut Rows<'_>,
        autoreset: Autoreset,
    ) -> Result<Vec<Finished>, Failure> {
        let Self { stage, places, first, .. } = self;
        for (place, actions) in actions.chunks_exact(actions.len() / places.len()).enumerate() {
            stage.act(place, actions);
        }
        rows.rewards.fill(0.0);
        rows.terminated.fill(false);
        rows.truncated.fill(false);
        let mut finished: Vec<Finished> = Vec::new();
        stage.step(&mut |place, step| {
            rows.rewards[place] = step.reward;
            let Some(end) = step.end else { return };
            rows.truncated[place] = end == DrivenEnd::OutOfTime;
            rows.terminated[place] = end != DrivenEnd::OutOfTime;
            let outcome = match end {
                DrivenEnd::Failed(failure) => Err(failure),
                DrivenEnd::OutOfTime | DrivenEnd::Ended => Ok(0.0),
            };
            finished.push(Finished { environment: *first + place, outcome });
        });
        for Finished { environment, outcome } in &mut finished {
            if let Ok(fitness) = outcome {
                *fitness = stage.value(*environment - *first);
            }
        }
        if autoreset == Autoreset::NextStep {
            for place in (0..self.places.len()).filter(|&place| self.places[place].over).collect::<Vec<_>>() {
                self.begin_next(place)?;
            }
        }
        finished.iter().for_each(|it| self.places[it.environment - self.first].over = true);
        if autoreset == Autoreset::SameStep && !finished.is_empty() {
            self.observe(rows.last_observations);
            for it in &finished {
                self.begin_next(it.environment - self.first)?;
            }
        }
        self.observe(rows.observations);
        Ok(finished)
    }

    /// What the movement is worth so far in an environment.
    pub(crate) fn value(&self, place: usize) -> f64 {
        self.stage.value(place)
    }

    /// The parts of a creature: x and y of the centre, m, and the angle, rad.
    pub(crate) fn parts(&self, place: usize) -> impl Iterator<Item = [f32; 3]> + '_ {
        self.snapshot(place).parts.iter().map(|part| [part.x, part.y, part.angle()])
    }

    /// Where a creature is; without parts before the first reset.
    pub(crate) fn snapshot(&self, place: usize) -> &Snapshot {
        self.stage.snapshot(place)
    }

    /// The seed of the world a creature is in.
    pub(crate) fn seed(&self, place: usize) -> Seed {
        self.places[place].world()
    }
}

impl Place {
    /// The seed of the present episode's world.
    fn world(&self) -> Seed {
        Seed::of_run(self.seed).trial(self.episode)
    }
}
