use crate::{Progress, SettingError, TieredFitness};
use serde::{Deserialize, Serialize};
use std::{
    fmt,
    sync::{
        Arc,
        atomic::{AtomicBool, Ordering},
    },
    time::Duration,
};

/// When a run ends: whichever condition is met first. A condition that is `None` never is.
///
/// Conditions are looked at between generations: the generation under way is always finished, so a budget can be
/// overrun by less than one generation.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields, default)]
pub struct StopConditions {
    /// Generations, at least 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub generations: Option<u64>,
    /// Evaluations, at least 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub evaluations: Option<u64>,
    /// Steps of work (for bodies: physics steps), at least 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub steps: Option<u64>,
    /// Minutes of wall clock since the start, or since the resume; above 0. The only condition that makes the length
    /// of a run depend on the machine.
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0.0)))]
    pub minutes: Option<f64>,
    /// A fitness that is good enough.
    pub target: Option<f64>,
    /// A [tier](crate::champion_selection::ReEvaluation::tiers) of the champion that is good enough.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub tier: Option<u8>,
    /// Generations without a better champion, at least 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 1)))]
    pub stagnation: Option<u64>,
}

/// Why a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StopReason {
    /// The generations were done.
    Generations,
    /// The evaluations were used up.
    Evaluations,
    /// The steps were used up.
    Steps,
    /// The time was up.
    Minutes,
    /// The target fitness was reached.
    Target,
    /// The champion has the tier asked for.
    Tier,
    /// No better champion for too long.
    Stagnation,
    /// It was asked to stop (Ctrl-C).
    Interrupted,
    /// A [`Promotion`](crate::promotion::Promotion) promoted the population.
    Promoted,
    /// A [`Promotion`](crate::promotion::Promotion) demoted the population.
    Demoted,
    /// A [`Promotion`](crate::promotion::Promotion) gave the population up.
    GivenUp,
}

impl fmt::Display for StopReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Generations => "the generations were done",
            Self::Evaluations => "the evaluations were used up",
            Self::Steps => "the physics steps were used up",
            Self::Minutes => "the time was up",
            Self::Target => "the target fitness was reached",
            Self::Tier => "the champion has the tier asked for",
            Self::Stagnation => "there was no progress any more",
            Self::Interrupted => "it was interrupted",
            Self::Promoted => "the stage was passed",
            Self::Demoted => "the population was sent back to the stage before",
            Self::GivenUp => "the population was given up, and another begins anew",
        })
    }
}

/// A switch by which other code (a Ctrl-C handler, a window) can end a run after the generation under way.
#[derive(Clone, Debug, Default)]
pub struct StopSignal(Arc<AtomicBool>);

impl StopSignal {
    /// Asks the run to stop.
    pub fn stop(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether a stop was requested.
    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// What holds the request: true once a stop is asked for. For handlers of signals, which may do no more than set it.
    pub fn switch(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.0)
    }
}

impl StopConditions {
    /// After so many generations, and nothing else; at least 1.
    pub fn generations(generations: u64) -> Self {
        Self { generations: Some(generations), ..Self::default() }
    }

    /// Checks the ranges, and that the run will end at all.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        let counts = [
            ("generations", self.generations),
            ("evaluations", self.evaluations),
            ("steps", self.steps),
            ("stagnation", self.stagnation),
            ("tier", self.tier.map(u64::from)),
        ];
        for (field, count) in counts {
            if count == Some(0) {
                return Err(SettingError::new(field, 0, "at least 1"));
            }
        }
        if let Some(minutes) = self.minutes
            && !(minutes > 0.0 && minutes.is_finite())
        {
            return Err(SettingError::new("minutes", minutes, "a finite number above 0"));
        }
        if let Some(target) = self.target
            && !target.is_finite()
        {
            return Err(SettingError::new("target", target, "a finite number"));
        }
        if *self == Self::default() {
            return Err(SettingError::new(
                "generations",
                "none",
                "a number, as there is no other limit and the run would never end",
            ));
        }
        Ok(())
    }

    /// Every condition of `newer`, and those of `self` where `newer` has none.
    #[must_use]
    pub fn overlaid(self, newer: Self) -> Self {
        Self {
            generations: newer.generations.or(self.generations),
            evaluations: newer.evaluations.or(self.evaluations),
            steps: newer.steps.or(self.steps),
            minutes: newer.minutes.or(self.minutes),
            target: newer.target.or(self.target),
            tier: newer.tier.or(self.tier),
            stagnation: newer.stagnation.or(self.stagnation),
        }
    }

    /// Without the generations and steps that a budget of `newer` takes the place of. A target or stagnation alone comes on top of
    /// them, or a run might never end.
    #[must_use]
    pub fn giving_way_to(self, newer: &Self) -> Self {
        let budget = newer.evaluations.or(newer.steps).is_some() || newer.minutes.is_some();
        let generations = self.generations.filter(|_| !budget);
        let steps = self.steps.filter(|_| !budget && newer.generations.is_none());
        Self { generations, steps, ..self }
    }

    /// For a run that goes on, and may have ended: a budget of `newer` (generations, evaluations, steps or minutes) takes the place of
    /// all budgets, and any condition that of the tier, so that a run with a usable champion goes on if it is given more of anything.
    #[must_use]
    pub fn resumed_with(self, newer: Self) -> Self {
        let Self { generations, evaluations, steps, minutes, .. } = newer;
        let has_budget = generations.or(evaluations).or(steps).is_some() || minutes.is_some();
        let Self { target, stagnation, .. } = self;
        let kept = match newer == Self::default() {
            true => self,
            false if has_budget => Self { target, stagnation, ..Self::default() },
            false => Self { tier: None, ..self },
        };
        kept.overlaid(newer)
    }

    /// The first condition that is met, if any.
    pub fn reached(&self, progress: &Progress, best: Option<TieredFitness>, elapsed: Duration) -> Option<StopReason> {
        let used_up = |limit: Option<u64>, used: u64| limit.is_some_and(|limit| used >= limit);
        if self.target.zip(best).is_some_and(|(target, best)| best.fitness.get() >= target) {
            Some(StopReason::Target)
        } else if self.tier.zip(best).is_some_and(|(tier, best)| best.tier >= tier) {
            Some(StopReason::Tier)
        } else if used_up(self.generations, progress.generations) {
            Some(StopReason::Generations)
        } else if used_up(self.evaluations, progress.evaluations) {
            Some(StopReason::Evaluations)
        } else if used_up(self.steps, progress.steps) {
            Some(StopReason::Steps)
        } else if used_up(self.stagnation, progress.stagnation) {
            Some(StopReason::Stagnation)
        } else if self.minutes.is_some_and(|minutes| elapsed.as_secs_f64() >= minutes * 60.0) {
            Some(StopReason::Minutes)
        } else {
            None
        }
    }
}
