//! A creature painted for other programs: any pose, with or without anything behind it.

use super::{
    DrawingError,
    canvas::{Canvas, GROUND, GROUND_LINE, SKY},
    creature::{Model, View},
    scene,
};
use creatures::Blueprint;
use envs_core::Ground;
use tasks::Snapshot;

/// Paints the poses of a creature.
pub struct Painter {
    model: Model,
    /// The longer side of its bounding box in the start pose, m.
    body_length: f64,
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

/// How much of the world a camera that follows a creature shows, width and height in body lengths.
const SURROUNDINGS: [f64; 2] = [4.0, 2.2];
/// Ground shown below y = 0, as a share of the height of the image.
const BELOW: f64 = 0.2;
/// Kept free above and below the creature, as a share of the height of the image: what comes next is below, where it goes down.
const FREE: [f64; 2] = [0.08, 0.16];
/// A mark on the ground, px.
const MARK: [f32; 2] = [2.0, 7.0];

impl Painter {
    /// A painter of a creature, by the looks in its file.
    pub fn new(blueprint: &Blueprint) -> Self {
        Self { model: Model::new(blueprint), body_length: f64::from(blueprint.body_length()) }
    }

    /// What a camera shows that follows the creature, width and height in px. It keeps its height as long as it sees the
    /// whole creature, so that a jump on level ground looks like one. It remembers nothing: equal poses are framed alike.
    pub fn follow(&self, pose: &Snapshot, [width, height]: [u32; 2]) -> Framing {
        let (wide, high) = (f64::from(width), f64::from(height));
        let scale = (wide / SURROUNDINGS[0]).min(high / SURROUNDINGS[1]) / self.body_length;
        let [_, bottom, _, top] = self.model.bounds(pose).map(f64::from);
        // px from the top, if the camera kept its height.
        let level = (1.0 - BELOW) * high;
        let (highest, lowest) = (level - scale * top, level - scale * bottom);
        let raised = (FREE[0] * high - highest).max(0.0);
        let lowered = (lowest - (1.0 - FREE[1]) * high).max(0.0);
        let origin = [0.5 * wide - scale * self.model.middle(pose), level + raised - lowered];
        Framing { width, height, scale, origin }
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
                draw_marked_ground(&mut canvas, &view, ground);
                canvas
            }
        };
        self.model.draw(&mut canvas, &view, pose);
        Ok(canvas.into_rgba())
    }

    /// A pose in its world, as red, green and blue of each pixel, row by row: with its ground, or in water where there is none, and
    /// with marks that stay where they are.
    ///
    /// # Errors
    /// If the image would be empty or too large.
    pub fn paint_in_world(&self, pose: &Snapshot, framing: &Framing, ground: &Ground) -> Result<Vec<u8>, DrawingError> {
        let Framing { width, height, scale, origin } = *framing;
        let view = View { scale, origin };
        let mut canvas = scene::backdrop([width, height], &view, ground)?;
        self.model.draw(&mut canvas, &view, pose);
        Ok(canvas.pixels().into_flattened())
    }
}

fn draw_marked_ground(canvas: &mut Canvas, view: &View, ground: MarkedGround) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::canvas::{GROUND, WATER};
    use tasks::PartState;

    const SIZE: [u32; 2] = [300, 200];

    /// A biped as its file draws it, so far from there.
    fn biped(x: f32, y: f32) -> (Painter, Snapshot) {
        let blueprint = Blueprint::new(creatures::find("biped-1").expect("shipped")).expect("valid");
        let part = |part: &creatures::Part| PartState {
            x: part.position[0] + x,
            y: part.position[1] + y,
            cos: 1.0,
            ..PartState::default()
        };
        let pose = Snapshot { parts: blueprint.creature().parts.iter().map(part).collect(), ..Snapshot::default() };
        (Painter::new(&blueprint), pose)
    }

    #[test]
    fn the_camera_follows_along_and_keeps_its_height_while_it_sees_all() {
        let frame = |dx, dy| {
            let (painter, pose) = biped(dx, dy);
            let framing = painter.follow(&pose, SIZE);
            let [_, bottom, _, top] = painter.bounds(&pose).map(f64::from);
            let [low, high] = [bottom, top].map(|y| framing.origin[1] - framing.scale * y);
            assert!(high >= 0.0 && low <= f64::from(SIZE[1]), "{dx} {dy}: {high} to {low}");
            framing
        };
        let start = frame(0.0, 0.0);
        let [along, up, away, down] = [frame(3.0, 0.0), frame(0.0, 0.1), frame(0.0, 5.0), frame(0.0, -5.0)];
        assert!((start.origin[0] - along.origin[0] - 3.0 * start.scale).abs() < 1e-3);
        assert_eq!((start.origin[1], start), (along.origin[1], up));
        assert!(away.origin[1] > start.origin[1] && down.origin[1] < start.origin[1]);
        assert_eq!((start.scale, start.scale), (away.scale, down.scale));
    }

    #[test]
    fn the_world_is_behind_the_creature() {
        let (painter, pose) = biped(0.0, 0.0);
        let framing = painter.follow(&pose, SIZE);
        let corner = |ground: &Ground| {
            let pixels = painter.paint_in_world(&pose, &framing, ground).expect("it can be painted");
            assert_eq!(pixels.len(), 3 * 300 * 200);
            [pixels[pixels.len() - 3], pixels[pixels.len() - 2], pixels[pixels.len() - 1]]
        };
        assert_eq!(corner(&Ground::flat()), GROUND);
        assert_eq!(corner(&Ground::none()), WATER);
    }
}
