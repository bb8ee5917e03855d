use super::State;

/// Decisions over which the restlessness is summed.
const WINDOW: u32 = 100;

/// How calm the last hundred decisions were: abs(x) + abs(ẋ) + abs(θ₁) + abs(θ̇₁) for each, in m, m/s, rad and rad/s.
pub(super) struct Damping {
    restlessness: [f64; WINDOW as usize],
    next: usize,
}

impl Damping {
    pub(super) fn new() -> Self {
        Self { restlessness: [0.0; WINDOW as usize], next: 0 }
    }

    pub(super) fn watch(&mut self, state: &State<2>) {
        self.restlessness[self.next] =
            state.position.abs() + state.velocity.abs() + state.angles[0].abs() + state.angular_velocities[0].abs();
        self.next = (self.next + 1) % self.restlessness.len();
    }

    /// f: 0 if fewer than 100 decisions were held, else 0.75 / Σ of the last 100.
    pub(super) fn calm(&self, held: u32) -> f64 {
        if held < WINDOW { 0.0 } else { 0.75 / self.restlessness.iter().sum::<f64>() }
    }
}
