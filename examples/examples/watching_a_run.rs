//! Watching a run: an observer prints a line a generation, and ends the run when it has seen enough.

use ne_core::{
    Evaluation, Evolution, Generation, Observer, ObserverError, Parallel, Phenotype, Seed, StopConditions, StopReason,
    StopSignal, Strategy, Task,
};
use ne_fixed::{ConventionalNe, ConventionalNeSettings};
use ne_net::DenseShape;

/// Answer with a wave: sin(2 x).
struct Wave;

impl Task for Wave {
    fn inputs(&self) -> usize {
        1
    }
    fn outputs(&self) -> usize {
        1
    }
    fn evaluate(&self, phenotype: &mut dyn Phenotype, _: Seed) -> Evaluation {
        if let Err(failure) = self.check_shape(phenotype) {
            return Evaluation::failed(failure);
        }
        phenotype.reset();
        let (mut error, mut answer) = (0.0, [0.0]);
        for step in -20..=20 {
            let x = step as f32 / 20.0;
            phenotype.activate(&[x], &mut answer);
            error += f64::from((answer[0] - libm::sinf(2.0 * x)).abs());
        }
        Evaluation::new(1.0 - error / 41.0).with_steps(41)
    }
}

/// Prints the progress; it may look at everything and change nothing, but for the switch that ends the run.
struct Progress {
    signal: StopSignal,
}

impl<S: Strategy> Observer<S> for Progress {
    fn generation(&mut self, generation: &Generation<'_, S>) -> Result<(), ObserverError> {
        let report = generation.report;
        let fitness = report.fitness.ok_or("every evaluation failed")?;
        let bar = "#".repeat((60.0 * fitness.best.max(0.0)) as usize);
        let mark = if generation.improved { '*' } else { ' ' };
        println!("{:>4} {:.4} mean {:>7.4} {mark}{bar}", report.generation, fitness.best, fitness.mean);
        if fitness.best > 0.97 {
            self.signal.stop();
        }
        Ok(())
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let strategy = ConventionalNe::new(ConventionalNeSettings::default(), DenseShape::new(1, vec![6], 1))?;
    let stop = StopConditions { generations: Some(300), ..Default::default() };
    let signal = StopSignal::default();
    let mut evolution = Evolution::new(strategy, Seed::of_run(1), stop).with_signal(signal.clone());
    let reason = evolution.run(&Wave, &Parallel::new(0)?, &mut [Box::new(Progress { signal })])?;
    println!("{} evaluations, then {reason}", evolution.progress().evaluations);
    if reason == StopReason::Interrupted { Ok(()) } else { Err("the wave was not learned".into()) }
}
