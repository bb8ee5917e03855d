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
}

impl Uprightness {
    pub(super) fn measure(trajectory: &Trajectory<'_>) -> Self {
        let (mut furthest, mut step) = (0.0, 0);
        for (index, tilt) in trajectory.tilts().iter().enumerate() {
            if tilt.abs() > furthest {
                (furthest, step) = (tilt.abs(), index);
            }
        }
        Self {
            largest_tilt: furthest.to_degrees(),
            largest_tilt_at: trajectory.time(step),
            rollovers: libm::floor((furthest + PI) / TAU),
        }
    }
}
