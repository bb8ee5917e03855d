//! The frames: the creature, moment by moment, all to the same scale.

use super::{FRAMES, MARGIN, Subject, WIDTH, moments::Moments};
use crate::drawing::{
    DrawingError,
    canvas::{CONTACT, CURVE, Canvas, INK, QUIET},
    creature::{Model, View},
    scene,
    text::{Anchor, Style},
};
use tasks::Snapshot;

const COLUMNS: usize = 6;
/// Between two frames, px.
const GUTTER: f32 = 8.0;
/// The least and the greatest height of a frame, px.
const HEIGHTS: [f32; 2] = [150.0, 320.0];
/// Above the creature, for the time, px.
const HEAD: f32 = 30.0;
/// Below the lowest point shown, for marks on the ground, px.
const FOOT: f32 = 30.0;
/// Left and right of the creature, px.
const SIDE: f32 = 10.0;
/// The line of text above the frames, px.
const CAPTION: f32 = 28.0;

/// The frames of a sheet, measured and ready to be drawn.
pub(super) struct Frames<'a> {
    subject: &'a Subject<'a>,
    moments: &'a Moments,
    model: Model,
    /// Width and height of a frame, px.
    size: [f32; 2],
    /// Pixels a metre.
    scale: f64,
    /// The lowest height shown, m.
    bottom: f64,
}

impl<'a> Frames<'a> {
    pub(super) fn new(subject: &'a Subject<'a>, moments: &'a Moments) -> Self {
        let model = Model::new(subject.blueprint);
        let width = ((WIDTH as f32 - 2.0 * MARGIN - (COLUMNS - 1) as f32 * GUTTER) / COLUMNS as f32).floor();
        // Half the width of the widest pose, and from the lowest to the highest point of all, m.
        let (mut half, mut low, mut high) = (0.0_f64, f64::INFINITY, f64::NEG_INFINITY);
        for &step in &moments.steps {
            let pose = &subject.snapshots[step];
            let [left, bottom, right, top] = model.bounds(pose).map(f64::from);
            let middle = model.middle(pose);
            half = half.max(middle - left).max(right - middle);
            (low, high) = (low.min(bottom), high.max(top));
        }
        if !subject.in_water() {
            low = low.min(0.0);
        }
        // Neither may be nothing, whatever the recording holds.
        let (half, tall) = (half.max(1e-3), (high - low).max(1e-3));
        let by_width = f64::from(0.5 * width - SIDE) / half;
        let [least, greatest] = HEIGHTS;
        let height = ((by_width * tall) as f32 + HEAD + FOOT).clamp(least, greatest).ceil();
        let scale = by_width.min(f64::from(height - HEAD - FOOT) / tall);
        Self { subject, moments, model, size: [width, height], scale, bottom: low }
    }

    /// px.
    pub(super) fn height(&self) -> f32 {
        let rows = FRAMES.div_ceil(COLUMNS) as f32;
        CAPTION + rows * self.size[1] + (rows - 1.0) * GUTTER
    }

    pub(super) fn draw(&self, sheet: &mut Canvas, top: f32) -> Result<(), DrawingError> {
        self.draw_caption(sheet, top);
        let [width, height] = self.size;
        for (frame, &step) in self.moments.steps.iter().enumerate() {
            let (row, column) = ((frame / COLUMNS) as f32, (frame % COLUMNS) as f32);
            let (x, y) = (MARGIN + column * (width + GUTTER), top + CAPTION + row * (height + GUTTER));
            sheet.place(&self.frame(frame, step)?, x, y.floor());
        }
        Ok(())
    }

    fn draw_caption(&self, sheet: &mut Canvas, top: f32) {
        let count = self.moments.steps.len() - usize::from(self.moments.lies_at_end);
        let mut caption = format!("{count} frames over {}", self.moments.caption);
        if self.moments.lies_at_end {
            caption.push_str(", and the end of the episode");
        }
        let key = "touches the ground";
        let right = WIDTH as f32 - MARGIN;
        let key_left = right - Style::Label.width(key);
        let room = if self.subject.in_water() { right - MARGIN } else { key_left - 40.0 - MARGIN };
        sheet.text(&Style::Label.cut(&caption, room), Style::Label, [MARGIN, top], Anchor::Left, INK);
        if !self.subject.in_water() {
            sheet.line(&[[key_left - 24.0, top + 11.0], [key_left - 8.0, top + 11.0]], 4.0, CONTACT);
            sheet.text(key, Style::Label, [right, top], Anchor::Right, QUIET);
        }
    }

    /// One frame, as an image of its own.
    pub(super) fn frame(&self, frame: usize, step: usize) -> Result<Canvas, DrawingError> {
        let pose = &self.subject.snapshots[step];
        let [width, height] = self.size;
        let left = 0.5 * f64::from(width) - self.scale * self.model.middle(pose);
        let view = View { scale: self.scale, origin: [left, f64::from(height - FOOT) + self.scale * self.bottom] };
        let mut canvas = scene::backdrop([width as u32, height as u32], &view, self.subject.ground)?;
        self.model.draw(&mut canvas, &view, pose);
        self.model.draw_contacts(&mut canvas, &view, pose);
        self.draw_labels(&mut canvas, frame, step, pose);
        Ok(canvas)
    }

    fn draw_labels(&self, canvas: &mut Canvas, frame: usize, step: usize, pose: &Snapshot) {
        let time = format!("{:.2} s", self.subject.time(step));
        canvas.text(&time, Style::Label, [8.0, 5.0], Anchor::Left, INK);
        let is_end = self.moments.lies_at_end && frame + 1 == self.moments.steps.len();
        let note = match (is_end, pose.aloft() && !self.subject.in_water()) {
            (true, _) => Some(("the end", INK)),
            (false, true) => Some(("in the air", CURVE)),
            (false, false) => None,
        };
        if let Some((note, ink)) = note {
            canvas.text(note, Style::Label, [canvas.width() - 8.0, 5.0], Anchor::Right, ink);
        }
    }
}
