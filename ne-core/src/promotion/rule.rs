use super::{Decision, Promotion, StageState};
use crate::{SettingError, share_rounded_up};
use serde::{Deserialize, Serialize};

/// A condition on a stage of a run, as a configuration file names it; as a [`Promotion`] it promotes when it is met.
///
/// In JSON: `{"fitness": 20}`, `"usable"`, `{"tier": 8}`, `{"share": {"fitness": 20, "of": 0.5}}`, `{"measurement": {"name": "energy",
/// "at_least": 10}}`, `{"stagnation": 30}`, `{"generations": 100}`, `{"evaluations": 10000}`, `{"steps": 1000000}`,
/// `{"any": [...]}`, `{"all": [...]}`, `{"not": ...}`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum PromotionRule {
    /// The champion's fitness is at least this.
    Fitness(f64),
    /// The champion selection gives the champion a [tier](crate::champion_selection::ReEvaluation::tiers) of at least 1: of creatures, its gait is usable.
    Usable,
    /// The champion selection gives the champion at least this tier, from 1.
    Tier(#[cfg_attr(feature = "schema", schemars(range(min = 1)))] u64),
    /// So large a share of the generation has at least this fitness.
    Share(PopulationShare),
    /// The mean of a [measurement](crate::Evaluation::measurements) over those of the generation that did not fail reaches a
    /// bound.
    Measurement(MeasurementBound),
    /// So many generations have passed without a better champion; at least 1.
    Stagnation(#[cfg_attr(feature = "schema", schemars(range(min = 1)))] u64),
    /// So many generations were spent in the stage; at least 1.
    Generations(#[cfg_attr(feature = "schema", schemars(range(min = 1)))] u64),
    /// So many evaluations were spent in the stage; at least 1.
    Evaluations(#[cfg_attr(feature = "schema", schemars(range(min = 1)))] u64),
    /// So many steps of work were spent in the stage; at least 1.
    Steps(#[cfg_attr(feature = "schema", schemars(range(min = 1)))] u64),
    /// One of these is met; at least one.
    Any(#[cfg_attr(feature = "schema", schemars(length(min = 1)))] Vec<PromotionRule>),
    /// All of these are met; at least one.
    All(#[cfg_attr(feature = "schema", schemars(length(min = 1)))] Vec<PromotionRule>),
    /// This one is not met.
    Not(Box<PromotionRule>),
}

/// A fitness, and by how many it is reached.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct PopulationShare {
    /// The fitness.
    pub fitness: f64,
    /// The share of the generation, above 0 and at most 1.
    #[cfg_attr(feature = "schema", schemars(range(max = 1.0), extend("exclusiveMinimum" = 0.0)))]
    pub of: f64,
}

/// A measurement, and the bound it must reach: one of them, from below or from above.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct MeasurementBound {
    /// Its name.
    pub name: String,
    /// At least this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_least: Option<f64>,
    /// At most this.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub at_most: Option<f64>,
}

impl PromotionRule {
    /// Checks the numbers. Whether the rule contradicts itself says [`can_be_met`](Self::can_be_met).
    ///
    /// # Errors
    /// Names the field and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        let finite = |field: &str, value: f64| match value.is_finite() {
            true => Ok(()),
            false => Err(SettingError::new(field, value, "a finite number")),
        };
        let count = |field: &str, count: u64| match count {
            0 => Err(SettingError::new(field, 0, "at least 1")),
            _ => Ok(()),
        };
        match self {
            Self::Usable => Ok(()),
            Self::Fitness(fitness) => finite("fitness", *fitness),
            Self::Tier(tier) => count("tier", *tier),
            Self::Share(PopulationShare { fitness, of }) => {
                finite("share.fitness", *fitness)?;
                SettingError::check_above_0("share.of", *of, 1.0)
            }
            Self::Measurement(MeasurementBound { at_least, at_most, .. }) => match (at_least, at_most) {
                (Some(bound), None) => finite("measurement.at_least", *bound),
                (None, Some(bound)) => finite("measurement.at_most", *bound),
                (bounds, _) => {
                    let found = if bounds.is_some() { "both bounds" } else { "no bound" };
                    Err(SettingError::new("measurement", found, "either at_least or at_most"))
                }
            },
            Self::Stagnation(generations) => count("stagnation", *generations),
            Self::Generations(generations) => count("generations", *generations),
            Self::Evaluations(evaluations) => count("evaluations", *evaluations),
            Self::Steps(steps) => count("steps", *steps),
            Self::Any(rules) => validate_all("any", rules),
            Self::All(rules) => validate_all("all", rules),
            Self::Not(rule) => rule.validate().map_err(|error| error.within("not")),
        }
    }

    /// Whether it is met.
    pub fn is_met(&self, state: &StageState<'_>) -> bool {
        let StageState { evaluations, champion, progress, .. } = *state;
        match self {
            Self::Fitness(fitness) => champion.is_some_and(|champion| champion.fitness.get() >= *fitness),
            Self::Usable => Self::Tier(1).is_met(state),
            Self::Tier(tier) => champion.is_some_and(|champion| u64::from(champion.tier) >= *tier),
            Self::Share(PopulationShare { fitness, of }) => {
                let good = evaluations
                    .iter()
                    .filter(|evaluation| evaluation.fitness().is_some_and(|found| found.get() >= *fitness));
                good.count() >= share_rounded_up(*of, evaluations.len())
            }
            Self::Measurement(reached) => reached.is_met(state),
            Self::Stagnation(generations) => progress.stagnation >= *generations,
            Self::Generations(generations) => progress.generations >= *generations,
            Self::Evaluations(evaluations) => progress.evaluations >= *evaluations,
            Self::Steps(steps) => progress.steps >= *steps,
            Self::Any(rules) => rules.iter().any(|rule| rule.is_met(state)),
            Self::All(rules) => rules.iter().all(|rule| rule.is_met(state)),
            Self::Not(rule) => !rule.is_met(state),
        }
    }

    /// Whether some number of generations exists at which the rule could be met, assuming that all its other conditions hold: not for
    /// `{"not": {"generations": 1}}`, nor for `{"all": [{"generations": 5}, {"not": {"generations": 5}}]}`.
    pub fn can_be_met(&self) -> bool {
        let mut generations = vec![1];
        self.add_thresholds(&mut generations);
        generations.into_iter().any(|generation| self.could_be(true, generation))
    }

    /// The generations between which it may change.
    fn add_thresholds(&self, generations: &mut Vec<u64>) {
        match self {
            Self::Generations(threshold) => generations.push((*threshold).max(1)),
            Self::Any(rules) | Self::All(rules) => rules.iter().for_each(|rule| rule.add_thresholds(generations)),
            Self::Not(rule) => rule.add_thresholds(generations),
            _ => {}
        }
    }

    /// Whether it could be met, or not met, after so many generations.
    fn could_be(&self, met: bool, generation: u64) -> bool {
        let mut rules = match self {
            Self::Generations(threshold) => return (generation >= *threshold) == met,
            Self::Not(rule) => return rule.could_be(!met, generation),
            Self::Any(rules) | Self::All(rules) => rules.iter().map(|rule| rule.could_be(met, generation)),
            _ => return true,
        };
        // One rule of `any` is enough to meet it, and one of `all` not to.
        match matches!(self, Self::Any(_)) == met {
            true => rules.any(|could| could),
            false => rules.all(|could| could),
        }
    }

    /// The same rule, where a tier above this one counts as this one.
    #[must_use]
    pub fn with_tiers_up_to(self, highest: u64) -> Self {
        let all = |rules: Vec<Self>| rules.into_iter().map(|rule| rule.with_tiers_up_to(highest)).collect();
        match self {
            Self::Tier(tier) => Self::Tier(tier.min(highest)),
            Self::Any(rules) => Self::Any(all(rules)),
            Self::All(rules) => Self::All(all(rules)),
            Self::Not(rule) => Self::Not(Box::new(rule.with_tiers_up_to(highest))),
            rule => rule,
        }
    }

    /// The names of all measurements it asks for.
    pub fn measurements(&self) -> Vec<&str> {
        match self {
            Self::Measurement(reached) => vec![reached.name.as_str()],
            Self::Any(rules) | Self::All(rules) => rules.iter().flat_map(Self::measurements).collect(),
            Self::Not(rule) => rule.measurements(),
            _ => Vec::new(),
        }
    }

    /// The rule with the highest tier that it asks for, and that tier; `None` where it asks for none.
    pub fn highest_tier(&self) -> Option<(&Self, u64)> {
        match self {
            Self::Usable => Some((self, 1)),
            Self::Tier(tier) => Some((self, *tier)),
            Self::Any(rules) | Self::All(rules) => {
                rules.iter().filter_map(Self::highest_tier).max_by_key(|&(_, tier)| tier)
            }
            Self::Not(rule) => rule.highest_tier(),
            _ => None,
        }
    }
}

fn validate_all(field: &str, rules: &[PromotionRule]) -> Result<(), SettingError> {
    if rules.is_empty() {
        return Err(SettingError::new(field, "[]", "at least one rule"));
    }
    let numbered = |(index, rule): (usize, &PromotionRule)| {
        rule.validate().map_err(|error| error.within(&format!("{field}[{index}]")))
    };
    rules.iter().enumerate().try_for_each(numbered)
}

impl MeasurementBound {
    fn is_met(&self, state: &StageState<'_>) -> bool {
        let found = state.evaluations.iter().filter(|evaluation| evaluation.outcome.is_ok());
        let values: Vec<f64> = found.filter_map(|evaluation| evaluation.measurements.get(&self.name)).collect();
        if values.is_empty() {
            return false;
        }
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        self.at_least.is_none_or(|bound| mean >= bound) && self.at_most.is_none_or(|bound| mean <= bound)
    }
}

impl Promotion for PromotionRule {
    fn decide(&self, state: &StageState<'_>) -> Decision {
        if self.is_met(state) { Decision::Promote } else { Decision::Stay }
    }
}

/// A condition in words: `fitness ≥ 20`, `usable or 100 generations`.
impl std::fmt::Display for PromotionRule {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let joined = |f: &mut std::fmt::Formatter<'_>, rules: &[PromotionRule], word: &str| {
            for (index, rule) in rules.iter().enumerate() {
                let nested = matches!(rule, Self::Any(_) | Self::All(_));
                f.write_str(if index > 0 { word } else { "" })?;
                if nested { write!(f, "({rule})")? } else { write!(f, "{rule}")? }
            }
            Ok(())
        };
        match self {
            Self::Fitness(fitness) => write!(f, "fitness ≥ {fitness}"),
            Self::Usable => f.write_str("usable"),
            Self::Tier(tier) => write!(f, "tier ≥ {tier}"),
            Self::Share(PopulationShare { fitness, of }) => {
                write!(f, "fitness ≥ {fitness} in {} % of the population", of * 100.0)
            }
            Self::Measurement(MeasurementBound { name, at_least: Some(bound), .. }) => {
                write!(f, "mean {name} ≥ {bound}")
            }
            Self::Measurement(MeasurementBound { name, at_most, .. }) => {
                write!(f, "mean {name} ≤ {}", at_most.unwrap_or(f64::NAN))
            }
            Self::Stagnation(generations) => write!(f, "{generations} generations without progress"),
            Self::Generations(generations) => write!(f, "{generations} generations"),
            Self::Evaluations(evaluations) => write!(f, "{evaluations} evaluations"),
            Self::Steps(steps) => write!(f, "{steps} steps"),
            Self::Any(rules) => joined(f, rules, " or "),
            Self::All(rules) => joined(f, rules, " and "),
            Self::Not(rule) => write!(f, "not ({rule})"),
        }
    }
}
