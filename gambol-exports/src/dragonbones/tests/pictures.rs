//! The pictures on bones look like the creature.

use super::{Place, bones, displays, exported, list, number, scale, text, within};
use crate::{Pose, picture::GAP, sample::samples};
use creatures::Blueprint;
use gambol_reports::drawing::{Framing, Painter};
use serde_json::Value;
use std::collections::BTreeMap;
use zune_png::{PngDecoder, zune_core::bytestream::ZCursor};

/// A picture: width, height, and for each pixel red, green and blue, multiplied with the opacity, and that.
struct Pixels {
    size: [usize; 2],
    pixels: Vec<[f64; 4]>,
}

impl Pixels {
    fn of(size: [usize; 2], bytes: &[u8]) -> Self {
        let pixel = |pixel: &[u8]| {
            let opacity = f64::from(pixel[3]) / 255.0;
            [0, 1, 2, 3].map(|part| f64::from(pixel[part]) * if part == 3 { 1.0 } else { opacity })
        };
        Self { size, pixels: bytes.chunks_exact(4).map(pixel).collect() }
    }

    fn read(png: &[u8]) -> Self {
        let mut decoder = PngDecoder::new(ZCursor::new(png));
        let bytes = decoder.decode_raw().expect("sound");
        let (width, height) = decoder.dimensions().expect("known");
        assert_eq!(bytes.len(), 4 * width * height);
        Self::of([width, height], &bytes)
    }

    fn at(&self, x: i64, y: i64) -> [f64; 4] {
        let [width, height] = self.size.map(|side| side as i64);
        match (0..width).contains(&x) && (0..height).contains(&y) {
            true => self.pixels[(y * width + x) as usize],
            false => [0.0; 4],
        }
    }

    /// Between the middles of pixels.
    fn sample(&self, [x, y]: [f64; 2]) -> [f64; 4] {
        let [x, y] = [x - 0.5, y - 0.5];
        let (left, top) = (x.floor(), y.floor());
        let corner = |right: i64, down: i64| self.at(left as i64 + right, top as i64 + down);
        let mix = |one: [f64; 4], two: [f64; 4], share: f64| {
            [0, 1, 2, 3].map(|part| one[part] + share * (two[part] - one[part]))
        };
        let rows = [0, 1].map(|down| mix(corner(0, down), corner(1, down), x - left));
        mix(rows[0], rows[1], y - top)
    }

    fn cut(&self, [x, y, width, height]: [usize; 4]) -> Self {
        let row = |line: usize| self.pixels[line * self.size[0] + x..][..width].to_vec();
        Self { size: [width, height], pixels: (y..y + height).flat_map(row).collect() }
    }
}

/// The pictures of an atlas, by their names, and where they are on its sheet.
fn pictures(atlas: &Value, sheet: &[u8]) -> BTreeMap<String, (Pixels, [usize; 4])> {
    let sheet = Pixels::read(sheet);
    assert_eq!(["width", "height"].map(|side| atlas[side].as_u64()), sheet.size.map(|side| Some(side as u64)));
    let entry = |texture: &Value| {
        let place = ["x", "y", "width", "height"].map(|side| texture[side].as_u64().expect("px") as usize);
        (text(&texture["name"]).to_owned(), (sheet.cut(place), place))
    };
    list(&atlas["SubTexture"]).iter().map(entry).collect()
}

#[test]
fn an_atlas_has_the_picture_of_every_part_and_none_touches_another() {
    for (blueprint, cycle) in samples() {
        let (skeleton, atlas, sheet) = exported(&blueprint, &cycle);
        assert_eq!((&atlas["name"], &atlas["imagePath"]), (&skeleton["name"], &"hero_tex.png".into()));
        let pictures = pictures(&atlas, &sheet);
        let named: Vec<&str> = blueprint.parts().iter().map(|part| &*part.name).collect();
        assert!(pictures.len() == named.len() && named.iter().all(|&name| pictures.contains_key(name)));
        let shown = displays(&skeleton["armature"][0]);
        for name in named {
            assert_eq!((&shown[name]["type"], &shown[name]["name"]), (&"image".into(), &name.into()));
            let (picture, [x, y, width, height]) = &pictures[name];
            // It is whole: nothing is drawn at its edge, but something in it.
            let is_drawn = |&(x, y): &(usize, usize)| picture.at(x as i64, y as i64)[3] > 0.0;
            let all = (0..*height).flat_map(|y| (0..*width).map(move |x| (x, y)));
            let is_edge = |&(x, y): &(usize, usize)| x == 0 || y == 0 || x == width - 1 || y == height - 1;
            let edge = all.clone().filter(is_edge).map(|(x, y)| picture.at(x as i64, y as i64)[3]);
            assert!(edge.fold(0.0, f64::max) <= 128.0, "{name}: cut off");
            assert!(all.clone().any(|at| is_drawn(&at)), "{name}: empty");
            for (other, (_, [left, top, wide, high])) in pictures.iter().filter(|(other, _)| *other != name) {
                let gap = GAP as usize;
                let apart = x + width + gap <= *left || left + wide + gap <= *x;
                assert!(apart || y + height + gap <= *top || top + high + gap <= *y, "{name} and {other}");
            }
        }
    }
}

