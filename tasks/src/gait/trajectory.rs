use super::{GaitError, GroundProfile};
use crate::{Body, BodyHinge, PartState, Snapshot};
use std::{
    borrow::Cow,
    f64::consts::{PI, TAU},
};

/// Shorter or longer steps, in s, are no simulation of a creature.
const TIME_STEPS: std::ops::RangeInclusive<f64> = 1e-4..=1.0;
/// How far a step may be from the mean step, as a share of it: clocks are f32.
const UNEVENNESS: f64 = 0.05;

/// A body's way through an episode, checked and ready to be measured: one snapshot a physics step, the first being the
/// settled start.
#[derive(Clone, Debug)]
pub struct Trajectory<'a> {
    body: &'a Body,
    snapshots: Cow<'a, [Snapshot]>,
    time_step: f64,
    tilts: Vec<f64>,
    hinge_angles: Vec<Vec<f64>>,
    work_known: bool,
    ground: Surface,
    backwards: bool,
    swimming: bool,
}

/// What the body moves on.
#[derive(Clone, Debug)]
enum Surface {
    /// Ground at height 0, without end.
    Flat,
    Uneven(GroundProfile),
    /// Water is deep.
    None,
}

impl<'a> Trajectory<'a> {
    /// The snapshots of an episode, as an environment shows them.
    ///
    /// # Errors
    /// If there are fewer than 2 snapshots, one has another number of parts than the body, a number is not finite, the
    /// time step is not constant, or the body is not consistent.
    pub fn new(body: &'a Body, snapshots: &'a [Snapshot]) -> Result<Self, GaitError> {
        Self::checked(body, Cow::Borrowed(snapshots), true)
    }

