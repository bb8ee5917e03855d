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

/// The most further bodies a creature can have.
const MOST_FURTHER_BODIES: usize = 15;

/// The task of a configuration in its creature and its further bodies; `alone` is that in its creature, which has these inputs
/// and outputs.
///
/// # Errors
/// If there are too many further bodies, or one cannot be built, or senses or moves something else than the creature.
pub(crate) fn with_further_bodies(
    config: &RunConfig,
    alone: TrainingTask,
    channels: [&[Channel]; 2],
    registry: &Registry,
) -> Result<TrainingTask, SetupError> {
    let count = config.further_bodies.len();
    if count > MOST_FURTHER_BODIES {
        let allowed = format!("at most {MOST_FURTHER_BODIES} creatures");
        return Err(SettingError::new("further_bodies", format!("{count} creatures"), allowed).into());
    }
    if count == 0 {
        return Ok(alone);
    }
    let further_body = |(index, creature): (usize, &Creature)| {
        let parts = EpisodeParts { creature, ..config.episode_parts() };
        let built = parts.build_both(config.engine, registry).and_then(|(episode, task)| {
            let environment = episode.environment();
            let own = [environment.senses().channels(), environment.motors().channels()];
            check_channels(own, channels).map(|()| task)
        });
        built.map_err(|problem| SetupError::FurtherBody {
            index,
            name: creature.name.clone(),
            problem: Box::new(problem),
        })
    };
    let others = config.further_bodies.iter().enumerate().map(further_body).collect::<Result<_, _>>()?;
    Ok(TrainingTask::Several(Box::new(SeveralBodies::new(alone, others, config.trials.combine))))
}

/// Checks that a further body has the inputs and outputs of the creature, by name and in order.
fn check_channels(own: [&[Channel]; 2], creatures: [&[Channel]; 2]) -> Result<(), SetupError> {
    for (what, (own, creatures)) in ["inputs", "outputs"].into_iter().zip(own.into_iter().zip(creatures)) {
        let own: Vec<String> = own.iter().map(|channel| channel.name.clone()).collect();
        if let Some(difference) = difference("further body", what, &own, creatures) {
            return Err(SetupError::Channels(difference));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
