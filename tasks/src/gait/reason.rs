use super::Cheat;
use serde::{Deserialize, Serialize};
use std::fmt;

/// What speaks against a gait, in words a user understands.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[allow(missing_docs, reason = "each field is named in the message; s, m, degrees, Hz and body lengths/s")]
pub enum Reason {
    /// The episode is shorter than the one to be judged, s.
    TooShort { seconds: f64, required: f64 },
    /// Too little speed over the second half, body lengths/s.
    Slow { speed: f64, required: f64 },
    /// No way forward in a quarter (1 to 4) of the episode or of its second half, m.
    NoProgress { quarter: usize, second_half: bool, progress: f64 },
    /// The torso tilts too far, degrees.
    Tilted { tilt: f64, allowed: f64, time: f64 },
    /// The torso sways too much over the second half, degrees of standard deviation.
    Swaying { deviation: f64, allowed: f64 },
    /// The torso gets too low, as a share of its start height.
    Crouching { height: f64, required: f64, time: f64 },
    /// Parts that are no feet touch the ground for too large a share of the time; the one that does most is named.
    OtherContact { part: String, share: f64, allowed: f64 },
    /// A foot hardly rises between liftoff and touchdown, m.
    LowStep { foot: String, clearance: f64, required: f64 },
    /// Feet slide over the ground, as a mean over all of them, m for each m of way.
    Slipping { slip: f64, allowed: f64 },
    /// Strides do not repeat themselves, 0 to 1.
    Irregular { regularity: f64, required: f64 },
    /// A foot does not come down for too long, s.
    NoTouchdown { foot: String, seconds: f64, allowed: f64 },
    /// A foot does not leave the ground for too long, s.
    NoLiftoff { foot: String, seconds: f64, allowed: f64 },
    /// The joints of a leg hardly move, all of them together, degrees.
    LegUnused { foot: String, range: f64, required: f64 },
    /// A joint of a legless body hardly moves, degrees.
    JointUnused { joint: String, range: f64, required: f64 },
    /// There is nothing for a controller to move.
    NothingActuated,
    /// A joint swings too fast, Hz.
    TooFast { joint: String, frequency: f64, allowed: f64 },
    /// It never leaves the ground.
    NeverAloft,
    /// Its best flight is too short, s.
    ShortFlight { time: f64, seconds: f64, required: f64 },
    /// Its best flight is too low, m.
    LowFlight { time: f64, rise: f64, required: f64 },
    /// A leg has no part in its best flight.
    NoPushOff { time: f64, foot: String },
    /// The legs push off too far apart, s.
    UnevenPushOff { time: f64, spread: f64, allowed: f64 },
    /// A part that is no foot touches the ground after the jump.
    LandedOn { part: String, time: f64 },
    /// It neither stands again in the last second nor jumps on: degrees, m from the start height, body lengths/s; and the
    /// most of each that is allowed.
    NotStanding { tilt: f64, height: f64, speed: f64, allowed: [f64; 3] },
    /// The commands ask for nothing that could be judged: no hold in which it is told to move leaves so many seconds.
    NeverToldToMove { required: f64 },
    /// The mean speed over the last half of a hold is too far from the commanded one, body lengths/s; the worst of so many holds
    /// that begin at `time`.
    OffSpeed { time: f64, wanted: f64, speed: f64, allowed: f64, holds: usize, of: usize },
    /// Too small a share of a change of speed is done in time; the worst of so many changes.
    SlowAnswer { time: f64, from: f64, to: f64, share: f64, required: f64, changes: usize, of: usize },
    /// Told to stand, it moves along, body lengths/s; the worst of so many holds.
    Drifting { time: f64, speed: f64, allowed: f64, holds: usize, of: usize },
    /// So many presses are not answered by a jump; what is against the first of them follows.
    Presses { failed: usize, of: usize },
    /// It does not leave the ground in time after a press, s.
    NoJump { time: f64, allowed: f64 },
    /// It is usable in too few of the worlds that are almost the one it is judged in.
    Brittle { usable: usize, worlds: usize, required: usize },
    /// The audit flagged a cheat.
    Cheat(Cheat),
    /// What rules of another crate find: a word for files and tables, and a sentence with figure and limit.
    Other { name: String, message: String },
}

