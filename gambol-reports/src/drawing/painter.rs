//! A creature painted for other programs: any pose, with or without anything behind it.

use super::{
    DrawingError,
    canvas::{Canvas, GROUND, GROUND_LINE, SKY},
    creature::{Model, View},
};
use creatures::Blueprint;
use tasks::Snapshot;

/// Paints the poses of a creature.
pub struct Painter {
    model: Model,
}

/// What of the world an image shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Framing {
    /// px.
    pub width: u32,
    /// px.
    pub height: u32,
    /// Pixels a metre.
    pub scale: f64,
    /// Where the world's origin is on the image, px from the left and from the top.
    pub origin: [f64; 2],
}

/// Flat ground with marks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkedGround {
    /// The distance of two marks, m.
    pub spacing: f64,
    /// Where a mark is, m.
    pub mark: f64,
}

/// A mark on the ground, px.
const MARK: [f32; 2] = [2.0, 7.0];

impl Painter {
    /// A painter of a creature, by the looks in its file.
    pub fn new(blueprint: &Blueprint) -> Self {
        Self { model: Model::new(blueprint) }
    }

    /// The box around a pose with all that is painted, m: left, bottom, right, top.
    pub fn bounds(&self, pose: &Snapshot) -> [f32; 4] {
        self.model.bounds(pose)
    }

    /// The box around one part as it is painted, m, in its own frame: left, bottom, right, top. Parts are counted as in
    /// snapshots; of one that is not there the box is inside out.
    pub fn part_bounds(&self, part: usize) -> [f32; 4] {
        self.model.part_bounds(part)
    }

    /// One part in its own frame, before nothing, as [`paint`](Self::paint) gives a pose.
    ///
    /// # Errors
    /// If the image would be empty or too large.
    pub fn paint_part(&self, part: usize, framing: &Framing) -> Result<Vec<u8>, DrawingError> {
        let mut canvas = Canvas::transparent(framing.width, framing.height)?;
        self.model.draw_part(&mut canvas, &View { scale: framing.scale, origin: framing.origin }, part);
        Ok(canvas.into_rgba())
    }

    /// A pose as red, green, blue and opacity of each pixel, row by row; the colours are not multiplied with the opacity. Without
    /// ground nothing is behind the creature.
    ///
    /// # Errors
    /// If the image would be empty or too large.
    pub fn paint(
        &self,
        pose: &Snapshot,
        framing: &Framing,
        ground: Option<MarkedGround>,
    ) -> Result<Vec<u8>, DrawingError> {
        let Framing { width, height, scale, origin } = *framing;
        let view = View { scale, origin };
        let mut canvas = match ground {
            None => Canvas::transparent(width, height)?,
            Some(ground) => {
                let mut canvas = Canvas::new(width, height, SKY)?;
                draw_ground(&mut canvas, &view, ground);
                canvas
            }
        };
        self.model.draw(&mut canvas, &view, pose);
        Ok(canvas.into_rgba())
    }
}

fn draw_ground(canvas: &mut Canvas, view: &View, ground: MarkedGround) {
    let (width, height, top) = (canvas.width(), canvas.height(), view.origin[1] as f32);
    canvas.rectangle([0.0, top, width, (height - top).max(1.0)], GROUND);
    canvas.rectangle([0.0, top, width, 1.5], GROUND_LINE);
    let left = -view.origin[0] / view.scale;
    let mut x = ground.mark + ((left - ground.mark) / ground.spacing).floor() * ground.spacing;
    let right = left + f64::from(width) / view.scale + ground.spacing;
    while ground.spacing > 0.0 && x < right {
        let [at, _] = view.point([x as f32, 0.0]);
        canvas.rectangle([at - 0.5 * MARK[0], top, MARK[0], MARK[1]], GROUND_LINE);
        x += ground.spacing;
    }
}
