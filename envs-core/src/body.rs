use crate::Engine;
use creatures::{
    Blueprint, BodyView, Hinge, Landings, Shape,
    rotation::{angle_from, turned_back},
};
use tasks::{PartState, Snapshot};

/// What the senses need to know of a creature besides where its parts are now.
#[derive(Clone, Debug, PartialEq)]
pub struct RestPose {
    torso: [f32; 2],
    height: f32,
    hinges: Vec<RestHinge>,
    shapes: Vec<Shape>,
}

/// A hinge in the start pose.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RestHinge {
    /// Index of its parent part.
    pub parent: usize,
    /// Index of its child part.
    pub child: usize,
    /// Cosine and sine of the child's angle against the parent in the creature's file.
    pub angle: [f32; 2],
}

impl RestPose {
    /// Angles come from the creature's file, the height from the settled creature.
    pub(crate) fn new(blueprint: &Blueprint, settled: &Snapshot) -> Self {
        let parts = blueprint.parts();
        let hinge = |hinge: &Hinge| {
            let angle = parts[hinge.child].angle - parts[hinge.parent].angle;
            RestHinge { parent: hinge.parent, child: hinge.child, angle: [libm::cosf(angle), libm::sinf(angle)] }
        };
        let start = parts[0].angle;
        Self {
            torso: [libm::cosf(start), libm::sinf(start)],
            height: settled.torso().y,
            hinges: blueprint.hinges().iter().map(hinge).collect(),
            shapes: parts.iter().map(|part| part.shape).collect(),
        }
    }

    /// Cosine and sine of the torso's angle in the creature's file.
    pub fn torso(&self) -> [f32; 2] {
        self.torso
    }

    /// Height of the torso's centre in the settled start pose, m.
    pub fn height(&self) -> f32 {
        self.height
    }

    /// The shapes of the parts.
    pub fn shapes(&self) -> &[Shape] {
        &self.shapes
    }

    /// The hinges, in order of [`Blueprint::hinges`].
    pub fn hinges(&self) -> &[RestHinge] {
        &self.hinges
    }
}

/// A creature as its sensors see it: the last snapshot against the start pose.
pub(crate) struct Body<'a, E> {
    pub(crate) engine: &'a E,
    pub(crate) snapshot: &'a Snapshot,
    pub(crate) rest: &'a RestPose,
    /// From left to right, m.
    pub(crate) gaps: &'a [[f32; 2]],
    pub(crate) landings: Landings,
}

/// What [`BodyView::next_gap`] tells of these gaps (from and to, m, from left to right) at x, m.
pub fn next_gap(gaps: &[[f32; 2]], x: f32, length: f32) -> [f32; 2] {
    let next = gaps.partition_point(|&[_, to]| to <= x);
    match gaps.get(next) {
        Some(&[from, to]) if from - x < length => [(from - x).max(0.0), to - from],
        _ => [length, 0.0],
    }
}

fn direction(part: &PartState) -> [f32; 2] {
    [part.cos, part.sin]
}

impl<E: Engine> BodyView for Body<'_, E> {
    fn torso_rotation(&self) -> f32 {
        angle_from(self.rest.torso, direction(self.snapshot.torso()))
    }

    fn torso_spin(&self) -> f32 {
        self.snapshot.torso().spin
    }

    fn joint_angle(&self, hinge: usize) -> f32 {
        let RestHinge { parent, child, angle } = self.rest.hinges[hinge];
        let parts = &self.snapshot.parts;
        angle_from(angle, turned_back(direction(&parts[parent]), direction(&parts[child])))
    }

    fn joint_speed(&self, hinge: usize) -> f32 {
        let RestHinge { parent, child, .. } = self.rest.hinges[hinge];
        self.snapshot.parts[child].spin - self.snapshot.parts[parent].spin
    }

    fn torso_velocity(&self) -> [f32; 2] {
        let torso = self.snapshot.torso();
        [torso.vx, torso.vy]
    }

    fn torso_height(&self) -> f32 {
        self.snapshot.torso().y - self.rest.height
    }

    fn touches_ground(&self, part: usize) -> bool {
        self.snapshot.parts[part].touching
    }

    fn slip(&self, part: usize) -> f32 {
        let (state, shape) = (&self.snapshot.parts[part], self.rest.shapes[part]);
        match state.touching {
            // The velocity of the point below the centre.
            true => state.vx - state.spin * shape.lowest_point(state.cos, state.sin),
            false => 0.0,
        }
    }

    fn next_gap(&self, length: f32) -> [f32; 2] {
        next_gap(self.gaps, self.snapshot.torso().x, length)
    }

    fn distance_along_ray(&self, angle: f32, length: f32) -> f32 {
        let torso = self.snapshot.torso();
        self.engine.distance_to_ground([torso.x, torso.y], angle, length)
    }

    fn time(&self) -> f32 {
        self.snapshot.time
    }

    fn time_since_landing(&self) -> f32 {
        self.landings.since(self.snapshot.time)
    }

    fn commanded_speed(&self) -> f32 {
        self.snapshot.command.speed
    }

    fn is_told_to_jump(&self) -> bool {
        self.snapshot.command.jump
    }

    fn time_since_press(&self) -> f32 {
        self.snapshot.command.since_press
    }

    fn stride_time(&self) -> f32 {
        self.snapshot.time - self.snapshot.command.stride_began
    }
}
