//! Whether a topology was made for a body.

use crate::{config::FrozenTopology, episode_parts::SetupError};
use creatures::Channel;
use ne_core::SettingError;
use ne_net::Topology;

impl FrozenTopology {
    /// The topology, if it was made for these inputs and outputs.
    pub(crate) fn fitting(&self, senses: &[Channel], motors: &[Channel]) -> Result<Topology, SetupError> {
        self.net.validate().map_err(|error| error.within("topology.net"))?;
        for (what, mine, count, channels) in [
            ("inputs", &self.inputs, self.net.inputs(), senses),
            ("outputs", &self.outputs, self.net.outputs(), motors),
        ] {
            if mine.len() != count {
                let allowed = format!("{count} names, one for each of the net's");
                return Err(SettingError::new(what, format!("{} names", mine.len()), allowed)
                    .within("topology")
                    .into());
            }
            if let Some(difference) = difference("topology", what, mine, channels) {
                return Err(SetupError::Topology(difference));
            }
        }
        let (free, searched) = (self.genes.iter().filter(|gene| gene.held.is_none()).count(), self.net.weight_count());
        if !self.genes.is_empty() && free != searched {
            let allowed = format!("{searched} that are not held, as many as the net has weights");
            let found = format!("{free} genes that are not held");
            return Err(SettingError::new("genes", found, allowed).within("topology").into());
        }
        if let Some(index) = self.genes.iter().position(|gene| gene.held.is_some_and(|held| !held.is_finite())) {
            return Err(SettingError::new(format!("genes[{index}].held"), "NaN or infinite", "finite")
                .within("topology")
                .into());
        }
        Ok(self.net.clone())
    }
}

/// Says how the names of the inputs or outputs of a topology, or of something else, differ from those of the creature.
pub(crate) fn difference(whose: &str, what: &str, mine: &[String], channels: &[Channel]) -> Option<String> {
    let theirs: Vec<&String> = channels.iter().map(|channel| &channel.name).collect();
    let only = |names: Vec<&String>| names.into_iter().map(|name| format!("\"{name}\"")).collect::<Vec<_>>().join(", ");
    let missing = only(mine.iter().filter(|name| !theirs.contains(name)).collect());
    let new = only(theirs.iter().copied().filter(|name| !mine.contains(name)).collect());
    let counts = format!("it has {} {what}, the creature has {}", mine.len(), theirs.len());
    match (missing.is_empty(), new.is_empty()) {
        (true, true) => {
            let place = mine.iter().zip(&theirs).position(|(mine, theirs)| mine != *theirs)?;
            let (mine, theirs) = (&mine[place], theirs[place]);
            Some(format!("its {what} are in another order: \"{mine}\" where the creature has \"{theirs}\""))
        }
        (false, true) => Some(format!("{counts}; {missing} is not among the creature's")),
        (true, false) => Some(format!("{counts}; {new} is not among the {whose}'s")),
        (false, false) => Some(format!("{counts}; only the {whose} has {missing}, only the creature has {new}")),
    }
}
