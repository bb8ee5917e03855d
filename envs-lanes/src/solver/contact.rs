use super::{body::Body, world::Pace};
use crate::lanes::{Lanes, Mask};
use creatures::Shape;

/// The contact of the same part of `W` creatures with level ground: at most two points, pushed apart along the upward
/// normal and slowed along the ground by Coulomb friction.
#[derive(Clone, Debug)]
pub(super) struct Contact<const W: usize> {
    outline: Outline,
    /// Friction coefficient of part and ground together.
    pub(super) friction: Lanes<W>,
    points: [Point<W>; 2],
    /// J M⁻¹ Jᵀ between the two points' normal rows.
    coupling: Lanes<W>,
    /// Whether both points are there and different enough to be solved as a pair.
    pair: Mask<W>,
    pair_any: bool,
    pair_terms: PairTerms<W>,
    /// Whether any creature is near the ground with this part.
    near: bool,
    /// Whether the part has pressed on the ground in this step.
    pressing: Mask<W>,
}

/// What of a shape can touch level ground.
#[derive(Clone, Copy, Debug)]
enum Outline {
    /// The edge that looks down most.
    Box { half_width: f32, half_height: f32 },
    /// The ends of a segment, rounded.
    Capsule { half_length: f32, radius: f32 },
    /// One point.
    Circle { radius: f32 },
}

/// A point that may touch the ground.
#[derive(Clone, Copy, Debug)]
struct Point<const W: usize> {
    /// Which corner of the shape it is, in the body's own frame: by it, an impulse is known again in the next step.
    corner: (Lanes<W>, Lanes<W>),
    /// The lever from the body's centre in the world as the step began, m.
    lever_x: Lanes<W>,
    lever_y: Lanes<W>,
    /// The point in the body's own frame, and what has to be added to its height for its distance from the ground, m.
    local: (Lanes<W>, Lanes<W>),
    offset: Lanes<W>,
    /// Where the point on the ground is, m above 0: not quite 0 by rounding.
    ground: Lanes<W>,
    /// J M⁻¹ Jᵀ of the normal row, its inverse and that of the friction row; 0 where there is no contact.
    normal_mass: Lanes<W>,
    normal_inverse: Lanes<W>,
    friction_inverse: Lanes<W>,
    /// M⁻¹ Jᵀ of the spin.
    normal_spin: Lanes<W>,
    friction_spin: Lanes<W>,
    bias: Lanes<W>,
    /// 1 / (1 + compliance).
    impulse_factor: Lanes<W>,
    normal_impulse: Lanes<W>,
    friction_impulse: Lanes<W>,
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
    const NONE: Self = Self {
        corner: (Lanes::ZERO, Lanes::ZERO),
        lever_x: Lanes::ZERO,
        lever_y: Lanes::ZERO,
        local: (Lanes::ZERO, Lanes::ZERO),
        offset: Lanes::ZERO,
        ground: Lanes::ZERO,
        normal_mass: Lanes::ZERO,
        normal_inverse: Lanes::ZERO,
        friction_inverse: Lanes::ZERO,
        normal_spin: Lanes::ZERO,
        friction_spin: Lanes::ZERO,
        bias: Lanes::ZERO,
        impulse_factor: Lanes::ONE,
        normal_impulse: Lanes::ZERO,
        friction_impulse: Lanes::ZERO,
    };

    /// The distance from the ground where the body is now, m.
    #[inline(always)]
    fn distance(&self, body: &Body<W>) -> Lanes<W> {
        let (_, height) = body.turn(self.local.0, self.local.1);
        self.offset - (self.ground - (height + body.y))
    }
}

