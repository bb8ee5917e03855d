//! An image to draw on.

use super::{DrawingError, palette};
use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, PixmapPaint, PremultipliedColorU8, Rect,
    Stroke, StrokeDash, Transform,
};

/// Red, green, blue.
pub(crate) type Ink = [u8; 3];

pub(crate) const PAPER: Ink = [0xfa, 0xf8, 0xf4];
pub(crate) const CARD: Ink = [0xff, 0xff, 0xff];
pub(crate) const INK: Ink = [0x23, 0x27, 0x2e];
pub(crate) const QUIET: Ink = [0x5d, 0x63, 0x6c];
pub(crate) const GRID: Ink = [0xe2, 0xdd, 0xd3];
pub(crate) const SKY: Ink = [0xee, 0xf3, 0xf5];
pub(crate) const WATER: Ink = [0xd3, 0xe4, 0xee];
pub(crate) const GROUND: Ink = [0xd8, 0xcf, 0xbb];
pub(crate) const GROUND_LINE: Ink = [0x8d, 0x82, 0x68];
/// What touches the ground.
pub(crate) const CONTACT: Ink = [0xff, 0x6a, 0x00];
/// What should not touch the ground, and limits.
pub(crate) const ALARM: Ink = [0xb0, 0x2a, 0x2a];
pub(crate) const GOOD: Ink = [0x2e, 0x7a, 0x45];
/// Curves, and what is in the air.
pub(crate) const CURVE: Ink = [0x2f, 0x6f, 0x9e];
/// The time of the frames, in charts.
pub(crate) const BAND: Ink = [0xff, 0xe6, 0xcf];

/// An image; opaque, but where it was begun without anything.
pub(crate) struct Canvas {
    pixmap: Pixmap,
}

impl Canvas {
    /// An empty image, width and height in pixels.
    pub(crate) fn new(width: u32, height: u32, background: Ink) -> Result<Self, DrawingError> {
        let too_large = || DrawingError::Image(format!("{width} × {height} pixels"));
        let mut pixmap = Pixmap::new(width, height).ok_or_else(too_large)?;
        pixmap.fill(colour(background));
        Ok(Self { pixmap })
    }

    /// An image with nothing on it.
    pub(crate) fn transparent(width: u32, height: u32) -> Result<Self, DrawingError> {
        let too_large = || DrawingError::Image(format!("{width} × {height} pixels"));
        Ok(Self { pixmap: Pixmap::new(width, height).ok_or_else(too_large)? })
    }

    /// Red, green, blue and opacity of each pixel, row by row.
    pub(crate) fn into_rgba(self) -> Vec<u8> {
        let pixels = self.pixmap.pixels().iter().map(|pixel| pixel.demultiply());
        pixels.flat_map(|pixel| [pixel.red(), pixel.green(), pixel.blue(), pixel.alpha()]).collect()
    }

    pub(crate) fn width(&self) -> f32 {
        self.pixmap.width() as f32
    }

    pub(crate) fn height(&self) -> f32 {
        self.pixmap.height() as f32
    }

    pub(crate) fn into_png(self) -> Result<Vec<u8>, DrawingError> {
        palette::encode(self.pixmap.width(), &self.pixels())
    }

    /// Row by row.
    pub(crate) fn pixels(&self) -> Vec<Ink> {
        self.pixmap.pixels().iter().map(|pixel| [pixel.red(), pixel.green(), pixel.blue()]).collect()
    }

    /// Puts another image on this one.
    pub(crate) fn place(&mut self, other: &Self, x: f32, y: f32) {
        let (x, y) = (x as i32, y as i32);
        self.pixmap.draw_pixmap(x, y, other.pixmap.as_ref(), &PixmapPaint::default(), Transform::identity(), None);
    }

