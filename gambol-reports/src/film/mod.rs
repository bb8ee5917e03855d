//! A film of gaits, as one animated image: what a page, a chat or a README shows of what was learned.
//!
//! The creatures stand in a grid, each in a panel with a camera that follows it. Every panel shows the same seconds of its
//! own episode, played in rapier in the world without variation. The same champions give the same bytes. The format is
//! PNG with frames (APNG), which browsers and chats play; other programs show its first frame.

mod panel;
#[cfg(test)]
mod tests;

use crate::drawing::{
    DrawingError,
    canvas::{Canvas, PAPER},
    palette::Palette,
};
use gambol_runs::{Registry, champion::Champion};
use panel::Panel;

/// Frames a second.
const RATE: u16 = 25;
/// Around panels, px.
const GUTTER: u32 = 6;
/// How many frames the palette is made from, spread over the film.
const SAMPLES: usize = 8;

/// How a film is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cut {
    /// The first moment shown, s of the episode; 0 to 3600.
    pub from: f64,
    /// How long it is, s; 0.04 (one frame) to 60.
    pub seconds: f64,
    /// Panels side by side; 1 to 16.
    pub columns: u32,
    /// The width of a panel, px; 80 to 1920.
    pub width: u32,
    /// The height of a panel, px; 80 to 1920.
    pub height: u32,
}

impl Default for Cut {
    fn default() -> Self {
        Self { from: 3.0, seconds: 4.0, columns: 2, width: 360, height: 220 }
    }
}

impl Cut {
    /// How many frames the film has.
    pub fn frames(&self) -> u32 {
        (self.seconds * f64::from(RATE)).round() as u32
    }

    /// When a frame is, s of the episode.
    fn time(&self, frame: u32) -> f64 {
        self.from + f64::from(frame) / f64::from(RATE)
    }

    fn check(&self) -> Result<(), DrawingError> {
        let within = |field, value: f64, [least, most]: [f64; 2]| match (least..=most).contains(&value) {
            true => Ok(()),
            false => Err(DrawingError::Setting { field, value, least, most }),
        };
        within("from", self.from, [0.0, 3600.0])?;
        within("seconds", self.seconds, [1.0 / f64::from(RATE), 60.0])?;
        within("columns", self.columns.into(), [1.0, 16.0])?;
        within("width", self.width.into(), [80.0, 1920.0])?;
        within("height", self.height.into(), [80.0, 1920.0])
    }
}

/// Films champions side by side, as the bytes of an animated PNG image that repeats for ever.
///
/// # Errors
/// If a setting is out of its range, there is no champion or there are more than 64, the world of one cannot be built, or
/// its episode ends before the film.
pub fn of_champions(champions: &[Champion], cut: &Cut, registry: &Registry) -> Result<Vec<u8>, DrawingError> {
    cut.check()?;
    let [least, most] = [1.0, 64.0];
    if !(1..=64).contains(&champions.len()) {
        return Err(DrawingError::Setting { field: "champions", value: champions.len() as f64, least, most });
    }
    let panels = champions.iter().map(|champion| Panel::new(champion, cut, registry)).collect::<Result<Vec<_>, _>>()?;
    shoot(&panels, cut)
}

fn shoot(panels: &[Panel], cut: &Cut) -> Result<Vec<u8>, DrawingError> {
    let count = cut.frames();
    let sample = |index: usize| frame(panels, cut, count * index as u32 / SAMPLES as u32).map(|frame| frame.pixels());
    let samples = (0..SAMPLES).map(sample).collect::<Result<Vec<_>, _>>()?;
    let mut palette = Palette::of(samples.iter().map(Vec::as_slice));
    let image = |error: png::EncodingError| DrawingError::Image(error.to_string());
    let mut bytes = Vec::new();
    let mut encoder = palette.encoder(&mut bytes, size(panels.len(), cut));
    encoder.set_animated(count, 0).map_err(image)?;
    encoder.set_frame_delay(1, RATE).map_err(image)?;
    let mut writer = encoder.write_header().map_err(image)?;
    for index in 0..count {
        let pixels = frame(panels, cut, index)?.pixels();
        writer.write_image_data(&palette.indices(&pixels)).map_err(image)?;
    }
    writer.finish().map_err(image)?;
    Ok(bytes)
}

/// Width and height of the film, px.
fn size(panels: usize, cut: &Cut) -> [u32; 2] {
    let panels = panels as u32;
    let columns = cut.columns.min(panels);
    [columns * (cut.width + GUTTER) + GUTTER, panels.div_ceil(columns) * (cut.height + GUTTER) + GUTTER]
}

fn frame(panels: &[Panel], cut: &Cut, index: u32) -> Result<Canvas, DrawingError> {
    let [width, height] = size(panels.len(), cut);
    let mut canvas = Canvas::new(width, height, PAPER)?;
    for (place, panel) in (0..).zip(panels) {
        let (column, row) = (place % cut.columns, place / cut.columns);
        let corner = |place: u32, size: u32| (GUTTER + place * (size + GUTTER)) as f32;
        canvas.place(&panel.draw(index)?, corner(column, cut.width), corner(row, cut.height));
    }
    Ok(canvas)
}
