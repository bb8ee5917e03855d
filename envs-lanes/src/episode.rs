use crate::{engine::LaneEnvironment, instructions::Instructions};
use ne_core::SettingError;
use tasks::{Environment, Movement, Trials};

/// A creature, a movement and trials, for a whole population at once: the task that [`tasks::Episode`] is for one
/// creature at a time, with the same results.
///
/// Each lane plays a trial of an individual; when it is over the next takes the lane, so that no lane waits for another
/// whose creature has not fallen yet. Nets of one topology think in lanes as well; where topologies differ, as in NEAT, and
/// for controllers of other kinds each thinks for itself.
#[derive(Clone)]
pub struct LaneEpisode {
    environment: LaneEnvironment,
    pub(crate) movement: Box<dyn Movement>,
    steps: u32,
    pub(crate) trials: Trials,
    instructions: Instructions,
}

impl LaneEpisode {
    /// Episodes of `steps` steps (at least 1).
    ///
    /// # Errors
    /// If steps or trials are out of range.
    pub fn new(
        environment: LaneEnvironment,
        mut movement: Box<dyn Movement>,
        steps: u32,
        trials: Trials,
    ) -> Result<Self, SettingError> {
        SettingError::check_at_least("steps", steps as usize, 1)?;
        trials.validate().map_err(|error| error.within("trials"))?;
        if let Some(body) = environment.body() {
            movement.bind(body);
        }
        Ok(Self { environment, movement, steps, trials, instructions: Instructions::best() })
    }

    /// The same episodes, stepped with other instructions of the processor: the same results at another speed.
    #[must_use]
    pub fn with_instructions(self, instructions: Instructions) -> Self {
        Self { instructions, ..self }
    }

    /// The instructions it is stepped with.
    pub fn instructions(&self) -> Instructions {
        self.instructions
    }

    /// The environment episodes start from.
    pub fn environment(&self) -> &LaneEnvironment {
        &self.environment
    }

    /// The longest an episode lasts, in steps.
    pub fn steps(&self) -> u32 {
        self.steps
    }

    /// The same episodes, lasting at most `steps` steps, and at least 1.
    #[must_use]
    pub fn shortened(&self, steps: u32) -> Self {
        Self { steps: self.steps.min(steps).max(1), ..self.clone() }
    }

    /// The same episodes, with the first `count` trials of an evaluation alone, and at least 1.
    #[must_use]
    pub fn with_fewer_trials(&self, count: u32) -> Self {
        let trials = Trials { count: self.trials.count.min(count).max(1), ..self.trials };
        Self { trials, ..self.clone() }
    }
}
