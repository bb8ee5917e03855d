//! A toy environment and snapshots by hand that several test programs share.
#![allow(dead_code, reason = "no program uses all of it")]

use ne_core::{Failure, Phenotype, Purpose, Seed};
use rand::Rng;

use tasks::{Environment, PartState, Snapshot};

const START: Purpose = Purpose::new("test start");

/// Seconds of a step.
pub(crate) const TIME_STEP: f32 = 0.0625;

/// A mass of 1 kg on rails. Its one motor pushes with up to 1 N; it senses place and speed.
#[derive(Clone, Debug)]
pub(crate) struct PointMass {
    snapshot: Snapshot,
    push: f32,
    steps: u32,
    spread: f32,
    rails: f32,
}

impl PointMass {
    /// Starts at 0, on rails without end.
    pub(crate) fn new() -> Self {
        Self::varied(0.0, f32::INFINITY)
    }

    /// Starts up to `spread` from 0, as the seed says; farther from 0 than `rails` is a failure.
    pub(crate) fn varied(spread: f32, rails: f32) -> Self {
        let snapshot = Snapshot { parts: vec![part(0.0, 0.0)], ..Snapshot::default() };
        Self { snapshot, push: 0.0, steps: 0, spread, rails }
    }
}

impl Environment for PointMass {
    fn inputs(&self) -> usize {
        2
    }

    fn outputs(&self) -> usize {
        1
    }

    fn time_step(&self) -> f32 {
        TIME_STEP
    }

    fn reset(&mut self, seed: Seed) -> Result<(), Failure> {
        // 24 bits fit an f32 exactly.
        let chance = (seed.stream(START).next_u32() >> 8) as f32 / (1 << 24) as f32;
        self.snapshot.parts[0] = part(self.spread * (2.0 * chance - 1.0), 0.0);
        (self.snapshot.time, self.snapshot.motor_work) = (0.0, 0.0);
        (self.push, self.steps) = (0.0, 0);
        Ok(())
    }

    fn sense(&self, inputs: &mut [f32]) {
        let mass = self.snapshot.torso();
        (inputs[0], inputs[1]) = (mass.x, mass.vx);
    }

    fn act(&mut self, outputs: &[f32]) {
        self.push = outputs[0].clamp(-1.0, 1.0);
    }

    fn step(&mut self) -> Result<(), Failure> {
        let mass = &mut self.snapshot.parts[0];
        mass.vx += self.push * TIME_STEP;
        mass.x += mass.vx * TIME_STEP;
        if !mass.x.is_finite() {
            return Err(Failure::NonFinite { what: "place of the mass".into() });
        }
        if mass.x.abs() > self.rails {
            return Err(Failure::Unstable { what: "off the rails".into() });
        }
        self.snapshot.motor_work += f64::from((self.push * mass.vx * TIME_STEP).abs());
        self.steps += 1;
        self.snapshot.time = self.steps as f32 * TIME_STEP;
        Ok(())
    }

    fn snapshot(&self) -> &Snapshot {
        &self.snapshot
    }
}

/// An upright part that touches nothing.
pub(crate) fn part(x: f32, y: f32) -> PartState {
    PartState { x, y, cos: 1.0, ..PartState::default() }
}

/// A controller that always wants the same.
#[derive(Clone, Debug)]
pub(crate) struct Constant(pub(crate) f32);

impl Phenotype for Constant {
    fn inputs(&self) -> usize {
        2
    }

    fn outputs(&self) -> usize {
        1
    }

    fn reset(&mut self) {}

    fn activate(&mut self, _: &[f32], outputs: &mut [f32]) {
        outputs[0] = self.0;
    }
}
