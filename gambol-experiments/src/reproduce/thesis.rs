//! What the thesis reports: A. Gegendorfer, *Using Neuroevolution for Physics-Based Character Animation in Two
//! Dimensions*, diploma thesis, TU Wien, 2017.
//!
//! Its unit of length is its engine's: fitnesses cannot be compared with metres.

/// A creature and a movement, and what the thesis says of them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scenario {
    /// The creature, by the name it has here.
    pub creature: &'static str,
    /// The movement.
    pub movement: &'static str,
    /// The best fitness after 300 generations in the three runs it describes, in its engine's unit of length.
    pub final_fitness: [f64; 3],
    /// Minutes of wall clock for 300 generations, on one thread of a Core i5-4670K at 3.4 GHz.
    pub minutes: f64,
    /// Whether it calls the movement usable after 300 generations.
    pub usable: bool,
    /// After 1 minute (tables 5.1 and 5.2); `None`: not reached.
    pub after_1_minute: Option<Timed>,
    /// After 5 minutes (tables 5.1 and 5.2); `None`: not reached.
    pub after_5_minutes: Option<Timed>,
}

/// How far a run was after some minutes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Timed {
    /// Generations done.
    pub generations: u64,
    /// The best fitness, in the unit of length of the thesis' engine.
    pub fitness: f64,
    /// Whether the movement is called usable.
    pub usable: bool,
}

/// Generations of each run.
pub const GENERATIONS: u64 = 300;
/// Runs of each scenario, of which three are described.
pub const RUNS: u64 = 10;
/// The minutes after which its tables 5.1 and 5.2 look at a run.
pub const CLOCK_MINUTES: [f64; 2] = [1.0, 5.0];

/// All 14 scenarios, in the thesis' order. Final fitnesses, minutes and usability: its chapter of results; figures 5.1 to
/// 5.16 and A.1 to A.14 show the same runs. After 1 and 5 minutes: its tables 5.1 (running) and 5.2 (jumping).
pub const SCENARIOS: &[Scenario] = &[
    running("apod", [220.73, 170.29, 123.42], 20.0, true, at(15, 92.37, true), at(75, 203.51, true)),
    running("biped-1", [73.62, 104.05, 108.32], 20.0, true, at(15, 19.38, true), at(75, 59.31, true)),
    running("biped-2", [50.38, 41.05, 179.69], 20.0, true, at(15, 3.68, false), at(75, 109.09, true)),
    running("tetrapod-1", [147.71, 71.37, 209.01], 20.0, true, at(15, 26.47, false), at(75, 36.43, true)),
    running("tetrapod-2", [136.93, 72.27, 75.41], 27.0, true, at(11, 19.90, false), at(55, 30.26, false)),
    running("decapod-1", [56.93, 24.98, 20.42], 27.0, false, None, None),
    running("decapod-2", [34.02, 20.48, 29.60], 58.0, false, None, None),
    jumping("apod", [3.96, 5.58, 5.98], 5.0, true, at(60, 4.29, false), at(300, 5.98, true)),
    jumping("biped-1", [1.93, 2.09, 1.90], 5.0, true, at(60, 0.86, false), at(300, 2.09, true)),
    jumping("biped-2", [2.34, 3.12, 2.87], 5.0, true, at(60, 1.96, false), at(300, 3.12, true)),
    jumping("tetrapod-1", [2.12, 2.69, 2.51], 5.0, true, at(60, 2.07, false), at(300, 2.69, true)),
    jumping("tetrapod-2", [2.75, 3.28, 3.46], 8.0, true, at(37, 2.85, false), at(187, 3.21, true)),
    jumping("decapod-1", [1.23, 1.49, 1.17], 8.0, false, None, None),
    jumping("decapod-2", [1.54, 1.33, 1.25], 22.0, false, None, None),
];

impl Scenario {
    /// What it is called: `biped-1 running`.
    pub fn name(&self) -> String {
        format!("{} {}", self.creature, self.movement)
    }

    /// The highest final fitness of the three runs.
    pub fn best_final_fitness(&self) -> f64 {
        self.final_fitness.into_iter().fold(f64::NEG_INFINITY, f64::max)
    }

    /// What the thesis' tables say of this moment, if it is one they look at: how far the run was, or `None` in the inner
    /// option if they call it not reached.
    pub fn after(&self, minutes: f64) -> Option<Option<Timed>> {
        let [first, second] = CLOCK_MINUTES;
        if minutes == first {
            Some(self.after_1_minute)
        } else if minutes == second {
            Some(self.after_5_minutes)
        } else {
            None
        }
    }
}

const fn running(
    creature: &'static str,
    final_fitness: [f64; 3],
    minutes: f64,
    usable: bool,
    after_1_minute: Option<Timed>,
    after_5_minutes: Option<Timed>,
) -> Scenario {
    Scenario { creature, movement: "running", final_fitness, minutes, usable, after_1_minute, after_5_minutes }
}

const fn jumping(
    creature: &'static str,
    final_fitness: [f64; 3],
    minutes: f64,
    usable: bool,
    after_1_minute: Option<Timed>,
    after_5_minutes: Option<Timed>,
) -> Scenario {
    let scenario = running(creature, final_fitness, minutes, usable, after_1_minute, after_5_minutes);
    Scenario { movement: "jumping", ..scenario }
}

const fn at(generations: u64, fitness: f64, usable: bool) -> Option<Timed> {
    Some(Timed { generations, fitness, usable })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_shipped_creature_runs_and_jumps() {
        for movement in ["running", "jumping"] {
            let creatures: Vec<&str> =
                SCENARIOS.iter().filter(|scenario| scenario.movement == movement).map(|s| s.creature).collect();
            let shipped: Vec<&str> = creatures::shipped().iter().map(|creature| creature.name).collect();
            assert_eq!(creatures, shipped);
        }
    }

    #[test]
    fn runs_that_were_over_after_five_minutes_are_the_best_ones() {
        for scenario in SCENARIOS {
            if let Some(timed) = scenario.after_5_minutes.filter(|timed| timed.generations == GENERATIONS) {
                assert_eq!(timed.fitness, scenario.best_final_fitness(), "{}", scenario.name());
            }
        }
    }
}
