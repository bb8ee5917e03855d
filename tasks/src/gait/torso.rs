use super::Trajectory;
use serde::{Deserialize, Serialize};
use std::f64::consts::{PI, TAU};

/// How upright the torso stays, against its [angle in the creature's file](crate::Body::start_angle): a body that topples while
/// it settles is tilted from the start.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Uprightness {
    /// The farthest it ever turned either way, degrees, whole turns counted: a somersault is 360.
    #[serde(rename = "largest_tilt_deg")]
    pub largest_tilt: f64,
    /// When that was, s.
    #[serde(rename = "largest_tilt_at_s")]
    pub largest_tilt_at: f64,
    /// How often it got upside down in one direction, further than ever before, as
    /// [`Rollovers`](crate::Rollovers) counts.
    pub rollovers: f64,
    /// The standard deviation of its angle over the second half, degrees.
    #[serde(rename = "deviation_deg", default)]
    pub deviation: f64,
    /// How low its centre ever got, over its start height.
    #[serde(rename = "lowest_over_start_height", default)]
    pub lowest: f64,
    /// When that was, s.
    #[serde(rename = "lowest_at_s", default)]
    pub lowest_at: f64,
}

impl Uprightness {
    pub(super) fn measure(trajectory: &Trajectory<'_>) -> Self {
        let (mut furthest, mut step) = (0.0, 0);
        for (index, tilt) in trajectory.tilts().iter().enumerate() {
            if tilt.abs() > furthest {
                (furthest, step) = (tilt.abs(), index);
            }
        }
        let (start, mut lowest, mut lowest_step) = (trajectory.start_height(), f64::INFINITY, 0);
        for step in 0..=trajectory.steps() {
            let height = trajectory.height(step) / start;
            if height < lowest {
                (lowest, lowest_step) = (height, step);
            }
        }
        Self {
            deviation: deviation(&trajectory.tilts()[trajectory.at(0.5)..]).to_degrees(),
            lowest,
            lowest_at: trajectory.time(lowest_step),
            largest_tilt: furthest.to_degrees(),
            largest_tilt_at: trajectory.time(step),
            rollovers: libm::floor((furthest + PI) / TAU),
        }
    }
}

/// The standard deviation of at least one value.
fn deviation(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / count).sqrt()
}
