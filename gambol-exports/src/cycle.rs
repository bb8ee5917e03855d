//! The cycle of a gait: the stride that meets itself best, made to meet itself exactly.

use crate::{ExportError, Pose};
use creatures::Blueprint;
use gambol_runs::{Registry, champion::Champion, judge::Judge, trajectory::Recording};
use tasks::{Body, Environment, Snapshot, gait::GaitReport};

/// One stride, without its last pose, which is its first.
#[derive(Clone, Debug, PartialEq)]
pub struct Cycle {
    /// How long it is, s.
    pub seconds: f64,
    /// How far it takes the torso, m.
    pub travel: f64,
    /// Poses at even times; the first is at x = 0.
    pub poses: Vec<Pose>,
}

/// Strides this much shorter or longer than the gait's rhythm are tried, as a share.
const STRIDES: f64 = 0.1;
/// A stride whose ends are farther apart than this, rad, and as a share of the body length, is none.
const FARTHEST: (f64, f64) = (0.35, 0.1);
/// A rhythm weaker than this is none.
const WEAKEST: f64 = 0.5;
/// rad, and a share of the body length: what ends may differ by, were they not blended.
const NEAR: (f64, f64) = (0.035, 0.01);

impl Cycle {
    /// The cycle of a champion's gait, as `gambol gait` measures it.
    ///
    /// # Errors
    /// If its episode cannot be built or played to its end, or its gait has no cycle.
    pub fn of_champion(champion: &Champion, registry: &Registry) -> Result<Self, ExportError> {
        let judge = Judge::new(champion.episode_parts(), registry)?;
        let world = judge.environment();
        let (recording, failure) = Recording::play(world, &champion.network, judge.steps());
        if let Some(failure) = failure {
            return Err(ExportError::Failed { failure });
        }
        let flat = Body::default();
        let body = world.body().unwrap_or(&flat);
        let report = GaitReport::measure(body, &recording.snapshots, judge.rules().map(AsRef::as_ref))?;
        let strength = report.rhythm.strength;
        let stride = report.rhythm.stride_time.filter(|_| strength >= WEAKEST);
        let (blueprint, swims) = (world.blueprint(), world.settings().water.is_some());
        stride
            .and_then(|stride| Self::find(blueprint, &recording.snapshots, world.time_step().into(), stride))
            .map(|cycle| if swims { cycle.at_height(blueprint.parts()[0].y.into()) } else { cycle })
            .ok_or(ExportError::NoCycle { strength })
    }

    /// The same, higher or lower, so that the torso is at this height in the mean, m: how high a swimmer is by then says nothing.
    fn at_height(mut self, height: f64) -> Self {
        let mean = self.poses.iter().map(|pose| pose.y).sum::<f64>() / self.poses.len() as f64;
        self.poses.iter_mut().for_each(|pose| pose.y += height - mean);
        self
    }

    /// The best cycle in the second half of a gait, about as long as a stride takes, s.
    pub fn find(blueprint: &Blueprint, snapshots: &[Snapshot], time_step: f64, stride: f64) -> Option<Self> {
        let second_half = &snapshots[snapshots.len() / 2..];
        let poses: Vec<Pose> = second_half.iter().map(|snapshot| Pose::of(blueprint, snapshot)).collect();
        let steps = |seconds: f64| (seconds / time_step).round() as usize;
        let lengths = steps((1.0 - STRIDES) * stride).max(2)..=steps((1.0 + STRIDES) * stride);
        let body_length = f64::from(blueprint.body_length());
        let apart = |one: usize, other: usize| {
            let (angle, height) = poses[one].difference(&poses[other]);
            (angle / NEAR.0).max(height / (NEAR.1 * body_length))
        };
        // With the poses that follow: what meets itself must also move alike.
        let ends =
            |(start, length): (usize, usize)| apart(start, start + length) + apart(start + 1, start + length + 1);
        let starts = |length: usize| 0..poses.len().saturating_sub(length + 1);
        let candidates = lengths.flat_map(|length| starts(length).map(move |start| (start, length)));
        let (start, length) = candidates.min_by(|&one, &other| ends(one).total_cmp(&ends(other)))?;
        let (angle, height) = poses[start].difference(&poses[start + length]);
        if angle > FARTHEST.0 || height > FARTHEST.1 * body_length {
            return None;
        }
        Some(Self::blended(&poses[start..=start + length], length as f64 * time_step))
    }

    /// What the ends differ by is spread over all poses.
    fn blended(poses: &[Pose], seconds: f64) -> Self {
        let (first, last) = (&poses[0], &poses[poses.len() - 1]);
        let travel = last.x - first.x;
        let blend = |(index, pose): (usize, &Pose)| {
            let share = index as f64 / (poses.len() - 1) as f64;
            // Where the end would have to be, and so by how much each pose is moved on the way there.
            let wanted = Pose { x: last.x, ..first.clone() };
            let moved = last.towards(&wanted, share);
            Pose {
                x: pose.x - first.x,
                y: pose.y + moved.y - last.y,
                angle: pose.angle + moved.angle - last.angle,
                hinges: pose
                    .hinges
                    .iter()
                    .zip(moved.hinges.iter().zip(&last.hinges))
                    .map(|(hinge, (moved, last))| hinge + moved - last)
                    .collect(),
            }
        };
        let poses = poses[..poses.len() - 1].iter().enumerate().map(blend).collect();
        Self { seconds, travel, poses }
    }

