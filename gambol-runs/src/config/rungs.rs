//! Cheaper evaluations that come before the whole one.

use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// The most rungs there can be.
const MOST_RUNGS: usize = 8;

/// A rung: a cheaper evaluation, after which only the best share of a generation goes on, to the next rung and in the end
/// to the evaluation of training. See [`ne_core::successive_halving::SuccessiveHalving`] for what those left behind are worth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct RungSettings {
    /// The steps an episode lasts, from 1 to those of training; `null`, the default: as many as in training.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1_000_000)))]
    pub steps: Option<u32>,
    /// The trials of an evaluation, from 1 to those of training, of which they are the first; `null`, the default: as many
    /// as in training.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 1000)))]
    pub trials: Option<u32>,
    /// The share of the individuals of this rung that goes on, above 0 and below 1; rounded up, and at least one.
    #[cfg_attr(feature = "schema", schemars(extend("exclusiveMinimum" = 0.0, "exclusiveMaximum" = 1.0)))]
    pub share: f64,
}

impl RungSettings {
    /// Checks the rungs of a run in which an evaluation of training has so many trials of at most so many steps.
    ///
    /// # Errors
    /// Names the field and its range.
    pub(crate) fn validate(rungs: &[Self], steps: u32, trials: u32) -> Result<(), SettingError> {
        if rungs.len() > MOST_RUNGS {
            let found = format!("{} rungs", rungs.len());
            return Err(SettingError::new("rungs", found, format!("at most {MOST_RUNGS} rungs")));
        }
        rungs.iter().enumerate().try_for_each(|(index, rung)| rung.check(&format!("rungs[{index}]"), steps, trials))
    }

    /// Checks the rung at this path.
    fn check(&self, path: &str, steps: u32, trials: u32) -> Result<(), SettingError> {
        if !(self.share > 0.0 && self.share < 1.0) {
            return Err(SettingError::new("share", self.share, "above 0 and below 1").within(path));
        }
        for (field, found, most) in [("steps", self.steps, steps), ("trials", self.trials, trials)] {
            if let Some(found) = found.filter(|found| !(1..=most).contains(found)) {
                let allowed = format!("from 1 to {most}, as many as in training");
                return Err(SettingError::new(field, found, allowed).within(path));
            }
        }
        if self.steps.unwrap_or(steps) < steps || self.trials.unwrap_or(trials) < trials {
            return Ok(());
        }
        let fewer_trials = if trials > 1 { format!(" or fewer trials than {trials}") } else { String::new() };
        let allowed = format!("cheaper than training: fewer steps than {steps}{fewer_trials}");
        Err(SettingError::new(path, format!("{steps} steps, trials: {trials}"), allowed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(rungs: &[RungSettings], steps: u32, trials: u32) -> String {
        RungSettings::validate(rungs, steps, trials).map_or_else(|error| error.to_string(), |()| "fine".into())
    }

    #[test]
    fn a_rung_must_be_cheaper_than_training() {
        let rung = |steps, trials| [RungSettings { steps, trials, share: 0.5 }];
        for (rung, says) in [
            (rung(Some(99), None), "fine"),
            (rung(None, Some(7)), "fine"),
            (rung(Some(100), Some(1)), "fine"),
            (rung(Some(1), Some(8)), "fine"),
            (rung(Some(0), None), "rungs[0].steps = 0: must be from 1 to 100, as many as in training"),
            (rung(Some(101), Some(1)), "rungs[0].steps = 101: must be from 1 to 100, as many as in training"),
            (rung(None, Some(0)), "rungs[0].trials = 0: must be from 1 to 8, as many as in training"),
            (rung(Some(1), Some(9)), "rungs[0].trials = 9: must be from 1 to 8, as many as in training"),
        ] {
            assert_eq!(refusal(&rung, 100, 8), says);
        }
        let dear = "must be cheaper than training: fewer steps than 100";
        for (steps, trials) in [(None, None), (Some(100), None), (None, Some(8)), (Some(100), Some(8))] {
            let says = format!("rungs[0] = 100 steps, trials: 8: {dear} or fewer trials than 8");
            assert_eq!(refusal(&rung(steps, trials), 100, 8), says);
        }
        assert_eq!(refusal(&rung(None, None), 100, 1), format!("rungs[0] = 100 steps, trials: 1: {dear}"));
    }

    #[test]
    fn shares_and_the_number_of_rungs_have_bounds() {
        let rung = |share| RungSettings { steps: Some(50), trials: None, share };
        for (share, shown) in [(0.0, "0"), (1.0, "1"), (1.5, "1.5"), (-0.1, "-0.1"), (f64::NAN, "NaN")] {
            let says = format!("rungs[1].share = {shown}: must be above 0 and below 1");
            assert_eq!(refusal(&[rung(0.5), rung(share)], 100, 1), says);
        }
        assert_eq!(refusal(&[rung(0.5); 8], 100, 1), "fine");
        assert_eq!(refusal(&[rung(0.5); 9], 100, 1), "rungs = 9 rungs: must be at most 8 rungs");
    }
}
