//! A body with its gait as a skeleton for DragonBones 5.5, which many two-dimensional engines play.
//!
//! A bone for each part, at the hinge that the part hangs on; a slot for each, in the order in which parts are drawn, with a
//! picture of the part from a texture [atlas]; and a slot that shows nothing, named `PART:box`, with its shape as a bounding
//! box. The animation `loop` stays in place: DragonBones has no root motion. The armature's `userData` says in three numbers how
//! far a loop would have gone, px, how many pixels a metre has, and how long the loop is in the gait, s: played, it has whole frames.

mod atlas;
#[cfg(test)]
mod tests;

use crate::{Cycle, ExportError, Options, bones, outline};
use atlas::Atlas;
use creatures::{Blueprint, BodyPart, Colour, Hinge, Shape};
use gambol_reports::drawing::Painter;
use gambol_runs::{Registry, champion::Champion};
use serde_json::{Value, json};

/// Frames a second.
const RATE: f64 = 30.0;

/// The skeleton, the atlas, and the image of its pictures.
pub(crate) fn of(champion: &Champion, registry: &Registry, options: &Options) -> Result<[Vec<u8>; 3], ExportError> {
    options.picture.check()?;
    let cycle = Cycle::of_champion(champion, registry)?;
    files(&Blueprint::new(champion.creature.clone())?, &cycle, options)
}

fn files(blueprint: &Blueprint, cycle: &Cycle, options: &Options) -> Result<[Vec<u8>; 3], ExportError> {
    let (painter, scale) = (Painter::new(blueprint), Scale::of(blueprint, options.picture.size));
    let atlas = Atlas::new(blueprint, &painter, scale.0)?;
    let image = atlas.image(&painter, scale.0)?;
    let description = atlas.description(blueprint.name(), &format!("{}_tex.png", options.name));
    let [skeleton, description] =
        [skeleton(blueprint, cycle, &atlas, scale), description].map(|json| format!("{json}\n").into_bytes());
    Ok([skeleton, description, image])
}

/// Pixels a metre.
#[derive(Clone, Copy)]
struct Scale(f64);

impl Scale {
    /// That with which the longer side of the body in its start pose has so many pixels.
    fn of(blueprint: &Blueprint, size: u32) -> Self {
        let [left, bottom, right, top] = blueprint.bounding_box().map(f64::from);
        Self(f64::from(size) / (right - left).max(top - bottom))
    }

    /// From metres, as short as a picture needs it.
    fn pixels(self, metres: f64) -> f64 {
        rounded(self.0 * metres)
    }

    /// A place and an angle; in DragonBones y is down.
    fn transform(self, [x, y]: [f64; 2], angle: f64) -> Value {
        json!({ "x": self.pixels(x), "y": self.pixels(-y), "skX": degrees(angle), "skY": degrees(angle) })
    }
}

