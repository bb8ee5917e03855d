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
        // A file of this size was made by a program gone astray: listing its every fault helps nobody.
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

fn has_feet(creature: &Creature) -> bool {
    creature.parts.iter().skip(1).any(|part| {
        creature.actuated_tags.contains(&part.tag) && !creature.joints.iter().any(|joint| joint.parent == part.name)
    })
}
