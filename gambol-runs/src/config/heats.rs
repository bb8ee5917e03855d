//! Cheaper evaluations that come before the whole one.

use ne_core::SettingError;
use serde::{Deserialize, Serialize};

/// The most heats there can be.
const MOST_HEATS: usize = 8;

/// A heat: a cheaper evaluation, after which only the best share of a generation goes on, to the next heat and in the end
/// to the evaluation of training. See [`ne_core::Heats`] for what those left behind are worth.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HeatSettings {
    /// The steps an episode lasts, from 1 to those of training; `null`, the default: as many as in training.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub steps: Option<u32>,
    /// The trials of an evaluation, from 1 to those of training, of which they are the first; `null`, the default: as many
    /// as in training.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub trials: Option<u32>,
    /// The share of those who ran this heat that goes on, above 0 and below 1; rounded up, and at least one.
    pub share: f64,
}

impl HeatSettings {
    /// Checks the heats of a run in which an evaluation of training has so many trials of at most so many steps.
    ///
    /// # Errors
    /// Names the field and its range.
    pub(crate) fn validate(heats: &[Self], steps: u32, trials: u32) -> Result<(), SettingError> {
        if heats.len() > MOST_HEATS {
            let found = format!("{} heats", heats.len());
            return Err(SettingError::new("heats", found, format!("at most {MOST_HEATS} heats")));
        }
        heats.iter().enumerate().try_for_each(|(index, heat)| heat.check(&format!("heats[{index}]"), steps, trials))
    }

    /// Checks the heat at this path.
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

    fn refusal(heats: &[HeatSettings], steps: u32, trials: u32) -> String {
        HeatSettings::validate(heats, steps, trials).map_or_else(|error| error.to_string(), |()| "fine".into())
    }

    #[test]
    fn a_heat_must_be_cheaper_than_training() {
        let heat = |steps, trials| [HeatSettings { steps, trials, share: 0.5 }];
        for (heat, says) in [
            (heat(Some(99), None), "fine"),
            (heat(None, Some(7)), "fine"),
            (heat(Some(100), Some(1)), "fine"),
            (heat(Some(1), Some(8)), "fine"),
            (heat(Some(0), None), "heats[0].steps = 0: must be from 1 to 100, as many as in training"),
            (heat(Some(101), Some(1)), "heats[0].steps = 101: must be from 1 to 100, as many as in training"),
            (heat(None, Some(0)), "heats[0].trials = 0: must be from 1 to 8, as many as in training"),
            (heat(Some(1), Some(9)), "heats[0].trials = 9: must be from 1 to 8, as many as in training"),
        ] {
            assert_eq!(refusal(&heat, 100, 8), says);
        }
        let dear = "must be cheaper than training: fewer steps than 100";
        for (steps, trials) in [(None, None), (Some(100), None), (None, Some(8)), (Some(100), Some(8))] {
            let says = format!("heats[0] = 100 steps, trials: 8: {dear} or fewer trials than 8");
            assert_eq!(refusal(&heat(steps, trials), 100, 8), says);
        }
        assert_eq!(refusal(&heat(None, None), 100, 1), format!("heats[0] = 100 steps, trials: 1: {dear}"));
    }

    #[test]
    fn shares_and_the_number_of_heats_have_bounds() {
        let heat = |share| HeatSettings { steps: Some(50), trials: None, share };
        for (share, shown) in [(0.0, "0"), (1.0, "1"), (1.5, "1.5"), (-0.1, "-0.1"), (f64::NAN, "NaN")] {
            let says = format!("heats[1].share = {shown}: must be above 0 and below 1");
            assert_eq!(refusal(&[heat(0.5), heat(share)], 100, 1), says);
        }
        assert_eq!(refusal(&[heat(0.5); 8], 100, 1), "fine");
        assert_eq!(refusal(&[heat(0.5); 9], 100, 1), "heats = 9 heats: must be at most 8 heats");
    }
}
