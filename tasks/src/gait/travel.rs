use super::Trajectory;
use serde::{Deserialize, Serialize};

/// How far, how fast and at what cost the torso travels, or the centre of mass of what swims. Ahead is positive: forwards,
/// or backwards, if that is how the gait is [looked at](super::View).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Travel {
    /// From start to end, m.
    #[serde(rename = "distance_m")]
    pub distance: f64,
    /// Mean speed, m/s.
    #[serde(rename = "speed_m_per_s")]
    pub speed: f64,
    /// Mean speed in body lengths a second.
    #[serde(rename = "speed_body_lengths_per_s")]
    pub relative_speed: f64,
    /// Mean speed over the second half, m/s.
    #[serde(rename = "second_half_speed_m_per_s")]
    pub second_half_speed: f64,
    /// Mean speed over the second half in body lengths a second.
    #[serde(rename = "second_half_speed_body_lengths_per_s")]
    pub second_half_relative_speed: f64,
    /// Progress in each quarter of the episode, m.
    #[serde(rename = "quarters_m")]
    pub quarters: [f64; 4],
    /// Progress in each quarter of the second half, m.
    #[serde(rename = "second_half_quarters_m")]
    pub second_half_quarters: [f64; 4],
    /// The motors' work over weight times distance. `None` if the work is not known or there is no way forward to divide
    /// by, or no weight.
    pub cost_of_transport: Option<f64>,
}

impl Travel {
    pub(super) fn measure(trajectory: &Trajectory<'_>) -> Self {
        let (half, end) = (trajectory.at(0.5), trajectory.steps());
        let distance = trajectory.progress(0, end);
        let speed = distance / trajectory.seconds();
        let second_half_speed = trajectory.progress(half, end) / trajectory.time(end - half);
        let length = f64::from(trajectory.body().body_length);
        let quarters = |from: f64, to: f64| {
            let border = |quarter: usize| trajectory.at(from + (to - from) * quarter as f64 / 4.0);
            std::array::from_fn(|quarter| trajectory.progress(border(quarter), border(quarter + 1)))
        };
        let weight = trajectory.body().weight().abs();
        let work = trajectory.work(end).zip(trajectory.work(0)).map(|(end, start)| end - start);
        Self {
            distance,
            speed,
            relative_speed: speed / length,
            second_half_speed,
            second_half_relative_speed: second_half_speed / length,
            quarters: quarters(0.0, 1.0),
            second_half_quarters: quarters(0.5, 1.0),
            cost_of_transport: work
                .filter(|_| distance > 0.0)
                .map(|work| work / (weight * distance))
                .filter(|cost| cost.is_finite()),
        }
    }
}
