use super::{Interval, Trajectory, contact};
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;

/// The time with every part off the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Aloft {
    /// Share of the episode, 0 to 1.
    pub share: f64,
    /// The longest flight, s; 0 without one.
    #[serde(rename = "longest_s")]
    pub longest: f64,
    /// The highest the torso rose above its start in a flight, m; `None` without a flight.
    #[serde(rename = "highest_m")]
    pub highest: Option<f64>,
    /// Every flight, in order of time.
    pub flights: Vec<Flight>,
}

/// A stretch of time in which no part touches the ground.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Flight {
    /// From when to when.
    #[serde(flatten)]
    pub interval: Interval,
    /// How far the torso was above its start at the peak, m; negative if it stayed below.
    #[serde(rename = "rise_m")]
    pub rise: f64,
    /// How far the centre of mass was above its start at the peak, m; negative if it stayed below.
    #[serde(rename = "centre_rise_m", default)]
    pub centre_rise: f64,
    /// When each leg pushed off: the last time its foot lost contact before the flight, s. In order of the body's legs;
    /// `None` for a foot that never touched the ground before, and for all in a flight the episode begins with.
    #[serde(rename = "push_offs_s")]
    pub push_offs: Vec<Option<f64>>,
}

impl Flight {
    /// How far apart in time the legs pushed off, s; `None` if not every leg did, or there are none.
    pub fn push_off_spread(&self) -> Option<f64> {
        let times: Option<Vec<f64>> = self.push_offs.iter().copied().collect();
        let times = times.filter(|times| !times.is_empty())?;
        let first = times.iter().copied().fold(f64::INFINITY, f64::min);
        let last = times.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        Some(last - first)
    }
}

impl Aloft {
    pub(super) fn measure(trajectory: &Trajectory<'_>) -> Self {
        let feet: Vec<Vec<RangeInclusive<usize>>> =
            trajectory.body().feet().map(|foot| contact::contacts(trajectory, foot)).collect();
        let flights: Vec<Flight> = contact::ranges(trajectory.snapshots().iter().map(|snapshot| snapshot.aloft()))
            .into_iter()
            // Snapshot 0 speaks of no time.
            .filter(|range| *range.end() > 0)
            .map(|range| flight(trajectory, &feet, range))
            .collect();
        let seconds = flights.iter().map(|flight| flight.interval.seconds());
        Self {
            share: seconds.clone().fold(0.0, |sum, flight| sum + flight) / trajectory.seconds(),
            longest: seconds.fold(0.0, f64::max),
            highest: flights.iter().map(|flight| flight.rise).reduce(f64::max),
            flights,
        }
    }
}

fn flight(trajectory: &Trajectory<'_>, feet: &[Vec<RangeInclusive<usize>>], range: RangeInclusive<usize>) -> Flight {
    let push_off = |contacts: &Vec<RangeInclusive<usize>>| {
        let last = contacts.iter().rfind(|contact| contact.end() < range.start());
        last.map(|contact| trajectory.time(*contact.end()))
    };
    Flight {
        interval: Interval::of(trajectory, &range),
        rise: range.clone().map(|step| trajectory.rise(step)).fold(f64::NEG_INFINITY, f64::max),
        centre_rise: range.clone().map(|step| trajectory.centre_height(step)).fold(f64::NEG_INFINITY, f64::max)
            - trajectory.centre_height(0),
        push_offs: feet.iter().map(push_off).collect(),
    }
}
