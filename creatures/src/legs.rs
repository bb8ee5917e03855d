//! Feet and legs, found in the tree of parts.

use crate::{BodyPart, Hinge};

/// Indices of the feet: actuated parts, other than the torso, on which nothing hangs; in the order of the parts.
pub(crate) fn feet(parts: &[BodyPart], hinges: &[Hinge]) -> Vec<usize> {
    let is_foot = |&part: &usize| parts[part].actuated && !hinges.iter().any(|hinge| hinge.parent == part);
    (1..parts.len()).filter(is_foot).collect()
}

/// The leg of each foot, from hip to foot: up from the foot for as long as the parts are actuated, short of the torso.
pub(crate) fn legs(parts: &[BodyPart], hinges: &[Hinge], feet: &[usize]) -> Vec<Vec<usize>> {
    let parent_of = |part: usize| hinges.iter().find(|hinge| hinge.child == part).map(|hinge| hinge.parent);
    let leg_of = |&foot: &usize| {
        let above = |&part: &usize| parent_of(part).filter(|&parent| parent != 0 && parts[parent].actuated);
        let mut leg: Vec<usize> = std::iter::successors(Some(foot), above).collect();
        leg.reverse();
        leg
    };
    feet.iter().map(leg_of).collect()
}
