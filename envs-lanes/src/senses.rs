use crate::{
    lanes::{Lanes, angle_of},
    solver::LaneWorld,
};
use creatures::{Probe, Senses, Shape, Source, clock_phase, jump_phase, stride_swing};
use envs_core::{RestPose, next_gap};
use std::sync::Arc;
use tasks::Command;

/// The senses of a creature, for all lanes at once; a lane's inputs have the bits of [`Senses::read`].
#[derive(Clone, Debug)]
pub(crate) struct LaneSenses {
    probes: Vec<Probe>,
    range: f32,
    /// The start pose; its height is one lane's, and not used.
    rest: RestPose,
}

/// What the senses need to know of each lane besides where its parts are.
pub(crate) struct Clocks<'a, const W: usize> {
    /// Seconds since the trial began.
    pub(crate) time: &'a Lanes<W>,
    /// Seconds since the last landing; zeros unless a [landing clock](LaneSenses::hears_landings) needs them.
    pub(crate) since_landing: &'a Lanes<W>,
    /// Height of the torso's centre as the trial began, m.
    pub(crate) rest_height: &'a Lanes<W>,
    /// The gaps of each lane's ground: from and to, m, from left to right.
    pub(crate) gaps: &'a [Arc<[[f32; 2]]>; W],
    /// What each lane is told to do.
    pub(crate) command: &'a [Command; W],
}

impl<const W: usize> Clocks<'_, W> {
    /// Something of what each lane is told.
    #[inline(always)]
    fn told(&self, what: impl Fn(&Command) -> f32) -> Lanes<W> {
        Lanes(std::array::from_fn(|lane| what(&self.command[lane])))
    }

    /// Seconds since each lane's stride clock began.
    #[inline(always)]
    fn stride_time(&self) -> Lanes<W> {
        *self.time - self.told(|command| command.stride_began)
    }
}

impl LaneSenses {
    pub(crate) fn new(senses: &Senses, rest: &RestPose) -> Self {
        Self { probes: senses.probes().to_vec(), range: senses.input_range(), rest: rest.clone() }
    }

    /// Whether a clock begins anew at landings.
    pub(crate) fn hears_landings(&self) -> bool {
        self.probes.iter().any(|probe| matches!(probe.source, Source::LandingSine { .. }))
    }

    #[inline(always)]
    pub(crate) fn read<const W: usize>(&self, world: &LaneWorld<W>, clocks: &Clocks<'_, W>, inputs: &mut [Lanes<W>]) {
        let range = Lanes::splat(self.range);
        for (input, probe) in inputs.iter_mut().zip(&self.probes) {
            let value = self.measure(probe.source, world, clocks);
            let scaled = (value - Lanes::splat(probe.middle)) * Lanes::splat(probe.factor);
            *input = scaled.clamp(-range, range);
        }
    }

    /// The angle of a hinge in each lane, rad.
    #[inline(always)]
    pub(crate) fn joint_angles<const W: usize>(&self, world: &LaneWorld<W>, hinge: usize) -> Lanes<W> {
        let hinge = &self.rest.hinges()[hinge];
        let (parent, child) = (world.body(hinge.parent), world.body(hinge.child));
        let cos = parent.cos * child.cos + parent.sin * child.sin;
        let sin = parent.cos * child.sin - parent.sin * child.cos;
        let (cos, sin) = turned_back(hinge.angle, cos, sin);
        angle_of(cos, sin)
    }

