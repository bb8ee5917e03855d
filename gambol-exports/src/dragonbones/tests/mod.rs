use super::*;
use crate::{Picture, pose::wrapped, sample::samples};
use std::collections::BTreeMap;

mod pictures;
mod runtime;

fn options() -> Options {
    Options { name: "hero".into(), steps: None, picture: Picture { size: 400, ..Picture::default() } }
}

/// The skeleton, the atlas, and the image.
fn exported(blueprint: &Blueprint, cycle: &Cycle) -> (Value, Value, Vec<u8>) {
    let [skeleton, atlas, image] = files(blueprint, cycle, &options()).expect("it can be drawn");
    let json = |bytes: Vec<u8>| serde_json::from_slice(&bytes).expect("JSON");
    (json(skeleton), json(atlas), image)
}

/// Pixels a metre.
fn scale(blueprint: &Blueprint) -> f64 {
    Scale::of(blueprint, options().picture.size).0
}

/// Where a bone is: x and y, px, down, and how it is turned, clockwise, degrees.
type Place = [f64; 3];

/// The bones in the world at a frame, as the format's description says: what a frame says is added to the rest. Without
/// a frame at rest.
fn bones(armature: &Value, frame: Option<u64>) -> BTreeMap<String, Place> {
    let mut world = BTreeMap::new();
    let animation = &armature["animation"][0];
    for bone in list(&armature["bone"]) {
        let name = text(&bone["name"]);
        let rest = &bone["transform"];
        assert_eq!(rest["skX"], rest["skY"]);
        let timeline = list(&animation["bone"]).iter().find(|timeline| timeline["name"] == *name);
        let keys = |field: &str| timeline.zip(frame).and_then(|(timeline, frame)| key(timeline.get(field)?, frame));
        let (moved, turned) = (keys("translateFrame"), keys("rotateFrame"));
        let added = |key: &Option<&Value>, field: &str| key.map_or(0.0, |key| number(&key[field]));
        let local = [
            number(&rest["x"]) + added(&moved, "x"),
            number(&rest["y"]) + added(&moved, "y"),
            number(&rest["skY"]) + added(&turned, "rotate"),
        ];
        let parent = bone.get("parent").map(|parent| world[text(parent)]);
        world.insert(name.to_owned(), parent.map_or(local, |parent| within(parent, local)));
    }
    world
}

/// The key that begins at a frame.
fn key(keys: &Value, frame: u64) -> Option<&Value> {
    let mut start = 0;
    list(keys).iter().find(|key| {
        let begins = start == frame;
        start += key["duration"].as_u64().expect("a number");
        begins
    })
}

