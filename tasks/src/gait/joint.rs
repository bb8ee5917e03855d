use super::{
    Trajectory,
    spectrum::{Peak, Spectrum, detrended},
};
use crate::BodyHinge;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// A joint that swings less than this to either side, in rad, keeps still.
const STILL: f64 = 0.5 * std::f64::consts::PI / 180.0;
/// A reversal is a way back of at least this, rad.
const HYSTERESIS: f64 = std::f64::consts::PI / 180.0;

/// What a joint does.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct JointUse {
    /// The part that hangs on it.
    pub name: String,
    /// Whether the controller moves it.
    pub actuated: bool,
    /// Largest minus smallest angle, degrees.
    #[serde(rename = "range_deg")]
    pub range: f64,
    /// The same over the window, degrees.
    #[serde(rename = "window_range_deg")]
    pub window_range: f64,
    /// The strongest frequency of its angle over the window, without mean and straight trend, Hz; 0 for a joint that
    /// swings less than 0.5° to either side, and in a window shorter than 1 s.
    #[serde(rename = "dominant_frequency_hz")]
    pub dominant_frequency: f64,
    /// How far it swings to either side at that frequency, degrees.
    #[serde(rename = "dominant_amplitude_deg")]
    pub dominant_amplitude: f64,
    /// How often it turns back by more than 1°, over the window, 1/s.
    #[serde(rename = "reversals_per_s")]
    pub reversals: f64,
    /// Root mean square of its angular acceleration, rad/s².
    #[serde(rename = "rms_acceleration_rad_per_s2")]
    pub rms_acceleration: f64,
}

impl JointUse {
    pub(super) fn measure(
        trajectory: &Trajectory<'_>,
        index: usize,
        hinge: &BodyHinge,
        window: &RangeInclusive<usize>,
        spectrum: &Spectrum,
    ) -> Self {
        let angles = trajectory.hinge_angles(index);
        let in_window = &angles[window.clone()];
        let signal = detrended(in_window);
        let peak = if range(&signal) < 2.0 * STILL { Peak::default() } else { spectrum.peak(&signal) };
        let seconds = trajectory.time(window.end() - window.start());
        Self {
            name: trajectory.hinge_name(hinge).into(),
            actuated: hinge.motor.is_some(),
            range: range(angles).to_degrees(),
            window_range: range(in_window).to_degrees(),
            dominant_frequency: peak.frequency,
            dominant_amplitude: peak.amplitude.to_degrees(),
            reversals: reversals(in_window) as f64 / seconds,
            rms_acceleration: rms_acceleration(angles, trajectory.time_step()),
        }
    }
}

/// Largest minus smallest.
pub(super) fn range(values: &[f64]) -> f64 {
    let highest = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let lowest = values.iter().copied().fold(f64::INFINITY, f64::min);
    highest - lowest
}

/// How often angles turn back by more than the hysteresis.
fn reversals(angles: &[f64]) -> usize {
    // Until it has moved by the hysteresis, a joint has no direction.
    let (mut lowest, mut highest) = (angles[0], angles[0]);
    let mut rising = None;
    let mut reversals = 0;
    for &angle in angles {
        lowest = angle.min(lowest);
        highest = angle.max(highest);
        let turned = match rising {
            Some(true) | None if angle < highest - HYSTERESIS => Some(false),
            Some(false) | None if angle > lowest + HYSTERESIS => Some(true),
            _ => None,
        };
        if turned.is_some() {
            reversals += usize::from(rising.is_some());
            rising = turned;
            (lowest, highest) = (angle, angle);
        }
    }
    reversals
}

fn rms_acceleration(angles: &[f64], time_step: f64) -> f64 {
    if angles.len() < 3 {
        return 0.0;
    }
    let square = |three: &[f64]| {
        let acceleration = (three[0] - 2.0 * three[1] + three[2]) / (time_step * time_step);
        acceleration * acceleration
    };
    let sum: f64 = angles.windows(3).map(square).sum();
    (sum / (angles.len() - 2) as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn a_reversal_needs_a_degree() {
        let degrees = |angles: &[f64]| reversals(&angles.iter().map(|angle| angle.to_radians()).collect::<Vec<_>>());
        assert_eq!(degrees(&[0.0, 10.0, 0.0, 10.0]), 2);
        assert_eq!(degrees(&[0.0, 10.0, 9.5, 10.0, 20.0]), 0);
        assert_eq!(degrees(&[0.0, 10.0, 9.5, 8.9, 8.0, 9.5]), 2);
        assert_eq!(degrees(&[5.0]), 0);
    }

    #[test]
    fn a_sine_reverses_twice_a_cycle() {
        let angles: Vec<f64> = (0..=500).map(|step| 0.3 * libm::sin(TAU * 2.0 * f64::from(step) * 0.02)).collect();
        assert!((39..=40).contains(&reversals(&angles)));
        // Amplitude × (2πf)² / √2, less what differences over a step lose.
        let expected = 0.3 * (TAU * 2.0) * (TAU * 2.0) / 2.0_f64.sqrt();
        assert!((rms_acceleration(&angles, 0.02) / expected - 1.0).abs() < 0.02);
    }
}
