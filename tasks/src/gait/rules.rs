use super::{GaitReport, Reason, Trajectory};
use crate::{Body, Snapshot};
use serde::{Deserialize, Serialize};
use std::fmt;

/// The rules by which the gaits of a movement are judged: how long its episode must be, how it is looked at, and what
/// speaks against it.
///
/// A movement gets them where it is added to a catalogue:
/// [`MovementEntry::judged_by`](crate::MovementEntry::judged_by). Whatever judges gaits then judges its gaits: the
/// choice of champions, `gambol gait` and `robust`, `--until usable`, reports.
///
/// Check yours with [`check_rules`](crate::conformance::check_rules).
///
/// ```
/// use tasks::gait::{Findings, GaitReport, Reason, Rules, Trajectory};
///
/// /// Getting nowhere, without a rollover, for ten seconds.
/// #[derive(Debug)]
/// struct Staying;
///
/// impl Rules for Staying {
///     fn name(&self) -> &str {
///         "staying"
///     }
///     fn seconds(&self) -> f64 {
///         10.0
///     }
///     fn judge(&self, gait: &GaitReport, _: &Trajectory<'_>) -> Findings {
///         let way = gait.travel.distance.abs();
///         Findings::new((way > 0.5).then(|| Reason::other("astray", format!("{way:.1} m away, at most 0.5 m allowed"))))
///     }
/// }
/// ```
pub trait Rules: fmt::Debug + Send + Sync {
    /// What the gait is judged as, for files and tables: lower case, hyphens. Built-in: `running`, `backwards`, `jumping`,
    /// `swimming`, `playing`.
    fn name(&self) -> &str;

    /// How long the episode to judge must last, s, from 0.1 to 600. All of a longer one is judged. A shorter one is not usable, which need
    /// not be found again.
    fn seconds(&self) -> f64;

    /// How the gait is measured and audited. Default: what gets ahead on the ground.
    fn view(&self) -> View {
        View::default()
    }

    /// Whether the gait is judged by what the body is [told](crate::Command), so that a recording without commands cannot be.
    /// Default: `false`.
    fn needs_commands(&self) -> bool {
        false
    }

    /// Whether no gait that was ever in this place is usable. Where it only counts whether a gait is usable, one that is lost
    /// is not played to its end. Default: `false`, which is always right.
    ///
    /// An implementor owes: `true` only where [`judge`](Self::judge) finds a reason, whatever comes before and after.
    fn is_lost(&self, _body: &Body, _now: &Snapshot) -> bool {
        false
    }

    /// What speaks against a gait. That the audit flagged a cheat need not be found again.
    fn judge(&self, gait: &GaitReport, trajectory: &Trajectory<'_>) -> Findings;
}

/// How a gait is looked at.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct View {
    /// What the movement is about.
    pub goal: Goal,
    /// Whether backwards is the way ahead.
    pub backwards: bool,
    /// Whether it swims: what gets ahead is its centre of mass, and there is no ground.
    pub in_water: bool,
}

/// What a movement is about.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Goal {
    /// Getting ahead. Rhythm and frequencies are measured in the second half of the episode, and getting ahead by sliding
    /// or falling is a cheat.
    #[default]
    Distance,
    /// Getting off the ground. Rhythm and frequencies are measured in the whole episode.
    Height,
}

/// What rules find in a gait.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Findings {
    /// What speaks against it.
    pub reasons: Vec<Reason>,
    /// Index of the highest flight that makes a usable jump, for a movement that is about jumps.
    pub best_flight: Option<usize>,
}

impl Findings {
    /// What speaks against a gait.
    pub fn new(reasons: impl IntoIterator<Item = Reason>) -> Self {
        Self { reasons: reasons.into_iter().collect(), best_flight: None }
    }
}

impl View {
    /// Whether getting ahead by sliding and falling is a cheat: it is where getting ahead is the goal and there is ground.
    pub(super) fn must_step(self) -> bool {
        self.goal == Goal::Distance && !self.in_water
    }
}
