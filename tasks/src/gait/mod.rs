//! Good gaits, measured: what a champion does with its body, whether it cheats, and whether a game can use it.
//!
//! Distance alone rewards cheating. A [`GaitReport`] takes a body and the snapshots of an episode and tells the rest:
//! speed, cost of transport, uprightness, footfalls, the use of each leg and joint, slip and rhythm. Its audit looks for
//! [`Cheat`]s, gaits that live on the errors of a physics engine, and its [`Judgement`] says whether the gait is *usable*,
//! with the reasons if it is not.
//!
//! Like a movement, a report sees where the parts are, and nothing else: snapshots of any engine will do, and so will
//! recorded positions ([`Trajectory::from_positions`]).
//!
//! Three conventions hold everywhere:
//! - **A snapshot speaks of the step that led to it.** A part that touches in snapshots 5 to 7 is on the ground from the
//!   time of snapshot 4 to that of snapshot 7. Times are seconds since snapshot 0.
//! - **The window** is where rhythm is measured: the second half of the episode, or all of it for a jump.
//! - **The ground is flat, at height 0,** unless [`Trajectory::on_terrain`] says otherwise.
//!
//! ```
//! use tasks::gait::{GaitReport, RunningRules};
//! # fn report(body: &tasks::Body, snapshots: &[tasks::Snapshot]) -> Result<(), tasks::gait::GaitError> {
//! let report = GaitReport::measure(body, snapshots, Some(&RunningRules::default()))?;
//! for reason in report.verdict.iter().flat_map(|verdict| &verdict.reasons) {
//!     // "left leg: no touchdown for 5.2 s, at most 1 s allowed"
//!     let _ = reason.to_string();
//! }
//! # Ok(())
//! # }
//! ```

mod audit;
mod contact;
mod error;
mod flight;
mod fourier;
mod ground;
mod joint;
mod judgement;
mod leg;
mod other_contact;
mod reason;
mod report;
mod rhythm;
mod rules;
mod spectrum;
mod torso;
mod trajectory;
mod travel;

#[cfg(test)]
mod synthetic;
#[cfg(test)]
mod tests;

pub use audit::{Cheat, CheatKind};
pub use contact::Interval;
pub use error::GaitError;
pub use flight::{Aloft, Flight};
pub use ground::GroundProfile;
pub use joint::JointUse;
pub use judgement::{
    Judgement, JumpingRules, NEAR_WORLDS, NEAR_WORLDS_REQUIRED, NearWorlds, PlayingRules, RunningRules, SwimmingRules,
};
pub use leg::{LegJoint, LegUse};
pub use other_contact::OtherContact;
pub use reason::Reason;
pub use report::GaitReport;
pub use rhythm::Rhythm;
pub use rules::{Findings, Goal, Rules, View};
pub use torso::Uprightness;
pub use trajectory::Trajectory;
pub use travel::Travel;
