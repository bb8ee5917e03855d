use creatures::Blueprint;
use std::sync::Arc;

/// A push against the torso, along the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Push {
    /// When, s from the start of the trial: before the first step that begins then or later. At least 0.
    pub time: f32,
    /// The impulse over the mass of the whole body, m/s, forwards if above 0; from −100 to 100. The torso is pushed alone,
    /// so its own velocity changes by more.
    pub velocity: f32,
}

/// The pushes of a trial that are still to come.
#[derive(Clone, Debug)]
pub struct PushSchedule {
    /// By time; velocities are the torso's.
    pushes: Arc<[Push]>,
    next: usize,
    /// Of the torso, kg.
    mass: f32,
}

impl PushSchedule {
    /// All of these pushes, for this creature, whose masses are multiplied with a factor.
    pub fn new(pushes: &[Push], blueprint: &Blueprint, mass_factor: f32) -> Self {
        let parts = blueprint.parts();
        let whole: f32 = parts.iter().map(|part| part.mass()).sum();
        let share = whole / parts[0].mass();
        let of_torso = |push: &Push| Push { velocity: push.velocity * share, ..*push };
        let mut pushes: Vec<Push> = pushes.iter().map(of_torso).collect();
        pushes.sort_by(|one, other| one.time.total_cmp(&other.time));
        Self { pushes: pushes.into(), next: 0, mass: parts[0].mass() * mass_factor }
    }

    /// The energy, J, that a torso of this velocity along the ground is given by a push, both in m/s.
    pub fn work(&self, velocity: f32, push: f32) -> f64 {
        let [mass, velocity, push] = [self.mass, velocity, push].map(f64::from);
        mass * push * (velocity + 0.5 * push)
    }

    /// When the next push comes, s; infinity if none does.
    pub fn next_time(&self) -> f32 {
        self.pushes.get(self.next).map_or(f32::INFINITY, |push| push.time)
    }

    /// Takes the next push if it comes before a step that begins at `time`, s: what is added to the torso's velocity along
    /// the ground, m/s. To be called until there is none.
    pub fn take(&mut self, time: f32) -> Option<f32> {
        let push = self.pushes.get(self.next).filter(|push| push.time <= time)?;
        self.next += 1;
        Some(push.velocity)
    }
}
