use super::{
    body::Body,
    normal::{Normal, Slanted},
    pace::Pace,
};
use crate::lanes::{Lanes, Mask};

/// The contact of the same part of `W` creatures with the ground: at most two points, pushed apart along the normal and
/// slowed along the ground by Coulomb friction.
#[derive(Clone, Debug)]
pub(super) struct Rows<N, const W: usize> {
    pub(super) normal: N,
    /// Friction coefficient of part and ground together.
    pub(super) friction: Lanes<W>,
    pub(super) points: [Point<W>; 2],
    /// Whether any creature is near the ground with this part.
    pub(super) near: bool,
    /// Whether the part has pressed on the ground in this step.
    pub(super) pressing: Mask<W>,
    /// J M⁻¹ Jᵀ between the two points' normal rows.
    coupling: Lanes<W>,
    /// Whether both points are there and different enough to be solved as a pair.
    pair: Mask<W>,
    pair_any: bool,
    pair_terms: PairTerms<W>,
    kept: Kept<W>,
}

/// What the points pressed with when the step was over in lanes with fewer substeps than others.
#[derive(Clone, Copy, Debug)]
struct Kept<const W: usize> {
    /// Normal and friction impulse of each point.
    impulses: [[Lanes<W>; 2]; 2],
    pressing: Mask<W>,
}

/// A point that may touch the ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point<const W: usize> {
    /// From the body's centre to the contact, in the world as the step began, m.
    pub(super) lever: (Lanes<W>, Lanes<W>),
    /// The body's point of the contact, in the body's own frame, m.
    pub(super) local: (Lanes<W>, Lanes<W>),
    /// The ground's, in the world, m.
    pub(super) ground: (Lanes<W>, Lanes<W>),
    /// What the distance of the two as the step began differs from the distance of the surfaces, m.
    pub(super) offset: Lanes<W>,
    pub(super) normal_impulse: Lanes<W>,
    pub(super) friction_impulse: Lanes<W>,
    /// J of the spin, and M⁻¹ Jᵀ.
    normal_arm: Lanes<W>,
    friction_arm: Lanes<W>,
    normal_spin: Lanes<W>,
    friction_spin: Lanes<W>,
    /// J M⁻¹ Jᵀ of the normal row, its inverse and that of the friction row; 0 where there is no contact.
    normal_mass: Lanes<W>,
    normal_inverse: Lanes<W>,
    friction_inverse: Lanes<W>,
    bias: Lanes<W>,
    /// 1 / (1 + compliance).
    impulse_factor: Lanes<W>,
}

/// What solving two points as a pair needs of the current softness.
#[derive(Clone, Copy, Debug)]
struct PairTerms<const W: usize> {
    /// The diagonal of the soft K.
    first: Lanes<W>,
    second: Lanes<W>,
    first_inverse: Lanes<W>,
    second_inverse: Lanes<W>,
    inverse_determinant: Lanes<W>,
    invertible: Mask<W>,
}

impl<const W: usize> Point<W> {
    pub(super) const NONE: Self = Self {
        lever: (Lanes::ZERO, Lanes::ZERO),
        local: (Lanes::ZERO, Lanes::ZERO),
        ground: (Lanes::ZERO, Lanes::ZERO),
        offset: Lanes::ZERO,
        normal_impulse: Lanes::ZERO,
        friction_impulse: Lanes::ZERO,
        normal_arm: Lanes::ZERO,
        friction_arm: Lanes::ZERO,
        normal_spin: Lanes::ZERO,
        friction_spin: Lanes::ZERO,
        normal_mass: Lanes::ZERO,
        normal_inverse: Lanes::ZERO,
        friction_inverse: Lanes::ZERO,
        bias: Lanes::ZERO,
        impulse_factor: Lanes::ONE,
    };