impl Reason {
    /// What kind of reason it is, as in files: "slow", "no-touchdown"; for a cheat, which.
    pub fn name(&self) -> &str {
        match self {
            Self::TooShort { .. } => "too-short",
            Self::Slow { .. } => "slow",
            Self::NoProgress { .. } => "no-progress",
            Self::Tilted { .. } => "tilted",
            Self::Swaying { .. } => "swaying",
            Self::Crouching { .. } => "crouching",
            Self::OtherContact { .. } => "other-contact",
            Self::LowStep { .. } => "low-step",
            Self::Slipping { .. } => "slipping",
            Self::Irregular { .. } => "irregular",
            Self::NoTouchdown { .. } => "no-touchdown",
            Self::NoLiftoff { .. } => "no-liftoff",
            Self::LegUnused { .. } => "leg-unused",
            Self::JointUnused { .. } => "joint-unused",
            Self::NothingActuated => "nothing-actuated",
            Self::TooFast { .. } => "too-fast",
            Self::NeverAloft => "never-aloft",
            Self::ShortFlight { .. } => "short-flight",
            Self::LowFlight { .. } => "low-flight",
            Self::NoPushOff { .. } => "no-push-off",
            Self::UnevenPushOff { .. } => "uneven-push-off",
            Self::LandedOn { .. } => "landed-on",
            Self::NotStanding { .. } => "not-standing",
            Self::NeverToldToMove { .. } => "never-told-to-move",
            Self::OffSpeed { .. } => "off-speed",
            Self::SlowAnswer { .. } => "slow-answer",
            Self::Drifting { .. } => "drifting",
            Self::Presses { .. } => "presses",
            Self::NoJump { .. } => "no-jump",
            Self::Brittle { .. } => "brittle",
            Self::Cheat(cheat) => cheat.kind.name(),
            Self::Other { name, .. } => name,
        }
    }

