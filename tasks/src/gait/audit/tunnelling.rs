use super::{Cheat, CheatKind, size, sustained::sustained_or_beyond};
use crate::gait::{Trajectory, trajectory::in_world};

/// Flagged is what is ever deeper than this, m: a foot that comes down fast goes in by 5 to 8 cm in a single step, before
/// the ground can answer,
const DEEPEST: f64 = 0.1;
/// or for two steps in a row deeper than half of the part's smaller side,
const DEEPEST_SHARE: f64 = 0.5;
/// but not, in thin parts, what is ordinary: feet sink in by 1 to 4 cm.
const ORDINARY: f64 = 0.05;

/// Parts deep in the ground.
pub(super) fn find(trajectory: &Trajectory<'_>) -> Vec<Cheat> {
    if !trajectory.is_flat() {
        return Vec::new();
    }
    let of_part = |(index, part): (usize, &crate::BodyPart)| {
        let threshold = DEEPEST.min(DEEPEST_SHARE * size(part).1).max(ORDINARY);
        let depths = trajectory.snapshots().iter().map(|snapshot| {
            let height = |&corner: &[f32; 2]| in_world(&snapshot.parts[index], corner)[1];
            f64::from(part.radius) - part.corners.iter().map(height).fold(f64::INFINITY, f64::min)
        });
        sustained_or_beyond(depths, threshold, DEEPEST).map(|worst| Cheat {
            kind: CheatKind::Tunnelling,
            part: part.name.clone(),
            worst: worst.figure,
            threshold,
            time: trajectory.time(worst.snapshot),
        })
    };
    trajectory.body().parts.iter().enumerate().filter_map(of_part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::{
        GroundProfile,
        synthetic::{Pose, body, film},
    };

    #[test]
    fn a_foot_deep_in_the_ground_is_flagged() {
        // The feet of the standing puppet are 5 cm above the ground.
        let sunk = |depth: f64| film(1.0, |step| Pose { y: 0.75 - depth, ..Pose::walking(step) });
        let (body, deep, ordinary) = (body(), sunk(0.08), sunk(0.02));
        let deep = find(&Trajectory::new(&body, &deep).expect("a script"));
        assert_eq!(deep.iter().map(|cheat| &cheat.part[..]).collect::<Vec<_>>(), ["left leg", "right leg"]);
        assert_eq!(find(&Trajectory::new(&body, &ordinary).expect("a script")), []);
    }

    #[test]
    fn on_terrain_the_ground_may_be_lower() {
        let sunk = film(1.0, |step| Pose { y: 0.3, ..Pose::walking(step) });
        let pit = GroundProfile::flat(-1.0, [-1.0, 9.0]);
        assert_eq!(find(&Trajectory::new(&body(), &sunk).expect("a script").on_terrain(pit)), []);
    }
}
