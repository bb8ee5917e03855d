//! Legs and other limbs, found in the tree of parts.

use crate::body_part::{BodyPart, Hinge};

/// The limbs, one for each actuated part (other than the torso) on which nothing hangs, in the order of these parts: from the
/// last part up for as long as the parts are actuated, short of the torso, and told from the body outwards.
pub(crate) fn limbs(parts: &[BodyPart], hinges: &[Hinge]) -> Vec<Vec<usize>> {
    let is_last = |&part: &usize| parts[part].actuated && !hinges.iter().any(|hinge| hinge.parent == part);
    let parent_of = |part: usize| hinges.iter().find(|hinge| hinge.child == part).map(|hinge| hinge.parent);
    let limb_of = |last: usize| {
        let above = |&part: &usize| parent_of(part).filter(|&parent| parent != 0 && parts[parent].actuated);
        let mut limb: Vec<usize> = std::iter::successors(Some(last), above).collect();
        limb.reverse();
        limb
    };
    (1..parts.len()).filter(is_last).map(limb_of).collect()
}

/// Whether a limb is a leg: none of its parts says that it is not.
pub(crate) fn is_leg(parts: &[BodyPart], limb: &[usize]) -> bool {
    limb.iter().all(|&part| parts[part].leg)
}