/// With y down and clockwise angles the formula is the same.
fn within([x, y, angle]: Place, [along, across, turned]: Place) -> Place {
    let (sin, cos) = libm::sincos(angle.to_radians());
    [x + cos * along - sin * across, y + sin * along + cos * across, angle + turned]
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

fn text(value: &Value) -> &str {
    value.as_str().expect("text")
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The displays of slots, by the names of the slots.
fn displays(armature: &Value) -> BTreeMap<&str, &Value> {
    let slots = list(&armature["skin"][0]["slot"]);
    slots.iter().map(|slot| (text(&slot["name"]), &slot["display"][0])).collect()
}

#[test]
fn bones_stand_where_the_poses_of_the_cycle_have_them() {
    for (blueprint, cycle) in samples() {
        let (skeleton, ..) = exported(&blueprint, &cycle);
        let armature = &skeleton["armature"][0];
        let displays = displays(armature);
        let animation = &armature["animation"][0];
        let frames = animation["duration"].as_u64().expect("a number");
        assert_eq!(frames, 22, "0.74 s at 30 a second");
        for frame in 0..frames {
            let share = frame as f64 / frames as f64;
            let pose = cycle.at(share);
            let pose = crate::Pose { x: pose.x - share * cycle.travel, ..pose };
            let bones = bones(armature, Some(frame));
            for (part, state) in blueprint.parts().iter().zip(pose.snapshot(&blueprint).parts) {
                let middle = &displays[&*format!("{}:box", part.name)]["transform"];
                let [x, y, angle] = within(bones[&part.name], [number(&middle["x"]), number(&middle["y"]), 0.0]);
                let [wanted_x, wanted_y] = [state.x, state.y].map(|metres| scale(&blueprint) * f64::from(metres));
                let apart = libm::hypot(x - wanted_x, y + wanted_y);
                let turned = wrapped(angle.to_radians() + f64::from(state.angle())).to_degrees().abs();
                assert!(apart < 0.1 && turned < 0.1, "{}, {}: {apart} px, {turned}°", blueprint.name(), part.name);
            }
        }
        // The last key has no duration and is the first again.
        for bone in list(&animation["bone"]) {
            for keys in ["translateFrame", "rotateFrame"].iter().filter_map(|&field| bone.get(field)) {
                let (first, last) = (&list(keys)[0], &list(keys)[frames as usize]);
                assert_eq!(
                    (first["x"].as_f64(), first["rotate"].as_f64()),
                    (last["x"].as_f64(), last["rotate"].as_f64())
                );
                assert_eq!((list(keys).len() as u64, last["duration"].as_u64()), (frames + 1, Some(0)));
            }
        }
    }
}

#[test]
fn bones_at_rest_are_the_start_pose() {
    for (blueprint, cycle) in samples() {
        let (skeleton, ..) = exported(&blueprint, &cycle);
        let armature = &skeleton["armature"][0];
        let (bones, displays) = (bones(armature, None), displays(armature));
        let torso = blueprint.parts()[0].x;
        for part in blueprint.parts() {
            let middle = &displays[&*format!("{}:box", part.name)]["transform"];
            let [x, y, angle] = within(bones[&part.name], [number(&middle["x"]), number(&middle["y"]), 0.0]);
            let [wanted_x, wanted_y] = [part.x - torso, part.y].map(|metres| scale(&blueprint) * f64::from(metres));
            assert!(libm::hypot(x - wanted_x, y + wanted_y) < 0.01);
            assert!(wrapped(angle.to_radians() + f64::from(part.angle)).abs() < 1e-4);
        }
    }
}

#[test]
fn slots_are_in_the_order_of_drawing_with_the_shapes_as_bounding_boxes() {
    let (blueprint, cycle) = samples().pop().expect("one of every shape");
    let (skeleton, ..) = exported(&blueprint, &cycle);
    let armature = &skeleton["armature"][0];
    let names: Vec<&str> = list(&armature["slot"]).iter().map(|slot| text(&slot["name"])).collect();
    assert_eq!(names, ["hand", "hub", "arm", "hand:box", "hub:box", "arm:box"]);
    let displays = displays(armature);
    assert!(["hand", "hub", "arm"].iter().all(|slot| displays[slot]["type"] == "image"));
    let pixels = |metres: f64| Scale(scale(&blueprint)).pixels(metres);
    let (hand, hub, arm) = (displays["hand:box"], displays["hub:box"], displays["arm:box"]);
    assert!([hand, hub, arm].iter().all(|display| display["type"] == "boundingBox"));
    assert_eq!(hand["subType"], "rectangle");
    assert!((number(&hand["width"]) - pixels(0.3)).abs() < 1e-3);
    assert_eq!((&hub["subType"], &hub["color"]), (&json!("ellipse"), &json!(0x33_66_99)));
    assert!((number(&hub["height"]) - pixels(0.6)).abs() < 1e-3);
    let corners = list(&arm["vertices"]);
    assert_eq!(arm["subType"], "polygon");
    let highest = corners.iter().skip(1).step_by(2).map(number).fold(f64::INFINITY, f64::min);
    assert!((highest + pixels(0.35)).abs() < 1e-3);
    assert_eq!(armature["userData"]["floats"], json!([pixels(0.8), pixels(1.0), rounded(cycle.seconds)]));
}

#[test]
fn the_body_is_as_large_as_is_asked_for() {
    for (blueprint, cycle) in samples() {
        let (skeleton, ..) = exported(&blueprint, &cycle);
        let sides = ["width", "height"].map(|side| number(&skeleton["armature"][0]["aabb"][side]));
        assert!((sides[0].max(sides[1]) - 400.0).abs() < 1e-3, "{sides:?}");
        let out_of_range = Options { picture: Picture { size: 5, ..Picture::default() }, ..options() };
        assert!(out_of_range.picture.check().is_err());
    }
}
