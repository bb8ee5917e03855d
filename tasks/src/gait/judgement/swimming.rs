use super::running::{gets_ahead, smooth};
use crate::gait::{Findings, GaitReport, Rules, Trajectory, View};

/// How long the episode must be, s.
const SECONDS: f64 = 20.0;

/// Swimming: 20 s.
///
/// It is usable if over the second half the mean forward speed of the centre of mass is at least 0.5 body lengths/s; it
/// gets ahead in each quarter of the episode and of its second half; no actuated joint's dominant frequency is above 4 Hz;
/// and no cheat is flagged. How it is turned does not matter, nor which of its joints it uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SwimmingRules;

impl Rules for SwimmingRules {
    fn name(&self) -> &str {
        "swimming"
    }

    fn seconds(&self) -> f64 {
        SECONDS
    }

    fn view(&self) -> View {
        View { in_water: true, ..View::default() }
    }

    fn judge(&self, report: &GaitReport, _: &Trajectory<'_>) -> Findings {
        let mut reasons = Vec::new();
        gets_ahead(report, &mut reasons);
        smooth(report, &mut reasons);
        Findings::new(reasons)
    }
}
