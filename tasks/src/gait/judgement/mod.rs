use super::{GaitReport, Reason, Rules, Trajectory};
use serde::{Deserialize, Serialize};

mod jumping;
mod playing;
mod running;
mod swimming;

pub use jumping::JumpingRules;
pub use playing::PlayingRules;
pub use running::RunningRules;
pub use swimming::SwimmingRules;

/// Clocks are f32: a limit in seconds is kept by what exceeds it by less than this.
const CLOCK_ERROR: f64 = 1e-5;

/// Whether a gait is usable: what a game animator would say of it, by the measures and limits of some [`Rules`].
///
/// A champion's gait is also tried in [near worlds](NearWorlds).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// Whether nothing speaks against it.
    pub usable: bool,
    /// What speaks against it.
    pub reasons: Vec<Reason>,
    /// Index of the highest flight that makes a usable jump.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub best_flight: Option<usize>,
    /// In how many near worlds it is usable; `None` if it was judged alone, as a bare trajectory is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near_worlds: Option<NearWorlds>,
}

/// In how many worlds that are almost the one it is judged in a gait is usable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NearWorlds {
    /// So many.
    pub usable: usize,
    /// Of so many.
    pub worlds: usize,
}

impl NearWorlds {
    /// In how many of so many near worlds a gait must be usable.
    pub fn required(worlds: usize) -> usize {
        (worlds * NEAR_WORLDS_REQUIRED).div_ceil(NEAR_WORLDS)
    }
}

/// In how many near worlds a gait is tried.
pub const NEAR_WORLDS: usize = 8;

/// In how many of them it must be usable: a gait that fails in more is a lucky trajectory.
pub const NEAR_WORLDS_REQUIRED: usize = 7;

impl Judgement {
    pub(super) fn of(rules: &dyn Rules, report: &GaitReport, trajectory: &Trajectory<'_>) -> Self {
        let findings = rules.judge(report, trajectory);
        // Half a step is forgiven: it may be the clock's.
        let short = report.duration < rules.seconds() - 0.5 * report.time_step;
        let short = short.then(|| Reason::TooShort { seconds: report.duration, required: rules.seconds() });
        let mut reasons: Vec<Reason> = short.into_iter().chain(findings.reasons).collect();
        reasons.extend(report.cheats.iter().cloned().map(Reason::Cheat));
        Self { usable: reasons.is_empty(), reasons, best_flight: findings.best_flight, near_worlds: None }
    }

    /// The same, of a gait that was also tried in near worlds. One that is usable in fewer than 7 of 8 is not usable.
    #[must_use]
    pub fn with_near_worlds(mut self, near: NearWorlds) -> Self {
        let required = NearWorlds::required(near.worlds);
        if near.usable < required {
            self.reasons.push(Reason::Brittle { usable: near.usable, worlds: near.worlds, required });
        }
        Self { usable: self.reasons.is_empty(), near_worlds: Some(near), ..self }
    }
}
