//! The motion of carts with poles: against an independent derivation, the laws of mechanics, and for ever the same.

use ne_core::digest::Digest;
use proptest::{array::uniform2, prelude::*};
use std::f64::consts::PI;
use tasks::classic::{Dynamics, Pole, State};

const WITHOUT_FRICTION: Dynamics<2> = Dynamics { track_friction: 0.0, hinge_friction: 0.0, ..Dynamics::TWO_POLES };

fn states() -> impl Strategy<Value = State<2>> {
    (-2.0..2.0, -2.0..2.0, uniform2(-PI..PI), uniform2(-4.0..4.0)).prop_map(
        |(position, velocity, angles, angular_velocities)| State { position, velocity, angles, angular_velocities },
    )
}

fn systems() -> impl Strategy<Value = Dynamics<2>> {
    let poles = uniform2((0.05..2.0, 0.005..1.0).prop_map(|(length, mass)| Pole { length, mass }));
    (0.1..10.0, 0.0..1.0, 0.0..1e-3, poles).prop_map(|(cart_mass, track_friction, hinge_friction, poles)| Dynamics {
        cart_mass,
        track_friction,
        hinge_friction,
        poles,
    })
}

/// The accelerations of cart and poles from Lagrange's equations of rods with the moment of inertia 4/3 m l² about the
/// hinge: a system of three linear equations, solved by elimination.
fn lagrange(dynamics: &Dynamics<2>, state: &State<2>, force: f64) -> [f64; 3] {
    let friction = if state.velocity == 0.0 { 0.0 } else { dynamics.track_friction * state.velocity.signum() };
    // Coefficients of ẍ, θ̈₁ and θ̈₂, and the right side.
    let mut rows = [[0.0; 4]; 3];
    rows[0][0] = dynamics.cart_mass;
    rows[0][3] = force - friction;
    for (index, pole) in dynamics.poles.iter().enumerate() {
        let (half, angle, spin) = (pole.length / 2.0, state.angles[index], state.angular_velocities[index]);
        rows[0][0] += pole.mass;
        rows[0][3] += pole.mass * half * spin * spin * angle.sin();
        rows[0][index + 1] = pole.mass * half * angle.cos();
        rows[index + 1][0] = rows[0][index + 1];
        rows[index + 1][index + 1] = 4.0 / 3.0 * pole.mass * half * half;
        rows[index + 1][3] = pole.mass * half * 9.8 * angle.sin() - dynamics.hinge_friction * spin;
    }
    // The matrix is positive definite, so no pivot is 0.
    for pivot in 0..3 {
        let divisor = rows[pivot][pivot];
        rows[pivot].iter_mut().for_each(|value| *value /= divisor);
        let subtracted = rows[pivot];
        for (_, row) in rows.iter_mut().enumerate().filter(|(row, _)| *row != pivot) {
            let factor = row[pivot];
            row.iter_mut().zip(subtracted).for_each(|(value, other)| *value -= factor * other);
        }
    }
    rows.map(|row| row[3])
}

/// Kinetic and potential energy, J.
fn energy(dynamics: &Dynamics<2>, state: &State<2>) -> f64 {
    let poles = dynamics.poles.iter().zip(state.angles).zip(state.angular_velocities).map(|((pole, angle), spin)| {
        let half = pole.length / 2.0;
        let (vx, vy) = (state.velocity + half * spin * angle.cos(), -half * spin * angle.sin());
        let inertia = pole.mass * pole.length * pole.length / 12.0;
        0.5 * pole.mass * (vx * vx + vy * vy) + 0.5 * inertia * spin * spin + pole.mass * 9.8 * half * angle.cos()
    });
    0.5 * dynamics.cart_mass * state.velocity * state.velocity + poles.sum::<f64>()
}

fn mirrored(state: &State<2>) -> State<2> {
    State {
        position: -state.position,
        velocity: -state.velocity,
        angles: state.angles.map(|angle| -angle),
        angular_velocities: state.angular_velocities.map(|spin| -spin),
    }
}

