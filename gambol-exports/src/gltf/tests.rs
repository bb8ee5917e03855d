#![allow(clippy::print_stderr)]

use super::*;
use crate::{bones::origin, sample::samples};
use base64::{Engine, prelude::BASE64_STANDARD};
use std::{fs, process::Command};
use tasks::Snapshot;

/// A file, read as the format's description says.
struct Reader {
    document: Value,
    bytes: Vec<u8>,
}

/// Where a node is in the world, or in its parent: x, y and angle.
type Place = [f64; 3];

impl Reader {
    fn new(blueprint: &Blueprint, cycle: &Cycle) -> Self {
        let text = document(blueprint, cycle).to_string();
        let document: Value = serde_json::from_str(&text).expect("JSON");
        let uri = document["buffers"][0]["uri"].as_str().expect("text");
        let data = uri.strip_prefix("data:application/octet-stream;base64,").expect("data");
        let bytes = BASE64_STANDARD.decode(data).expect("base64");
        assert_eq!(document["buffers"][0]["byteLength"], bytes.len());
        Self { document, bytes }
    }

    /// The numbers of an accessor, row by row.
    fn rows(&self, accessor: &Value) -> Vec<Vec<f64>> {
        let accessor = &self.document["accessors"][index(accessor)];
        let view = &self.document["bufferViews"][index(&accessor["bufferView"])];
        let (start, length) = (index(&view["byteOffset"]), index(&view["byteLength"]));
        let width = match accessor["type"].as_str() {
            Some("SCALAR") => 1,
            Some("VEC3") => 3,
            Some("VEC4") => 4,
            other => panic!("{other:?}"),
        };
        assert_eq!(start % 4, 0);
        let bytes = &self.bytes[start..start + length];
        let numbers: Vec<f64> = match index(&accessor["componentType"]) {
            5126 => bytes.as_chunks().0.iter().map(|&number| f32::from_le_bytes(number).into()).collect(),
            5123 => bytes.as_chunks().0.iter().map(|&number| u16::from_le_bytes(number).into()).collect(),
            other => panic!("{other}"),
        };
        let rows: Vec<Vec<f64>> = numbers.chunks(width).map(<[f64]>::to_vec).collect();
        assert_eq!(rows.len(), index(&accessor["count"]));
        for (bound, pick) in [("min", f64::min as fn(f64, f64) -> f64), ("max", f64::max)] {
            for (place, bound) in accessor[bound].as_array().into_iter().flatten().enumerate() {
                assert_eq!(rows.iter().map(|row| row[place]).reduce(pick), bound.as_f64());
            }
        }
        rows
    }

    /// All nodes in the world at a time, s; in the start pose without one.
    fn places(&self, time: Option<f64>) -> Vec<Place> {
        let nodes = self.document["nodes"].as_array().expect("nodes");
        let mut local: Vec<Place> =
            nodes.iter().map(|node| place(&numbers(&node["translation"]), &numbers(&node["rotation"]))).collect();
        let animation = &self.document["animations"][0];
        for channel in animation["channels"].as_array().filter(|_| time.is_some()).into_iter().flatten() {
            let sampler = &animation["samplers"][index(&channel["sampler"])];
            assert_eq!(sampler["interpolation"], "LINEAR");
            let (times, values) = (self.rows(&sampler["input"]), self.rows(&sampler["output"]));
            assert_eq!(times.len(), values.len());
            let time = time.unwrap_or_default();
            let key = times.iter().rposition(|key| key[0] <= time).unwrap_or(0).min(times.len() - 2);
            let share = (time - times[key][0]) / (times[key + 1][0] - times[key][0]);
            let mix = |place: usize| values[key][place] + share * (values[key + 1][place] - values[key][place]);
            let node = index(&channel["target"]["node"]);
            match channel["target"]["path"].as_str() {
                Some("translation") => (local[node][0], local[node][1]) = (mix(0), mix(1)),
                Some("rotation") => {
                    // The short way: both are turns about z.
                    let [from, to] = [&values[key], &values[key + 1]].map(|turn| angle(turn));
                    local[node][2] = from + share * wrapped(to - from);
                }
                other => panic!("{other:?}"),
            }
        }
        let mut world = local.clone();
        let mut open = vec![0];
        while let Some(parent) = open.pop() {
            for child in nodes[parent]["children"].as_array().into_iter().flatten().map(index) {
                world[child] = within(world[parent], local[child]);
                open.push(child);
            }
        }
        world
    }

    /// How far parts are from where a pose has them, at most, m and rad.
    fn difference(&self, blueprint: &Blueprint, time: Option<f64>, pose: &Snapshot) -> f64 {
        let mut greatest: f64 = 0.0;
        for (part, place) in self.places(time).into_iter().enumerate() {
            let [left, up] = origin(blueprint, part).map(f64::from);
            let [x, y, angle] = within(place, [-left, -up, 0.0]);
            let expected = &pose.parts[part];
            let turned = wrapped(angle - f64::from(expected.angle()));
            let apart = libm::hypot(x - f64::from(expected.x), y - f64::from(expected.y));
            greatest = greatest.max(turned.abs()).max(apart);
        }
        greatest
    }
}

fn index(value: &Value) -> usize {
    value.as_u64().expect("a whole number") as usize
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(|number| number.as_f64().expect("a number")).collect()
}

fn place(translation: &[f64], rotation: &[f64]) -> Place {
    assert_eq!((translation.len(), translation[2]), (3, 0.0));
    [translation[0], translation[1], angle(rotation)]
}

