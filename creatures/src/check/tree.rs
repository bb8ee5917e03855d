//! Which part hangs on which: it must be a tree with the torso as its root, parents listed first.

use std::collections::BTreeMap;

use crate::names::{nearest, shortened};
use crate::{Creature, Joint, Problem};

/// The parts a joint holds, as indices; `None` where the name is of no part.
#[derive(Clone, Copy)]
pub(super) struct Ends {
    pub(super) parent: Option<usize>,
    pub(super) child: Option<usize>,
}

/// Finds the parts of every joint.
pub(super) fn ends(creature: &Creature, problems: &mut Vec<Problem>) -> Vec<Ends> {
    let mut index_of: BTreeMap<&str, usize> = BTreeMap::new();
    for (index, part) in creature.parts.iter().enumerate() {
        index_of.entry(&part.name).or_insert(index);
    }
    let mut find = |index: usize, field: &str, name: &str| {
        let found = index_of.get(name).copied();
        if found.is_none() {
            problems.push(Problem::MissingPart {
                path: format!("joints[{index}].{field}"),
                name: shortened(name),
                nearest: nearest(name, creature.parts.iter().map(|part| part.name.as_str())),
            });
        }
        found
    };
    let joints = creature.joints.iter().enumerate();
    joints
        .map(|(index, Joint { parent, child, .. })| Ends {
            parent: find(index, "parent", parent),
            child: find(index, "child", child),
        })
        .collect()
}

pub(super) fn check(creature: &Creature, ends: &[Ends], problems: &mut Vec<Problem>) {
    let name = |part: usize| creature.parts[part].name.clone();
    let mut joint_of: Vec<Option<usize>> = vec![None; creature.parts.len()];
    for (joint, Ends { parent, child }) in ends.iter().enumerate() {
        let Some(child) = *child else { continue };
        if let Some(first) = joint_of[child] {
            problems.push(Problem::TwoJoints { path: format!("joints[{joint}].child"), part: name(child), first });
            continue;
        }
        joint_of[child] = Some(joint);
        if child == 0 && *parent != Some(0) {
            problems.push(Problem::TorsoHangs {
                path: format!("joints[{joint}].child"),
                torso: name(0),
                parent: shortened(&creature.joints[joint].parent),
            });
        }
    }

    let parent_of = |part: usize| joint_of[part].and_then(|joint| ends[joint].parent);
    let in_cycle = check_cycles(creature, parent_of, &joint_of, problems);

    for (joint, Ends { parent, child }) in ends.iter().enumerate() {
        let (Some(parent), Some(child)) = (*parent, *child) else { continue };
        // The torso's and a loop's joints have been blamed already.
        if parent > child && child != 0 && !(in_cycle[child] && joint_of[child] == Some(joint)) {
            problems.push(Problem::LaterParent {
                path: format!("joints[{joint}]"),
                parent: name(parent),
                child: name(child),
            });
        }
    }
    // A joint to a mistyped name would else be blamed twice.
    let mistyped = ends.iter().any(|ends| ends.child.is_none());
    for (part, joint) in joint_of.iter().enumerate().skip(1) {
        if joint.is_none() && !mistyped {
            problems.push(Problem::NoJoint { path: format!("parts[{part}]"), part: name(part) });
        }
    }
}

/// Reports each loop once; returns which parts are in one.
fn check_cycles(
    creature: &Creature,
    parent_of: impl Fn(usize) -> Option<usize>,
    joint_of: &[Option<usize>],
    problems: &mut Vec<Problem>,
) -> Vec<bool> {
    let mut in_cycle = vec![false; creature.parts.len()];
    // Which walk came by a part first: a walk that meets itself has gone round a loop.
    let mut walk_of: Vec<Option<usize>> = vec![None; creature.parts.len()];
    for start in 0..creature.parts.len() {
        let mut here = Some(start);
        while let Some(part) = here.filter(|&part| walk_of[part].is_none()) {
            walk_of[part] = Some(start);
            here = parent_of(part);
        }
        let Some(first) = here.filter(|&part| walk_of[part] == Some(start)) else { continue };
        let mut names = vec![creature.parts[first].name.clone()];
        let mut part = first;
        while !in_cycle[part] {
            in_cycle[part] = true;
            part = parent_of(part).unwrap_or(first);
            names.push(creature.parts[part].name.clone());
        }
        let joint = joint_of[first].unwrap_or_default();
        problems.push(Problem::Cycle { path: format!("joints[{joint}]"), names });
    }
    in_cycle
}
