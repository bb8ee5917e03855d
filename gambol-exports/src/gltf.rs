//! A body with its gait as glTF 2.0, for engines and modellers that know three dimensions.
//!
//! Forward is x, up is y, and the layers of a drawing lie a little apart along z: the body is seen from where z is
//! large. A node for each part, at the hinge that the part hangs on, so that it turns there. The animation `loop`
//! travels.

mod buffer;
mod mesh;
#[cfg(test)]
mod tests;

use crate::{
    Cycle, ExportError, Pose, bones,
    pose::{rest_angle, wrapped},
};
use buffer::{Buffer, Use};
use creatures::Blueprint;
use gambol_runs::{Registry, champion::Champion};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// What is painted later is so much closer, as a share of the body's length: enough for graphics cards, and hardly
/// deep.
const LAYER: f32 = 2e-4;

pub(crate) fn of(champion: &Champion, registry: &Registry) -> Result<Vec<u8>, ExportError> {
    let cycle = Cycle::of_champion(champion, registry)?;
    let mut document = document(&Blueprint::new(champion.creature.clone())?, &cycle);
    document["asset"]["extras"] = json!({ "creature": champion.creature.name, "movement": champion.movement.name });
    let mut text = document.to_string();
    text.push('\n');
    Ok(text.into_bytes())
}

/// A body with its gait.
fn document(blueprint: &Blueprint, cycle: &Cycle) -> Value {
    let mut buffer = Buffer::default();
    let mut materials = Materials::default();
    let meshes = meshes(blueprint, &mut buffer, &mut materials);
    let animation = animation(blueprint, cycle, &mut buffer);
    let mut document = json!({
        "asset": { "version": "2.0", "generator": "Gambol" },
        "extensionsUsed": ["KHR_materials_unlit"],
        "scene": 0,
        "scenes": [{ "name": blueprint.name(), "nodes": [0] }],
        "nodes": nodes(blueprint),
        "meshes": meshes,
        "materials": materials.list,
        "animations": [animation],
    });
    buffer.write(&mut document);
    document
}

/// In the start pose.
fn nodes(blueprint: &Blueprint) -> Vec<Value> {
    let node = |(part, body): (usize, &creatures::BodyPart)| {
        let in_world = ([body.x, body.y], body.angle.into());
        let ([x, y], angle) =
            bones::hinge_of(blueprint, part).map_or(in_world, |hinge| bones::at_rest(blueprint, hinge));
        let hinges = blueprint.hinges().iter();
        let children: Vec<usize> = hinges.filter(|hinge| hinge.parent == part).map(|hinge| hinge.child).collect();
        let mut node = json!({ "name": body.name, "mesh": part, "translation": [x, y, 0.0], "rotation": turn(angle) });
        if !children.is_empty() {
            node["children"] = json!(children);
        }
        node
    };
    blueprint.parts().iter().enumerate().map(node).collect()
}

/// A rotation about z, rad, as a quaternion.
fn turn(angle: f64) -> [f32; 4] {
    let (sin, cos) = libm::sincos(0.5 * angle);
    [0.0, 0.0, sin as f32, cos as f32]
}

/// The colours of all parts, each once.
#[derive(Default)]
struct Materials {
    list: Vec<Value>,
    known: BTreeMap<([u8; 3], u32), usize>,
}

