use crate::{
    ConnectionGene, GenomeError, InnovationNumber, Layout, Neat, NeatGenome, NeatSettings, NodeGene, NodeId,
    innovation::Innovations, speciation::Species,
};
use ne_core::{Fitness, SettingError};
use ne_net::Copies;
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error as _};
use std::{collections::BTreeMap, sync::Arc};

/// Why a saved [`Neat`] cannot go on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StateError {
    /// A setting, or the number of inputs or outputs, is out of range.
    #[error(transparent)]
    Setting(#[from] SettingError),
    /// There are too many or too few individuals.
    #[error("{field}: found {found} individuals, the settings say {expected}")]
    Count {
        /// Which generation: `parents` or `asked`.
        field: String,
        /// How many there must be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// An individual is not a genome.
    #[error("{field}[{index}].{source}")]
    Individual {
        /// Which generation: `parents` or `asked`.
        field: String,
        /// Which individual, from 0.
        index: usize,
        /// What is wrong with it.
        source: GenomeError,
    },
    /// A gene has a number that has not been given yet.
    #[error("{field}[{index}]: has number {number} of {what}, the next to be given is {next}")]
    NotGiven {
        /// Which generation: `parents` or `asked`.
        field: String,
        /// Which individual, from 0.
        index: usize,
        /// A node or an innovation.
        what: String,
        /// The number.
        number: u32,
        /// The next that the registry will give.
        next: u32,
    },
    /// Genes of one number are not the same connection, or one is not that which the number is for.
    #[error(
        "{field}[{index}]: innovation {innovation} leads from {from} to {to}, must lead from {other_from} to {other_to}"
    )]
    Ends {
        /// Which generation: `parents` or `asked`.
        field: String,
        /// Which individual, from 0.
        index: usize,
        /// The number.
        innovation: u32,
        /// Where it comes from here.
        from: u32,
        /// Where it leads to here.
        to: u32,
        /// Where it must come from: as in an individual before, or from an input.
        other_from: u32,
        /// Where it must lead to: as in an individual before, or to an output.
        other_to: u32,
    },
    /// Species are not in the order of their numbers, or one has a number that has not been given yet.
    #[error("species[{index}].id = {id}: must be {allowed}")]
    SpeciesId {
        /// Which species, from 0.
        index: usize,
        /// Its number.
        id: u64,
        /// What is allowed, in words.
        allowed: String,
    },
    /// A parent is of no species, or a species has no member.
    #[error("{what}")]
    Membership {
        /// Which parent or species, and what it lacks.
        what: String,
    },
    /// A number is not in its range.
    #[error("threshold = {found}: must be above 0 and finite")]
    Threshold {
        /// The threshold.
        found: f64,
    },
}

/// A [`Neat`] as a checkpoint has it: the layout once, and no memory that is only kept for reuse.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename = "Neat")]
pub(crate) struct State {
    settings: NeatSettings,
    inputs: usize,
    outputs: usize,
    #[serde(default, skip_serializing_if = "Option::is_none")]
    copies: Option<Arc<Copies>>,
    innovations: Innovations,
    threshold: f64,
    next_species: u64,
    best: Option<Fitness>,
    stagnation: u64,
    /// Those of the generation last told, in order of their numbers.
    species: Vec<SavedSpecies>,
    /// The first generation, if it is not drawn; empty after it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    start: Vec<Genes>,
    /// The generation last told; empty before the first.
    parents: Vec<Parent>,
    /// The generation asked and not told yet; empty between generations.
    asked: Vec<Genes>,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct SavedSpecies {
    id: u64,
    best: Option<Fitness>,
    stagnation: u64,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parent {
    species: u64,
    fitness: Option<Fitness>,
    genes: Genes,
}

#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Genes {
    nodes: Vec<NodeGene>,
    connections: Vec<ConnectionGene>,
}

impl From<&NeatGenome> for Genes {
    fn from(genome: &NeatGenome) -> Self {
        Self { nodes: genome.nodes().to_vec(), connections: genome.connections().to_vec() }
    }
}

impl Serialize for Neat {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        State::from(self.clone()).serialize(serializer)
    }
}

