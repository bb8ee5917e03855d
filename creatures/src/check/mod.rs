//! Finds everything that is wrong with a creature.

mod joints;
mod looks;
mod numbers;
mod parts;
mod sensors;
mod tree;

use crate::bounds::MOST_PARTS;
use crate::{Creature, Problem};

pub(crate) use sensors::check as check_sensors;

/// All problems of a creature, in the order of the file's fields; empty if it makes sense.
pub(crate) fn check(creature: &Creature) -> Vec<Problem> {
    let mut problems = Vec::new();
    let count = creature.parts.len();
    if count > MOST_PARTS {
        // A file of this size comes from a faulty program: a list of its every fault is of no use.
        return vec![Problem::TooManyParts { count }];
    }
    parts::check_creature_name(&creature.name, &mut problems);
    if count == 0 {
        problems.push(Problem::NoTorso);
    }
    parts::check(creature, &mut problems);
    let ends = tree::ends(creature, &mut problems);
    tree::check(creature, &ends, &mut problems);
    joints::check(creature, &ends, &mut problems);
    let has_feet = has_feet(creature);
    check_sensors(&creature.sensors, has_feet, &mut problems);
    problems
}

/// Whether a leg ends somewhere. Of a creature whose tree is not one, any answer will do that ends.
fn has_feet(creature: &Creature) -> bool {
    let part_of = |name: &str| creature.parts.iter().position(|part| part.name == name);
    let parent_of = |part: usize| {
        let joint = creature.joints.iter().find(|joint| joint.child == creature.parts[part].name)?;
        part_of(&joint.parent).filter(|&parent| parent < part)
    };
    let is_actuated = |part: usize| part != 0 && creature.actuated_tags.contains(&creature.parts[part].tag);
    (1..creature.parts.len()).any(|part| {
        let is_last = !creature.joints.iter().any(|joint| joint.parent == creature.parts[part].name);
        let above = |&part: &usize| parent_of(part).filter(|&parent| is_actuated(parent));
        let mut limb = std::iter::successors(Some(part), above);
        is_actuated(part) && is_last && limb.all(|part| creature.parts[part].leg)
    })
}