    /// A reason of rules of one's own. `name`: lower case, hyphens, as [`name`](Self::name) tells it; `message`: a sentence
    /// with the figure and the limit.
    pub fn other(name: &str, message: impl Into<String>) -> Self {
        Self::Other { name: name.into(), message: message.into() }
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooShort { seconds, required } => {
                write!(f, "the episode lasted {seconds:.1} s, shorter than the {required:.0} s to be judged")
            }
            Self::Slow { speed, required } => {
                write!(f, "second half: {speed:.2} body lengths/s, at least {required} required")
            }
            Self::NoProgress { quarter, second_half, progress } => {
                let whole = if *second_half { "the second half" } else { "the episode" };
                write!(f, "quarter {quarter} of {whole}: {progress:.2} m, some way forward required")
            }
            Self::Tilted { tilt, allowed, time } => {
                write!(f, "torso: tilted by {tilt:.0}° at {time:.1} s, at most {allowed:.0}° allowed")
            }
            Self::Swaying { deviation, allowed } => {
                write!(f, "torso: sways by {deviation:.1}° (standard deviation), at most {allowed:.0}° allowed")
            }
            Self::Crouching { height, required, time } => {
                write!(f, "torso: at {height:.2} of its start height at {time:.1} s, at least {required} required")
            }
            Self::OtherContact { part, share, allowed } => {
                let (share, allowed) = (100.0 * share, 100.0 * allowed);
                write!(
                    f,
                    "parts that are no feet touch the ground {share:.1} % of the time, {part} most; at most {allowed:.0} % \
                     allowed"
                )
            }
            Self::LowStep { foot, clearance, required } => {
                write!(f, "{foot}: rises by {clearance:.3} m in a step, at least {required:.3} m required")
            }
            Self::Slipping { slip, allowed } => {
                write!(f, "feet slip by {slip:.2} m for each metre, at most {allowed} m allowed")
            }
            Self::Irregular { regularity, required } => {
                write!(
                    f,
                    "strides repeat themselves with a regularity of {regularity:.2}, at least {required} required"
                )
            }
            Self::NoTouchdown { foot, seconds, allowed } => {
                write!(f, "{foot}: no touchdown for {seconds:.1} s, at most {allowed:.0} s allowed")
            }
            Self::NoLiftoff { foot, seconds, allowed } => {
                write!(f, "{foot}: did not leave the ground for {seconds:.1} s, at most {allowed:.0} s allowed")
            }
            Self::LegUnused { foot, range, required } => {
                write!(
                    f,
                    "{foot}: the joints of its leg move by {range:.0}° in all in the second half, at least {required:.0}° required"
                )
            }
            Self::JointUnused { joint, range, required } => {
                write!(
                    f,
                    "{joint}: its joint moves by {range:.0}° in the second half, at least {required:.0}° required"
                )
            }
            Self::NothingActuated => write!(f, "the body has no motor that a controller moves"),
            Self::TooFast { joint, frequency, allowed } => {
                write!(f, "{joint}: its joint swings at {frequency:.1} Hz, at most {allowed:.0} Hz allowed")
            }
            Self::NeverAloft => write!(f, "some part always touched the ground"),
            Self::ShortFlight { time, seconds, required } => {
                write!(f, "jump at {time:.1} s: {seconds:.2} s off the ground, at least {required} s required")
            }
            Self::LowFlight { time, rise, required } => {
                write!(f, "jump at {time:.1} s: centre of mass rose {rise:.2} m, at least {required:.2} m required")
            }
            Self::NoPushOff { time, foot } => write!(f, "jump at {time:.1} s: {foot} did not push off"),
            Self::UnevenPushOff { time, spread, allowed } => {
                write!(f, "jump at {time:.1} s: the legs pushed off {spread:.2} s apart, at most {allowed} s allowed")
            }
            Self::LandedOn { part, time } => {
                write!(f, "{part}: touches the ground at {time:.1} s, after the jump; only feet may")
            }
            Self::NotStanding { tilt, height, speed, allowed: [most_tilt, most_height, most_speed] } => {
                write!(
                    f,
                    "last second: neither stands nor jumps on: tilted by {tilt:.0}° (at most {most_tilt:.0}°), {height:.2} m off \
                     its start height (at most {most_height:.2} m), {speed:.2} body lengths/s (at most {most_speed})"
                )
            }
            Self::NeverToldToMove { required } => write!(
                f,
                "never told to move for long enough: no hold that tells it to has {required} s outside of jumps in its last half, \
                 one required"
            ),
            Self::OffSpeed { time, wanted, speed, allowed, holds, of } => write!(
                f,
                "told to move at {wanted:.2} body lengths/s from {time:.1} s on: {speed:.2} over the last half, at most \
                 {allowed:.2} off allowed; too far off in {holds} of {of} holds"
            ),
            Self::SlowAnswer { time, from, to, share, required, changes, of } => write!(
                f,
                "told to go from {from:.2} to {to:.2} body lengths/s at {time:.1} s: {:.0} % of it done within 1.2 s, at least \
                 {:.0} % required; too slow in {changes} of {of} changes",
                100.0 * share,
                100.0 * required
            ),
            Self::Drifting { time, speed, allowed, holds, of } => write!(
                f,
                "told to stand from {time:.1} s on: moves at {speed:.2} body lengths/s over the last half, at most {allowed} \
                 allowed; does so in {holds} of {of} holds"
            ),
            Self::Presses { failed, of } => write!(f, "{failed} of {of} presses are not answered by a jump"),
            Self::NoJump { time, allowed } => {
                write!(f, "told to jump at {time:.1} s: does not leave the ground within {allowed} s")
            }
            Self::Brittle { usable, worlds, required } => {
                write!(f, "usable in {usable} of {worlds} near worlds, at least {required} required")
            }
            Self::Cheat(cheat) => write!(f, "{cheat}"),
            Self::Other { message, .. } => write!(f, "{message}"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::CheatKind;

    #[test]
    fn names_are_those_of_files() {
        let foot = || "foot".to_owned();
        let reasons = [
            Reason::TooShort { seconds: 1.0, required: 2.0 },
            Reason::Slow { speed: 0.0, required: 1.0 },
            Reason::NoProgress { quarter: 1, second_half: false, progress: 0.0 },
            Reason::Tilted { tilt: 91.0, allowed: 90.0, time: 0.0 },
            Reason::NoTouchdown { foot: foot(), seconds: 4.0, allowed: 3.0 },
            Reason::NoLiftoff { foot: foot(), seconds: 4.0, allowed: 3.0 },
            Reason::LegUnused { foot: foot(), range: 0.0, required: 1.0 },
            Reason::JointUnused { joint: foot(), range: 0.0, required: 1.0 },
            Reason::NothingActuated,
            Reason::TooFast { joint: foot(), frequency: 6.0, allowed: 5.0 },
            Reason::NeverAloft,
            Reason::ShortFlight { time: 0.0, seconds: 0.0, required: 1.0 },
            Reason::LowFlight { time: 0.0, rise: 0.0, required: 1.0 },
            Reason::NoPushOff { time: 0.0, foot: foot() },
            Reason::UnevenPushOff { time: 0.0, spread: 1.0, allowed: 0.3 },
            Reason::NeverToldToMove { required: 0.5 },
            Reason::OffSpeed { time: 0.0, wanted: 1.0, speed: 0.0, allowed: 0.2, holds: 1, of: 1 },
            Reason::SlowAnswer { time: 0.0, from: 0.0, to: 1.0, share: 0.0, required: 0.7, changes: 1, of: 1 },
            Reason::Drifting { time: 0.0, speed: 1.0, allowed: 0.1, holds: 1, of: 1 },
            Reason::Presses { failed: 1, of: 2 },
            Reason::NoJump { time: 0.0, allowed: 0.5 },
        ];
        for reason in reasons {
            let written = serde_json::to_value(&reason).expect("plain data");
            let tag = written.as_str().or_else(|| written.as_object()?.keys().next().map(String::as_str));
            assert_eq!(tag, Some(reason.name()));
        }
        for kind in [
            CheatKind::JointSeparation,
            CheatKind::LimitViolation,
            CheatKind::SpeedCap,
            CheatKind::SpinCap,
            CheatKind::EnergyFromNowhere,
            CheatKind::Tunnelling,
            CheatKind::Vibration,
            CheatKind::Chatter,
            CheatKind::FrictionRatchet,
            CheatKind::Fall,
            CheatKind::Toppling,
            CheatKind::BallisticLimb,
        ] {
            assert_eq!(serde_json::to_value(kind).expect("plain data"), kind.name());
        }
    }
}
