use crate::{Movement, commands::LESSONS};
use ne_core::{Evaluation, Failure, Measurements, SettingError};
use serde::{Deserialize, Serialize};

/// How many trials make an evaluation, and what their values become.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct Trials {
    /// How many, from 1 to 1000; default 1. Trial k gets the seed's trial k, so more trials pay only where the
    /// environment varies with the seed.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1000)))]
    pub count: u32,
    /// How the values of the trials become one fitness; default mean.
    pub combine: Combine,
    /// Whether the trials of a body that is told [random commands](crate::RandomCommands) are lessons: of every two the first
    /// has nothing but jumps out of standing, and the second a jump in every hold. Default `false`.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub lessons: bool,
}

/// How the values of several trials become one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Combine {
    /// The arithmetic mean.
    #[default]
    Mean,
    /// The lowest: a gait is worth what it is on its worst day.
    Worst,
    /// Half the mean, and half the mean of the [lesson](Trials::lessons) that went worst: nothing is gained by doing one thing
    /// better and another worse. Without lessons the mean.
    WorstLesson,
}

impl Default for Trials {
    fn default() -> Self {
        Self { count: 1, combine: Combine::Mean, lessons: false }
    }
}

impl Trials {
    /// Checks the ranges.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        SettingError::check_range("count", self.count, 1.0, 1000.0)
    }
}

/// How a trial ended.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// Steps done.
    pub steps: u32,
    /// Seconds each of them lasted.
    pub time_step: f32,
    /// What went wrong, if anything did.
    pub failure: Option<Failure>,
}

/// The failure of a movement whose value is not finite: which of its [measurements](Movement::measurements) is not, or that the
/// fitness is not.
pub fn failure_of_value(movement: &dyn Movement) -> Failure {
    let mut found = None;
    movement.measurements(&mut |name, value| {
        if !value.is_finite() && found.is_none() {
            found = Some(format!("the value of \"{name}\""));
        }
    });
    Failure::NonFinite { what: found.unwrap_or_else(|| "fitness".into()) }
}

/// A trial that has been played: how it ended, and what its movement then had to say.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    outcome: Outcome,
    value: f64,
    objectives: Vec<f64>,
    measurements: Measurements,
}

impl Trial {
    /// A trial that ended so, watched by this movement.
    pub fn new(outcome: Outcome, movement: &dyn Movement) -> Self {
        let mut trial =
            Self { outcome, value: f64::NAN, objectives: Vec::new(), measurements: Measurements::default() };
        trial.note(movement);
        trial
    }

    /// Another trial in its place, with what it has allocated.
    pub(crate) fn renew(&mut self, outcome: Outcome, movement: &dyn Movement) {
        self.outcome = outcome;
        self.note(movement);
    }

    fn note(&mut self, movement: &dyn Movement) {
        self.value = if self.failed() { f64::NAN } else { movement.value() };
        if !self.value.is_finite() {
            self.outcome.failure.get_or_insert_with(|| failure_of_value(movement));
        }
        self.objectives.clear();
        if self.value.is_finite() {
            let Self { outcome, objectives, measurements, .. } = self;
            movement.objectives(&mut |objective| objectives.push(objective));
            let duration = f64::from(outcome.steps) * f64::from(outcome.time_step);
            measurements.retell(|tell| {
                movement.measurements(tell);
                tell("duration", duration);
            });
        } else {
            self.measurements = Measurements::default();
        }
    }

    /// Whether it failed, which ends its evaluation.
    pub fn failed(&self) -> bool {
        self.outcome.failure.is_some()
    }
}

/// Makes an evaluation of trials, in their order. What an [`Episode`](crate::Episode) uses, and tasks that play many at once.
#[derive(Clone, Debug)]
pub struct Tally {
    trials: Trials,
    done: u32,
    steps: u64,
    sum: f64,
    worst: f64,
    /// Sum and number of the trials of each lesson.
    lessons: [(f64, f64); LESSONS],
    objectives: Vec<f64>,
    measurements: Measurements,
}

impl Tally {
    /// Of no trials yet.
    pub fn new(trials: Trials) -> Self {
        let (objectives, measurements) = (Vec::new(), Measurements::default());
        let lessons = [(0.0, 0.0); LESSONS];
        Self { trials, done: 0, steps: 0, sum: 0.0, worst: f64::INFINITY, lessons, objectives, measurements }
    }

    /// The number of the trial that comes next, from 0.
    pub fn next_trial(&self) -> u32 {
        self.done
    }

    /// Adds the next trial; gives the evaluation once it is complete: after the last trial, and after one that failed or has
    /// no finite value. The objectives are the means of the trials', however values combine.
    pub fn add(&mut self, trial: &Trial) -> Option<Evaluation> {
        let Trial { outcome, value, objectives, measurements } = trial;
        self.done += 1;
        self.steps += u64::from(outcome.steps);
        if let Some(failure) = &outcome.failure {
            return Some(Evaluation::failed(failure.clone()).with_steps(self.steps));
        }
        let value = *value;
        let (sum, trials) = &mut self.lessons[(self.done as usize - 1) % LESSONS];
        (*sum, *trials) = (*sum + value, *trials + 1.0);
        self.sum += value;
        self.worst = self.worst.min(value);
        let count = f64::from(self.trials.count);
        for (index, objective) in objectives.iter().enumerate() {
            match self.objectives.get_mut(index) {
                Some(mean) => *mean += objective / count,
                None => self.objectives.push(objective / count),
            }
        }
        if let Some(index) = self.objectives.iter().position(|objective| !objective.is_finite()) {
            let failure = Failure::NonFinite { what: format!("objective {index}") };
            return Some(Evaluation::failed(failure).with_steps(self.steps));
        }
        self.measurements.add_share(measurements, count);
        if self.done < self.trials.count {
            return None;
        }
        let fitness = match self.trials.combine {
            Combine::WorstLesson if self.trials.lessons => {
                let means = self.lessons.iter().filter(|lesson| lesson.1 > 0.0).map(|(sum, trials)| sum / trials);
                0.5 * (self.sum / count + means.fold(f64::INFINITY, f64::min))
            }
            Combine::Mean | Combine::WorstLesson => self.sum / count,
            Combine::Worst => self.worst,
        };
        let (objectives, measurements) = (std::mem::take(&mut self.objectives), std::mem::take(&mut self.measurements));
        Some(Evaluation { objectives, measurements, ..Evaluation::new(fitness).with_steps(self.steps) })
    }
}