    /// The pose at a share of the cycle, 0 to 1 and beyond, where it repeats.
    pub fn at(&self, share: f64) -> Pose {
        let place = share * self.poses.len() as f64;
        let whole = place.floor();
        let pose = |step: f64| {
            let rounds = (step / self.poses.len() as f64).floor();
            let index = (step - rounds * self.poses.len() as f64) as usize;
            let pose = &self.poses[index.min(self.poses.len() - 1)];
            Pose { x: pose.x + rounds * self.travel, ..pose.clone() }
        };
        pose(whole).towards(&pose(whole + 1.0), place - whole)
    }

    /// So many poses at even times. Without the way along the ground if the body stays in place: what is left of it is how the
    /// torso hurries and lingers.
    pub fn resampled(&self, frames: usize, in_place: bool) -> Vec<Pose> {
        let frame = |frame: usize| {
            let share = frame as f64 / frames as f64;
            let pose = self.at(share);
            let way = if in_place { share * self.travel } else { 0.0 };
            Pose { x: pose.x - way, ..pose }
        };
        (0..frames).map(frame).collect()
    }

    /// How many frames it has at a rate, 1/s; at least 2.
    pub fn frames(&self, rate: f64) -> usize {
        ((self.seconds * rate).round() as usize).max(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample::samples;
    use std::f64::consts::TAU;

    /// A gait that sways, a little more each time, recorded by an engine with steps of 0.02 s.
    fn recorded(blueprint: &Blueprint, stride: f64, growth: f64) -> Vec<Snapshot> {
        let pose = |step: usize| {
            let time = 0.02 * step as f64;
            let sway = (0.3 + growth * time) * libm::sin(TAU * time / stride);
            let hinges = (0..blueprint.hinges().len()).map(|hinge| sway * (1.0 - 0.2 * hinge as f64)).collect();
            let pose = Pose { x: 1.5 * time, y: 0.8 + 0.05 * sway, angle: 0.2 * sway, hinges };
            pose.snapshot(blueprint)
        };
        (0..600).map(pose).collect()
    }

    #[test]
    fn a_cycle_can_be_put_at_a_height() {
        for (blueprint, _) in samples() {
            let snapshots = recorded(&blueprint, 0.5, 0.0);
            let found = Cycle::find(&blueprint, &snapshots, 0.02, 0.5).expect("it repeats itself");
            let put = found.clone().at_height(-3.0);
            let mean = put.poses.iter().map(|pose| pose.y).sum::<f64>() / put.poses.len() as f64;
            assert!((mean + 3.0).abs() < 1e-9, "{mean} m");
            let moved = put.poses[0].y - found.poses[0].y;
            let alike = put.poses.iter().zip(&found.poses).all(|(put, found)| (put.y - found.y - moved).abs() < 1e-9);
            assert!(alike && put.travel == found.travel);
        }
    }

    #[test]
    fn a_stride_is_found_and_ends_as_it_begins() {
        for (blueprint, _) in samples() {
            let cycle = Cycle::find(&blueprint, &recorded(&blueprint, 0.6, 0.002), 0.02, 0.61).expect("a cycle");
            assert!((cycle.seconds - 0.6).abs() < 0.021, "{}", cycle.seconds);
            assert!((cycle.travel - 1.5 * cycle.seconds).abs() < 1e-3);
            let (first, last) = (cycle.at(0.0), cycle.at(1.0));
            assert!(first.difference(&last) == (0.0, 0.0) && (last.x - first.x - cycle.travel).abs() < 1e-9);
            // Nothing leaps where the end meets the beginning.
            let steps = cycle.poses.len();
            let apart = |index: usize| {
                let (one, other) = (cycle.at(index as f64 / steps as f64), cycle.at((index + 1) as f64 / steps as f64));
                one.difference(&other).0
            };
            let (at_the_end, largest) = (apart(steps - 1), (0..steps - 1).map(apart).fold(0.0, f64::max));
            assert!(at_the_end <= 1.2 * largest, "{at_the_end} {largest}");
        }
    }

    #[test]
    fn a_gait_that_never_comes_back_has_no_cycle() {
        let (blueprint, _) = samples().swap_remove(1);
        let falling: Vec<Snapshot> = (0..200)
            .map(|step| {
                let turned = 0.05 * f64::from(step);
                let hinges = vec![0.0; blueprint.hinges().len()];
                Pose { x: 0.0, y: 1.0, angle: turned, hinges }.snapshot(&blueprint)
            })
            .collect();
        assert_eq!(Cycle::find(&blueprint, &falling, 0.02, 0.6), None);
        assert_eq!(Cycle::find(&blueprint, &falling[..3], 0.02, 0.6), None);
        assert_eq!(Cycle::find(&blueprint, &[], 0.02, 0.6), None);
    }

    #[test]
    fn a_pose_is_the_same_after_it_was_placed() {
        for (blueprint, cycle) in samples() {
            for pose in &cycle.poses {
                let again = Pose::of(&blueprint, &pose.snapshot(&blueprint));
                let (angle, height) = pose.difference(&again);
                assert!(angle < 1e-5 && height < 1e-5 && (pose.x - again.x).abs() < 1e-5, "{angle} {height}");
            }
        }
    }

    #[test]
    fn in_place_the_body_goes_nowhere() {
        let (_, cycle) = samples().swap_remove(0);
        let [moving, in_place] = [false, true].map(|in_place| cycle.resampled(8, in_place));
        assert!(moving[7].x > 0.6 && in_place.iter().all(|pose| pose.x.abs() < 0.05));
        assert_eq!(cycle.frames(25.0), 19);
        assert_eq!(cycle.frames(0.1), 2);
    }
}