impl<'de> Deserialize<'de> for Neat {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        State::deserialize(deserializer)?.try_into().map_err(D::Error::custom)
    }
}

impl From<Neat> for State {
    fn from(neat: Neat) -> Self {
        let mut species_of = vec![0; neat.parents.len()];
        for species in &neat.species {
            species.members.iter().for_each(|&member| species_of[member] = species.id);
        }
        let parent = |((genome, &fitness), &species): ((&NeatGenome, &Option<Fitness>), &u64)| Parent {
            species,
            fitness,
            genes: genome.into(),
        };
        let saved = |&Species { id, best, stagnation, .. }: &Species| SavedSpecies { id, best, stagnation };
        let asked: &[_] = if neat.asked { &neat.population } else { &[] };
        Self {
            inputs: neat.layout.inputs,
            outputs: neat.layout.outputs,
            copies: neat.copies,
            threshold: neat.threshold,
            next_species: neat.next_species,
            best: neat.best,
            stagnation: neat.stagnation,
            species: neat.species.iter().map(saved).collect(),
            parents: neat.parents.iter().zip(&neat.scores).zip(&species_of).map(parent).collect(),
            start: neat.start.iter().map(Genes::from).collect(),
            asked: asked.iter().map(Genes::from).collect(),
            innovations: neat.innovations,
            settings: neat.settings,
        }
    }
}

impl TryFrom<State> for Neat {
    type Error = StateError;

    fn try_from(state: State) -> Result<Self, StateError> {
        let mut neat = match state.copies {
            Some(copies) => Self::of_copies(state.settings, copies)?,
            None => Self::new(state.settings, state.inputs, state.outputs)?,
        };
        for (field, found, expected) in
            [("inputs", state.inputs, neat.layout.inputs), ("outputs", state.outputs, neat.layout.outputs)]
        {
            if found != expected {
                return Err(SettingError::new(field, found, format!("{expected}, as the copies have it")).into());
            }
        }
        if !(state.threshold > 0.0 && state.threshold.is_finite()) {
            return Err(StateError::Threshold { found: state.threshold });
        }
        neat.threshold = state.threshold;
        check_next(&state.innovations, &neat.layout, !state.asked.is_empty())?;
        neat.innovations = state.innovations;
        neat.scores = state.parents.iter().map(|parent| parent.fitness).collect();
        neat.next_species = state.next_species;
        neat.species = species(state.species, &state.parents, &neat)?;
        let parents = state.parents.into_iter().map(|parent| parent.genes).collect();
        let size = neat.settings.population;
        let begins = state.start.len();
        let before = neat.innovations.next_of_parents();
        let next = [neat.innovations.next_node, neat.innovations.next_innovation];
        neat.start = generation("start", state.start, begins, &neat, before)?;
        neat.parents = generation("parents", parents, size, &neat, before)?;
        neat.population = generation("asked", state.asked, size, &neat, next)?;
        neat.asked = !neat.population.is_empty();
        check_ends(&neat)?;
        (neat.best, neat.stagnation) = (state.best, state.stagnation);
        Ok(neat)
    }
}

/// The numbers to be given next.
fn check_next(innovations: &Innovations, layout: &Layout, is_asked: bool) -> Result<(), SettingError> {
    let first = [layout.first_hidden(), (layout.sources() * layout.outputs) as InnovationNumber];
    let (before, next) = (innovations.next_of_parents(), [innovations.next_node, innovations.next_innovation]);
    for (field, next, before, least) in
        [("next_node", next[0], before[0], first[0]), ("next_innovation", next[1], before[1], first[1])]
    {
        if next < least {
            let allowed = format!("at least {least}, the first that is free");
            return Err(SettingError::new(format!("innovations.{field}"), next, allowed));
        }
        if !(least..=next).contains(&before) {
            let allowed = format!("from {least} to {next}, the next in `{field}`");
            return Err(SettingError::new("innovations.before_asked", before, allowed));
        }
    }
    match innovations.before_asked {
        Some(_) if !is_asked => {
            Err(SettingError::new("innovations.before_asked", "there", "absent between generations"))
        }
        _ => Ok(()),
    }
}

