use crate::{Body, PartState, Snapshot};

/// Tells the flights of a body that begin with a push of its feet: no part touches the ground, and what touched it last
/// were feet alone. A body that is thrown into the air by its torso, or that begins in the air, does not fly.
///
/// Of a body without legs, or one that is not known, every part may push.
#[derive(Clone, Debug, Default)]
pub(super) struct Flights {
    /// Whether each part is a foot; empty: all are.
    feet: Vec<bool>,
    pushing: bool,
    take_off: PartState,
    since: f32,
}

/// A flight under way.
pub(super) struct Flight {
    /// The torso as it was on the ground for the last time.
    pub(super) take_off: PartState,
    /// How long it has lasted, s.
    pub(super) seconds: f32,
}

impl Flights {
    pub(super) fn bind(&mut self, body: &Body) {
        self.feet.clear();
        if !body.legless && !body.legs.is_empty() {
            self.feet.resize(body.parts.len(), false);
            body.feet().for_each(|foot| self.feet[foot] = true);
        }
    }

    pub(super) fn begin(&mut self, start: &Snapshot) {
        self.pushing = false;
        self.stand(start);
    }

    /// The flight that a step is part of, if it is.
    pub(super) fn observe(&mut self, now: &Snapshot) -> Option<Flight> {
        if now.aloft() {
            return self.pushing.then_some(Flight { take_off: self.take_off, seconds: now.time - self.since });
        }
        self.stand(now);
        None
    }

    fn stand(&mut self, now: &Snapshot) {
        if !now.aloft() {
            let is_foot = |part: usize| self.feet.get(part).copied().unwrap_or(true);
            self.pushing = now.parts.iter().enumerate().all(|(part, state)| !state.touching || is_foot(part));
            (self.take_off, self.since) = (*now.torso(), now.time);
        }
    }
}
