//! When a body last came down.

/// What touches within this time of a landing belongs to it, s: feet come down one after the other, and bounce.
const ONE_LANDING: f32 = 0.2;

/// The account of a body's landings that [`BodyView::time_since_landing`](crate::BodyView::time_since_landing) asks for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Landings {
    touches: bool,
    last: f32,
}

impl Default for Landings {
    /// A body that stands as its clock starts.
    fn default() -> Self {
        Self { touches: true, last: 0.0 }
    }
}

impl Landings {
    /// After each step: whether any part touches the ground, and the time since the clock started, s.
    pub fn observe(&mut self, touches: bool, time: f32) {
        if touches && !self.touches && time - self.last >= ONE_LANDING {
            self.last = time;
        }
        self.touches = touches;
    }

    /// Time since the last landing, s, when it is so late.
    pub fn since(&self, time: f32) -> f32 {
        time - self.last
    }
}

#[cfg(test)]
mod tests {
    use super::Landings;

    #[test]
    fn feet_that_bounce_or_come_later_are_of_one_landing() {
        let mut landings = Landings::default();
        for (time, touches, since) in [
            (0.1, false, 0.1),
            (0.15, true, 0.15),
            (0.5, true, 0.5),
            (0.6, false, 0.6),
            (0.8, true, 0.0),
            (0.9, false, 0.1),
            (0.95, true, 0.15),
            (1.2, false, 0.4),
            (1.5, true, 0.0),
        ] {
            landings.observe(touches, time);
            assert!((landings.since(time) - since).abs() < 1e-6, "at {time} s: {}", landings.since(time));
        }
    }
}
