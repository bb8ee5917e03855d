//! Names, sizes and poses of parts.

use std::collections::BTreeMap;

use super::{looks, numbers};
use crate::bounds::{ANGLE, DENSITY, FRICTION, LONGEST_NAME, POSITION, SIZE};
use crate::names::{is_file_name, shortened};
use crate::{Creature, Part, Problem};

pub(super) fn check(creature: &Creature, problems: &mut Vec<Problem>) {
    let mut first_of: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, part) in creature.parts.iter().enumerate() {
        let path = format!("parts[{index}]");
        check_name(&path, "name", &part.name, problems);
        check_name(&path, "tag", &part.tag, problems);
        match first_of.get(part.name.as_str()) {
            Some(&first) => {
                problems.push(Problem::DuplicateName {
                    path: format!("{path}.name"),
                    name: shortened(&part.name),
                    first,
                });
            }
            None => {
                first_of.insert(&part.name, index);
            }
        }
        check_numbers(&path, part, problems);
        looks::check(&path, &part.look, problems);
    }
}

fn check_name(path: &str, field: &str, name: &str, problems: &mut Vec<Problem>) {
    let has_control = name.chars().any(char::is_control);
    if name.trim().is_empty() || has_control || name.chars().count() > LONGEST_NAME {
        problems.push(Problem::BadName { path: format!("{path}.{field}"), found: shortened(name) });
    }
}

/// The name of a creature becomes the name of a folder: nothing in it may be read as a path or an option.
pub(super) fn check_creature_name(name: &str, problems: &mut Vec<Problem>) {
    if !is_file_name(name) {
        problems.push(Problem::BadCreatureName { found: shortened(name) });
    }
}

fn check_numbers(path: &str, part: &Part, problems: &mut Vec<Problem>) {
    for (field, size) in part.shape.sizes() {
        numbers::check(|| format!("{path}.shape.{field}"), size, SIZE, problems);
    }
    numbers::check(|| format!("{path}.density"), part.density, DENSITY, problems);
    numbers::check(|| format!("{path}.friction"), part.friction, FRICTION, problems);
    numbers::check_pair(&format!("{path}.position"), part.position, POSITION, problems);
    numbers::check(|| format!("{path}.angle"), part.angle, ANGLE, problems);
}