    #[inline(always)]
    fn measure<const W: usize>(&self, source: Source, world: &LaneWorld<W>, clocks: &Clocks<'_, W>) -> Lanes<W> {
        let torso = world.body(0);
        match source {
            Source::TorsoRotation => {
                let (cos, sin) = turned_back(self.rest.torso(), torso.cos, torso.sin);
                angle_of(cos, sin)
            }
            Source::TorsoSpin => torso.spin,
            Source::JointAngle(hinge) => self.joint_angles(world, hinge),
            Source::JointSpeed(hinge) => {
                let hinge = &self.rest.hinges()[hinge];
                world.body(hinge.child).spin - world.body(hinge.parent).spin
            }
            Source::VelocityForward => torso.velocity_x,
            Source::VelocityUp => torso.velocity_y,
            Source::TorsoHeight => torso.y - *clocks.rest_height,
            Source::Contact(part) => world.pressing(part).select(Lanes::ONE, Lanes::ZERO),
            Source::Slip(part) => {
                let body = world.body(part);
                let lowest = -half_height(self.rest.shapes()[part], body.cos.abs(), body.sin.abs());
                world.pressing(part).select(body.velocity_x - body.spin * lowest, Lanes::ZERO)
            }
            Source::GapDistance { length } => nearest_gaps(torso.x, clocks, length, 0),
            Source::GapWidth { length } => nearest_gaps(torso.x, clocks, length, 1),
            Source::Ray { angle, length } => world.distance_to_ground((torso.x, torso.y), angle, length),
            Source::ClockSine { period } => clocks.time.map(|time| libm::sinf(clock_phase(time, period))),
            Source::ClockCosine { period } => clocks.time.map(|time| libm::cosf(clock_phase(time, period))),
            Source::LandingSine { period } => clocks.since_landing.map(|time| libm::sinf(clock_phase(time, period))),
            Source::LandingCosine { period } => clocks.since_landing.map(|time| libm::cosf(clock_phase(time, period))),
            Source::CommandedSpeed => clocks.told(|command| command.speed),
            Source::JumpCommand => clocks.told(|command| f32::from(u8::from(command.jump))),
            Source::StrideSine { period, top } => {
                let swing = clocks.told(|command| stride_swing(command.speed, top));
                swing * clocks.stride_time().map(|time| libm::sinf(clock_phase(time, period)))
            }
            Source::StrideCosine { period, top } => {
                let swing = clocks.told(|command| stride_swing(command.speed, top));
                swing * clocks.stride_time().map(|time| libm::cosf(clock_phase(time, period)))
            }
            Source::JumpSine { period } => clocks.told(|command| libm::sinf(jump_phase(command.since_press, period))),
            Source::JumpSwell { period } => {
                clocks.told(|command| 0.5 * (1.0 - libm::cosf(jump_phase(command.since_press, period))))
            }
            // Lanes have no view of one body that it could be asked with; not a number fails the evaluation.
            Source::Custom { .. } => Lanes::splat(f32::NAN),
        }
    }
}

/// A direction seen from a fixed one. Most creatures start with level parts, whose direction changes nothing.
#[inline(always)]
fn turned_back<const W: usize>([c, s]: [f32; 2], cos: Lanes<W>, sin: Lanes<W>) -> (Lanes<W>, Lanes<W>) {
    if [c, s] == [1.0, 0.0] {
        return (cos, sin);
    }
    let (c, s) = (Lanes::splat(c), Lanes::splat(s));
    (c * cos + s * sin, c * sin - s * cos)
}

/// As [`Shape::half_extents`] has it, from the magnitudes of cosine and sine.
#[inline(always)]
fn half_height<const W: usize>(shape: Shape, c: Lanes<W>, s: Lanes<W>) -> Lanes<W> {
    let half = Lanes::splat(0.5);
    match shape {
        Shape::Box { width, height } => half * (s * Lanes::splat(width) + c * Lanes::splat(height)),
        Shape::Circle { radius } => Lanes::splat(radius),
        Shape::Capsule { length, radius } => half * c * Lanes::splat(length) + Lanes::splat(radius),
    }
}

/// Distance (0) or width (1) of each lane's next gap.
#[inline(always)]
fn nearest_gaps<const W: usize>(x: Lanes<W>, clocks: &Clocks<'_, W>, length: f32, which: usize) -> Lanes<W> {
    Lanes(std::array::from_fn(|lane| next_gap(&clocks.gaps[lane], x.0[lane], length)[which]))
}
