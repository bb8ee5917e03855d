use super::{Movement, Verdict, flights::Flights};
use crate::{Body, Snapshot};

/// The heights of all hops on the spot, added up, in m. A hop is a flight of at least 0.1 s that feet began; its height is
/// how far the torso rises above where it took off, or above its start if that is higher. A hop counts the less, the
/// farther from the start it is, forwards or backwards, and nothing a body length away.
///
/// Drifting away therefore loses what it gains, a body that rears up or crouches has no hop higher than it flies, and one
/// that trembles has none at all.
#[derive(Clone, Debug, Default)]
pub struct Hopping {
    body_length: Option<f32>,
    flights: Flights,
    /// The torso at the start, m.
    start: [f32; 2],
    hop: Hop,
    done: f64,
}

/// The hop under way.
#[derive(Clone, Copy, Debug, Default)]
struct Hop {
    seconds: f32,
    rise: f32,
    farthest: f32,
}

/// A flight shorter than this is a tremble, s.
const SHORTEST: f32 = 0.1;

impl Movement for Hopping {
    fn name(&self) -> &str {
        "hopping"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.flights.bind(body);
        self.body_length = Some(body.body_length);
    }

    fn begin(&mut self, start: &Snapshot) {
        self.flights.begin(start);
        self.start = [start.torso().x, start.torso().y];
        (self.hop, self.done) = (Hop::default(), 0.0);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let Some(flight) = self.flights.observe(now) else {
            self.done += self.worth();
            self.hop = Hop::default();
            return Verdict::GoOn;
        };
        let ([x, y], torso) = (self.start, now.torso());
        self.hop.seconds = flight.seconds;
        self.hop.rise = self.hop.rise.max(torso.y - y.max(flight.take_off.y));
        self.hop.farthest = self.hop.farthest.max((torso.x - x).abs());
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.done + self.worth()
    }
}

impl Hopping {
    /// Of the hop under way, m.
    fn worth(&self) -> f64 {
        let Hop { seconds, rise, farthest } = self.hop;
        if seconds < SHORTEST {
            return 0.0;
        }
        let near = 1.0 - f64::from(farthest) / f64::from(self.body_length.unwrap_or(1.0));
        f64::from(rise) * near.max(0.0)
    }
}
