use std::array;

/// Seconds of one step of the Runge–Kutta method.
const STEP: f64 = 0.01;

/// Steps of the Runge–Kutta method in one decision.
const STEPS_A_DECISION: u32 = 2;

/// Acceleration of gravity, m/s².
const GRAVITY: f64 = 9.8;

/// A thin uniform rod, hinged on the cart at its lower end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pole {
    /// The whole length, m, above 0. The equations use half of it.
    pub length: f64,
    /// Mass, kg, above 0.
    pub mass: f64,
}

/// A cart on a straight track with `N` poles on it, and the equations of their motion.
///
/// Angles are measured from upright, positive towards positive x. With l half the length of a pole, m its mass, M the
/// mass of the cart, g = 9.8 m/s², F the force on the cart, μc the friction of the track and μp that of the hinges:
///
/// ```text
/// ẍ  = (F − μc sgn ẋ + Σ F̃ᵢ) / (M + Σ m̃ᵢ)
/// θ̈ᵢ = 3/(4 lᵢ) · (g sin θᵢ − ẍ cos θᵢ − μp θ̇ᵢ/(mᵢ lᵢ))
///
/// F̃ᵢ = mᵢ lᵢ θ̇ᵢ² sin θᵢ + 3/4 mᵢ cos θᵢ · (μp θ̇ᵢ/(mᵢ lᵢ) − g sin θᵢ)
/// m̃ᵢ = mᵢ (1 − 3/4 cos² θᵢ)
/// ```
///
/// F̃ is the force a pole puts on the cart, m̃ the mass the cart feels of it; sgn 0 = 0. Poles do not touch each other.
/// The equations are integrated by the classic fourth-order Runge–Kutta method with steps of 0.01 s, two to a decision.
///
/// The numbers are f64 and the sine is libm's, so that a path is the same to the bit on every platform.
///
/// Source: Wieland, *Evolving Neural Network Controllers for Unstable Systems*, IJCNN 1991; in this form in Gomez,
/// Schmidhuber & Miikkulainen, *Accelerated Neural Evolution through Cooperatively Coevolved Synapses*, JMLR 9, 2008,
/// where g is −9.8 m/s².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamics<const N: usize> {
    /// Mass of the cart, kg, above 0.
    pub cart_mass: f64,
    /// The friction of the track, μc: a force in N, whatever the speed.
    pub track_friction: f64,
    /// The friction of each hinge, μp: N·m per rad/s.
    pub hinge_friction: f64,
    /// The poles.
    pub poles: [Pole; N],
}

/// Where cart and poles are, and how fast they move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct State<const N: usize> {
    /// Position of the cart, m; 0 is the middle of the track.
    pub position: f64,
    /// Velocity of the cart, m/s.
    pub velocity: f64,
    /// Angle of each pole from upright, rad, positive towards positive x.
    pub angles: [f64; N],
    /// Angular velocity of each pole, rad/s.
    pub angular_velocities: [f64; N],
}

impl Dynamics<1> {
    /// The cart of the benchmark (1 kg, track friction 5e-4, hinge friction 2e-6) with one pole of 1 m and 0.1 kg.
    pub const ONE_POLE: Self = Self::of_benchmark([LONG_POLE]);
}

impl Dynamics<2> {
    /// The cart of the benchmark with two poles: 1 m and 0.1 kg, 0.1 m and 0.01 kg.
    pub const TWO_POLES: Self = Self::of_benchmark([LONG_POLE, Pole { length: 0.1, mass: 0.01 }]);
}

const LONG_POLE: Pole = Pole { length: 1.0, mass: 0.1 };

impl<const N: usize> Dynamics<N> {
    const fn of_benchmark(poles: [Pole; N]) -> Self {
        Self { cart_mass: 1.0, track_friction: 5e-4, hinge_friction: 2e-6, poles }
    }

    /// The state after one decision, 0.02 s, during which the cart is pushed with `force` N.
    #[must_use]
    pub fn decision(&self, state: &State<N>, force: f64) -> State<N> {
        (0..STEPS_A_DECISION).fold(*state, |state, _| self.step(&state, force))
    }

    fn step(&self, state: &State<N>, force: f64) -> State<N> {
        let first = self.derivative(state, force);
        let second = self.derivative(&state.moved(&first, STEP / 2.0), force);
        let third = self.derivative(&state.moved(&second, STEP / 2.0), force);
        let fourth = self.derivative(&state.moved(&third, STEP), force);
        let inner = second.moved(&third, 1.0);
        let sum = first.moved(&inner, 2.0).moved(&fourth, 1.0);
        state.moved(&sum, STEP / 6.0)
    }

    /// The time derivative of a state: velocities stand in the place of positions, accelerations in that of velocities.
    #[must_use]
    pub fn derivative(&self, state: &State<N>, force: f64) -> State<N> {
        let mut pull = force - self.track_friction * sign(state.velocity);
        let mut mass = self.cart_mass;
        let mut cosines = [0.0; N];
        // What turns a pole on a cart that is not accelerated: g sin θ − μp θ̇/(m l).
        let mut turns = [0.0; N];
        for (index, pole) in self.poles.iter().enumerate() {
            let (sine, cosine) = libm::sincos(state.angles[index]);
            let spin = state.angular_velocities[index];
            let moment = pole.mass * pole.length / 2.0;
            turns[index] = GRAVITY * sine - self.hinge_friction * spin / moment;
            cosines[index] = cosine;
            pull += moment * spin * spin * sine - 0.75 * pole.mass * cosine * turns[index];
            mass += pole.mass * (1.0 - 0.75 * cosine * cosine);
        }
        let acceleration = pull / mass;
        State {
            position: state.velocity,
            velocity: acceleration,
            angles: state.angular_velocities,
            angular_velocities: array::from_fn(|index| {
                1.5 / self.poles[index].length * (turns[index] - acceleration * cosines[index])
            }),
        }
    }
}

impl<const N: usize> State<N> {
    /// At rest in the middle of the track, every pole upright.
    pub const UPRIGHT: Self = Self { position: 0.0, velocity: 0.0, angles: [0.0; N], angular_velocities: [0.0; N] };

    /// At rest in the middle of the track, the first pole leaning by `degrees`, the others upright.
    #[must_use]
    pub fn leaning(degrees: f64) -> Self {
        let angles = array::from_fn(|index| if index == 0 { degrees.to_radians() } else { 0.0 });
        Self { angles, ..Self::UPRIGHT }
    }

    /// `self + factor · change`.
    fn moved(&self, change: &Self, factor: f64) -> Self {
        Self {
            position: self.position + factor * change.position,
            velocity: self.velocity + factor * change.velocity,
            angles: array::from_fn(|index| self.angles[index] + factor * change.angles[index]),
            angular_velocities: array::from_fn(|index| {
                self.angular_velocities[index] + factor * change.angular_velocities[index]
            }),
        }
    }
}

/// −1, 0 or 1; unlike [`f64::signum`], 0 for 0.
fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}