/// A body with its gait. The ground is at y = 0, below the torso.
fn skeleton(blueprint: &Blueprint, cycle: &Cycle, atlas: &Atlas, scale: Scale) -> Value {
    let order = blueprint.creature().drawing_order();
    let name = |part: usize| &blueprint.parts()[part].name;
    // One that no part's name ends with, so that no two slots have the same.
    let is_free = |ending: &String| blueprint.parts().iter().all(|part| !part.name.ends_with(ending.as_str()));
    let boxed = (1..).map(|times| ":box".repeat(times)).find(is_free).unwrap_or_default();
    let bone = |(part, body): (usize, &BodyPart)| bone(blueprint, part, body, scale);
    let slots = |slot: &dyn Fn(usize, String) -> Value| -> Vec<Value> {
        let pictures = order.iter().map(|&part| slot(part, name(part).clone()));
        pictures.chain(order.iter().map(|&part| slot(part, format!("{}{boxed}", name(part))))).collect()
    };
    let shown = |part: usize, slot: String| {
        let display = match slot == *name(part) {
            true => picture(blueprint, part, atlas, scale),
            false => bounding_box(blueprint, part, scale),
        };
        json!({ "name": slot, "display": [display] })
    };
    let [left, bottom, right, top] = blueprint.bounding_box().map(f64::from);
    let box_left = left - f64::from(blueprint.parts()[0].x);
    let [x, y, width, height] = [box_left, -top, right - left, top - bottom].map(|metres| scale.pixels(metres));
    let armature = json!({
        "type": "Armature",
        "name": blueprint.name(),
        "frameRate": RATE,
        "aabb": { "x": x, "y": y, "width": width, "height": height },
        "bone": blueprint.parts().iter().enumerate().map(bone).collect::<Vec<_>>(),
        "slot": slots(&|part, slot| json!({ "name": slot, "parent": name(part) })),
        "skin": [{ "name": "", "slot": slots(&shown) }],
        "animation": [animation(blueprint, cycle, scale)],
        "defaultActions": [{ "gotoAndPlay": "loop" }],
        "userData": { "floats": [scale.pixels(cycle.travel), rounded(scale.0), rounded(cycle.seconds)] },
    });
    json!({
        "name": blueprint.name(),
        "version": "5.5",
        "compatibleVersion": "5.5",
        "frameRate": RATE,
        "armature": [armature],
    })
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
fn bone(blueprint: &Blueprint, part: usize, body: &BodyPart, scale: Scale) -> Value {
    let Some(hinge) = bones::hinge_of(blueprint, part) else {
        return json!({ "name": body.name, "transform": scale.transform([0.0, body.y.into()], body.angle.into()) });
    };
    let (place, angle) = bones::at_rest(blueprint, hinge);
    let transform = scale.transform(place.map(f64::from), angle);
    json!({ "name": body.name, "parent": blueprint.parts()[hinge.parent].name, "transform": transform })
}

/// The picture of a part, by its name in the atlas.
fn picture(blueprint: &Blueprint, part: usize, atlas: &Atlas, scale: Scale) -> Value {
    let ([x, y], [left, up]) = (atlas.pictures[part].middle, bones::origin(blueprint, part).map(f64::from));
    let place = json!({ "x": scale.pixels(x - left), "y": scale.pixels(up - y) });
    json!({ "type": "image", "name": blueprint.parts()[part].name, "transform": place })
}

/// The shape of a part as a bounding box.
fn bounding_box(blueprint: &Blueprint, part: usize, scale: Scale) -> Value {
    let drawn = &blueprint.creature().parts[part];
    let size = |width: f32, height: f32| (scale.pixels(width.into()), scale.pixels(height.into()));
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
            let corners = points.into_iter().flat_map(|[x, y]| [scale.pixels(x.into()), scale.pixels((-y).into())]);
            json!({ "subType": "polygon", "vertices": corners.collect::<Vec<_>>() })
        }
    };
    let [x, y] = bones::origin(blueprint, part).map(f64::from);
    let [red, green, blue] = drawn.look.colour.rgb().or_else(|| Colour::default().rgb()).unwrap_or_default();
    display["type"] = json!("boundingBox");
    display["name"] = json!(drawn.name);
    display["color"] = json!(u32::from_be_bytes([0, red, green, blue]));
    display["transform"] = json!({ "x": scale.pixels(-x), "y": scale.pixels(y) });
    display
}

/// What frames say is added to the rest.
fn animation(blueprint: &Blueprint, cycle: &Cycle, scale: Scale) -> Value {
    let frames = cycle.frames(RATE);
    let poses = cycle.resampled(frames, true);
    let torso = &blueprint.parts()[0];
    // The last frame has no duration, and is the first again.
    let poses = || poses.iter().map(|pose| (pose, 1)).chain(poses.first().map(|pose| (pose, 0)));
    let rotated =
        |duration: u32, angle: f64| json!({ "duration": duration, "tweenEasing": 0, "rotate": degrees(angle) });
    let moves = poses().map(|(pose, duration)| {
        let (x, y) = (scale.pixels(pose.x), scale.pixels(f64::from(torso.y) - pose.y));
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
