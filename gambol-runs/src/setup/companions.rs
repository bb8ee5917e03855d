//! Further bodies that a net has to move.

use crate::{
    Registry,
    config::RunConfig,
    episode_parts::{EpisodeParts, SetupError},
    topology::difference,
    training_task::{SeveralBodies, TrainingTask},
};
use creatures::{Channel, Creature};
use ne_core::SettingError;

/// The most companions a creature can have.
const MOST_COMPANIONS: usize = 15;

/// The task of a configuration in its creature and its companions; `alone` is that in its creature, which has these inputs
/// and outputs.
///
/// # Errors
/// If there are too many companions, or one cannot be built, or senses or moves something else than the creature.
pub(crate) fn with_companions(
    config: &RunConfig,
    alone: TrainingTask,
    channels: [&[Channel]; 2],
    registry: &Registry,
) -> Result<TrainingTask, SetupError> {
    let count = config.companions.len();
    if count > MOST_COMPANIONS {
        let allowed = format!("at most {MOST_COMPANIONS} creatures");
        return Err(SettingError::new("companions", format!("{count} creatures"), allowed).into());
    }
    if count == 0 {
        return Ok(alone);
    }
    let companion = |(index, creature): (usize, &Creature)| {
        let parts = EpisodeParts { creature, ..config.episode_parts() };
        let built = parts.build_both(config.engine, registry).and_then(|(episode, task)| {
            let environment = episode.environment();
            let own = [environment.senses().channels(), environment.motors().channels()];
            check_channels(own, channels).map(|()| task)
        });
        built.map_err(|problem| SetupError::Companion {
            index,
            name: creature.name.clone(),
            problem: Box::new(problem),
        })
    };
    let others = config.companions.iter().enumerate().map(companion).collect::<Result<_, _>>()?;
    Ok(TrainingTask::Several(Box::new(SeveralBodies::new(alone, others, config.trials.combine))))
}

/// Checks that a companion has the inputs and outputs of the creature, by name and in order.
fn check_channels(own: [&[Channel]; 2], creatures: [&[Channel]; 2]) -> Result<(), SetupError> {
    for (what, (own, creatures)) in ["inputs", "outputs"].into_iter().zip(own.into_iter().zip(creatures)) {
        let own: Vec<String> = own.iter().map(|channel| channel.name.clone()).collect();
        if let Some(difference) = difference("companion", what, &own, creatures) {
            return Err(SetupError::Channels(difference));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