    /// A recording that holds only time, place, angle and contact: speeds are filled in by central differences (one-sided
    /// at both ends), and the motors' work is unknown, so that there is no cost of transport and no audit of the energy.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn from_positions(body: &'a Body, snapshots: &[Snapshot]) -> Result<Self, GaitError> {
        let time_step = check(body, snapshots)?;
        let mut derived = snapshots.to_vec();
        for (index, snapshot) in derived.iter_mut().enumerate() {
            let (before, after) = (index.saturating_sub(1), (index + 1).min(snapshots.len() - 1));
            let seconds = (after - before) as f64 * time_step;
            for (part, state) in snapshot.parts.iter_mut().enumerate() {
                let (from, to) = (&snapshots[before].parts[part], &snapshots[after].parts[part]);
                state.vx = ((f64::from(to.x) - f64::from(from.x)) / seconds) as f32;
                state.vy = ((f64::from(to.y) - f64::from(from.y)) / seconds) as f32;
                state.spin = (shorter_way(angle_of(to) - angle_of(from)) / seconds) as f32;
            }
        }
        Self::checked(body, Cow::Owned(derived), false)
    }

    /// The same, of a recording that holds speeds, but not the motors' work: there is no cost of transport and no audit of the
    /// energy.
    #[must_use]
    pub fn without_work(self) -> Self {
        Self { work_known: false, ..self }
    }

    /// The same, on ground that is not flat: parts below height 0 are no tunnelling then, and feet are down where they are as
    /// good as on this ground.
    #[must_use]
    pub fn on_terrain(self, ground: GroundProfile) -> Self {
        Self { ground: Surface::Uneven(ground), ..self }
    }

    /// The same, with backwards as the way ahead.
    #[must_use]
    pub(super) fn backwards(self) -> Self {
        Self { backwards: true, ..self }
    }

    /// The same, of a swimmer: what gets ahead is its centre of mass, and there is no ground.
    #[must_use]
    pub(super) fn swimming(self) -> Self {
        Self { swimming: true, ground: Surface::None, ..self }
    }

    fn checked(body: &'a Body, snapshots: Cow<'a, [Snapshot]>, work_known: bool) -> Result<Self, GaitError> {
        let time_step = check(body, &snapshots)?;
        let mut tilts = unwrapped(snapshots.iter().map(|snapshot| angle_of(snapshot.torso())));
        let turns = tilts[0] - shorter_way(tilts[0] - f64::from(body.start_angle));
        tilts.iter_mut().for_each(|tilt| *tilt -= turns);
        let hinge_angles = body.hinges.iter().map(|hinge| angles(hinge, &snapshots)).collect();
        Ok(Self {
            body,
            snapshots,
            time_step,
            tilts,
            hinge_angles,
            work_known,
            ground: Surface::Flat,
            backwards: false,
            swimming: false,
        })
    }

    /// Whose it is.
    pub fn body(&self) -> &Body {
        self.body
    }

    /// One a step, and the start.
    pub fn snapshots(&self) -> &[Snapshot] {
        &self.snapshots
    }

    /// Seconds of a step.
    pub fn time_step(&self) -> f64 {
        self.time_step
    }

    /// The number of steps: one less than the snapshots, at least 1.
    pub fn steps(&self) -> usize {
        self.snapshots.len() - 1
    }

    /// When a step was over, s.
    pub fn time(&self, step: usize) -> f64 {
        step as f64 * self.time_step
    }

    /// How long it lasted, s; positive.
    pub fn seconds(&self) -> f64 {
        self.time(self.steps())
    }

    /// The last snapshot of a share (0 to 1) of the episode.
    pub(super) fn at(&self, share: f64) -> usize {
        (libm::floor(share * self.steps() as f64) as usize).min(self.steps())
    }

    /// How far ahead the torso, or the centre of a swimmer's mass, has come from one snapshot to another, m.
    pub(super) fn progress(&self, from: usize, to: usize) -> f64 {
        let way = self.place(to) - self.place(from);
        if self.backwards { -way } else { way }
    }

    /// The x of what is to get ahead, m.
    fn place(&self, step: usize) -> f64 {
        let snapshot = &self.snapshots[step];
        if !self.swimming {
            return f64::from(snapshot.torso().x);
        }
        let parts = self.body.parts.iter().zip(&snapshot.parts);
        parts.map(|(part, state)| f64::from(part.mass) * f64::from(state.x)).sum::<f64>() / self.mass()
    }

    /// The height of the torso's centre, m.
    pub(super) fn height(&self, step: usize) -> f64 {
        self.snapshots[step].torso().y.into()
    }

    /// The height of a part's lowest point, m.
    pub fn lowest_point(&self, part: usize, step: usize) -> f64 {
        self.body.parts[part].lowest_point(&self.snapshots[step].parts[part]).into()
    }

    /// How far a part's lowest point is above the ground, m; of uneven ground what is below each corner counts. `None` where
    /// the ground is not known.
    pub(super) fn clearance(&self, part: usize, step: usize) -> Option<f64> {
        let Surface::Uneven(ground) = &self.ground else {
            return self.is_flat().then(|| self.lowest_point(part, step));
        };
        let (part, state) = (&self.body.parts[part], &self.snapshots[step].parts[part]);
        let corners = part.corners.iter().map(|&corner| in_world(state, corner));
        let clearances = corners.filter_map(|[x, y]| Some(y - f64::from(part.radius) - ground.height(x)?));
        clearances.min_by(f64::total_cmp)
    }

    /// The height of the centre of mass, m.
    pub fn centre_height(&self, step: usize) -> f64 {
        let parts = self.body.parts.iter().zip(&self.snapshots[step].parts);
        parts.map(|(part, state)| f64::from(part.mass) * f64::from(state.y)).sum::<f64>() / self.mass()
    }

    /// How far the torso is above where it started, m.
    pub(super) fn rise(&self, step: usize) -> f64 {
        f64::from(self.snapshots[step].torso().y) - f64::from(self.snapshots[0].torso().y)
    }

    /// The torso's angle against [that of its file](Body::start_angle), rad, counting whole turns; at the start at most half
    /// a turn.
    pub fn tilts(&self) -> &[f64] {
        &self.tilts
    }

    /// A hinge's angle after each step, rad from the start pose, counting whole turns.
    pub fn hinge_angles(&self, hinge: usize) -> &[f64] {
        &self.hinge_angles[hinge]
    }

    /// The child's angular speed against the parent, rad/s.
    pub(super) fn hinge_speed(&self, hinge: &BodyHinge, step: usize) -> f64 {
        let parts = &self.snapshots[step].parts;
        f64::from(parts[hinge.child].spin) - f64::from(parts[hinge.parent].spin)
    }

    /// The motors' work up to a step, J, if known.
    pub(super) fn work(&self, step: usize) -> Option<f64> {
        self.work_known.then(|| self.snapshots[step].motor_work)
    }

    /// Whether the ground is flat, at height 0.
    pub(super) fn is_flat(&self) -> bool {
        matches!(self.ground, Surface::Flat)
    }

    /// Mass of all parts, kg.
    pub(super) fn mass(&self) -> f64 {
        self.body.parts.iter().map(|part| f64::from(part.mass)).sum()
    }

    /// Height of the torso's centre once settled, m; that of the start pose should a recording start below the ground.
    pub fn start_height(&self) -> f64 {
        let settled = f64::from(self.snapshots[0].torso().y);
        if settled > 0.0 { settled } else { f64::from(self.body.start_height) }
    }

    /// The name of a hinge: that of its child part.
    pub(super) fn hinge_name(&self, hinge: &BodyHinge) -> &str {
        &self.body.parts[hinge.child].name
    }
}

