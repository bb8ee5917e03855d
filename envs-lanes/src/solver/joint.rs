use super::{body::Body, pace::Pace};
use crate::lanes::{Lanes, Mask, angle_of};
use creatures::{Blueprint, Hinge};
use std::f32::consts::PI;

/// The same hinge of `W` creatures: two rows that keep the anchors together, one for the motor, one for the limits.
///
/// A row is a condition J v = b on the velocities of the two bodies, solved by an impulse along J (Catto, *Soft
/// Constraints*): λ += (J v + bias − gain λ) / (J M⁻¹ Jᵀ + gain).
#[derive(Clone, Debug)]
pub(super) struct Joint<const W: usize> {
    pub(super) parent: usize,
    pub(super) child: usize,
    parent_anchor: [f32; 2],
    child_anchor: [f32; 2],
    /// Cosine and sine by which the child's frame is turned so that the angle is zero in the middle of its range; none if
    /// it is not turned.
    frame: Option<[f32; 2]>,
    limits: Option<Limits>,
    motor: Option<Motor<W>>,
    /// Along the parent's own axes.
    anchors: [Row<W>; 2],
    limit: LimitRow<W>,
}

#[derive(Clone, Debug)]
struct Motor<const W: usize> {
    /// The speed asked for, rad/s.
    wanted: Lanes<W>,
    /// The largest impulse in a substep, N·m·s.
    top_impulse: Lanes<W>,
    /// 1 / (J M⁻¹ Jᵀ + gain).
    inverse: Lanes<W>,
    gain: Lanes<W>,
    impulse: Lanes<W>,
    /// N·m.
    top_torque: Lanes<W>,
    /// The torque for each rad/s that is lacking, N·m·s.
    strength: Lanes<W>,
    /// How fast the hinge turned before the last step, rad/s.
    before: Lanes<W>,
}

/// How far a joint may move from the middle of its range.
#[derive(Clone, Copy, Debug)]
struct Limits {
    /// rad.
    half_range: f32,
    /// A cosine at or below which the angle may be out of range; a little too large, to be on the safe side.
    near: f32,
}

#[derive(Clone, Copy, Debug)]
struct Row<const W: usize> {
    /// J: along the velocities and against the spins of parent and child.
    x: Lanes<W>,
    y: Lanes<W>,
    parent: Lanes<W>,
    child: Lanes<W>,
    /// M⁻¹ Jᵀ of the spins.
    parent_spin: Lanes<W>,
    child_spin: Lanes<W>,
    /// 1 / (J M⁻¹ Jᵀ + gain).
    inverse: Lanes<W>,
    gain: Lanes<W>,
    bias: Lanes<W>,
    impulse: Lanes<W>,
}

#[derive(Clone, Copy, Debug)]
struct LimitRow<const W: usize> {
    row: Row<W>,
    /// The impulse may only push back into the range.
    lowest: Lanes<W>,
    highest: Lanes<W>,
    /// Whether any creature is at a limit.
    any: bool,
}

/// The velocities of parent and child while rows are solved.
struct Pair<const W: usize> {
    parent: (Lanes<W>, Lanes<W>, Lanes<W>),
    child: (Lanes<W>, Lanes<W>, Lanes<W>),
}

/// From the centres of parent and child to the hinge, in the world.
struct Levers<const W: usize> {
    parent: (Lanes<W>, Lanes<W>),
    child: (Lanes<W>, Lanes<W>),
}

impl<const W: usize> Levers<W> {
    /// The row that keeps the anchors together along an axis.
    #[inline(always)]
    fn row(&self, (x, y): (Lanes<W>, Lanes<W>), bias: Lanes<W>, parent: &Body<W>, child: &Body<W>) -> Row<W> {
        let of_parent = self.parent.0 * y - self.parent.1 * x;
        let of_child = self.child.0 * y - self.child.1 * x;
        Row {
            x,
            y,
            parent: of_parent,
            child: of_child,
            parent_spin: parent.inverse_inertia * of_parent,
            child_spin: child.inverse_inertia * of_child,
            inverse: Lanes::ZERO,
            gain: Lanes::ZERO,
            bias,
            impulse: Lanes::ZERO,
        }
    }
}

impl<const W: usize> Row<W> {
    const NONE: Self = Self {
        x: Lanes::ZERO,
        y: Lanes::ZERO,
        parent: Lanes::ZERO,
        child: Lanes::ZERO,
        parent_spin: Lanes::ZERO,
        child_spin: Lanes::ZERO,
        inverse: Lanes::ZERO,
        gain: Lanes::ZERO,
        bias: Lanes::ZERO,
        impulse: Lanes::ZERO,
    };