proptest! {
    #[test]
    fn accelerations_are_those_of_lagranges_equations(
        dynamics in systems(), state in states(), force in -10.0..10.0,
    ) {
        let derivative = dynamics.derivative(&state, force);
        let [first, second] = derivative.angular_velocities;
        for (found, expected) in [derivative.velocity, first, second].into_iter().zip(lagrange(&dynamics, &state, force)) {
            prop_assert!((found - expected).abs() <= 1e-9 * (1.0 + expected.abs()), "{found} against {expected}");
        }
        prop_assert_eq!(derivative.position, state.velocity);
        prop_assert_eq!(derivative.angles, state.angular_velocities);
    }

    #[test]
    fn energy_is_kept_without_friction(start in states()) {
        let before = energy(&WITHOUT_FRICTION, &start);
        let mut state = start;
        for _ in 0..100 {
            state = WITHOUT_FRICTION.decision(&state, 0.0);
        }
        let after = energy(&WITHOUT_FRICTION, &state);
        prop_assert!((after - before).abs() < 1e-4, "{before} J before, {after} J after two seconds");
    }

    #[test]
    fn friction_takes_energy(start in states()) {
        let start = State { velocity: start.velocity + 0.1_f64.copysign(start.velocity), ..start };
        let slow = Dynamics { track_friction: 0.05, hinge_friction: 1e-3, ..Dynamics::TWO_POLES };
        let (before, after) = (energy(&slow, &start), energy(&slow, &slow.decision(&start, 0.0)));
        prop_assert!(after < before, "{before} J before, {after} J after a decision");
    }

    #[test]
    fn the_mirrored_start_and_force_give_the_mirrored_path(start in states(), force in -10.0..10.0) {
        let (mut state, mut mirror) = (start, mirrored(&start));
        for _ in 0..50 {
            state = Dynamics::TWO_POLES.decision(&state, force);
            mirror = Dynamics::TWO_POLES.decision(&mirror, -force);
            prop_assert_eq!(mirrored(&state), mirror);
        }
    }

    #[test]
    fn a_second_pole_without_mass_changes_nothing(start in states(), force in -10.0..10.0) {
        let [long, short] = Dynamics::TWO_POLES.poles;
        let two = Dynamics { hinge_friction: 0.0, poles: [long, Pole { mass: 1e-14, ..short }], ..Dynamics::TWO_POLES };
        let one = Dynamics { hinge_friction: 0.0, ..Dynamics::ONE_POLE };
        let mut with = start;
        let mut without = State {
            position: start.position,
            velocity: start.velocity,
            angles: [start.angles[0]],
            angular_velocities: [start.angular_velocities[0]],
        };
        for _ in 0..20 {
            (with, without) = (two.decision(&with, force), one.decision(&without, force));
        }
        prop_assert!((with.position - without.position).abs() < 1e-9);
        prop_assert!((with.angles[0] - without.angles[0]).abs() < 1e-9);
    }
}

#[test]
fn upright_poles_at_rest_stay_so() {
    let mut state = State::UPRIGHT;
    for _ in 0..1000 {
        state = Dynamics::TWO_POLES.decision(&state, 0.0);
    }
    assert_eq!(state, State::UPRIGHT);
}

#[test]
fn a_cart_without_poles_is_uniformly_accelerated() {
    let cart = Dynamics::<0> { cart_mass: 2.0, track_friction: 1.0, hinge_friction: 0.0, poles: [] };
    let mut state = State { velocity: 0.001, ..State::UPRIGHT };
    for _ in 0..50 {
        state = cart.decision(&state, 5.0);
    }
    // (5 − 1) N on 2 kg for a second.
    assert!((state.velocity - 2.001).abs() < 1e-12, "{state:?}");
    assert!((state.position - 1.001).abs() < 1e-12, "{state:?}");
}

/// Golden: a change of this digest is another task.
#[test]
fn a_path_is_the_same_for_ever() {
    let mut digest = Digest::default();
    let mut state = State::<2>::leaning(4.0);
    for decision in 0..200 {
        let force = f64::from(decision * 37 % 41 - 20) / 2.0;
        state = Dynamics::TWO_POLES.decision(&state, force);
        let [a, b] = state.angles;
        let [c, d] = state.angular_velocities;
        for value in [state.position, state.velocity, a, b, c, d] {
            digest.add(&value.to_bits().to_le_bytes());
        }
    }
    assert_eq!(digest.to_string(), "c7a947b40637050f");
}