/// A point given in a part's frame, in the world's, m.
pub(super) fn in_world(state: &PartState, point: [f32; 2]) -> [f64; 2] {
    let (cos, sin) = (f64::from(state.cos), f64::from(state.sin));
    let [x, y] = point.map(f64::from);
    [f64::from(state.x) + cos * x - sin * y, f64::from(state.y) + sin * x + cos * y]
}

fn angle_of(state: &PartState) -> f64 {
    libm::atan2(f64::from(state.sin), f64::from(state.cos))
}

/// The same turn, at most half round.
pub(super) fn shorter_way(turn: f64) -> f64 {
    turn - TAU * libm::floor((turn + PI) / TAU)
}

/// Angles without the jumps from π to −π: from each to the next by the shorter way.
fn unwrapped(angles: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut unwrapped: Vec<f64> = Vec::with_capacity(angles.size_hint().0);
    for angle in angles {
        let next = unwrapped.last().map_or(angle, |last| last + shorter_way(angle - last));
        unwrapped.push(next);
    }
    unwrapped
}

/// A hinge's angles, whole turns counted; the first is the one nearest to the middle of its limits.
fn angles(hinge: &BodyHinge, snapshots: &[Snapshot]) -> Vec<f64> {
    let start = f64::from(hinge.start_angle);
    let angle = |snapshot: &Snapshot| {
        shorter_way(angle_of(&snapshot.parts[hinge.child]) - angle_of(&snapshot.parts[hinge.parent]) - start)
    };
    let mut angles = unwrapped(snapshots.iter().map(angle));
    let middle = 0.5 * (f64::from(hinge.limits[0]) + f64::from(hinge.limits[1]));
    if middle.is_finite() && middle.abs() <= TAU {
        let turns = TAU * libm::round((middle - angles[0]) / TAU);
        angles.iter_mut().for_each(|angle| *angle += turns);
    }
    angles
}

/// Checks everything; returns the time step, s.
fn check(body: &Body, snapshots: &[Snapshot]) -> Result<f64, GaitError> {
    check_body(body)?;
    if snapshots.len() < 2 {
        return Err(GaitError::TooShort { snapshots: snapshots.len() });
    }
    for (index, snapshot) in snapshots.iter().enumerate() {
        check_snapshot(body, index, snapshot)?;
    }
    let time = |index: usize| f64::from(snapshots[index].time);
    let expected = (time(snapshots.len() - 1) - time(0)) / (snapshots.len() - 1) as f64;
    for snapshot in 1..snapshots.len() {
        let found = time(snapshot) - time(snapshot - 1);
        if !TIME_STEPS.contains(&expected) || (found - expected).abs() > UNEVENNESS * expected {
            return Err(GaitError::Clock { snapshot, expected, found });
        }
    }
    Ok(expected)
}