    /// J M⁻¹ Jᵀ of two rows, the other's spins with their inertia.
    #[inline(always)]
    fn coupling(&self, mass: Lanes<W>, other: &Self) -> Lanes<W> {
        let linear = self.x * (mass * other.x) + self.y * (mass * other.y);
        linear + self.parent_spin * other.parent + self.child_spin * other.child
    }

    /// Takes out the part of this row that `other` does already, so that solving one does not undo the other (modified
    /// Gram–Schmidt).
    #[inline(always)]
    fn make_independent_of(&mut self, other: &Self, mass: Lanes<W>, other_inverse: Lanes<W>) {
        let share = self.coupling(mass, other) * other_inverse;
        self.x -= other.x * share;
        self.y -= other.y * share;
        self.parent -= other.parent * share;
        self.child -= other.child * share;
        self.parent_spin -= other.parent_spin * share;
        self.child_spin -= other.child_spin * share;
        self.bias -= other.bias * share;
    }

    /// Sets gain and inverse; returns the inverse without the gain.
    #[inline(always)]
    fn finish(&mut self, mass: Lanes<W>, compliance: Lanes<W>) -> Lanes<W> {
        let own = self.coupling(mass, self);
        self.gain = own * compliance;
        self.inverse = (own + self.gain).inverse();
        own.inverse()
    }

    /// How far the velocities are from what the row wants.
    #[inline(always)]
    fn error(&self, pair: &Pair<W>) -> Lanes<W> {
        let linear = self.x * (pair.child.0 - pair.parent.0) + self.y * (pair.child.1 - pair.parent.1);
        linear + (self.child * pair.child.2 - self.parent * pair.parent.2)
    }

    /// Applies the change of impulse from `self.impulse` to `impulse`.
    #[inline(always)]
    fn apply(&mut self, impulse: Lanes<W>, parent_mass: Lanes<W>, child_mass: Lanes<W>, pair: &mut Pair<W>) {
        let change = impulse - self.impulse;
        self.impulse = impulse;
        let (x, y) = (self.x * change, self.y * change);
        pair.parent.0 += x * parent_mass;
        pair.parent.1 += y * parent_mass;
        pair.parent.2 += self.parent_spin * change;
        pair.child.0 -= x * child_mass;
        pair.child.1 -= y * child_mass;
        pair.child.2 -= self.child_spin * change;
    }
}

impl Limits {
    /// None for a range of a whole turn, which rapier does not limit.
    fn new([low, high]: [f32; 2]) -> Option<Self> {
        let half_range = (high - low) * 0.5;
        (half_range < PI).then(|| Self { half_range, near: libm::cosf(half_range) + 1e-4 })
    }
}

impl<const W: usize> Joint<W> {
    pub(super) fn new(blueprint: &Blueprint, hinge: &Hinge) -> Self {
        let [low, high] = hinge.limits;
        let middle = (low + high) * 0.5;
        let turned = blueprint.parts()[hinge.parent].angle - blueprint.parts()[hinge.child].angle - middle;
        let (sin, cos) = libm::sincosf(turned);
        let motor = Motor {
            wanted: Lanes::ZERO,
            top_impulse: Lanes::ZERO,
            inverse: Lanes::ZERO,
            gain: Lanes::ZERO,
            impulse: Lanes::ZERO,
            top_torque: Lanes::ZERO,
            strength: Lanes::ZERO,
            before: Lanes::ZERO,
        };
        Self {
            parent: hinge.parent,
            child: hinge.child,
            parent_anchor: hinge.parent_anchor,
            child_anchor: hinge.child_anchor,
            frame: if turned == 0.0 { None } else { Some([cos, sin]) },
            limits: Limits::new(hinge.limits),
            motor: hinge.motor.map(|_| motor),
            anchors: [Row::NONE; 2],
            limit: LimitRow { row: Row::NONE, lowest: Lanes::ZERO, highest: Lanes::ZERO, any: false },
        }
    }

    /// Sets what a lane's motor can do; it holds still until it is asked for a speed.
    pub(super) fn reset_motor(&mut self, lane: usize, top_torque: f32, gain: f32, substep: f32, bodies: &[Body<W>]) {
        let Some(motor) = &mut self.motor else { return };
        motor.top_torque.0[lane] = top_torque;
        motor.strength.0[lane] = gain;
        motor.before.0[lane] = 0.0;
        let gain = 1.0 / (substep * gain);
        let own = bodies[self.parent].inverse_inertia.0[lane] + bodies[self.child].inverse_inertia.0[lane];
        motor.wanted.0[lane] = 0.0;
        motor.top_impulse.0[lane] = top_torque * substep;
        motor.gain.0[lane] = gain;
        motor.inverse.0[lane] = 1.0 / (own + gain);
        motor.impulse.0[lane] = 0.0;
    }

