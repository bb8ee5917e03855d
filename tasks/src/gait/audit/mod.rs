//! The cheat audit: gaits that live on the errors of a physics engine, or on something else than moving. One file a
//! cheat, each with its thresholds and the reason for them.
//!
//! Soft joints, overshooting limits and feet that sink in a little are ordinary in strong, honest gaits, and are not
//! flagged: thresholds lie well above what good gaits show, and most ask that it lasts.

mod ballistic_limb;
mod energy;
mod fall;
mod limits;
mod ratchet;
mod separation;
mod speed_cap;
mod sustained;
mod tunnelling;
mod vibration;

use super::{JointUse, Trajectory, View};
use serde::{Deserialize, Serialize};
use std::fmt;

/// A way to cheat.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum CheatKind {
    /// A joint came apart, m.
    JointSeparation,
    /// A joint went beyond its limits, degrees.
    LimitViolation,
    /// A part was as fast as the engine lets it be, m/s.
    SpeedCap,
    /// A part span as fast as the engine lets it, rad/s.
    SpinCap,
    /// The body gained more energy than its motors gave, J.
    EnergyFromNowhere,
    /// A part got deep into the ground, m.
    Tunnelling,
    /// A joint swings faster than the eye follows, Hz.
    Vibration,
    /// A joint turns back more often than the eye follows, 1/s.
    Chatter,
    /// It gets ahead without a step, body lengths/s.
    FrictionRatchet,
    /// Most of the distance was made by falling or lying, share.
    Fall,
    /// It only toppled, m.
    Toppling,
    /// A limb is thrown rather than driven, share of the time.
    BallisticLimb,
}

impl CheatKind {
    /// Its name, as in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::JointSeparation => "joint-separation",
            Self::LimitViolation => "limit-violation",
            Self::SpeedCap => "speed-cap",
            Self::SpinCap => "spin-cap",
            Self::EnergyFromNowhere => "energy-from-nowhere",
            Self::Tunnelling => "tunnelling",
            Self::Vibration => "vibration",
            Self::Chatter => "chatter",
            Self::FrictionRatchet => "friction-ratchet",
            Self::Fall => "fall",
            Self::Toppling => "toppling",
            Self::BallisticLimb => "ballistic-limb",
        }
    }

    /// The unit of its figures: "m", "1" for a share.
    pub fn unit(self) -> &'static str {
        match self {
            Self::JointSeparation | Self::Tunnelling | Self::Toppling => "m",
            Self::LimitViolation => "°",
            Self::SpeedCap => "m/s",
            Self::SpinCap => "rad/s",
            Self::EnergyFromNowhere => "J",
            Self::Vibration => "Hz",
            Self::Chatter => "1/s",
            Self::FrictionRatchet => "body lengths/s",
            Self::Fall | Self::BallisticLimb => "1",
        }
    }
}

/// A cheat the audit flagged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cheat {
    /// Which.
    pub kind: CheatKind,
    /// The part that does it, or that hangs on the joint that does; the torso for the body as a whole.
    pub part: String,
    /// The worst figure measured, in the kind's [unit](CheatKind::unit).
    pub worst: f64,
    /// The figure it had to exceed (toppling: to stay within) to be flagged.
    pub threshold: f64,
    /// When the worst was, or when it began for what lasts, s.
    #[serde(rename = "time_s")]
    pub time: f64,
}

impl fmt::Display for Cheat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, part, worst, threshold, time } = self;
        match kind {
            CheatKind::JointSeparation => {
                write!(f, "cheat: {part}: its joint came apart by {worst:.3} m at {time:.2} s (limit {threshold:.3} m)")
            }
            CheatKind::LimitViolation => write!(
                f,
                "cheat: {part}: its joint was {worst:.0}° beyond its limits at {time:.2} s (tolerance {threshold:.0}°)"
            ),
            CheatKind::SpeedCap => {
                write!(f, "cheat: {part}: moved at {worst:.0} m/s at {time:.2} s (cap {threshold:.0} m/s)")
            }
            CheatKind::SpinCap => {
                write!(f, "cheat: {part}: span at {worst:.0} rad/s at {time:.2} s (cap {threshold:.0} rad/s)")
            }
            CheatKind::EnergyFromNowhere => write!(
                f,
                "cheat: energy from nowhere: {worst:.0} J more than the motors' work until {time:.2} s (tolerance {threshold:.0} J)"
            ),
            CheatKind::Tunnelling => {
                write!(f, "cheat: {part}: {worst:.2} m deep in the ground at {time:.2} s (tolerance {threshold:.2} m)")
            }
            CheatKind::Vibration => {
                write!(f, "cheat: {part}: its joint vibrates at {worst:.1} Hz (limit {threshold:.0} Hz)")
            }
            CheatKind::Chatter => {
                write!(f, "cheat: {part}: its joint turns back {worst:.0} times a second (limit {threshold:.0})")
            }
            CheatKind::FrictionRatchet => write!(
                f,
                "cheat: slid {worst:.2} body lengths/s without a footfall from {time:.1} s on (limit {threshold})"
            ),
            CheatKind::Fall => write!(
                f,
                "cheat: {:.0} % of the distance was made after falling at {time:.1} s (limit {:.0} %)",
                100.0 * worst,
                100.0 * threshold
            ),
            CheatKind::Toppling => {
                write!(f, "cheat: only toppled over: {worst:.2} m (falling alone gives up to {threshold:.2} m)")
            }
            CheatKind::BallisticLimb => write!(
                f,
                "cheat: {part}: thrown rather than driven for {:.0} % of the time (limit {:.0} %)",
                100.0 * worst,
                100.0 * threshold
            ),
        }
    }
}

/// Every cheat found. `joints` are the trajectory's.
///
/// Getting ahead by sliding or falling is no cheat in a jump, which is not about getting ahead, nor in water, where nothing
/// else can be done.
pub(super) fn audit(trajectory: &Trajectory<'_>, joints: &[JointUse], view: View) -> Vec<Cheat> {
    let mut cheats = separation::find(trajectory);
    cheats.extend(limits::find(trajectory));
    cheats.extend(speed_cap::find(trajectory));
    cheats.extend(energy::find(trajectory));
    cheats.extend(tunnelling::find(trajectory));
    cheats.extend(vibration::find(trajectory, joints, view.goal));
    cheats.extend(ballistic_limb::find(trajectory));
    if view.must_step() {
        cheats.extend(ratchet::find(trajectory));
        cheats.extend(fall::find(trajectory));
    }
    cheats
}

/// Largest extent of a part along and across its frame, m: the longer and the shorter.
fn size(part: &crate::BodyPart) -> (f64, f64) {
    let extent = |axis: usize| {
        let along = || part.corners.iter().map(|corner| f64::from(corner[axis]));
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min) + 2.0 * f64::from(part.radius)
    };
    let (width, height) = (extent(0), extent(1));
    (width.max(height), width.min(height))
}

#[cfg(test)]
mod tests {
    use crate::gait::{
        GaitReport, JumpingRules, Rules, RunningRules,
        synthetic::{Pose, body, film},
    };

    #[test]
    fn honest_gaits_are_not_flagged() {
        let (walk, jump) = (film(20.0, Pose::walking), film(5.0, Pose::jumping));
        let (running, jumping): (&dyn Rules, &dyn Rules) = (&RunningRules::default(), &JumpingRules);
        for (rules, film) in [(Some(running), &walk), (Some(jumping), &jump), (None, &walk), (None, &jump)] {
            let report = GaitReport::measure(&body(), film, rules).expect("a script");
            assert_eq!(report.cheats, []);
        }
    }
}
