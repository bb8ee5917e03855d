//! A body with its gait as a skeleton for DragonBones 5.5, which many two-dimensional engines play.
//!
//! A bone for each part, at the hinge that the part hangs on; a slot for each, in the order in which parts are drawn,
//! with the part's shape as a bounding box: it has a colour, but no image, so that a player shows nothing where it does
//! not draw bounding boxes. The animation `loop` stays in place: DragonBones has no root motion. The armature's
//! `userData` says, as its only number, how far a loop would have gone, px.

#[cfg(test)]
mod tests;

use crate::{Cycle, ExportError, bones, outline};
use creatures::{Blueprint, BodyPart, Colour, Hinge, Shape};
use gambol_runs::{Registry, champion::Champion};
use serde_json::{Value, json};

/// Pixels a metre.
const SCALE: f64 = 100.0;
/// Frames a second.
const RATE: f64 = 30.0;

pub(crate) fn of(champion: &Champion, registry: &Registry) -> Result<Vec<u8>, ExportError> {
    let cycle = Cycle::of_champion(champion, registry)?;
    let mut text = skeleton(&Blueprint::new(champion.creature.clone())?, &cycle).to_string();
    text.push('\n');
    Ok(text.into_bytes())
}

/// A body with its gait. The ground is at y = 0, below the torso.
fn skeleton(blueprint: &Blueprint, cycle: &Cycle) -> Value {
    let order = blueprint.creature().drawing_order();
    let name = |part: usize| &blueprint.parts()[part].name;
    let bone = |(part, body): (usize, &BodyPart)| bone(blueprint, part, body);
    let slot = |&part: &usize| json!({ "name": name(part), "parent": name(part) });
    let shown = |&part: &usize| json!({ "name": name(part), "display": [display(blueprint, part)] });
    let [left, bottom, right, top] = blueprint.bounding_box().map(f64::from);
    let box_left = left - f64::from(blueprint.parts()[0].x);
    let armature = json!({
        "type": "Armature",
        "name": blueprint.name(),
        "frameRate": RATE,
        "aabb": {
            "x": pixels(box_left), "y": pixels(-top), "width": pixels(right - left), "height": pixels(top - bottom),
        },
        "bone": blueprint.parts().iter().enumerate().map(bone).collect::<Vec<_>>(),
        "slot": order.iter().map(slot).collect::<Vec<_>>(),
        "skin": [{ "name": "", "slot": order.iter().map(shown).collect::<Vec<_>>() }],
        "animation": [animation(blueprint, cycle)],
        "defaultActions": [{ "gotoAndPlay": "loop" }],
        "userData": { "floats": [pixels(cycle.travel)] },
    });
    json!({
        "name": blueprint.name(),
        "version": "5.5",
        "compatibleVersion": "5.5",
        "frameRate": RATE,
        "armature": [armature],
    })
}

/// From metres, as short as a picture needs it.
fn pixels(metres: f64) -> f64 {
    rounded(SCALE * metres)
}

/// DragonBones turns clockwise, in degrees.
fn degrees(angle: f64) -> f64 {
    rounded(-angle.to_degrees())
}

fn rounded(number: f64) -> f64 {
    // Not −0.
    (number * 1e4).round() / 1e4 + 0.0
}

/// In the start pose.
fn bone(blueprint: &Blueprint, part: usize, body: &BodyPart) -> Value {
    let Some(hinge) = bones::hinge_of(blueprint, part) else {
        return json!({ "name": body.name, "transform": transform([0.0, body.y.into()], body.angle.into()) });
    };
    let (place, angle) = bones::at_rest(blueprint, hinge);
    let transform = transform(place.map(f64::from), angle);
    json!({ "name": body.name, "parent": blueprint.parts()[hinge.parent].name, "transform": transform })
}

/// In DragonBones y is down.
fn transform([x, y]: [f64; 2], angle: f64) -> Value {
    json!({ "x": pixels(x), "y": pixels(-y), "skX": degrees(angle), "skY": degrees(angle) })
}

/// The shape of a part as a bounding box.
fn display(blueprint: &Blueprint, part: usize) -> Value {
    let drawn = &blueprint.creature().parts[part];
    let size = |width: f32, height: f32| (pixels(width.into()), pixels(height.into()));
    let mut display = match drawn.shape {
        Shape::Box { width, height } => {
            let (width, height) = size(width, height);
            json!({ "subType": "rectangle", "width": width, "height": height })
        }
        Shape::Circle { radius } => {
            let (width, height) = size(2.0 * radius, 2.0 * radius);
            json!({ "subType": "ellipse", "width": width, "height": height })
        }
        Shape::Capsule { .. } => {
            let points = outline::of_shape(drawn.shape, 0.0);
            let corners = points.into_iter().flat_map(|[x, y]| [pixels(x.into()), pixels((-y).into())]);
            json!({ "subType": "polygon", "vertices": corners.collect::<Vec<_>>() })
        }
    };
    let [x, y] = bones::origin(blueprint, part).map(f64::from);
    let [red, green, blue] = drawn.look.colour.rgb().or_else(|| Colour::default().rgb()).unwrap_or_default();
    display["type"] = json!("boundingBox");
    display["name"] = json!(drawn.name);
    display["color"] = json!(u32::from_be_bytes([0, red, green, blue]));
    display["transform"] = json!({ "x": pixels(-x), "y": pixels(y) });
    display
}

/// What frames say is added to the rest.
fn animation(blueprint: &Blueprint, cycle: &Cycle) -> Value {
    let frames = cycle.frames(RATE);
    let poses = cycle.resampled(frames, true);
    let torso = &blueprint.parts()[0];
    // The last frame has no duration, and is the first again.
    let poses = || poses.iter().map(|pose| (pose, 1)).chain(poses.first().map(|pose| (pose, 0)));
    let rotated =
        |duration: u32, angle: f64| json!({ "duration": duration, "tweenEasing": 0, "rotate": degrees(angle) });
    let moves = poses().map(|(pose, duration)| {
        let (x, y) = (pixels(pose.x), pixels(f64::from(torso.y) - pose.y));
        json!({ "duration": duration, "tweenEasing": 0, "x": x, "y": y })
    });
    let turns = poses().map(|(pose, duration)| rotated(duration, pose.angle - f64::from(torso.angle)));
    let root = json!({
        "name": torso.name, "translateFrame": moves.collect::<Vec<_>>(), "rotateFrame": turns.collect::<Vec<_>>(),
    });
    let limb = |(index, hinge): (usize, &Hinge)| {
        let turns: Vec<Value> = poses().map(|(pose, duration)| rotated(duration, pose.hinges[index])).collect();
        json!({ "name": blueprint.parts()[hinge.child].name, "rotateFrame": turns })
    };
    let limbs = blueprint.hinges().iter().enumerate().map(limb);
    let bones: Vec<Value> = std::iter::once(root).chain(limbs).collect();
    json!({ "name": "loop", "duration": frames, "playTimes": 0, "fadeInTime": 0, "bone": bones })
}
