use super::{Movement, Verdict};
use crate::{Body, Snapshot};

/// How far the body has come forwards: the x of its centre of mass at the end minus that at the start, in m. Backwards is
/// negative.
///
/// Of the centre of mass, since in water a body gets nowhere by stretching a part forwards: what it gains in front it loses
/// behind. Rising and sinking count for nothing. A movement that has met no body takes all parts as equally heavy.
#[derive(Clone, Debug, Default)]
pub struct Swimming {
    /// Share of each part in the body's mass.
    shares: Vec<f64>,
    start: f64,
    now: f64,
}

impl Movement for Swimming {
    fn name(&self) -> &str {
        "swimming"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        let mass: f64 = body.parts.iter().map(|part| f64::from(part.mass)).sum();
        self.shares = body.parts.iter().map(|part| f64::from(part.mass) / mass).collect();
    }

    fn begin(&mut self, start: &Snapshot) {
        self.start = self.centre(start);
        self.now = self.start;
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.now = self.centre(now);
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.now - self.start
    }
}

impl Swimming {
    /// The x of the centre of mass, m.
    fn centre(&self, snapshot: &Snapshot) -> f64 {
        let equal = 1.0 / snapshot.parts.len() as f64;
        let share = |part: usize| self.shares.get(part).copied().unwrap_or(equal);
        snapshot.parts.iter().enumerate().map(|(index, part)| share(index) * f64::from(part.x)).sum()
    }
}
