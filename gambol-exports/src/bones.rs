//! A body as bones: each part hangs on its parent at its hinge, and the torso on nothing.

use crate::pose::rest_angle;
use creatures::{Blueprint, Hinge};

/// The hinge that a part hangs on; none for the torso.
pub(crate) fn hinge_of(blueprint: &Blueprint, part: usize) -> Option<&Hinge> {
    blueprint.hinges().iter().find(|hinge| hinge.child == part)
}

/// Where the bone of a part begins, in the part's frame, m: at its hinge, or in the middle of the torso.
pub(crate) fn origin(blueprint: &Blueprint, part: usize) -> [f32; 2] {
    hinge_of(blueprint, part).map_or([0.0; 2], |hinge| hinge.child_anchor)
}

/// Where a bone begins in the start pose, m, and how it is turned, rad; both as its parent sees it.
pub(crate) fn at_rest(blueprint: &Blueprint, hinge: &Hinge) -> ([f32; 2], f64) {
    let ([x, y], [left, up]) = (hinge.parent_anchor, origin(blueprint, hinge.parent));
    ([x - left, y - up], rest_angle(blueprint, hinge))
}