    /// The distance from the ground where the body is now, m.
    #[inline(always)]
    fn distance(&self, normal: &impl Normal<W>, body: &Body<W>) -> Lanes<W> {
        let (x, y) = body.turn(self.local.0, self.local.1);
        self.offset - normal.gap(self.ground, (x + body.x, y + body.y))
    }
}

impl<const W: usize> Rows<Slanted<W>, W> {
    /// Sets these lanes to points on level ground.
    #[inline(always)]
    pub(super) fn set_level(&mut self, lanes: Mask<W>, points: &[Point<W>; 2]) {
        self.normal.x = lanes.select(Lanes::ZERO, self.normal.x);
        self.normal.y = lanes.select(Lanes::ONE, self.normal.y);
        for (mine, point) in self.points.iter_mut().zip(points) {
            let choose = |new: (_, _), old: (_, _)| (lanes.select(new.0, old.0), lanes.select(new.1, old.1));
            mine.lever = choose(point.lever, mine.lever);
            mine.local = choose(point.local, mine.local);
            mine.ground = choose(point.ground, mine.ground);
            mine.offset = lanes.select(point.offset, mine.offset);
            mine.normal_impulse = lanes.select(point.normal_impulse, mine.normal_impulse);
            mine.friction_impulse = lanes.select(point.friction_impulse, mine.friction_impulse);
        }
    }
}

impl<N: Normal<W>, const W: usize> Rows<N, W> {
    pub(super) fn new(normal: N) -> Self {
        let zero = Lanes::ZERO;
        let pair_terms = PairTerms {
            first: zero,
            second: zero,
            first_inverse: zero,
            second_inverse: zero,
            inverse_determinant: zero,
            invertible: Mask::NONE,
        };
        Self {
            normal,
            friction: zero,
            points: [Point::NONE; 2],
            near: false,
            pressing: Mask::NONE,
            coupling: zero,
            pair: Mask::NONE,
            pair_any: false,
            pair_terms,
            kept: Kept { impulses: [[zero; 2]; 2], pressing: Mask::NONE },
        }
    }

    /// Forgets what a lane's part pressed on the ground with.
    pub(super) fn reset(&mut self, lane: usize, friction: f32) {
        self.friction.0[lane] = friction;
        for point in &mut self.points {
            point.normal_impulse.0[lane] = 0.0;
            point.friction_impulse.0[lane] = 0.0;
        }
        self.pressing.set_lane(lane, false);
    }

    /// Takes over what another lane's part presses on the ground with; all else is made anew in each step.
    pub(super) fn copy_lane<M>(&mut self, lane: usize, from: &Rows<M, 1>) {
        self.friction.0[lane] = from.friction.0[0];
        for (point, from) in self.points.iter_mut().zip(&from.points) {
            point.normal_impulse.0[lane] = from.normal_impulse.0[0];
            point.friction_impulse.0[lane] = from.friction_impulse.0[0];
        }
        self.pressing.set_lane(lane, from.pressing.lane(0));
    }

    /// Keeps what these lanes press with now, for [`put_back`](Self::put_back) in the same step.
    pub(super) fn keep(&mut self, lanes: Mask<W>) {
        for (point, [normal, friction]) in self.points.iter().zip(&mut self.kept.impulses) {
            *normal = lanes.select(point.normal_impulse, *normal);
            *friction = lanes.select(point.friction_impulse, *friction);
        }
        self.kept.pressing = lanes.select_mask(self.pressing, self.kept.pressing);
    }

    /// Has these lanes press with what was kept of them.
    pub(super) fn put_back(&mut self, lanes: Mask<W>) {
        for (point, [normal, friction]) in self.points.iter_mut().zip(&self.kept.impulses) {
            point.normal_impulse = lanes.select(*normal, point.normal_impulse);
            point.friction_impulse = lanes.select(*friction, point.friction_impulse);
        }
        self.pressing = lanes.select_mask(self.kept.pressing, self.pressing);
    }

