//! What a champion did, step by step: recorded, digested, written as CSV and read from it.

mod csv;
mod play;
mod replay;

pub use csv::{COMMAND_COLUMNS, CsvError, CsvTrajectory, read_csv};
pub(crate) use replay::replay;

use ne_core::digest::Digest;
use ne_net::Network;
use serde::{Deserialize, Serialize};
use tasks::{Moment, Snapshot, Watcher};

/// A fingerprint of a trajectory that also knows, for any other trajectory, the first step at which the two differ.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TrajectoryDigest {
    /// Steps of the trajectory, the start not counted.
    pub steps: u32,
    /// The digest of the position and rotation of every part at the start and after every step.
    pub digest: String,
    /// Eight hexadecimal digits for the start and for each step: the low half of the digest so far.
    pub marks: String,
}

const MARK: usize = 8;

impl TrajectoryDigest {
    /// The first step (0: the start) at which `other` is not the same, or `None` if the two are the same. Where all marks
    /// agree, and the digests of the whole do not, it is the last.
    pub fn first_difference(&self, other: &Self) -> Option<u32> {
        if self == other {
            return None;
        }
        let marks = |digest: &Self| digest.marks.as_bytes().chunks(MARK).map(<[u8]>::to_vec).collect::<Vec<_>>();
        let (mine, others) = (marks(self), marks(other));
        let same = mine.iter().zip(&others).take_while(|(a, b)| a == b).count();
        let known = mine.len().max(others.len()).saturating_sub(1);
        u32::try_from(same.min(known)).ok()
    }
}

/// Digests a trajectory while it is played.
#[derive(Clone, Debug, Default)]
pub struct TrajectoryDigester {
    digest: Digest,
    steps: u32,
    marks: String,
}

impl TrajectoryDigester {
    /// The digest of what has been seen.
    pub fn finish(self) -> TrajectoryDigest {
        TrajectoryDigest { steps: self.steps, digest: self.digest.to_string(), marks: self.marks }
    }
}

impl Watcher for TrajectoryDigester {
    fn watch(&mut self, moment: &Moment<'_>) {
        for part in &moment.snapshot.parts {
            for value in [part.x, part.y, part.cos, part.sin] {
                self.digest.add_f32(value);
            }
        }
        self.steps = moment.step;
        let low = self.digest.value() & u64::from(u32::MAX);
        self.marks.push_str(&format!("{low:08x}"));
    }
}

/// Everything a replay shows, for the start and for every step.
#[derive(Clone, Debug, Default)]
pub struct Recording {
    /// Where every part was.
    pub snapshots: Vec<Snapshot>,
    /// The activation of every node of the net, inputs first, in the order they are computed; empty if the controller
    /// does not show them.
    pub activations: Vec<Vec<f32>>,
    /// The torque each motor gave in the step that led there, N·m, in order of the controller's outputs; empty if it was not
    /// [played](Self::play) but watched.
    pub torques: Vec<Vec<f32>>,
}

impl Watcher for Recording {
    fn watch(&mut self, moment: &Moment<'_>) {
        self.snapshots.push(moment.snapshot.clone());
        let phenotype: &dyn std::any::Any = moment.phenotype;
        if let Some(network) = phenotype.downcast_ref::<Network>() {
            self.activations.push(network.activations());
        }
    }
}
