use super::{Interval, Trajectory, contact, joint, trajectory::in_world};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// What a leg does. It counts by its foot, its last part.
///
/// A foot that loses contact for no more than 0.03 s has not left the ground: a foot pressed down chatters for a step,
/// and a dragged foot must not look like a walking one. For touchdowns, liftoffs and clearance a foot is down that touches the
/// ground or is less than 1 % of the body length above it; stances and slip count contacts alone.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LegUse {
    /// Name of its foot.
    pub foot: String,
    /// When the foot stands: a row of a footfall diagram (Hildebrand).
    pub stances: Vec<Interval>,
    /// How often the foot came down. Standing at the start is no footfall.
    pub footfalls: usize,
    /// How often the foot left the ground.
    pub liftoffs: usize,
    /// Share of the episode the foot stands, 0 to 1.
    pub duty_factor: f64,
    /// The longest time between two touchdowns, start and end of the episode counting as such, s.
    #[serde(rename = "longest_without_touchdown_s")]
    pub longest_without_touchdown: f64,
    /// The longest time between two liftoffs, start and end of the episode counting as such, s.
    #[serde(rename = "longest_without_liftoff_s")]
    pub longest_without_liftoff: f64,
    /// How far the foot's lowest point rises between a liftoff and the next touchdown: the median of all swings, m; `None`
    /// for a foot that never swings.
    #[serde(rename = "clearance_m", default)]
    pub clearance: Option<f64>,
    /// The range of motion its joints use.
    pub joints: Vec<LegJoint>,
    /// How far the foot's point on the ground slid, forwards and backwards added up, m.
    #[serde(rename = "slip_m")]
    pub slip: f64,
    /// The same for each metre of distance; `None` without a way forward.
    pub slip_per_distance: Option<f64>,
}

/// A joint of a leg.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LegJoint {
    /// The part that hangs on it.
    pub name: String,
    /// Largest minus smallest angle, rad.
    #[serde(rename = "range_rad")]
    pub range: f64,
}

impl LegUse {
    pub(super) fn measure(trajectory: &Trajectory<'_>, leg: &[usize], foot: usize) -> Self {
        let body = trajectory.body();
        let ranges = contact::stances(trajectory, foot);
        let stances: Vec<Interval> = ranges
            .iter()
            .map(|stance| Interval::of(trajectory, stance))
            .filter(|stance| stance.seconds() > 0.0)
            .collect();
        let downs = contact::downs(trajectory, foot);
        let touchdowns = contact::touchdowns(trajectory, &downs);
        let liftoffs = contact::liftoffs(trajectory, &downs);
        let joints = body.hinges.iter().enumerate().filter(|(_, hinge)| leg.contains(&hinge.child));
        let slip: f64 = ranges.iter().map(|stance| slip(trajectory, foot, stance)).fold(0.0, |sum, slip| sum + slip);
        let distance = trajectory.progress(0, trajectory.steps());
        Self {
            foot: body.parts[foot].name.clone(),
            footfalls: touchdowns.len(),
            liftoffs: liftoffs.len(),
            duty_factor: stances.iter().map(Interval::seconds).fold(0.0, |sum, stance| sum + stance)
                / trajectory.seconds(),
            longest_without_touchdown: contact::longest_gap(trajectory, &touchdowns),
            longest_without_liftoff: contact::longest_gap(trajectory, &liftoffs),
            joints: joints
                .map(|(index, hinge)| LegJoint {
                    name: trajectory.hinge_name(hinge).into(),
                    range: joint::range(trajectory.hinge_angles(index)),
                })
                .collect(),
            clearance: clearance(trajectory, foot, &downs),
            slip,
            slip_per_distance: Some(slip / distance).filter(|slip| distance > 0.0 && slip.is_finite()),
            stances,
        }
    }
}

/// The median rise of a foot in the swings between two times it is down, m.
fn clearance(trajectory: &Trajectory<'_>, foot: usize, downs: &[RangeInclusive<usize>]) -> Option<f64> {
    let height = |step: usize| trajectory.lowest_point(foot, step);
    let swing = |pair: &[RangeInclusive<usize>]| {
        let (liftoff, touchdown) = (*pair[0].end(), *pair[1].start());
        (liftoff..=touchdown).map(height).fold(f64::NEG_INFINITY, f64::max) - height(liftoff)
    };
    let mut swings: Vec<f64> = downs.windows(2).map(swing).collect();
    swings.sort_by(f64::total_cmp);
    swings.get(swings.len() / 2).copied()
}

/// How far the point of the foot that is on the ground slides in a stance, m. A round foot that rolls does not slide:
/// the rim turns back as far as the centre moves on.
fn slip(trajectory: &Trajectory<'_>, foot: usize, stance: &RangeInclusive<usize>) -> f64 {
    let part = &trajectory.body().parts[foot];
    let mut slid = 0.0;
    for step in stance.start() + 1..=*stance.end() {
        let [before, after] = [step - 1, step].map(|step| &trajectory.snapshots()[step].parts[foot]);
        let height = |corner: &[f32; 2]| in_world(after, *corner)[1];
        let lowest = part.corners.iter().min_by(|one, other| height(one).total_cmp(&height(other)));
        let Some(&corner) = lowest else { continue };
        let turn = libm::atan2(
            f64::from(before.cos) * f64::from(after.sin) - f64::from(before.sin) * f64::from(after.cos),
            f64::from(before.cos) * f64::from(after.cos) + f64::from(before.sin) * f64::from(after.sin),
        );
        let moved = in_world(after, corner)[0] - in_world(before, corner)[0];
        slid += (moved + turn * f64::from(part.radius)).abs();
    }
    slid
}
