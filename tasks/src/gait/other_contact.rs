use super::Trajectory;
use serde::{Deserialize, Serialize};

/// How long parts that are no feet touch the ground: knees, hips, a tail, the torso.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct OtherContact {
    /// The share of the episode in which any of them does, 0 to 1.
    pub share: f64,
    /// The name of the part that does most.
    pub part: String,
    /// The share of the episode in which that part does, 0 to 1.
    pub part_share: f64,
}

impl OtherContact {
    /// `None` if no such part ever touches the ground, and for a legless body.
    pub(super) fn measure(trajectory: &Trajectory<'_>) -> Option<Self> {
        let body = trajectory.body();
        if body.legless {
            return None;
        }
        let others = body.parts_without_feet();
        // Snapshot 0 speaks of no time.
        let snapshots = &trajectory.snapshots()[1..];
        let share = |count: usize| count as f64 / snapshots.len() as f64;
        let any = snapshots.iter().filter(|snapshot| others.iter().any(|&part| snapshot.parts[part].touching)).count();
        let counts = others
            .iter()
            .map(|&part| (part, snapshots.iter().filter(|snapshot| snapshot.parts[part].touching).count()));
        // Of equals the first.
        let (part, count) = counts.rev().max_by_key(|&(_, count)| count)?;
        (any > 0).then(|| Self { share: share(any), part: body.parts[part].name.clone(), part_share: share(count) })
    }
}