/// As an engine shows a frame: every slot's picture, at its bone.
fn composed(skeleton: &Value, pictures: &BTreeMap<String, (Pixels, [usize; 4])>, frame: u64, view: &Framing) -> Pixels {
    let armature = &skeleton["armature"][0];
    let (bones, displays) = (bones(armature, Some(frame)), displays(armature));
    let size = [view.width, view.height].map(|side| side as usize);
    let mut canvas = Pixels { size, pixels: vec![[0.0; 4]; size[0] * size[1]] };
    for slot in list(&armature["slot"]) {
        let display = displays[text(&slot["name"])];
        if display["type"] != "image" {
            continue;
        }
        let (picture, _) = &pictures[text(&display["name"])];
        let [x, y] = ["x", "y"].map(|axis| number(&display["transform"][axis]));
        let [middle_x, middle_y, angle]: Place = within(bones[text(&slot["parent"])], [x, y, 0.0]);
        let (sin, cos) = libm::sincos(angle.to_radians());
        for (index, pixel) in canvas.pixels.iter_mut().enumerate() {
            let [x, y] = [index % size[0], index / size[0]].map(|place| place as f64 + 0.5);
            let (x, y) = (x - view.origin[0] - middle_x, y - view.origin[1] - middle_y);
            let place = [cos * x + sin * y, cos * y - sin * x];
            let over = picture.sample([0, 1].map(|axis| place[axis] + 0.5 * picture.size[axis] as f64));
            *pixel = [0, 1, 2, 3].map(|part| over[part] + pixel[part] * (1.0 - over[3] / 255.0));
        }
    }
    canvas
}

/// How far pictures differ, of 255, in the mean of what is drawn.
fn difference(one: &Pixels, two: &Pixels) -> f64 {
    let pairs = || one.pixels.iter().zip(&two.pixels).filter(|(one, two)| one[3] > 0.0 || two[3] > 0.0);
    let apart = |(one, two): (&[f64; 4], &[f64; 4])| {
        one.iter().zip(two).map(|(one, two)| (one - two).abs()).fold(0.0, f64::max)
    };
    pairs().map(apart).sum::<f64>() / pairs().count() as f64
}

fn framing(blueprint: &Blueprint, painter: &Painter, pose: &tasks::Snapshot, shift: f64) -> Framing {
    let scale = scale(blueprint);
    let [left, bottom, right, top] = painter.bounds(pose).map(f64::from);
    let [width, height] = [right - left, top - bottom].map(|side| (scale * side).ceil() as u32 + 20);
    Framing { width, height, scale, origin: [10.0 - scale * left + shift, 10.0 + scale * top] }
}

#[test]
fn pictures_on_bones_look_like_the_creature() {
    for (blueprint, cycle) in samples() {
        let (skeleton, atlas, sheet) = exported(&blueprint, &cycle);
        let (pictures, painter) = (pictures(&atlas, &sheet), Painter::new(&blueprint));
        for frame in [0, 7, 15] {
            let pose = cycle.at(frame as f64 / 22.0);
            let pose = Pose { x: pose.x - frame as f64 / 22.0 * cycle.travel, ..pose }.snapshot(&blueprint);
            let drawn = |shift: f64| {
                let framing = framing(&blueprint, &painter, &pose, shift);
                let bytes = painter.paint(&pose, &framing, None).expect("it can be drawn");
                (Pixels::of([framing.width as usize, framing.height as usize], &bytes), framing)
            };
            let (wanted, view) = drawn(0.0);
            let found = composed(&skeleton, &pictures, frame, &view);
            let (apart, shifted) = (difference(&wanted, &found), difference(&wanted, &drawn(2.0).0));
            // Sampled pictures are a little softer. A shift by two pixels would be seen.
            assert!(apart < 8.0 && apart < 0.5 * shifted, "{}, frame {frame}: {apart}, {shifted}", blueprint.name());
        }
    }
}
