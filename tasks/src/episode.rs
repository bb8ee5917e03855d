use crate::{Environment, Movement, Outcome, Snapshot, Tally, Trial, Trials, Verdict};
use ne_core::{Evaluation, Failure, Phenotype, Seed, SettingError, Task};

/// An environment, a movement and trials: the [`Task`] of a body that learns to move.
#[derive(Clone)]
pub struct Episode<E: Environment> {
    environment: E,
    movement: Box<dyn Movement>,
    steps: u32,
    trials: Trials,
}

/// Watches an episode as it is played: a recorder, a digest, a window.
pub trait Watcher {
    /// A step has passed, or, with step 0, the episode is about to begin.
    fn watch(&mut self, moment: &Moment<'_>);
}

/// What a [`Watcher`] is shown.
pub struct Moment<'a> {
    /// Steps since the clock started; 0 is the start.
    pub step: u32,
    /// Where everything is after that step.
    pub snapshot: &'a Snapshot,
    /// What the controller saw before the step; at step 0 zeros.
    pub inputs: &'a [f32],
    /// What it wanted; at step 0 zeros.
    pub outputs: &'a [f32],
    /// The controller itself.
    pub phenotype: &'a dyn Phenotype,
}

/// Watches nothing, at no cost.
impl Watcher for () {
    fn watch(&mut self, _: &Moment<'_>) {}
}

impl<F: FnMut(&Moment<'_>)> Watcher for F {
    fn watch(&mut self, moment: &Moment<'_>) {
        self(moment);
    }
}

/// How one trial ended.
pub struct Played {
    /// The movement after the last step.
    pub movement: Box<dyn Movement>,
    /// How it ended.
    pub outcome: Outcome,
}

impl<E: Environment> Episode<E> {
    /// Episodes of `steps` steps (at least 1).
    ///
    /// # Errors
    /// If steps or trials are out of range.
    pub fn new(
        environment: E,
        mut movement: Box<dyn Movement>,
        steps: u32,
        trials: Trials,
    ) -> Result<Self, SettingError> {
        SettingError::check_at_least("steps", steps as usize, 1)?;
        trials.validate().map_err(|error| error.within("trials"))?;
        if let Some(body) = environment.body() {
            movement.bind(body);
        }
        Ok(Self { environment, movement, steps, trials })
    }

    /// The environment episodes start from.
    pub fn environment(&self) -> &E {
        &self.environment
    }

    /// The movement every trial begins with.
    pub fn movement(&self) -> &dyn Movement {
        &*self.movement
    }

    /// The longest an episode lasts, in steps.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// The same episodes, lasting at most `steps` steps, and at least 1.
    #[must_use]
    pub fn shortened(&self, steps: u32) -> Self {
        Self { steps: self.steps.min(steps).max(1), ..self.clone() }
    }

    /// The same episodes, with the first `count` trials of an evaluation alone, and at least 1.
    #[must_use]
    pub fn with_fewer_trials(&self, count: u32) -> Self {
        let trials = Trials { count: self.trials.count.min(count).max(1), ..self.trials };
        Self { trials, ..self.clone() }
    }

    /// Plays one trial under the eyes of a watcher: exactly what an evaluation does. A phenotype of another shape fails
    /// before the first step.
    pub fn play(&self, phenotype: &mut dyn Phenotype, seed: Seed, watcher: &mut impl Watcher) -> Played {
        let mut state = EvaluationState::new(self);
        if let Err(failure) = self.check_shape(phenotype) {
            let outcome = Outcome { steps: 0, time_step: state.environment.time_step(), failure: Some(failure) };
            return Played { movement: state.movement, outcome };
        }
        let outcome = state.play(phenotype, seed, self.steps, watcher);
        Played { movement: state.movement, outcome }
    }
}

/// What one evaluation needs of its own, allocated once for all its trials and steps.
struct EvaluationState<E> {
    environment: E,
    movement: Box<dyn Movement>,
    inputs: Vec<f32>,
    outputs: Vec<f32>,
}

impl<E: Environment> EvaluationState<E> {
    fn new(episode: &Episode<E>) -> Self {
        let environment = episode.environment.clone();
        let (inputs, outputs) = (vec![0.0; environment.inputs()], vec![0.0; environment.outputs()]);
        Self { environment, movement: episode.movement.clone(), inputs, outputs }
    }

    /// One trial.
    fn play(&mut self, phenotype: &mut dyn Phenotype, seed: Seed, steps: u32, watcher: &mut impl Watcher) -> Outcome {
        let (steps, failure) = self.steps(phenotype, seed, steps, watcher);
        Outcome { steps, time_step: self.environment.time_step(), failure }
    }

    /// The steps of a trial, how many were done, and the failure that ended it, if one did.
    fn steps(
        &mut self,
        phenotype: &mut dyn Phenotype,
        seed: Seed,
        steps: u32,
        watcher: &mut impl Watcher,
    ) -> (u32, Option<Failure>) {
        let Self { environment, movement, inputs, outputs } = self;
        phenotype.reset();
        inputs.fill(0.0);
        outputs.fill(0.0);
        if let Err(failure) = environment.reset(seed) {
            return (0, Some(failure));
        }
        if let Some(body) = environment.body() {
            movement.bind(body);
        }
        movement.begin(environment.snapshot());
        watcher.watch(&Moment { step: 0, snapshot: environment.snapshot(), inputs, outputs, phenotype });
        for step in 1..=steps {
            environment.sense(inputs);
            phenotype.activate(inputs, outputs);
            // A body would clamp a NaN into some number, and the fault would stay hidden.
            if let Some(failure) = Failure::of_decision(inputs, outputs) {
                return (step - 1, Some(failure));
            }
            environment.act(outputs);
            if let Err(failure) = environment.step() {
                return (step, Some(failure));
            }
            let verdict = movement.observe(environment.snapshot());
            watcher.watch(&Moment { step, snapshot: environment.snapshot(), inputs, outputs, phenotype });
            match verdict {
                Verdict::GoOn => {}
                Verdict::End => return (step, None),
                Verdict::Fail(reason) => return (step, Some(Failure::Other { what: reason.into() })),
            }
        }
        (steps, None)
    }
}

impl<E: Environment> Task for Episode<E> {
    fn inputs(&self) -> usize {
        self.environment.inputs()
    }

    fn outputs(&self) -> usize {
        self.environment.outputs()
    }

    /// Fitness: the movement's value, combined over the trials. Measurements: each term's value under its name (mean
    /// over the trials), and `duration`, the length of the episode in s. Objectives: the movement's, if it has any
    /// (mean over the trials).
    fn evaluate(&self, phenotype: &mut dyn Phenotype, seed: Seed) -> Evaluation {
        if let Err(failure) = self.check_shape(phenotype) {
            return Evaluation::failed(failure);
        }
        let mut state = EvaluationState::new(self);
        let mut tally = Tally::new(self.trials);
        let mut trial: Option<Trial> = None;
        loop {
            let outcome = state.play(phenotype, seed.trial(tally.next_trial()), self.steps, &mut ());
            match &mut trial {
                Some(trial) => trial.renew(outcome, &*state.movement),
                None => trial = Some(Trial::new(outcome, &*state.movement)),
            }
            if let Some(evaluation) = trial.as_ref().and_then(|trial| tally.add(trial)) {
                return evaluation;
            }
        }
    }
}