    /// No creature is near the ground: no point presses on it.
    #[inline(always)]
    pub(super) fn rest(&mut self) {
        self.near = false;
        self.pressing = Mask::NONE;
        for point in &mut self.points {
            point.normal_impulse = Lanes::ZERO;
            point.friction_impulse = Lanes::ZERO;
        }
    }

    /// Effective masses for this step, once lever, local point, ground, offset and impulses are set.
    #[inline(always)]
    pub(super) fn begin(&mut self, body: &Body<W>, active: [Mask<W>; 2]) {
        let zero = Lanes::ZERO;
        self.pressing = Mask::NONE;
        let (normal_centre, friction_centre) = self.normal.inverse_masses(body);
        for (point, active) in self.points.iter_mut().zip(active) {
            (point.normal_arm, point.friction_arm) = self.normal.arms(point.lever);
            point.normal_impulse = active.select(point.normal_impulse, zero);
            point.friction_impulse = active.select(point.friction_impulse, zero);
            point.normal_spin = body.inverse_inertia * point.normal_arm;
            point.friction_spin = body.inverse_inertia * point.friction_arm;
            let normal_mass = normal_centre + point.normal_spin * point.normal_arm;
            let friction_mass = friction_centre + point.friction_spin * point.friction_arm;
            point.normal_inverse = active.select(normal_mass.inverse(), zero);
            point.friction_inverse = active.select(friction_mass.inverse(), zero);
            point.normal_mass = point.normal_inverse.inverse();
        }
        self.near = active[0].or(active[1]).any();
        let [first, second] = &self.points;
        self.coupling = normal_centre + first.normal_spin * second.normal_arm;
        let determinant = first.normal_mass * second.normal_mass - self.coupling * self.coupling;
        // rapier's condition: nearly the same point twice is solved one after the other.
        let well_conditioned = (Lanes::splat(0.01) * first.normal_mass * second.normal_mass).less(determinant);
        self.pair = active[0].and(active[1]).and(well_conditioned);
        self.pair_any = self.pair.any();
    }

    /// The rows' right sides for where the body is now; the impulses of the last substep are applied again.
    #[inline(always)]
    pub(super) fn prepare(&mut self, body: &mut Body<W>, pace: &Pace<W>) {
        if !self.near {
            return;
        }
        let normal = self.normal;
        for point in &mut self.points {
            let distance = point.distance(&normal, body);
            let zero = Lanes::ZERO;
            let depth = (distance * pace.contact_correction).clamp(-pace.top_correction, zero);
            point.bias = distance.max(zero) * pace.substeps_per_second + depth;
            point.impulse_factor = distance.at_most(zero).select(pace.contact_factor, Lanes::ONE);
        }
        for point in &self.points {
            normal.push(body, point.normal_impulse);
            body.spin += point.normal_spin * point.normal_impulse;
        }
        for point in &self.points {
            normal.drag(body, point.friction_impulse);
            body.spin += point.friction_spin * point.friction_impulse;
        }
        self.prepare_pair();
    }

    /// One relaxing sweep, with friction: what is above the ground may come down to it, nothing is pushed out.
    #[inline(always)]
    pub(super) fn relax(&mut self, body: &mut Body<W>, pace: &Pace<W>) {
        if !self.near {
            return;
        }
        let normal = self.normal;
        for point in &mut self.points {
            point.bias = point.distance(&normal, body).max(Lanes::ZERO) * pace.substeps_per_second;
            point.impulse_factor = Lanes::ONE;
        }
        self.prepare_pair();
        self.solve(body);
        self.solve_friction(body);
    }

    #[inline(always)]
    fn prepare_pair(&mut self) {
        if !self.pair_any {
            return;
        }
        let [first, second] = &self.points;
        let first = first.normal_mass * first.impulse_factor.inverse();
        let second = second.normal_mass * second.impulse_factor.inverse();
        let determinant = first * second - self.coupling * self.coupling;
        self.pair_terms = PairTerms {
            first,
            second,
            first_inverse: first.inverse(),
            second_inverse: second.inverse(),
            inverse_determinant: determinant.inverse(),
            invertible: Lanes::ZERO.less(determinant),
        };
    }