impl Materials {
    fn index(&mut self, colour: [u8; 3], opacity: f32) -> usize {
        *self.known.entry((colour, opacity.to_bits())).or_insert_with(|| {
            let [red, green, blue] = colour.map(linear);
            let mut material = json!({
                "name": format!("#{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]),
                "pbrMetallicRoughness": {
                    "baseColorFactor": [red, green, blue, opacity], "metallicFactor": 0.0, "roughnessFactor": 1.0,
                },
                "extensions": { "KHR_materials_unlit": {} },
                "doubleSided": true,
            });
            if opacity < 1.0 {
                material["alphaMode"] = json!("BLEND");
            }
            self.list.push(material);
            self.list.len() - 1
        })
    }
}

/// From the numbers of an image to amounts of light, which glTF has.
fn linear(value: u8) -> f64 {
    let value = f64::from(value) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { libm::pow((value + 0.055) / 1.055, 2.4) }
}

/// A mesh for each part, with a list of triangles for each of its colours.
fn meshes(blueprint: &Blueprint, buffer: &mut Buffer, materials: &mut Materials) -> Vec<Value> {
    let creature = blueprint.creature();
    let layer = LAYER * blueprint.body_length();
    let mut meshes = vec![Value::Null; creature.parts.len()];
    let mut painted = 0;
    for part in creature.drawing_order() {
        let drawn = &creature.parts[part];
        let [left, up] = bones::origin(blueprint, part);
        let mut areas: BTreeMap<usize, Area> = BTreeMap::new();
        for paint in mesh::paints(drawn) {
            let depth = layer * painted as f32;
            painted += 1;
            let area = areas.entry(materials.index(paint.colour, drawn.look.opacity)).or_default();
            let points: Vec<[f32; 3]> = paint.points.iter().map(|[x, y]| [x - left, y - up, depth]).collect();
            area.add(&points, &paint.triangles);
        }
        let mut primitives = Vec::new();
        for (material, area) in areas {
            for (points, corners) in area.lists {
                primitives.push(json!({
                    "attributes": { "POSITION": buffer.add(&points, Use::Vertices) },
                    "indices": buffer.add_triangles(&corners),
                    "material": material,
                }));
            }
        }
        meshes[part] = json!({ "name": drawn.name, "primitives": primitives });
    }
    meshes
}

/// Triangles of one colour: lists that 16 bits can number.
#[derive(Default)]
struct Area {
    lists: Vec<(Vec<[f32; 3]>, Vec<u16>)>,
}

impl Area {
    fn add(&mut self, points: &[[f32; 3]], triangles: &[[usize; 3]]) {
        if triangles.is_empty() {
            return;
        }
        // The last number means that a strip begins anew.
        let has_room = |(known, _): &(Vec<[f32; 3]>, Vec<u16>)| known.len() + points.len() < usize::from(u16::MAX);
        if !self.lists.last().is_some_and(has_room) {
            self.lists.push(Default::default());
        }
        if let Some((known, corners)) = self.lists.last_mut() {
            let first = known.len();
            known.extend_from_slice(points);
            corners.extend(triangles.iter().flatten().filter_map(|corner| u16::try_from(first + corner).ok()));
        }
    }
}

/// A key for each pose, and a last one that is the first again, one cycle's travel on.
fn animation(blueprint: &Blueprint, cycle: &Cycle, buffer: &mut Buffer) -> Value {
    let first = cycle.at(0.0);
    let last = Pose { x: first.x + cycle.travel, ..first };
    let poses: Vec<&Pose> = cycle.poses.iter().chain([&last]).collect();
    let time = |key: usize| [(cycle.seconds * key as f64 / cycle.poses.len() as f64) as f32];
    let times = buffer.add(&(0..poses.len()).map(time).collect::<Vec<_>>(), Use::Times);
    let (mut samplers, mut channels) = (Vec::new(), Vec::new());
    let mut channel = |node: usize, path: &str, output: usize| {
        channels.push(json!({ "sampler": samplers.len(), "target": { "node": node, "path": path } }));
        samplers.push(json!({ "input": times, "output": output, "interpolation": "LINEAR" }));
    };
    let places: Vec<[f32; 3]> = poses.iter().map(|pose| [pose.x as f32, pose.y as f32, 0.0]).collect();
    channel(0, "translation", buffer.add(&places, Use::Values));
    channel(0, "rotation", buffer.add(&turns(poses.iter().map(|pose| pose.angle)), Use::Values));
    for (index, hinge) in blueprint.hinges().iter().enumerate() {
        let rest = rest_angle(blueprint, hinge);
        let turns = turns(poses.iter().map(|pose| rest + pose.hinges[index]));
        channel(hinge.child, "rotation", buffer.add(&turns, Use::Values));
    }
    json!({
        "name": "loop",
        "samplers": samplers,
        "channels": channels,
        "extras": { "seconds": cycle.seconds, "travel": cycle.travel, "unit": "m" },
    })
}

/// Rotations, each the short way from the one before.
fn turns(angles: impl Iterator<Item = f64>) -> Vec<[f32; 4]> {
    let mut before: Option<f64> = None;
    let on = |angle: f64| {
        let angle = before.map_or(angle, |before| before + wrapped(angle - before));
        before = Some(angle);
        turn(angle)
    };
    angles.map(on).collect()
}
