//! An engine without physics.

use creatures::{Blueprint, Hinge};
use envs_core::{Conditions, Engine, EnvironmentError, Ground, PhysicsSettings};
use tasks::PartState;

/// A creature on strings: its parts stay where they are, whatever their velocity, which nudges alone change; and each hinge
/// turns exactly as fast as its motor is asked to.
#[derive(Clone)]
pub(crate) struct Puppet {
    parts: Vec<PartState>,
    hinges: Vec<Hinge>,
    /// For each hinge: rad/s, and how often it was asked.
    motors: Vec<(f32, u32)>,
    time_step: f32,
}

impl Engine for Puppet {
    /// Strings tangle where parts collide with each other, and hang above flat ground alone.
    fn new(
        blueprint: &Blueprint,
        settings: &PhysicsSettings,
        ground: &Ground,
        _: &Conditions,
    ) -> Result<Self, EnvironmentError> {
        let unsupported = |what: &str| EnvironmentError::Unsupported { engine: "puppets", what: what.to_owned() };
        if blueprint.self_collision() {
            return Err(unsupported("its parts collide with each other"));
        }
        if *ground != Ground::flat() {
            return Err(unsupported("the ground is not flat"));
        }
        let part = |part: &creatures::BodyPart| PartState {
            x: part.x,
            y: part.y,
            cos: part.angle.cos(),
            sin: part.angle.sin(),
            touching: part.lowest_point() < 0.1,
            ..PartState::default()
        };
        let hinges = blueprint.hinges().to_vec();
        Ok(Self {
            parts: blueprint.parts().iter().map(part).collect(),
            motors: vec![(0.0, 0); hinges.len()],
            hinges,
            time_step: settings.time_step,
        })
    }

    fn set_motor_speed(&mut self, hinge: usize, speed: f32) {
        let (asked, times) = &mut self.motors[hinge];
        (*asked, *times) = (speed, *times + 1);
    }

    fn nudge(&mut self, part: usize, [x, y]: [f32; 2], spin: f32) {
        let part = &mut self.parts[part];
        (part.vx, part.vy, part.spin) = (part.vx + x, part.vy + y, part.spin + spin);
    }

    fn step(&mut self) -> bool {
        for part in &mut self.parts {
            part.spin = 0.0;
        }
        // A child's joint stands after its parent's, so a parent's spin is there when the child's is added to it.
        for (hinge, &(speed, _)) in self.hinges.iter().zip(&self.motors) {
            self.parts[hinge.child].spin = self.parts[hinge.parent].spin + speed;
        }
        for part in &mut self.parts {
            let angle = part.angle() + part.spin * self.time_step;
            (part.sin, part.cos) = angle.sin_cos();
        }
        self.parts.iter().all(|part| part.spin.is_finite())
    }

    fn look(&self, parts: &mut [PartState]) {
        parts.copy_from_slice(&self.parts);
    }

    /// How often the motor was asked, so that tests can count.
    fn motor_torque(&self, hinge: usize) -> f32 {
        self.motors[hinge].1 as f32
    }

    /// Of a body that moves as it is told.
    fn motor_power(&self, hinge: usize) -> f32 {
        let Hinge { parent, child, .. } = self.hinges[hinge];
        (self.motor_torque(hinge) * (self.parts[child].spin - self.parts[parent].spin)).abs()
    }

    fn distance_to_ground(&self, [_, y]: [f32; 2], angle: f32, length: f32) -> f32 {
        if angle < 0.0 { (y / -angle.sin()).min(length) } else { length }
    }
}
