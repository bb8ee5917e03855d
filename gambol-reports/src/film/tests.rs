use super::*;
use crate::drawing::creature::Model;
use creatures::Blueprint;
use envs_core::Ground;
use tasks::{PartState, Snapshot};

/// A biped that slides to the right, 1 m/s.
fn sliding(cut: &Cut) -> Panel {
    let blueprint = Blueprint::new(creatures::find("biped-1").expect("shipped")).expect("valid");
    let pose = |frame: u32| {
        let time = frame as f32 / f32::from(RATE);
        let part = |part: &creatures::Part| PartState {
            x: part.position[0] + time,
            y: part.position[1],
            cos: 1.0,
            sin: 0.0,
            ..PartState::default()
        };
        Snapshot {
            time,
            parts: blueprint.creature().parts.iter().map(part).collect(),
            motor_work: 0.0,
            ..Snapshot::default()
        }
    };
    let poses = (0..cut.frames()).map(pose).collect();
    Panel::of_poses(Model::new(&blueprint), "A biped".into(), Ground::flat(), poses, cut)
}

/// The frames that a PNG says it has, and how many it has.
fn frames(png: &[u8]) -> (u32, usize) {
    let (mut at, mut said, mut found) = (8, 0, 0);
    while let Some(header) = png.get(at..at + 8) {
        let length = u32::from_be_bytes(header[..4].try_into().expect("four bytes")) as usize;
        match &header[4..] {
            b"acTL" => said = u32::from_be_bytes(png[at + 8..at + 12].try_into().expect("four bytes")),
            b"fcTL" => found += 1,
            _ => {}
        }
        at += length + 12;
    }
    (said, found)
}

#[test]
fn a_film_has_its_frames_and_is_always_the_same() {
    let cut = Cut { seconds: 1.0, columns: 2, width: 100, height: 80, ..Cut::default() };
    let film = || shoot(&[sliding(&cut), sliding(&cut), sliding(&cut)], &cut).expect("a film");
    let bytes = film();
    assert_eq!(frames(&bytes), (25, 25));
    assert_eq!(bytes, film());
    assert_eq!(size(3, &cut), [218, 178]);
    assert_eq!(size(1, &cut), [112, 92], "no empty column");
}

#[test]
fn the_camera_follows_the_creature() {
    let cut = Cut { seconds: 2.0, width: 200, height: 160, ..Cut::default() };
    let panel = sliding(&cut);
    let ink = |frame: u32| {
        let canvas = panel.draw(frame).expect("a frame");
        let background = canvas.pixel(0, 80);
        // Above the ground's marks and below the title.
        (0..200_u32).filter(|&x| (40..100).any(|y| canvas.pixel(x, y) != background)).collect::<Vec<_>>()
    };
    let middle = |columns: Vec<u32>| (columns[0] + columns[columns.len() - 1]) / 2;
    for frame in [0, 20, 49] {
        assert!(middle(ink(frame)).abs_diff(100) <= 8, "frame {frame}");
    }
}

#[test]
fn settings_out_of_range_are_named() {
    let registry = Registry::default();
    let wrong = |cut: Cut| of_champions(&[], &cut, &registry).expect_err("wrong").to_string();
    assert_eq!(wrong(Cut { columns: 0, ..Cut::default() }), "columns: 0 is not from 1 to 16");
    assert_eq!(wrong(Cut { seconds: f64::NAN, ..Cut::default() }), "seconds: NaN is not from 0.04 to 60");
    assert_eq!(wrong(Cut { from: -1.0, ..Cut::default() }), "from: -1 is not from 0 to 3600");
    assert_eq!(wrong(Cut { width: 79, ..Cut::default() }), "width: 79 is not from 80 to 1920");
    assert_eq!(wrong(Cut { height: 2000, ..Cut::default() }), "height: 2000 is not from 80 to 1920");
    assert_eq!(wrong(Cut::default()), "champions: 0 is not from 1 to 64");
}
