use super::{GaitReport, JUMPING_SECONDS, RUNNING_SECONDS, Reason, SWIMMING_SECONDS, Trajectory};
use serde::{Deserialize, Serialize};

mod jumping;
mod running;

/// Clocks are f32: a limit in seconds is kept by what exceeds it by less than this.
const CLOCK_ERROR: f64 = 1e-5;

/// What a gait is judged as.
///
/// | movement | judged as | why |
/// |---|---|---|
/// | `running`, `climbing`, `carrying`, `cruising` | running | they get ahead, upright and step by step |
/// | `backwards` | backwards | the same, the other way |
/// | `swimming` | swimming | it gets ahead, and there is neither ground nor up |
/// | `jumping`, `long-jump` | jumping | what gets far without getting high off all legs is a stride |
///
/// Others are measured and audited, and not judged: the speed of a walk is a setting, and hopping, standing and
/// getting up have no rules yet that a game agrees on. Nor are movements of other crates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Getting ahead.
    Running,
    /// Getting ahead backwards: running, with every way measured against the direction the creature faces.
    Backwards,
    /// Getting off the ground.
    Jumping,
    /// Getting ahead in water.
    Swimming,
}

impl Kind {
    /// The movements whose gaits are judged.
    pub const JUDGED: [&str; 8] =
        ["running", "jumping", "long-jump", "climbing", "carrying", "cruising", "backwards", "swimming"];

    /// How a movement of this name is judged, if it is.
    pub fn of(movement: &str) -> Option<Self> {
        match movement {
            "running" | "climbing" | "carrying" | "cruising" => Some(Self::Running),
            "backwards" => Some(Self::Backwards),
            "jumping" | "long-jump" => Some(Self::Jumping),
            "swimming" => Some(Self::Swimming),
            _ => None,
        }
    }

    /// How long the episode to judge must last, s. All of a longer one is judged.
    pub fn judged_seconds(self) -> f64 {
        match self {
            Self::Running | Self::Backwards => RUNNING_SECONDS,
            Self::Swimming => SWIMMING_SECONDS,
            Self::Jumping => JUMPING_SECONDS,
        }
    }
}

/// Whether a gait is usable: what a game animator would say of it, by measures and limits.
///
/// **Running** is, if over the second half the mean forward speed is at least 0.5 body lengths/s; the torso gets ahead
/// in each quarter of the episode and in each quarter of its second half; every leg comes down (its foot touches the
/// ground, or on flat ground is less than 1 % of the body length above it) and lifts off at least once every second, from the
/// start to the end, and its foot rises by at least 2 % of the body length between; the torso
/// stays within 45° of its start, with a standard deviation of at most 12° over the second half, and above 0.6 of its start
/// height on flat ground; parts that are no feet touch the ground for at most 1 % of the time; feet slip by at most
/// 0.3 m for each metre of way, as a mean over all; no actuated joint's dominant frequency is above 4 Hz; the joints repeat themselves with a
/// regularity of at least 0.8; and no cheat is flagged. A legless body (or one without an actuated leg) may turn, touch and
/// lie as it likes; every actuated joint moves by at least 20° in the second half instead. **Backwards** is the same, where
/// ahead is backwards.
///
/// **Swimming** is, if over the second half the mean forward speed of the centre of mass is at least 0.5 body lengths/s; it
/// gets ahead in each quarter of the episode and of its second half; no actuated joint's dominant frequency is above 4 Hz;
/// and no cheat is flagged. How it is turned does not matter, nor which of its joints it uses.
///
/// **Jumping** is, if in one and the same flight every part is off the ground for at least 0.2 s, the centre of mass rises
/// at least 0.3 × the start height and 5 cm above its start (without legs 0.25 body lengths), and all legs lose contact within 0.15 s before it; if from the
/// take-off of the first such flight to the end the torso stays within 45° and nothing but feet touches the ground; if the
/// body stands again in the last second, or jumps on; and no cheat is flagged. Legs, tilt and contacts are not asked of a
/// legless body, which lies at the end as it lay.
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

/// In how many near worlds a gait is tried.
pub const NEAR_WORLDS: usize = 8;

/// In how many of them it must be usable: a gait that fails in more is a lucky trajectory.
pub const NEAR_WORLDS_REQUIRED: usize = 7;

impl Judgement {
    pub(super) fn of(kind: Kind, report: &GaitReport, trajectory: &Trajectory<'_>) -> Self {
        let mut reasons = Vec::new();
        // Half a step is forgiven: it may be the clock's.
        if report.duration < kind.judged_seconds() - 0.5 * report.time_step {
            reasons.push(Reason::TooShort { seconds: report.duration, required: kind.judged_seconds() });
        }
        let mut best_flight = None;
        match kind {
            Kind::Running | Kind::Backwards => running::judge(report, trajectory, &mut reasons),
            Kind::Swimming => running::judge_swimming(report, &mut reasons),
            Kind::Jumping => best_flight = jumping::judge(report, trajectory, &mut reasons),
        }
        reasons.extend(report.cheats.iter().cloned().map(Reason::Cheat));
        Self { usable: reasons.is_empty(), reasons, best_flight, near_worlds: None }
    }

    /// The same, of a gait that was also tried in near worlds. One that is usable in fewer than 7 of 8 is not usable.
    #[must_use]
    pub fn with_near_worlds(mut self, near: NearWorlds) -> Self {
        let required = (near.worlds * NEAR_WORLDS_REQUIRED).div_ceil(NEAR_WORLDS);
        if near.usable < required {
            self.reasons.push(Reason::Brittle { usable: near.usable, worlds: near.worlds, required });
        }
        Self { usable: self.reasons.is_empty(), near_worlds: Some(near), ..self }
    }
}
