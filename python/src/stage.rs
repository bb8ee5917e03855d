//! Environments that are stepped together, whatever steps them.

use crate::episodes::Episodes;
use envs_core::Settled;
use envs_lanes::{DrivenLanes, DrivenStep, LaneEngine, LaneEnvironment};
use envs_rapier::RapierEnvironment;
use ne_core::{Failure, Seed};
use tasks::{Environment, Episode, Movement, Snapshot};

/// A few environments, each in an episode of its own.
pub(crate) trait Stage: Send + Sync {
    /// Begins the episode of this seed.
    ///
    /// # Errors
    /// If the creature cannot come to rest in the world of this seed.
    fn begin(&mut self, place: usize, seed: Seed) -> Result<(), Failure>;

    /// What the motors of a creature are to do.
    fn act(&mut self, place: usize, actions: &[f32]);

    /// A step of all whose episode is under way.
    fn step(&mut self, report: &mut dyn FnMut(usize, DrivenStep));

    /// All creatures sense where they are.
    fn sense(&mut self);

    /// What a creature has last sensed.
    fn read(&self, place: usize, inputs: &mut [f32]);

    /// What the movement is worth so far.
    fn value(&self, place: usize) -> f64;

    /// Where the parts of a creature are.
    fn snapshot(&self, place: usize) -> &Snapshot;
}

/// An empty stage for these episodes.
pub(crate) fn stage(episodes: &Episodes) -> Box<dyn Stage> {
    match episodes {
        Episodes::Lanes(episode) => {
            let environment = episode.environment().clone();
            let alike = environment.variation().is_none() && environment.commands().is_none();
            Box::new(Lanes { driven: DrivenLanes::new(episode), environment, alike, start: None })
        }
        Episodes::Rapier(episode) => Box::new(Alone::new(episode)),
    }
}

/// Sixteen in lanes.
struct Lanes {
    driven: DrivenLanes,
    environment: LaneEnvironment,
    /// Whether all episodes begin alike.
    alike: bool,
    /// Then this is how.
    start: Option<Settled<LaneEngine>>,
}

impl Stage for Lanes {
    fn begin(&mut self, place: usize, seed: Seed) -> Result<(), Failure> {
        if !self.alike {
            self.driven.begin(place, &self.environment.settled(seed)?);
            return Ok(());
        }
        let start = match &mut self.start {
            Some(start) => start,
            none => none.insert(self.environment.settled(seed)?),
        };
        self.driven.begin(place, start);
        Ok(())
    }

    fn act(&mut self, place: usize, actions: &[f32]) {
        self.driven.act(place, actions);
    }

    fn step(&mut self, report: &mut dyn FnMut(usize, DrivenStep)) {
        self.driven.step(report);
    }

    fn sense(&mut self) {
        self.driven.sense();
    }

    fn read(&self, place: usize, inputs: &mut [f32]) {
        self.driven.read(place, inputs);
    }

    fn value(&self, place: usize) -> f64 {
        self.driven.value(place)
    }

    fn snapshot(&self, place: usize) -> &Snapshot {
        self.driven.snapshot(place)
    }
}

/// One in rapier: step for step what [`Episode`] does.
struct Alone {
    environment: RapierEnvironment,
    movement: Box<dyn Movement>,
    steps: u32,
    done: u32,
    value: f64,
    plays: bool,
    /// An action of the next step that is no finite number.
    unusable: Option<usize>,
}

impl Alone {
    fn new(episode: &Episode<RapierEnvironment>) -> Self {
        Self {
            environment: episode.environment().clone(),
            movement: episode.movement().boxed_clone(),
            steps: episode.steps(),
            done: 0,
            value: 0.0,
            plays: false,
            unusable: None,
        }
    }

    fn observe(&mut self) -> DrivenStep {
        if let Some(index) = self.unusable.take() {
            return DrivenStep::failed(Failure::NonFinite { what: format!("output {index}") });
        }
        if let Err(failure) = self.environment.step() {
            return DrivenStep::failed(failure);
        }
        self.done += 1;
        let snapshot = self.environment.snapshot();
        DrivenStep::judged(&mut *self.movement, snapshot, &mut self.value, self.done >= self.steps)
    }
}

impl Stage for Alone {
    fn begin(&mut self, _: usize, seed: Seed) -> Result<(), Failure> {
        self.environment.reset(seed)?;
        if let Some(body) = self.environment.body() {
            self.movement.bind(body);
        }
        self.movement.begin(self.environment.snapshot());
        (self.done, self.value, self.plays, self.unusable) = (0, 0.0, true, None);
        Ok(())
    }

    fn act(&mut self, _: usize, actions: &[f32]) {
        self.unusable = actions.iter().position(|action| !action.is_finite());
        if self.unusable.is_none() {
            self.environment.act(actions);
        }
    }

    fn step(&mut self, report: &mut dyn FnMut(usize, DrivenStep)) {
        if self.plays {
            let step = self.observe();
            self.plays = step.end.is_none();
            report(0, step);
        }
    }

    fn sense(&mut self) {}

    fn read(&self, _: usize, inputs: &mut [f32]) {
        self.environment.sense(inputs);
    }

    fn value(&self, _: usize) -> f64 {
        self.value
    }

    fn snapshot(&self, _: usize) -> &Snapshot {
        self.environment.snapshot()
    }
}