fn angle(rotation: &[f64]) -> f64 {
    assert_eq!((rotation.len(), rotation[0], rotation[1]), (4, 0.0, 0.0));
    assert!((libm::hypot(rotation[2], rotation[3]) - 1.0).abs() < 1e-6);
    2.0 * libm::atan2(rotation[2], rotation[3])
}

/// A place that a parent sees, as the world sees it.
fn within([x, y, angle]: Place, [along, across, turned]: Place) -> Place {
    let (sin, cos) = libm::sincos(angle);
    [x + cos * along - sin * across, y + sin * along + cos * across, angle + turned]
}

#[test]
fn nodes_stand_where_the_poses_of_the_cycle_have_them() {
    for (blueprint, cycle) in samples() {
        let (name, reader) = (blueprint.name(), Reader::new(&blueprint, &cycle));
        // At the keys, and between them.
        for step in 0..=4 * cycle.poses.len() {
            let share = step as f64 / (4 * cycle.poses.len()) as f64;
            let pose = cycle.at(share).snapshot(&blueprint);
            let difference = reader.difference(&blueprint, Some(share * cycle.seconds), &pose);
            assert!(difference < 1e-4, "{name} at {share}: {difference}");
        }
        let mut start = Snapshot::default();
        start.parts.extend(blueprint.parts().iter().map(|part| {
            let (sin, cos) = libm::sincosf(part.angle);
            tasks::PartState { x: part.x, y: part.y, cos, sin, ..Default::default() }
        }));
        let difference = reader.difference(&blueprint, None, &start);
        assert!(difference < 1e-5, "{name} at the start: {difference}");
    }
}

#[test]
fn the_last_key_is_the_first_a_cycle_further_on() {
    for (blueprint, cycle) in samples() {
        let reader = Reader::new(&blueprint, &cycle);
        let animation = &reader.document["animations"][0];
        assert_eq!(animation["extras"]["seconds"], cycle.seconds);
        assert_eq!(animation["extras"]["travel"], cycle.travel);
        assert_eq!(animation["channels"].as_array().map(Vec::len), Some(blueprint.parts().len() + 1));
        let (first, last) = (reader.places(Some(0.0)), reader.places(Some(cycle.seconds)));
        for (first, last) in first.into_iter().zip(last) {
            assert!((last[0] - first[0] - cycle.travel).abs() < 1e-5);
            assert!((last[1] - first[1]).abs() < 1e-5);
            assert!(wrapped(last[2] - first[2]).abs() < 1e-5);
        }
        let neighbours = |turns: &[Vec<f64>]| {
            turns.windows(2).all(|pair| pair[0].iter().zip(&pair[1]).map(|(one, other)| one * other).sum::<f64>() > 0.0)
        };
        let samplers = animation["samplers"].as_array().expect("samplers");
        assert!(samplers[1..].iter().all(|sampler| neighbours(&reader.rows(&sampler["output"]))));
    }
}

#[test]
fn meshes_hold_the_shapes_in_the_order_they_are_drawn_in() {
    for (blueprint, cycle) in samples() {
        let reader = Reader::new(&blueprint, &cycle);
        let mut before = -1.0;
        for part in blueprint.creature().drawing_order() {
            let drawn = &blueprint.creature().parts[part];
            assert_eq!(reader.document["nodes"][part]["name"], *drawn.name);
            assert_eq!(index(&reader.document["nodes"][part]["mesh"]), part);
            let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
            for primitive in reader.document["meshes"][part]["primitives"].as_array().expect("primitives") {
                let (points, corners) =
                    (reader.rows(&primitive["attributes"]["POSITION"]), reader.rows(&primitive["indices"]));
                assert!(
                    corners.len().is_multiple_of(3) && corners.iter().all(|corner| corner[0] < points.len() as f64)
                );
                for point in points {
                    for axis in 0..3 {
                        bounds[0][axis] = bounds[0][axis].min(point[axis]);
                        bounds[1][axis] = bounds[1][axis].max(point[axis]);
                    }
                }
                let material = &reader.document["materials"][index(&primitive["material"])];
                assert_eq!(material["pbrMetallicRoughness"]["baseColorFactor"][3], drawn.look.opacity);
                assert_eq!(material["doubleSided"], true);
                assert!(material["extensions"]["KHR_materials_unlit"].is_object());
            }
            let (half, middle) = (drawn.shape.half_extents(1.0, 0.0), origin(&blueprint, part));
            for axis in 0..2 {
                let (half, middle) = (f64::from(half[axis]), f64::from(middle[axis]));
                assert!(bounds[0][axis] <= 1e-6 - half - middle && bounds[1][axis] >= half - middle - 1e-6);
            }
            assert!(bounds[0][2] > before, "{}: {} is not before {before}", drawn.name, bounds[0][2]);
            before = bounds[1][2];
        }
    }
}

#[test]
fn colours_are_amounts_of_light() {
    assert_eq!((linear(0), linear(255)), (0.0, 1.0));
    assert!((linear(188) - 0.5).abs() < 0.005);
}

/// With the validator of those who made the format, where it is installed for node.
#[test]
fn the_official_validator_finds_nothing() {
    let has = Command::new("node").args(["-e", "require('gltf-validator')"]).output();
    if !has.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: node has no gltf-validator");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    for (blueprint, cycle) in samples() {
        let file = folder.path().join("body.gltf");
        fs::write(&file, document(&blueprint, &cycle).to_string()).expect("written");
        let program = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/check_gltf.cjs");
        let output = Command::new("node").arg(program).arg(&file).output().expect("node");
        let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert!(output.status.success(), "{}: {said}", blueprint.name());
        eprintln!("{}: {}", blueprint.name(), said.trim());
    }
}
