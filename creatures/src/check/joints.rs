//! Anchors, limits and motors.

use std::collections::BTreeSet;

use super::numbers::{check as check_number, check_pair};
use super::tree::Ends;
use crate::body_part::to_local;
use crate::bounds::{ANCHOR_DISTANCE, ANGLE, POSITION, SIZE, TOP_SPEED, TOP_TORQUE};
use crate::names::shortened;
use crate::{Creature, Joint, Part, Problem};

/// The least a joint with a motor must be able to turn, degrees.
const LEAST_ROOM: f32 = 1.0;

/// The most limits may be apart, degrees: a motor that overshoots a wider range comes round on the other side.
const WIDEST_RANGE: f32 = 340.0;

pub(super) fn check(creature: &Creature, ends: &[Ends], problems: &mut Vec<Problem>) {
    let mut has_output = false;
    for (index, (joint, ends)) in creature.joints.iter().zip(ends).enumerate() {
        let path = format!("joints[{index}]");
        check_anchor(&path, joint, creature, *ends, problems);
        check_limits(&format!("{path}.limits"), joint, problems);
        if let Some(motor) = joint.motor {
            check_number(|| format!("{path}.motor.top_speed"), motor.top_speed, TOP_SPEED, problems);
            check_number(|| format!("{path}.motor.top_torque"), motor.top_torque, TOP_TORQUE, problems);
            has_output |= ends.child.is_some_and(|c| creature.actuated_tags.contains(&creature.parts[c].tag));
        }
    }
    if !has_output && !creature.parts.is_empty() {
        let tags: BTreeSet<&str> = creature.parts.iter().skip(1).map(|part| part.tag.as_str()).collect();
        problems.push(Problem::NoMotors {
            actuated_tags: creature.actuated_tags.iter().map(|tag| shortened(tag)).collect(),
            tags: if tags.is_empty() { vec!["none".to_owned()] } else { tags.into_iter().map(shortened).collect() },
        });
    }
}

fn check_anchor(path: &str, joint: &Joint, creature: &Creature, ends: Ends, problems: &mut Vec<Problem>) {
    let path = format!("{path}.anchor");
    if !check_pair(&path, joint.anchor, POSITION, problems) {
        return;
    }
    for part in [ends.parent, ends.child].into_iter().flatten() {
        let part = &creature.parts[part];
        if !is_somewhere(part) {
            continue;
        }
        let distance = part.shape.distance_to(to_local(part.position, part.angle.to_radians(), joint.anchor));
        if distance > ANCHOR_DISTANCE.max {
            problems.push(Problem::AnchorFar {
                path: path.clone(),
                part: part.name.clone(),
                distance,
                most: ANCHOR_DISTANCE.max,
            });
        }
    }
}

/// Whether the numbers of a part say where it is. If not, that has been told already: its anchors are not to blame.
fn is_somewhere(part: &Part) -> bool {
    part.shape.sizes().iter().all(|&(_, size)| SIZE.contains(size))
        && part.position.iter().all(|&coordinate| POSITION.contains(coordinate))
        && ANGLE.contains(part.angle)
}

fn check_limits(path: &str, joint: &Joint, problems: &mut Vec<Problem>) {
    let limits @ [min, max] = joint.limits;
    let path = path.to_owned();
    if !check_pair(&path, limits, ANGLE, problems) {
        return;
    }
    if min > max {
        problems.push(Problem::LimitsReversed { path, limits });
    } else if min > 0.0 || max < 0.0 {
        problems.push(Problem::LimitsWithoutStart { path, limits });
    } else if max - min > WIDEST_RANGE || min < -180.0 || max > 180.0 {
        problems.push(Problem::LimitsTooWide { path, limits });
    } else if joint.motor.is_some() && max - min < LEAST_ROOM {
        problems.push(Problem::LimitsLocked { path, limits });
    }
}
