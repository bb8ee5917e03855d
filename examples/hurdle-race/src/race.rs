//! The track, its hurdles, the clock, and the positions of the runners.

use crate::body::{Body, GROUND};
use player::{Character, Command, FileError, PartState};
use rapier2d::prelude::*;
use std::sync::Arc;

/// A frame, s.
pub const FRAME: f32 = 1.0 / 60.0;
/// Steps of the physics in a frame: as stiff as where the characters have learned.
const STEPS: usize = 2;
/// From the start to the finish, m.
pub const LENGTH: f32 = 30.0;
/// Where hurdles stand, m.
pub const HURDLES: [f32; 6] = [5.0, 9.0, 13.0, 17.0, 21.0, 25.0];
/// How high they are, in heights of the runner's torso at rest: each has those of its size.
pub const HURDLE_HEIGHT: f32 = 0.18;
/// What a hurdle costs that is knocked over, s: one that a runner is not in the air above as its torso passes.
pub const PENALTY: f32 = 1.0;
/// After so long on its torso a runner is put on its feet, s.
const DOWN: f32 = 1.0;
/// Beyond this a torso is down, rad.
const TILTED: f32 = 1.2;
/// A speed is smoothed over so long, s.
const STRIDE: f32 = 0.4;
/// Before the start the runners come to rest, s.
const SETTLING: f32 = 0.5;

/// A runner on the track.
pub struct Runner {
    /// Its body.
    pub body: Body,
    /// Which hurdles it has knocked over.
    pub knocked: [bool; HURDLES.len()],
    /// When it crossed the line, penalties included, s.
    pub finished: Option<f32>,
    /// How often it was put on its feet.
    pub falls: u32,
    /// Its speed, smoothed over a stride, m/s.
    pub pace: f32,
    down_for: f32,
    /// How far it ever was, m.
    reached: f32,
}

impl Runner {
    /// What the hurdles have cost so far, s.
    pub fn penalty(&self) -> f32 {
        PENALTY * self.knocked.iter().filter(|&&knocked| knocked).count() as f32
    }

    /// How far it is, m.
    pub fn distance(&self) -> f32 {
        self.body.parts()[0].x
    }

    /// How high its hurdles are, m.
    pub fn hurdle_height(&self) -> f32 {
        HURDLE_HEIGHT * self.body.character().world.rest_height
    }

    /// How far ahead of its torso the next hurdle is, m; infinity after the last.
    pub fn ahead(&self) -> f32 {
        let here = self.distance();
        HURDLES.iter().map(|hurdle| hurdle - here).find(|&ahead| ahead > 0.0).unwrap_or(f32::INFINITY)
    }

    /// Whether any part of it is on the ground.
    fn is_down(&self) -> bool {
        self.body.parts().iter().any(|part| part.touching != 0)
    }
}

/// A race.
pub struct Race {
    physics: PhysicsWorld,
    /// In the order of their lanes.
    pub runners: Vec<Runner>,
    /// Since the start, s; below 0 before it.
    pub time: f32,
}

impl Race {
    /// All at the start.
    ///
    /// # Errors
    /// If a character is not valid.
    pub fn new(characters: &[Arc<Character>]) -> Result<Self, FileError> {
        let mut physics = PhysicsWorld::new();
        physics.integration_parameters.dt = FRAME / STEPS as f32;
        physics.integration_parameters.contact_recycling = false;
        let ground = ColliderBuilder::new(SharedShape::halfspace(Vector::Y))
            .friction(1.0)
            .friction_combine_rule(CoefficientCombineRule::Multiply)
            .collision_groups(InteractionGroups::new(GROUND, Group::ALL, InteractionTestMode::And));
        physics.insert(RigidBodyBuilder::fixed(), ground);
        let mut runners = Vec::new();
        for (lane, character) in characters.iter().enumerate() {
            let body = Body::new(&mut physics, Arc::clone(character), 0.0, lane as u32)?;
            runners.push(Runner {
                body,
                knocked: [false; HURDLES.len()],
                finished: None,
                falls: 0,
                pace: 0.0,
                down_for: 0.0,
                reached: 0.0,
            });
        }
        Ok(Self { physics, runners, time: -SETTLING })
    }

    /// A frame: `told` says what each runner is told, by its lane. Before the start they are told to stand.
    pub fn frame(&mut self, told: impl Fn(usize, &Runner) -> Command) {
        self.time += FRAME;
        for (lane, runner) in self.runners.iter_mut().enumerate() {
            let goes = self.time >= 0.0 && runner.finished.is_none();
            let command = if goes { told(lane, runner) } else { Command::STAND };
            runner.body.tick(&mut self.physics, command, FRAME);
        }
        for _ in 0..STEPS {
            self.physics.step();
        }
        for runner in &mut self.runners {
            let (before, now, is_down) = (runner.reached, runner.distance(), runner.is_down());
            for (knocked, hurdle) in runner.knocked.iter_mut().zip(HURDLES) {
                *knocked |= is_down && (before..now).contains(&hurdle);
            }
            runner.reached = before.max(now);
            runner.pace += (runner.body.parts()[0].vx - runner.pace) * FRAME / STRIDE;
            if runner.finished.is_none() && runner.body.front() >= LENGTH {
                runner.finished = Some(self.time + runner.penalty());
            }
            let PartState { cos, touching, .. } = runner.body.parts()[0];
            let legless = runner.body.character().parts.iter().all(|part| !part.foot);
            let down = !legless && (touching != 0 || cos < TILTED.cos());
            runner.down_for = if down { runner.down_for + FRAME } else { 0.0 };
            if runner.down_for > DOWN {
                let x = runner.distance();
                runner.body.put(&mut self.physics, x);
                (runner.falls, runner.down_for) = (runner.falls + 1, 0.0);
            }
        }
    }

    /// The lanes, those in front first.
    pub fn standings(&self) -> Vec<usize> {
        let mut lanes: Vec<usize> = (0..self.runners.len()).collect();
        let key = |&lane: &usize| {
            let runner = &self.runners[lane];
            (runner.finished.unwrap_or(f32::INFINITY), -runner.distance())
        };
        lanes.sort_by(|one, other| {
            let (one, other) = (key(one), key(other));
            one.0.total_cmp(&other.0).then(one.1.total_cmp(&other.1))
        });
        lanes
    }
}
