use super::body::Body;
use crate::lanes::Lanes;

/// Away from the ground at a contact.
pub(super) trait Normal<const W: usize>: Copy {
    /// How fast a body leaves the ground, m/s.
    fn leaving(&self, body: &Body<W>) -> Lanes<W>;

    /// How fast a body slides, against the direction in which friction impulses count, m/s.
    fn sliding(&self, body: &Body<W>) -> Lanes<W>;

    /// Pushes a body's centre off the ground.
    fn push(&self, body: &mut Body<W>, impulse: Lanes<W>);

    /// Drags a body's centre along the ground.
    fn drag(&self, body: &mut Body<W>, impulse: Lanes<W>);

    /// The part of J M⁻¹ Jᵀ that is the centre's, of the normal row and of the friction row.
    fn inverse_masses(&self, body: &Body<W>) -> (Lanes<W>, Lanes<W>);

    /// The lever arms of push and drag.
    fn arms(&self, lever: (Lanes<W>, Lanes<W>)) -> (Lanes<W>, Lanes<W>);

    /// How far the ground's point is above the body's.
    fn gap(&self, ground: (Lanes<W>, Lanes<W>), point: (Lanes<W>, Lanes<W>)) -> Lanes<W>;
}

/// Level ground: upwards. Without the terms that would be multiplied by zero.
#[derive(Clone, Copy, Debug)]
pub(super) struct Up;

/// Any direction, another in each lane.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slanted<const W: usize> {
    pub(super) x: Lanes<W>,
    pub(super) y: Lanes<W>,
}

impl<const W: usize> Normal<W> for Up {
    #[inline(always)]
    fn leaving(&self, body: &Body<W>) -> Lanes<W> {
        body.velocity_y
    }

    #[inline(always)]
    fn sliding(&self, body: &Body<W>) -> Lanes<W> {
        -body.velocity_x
    }

    #[inline(always)]
    fn push(&self, body: &mut Body<W>, impulse: Lanes<W>) {
        body.velocity_y += body.inverse_mass * impulse;
    }

    #[inline(always)]
    fn drag(&self, body: &mut Body<W>, impulse: Lanes<W>) {
        body.velocity_x -= body.inverse_mass * impulse;
    }

    #[inline(always)]
    fn inverse_masses(&self, body: &Body<W>) -> (Lanes<W>, Lanes<W>) {
        (body.inverse_mass, body.inverse_mass)
    }

    #[inline(always)]
    fn arms(&self, lever: (Lanes<W>, Lanes<W>)) -> (Lanes<W>, Lanes<W>) {
        lever
    }

    #[inline(always)]
    fn gap(&self, ground: (Lanes<W>, Lanes<W>), point: (Lanes<W>, Lanes<W>)) -> Lanes<W> {
        ground.1 - point.1
    }
}

impl<const W: usize> Normal<W> for Slanted<W> {
    #[inline(always)]
    fn leaving(&self, body: &Body<W>) -> Lanes<W> {
        self.x * body.velocity_x + self.y * body.velocity_y
    }

    #[inline(always)]
    fn sliding(&self, body: &Body<W>) -> Lanes<W> {
        -(self.y * body.velocity_x - self.x * body.velocity_y)
    }

    #[inline(always)]
    fn push(&self, body: &mut Body<W>, impulse: Lanes<W>) {
        body.velocity_x += self.x * body.inverse_mass * impulse;
        body.velocity_y += self.y * body.inverse_mass * impulse;
    }

    #[inline(always)]
    fn drag(&self, body: &mut Body<W>, impulse: Lanes<W>) {
        body.velocity_x -= self.y * body.inverse_mass * impulse;
        body.velocity_y += self.x * body.inverse_mass * impulse;
    }

    #[inline(always)]
    fn inverse_masses(&self, body: &Body<W>) -> (Lanes<W>, Lanes<W>) {
        let mass = body.inverse_mass;
        let normal = self.x * (mass * self.x) + self.y * (mass * self.y);
        let friction = self.y * (mass * self.y) + self.x * (mass * self.x);
        (normal, friction)
    }

    #[inline(always)]
    fn arms(&self, (x, y): (Lanes<W>, Lanes<W>)) -> (Lanes<W>, Lanes<W>) {
        (x * self.y - y * self.x, x * self.x + y * self.y)
    }

    #[inline(always)]
    fn gap(&self, ground: (Lanes<W>, Lanes<W>), point: (Lanes<W>, Lanes<W>)) -> Lanes<W> {
        (ground.0 - point.0) * self.x + (ground.1 - point.1) * self.y
    }
}