fn check_snapshot(body: &Body, index: usize, snapshot: &Snapshot) -> Result<(), GaitError> {
    let (expected, found) = (body.parts.len(), snapshot.parts.len());
    if expected != found {
        return Err(GaitError::Parts { snapshot: index, expected, found });
    }
    let not_finite = |what: String| Err(GaitError::NotFinite { snapshot: index, what });
    if !snapshot.time.is_finite() {
        return not_finite("the time".into());
    }
    if !snapshot.motor_work.is_finite() {
        return not_finite("the motors' work".into());
    }
    if !snapshot.push_work.is_finite() {
        return not_finite("the energy of pushes".into());
    }
    for (part, state) in body.parts.iter().zip(&snapshot.parts) {
        let PartState { x, y, cos, sin, vx, vy, spin, touching: _ } = *state;
        if ![x, y, cos, sin, vx, vy, spin].into_iter().all(f32::is_finite) {
            return not_finite(format!("place or speed of {}", part.name));
        }
    }
    Ok(())
}

fn check_body(body: &Body) -> Result<(), GaitError> {
    let wrong = |what: &str| Err(GaitError::Body { what: what.into() });
    let positive = |number: f32| number.is_finite() && number > 0.0;
    let parts = body.parts.len();
    if parts == 0 {
        return wrong("list of parts is empty");
    }
    if !positive(body.body_length) || !positive(body.start_height) {
        return wrong("length and start height must be positive");
    }
    if !body.gravity.is_finite() || !body.start_angle.is_finite() {
        return wrong("gravity and start angle must be finite");
    }
    for part in &body.parts {
        let finite = part
            .corners
            .iter()
            .flatten()
            .chain([&part.radius, &part.inertia, &part.buoyancy])
            .all(|number| number.is_finite());
        if !finite || part.corners.is_empty() || !positive(part.mass) || part.radius < 0.0 {
            return wrong(&format!("part {} must have a mass, corners and finite numbers", part.name));
        }
    }
    for hinge in &body.hinges {
        if hinge.parent >= parts || hinge.child >= parts {
            return wrong("hinges must join parts that exist");
        }
        let anchors = [hinge.parent_anchor, hinge.child_anchor];
        if !anchors.iter().flatten().all(|number| number.is_finite())
            || !hinge.start_angle.is_finite()
            || hinge.limits.iter().any(|limit| limit.is_nan())
            || hinge.motor.is_some_and(|motor| !motor.top_speed.is_finite())
        {
            return wrong(&format!("hinge of {} has a number that is not finite", body.parts[hinge.child].name));
        }
    }
    if body.legs.iter().any(|leg| leg.is_empty() || leg.iter().any(|&part| part >= parts)) {
        return wrong("legs must be made of parts that exist");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::synthetic::{Pose, body, film};
    use super::*;

    /// The torso's tilt at the start and at the end of half a second, of a torso drawn at one angle that settles at another
    /// and then turns by 0.5 rad.
    fn tilts(drawn: f64, settled: f64) -> [f64; 2] {
        let body = Body { start_angle: drawn as f32, ..body() };
        let script = |step: usize| Pose { tilt: settled + 0.02 * step as f64, ..Pose::standing() };
        let snapshots = film(0.5, script);
        let trajectory = Trajectory::new(&body, &snapshots).expect("consistent");
        [trajectory.tilts()[0], trajectory.tilts()[25]]
    }

    #[test]
    fn tilt_counts_from_the_pose_of_the_file_by_the_shorter_way() {
        for (drawn, settled, tilt) in
            [(0.0, 0.0, 0.0), (0.3, 1.3, 1.0), (3.0, -3.0, TAU - 6.0), (-3.0, 3.0, 6.0 - TAU), (7.0, 7.0 - TAU, 0.0)]
        {
            let [start, end] = tilts(drawn, settled);
            assert!((start - tilt).abs() < 1e-5, "{drawn} {settled}: {start}");
            assert!((end - start - 0.5).abs() < 1e-5, "{drawn} {settled}: {end}");
        }
    }

    #[test]
    fn a_body_that_is_drawn_nowhere_is_refused() {
        let body = Body { start_angle: f32::NAN, ..body() };
        let snapshots = film(0.1, |_| Pose::standing());
        let error = Trajectory::new(&body, &snapshots).expect_err("no angle").to_string();
        assert!(error.contains("gravity and start angle must be finite"), "{error}");
    }
}
