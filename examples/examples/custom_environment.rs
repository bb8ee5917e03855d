//! An environment of one's own, without a physics engine: a rider on a swing learns to pump.

use ne_core::{Evolution, Failure, Seed, Serial, StopConditions};
use ne_fixed::{ConventionalNe, ConventionalNeSettings};
use ne_net::DenseShape;
use tasks::{Environment, Episode, Jumping, PartState, Snapshot, Trials, conformance::check_environment};

const TIME_STEP: f32 = 1.0 / 60.0;

/// A swing whose rider squats and stands up: a pendulum of 2 to 3 m that changes its length by up to 1 m/s.
#[derive(Clone, Default)]
struct Swing {
    angle: f32,
    spin: f32,
    length: f32,
    wanted: f32,
    steps: u32,
    snapshot: Snapshot,
}

impl Swing {
    /// Shows the rider; the ropes are tied up 4 m above the ground.
    fn show(&mut self) {
        let (sin, cos) = (libm::sinf(self.angle), libm::cosf(self.angle));
        let (x, y, speed) = (self.length * sin, 4.0 - self.length * cos, self.length * self.spin);
        let rider = PartState { x, y, cos, sin, vx: speed * cos, vy: speed * sin, spin: self.spin, touching: false };
        self.snapshot.parts.clear();
        self.snapshot.parts.push(rider);
        self.snapshot.time = self.steps as f32 * TIME_STEP;
    }
}

impl Environment for Swing {
    fn inputs(&self) -> usize {
        3
    }
    fn outputs(&self) -> usize {
        1
    }
    fn time_step(&self) -> f32 {
        TIME_STEP
    }
    fn reset(&mut self, _: Seed) -> Result<(), Failure> {
        *self = Self { angle: 0.2, length: 2.5, wanted: 2.5, ..Self::default() };
        self.show();
        Ok(())
    }
    fn sense(&self, inputs: &mut [f32]) {
        inputs.copy_from_slice(&[3.0 * self.angle, self.spin, 3.0 * (self.length - 2.5)]);
    }
    fn act(&mut self, outputs: &[f32]) {
        self.wanted = 2.5 - 0.5 * outputs[0].clamp(-1.0, 1.0);
    }
    fn step(&mut self) -> Result<(), Failure> {
        // Gravity changes the angular momentum, a change of length keeps it.
        let momentum = self.length * self.length * self.spin - 9.81 * self.length * libm::sinf(self.angle) * TIME_STEP;
        self.length += (self.wanted - self.length).clamp(-TIME_STEP, TIME_STEP);
        self.spin = momentum / (self.length * self.length);
        self.angle += self.spin * TIME_STEP;
        self.steps += 1;
        self.show();
        if self.angle.is_finite() { Ok(()) } else { Err(Failure::NonFinite { what: "angle of the swing".into() }) }
    }
    fn snapshot(&self) -> &Snapshot {
        &self.snapshot
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    check_environment(&Swing::default(), Seed::of_run(1))?;
    let task = Episode::new(Swing::default(), Box::new(Jumping::default()), 20 * 60, Trials::default())?;
    let strategy = ConventionalNe::new(ConventionalNeSettings::default(), DenseShape::new(3, vec![4], 1))?;
    let stop = StopConditions { generations: Some(60), ..Default::default() };
    let mut evolution = Evolution::new(strategy, Seed::of_run(1), stop);
    evolution.run(&task, &Serial, &mut [])?;
    let height = evolution.champion().ok_or("every evaluation failed")?.fitness.get();
    println!("the rider rises {height:.2} m above the start");
    if height > 2.0 { Ok(()) } else { Err("the rider did not learn to swing".into()) }
}
