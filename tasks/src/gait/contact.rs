use super::Trajectory;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// A foot that is off the ground no longer than this, in s, has not left it: pressed feet chatter for a step.
const CHATTER: f64 = 0.03;
/// A foot that is lower than this share of the body length over the ground has come down, whether it presses or not. Of ten
/// feet on stiff ground the longest legs bear the weight, and the others step to within a few millimetres of it: the eye sees
/// no difference.
const DOWN: f64 = 0.01;

/// A stretch of time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Interval {
    /// When it begins, s.
    #[serde(rename = "from_s")]
    pub from: f64,
    /// When it ends, s.
    #[serde(rename = "to_s")]
    pub to: f64,
}

impl Interval {
    /// How long it lasts, s.
    pub fn seconds(&self) -> f64 {
        self.to - self.from
    }

    /// The time of which these snapshots speak.
    pub(super) fn of(trajectory: &Trajectory<'_>, snapshots: &RangeInclusive<usize>) -> Self {
        let from = trajectory.time(snapshots.start().saturating_sub(1));
        Self { from, to: trajectory.time(*snapshots.end()) }
    }
}

/// The ranges of snapshots in which something holds.
pub(super) fn ranges(holds: impl Iterator<Item = bool>) -> Vec<RangeInclusive<usize>> {
    let mut ranges: Vec<RangeInclusive<usize>> = Vec::new();
    for (index, _) in holds.enumerate().filter(|&(_, holds)| holds) {
        match ranges.last_mut() {
            Some(range) if *range.end() + 1 == index => *range = *range.start()..=index,
            _ => ranges.push(index..=index),
        }
    }
    ranges
}

/// The snapshots in which a part touches the ground, to the step.
pub(super) fn contacts(trajectory: &Trajectory<'_>, part: usize) -> Vec<RangeInclusive<usize>> {
    ranges(trajectory.snapshots().iter().map(|snapshot| snapshot.parts[part].touching))
}

/// The stances of a part: its contacts, with chatter joined up.
pub(super) fn stances(trajectory: &Trajectory<'_>, part: usize) -> Vec<RangeInclusive<usize>> {
    joined(trajectory, contacts(trajectory, part))
}

/// When a foot is down: it touches the ground, or is as good as on it. Chatter is joined up.
pub(super) fn downs(trajectory: &Trajectory<'_>, foot: usize) -> Vec<RangeInclusive<usize>> {
    let near = DOWN * f64::from(trajectory.body().body_length);
    let down = |step: usize| {
        let touches = trajectory.snapshots()[step].parts[foot].touching;
        touches || trajectory.clearance(foot, step).is_some_and(|clearance| clearance < near)
    };
    joined(trajectory, ranges((0..=trajectory.steps()).map(down)))
}

/// Ranges of snapshots with chatter joined up.
fn joined(trajectory: &Trajectory<'_>, contacts: Vec<RangeInclusive<usize>>) -> Vec<RangeInclusive<usize>> {
    let mut stances: Vec<RangeInclusive<usize>> = Vec::new();
    for contact in contacts {
        match stances.last_mut() {
            Some(last) if trajectory.time(contact.start() - last.end() - 1) <= CHATTER => {
                *last = *last.start()..=*contact.end();
            }
            _ => stances.push(contact),
        }
    }
    stances
}

/// When stances begin, s. One that the episode begins with has not begun.
pub(super) fn touchdowns(trajectory: &Trajectory<'_>, stances: &[RangeInclusive<usize>]) -> Vec<f64> {
    stances.iter().filter(|stance| *stance.start() > 0).map(|stance| Interval::of(trajectory, stance).from).collect()
}

/// When stances end, s. One that the episode ends with has not ended.
pub(super) fn liftoffs(trajectory: &Trajectory<'_>, stances: &[RangeInclusive<usize>]) -> Vec<f64> {
    stances
        .iter()
        .filter(|stance| *stance.end() < trajectory.steps())
        .map(|stance| Interval::of(trajectory, stance).to)
        .collect()
}

/// The longest time between two consecutive events, the start and the end of the episode being events too, s.
pub(super) fn longest_gap(trajectory: &Trajectory<'_>, events: &[f64]) -> f64 {
    let mut last = 0.0;
    let mut longest: f64 = 0.0;
    for &event in events.iter().chain([&trajectory.seconds()]) {
        longest = longest.max(event - last);
        last = event;
    }
    longest
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::{
        GroundProfile,
        synthetic::{Pose, body, film},
    };

    #[test]
    fn a_foot_a_hair_above_the_ground_is_down_on_flat_ground_and_on_a_mound() {
        // Nothing touches; the lowest points of the feet come as low as 4 mm above the ground, every second, by 5 cm.
        let hovering = |ground: f64| {
            film(3.0, move |step| {
                let phase = step as f64 * super::super::synthetic::TIME_STEP * std::f64::consts::TAU;
                let lift = 0.029 + 0.025 * libm::cos(phase);
                Pose { y: 0.75 + ground, touching: [false; 3], lift: [lift; 2], ..Pose::standing() }
            })
        };
        let body = body();
        let counted = |snapshots: &[crate::Snapshot], mound: Option<f32>| {
            let trajectory = Trajectory::new(&body, snapshots).expect("a script");
            let mounds = |height| {
                let mut ground = GroundProfile::flat(0.0, [-5.0, 5.0]);
                ground.raise([-1.0, 1.0], |_| height);
                ground
            };
            let trajectory = match mound {
                Some(height) => trajectory.on_terrain(mounds(height)),
                None => trajectory,
            };
            downs(&trajectory, 1).len()
        };
        let (flat, raised) = (hovering(0.0), hovering(0.02));
        assert_eq!([counted(&flat, None), counted(&raised, None)], [3, 0]);
        assert_eq!([counted(&raised, Some(0.02)), counted(&flat, Some(-0.1)), counted(&raised, Some(0.0))], [3, 3, 0]);
    }
}
