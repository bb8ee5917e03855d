use super::{Cheat, CheatKind, size, sustained::sustained};
use crate::gait::{Trajectory, trajectory::in_world};

/// Joints are springs, and strong honest gaits stretch them by 1 to 3 cm: flagged is what is wider than 5 cm.
const WIDEST: f64 = 0.05;
/// The same in large bodies, as a share of the smaller part.
const WIDEST_SHARE: f64 = 0.1;

/// Joints whose two anchors are far apart for two steps in a row, or three times as far for one.
pub(super) fn find(trajectory: &Trajectory<'_>) -> Vec<Cheat> {
    let body = trajectory.body();
    let of_hinge = |hinge: &crate::BodyHinge| {
        let smaller = size(&body.parts[hinge.parent]).0.min(size(&body.parts[hinge.child]).0);
        let threshold = WIDEST.max(WIDEST_SHARE * smaller);
        let gaps = trajectory.snapshots().iter().map(|snapshot| {
            let [px, py] = in_world(&snapshot.parts[hinge.parent], hinge.parent_anchor);
            let [cx, cy] = in_world(&snapshot.parts[hinge.child], hinge.child_anchor);
            libm::hypot(cx - px, cy - py)
        });
        sustained(gaps, threshold).map(|worst| Cheat {
            kind: CheatKind::JointSeparation,
            part: trajectory.hinge_name(hinge).into(),
            worst: worst.figure,
            threshold,
            time: trajectory.time(worst.snapshot),
        })
    };
    body.hinges.iter().filter_map(of_hinge).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::synthetic::{Pose, body, film};

    #[test]
    fn a_joint_that_comes_apart_is_flagged() {
        let torn = film(2.0, |step| Pose { gap: if step > 50 { 0.1 } else { 0.02 }, ..Pose::standing() });
        let cheats = find(&Trajectory::new(&body(), &torn).expect("a script"));
        assert_eq!(cheats.len(), 1);
        assert_eq!(cheats[0].part, "left leg");
        assert!((cheats[0].worst - 0.1).abs() < 1e-5);
    }

    #[test]
    fn a_stretch_of_one_step_is_ordinary() {
        let stretched = film(2.0, |step| Pose { gap: if step == 50 { 0.1 } else { 0.02 }, ..Pose::walking(step) });
        assert_eq!(find(&Trajectory::new(&body(), &stretched).expect("a script")), []);
    }
}
