use super::{Movement, Verdict, flights::Flights};
use crate::{Body, Snapshot};

/// How far the torso gets in its longest flight, in m: from where it was when the last foot left the ground to where it
/// is when the first part comes down again.
///
/// Only a flight that feet began counts, from the ground, and not what is run, slid or rolled before and after it; many
/// short flights are worth no more than the longest of them.
#[derive(Clone, Debug, Default)]
pub struct LongJump {
    flights: Flights,
    longest: f64,
}

impl Movement for LongJump {
    fn name(&self) -> &str {
        "long-jump"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.flights.bind(body);
    }

    fn begin(&mut self, start: &Snapshot) {
        self.flights.begin(start);
        self.longest = 0.0;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if let Some(flight) = self.flights.observe(now) {
            self.longest = self.longest.max(f64::from(now.torso().x) - f64::from(flight.take_off.x));
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.longest
    }
}
