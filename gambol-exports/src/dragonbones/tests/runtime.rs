//! The runtime of DragonBones reads the files and puts pictures where the poses of the cycle have the parts.
#![allow(clippy::print_stderr)]

use super::{displays, exported, number, scale};
use crate::{Pose, pose::wrapped, sample::samples};
use serde_json::Value;
use std::{fs, process::Command};

#[test]
fn the_runtime_of_dragonbones_shows_the_cycle() {
    let has = Command::new("node").args(["-e", "require.resolve('@cocos/dragonbones-js')"]).output();
    if !has.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: node has no @cocos/dragonbones-js");
        return;
    }
    let folder = tempfile::tempdir().expect("a folder");
    for (blueprint, cycle) in samples() {
        let (skeleton, atlas, _) = exported(&blueprint, &cycle);
        let [skeleton_file, atlas_file] = ["hero_ske.json", "hero_tex.json"].map(|name| folder.path().join(name));
        fs::write(&skeleton_file, skeleton.to_string()).expect("written");
        fs::write(&atlas_file, atlas.to_string()).expect("written");
        let program = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/check_dragonbones.cjs");
        let output = Command::new("node").arg(program).args([&skeleton_file, &atlas_file]).output().expect("node");
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{}: {said}", blueprint.name());
        let frames: Vec<Value> = serde_json::from_slice(&output.stdout).expect("JSON");
        assert_eq!(frames.len(), 22);
        let displays = displays(&skeleton["armature"][0]);
        for (frame, slots) in frames.iter().enumerate() {
            let share = frame as f64 / 22.0;
            let pose = cycle.at(share);
            let states = Pose { x: pose.x - share * cycle.travel, ..pose }.snapshot(&blueprint).parts;
            assert_eq!(slots.as_object().map(serde_json::Map::len), Some(states.len()), "pictures, and no boxes");
            for (part, state) in blueprint.parts().iter().zip(states) {
                let slot = &slots[&part.name];
                // From the middle of the picture to that of the part.
                let [along, across] = ["x", "y"].map(|axis| {
                    number(&displays[&*format!("{}:box", part.name)]["transform"][axis])
                        - number(&displays[&*part.name]["transform"][axis])
                });
                let (angle, [x, y]) = (number(&slot["angle"]), ["x", "y"].map(|axis| number(&slot[axis])));
                let (sin, cos) = libm::sincos(angle);
                let [x, y] = [x + cos * along - sin * across, y + sin * along + cos * across];
                let [wanted_x, wanted_y] = [state.x, state.y].map(|metres| scale(&blueprint) * f64::from(metres));
                let (apart, turned) =
                    (libm::hypot(x - wanted_x, y + wanted_y), wrapped(angle + f64::from(state.angle())));
                assert!(
                    apart < 0.2 && turned.abs() < 0.005,
                    "{}, {}: {apart} px, {turned}",
                    blueprint.name(),
                    part.name
                );
                assert_eq!(slot["texture"], part.name);
            }
        }
        eprintln!("{}: {} frames", blueprint.name(), frames.len());
    }
}
