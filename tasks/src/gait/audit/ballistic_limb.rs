use super::{Cheat, CheatKind};
use crate::gait::{Trajectory, contact};

/// A motor that holds back a limb lets it run a little faster than its top speed; not twice as fast.
const TIMES_TOP_SPEED: f64 = 2.0;
/// A knock at touchdown is over sooner, degrees.
const SWEEP: f64 = 60.0;
/// The largest share of the time that may go like this.
const LARGEST_SHARE: f64 = 0.2;

/// Limbs thrown by impulses: a joint that, for much of the time, runs at more than twice its motor's top speed in sweeps
/// of more than 60°.
pub(super) fn find(trajectory: &Trajectory<'_>) -> Vec<Cheat> {
    let of_hinge = |(index, hinge): (usize, &crate::BodyHinge)| {
        let fastest = TIMES_TOP_SPEED * f64::from(hinge.motor?.top_speed).abs();
        let too_fast = (0..=trajectory.steps()).map(|step| trajectory.hinge_speed(hinge, step).abs() > fastest);
        let angles = trajectory.hinge_angles(index);
        let thrown: Vec<_> = contact::ranges(too_fast)
            .into_iter()
            .filter(|sweep| {
                let swept = angles[*sweep.end()] - angles[sweep.start().saturating_sub(1)];
                swept.abs().to_degrees() > SWEEP
            })
            .collect();
        let steps: usize = thrown.iter().map(|sweep| sweep.end() - sweep.start().saturating_sub(1)).sum();
        let share = steps as f64 / trajectory.steps() as f64;
        let first = thrown.first().filter(|_| share > LARGEST_SHARE)?;
        Some(Cheat {
            kind: CheatKind::BallisticLimb,
            part: trajectory.hinge_name(hinge).into(),
            worst: share,
            threshold: LARGEST_SHARE,
            time: trajectory.time(*first.start()),
        })
    };
    trajectory.body().hinges.iter().enumerate().filter_map(of_hinge).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::synthetic::{Pose, body, film};

    use std::f64::consts::TAU;

    /// A hip that swings by 1.2 rad to either side, some times a second.
    fn swinging(hertz: f64) -> Vec<Cheat> {
        let thrown = film(20.0, |step| {
            let angle = 1.2 * libm::sin(TAU * hertz * step as f64 * 0.02);
            Pose { hips: [angle, Pose::walking(step).hips[1]], ..Pose::walking(step) }
        });
        find(&Trajectory::new(&body(), &thrown).expect("a script"))
    }

    #[test]
    fn a_limb_far_faster_than_its_motor_is_flagged() {
        let cheats = swinging(4.0);
        assert_eq!(cheats.iter().map(|cheat| &cheat.part[..]).collect::<Vec<_>>(), ["left leg"]);
        assert!(cheats[0].worst > 0.3, "{}", cheats[0]);
    }

    #[test]
    fn a_limb_as_fast_as_its_motor_is_driven() {
        assert_eq!(swinging(1.0), []);
    }
}