impl<const W: usize> Contact<W> {
    pub(super) fn new(shape: Shape) -> Self {
        let outline = match shape {
            Shape::Box { width, height } => Outline::Box { half_width: width * 0.5, half_height: height * 0.5 },
            Shape::Circle { radius } => Outline::Circle { radius },
            Shape::Capsule { length, radius } => Outline::Capsule { half_length: length * 0.5, radius },
        };
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
            outline,
            friction: zero,
            points: [Point::NONE; 2],
            coupling: zero,
            pair: Mask::NONE,
            pair_any: false,
            pair_terms,
            near: false,
            pressing: Mask::NONE,
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
    pub(super) fn copy_lane(&mut self, lane: usize, from: &Contact<1>) {
        self.friction.0[lane] = from.friction.0[0];
        for (point, from) in self.points.iter_mut().zip(&from.points) {
            point.corner.0.0[lane] = from.corner.0.0[0];
            point.corner.1.0[lane] = from.corner.1.0[0];
            point.normal_impulse.0[lane] = from.normal_impulse.0[0];
            point.friction_impulse.0[lane] = from.friction_impulse.0[0];
        }
        self.pressing.set_lane(lane, from.pressing.lane(0));
    }

    /// Which creatures have pressed on the ground with this part in the last step.
    #[inline(always)]
    pub(super) fn pressing(&self) -> Mask<W> {
        self.pressing
    }

    /// Finds the points that are within `reach` m of the ground. Points that were there in the last step keep their
    /// impulses.
    #[inline(always)]
    pub(super) fn find(&mut self, body: &Body<W>, reach: f32) {
        self.pressing = Mask::NONE;
        let zero = Lanes::ZERO;
        let reach = Lanes::splat(reach);
        self.near = self.lowest(body).less(reach).any();
        if !self.near {
            for point in &mut self.points {
                point.normal_impulse = zero;
                point.friction_impulse = zero;
            }
            return;
        }
        let corners = self.corners(body);
        let before = self.points;
        let mut active = [Mask::NONE; 2];
        for ((point, active), corner) in self.points.iter_mut().zip(&mut active).zip(corners) {
            let Some((x, y)) = corner else { continue };
            point.corner = (x, y);
            let distance = point.place(body, self.outline);
            *active = distance.less(reach);
            let [mut normal, mut friction] = [zero; 2];
            for old in &before {
                let same = x.equal(old.corner.0).and(y.equal(old.corner.1));
                normal = same.select(old.normal_impulse, normal);
                friction = same.select(old.friction_impulse, friction);
            }
            point.normal_impulse = active.select(normal, zero);
            point.friction_impulse = active.select(friction, zero);
            point.normal_spin = body.inverse_inertia * point.lever_x;
            point.friction_spin = body.inverse_inertia * point.lever_y;
            let normal_mass = body.inverse_mass + point.normal_spin * point.lever_x;
            let friction_mass = body.inverse_mass + point.friction_spin * point.lever_y;
            point.normal_inverse = active.select(normal_mass.inverse(), zero);
            point.friction_inverse = active.select(friction_mass.inverse(), zero);
            point.normal_mass = point.normal_inverse.inverse();
        }
        self.near = active[0].or(active[1]).any();
        let [first, second] = &self.points;
        self.coupling = body.inverse_mass + first.normal_spin * second.lever_x;
        let determinant = first.normal_mass * second.normal_mass - self.coupling * self.coupling;
        // rapier's condition: nearly the same point twice is solved one after the other.
        let well_conditioned = (Lanes::splat(0.01) * first.normal_mass * second.normal_mass).less(determinant);
        self.pair = active[0].and(active[1]).and(well_conditioned);
        self.pair_any = self.pair.any();
    }

    /// At most the height of the lowest point.
    #[inline(always)]
    fn lowest(&self, body: &Body<W>) -> Lanes<W> {
        let margin = Lanes::splat(1e-3);
        let reach = match self.outline {
            Outline::Box { half_width, half_height } => {
                body.sin.abs() * Lanes::splat(half_width) + body.cos.abs() * Lanes::splat(half_height)
            }
            Outline::Capsule { half_length, radius } => {
                body.cos.abs() * Lanes::splat(half_length) + Lanes::splat(radius)
            }
            Outline::Circle { radius } => Lanes::splat(radius),
        };
        body.y - reach - margin
    }

    /// The corners that may touch, in the body's own frame.
    #[inline(always)]
    fn corners(&self, body: &Body<W>) -> [Option<(Lanes<W>, Lanes<W>)>; 2] {
        let zero = Lanes::ZERO;
        match self.outline {
            Outline::Box { half_width, half_height } => {
                let (width, height) = (Lanes::splat(half_width), Lanes::splat(half_height));
                // Downwards, seen from the body, is (-sin, -cos); the edge across the larger of the two looks down most.
                let level = body.sin.abs().at_most(body.cos.abs());
                let (side_x, side_y) = (width.with_sign_of(-body.sin), height.with_sign_of(-body.cos));
                let first = (level.select(width, side_x), level.select(side_y, height));
                let second = (level.select(-width, side_x), level.select(side_y, -height));
                [Some(first), Some(second)]
            }
            Outline::Capsule { half_length, .. } => {
                let half = Lanes::splat(half_length);
                [Some((zero, -half)), Some((zero, half))]
            }
            Outline::Circle { .. } => [Some((zero, zero)), None],
        }
    }

    /// The rows' right sides for where the body is now; the impulses of the last substep are applied again.
    #[inline(always)]
    pub(super) fn prepare(&mut self, body: &mut Body<W>, pace: &Pace<W>) {
        if !self.near {
            return;
        }
        for point in &mut self.points {
            let distance = point.distance(body);
            let zero = Lanes::ZERO;
            let depth = (distance * pace.contact_correction).clamp(-pace.top_correction, zero);
            point.bias = distance.max(zero) * pace.substeps_per_second + depth;
            point.impulse_factor = distance.at_most(zero).select(pace.contact_factor, Lanes::ONE);
        }
        for point in &self.points {
            body.velocity_y += body.inverse_mass * point.normal_impulse;
            body.spin += point.normal_spin * point.normal_impulse;
        }
        for point in &self.points {
            body.velocity_x -= body.inverse_mass * point.friction_impulse;
            body.spin += point.friction_spin * point.friction_impulse;
        }
        self.prepare_pair();
    }

    /// The right sides of a relaxing sweep: what is above the ground may come down to it, nothing is pushed out.
    #[inline(always)]
    pub(super) fn prepare_relaxation(&mut self, body: &Body<W>, pace: &Pace<W>) {
        if !self.near {
            return;
        }
        for point in &mut self.points {
            point.bias = point.distance(body).max(Lanes::ZERO) * pace.substeps_per_second;
            point.impulse_factor = Lanes::ONE;
        }
        self.prepare_pair();
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
        let error_a = body.velocity_y + first.lever_x * body.spin + first.bias;
        let error_b = body.velocity_y + second.lever_x * body.spin + second.bias;
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
        body.velocity_y += body.inverse_mass * (change_a + change_b);
        body.spin += first.normal_spin * change_a + second.normal_spin * change_b;
    }

    /// Solves the friction rows once; part of a relaxing sweep only.
    #[inline(always)]
    pub(super) fn solve_friction(&mut self, body: &mut Body<W>) {
        if !self.near {
            return;
        }
        for point in &mut self.points {
            let limit = self.friction * point.normal_impulse;
            let error = point.lever_y * body.spin - body.velocity_x;
            let impulse = (point.friction_impulse - point.friction_inverse * error).clamp(-limit, limit);
            let change = impulse - point.friction_impulse;
            point.friction_impulse = impulse;
            body.velocity_x -= body.inverse_mass * change;
            body.spin += point.friction_spin * change;
            self.pressing = self.pressing.or(Lanes::ZERO.less(point.normal_impulse));
        }
    }
}

impl<const W: usize> Point<W> {
    /// Sets lever and local point from the corner; returns the distance from the ground, m.
    #[inline(always)]
    fn place(&mut self, body: &Body<W>, outline: Outline) -> Lanes<W> {
        let half = Lanes::splat(0.5);
        let (x, y) = self.corner;
        let (turned_x, turned_y) = body.turn(x, y);
        let (corner_x, corner_y) = (turned_x + body.x, turned_y + body.y);
        // The surface point and the one below it on the ground, and how far apart they are.
        let (surface, distance) = match outline {
            Outline::Box { .. } => ((corner_x, corner_y), corner_y),
            Outline::Capsule { radius, .. } => {
                let radius = Lanes::splat(radius);
                let (x, y) = body.turn(x - body.sin * radius, y - body.cos * radius);
                ((x + body.x, y + body.y), corner_y - radius)
            }
            Outline::Circle { radius } => {
                let radius = Lanes::splat(radius);
                let (x, y) = body.turn(-body.sin * radius, -body.cos * radius);
                ((x + body.x, y + body.y), body.y - radius)
            }
        };
        let ground_x = if matches!(outline, Outline::Circle { .. }) { body.x } else { corner_x };
        let ground_y = surface.1 - distance;
        // Halfway between the two; the lever stays as it is for the whole step.
        let (middle_x, middle_y) = ((ground_x + surface.0) * half, (ground_y + surface.1) * half);
        self.lever_x = middle_x - body.x;
        self.lever_y = middle_y - body.y;
        self.local = body.turn_back((body.x + self.lever_x) - body.x, (body.y + self.lever_y) - body.y);
        // rapier carries the surface point through the body's own frame, which rounds it.
        let (local_x, local_y) = body.turn_back(surface.0 - body.x, surface.1 - body.y);
        let (_, height) = body.turn(local_x, local_y);
        let carried = (height + body.y) - ground_y;
        self.ground = middle_y;
        self.offset = carried + (middle_y - (body.y + self.lever_y));
        distance
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
