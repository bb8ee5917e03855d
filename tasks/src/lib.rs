//! What a creature has to learn, free of any physics engine.
//!
//! Three things make a [`Task`](ne_core::Task) for bodies, and each can be swapped alone:
//!
//! - an [`Environment`]: a body in a world that is reset, sensed, acted on and stepped, and tells after each step where
//!   every part is (a [`Snapshot`]),
//! - a [`Movement`]: watches the snapshots of an episode and turns them into one number,
//! - an [`Episode`]: puts a controller into the environment for a number of steps and trials, and is the task.
//!
//! The decision behind them: **a movement sees where the parts are, and little else.** It knows no engine, no creature
//! file and no controller, so a movement written once works for every creature in every engine, and fits on a page
//! ([`Running`] is one). Movements add up: [`Sum`] weighs several, so a penalty is a movement too.
//!
//! What a body is made of, its legs, hinges and masses, an environment may tell as a [`Body`]; a movement that wants to
//! know is told once, by [`Movement::bind`], and one that does not need not look.
//!
//! Beside them stand the [`classic`] tasks, XOR and pole balancing, on which strategies are compared, and [`gait`], which
//! measures what a body does in an episode, audits it for cheats and says whether it is usable.
//!
//! ```
//! use ne_core::{Phenotype, Seed, Task};
//! use tasks::{Environment, Episode, Movement, Running, Snapshot, Trials, Verdict};
//!
//! /// Run backwards.
//! #[derive(Clone, Default)]
//! struct Retreat { start: f32, now: f32 }
//! impl Movement for Retreat {
//!     fn name(&self) -> &str { "retreat" }
//!     fn unit(&self) -> &str { "m" }
//!     fn begin(&mut self, start: &Snapshot) { (self.start, self.now) = (start.torso().x, start.torso().x) }
//!     fn observe(&mut self, now: &Snapshot) -> Verdict { self.now = now.torso().x; Verdict::GoOn }
//!     fn value(&self) -> f64 { f64::from(self.start - self.now) }
//! }
//! # let _: Box<dyn Movement> = Box::new(Retreat::default());
//! ```

mod body;
mod catalogue;
pub mod classic;
mod commands;
pub mod conformance;
mod environment;
mod episode;
pub mod gait;
mod movement;
mod snapshot;
mod trials;

pub use body::{Body, BodyHinge, BodyMotor, BodyPart};
pub use catalogue::{
    Medium, MovementCatalogue, MovementEntry, MovementSettings, MovementSpec, MovementSpecError, TermSpec,
};
pub use classic::{
    Benchmark, CartPole, CartPoleSettings, DoublePole, DoublePoleSettings, Generalization, OutputRange, PoleFitness,
    Xor, XorSettings,
};
pub use commands::{Command, CommandChange, CommandSchedule, Commands, RandomCommands};
pub use environment::Environment;
pub use episode::{Episode, Moment, Played, Watcher};
pub use movement::{
    Alternation, Backwards, Carrying, Climbing, Cruising, CruisingSettings, Energy, FallEnds, Footfalls, GettingUp,
    GettingUpSettings, Haste, HasteSettings, Headway, HeadwaySettings, Hopping, Idleness, Jumping, Landing, Leap,
    LongJump, Movement, MovementClone, NoExploits, NoExploitsSettings, Objectives, Playing, PlayingSettings, Posture,
    PostureSettings, Rhythm, RhythmSettings, Rollovers, Running, Slip, Standing, StandingSettings, Sum, Swimming,
    TimeAloft, Upright, Verdict, Vibration, Walking, WalkingSettings,
};
pub use snapshot::{PartState, Snapshot};
pub use trials::{Combine, Outcome, Tally, Trial, Trials, failure_of_value};
