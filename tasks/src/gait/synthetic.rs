//! A puppet for tests: a torso and two legs that follow a script.

use super::Trajectory;
use crate::{Body, BodyHinge, BodyMotor, BodyPart, PartState, Snapshot};
use std::f64::consts::TAU;

/// Seconds of a step.
pub(super) const TIME_STEP: f64 = 0.02;
/// Steps of the walker's stride, and how many of them each foot stands.
pub(super) const STRIDE: usize = 25;
pub(super) const STANCE: usize = 15;
/// From hip to sole, m.
const LEG: f64 = 0.6;

/// Where the script wants everything after a step.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Pose {
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) tilt: f64,
    /// Angles of the two hips, rad.
    pub(super) hips: [f64; 2],
    /// Torso, left leg, right leg.
    pub(super) touching: [bool; 3],
    /// How far the left hip has come apart, m.
    pub(super) gap: f64,
    /// How far each leg is drawn up, m.
    pub(super) lift: [f64; 2],
    /// The motors' work so far, J.
    pub(super) work: f64,
}

impl Pose {
    /// Standing still on both legs.
    pub(super) fn standing() -> Self {
        Self {
            x: 0.0,
            y: 0.8,
            tilt: 0.0,
            hips: [0.0; 2],
            touching: [false, true, true],
            gap: 0.0,
            lift: [0.0; 2],
            work: 0.0,
        }
    }

    /// Walking at 1 m/s, which is 1 body length/s, the legs half a stride apart, the motors giving 60 W. A foot that stands
    /// stays where it is.
    pub(super) fn walking(step: usize) -> Self {
        let time = step as f64 * TIME_STEP;
        let steps = [step, step + STRIDE / 2];
        let [left, right] = steps.map(|step| step % STRIDE < STANCE);
        let work = 60.0 * time;
        Self {
            x: time,
            hips: steps.map(hip),
            touching: [false, left, right],
            lift: steps.map(lift),
            work,
            ..Self::standing()
        }
    }

    /// Crouching for a second, then jumping 0.46 m high.
    pub(super) fn jumping(step: usize) -> Self {
        let time = step as f64 * TIME_STEP;
        let flight = time - 1.0;
        let height = flight * (3.0 - 0.5 * 9.81 * flight);
        let aloft = flight > 1e-9 && height > 0.0;
        Self {
            y: 0.8 + if aloft { height } else { 0.0 },
            touching: [false, !aloft, !aloft],
            work: 100.0 * ((time - 0.98) / 0.04).clamp(0.0, 1.0),
            ..Self::standing()
        }
    }
}

/// A hip that keeps its foot in place for the steps of a stance, and swings it forward in the others, rad.
fn hip(step: usize) -> f64 {
    let phase = step % STRIDE;
    let reach = 0.5 * (STANCE - 1) as f64 * TIME_STEP / LEG;
    let share = if phase < STANCE {
        1.0 - 2.0 * phase as f64 / (STANCE - 1) as f64
    } else {
        -libm::cos(TAU * 0.5 * (phase + 1 - STANCE) as f64 / (STRIDE - STANCE + 1) as f64)
    };
    libm::asin(reach * share)
}

/// How far a leg that swings is drawn up, m.
fn lift(step: usize) -> f64 {
    let phase = step % STRIDE;
    let swing = phase.saturating_sub(STANCE - 1) as f64 / (STRIDE - STANCE + 1) as f64;
    0.045 * libm::sin(TAU * 0.5 * swing)
}

/// Torso 0.6 × 0.3 m, 10 kg; two legs of 0.6 × 0.1 m, 1 kg, that hang on its centre line at its bottom.
pub(super) fn body() -> Body {
    let part = |name: &str, mass: f32, width: f32, height: f32| BodyPart {
        name: name.into(),
        mass,
        inertia: mass * (width * width + height * height) / 12.0,
        buoyancy: 0.0,
        corners: [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]]
            .map(|[x, y]| [0.5 * width * x, 0.5 * height * y])
            .into(),
        radius: 0.0,
    };
    let hip = |child: usize| BodyHinge {
        parent: 0,
        child,
        parent_anchor: [0.0, -0.15],
        child_anchor: [0.0, 0.3],
        start_angle: 0.0,
        limits: [-1.0, 1.0],
        motor: Some(BodyMotor { top_speed: 8.0, top_torque: 80.0 }),
    };
    Body {
        body_length: 1.0,
        start_height: 0.8,
        start_angle: 0.0,
        gravity: 9.81,
        parts: vec![part("torso", 10.0, 0.6, 0.3), part("left leg", 1.0, 0.1, 0.6), part("right leg", 1.0, 0.1, 0.6)],
        hinges: vec![hip(1), hip(2)],
        legs: vec![vec![1], vec![2]],
        legless: false,
        uneven_ground: false,
    }
}

/// Films a script for some seconds; speeds are those of the motion.
pub(super) fn film(seconds: f64, script: impl Fn(usize) -> Pose) -> Vec<Snapshot> {
    let steps = libm::round(seconds / TIME_STEP) as usize;
    let positions: Vec<Snapshot> = (0..=steps).map(|step| snapshot(step, &script(step))).collect();
    let body = body();
    let trajectory = Trajectory::from_positions(&body, &positions).expect("a script is a trajectory");
    trajectory.snapshots().to_vec()
}

fn snapshot(step: usize, pose: &Pose) -> Snapshot {
    let state = |x: f64, y: f64, angle: f64, touching: bool| PartState {
        x: x as f32,
        y: y as f32,
        cos: libm::cos(angle) as f32,
        sin: libm::sin(angle) as f32,
        touching,
        ..PartState::default()
    };
    let leg = |index: usize, gap: f64| {
        let angle = pose.tilt + pose.hips[index];
        let hip = [pose.x + 0.15 * libm::sin(pose.tilt), pose.y - 0.15 * libm::cos(pose.tilt)];
        let centre = [hip[0] + 0.3 * libm::sin(angle) + gap, hip[1] - 0.3 * libm::cos(angle) + pose.lift[index]];
        state(centre[0], centre[1], angle, pose.touching[index + 1])
    };
    Snapshot {
        time: (step as f64 * TIME_STEP) as f32,
        parts: vec![state(pose.x, pose.y, pose.tilt, pose.touching[0]), leg(0, pose.gap), leg(1, 0.0)],
        motor_work: pose.work,
        ..Snapshot::default()
    }
}
