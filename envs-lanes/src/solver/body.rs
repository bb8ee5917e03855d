use crate::lanes::{Lanes, Mask};

/// The same part of `W` creatures.
#[derive(Clone, Debug)]
pub(crate) struct Body<const W: usize> {
    /// Centre, m.
    pub(crate) x: Lanes<W>,
    pub(crate) y: Lanes<W>,
    /// Direction: cosine and sine of the angle against the world.
    pub(crate) cos: Lanes<W>,
    pub(crate) sin: Lanes<W>,
    /// Velocity of the centre, m/s.
    pub(crate) velocity_x: Lanes<W>,
    pub(crate) velocity_y: Lanes<W>,
    /// Angular velocity, rad/s.
    pub(crate) spin: Lanes<W>,
    /// 1 / mass.
    pub(super) inverse_mass: Lanes<W>,
    /// 1 / moment of inertia.
    pub(super) inverse_inertia: Lanes<W>,
    /// What gravity adds to the upward velocity in a substep, m/s.
    pub(super) fall: Lanes<W>,
}

impl<const W: usize> Body<W> {
    pub(super) fn at_rest() -> Self {
        Self {
            x: Lanes::ZERO,
            y: Lanes::ZERO,
            cos: Lanes::ONE,
            sin: Lanes::ZERO,
            velocity_x: Lanes::ZERO,
            velocity_y: Lanes::ZERO,
            spin: Lanes::ZERO,
            inverse_mass: Lanes::ZERO,
            inverse_inertia: Lanes::ZERO,
            fall: Lanes::ZERO,
        }
    }

    pub(super) fn copy_lane(&mut self, lane: usize, from: &Body<1>) {
        self.x.0[lane] = from.x.0[0];
        self.y.0[lane] = from.y.0[0];
        self.cos.0[lane] = from.cos.0[0];
        self.sin.0[lane] = from.sin.0[0];
        self.velocity_x.0[lane] = from.velocity_x.0[0];
        self.velocity_y.0[lane] = from.velocity_y.0[0];
        self.spin.0[lane] = from.spin.0[0];
        self.inverse_mass.0[lane] = from.inverse_mass.0[0];
        self.inverse_inertia.0[lane] = from.inverse_inertia.0[0];
        self.fall.0[lane] = from.fall.0[0];
    }

    /// Takes over where some of the lanes are and how they move.
    pub(super) fn copy_motion(&mut self, lanes: Mask<W>, from: &Self) {
        self.x = lanes.select(from.x, self.x);
        self.y = lanes.select(from.y, self.y);
        self.cos = lanes.select(from.cos, self.cos);
        self.sin = lanes.select(from.sin, self.sin);
        self.velocity_x = lanes.select(from.velocity_x, self.velocity_x);
        self.velocity_y = lanes.select(from.velocity_y, self.velocity_y);
        self.spin = lanes.select(from.spin, self.spin);
    }

    /// Where a vector of the body's own frame points in the world.
    #[inline(always)]
    pub(super) fn turn(&self, x: Lanes<W>, y: Lanes<W>) -> (Lanes<W>, Lanes<W>) {
        (self.cos * x - self.sin * y, self.sin * x + self.cos * y)
    }

    /// Where a point of the body's own frame is in the world.
    #[inline(always)]
    pub(super) fn place(&self, [x, y]: [f32; 2]) -> (Lanes<W>, Lanes<W>) {
        let (x, y) = self.turn(Lanes::splat(x), Lanes::splat(y));
        (self.x + x, self.y + y)
    }

    /// Where a vector of the world points in the body's own frame.
    #[inline(always)]
    pub(super) fn turn_back(&self, x: Lanes<W>, y: Lanes<W>) -> (Lanes<W>, Lanes<W>) {
        (self.cos * x + self.sin * y, self.cos * y - self.sin * x)
    }

    /// Moves by one substep (semi-implicit Euler), at most at `top_speed` and `top_spin`. The turn is linearised: a step
    /// along the tangent, and back onto the unit circle.
    #[inline(always)]
    pub(super) fn advance(&mut self, substep: Lanes<W>, top_spin: Lanes<W>) {
        let speed = (self.velocity_x * self.velocity_x + self.velocity_y * self.velocity_y).sqrt();
        let too_fast = Lanes::splat(TOP_SPEED).less(speed);
        if too_fast.any() {
            let factor = too_fast.select(Lanes::splat(TOP_SPEED) / speed, Lanes::ONE);
            self.velocity_x = self.velocity_x * factor;
            self.velocity_y = self.velocity_y * factor;
        }
        self.spin = self.spin.clamp(-top_spin, top_spin);
        let turn = self.spin * substep;
        let cos = self.cos - turn * self.sin;
        let sin = self.sin + turn * self.cos;
        let length = (cos * cos + sin * sin).sqrt();
        self.cos = cos / length;
        self.sin = sin / length;
        self.x += self.velocity_x * substep;
        self.y += self.velocity_y * substep;
    }
}

/// rapier lets no body move faster, m/s.
const TOP_SPEED: f32 = 400.0;
