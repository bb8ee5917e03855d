use super::{GAP, Loop, check_sheet, copy, png};
use crate::ExportError;
use serde_json::{Map, Value, json};

/// A loop as a sheet of frames, and the atlas that says where each is: as bytes of a PNG image and of JSON, in the layout that
/// texture packers have in common. `name`: of the creature and its movement; `image`: the name of the image's file.
pub(crate) fn sprites(drawn: &Loop, name: [&str; 2], image: &str) -> Result<(Vec<u8>, Vec<u8>), ExportError> {
    let (width, height, count) = (drawn.framing.width, drawn.framing.height, drawn.snapshots.len());
    let columns = (1..count).find(|columns| columns * columns >= count).unwrap_or(count) as u32;
    let rows = (count as u32).div_ceil(columns);
    let sheet = [columns * (width + GAP) + GAP, rows * (height + GAP) + GAP];
    check_sheet(sheet)?;
    let mut pixels = vec![0; 4 * sheet[0] as usize * sheet[1] as usize];
    let mut frames = Map::new();
    let duration = 1000.0 * drawn.cycle.seconds / count as f64;
    for index in 0..count {
        let (column, row) = (index as u32 % columns, index as u32 / columns);
        let [x, y] = [GAP + column * (width + GAP), GAP + row * (height + GAP)];
        copy(&drawn.paint(index)?, width, &mut pixels, sheet[0], [x, y]);
        let way = drawn.cycle.travel * index as f64 / count as f64;
        frames.insert(
            frame_name(name, index),
            json!({
                "frame": { "x": x, "y": y, "w": width, "h": height },
                "rotated": false,
                "trimmed": false,
                "spriteSourceSize": { "x": 0, "y": 0, "w": width, "h": height },
                "sourceSize": { "w": width, "h": height },
                "pivot": pivot(drawn),
                "duration": duration,
                "rootMotion": { "x": way, "y": 0.0 },
            }),
        );
    }
    let names: Vec<String> = (0..count).map(|index| frame_name(name, index)).collect();
    let atlas = json!({
        "frames": frames,
        "animations": { name[1]: names },
        "meta": {
            "app": "Gambol",
            "version": env!("CARGO_PKG_VERSION"),
            "image": image,
            "format": "RGBA8888",
            "size": { "w": sheet[0], "h": sheet[1] },
            "scale": "1",
            "loop": {
                "seconds": drawn.cycle.seconds,
                "travelMetres": drawn.cycle.travel,
                "pixelsPerMetre": drawn.framing.scale,
            },
        },
    });
    Ok((png(&pixels, sheet)?, format!("{atlas:#}\n").into_bytes()))
}

fn frame_name([creature, movement]: [&str; 2], index: usize) -> String {
    format!("{creature}-{movement}-{index:03}")
}

/// Where the world's origin is in a frame, as shares of its sides: on the ground, below the body.
fn pivot(drawn: &Loop) -> Value {
    let [x, y] = drawn.framing.origin;
    json!({ "x": x / f64::from(drawn.framing.width), "y": y / f64::from(drawn.framing.height) })
}
