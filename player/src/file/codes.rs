//! Numbers that stand for names.

use creatures::Source;
use ne_net::Activation;

/// The number of an activation.
pub(super) fn of_activation(activation: Activation) -> u8 {
    match activation {
        Activation::Logistic => 0,
        Activation::Tanh => 1,
        Activation::RationalTanh => 2,
        Activation::Relu => 3,
        Activation::Linear => 4,
        Activation::Sine => 5,
        Activation::Gaussian => 6,
        Activation::SteepLogistic => 7,
        Activation::SteepTanh => 8,
    }
}

/// The activation with a number.
pub(super) fn activation(code: u8) -> Option<Activation> {
    Activation::ALL.into_iter().find(|&activation| of_activation(activation) == code)
}

/// The record of a source, as the specification of the file (`docs/player.md`) lists them: its number, a part or hinge, and two settings.
/// `None` for a sensor of another crate.
pub fn source_record(source: Source) -> Option<(u8, usize, f32, f32)> {
    Some(match source {
        Source::TorsoRotation => (0, 0, 0.0, 0.0),
        Source::TorsoSpin => (1, 0, 0.0, 0.0),
        Source::JointAngle(hinge) => (2, hinge, 0.0, 0.0),
        Source::JointSpeed(hinge) => (3, hinge, 0.0, 0.0),
        Source::VelocityForward => (4, 0, 0.0, 0.0),
        Source::VelocityUp => (5, 0, 0.0, 0.0),
        Source::TorsoHeight => (6, 0, 0.0, 0.0),
        Source::Contact(part) => (7, part, 0.0, 0.0),
        Source::Ray { angle, length } => (8, 0, angle, length),
        Source::Slip(part) => (9, part, 0.0, 0.0),
        Source::GapDistance { length } => (10, 0, length, 0.0),
        Source::GapWidth { length } => (11, 0, length, 0.0),
        Source::ClockSine { period } => (12, 0, period, 0.0),
        Source::ClockCosine { period } => (13, 0, period, 0.0),
        Source::LandingSine { period } => (14, 0, period, 0.0),
        Source::LandingCosine { period } => (15, 0, period, 0.0),
        Source::CommandedSpeed => (16, 0, 0.0, 0.0),
        Source::JumpCommand => (17, 0, 0.0, 0.0),
        Source::StrideSine { period, top } => (18, 0, period, top),
        Source::StrideCosine { period, top } => (19, 0, period, top),
        Source::JumpSine { period } => (20, 0, period, 0.0),
        Source::JumpSwell { period } => (21, 0, period, 0.0),
        // Only the program that has its code can read it.
        Source::Custom { .. } => return None,
    })
}

/// The source of a record.
pub(super) fn source(code: u8, index: usize, first: f32, second: f32) -> Option<Source> {
    Some(match code {
        0 => Source::TorsoRotation,
        1 => Source::TorsoSpin,
        2 => Source::JointAngle(index),
        3 => Source::JointSpeed(index),
        4 => Source::VelocityForward,
        5 => Source::VelocityUp,
        6 => Source::TorsoHeight,
        7 => Source::Contact(index),
        8 => Source::Ray { angle: first, length: second },
        9 => Source::Slip(index),
        10 => Source::GapDistance { length: first },
        11 => Source::GapWidth { length: first },
        12 => Source::ClockSine { period: first },
        13 => Source::ClockCosine { period: first },
        14 => Source::LandingSine { period: first },
        15 => Source::LandingCosine { period: first },
        16 => Source::CommandedSpeed,
        17 => Source::JumpCommand,
        18 => Source::StrideSine { period: first, top: second },
        19 => Source::StrideCosine { period: first, top: second },
        20 => Source::JumpSine { period: first },
        21 => Source::JumpSwell { period: first },
        _ => return None,
    })
}