/// The species with their members.
fn species(saved: Vec<SavedSpecies>, parents: &[Parent], neat: &Neat) -> Result<Vec<Species>, StateError> {
    let mut all: Vec<Species> = Vec::new();
    for (index, SavedSpecies { id, best, stagnation }) in saved.into_iter().enumerate() {
        let wrong = |allowed| Err(StateError::SpeciesId { index, id, allowed });
        if all.last().is_some_and(|before| before.id >= id) {
            return wrong("above the one before".into());
        }
        if id >= neat.next_species {
            return wrong(format!("below {}, the next to be given", neat.next_species));
        }
        all.push(Species { id, best, stagnation, members: Vec::new() });
    }
    for (index, parent) in parents.iter().enumerate() {
        match all.iter_mut().find(|species| species.id == parent.species) {
            Some(species) => species.members.push(index),
            None => {
                let what = format!("parents[{index}].species = {}: must be one of the species", parent.species);
                return Err(StateError::Membership { what });
            }
        }
    }
    for (index, species) in all.iter_mut().enumerate() {
        if species.members.is_empty() {
            return Err(StateError::Membership { what: format!("species[{index}]: has no member among the parents") });
        }
        species.rank(&neat.scores);
    }
    Ok(all)
}

/// A generation, or an empty one, whose nodes and innovations have numbers below these.
fn generation(
    field: &str,
    genes: Vec<Genes>,
    expected: usize,
    neat: &Neat,
    next: [u32; 2],
) -> Result<Vec<NeatGenome>, StateError> {
    if !genes.is_empty() && genes.len() != expected {
        return Err(StateError::Count { field: field.into(), expected, found: genes.len() });
    }
    let genome = |(index, genes): (usize, Genes)| {
        let genome = NeatGenome::new(neat.layout, genes.nodes, genes.connections)
            .and_then(|genome| match &neat.copies {
                Some(copies) => genome.with_copies(Arc::clone(copies)),
                None => Ok(genome),
            })
            .map_err(|source| StateError::Individual { field: field.into(), index, source })?;
        let [next_node, next_innovation] = next;
        let node = genome.nodes().last().map(|gene| gene.id);
        let innovation = genome.connections().last().map(|gene| gene.innovation);
        for (what, last, next) in [("a node", node, next_node), ("an innovation", innovation, next_innovation)] {
            if let Some(number) = last.filter(|&number| number >= next) {
                return Err(StateError::NotGiven { field: field.into(), index, what: what.into(), number, next });
            }
        }
        Ok(genome)
    };
    genes.into_iter().enumerate().map(genome).collect()
}

/// Genes of one number must be the same connection, those of the first numbers from an input to an output, or crossover could make genomes that are none.
fn check_ends(neat: &Neat) -> Result<(), StateError> {
    let sources = neat.layout.sources() as NodeId;
    let outputs = neat.layout.outputs as NodeId;
    let direct = sources * outputs;
    let mut ends = BTreeMap::new();
    for (field, generation) in [("start", &neat.start), ("parents", &neat.parents), ("asked", &neat.population)] {
        for (index, genome) in generation.iter().enumerate() {
            for &ConnectionGene { innovation, from, to, .. } in genome.connections() {
                let (other_from, other_to) = *ends.entry(innovation).or_insert_with(|| match innovation < direct {
                    true => (innovation / outputs, sources + innovation % outputs),
                    false => (from, to),
                });
                if (other_from, other_to) != (from, to) {
                    let field = field.into();
                    return Err(StateError::Ends { field, index, innovation, from, to, other_from, other_to });
                }
            }
        }
    }
    Ok(())
}