    pub(crate) fn rectangle(&mut self, [x, y, width, height]: [f32; 4], ink: Ink) {
        if let Some(rectangle) = Rect::from_xywh(x, y, width, height) {
            self.pixmap.fill_rect(rectangle, &paint(ink, 1.0), Transform::identity(), None);
        }
    }

    pub(crate) fn line(&mut self, points: &[[f32; 2]], width: f32, ink: Ink) {
        self.stroke_line(points, &stroke(width), ink);
    }

    pub(crate) fn dashed_line(&mut self, points: &[[f32; 2]], width: f32, ink: Ink) {
        let stroke = Stroke { dash: StrokeDash::new(vec![6.0, 5.0], 0.0), line_cap: LineCap::Butt, ..stroke(width) };
        self.stroke_line(points, &stroke, ink);
    }

    fn stroke_line(&mut self, points: &[[f32; 2]], stroke: &Stroke, ink: Ink) {
        if let Some(path) = lines(points, false) {
            self.pixmap.stroke_path(&path, &paint(ink, 1.0), stroke, Transform::identity(), None);
        }
    }

    /// Fills by the non-zero rule. `opacity`: 0 to 1.
    pub(crate) fn fill(&mut self, path: &Path, transform: Transform, ink: Ink, opacity: f32) {
        self.pixmap.fill_path(path, &paint(ink, opacity), FillRule::Winding, transform, None);
    }

    /// Draws a line along a path, with round ends and corners; `width` in the path's own unit.
    pub(crate) fn outline(&mut self, path: &Path, transform: Transform, width: f32, ink: Ink, opacity: f32) {
        self.pixmap.stroke_path(path, &paint(ink, opacity), &stroke(width), transform, None);
    }

    /// Lays ink on a pixel, as much as `cover` says: 0 to 255.
    pub(crate) fn dab(&mut self, x: i32, y: i32, ink: Ink, cover: u8) {
        let (Ok(x), Ok(y)) = (u32::try_from(x), u32::try_from(y)) else { return };
        if x >= self.pixmap.width() || y >= self.pixmap.height() {
            return;
        }
        let index = (y * self.pixmap.width() + x) as usize;
        let pixel = &mut self.pixmap.pixels_mut()[index];
        let mixed = |new: u8, old: u8| {
            let (new, old, cover) = (u32::from(new), u32::from(old), u32::from(cover));
            ((new * cover + old * (255 - cover) + 127) / 255) as u8
        };
        let [red, green, blue] = ink;
        let mixed = PremultipliedColorU8::from_rgba(
            mixed(red, pixel.red()),
            mixed(green, pixel.green()),
            mixed(blue, pixel.blue()),
            u8::MAX,
        );
        *pixel = mixed.unwrap_or(*pixel);
    }

    /// The colour of a pixel.
    #[cfg(test)]
    pub(crate) fn pixel(&self, x: u32, y: u32) -> Option<Ink> {
        self.pixmap.pixel(x, y).map(|pixel| [pixel.red(), pixel.green(), pixel.blue()])
    }
}

/// A path along points; `None` if there is nothing to see.
pub(crate) fn lines(points: &[[f32; 2]], closed: bool) -> Option<Path> {
    let (first, rest) = points.split_first()?;
    let mut path = PathBuilder::new();
    path.move_to(first[0], first[1]);
    rest.iter().for_each(|point| path.line_to(point[0], point[1]));
    if closed {
        path.close();
    }
    path.finish()
}

fn colour([red, green, blue]: Ink) -> Color {
    Color::from_rgba8(red, green, blue, u8::MAX)
}

fn paint(ink: Ink, opacity: f32) -> Paint<'static> {
    let mut colour = colour(ink);
    colour.apply_opacity(opacity.clamp(0.0, 1.0));
    let mut paint = Paint::default();
    paint.set_color(colour);
    paint
}

fn stroke(width: f32) -> Stroke {
    Stroke { width, line_cap: LineCap::Round, line_join: LineJoin::Round, ..Stroke::default() }
}
