//! The pictures of parts, on one sheet, and the file that says where each is: a texture atlas of DragonBones 5.5.

use crate::{
    ExportError,
    picture::{GAP, check_sheet, copy, png},
};
use creatures::Blueprint;
use gambol_reports::drawing::{Framing, Painter};
use serde_json::{Value, json};

/// Around a part, px: its edges are soft.
const MARGIN: f64 = 1.0;

/// The pictures of all parts.
pub(super) struct Atlas {
    /// In the order of the parts.
    pub(super) pictures: Vec<Picture>,
    size: [u32; 2],
}

/// A part as it is drawn, before nothing.
pub(super) struct Picture {
    name: String,
    size: [u32; 2],
    /// Where it is on the sheet, px from the left and from the top.
    place: [u32; 2],
    /// Where its middle is in the part's frame, m.
    pub(super) middle: [f64; 2],
}

impl Atlas {
    /// `scale`: pixels a metre.
    pub(super) fn new(blueprint: &Blueprint, painter: &Painter, scale: f64) -> Result<Self, ExportError> {
        let picture = |(part, body): (usize, &creatures::BodyPart)| {
            let [left, bottom, right, top] = painter.part_bounds(part).map(f64::from);
            let side = |metres: f64| (metres * scale + 2.0 * MARGIN).ceil() as u32;
            Picture {
                name: body.name.clone(),
                size: [side(right - left), side(top - bottom)],
                place: [0, 0],
                middle: [0.5 * (left + right), 0.5 * (bottom + top)],
            }
        };
        let mut pictures: Vec<Picture> = blueprint.parts().iter().enumerate().map(picture).collect();
        // One is refused before all of them are added up.
        pictures.iter().try_for_each(|picture| check_sheet(picture.size))?;
        let size = pack(&mut pictures);
        check_sheet(size)?;
        Ok(Self { pictures, size })
    }

    /// The sheet as a PNG image.
    pub(super) fn image(&self, painter: &Painter, scale: f64) -> Result<Vec<u8>, ExportError> {
        let mut pixels = vec![0; 4 * self.size[0] as usize * self.size[1] as usize];
        for (part, &Picture { size: [width, height], place, middle: [x, y], .. }) in self.pictures.iter().enumerate() {
            let origin = [0.5 * f64::from(width) - scale * x, 0.5 * f64::from(height) + scale * y];
            let drawn = painter.paint_part(part, &Framing { width, height, scale, origin })?;
            copy(&drawn, width, &mut pixels, self.size[0], place);
        }
        png(&pixels, self.size)
    }

    /// `name`: that of the skeleton; `image`: the name of the sheet's file.
    pub(super) fn description(&self, name: &str, image: &str) -> Value {
        let texture = |Picture { name, size: [width, height], place: [x, y], .. }: &Picture| json!({ "name": name, "x": x, "y": y, "width": width, "height": height });
        json!({
            "name": name,
            "imagePath": image,
            "width": self.size[0],
            "height": self.size[1],
            "SubTexture": self.pictures.iter().map(texture).collect::<Vec<_>>(),
        })
    }
}

/// Places pictures in rows, the highest first, on a sheet that is about square; its size, px.
fn pack(pictures: &mut [Picture]) -> [u32; 2] {
    let widths = pictures.iter().map(|picture| picture.size[0]);
    let area: f64 =
        pictures.iter().map(|picture| picture.size.map(|side| f64::from(side + GAP)).iter().product::<f64>()).sum();
    let width = widths.max().unwrap_or(0).max(area.sqrt().ceil() as u32) + 2 * GAP;
    let mut order: Vec<&mut Picture> = pictures.iter_mut().collect();
    order.sort_by_key(|picture| std::cmp::Reverse(picture.size[1]));
    let ([mut x, mut y], mut bottom) = ([GAP, GAP], GAP);
    for picture in order {
        if x + picture.size[0] + GAP > width {
            [x, y] = [GAP, bottom];
        }
        picture.place = [x, y];
        x += picture.size[0] + GAP;
        bottom = bottom.max(y.saturating_add(picture.size[1]).saturating_add(GAP));
    }
    [width, bottom]
}
