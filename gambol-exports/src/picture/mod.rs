//! A loop as pictures: the cycle of a gait, drawn in place.

mod apng;
mod gif;
mod sprites;
mod svg;

pub(crate) use apng::apng;
pub(crate) use gif::{GIF_RATE, gif};
pub(crate) use sprites::sprites;
pub(crate) use svg::svg;

use crate::{Cycle, ExportError};
use creatures::Blueprint;
use gambol_reports::drawing::{Framing, MarkedGround, Painter};
use tasks::Snapshot;

/// How a loop is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Picture {
    /// The longer side of a frame, px; 16 to 2048, default 256.
    pub size: u32,
    /// Frames a second, 1 to 60, of which a GIF shows at most 50; default 25. A loop has as many as fit best.
    pub rate: f64,
    /// Whether there is sky and ground behind the creature; default no, it stands before nothing.
    pub ground: bool,
}

impl Default for Picture {
    fn default() -> Self {
        Self { size: 256, rate: 25.0, ground: false }
    }
}

impl Picture {
    pub(crate) fn check(&self) -> Result<(), ExportError> {
        let within = |field, value: f64, [least, most]: [f64; 2]| match (least..=most).contains(&value) {
            true => Ok(()),
            false => Err(ExportError::Setting { field, value, least, most }),
        };
        within("size", self.size.into(), [16.0, 2048.0])?;
        within("rate", self.rate, [1.0, 60.0])
    }

    /// The same with at most so many frames a second, of which a cycle has a whole number.
    pub(crate) fn at_most(self, rate: f64, cycle: &Cycle) -> Self {
        Self { rate: self.rate.min((cycle.seconds * rate).floor() / cycle.seconds), ..self }
    }
}

/// Between the pictures of a sheet, px: filters of games look beyond the edge.
pub(crate) const GAP: u32 = 2;
/// The most pixels of a sheet.
const LARGEST: u64 = 1 << 28;
/// Around the creature, px.
const MARGIN: f64 = 4.0;
/// Marks on the ground are about so far apart, m.
const SPACING: f64 = 0.25;
/// Ground shown below the creature, as a share of the height of the picture.
const GROUND_SHARE: f64 = 0.08;

/// A loop, ready to be drawn.
pub(crate) struct Loop {
    pub(crate) cycle: Cycle,
    /// A pose for each frame, in place.
    pub(crate) snapshots: Vec<Snapshot>,
    pub(crate) framing: Framing,
    painter: Painter,
    /// The distance of two marks on the ground, m, if there is any.
    spacing: Option<f64>,
}

impl Loop {
    /// Frames the cycle of a creature's gait.
    pub(crate) fn new(blueprint: &Blueprint, cycle: Cycle, picture: &Picture) -> Result<Self, ExportError> {
        picture.check()?;
        let poses = cycle.resampled(cycle.frames(picture.rate), true).into_iter();
        let snapshots: Vec<Snapshot> = poses.map(|pose| pose.snapshot(blueprint)).collect();
        let painter = Painter::new(blueprint);
        let around = |[left, bottom, right, top]: [f64; 4], pose: &Snapshot| {
            let [l, b, r, t] = painter.bounds(pose).map(f64::from);
            [left.min(l), bottom.min(b), right.max(r), top.max(t)]
        };
        let nothing = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        let [left, mut bottom, right, top] = snapshots.iter().fold(nothing, around);
        if picture.ground {
            bottom = bottom.min(0.0) - GROUND_SHARE * (top - bottom);
        }
        let (wide, high) = (right - left, top - bottom);
        let scale = (f64::from(picture.size) - 2.0 * MARGIN) / wide.max(high);
        let pixels = |metres: f64| (metres * scale + 2.0 * MARGIN).ceil().clamp(1.0, f64::from(picture.size));
        let (width, height) = (pixels(wide), pixels(high));
        let origin = [0.5 * width - 0.5 * (left + right) * scale, height - MARGIN + bottom * scale];
        // As many marks as let the last frame lead to the first.
        let marks = (cycle.travel.abs() / SPACING).round().max(1.0);
        let spacing = picture.ground.then(|| (cycle.travel.abs() / marks).max(1e-3));
        let framing = Framing { width: width as u32, height: height as u32, scale, origin };
        Ok(Self { cycle, snapshots, framing, painter, spacing })
    }

    /// A frame, as red, green, blue and opacity of each pixel, row by row.
    pub(crate) fn paint(&self, frame: usize) -> Result<Vec<u8>, ExportError> {
        let share = frame as f64 / self.snapshots.len() as f64;
        let ground = self.spacing.map(|spacing| MarkedGround { spacing, mark: -share * self.cycle.travel });
        Ok(self.painter.paint(&self.snapshots[frame], &self.framing, ground)?)
    }
}

/// A PNG image of red, green, blue and opacity of each pixel.
pub(crate) fn png(pixels: &[u8], [width, height]: [u32; 2]) -> Result<Vec<u8>, ExportError> {
    let error = |error: png::EncodingError| ExportError::Image(error.to_string());
    let mut bytes = Vec::new();
    let mut writer = apng::encoder(&mut bytes, width, height).write_header().map_err(error)?;
    writer.write_image_data(pixels).map_err(error)?;
    writer.finish().map_err(error)?;
    Ok(bytes)
}

/// An image that grows too large to be one is refused before it takes memory.
pub(crate) fn check_sheet([width, height]: [u32; 2]) -> Result<(), ExportError> {
    match u64::from(width) * u64::from(height) > LARGEST {
        true => Err(ExportError::Image(format!("a sheet of {width} × {height} pixels"))),
        false => Ok(()),
    }
}

/// Copies an image to a place on a larger one, both as lists of pixels.
pub(crate) fn copy(from: &[u8], width: u32, to: &mut [u8], to_width: u32, [x, y]: [u32; 2]) {
    for (line, pixels) in from.chunks_exact(4 * width as usize).enumerate() {
        let start = 4 * ((y as usize + line) * to_width as usize + x as usize);
        to[start..start + pixels.len()].copy_from_slice(pixels);
    }
}

#[cfg(test)]
mod tests;