    /// Solves the normal rows once: λ = factor · max(0, λ − (v + bias) / K) for a point alone, the linear
    /// complementarity problem of both for a pair.
    #[inline(always)]
    pub(super) fn solve(&mut self, body: &mut Body<W>) {
        if !self.near {
            return;
        }
        let zero = Lanes::ZERO;
        let [first, second] = &mut self.points;
        let (a, b) = (first.normal_impulse, second.normal_impulse);
        let leaving = self.normal.leaving(body);
        let error_a = leaving + first.normal_arm * body.spin + first.bias;
        let error_b = leaving + second.normal_arm * body.spin + second.bias;
        let mut new_a = first.impulse_factor * (a - first.normal_inverse * error_a).max(zero);
        let error_b_then = error_b + self.coupling * (new_a - a);
        let mut new_b = second.impulse_factor * (b - second.normal_inverse * error_b_then).max(zero);
        if self.pair_any {
            let (pair_a, pair_b) = self.pair_terms.solve(
                [
                    error_a - first.normal_mass * a - self.coupling * b,
                    error_b - self.coupling * a - second.normal_mass * b,
                ],
                self.coupling,
                (a, b),
            );
            new_a = self.pair.select(pair_a, new_a);
            new_b = self.pair.select(pair_b, new_b);
        }
        let (change_a, change_b) = (new_a - a, new_b - b);
        first.normal_impulse = new_a;
        second.normal_impulse = new_b;
        self.normal.push(body, change_a + change_b);
        body.spin += first.normal_spin * change_a + second.normal_spin * change_b;
    }

    /// Solves the friction rows once.
    #[inline(always)]
    fn solve_friction(&mut self, body: &mut Body<W>) {
        for point in &mut self.points {
            let limit = self.friction * point.normal_impulse;
            let error = self.normal.sliding(body) + point.friction_arm * body.spin;
            let impulse = (point.friction_impulse - point.friction_inverse * error).clamp(-limit, limit);
            let change = impulse - point.friction_impulse;
            point.friction_impulse = impulse;
            self.normal.drag(body, change);
            body.spin += point.friction_spin * change;
            self.pressing = self.pressing.or(Lanes::ZERO.less(point.normal_impulse));
        }
    }
}

impl<const W: usize> PairTerms<W> {
    /// The impulses λ ≥ 0 with K λ + b ≥ 0 of which, for each point, one is 0: both points, the first, the second or
    /// none pushes; `before` where rounding leaves none of the four.
    #[inline(always)]
    fn solve(&self, [b1, b2]: [Lanes<W>; 2], coupling: Lanes<W>, before: (Lanes<W>, Lanes<W>)) -> (Lanes<W>, Lanes<W>) {
        let zero = Lanes::ZERO;
        let both_a = (coupling * b2 - self.second * b1) * self.inverse_determinant;
        let both_b = (coupling * b1 - self.first * b2) * self.inverse_determinant;
        let only_a = -b1 * self.first_inverse;
        let only_b = -b2 * self.second_inverse;
        let both = self.invertible.and(zero.at_most(both_a)).and(zero.at_most(both_b));
        let first = zero.at_most(only_a).and(zero.at_most(b2 + coupling * only_a));
        let second = zero.at_most(only_b).and(zero.at_most(b1 + coupling * only_b));
        let none = zero.at_most(b1).and(zero.at_most(b2));
        let a = second.select(zero, none.select(zero, before.0));
        let b = second.select(only_b, none.select(zero, before.1));
        (both.select(both_a, first.select(only_a, a)), both.select(both_b, first.select(zero, b)))
    }
}