    /// Takes over another lane's motor; all else is made anew in each substep.
    pub(super) fn copy_lane(&mut self, lane: usize, from: &Joint<1>) {
        let (Some(motor), Some(from)) = (&mut self.motor, &from.motor) else { return };
        motor.wanted.0[lane] = from.wanted.0[0];
        motor.top_impulse.0[lane] = from.top_impulse.0[0];
        motor.inverse.0[lane] = from.inverse.0[0];
        motor.gain.0[lane] = from.gain.0[0];
        motor.impulse.0[lane] = from.impulse.0[0];
        motor.top_torque.0[lane] = from.top_torque.0[0];
        motor.strength.0[lane] = from.strength.0[0];
        motor.before.0[lane] = from.before.0[0];
    }

    /// The speeds asked of the motors, rad/s, to be set.
    #[inline(always)]
    pub(super) fn wanted_speed(&mut self) -> Option<&mut Lanes<W>> {
        self.motor.as_mut().map(|motor| &mut motor.wanted)
    }

    /// Sets what the motor gave in the last substep, in some of the lanes, N·m·s.
    pub(super) fn set_motor_impulse(&mut self, lanes: Mask<W>, impulse: Lanes<W>) {
        if let Some(motor) = &mut self.motor {
            motor.impulse = lanes.select(impulse, motor.impulse);
        }
    }

    /// The impulse the motor gave in the last substep, N·m·s.
    #[inline(always)]
    pub(super) fn motor_impulse(&self) -> Lanes<W> {
        self.motor.as_ref().map_or(Lanes::ZERO, |motor| motor.impulse)
    }

    /// Remembers how fast the hinge turns before a step.
    #[inline(always)]
    pub(super) fn begin(&mut self, bodies: &[Body<W>]) {
        let speed = self.speed(bodies);
        if let Some(motor) = &mut self.motor {
            motor.before = speed;
        }
    }

    /// rad/s.
    #[inline(always)]
    fn speed(&self, bodies: &[Body<W>]) -> Lanes<W> {
        bodies[self.child].spin - bodies[self.parent].spin
    }

    /// The mean power of the motor in the last step, W, as [`Engine::motor_power`](envs_core::Engine::motor_power) has it.
    #[inline(always)]
    pub(super) fn motor_power(&self, bodies: &[Body<W>], pace: &Pace<W>) -> Lanes<W> {
        let Some(motor) = &self.motor else { return Lanes::ZERO };
        let last = motor.impulse / pace.substep;
        let after = self.speed(bodies);
        let speed = Lanes::splat(0.5) * (motor.before + after);
        let rest = ((speed - motor.wanted) * motor.strength).clamp(-motor.top_torque, motor.top_torque);
        let mean = last * pace.last_share + rest * (Lanes::ONE - pace.last_share);
        (last * after).abs() + (mean.abs() - last.abs()).max(Lanes::ZERO) * speed.abs()
    }

    /// The rows for where the bodies are now.
    #[inline(always)]
    pub(super) fn prepare(&mut self, bodies: &[Body<W>], pace: &Pace<W>) {
        let (parent, child) = (&bodies[self.parent], &bodies[self.child]);
        let (parent_x, parent_y) = parent.place(self.parent_anchor);
        let (child_x, child_y) = child.place(self.child_anchor);
        let (gap_x, gap_y) = (child_x - parent_x, child_y - parent_y);
        // The axes are the parent's own. Both levers reach to the child's anchor, the parent's up to rounding.
        let (along, across) = ((parent.cos, parent.sin), (-parent.sin, parent.cos));
        let gap_along = gap_x * along.0 + gap_y * along.1;
        let gap_across = gap_x * across.0 + gap_y * across.1;
        let lever_x = child_x - along.0 * gap_along - across.0 * gap_across - parent.x;
        let lever_y = child_y - along.1 * gap_along - across.1 * gap_across - parent.y;
        let levers = Levers { parent: (lever_x, lever_y), child: (child_x - child.x, child_y - child.y) };
        let mass = parent.inverse_mass + child.inverse_mass;
        let mut first = levers.row(along, gap_along * pace.joint_correction, parent, child);
        let mut second = levers.row(across, gap_across * pace.joint_correction, parent, child);
        let first_inverse = first.finish(mass, pace.joint_compliance);
        second.make_independent_of(&first, mass, first_inverse);
        let second_inverse = second.finish(mass, pace.joint_compliance);
        self.anchors = [first, second];
        if let Some(motor) = &mut self.motor {
            motor.impulse = Lanes::ZERO;
        }
        self.prepare_limit(bodies, pace, [first_inverse, second_inverse]);
    }

