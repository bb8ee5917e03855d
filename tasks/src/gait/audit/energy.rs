use super::{Cheat, CheatKind, sustained::worst};
use crate::gait::Trajectory;

/// Windows up to this long are looked at, s: one push of a leg.
const WINDOW: f64 = 0.5;
/// Springs in joints and contacts lend a few J (a passive drop gains 3 J), and so does a foot pressed out of the ground.
const TOLERANCE: f64 = 10.0;
/// The same for heavy bodies, as a share of the energy of their height.
const TOLERANCE_SHARE: f64 = 0.25;

/// A body that gains more energy in a short time than its motors, and pushes against it, gave in it. Motors that brake count as if they drove,
/// so that an honest body stays well below.
pub(super) fn find(trajectory: &Trajectory<'_>) -> Option<Cheat> {
    let surplus: Vec<f64> = (0..=trajectory.steps())
        .map(|step| {
            let work = trajectory.work(step)? + trajectory.snapshots()[step].push_work;
            Some(energy(trajectory, step) - work)
        })
        .collect::<Option<_>>()?;
    let threshold = TOLERANCE + TOLERANCE_SHARE * trajectory.body().weight().abs() * trajectory.start_height();
    let steps = libm::round(WINDOW / trajectory.time_step()) as usize;
    let gains = (0..surplus.len()).map(|step| {
        let before = &surplus[step.saturating_sub(steps)..=step];
        surplus[step] - before.iter().copied().fold(f64::INFINITY, f64::min)
    });
    worst(gains).filter(|worst| worst.figure > threshold).map(|worst| Cheat {
        kind: CheatKind::EnergyFromNowhere,
        part: trajectory.body().parts[0].name.clone(),
        worst: worst.figure,
        threshold,
        time: trajectory.time(worst.snapshot),
    })
}

/// Kinetic and potential energy of all parts, J.
fn energy(trajectory: &Trajectory<'_>, step: usize) -> f64 {
    let gravity = f64::from(trajectory.body().gravity);
    let parts = trajectory.body().parts.iter().zip(&trajectory.snapshots()[step].parts);
    parts
        .map(|(part, state)| {
            let [mass, inertia, unborne] = [part.mass, part.inertia, part.unborne_mass()].map(f64::from);
            let [y, vx, vy, spin] = [state.y, state.vx, state.vy, state.spin].map(f64::from);
            0.5 * mass * (vx * vx + vy * vy) + 0.5 * inertia * spin * spin + unborne * gravity * y
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::synthetic::{Pose, body, film};

    #[test]
    fn a_jump_without_work_is_flagged() {
        let launched = film(5.0, |step| Pose { work: 0.0, ..Pose::jumping(step) });
        let cheat = find(&Trajectory::new(&body(), &launched).expect("a script")).expect("flagged");
        // 12 kg at 3 m/s.
        assert!((cheat.worst - 54.0).abs() < 6.0, "{cheat}");
    }

    #[test]
    fn what_pushes_give_is_not_gained() {
        let mut pushed = film(5.0, |step| Pose { work: 0.0, ..Pose::jumping(step) });
        let (body, unaware) = (body(), pushed.clone());
        let trajectory = Trajectory::new(&body, &unaware).expect("a script");
        for (step, snapshot) in pushed.iter_mut().enumerate() {
            snapshot.push_work = energy(&trajectory, step);
        }
        assert_eq!(find(&Trajectory::new(&body, &pushed).expect("a script")), None);
    }

    #[test]
    fn a_fall_gains_nothing() {
        let falling = film(0.4, |step| {
            let time = step as f64 * 0.02;
            Pose { y: 5.0 - 0.5 * 9.81 * time * time, touching: [false; 3], ..Pose::standing() }
        });
        assert_eq!(find(&Trajectory::new(&body(), &falling).expect("a script")), None);
    }

    #[test]
    fn without_knowing_the_work_nothing_is_said() {
        let launched = film(5.0, |step| Pose { work: 0.0, ..Pose::jumping(step) });
        assert_eq!(find(&Trajectory::from_positions(&body(), &launched).expect("a script")), None);
    }
}
