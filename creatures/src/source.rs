//! Where the inputs of a net come from.

use crate::{BodyView, limit};
use core::f32::consts::TAU;

/// Where a channel's raw value comes from, and how it is scaled: the input is (value − middle) · factor, clamped. For
/// engines that sense many bodies at once, and for players; all others call `Senses::read`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Probe {
    /// What is measured.
    pub source: Source,
    /// The middle of the channel's range, in its unit.
    pub middle: f32,
    /// Input per unit.
    pub factor: f32,
}

/// What of a body a channel shows, each as the method of [`BodyView`] of that name tells it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Source {
    /// [`BodyView::torso_rotation`].
    TorsoRotation,
    /// [`BodyView::torso_spin`].
    TorsoSpin,
    /// [`BodyView::joint_angle`] of this hinge.
    JointAngle(usize),
    /// [`BodyView::joint_speed`] of this hinge.
    JointSpeed(usize),
    /// The first of [`BodyView::torso_velocity`].
    VelocityForward,
    /// The second of [`BodyView::torso_velocity`].
    VelocityUp,
    /// [`BodyView::torso_height`].
    TorsoHeight,
    /// [`BodyView::touches_ground`] of this part, as 0 or 1.
    Contact(usize),
    /// [`BodyView::distance_along_ray`].
    Ray {
        /// In the world, rad.
        angle: f32,
        /// m.
        length: f32,
    },
    /// [`BodyView::slip`] of this part.
    Slip(usize),
    /// The first of [`BodyView::next_gap`].
    GapDistance {
        /// m.
        length: f32,
    },
    /// The second of [`BodyView::next_gap`].
    GapWidth {
        /// m.
        length: f32,
    },
    /// The sine of a clock: see [`clock_phase`].
    ClockSine {
        /// s.
        period: f32,
    },
    /// The cosine of a clock: see [`clock_phase`].
    ClockCosine {
        /// s.
        period: f32,
    },
    /// The sine of a clock that begins anew at every landing: see [`BodyView::time_since_landing`].
    LandingSine {
        /// s.
        period: f32,
    },
    /// The cosine of a clock that begins anew at every landing.
    LandingCosine {
        /// s.
        period: f32,
    },
    /// [`BodyView::commanded_speed`].
    CommandedSpeed,
    /// [`BodyView::is_told_to_jump`], as 0 or 1.
    JumpCommand,
    /// The sine of a clock, times the commanded speed as a share of the top one: see [`BodyView::stride_time`].
    StrideSine {
        /// s.
        period: f32,
        /// Body lengths/s.
        top: f32,
    },
    /// The cosine of a clock, times the commanded speed as a share of the top one.
    StrideCosine {
        /// s.
        period: f32,
        /// Body lengths/s.
        top: f32,
    },
    /// The sine of the one turn that follows a press: see [`BodyView::time_since_press`].
    JumpSine {
        /// s.
        period: f32,
    },
    /// (1 − cosine) / 2 of the one turn that follows a press.
    JumpSwell {
        /// s.
        period: f32,
    },
    /// What a sensor of another crate tells. Only `Senses::read` can ask it.
    Custom {
        /// Which of these sensors.
        sensor: usize,
        /// Which of its channels.
        channel: usize,
    },
}

impl Probe {
    /// The input of a net for this raw value, within ± `input_range`; NaN for NaN.
    #[inline]
    pub fn scale(&self, value: f32, input_range: f32) -> f32 {
        limit((value - self.middle) * self.factor, -input_range, input_range)
    }
}

impl Source {
    /// The raw value, in the unit of its channel; NaN for one of another crate.
    #[inline]
    pub fn read<B: BodyView>(self, body: &B) -> f32 {
        match self {
            Self::TorsoRotation => body.torso_rotation(),
            Self::TorsoSpin => body.torso_spin(),
            Self::JointAngle(hinge) => body.joint_angle(hinge),
            Self::JointSpeed(hinge) => body.joint_speed(hinge),
            Self::VelocityForward => body.torso_velocity()[0],
            Self::VelocityUp => body.torso_velocity()[1],
            Self::TorsoHeight => body.torso_height(),
            Self::Contact(part) => f32::from(u8::from(body.touches_ground(part))),
            Self::Ray { angle, length } => body.distance_along_ray(angle, length),
            Self::Slip(part) => body.slip(part),
            Self::GapDistance { length } => body.next_gap(length)[0],
            Self::GapWidth { length } => body.next_gap(length)[1],
            Self::ClockSine { period } => libm::sinf(clock_phase(body.time(), period)),
            Self::ClockCosine { period } => libm::cosf(clock_phase(body.time(), period)),
            Self::LandingSine { period } => libm::sinf(clock_phase(body.time_since_landing(), period)),
            Self::LandingCosine { period } => libm::cosf(clock_phase(body.time_since_landing(), period)),
            Self::CommandedSpeed => body.commanded_speed(),
            Self::JumpCommand => f32::from(u8::from(body.is_told_to_jump())),
            Self::StrideSine { period, top } => {
                stride_swing(body.commanded_speed(), top) * libm::sinf(clock_phase(body.stride_time(), period))
            }
            Self::StrideCosine { period, top } => {
                stride_swing(body.commanded_speed(), top) * libm::cosf(clock_phase(body.stride_time(), period))
            }
            Self::JumpSine { period } => libm::sinf(jump_phase(body.time_since_press(), period)),
            Self::JumpSwell { period } => 0.5 * (1.0 - libm::cosf(jump_phase(body.time_since_press(), period))),
            Self::Custom { .. } => f32::NAN,
        }
    }
}

/// Phase of a clock of this period, both s, in rad, 0 to 2π. Whole turns are dropped first: they would cost precision.
pub fn clock_phase(time: f32, period: f32) -> f32 {
    let turns = time / period;
    (turns - libm::floorf(turns)) * TAU
}

/// How far a stride clock swings at a commanded speed, -1 to 1; both in body lengths/s.
pub fn stride_swing(speed: f32, top: f32) -> f32 {
    limit(speed / top, -1.0, 1.0)
}

/// Phase of a jump clock of this period, so long after the press, both s; in rad, 0 to 2π, and 0 once the turn is over.
pub fn jump_phase(since_press: f32, period: f32) -> f32 {
    if since_press < period { since_press / period * TAU } else { 0.0 }
}