    /// The row of the limits, if any creature is at one.
    #[inline(always)]
    fn prepare_limit(&mut self, bodies: &[Body<W>], pace: &Pace<W>, inverses: [Lanes<W>; 2]) {
        self.limit.any = false;
        let Some(limits) = self.limits else { return };
        let (parent, child) = (&bodies[self.parent], &bodies[self.child]);
        let (child_cos, child_sin) = match self.frame {
            None => (child.cos, child.sin),
            Some([c, s]) => child.turn(Lanes::splat(c), Lanes::splat(s)),
        };
        let cos = parent.cos * child_cos + parent.sin * child_sin;
        let sin = parent.cos * child_sin - parent.sin * child_cos;
        if !cos.at_most(Lanes::splat(limits.near)).any() {
            return;
        }
        let angle = angle_of(cos, sin);
        let half = Lanes::splat(limits.half_range);
        let (below, above) = (angle.at_most(-half), half.at_most(angle));
        self.limit.any = below.or(above).any();
        if !self.limit.any {
            return;
        }
        let zero = Lanes::ZERO;
        self.limit.lowest = below.select(Lanes::splat(f32::NEG_INFINITY), zero);
        self.limit.highest = above.select(Lanes::splat(f32::INFINITY), zero);
        let depth = (angle - half).max(zero) - (-half - angle).max(zero);
        let bias = (depth * pace.joint_correction).clamp(-pace.top_correction, pace.top_correction);
        let mut row = Row {
            x: zero,
            y: zero,
            parent: Lanes::ONE,
            child: Lanes::ONE,
            parent_spin: parent.inverse_inertia,
            child_spin: child.inverse_inertia,
            inverse: zero,
            gain: zero,
            bias,
            impulse: zero,
        };
        let mass = parent.inverse_mass + child.inverse_mass;
        row.make_independent_of(&self.anchors[0], mass, inverses[0]);
        row.make_independent_of(&self.anchors[1], mass, inverses[1]);
        row.finish(mass, pace.joint_compliance);
        self.limit.row = row;
    }

    /// Solves all rows once. A relaxing sweep leaves out what would push the anchors together and the angle back.
    #[inline(always)]
    pub(super) fn solve<const RELAX: bool>(&mut self, bodies: &mut [Body<W>]) {
        let (parent, child) = (&bodies[self.parent], &bodies[self.child]);
        let (parent_mass, child_mass) = (parent.inverse_mass, child.inverse_mass);
        let mut pair = Pair {
            parent: (parent.velocity_x, parent.velocity_y, parent.spin),
            child: (child.velocity_x, child.velocity_y, child.spin),
        };
        if let Some(motor) = &mut self.motor {
            let error = (pair.child.2 - pair.parent.2) + -motor.wanted;
            let impulse = motor.impulse + motor.inverse * (error - motor.gain * motor.impulse);
            let impulse = impulse.clamp(-motor.top_impulse, motor.top_impulse);
            let change = impulse - motor.impulse;
            motor.impulse = impulse;
            pair.parent.2 += parent.inverse_inertia * change;
            pair.child.2 -= child.inverse_inertia * change;
        }
        for row in &mut self.anchors {
            let error = row.error(&pair);
            let error = if RELAX { error } else { error + row.bias };
            let impulse = row.impulse + row.inverse * (error - row.gain * row.impulse);
            row.apply(impulse, parent_mass, child_mass, &mut pair);
        }
        if self.limit.any {
            let row = &mut self.limit.row;
            let error = row.error(&pair);
            let error = if RELAX { error } else { error + row.bias };
            let impulse = row.impulse + row.inverse * (error - row.gain * row.impulse);
            let impulse = impulse.clamp(self.limit.lowest, self.limit.highest);
            row.apply(impulse, parent_mass, child_mass, &mut pair);
        }
        let parent = &mut bodies[self.parent];
        (parent.velocity_x, parent.velocity_y, parent.spin) = pair.parent;
        let child = &mut bodies[self.child];
        (child.velocity_x, child.velocity_y, child.spin) = pair.child;
    }
}
