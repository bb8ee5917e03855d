use super::{
    Nsga2, Nsga2Settings,
    strategy::{Parent, Scores},
};
use crate::{
    StateError,
    state_error::{Genes, generation},
};
use ne_core::{Fitness, SettingError};
use ne_net::Topology;
use serde::{Deserialize, Serialize};

/// An [`Nsga2`] as a checkpoint has it: the topology once.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Nsga2")]
pub(super) struct State {
    settings: Nsga2Settings,
    topology: Topology,
    reference: Option<Vec<Fitness>>,
    /// The first generation, if it is not drawn; empty after it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    start: Vec<Genes>,
    /// The survivors of the generation last told; empty before the first.
    parents: Vec<SavedParent>,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Genes>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedParent {
    scores: Option<Scores>,
    generation: u64,
    genes: Genes,
}

impl From<Nsga2> for State {
    fn from(strategy: Nsga2) -> Self {
        let saved = |Parent { genome, scores, generation }| SavedParent { scores, generation, genes: (&genome).into() };
        Self {
            asked: strategy.nets.saved(),
            settings: strategy.settings,
            topology: strategy.nets.topology,
            reference: strategy.reference,
            start: strategy.start.iter().map(Genes::from).collect(),
            parents: strategy.parents.into_iter().map(saved).collect(),
        }
    }
}

impl TryFrom<State> for Nsga2 {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut strategy = Self::new(state.settings, state.topology)?;
        check_objectives(&state.parents, state.reference.as_deref())?;
        let evaluated: Vec<_> = state.parents.iter().map(|parent| (parent.scores.clone(), parent.generation)).collect();
        let parents = state.parents.into_iter().map(|parent| parent.genes).collect();
        let parents = generation("parents", parents, strategy.settings.parent_count(), &strategy.nets.topology)?;
        let parent = |(genome, (scores, generation))| Parent { genome, scores, generation };
        strategy.parents = parents.into_iter().zip(evaluated).map(parent).collect();
        let begins = state.start.len();
        strategy.start = generation("start", state.start, begins, &strategy.nets.topology)?;
        strategy.nets.load(state.asked, strategy.settings.population)?;
        strategy.reference = state.reference;
        Ok(strategy)
    }
}

/// Points can be compared only if all have as many values.
fn check_objectives(parents: &[SavedParent], reference: Option<&[Fitness]>) -> Result<(), SettingError> {
    let counts = parents.iter().enumerate().filter_map(|(index, parent)| {
        Some((format!("parents[{index}].scores.objectives"), parent.scores.as_ref()?.objectives.len()))
    });
    let Some(expected) = reference.map(<[Fitness]>::len) else {
        return match counts.into_iter().next() {
            Some(_) => Err(SettingError::new("reference", "null", "given if a parent has scores")),
            None => Ok(()),
        };
    };
    let mut others = counts.filter(|&(_, count)| count != expected);
    others.next().map_or(Ok(()), |(field, count)| {
        Err(SettingError::new(field, format!("{count} numbers"), format!("{expected} numbers, as the reference has")))
    })
}
