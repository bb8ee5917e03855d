//! One creature of a film, with a camera that follows it.

use super::Cut;
use crate::drawing::{
    DrawingError,
    canvas::{Canvas, INK},
    check_poses,
    creature::{Model, View},
    scene,
    text::{Anchor, Style},
};
use envs_core::Ground;
use gambol_runs::{Registry, champion::Champion, judge::Judge, trajectory::Recording};
use tasks::Snapshot;

/// Left and right of the creature, px.
const SIDE: f64 = 16.0;
/// Above the creature, for its name, px.
const HEAD: f64 = 32.0;
/// Left and right of the name, px.
const TITLE: f32 = 8.0;
/// Below the lowest point shown, for marks on the ground, px.
const FOOT: f64 = 30.0;
/// The camera follows the mean of what comes within so many frames on either side: it glides where a creature jerks.
const GLIDE: usize = 12;

/// One creature of a film.
pub(super) struct Panel {
    model: Model,
    title: String,
    ground: Ground,
    /// A pose for each frame.
    poses: Vec<Snapshot>,
    /// Where the camera looks in each frame, m.
    camera: Vec<f64>,
    /// px.
    size: [u32; 2],
    /// Pixels a metre.
    scale: f64,
    /// The lowest height shown, m.
    bottom: f64,
}

impl Panel {
    /// Plays a champion and chooses what of it is shown.
    pub(super) fn new(champion: &Champion, cut: &Cut, registry: &Registry) -> Result<Self, DrawingError> {
        let judge = Judge::new(champion.episode_parts(), registry)?;
        let end = cut.from + cut.seconds;
        let time_step = f64::from(champion.physics.time_step);
        let steps = (end / time_step).ceil() as u32;
        let (recording, _) = Recording::play(judge.environment(), &champion.network, steps);
        let snapshots = recording.snapshots;
        check_poses(judge.environment().blueprint(), &snapshots)?;
        let pose_at = |time: f64| snapshots.get((time / time_step).round() as usize).cloned();
        let poses = (0..cut.frames()).map(|frame| pose_at(cut.time(frame))).collect::<Option<Vec<_>>>();
        let lasts = (snapshots.len() - 1) as f64 * time_step;
        let too_late = || DrawingError::TooLate { creature: champion.creature.name.clone(), lasts, end };
        let title = match &champion.creature.title {
            title if title.is_empty() => champion.creature.name.clone(),
            title => title.clone(),
        };
        // The movement goes where there is room.
        let with_movement = format!("{title}, {}", champion.movement.name);
        let fits = Style::Label.width(&with_movement) <= room(cut.width);
        let title = if fits { with_movement } else { title };
        let model = Model::new(judge.environment().blueprint());
        Ok(Self::of_poses(model, title, judge.environment().ground().clone(), poses.ok_or_else(too_late)?, cut))
    }

    /// `poses`: one a frame.
    pub(super) fn of_poses(model: Model, title: String, ground: Ground, poses: Vec<Snapshot>, cut: &Cut) -> Self {
        let middles: Vec<f64> = poses.iter().map(|pose| model.middle(pose)).collect();
        let camera = glide(&middles);
        let (mut half, mut low, mut high) = (1e-3_f64, f64::INFINITY, f64::NEG_INFINITY);
        for (pose, middle) in poses.iter().zip(&camera) {
            let [left, bottom, right, top] = model.bounds(pose).map(f64::from);
            half = half.max(middle - left).max(right - middle);
            (low, high) = (low.min(bottom), high.max(top));
        }
        let by_width = (0.5 * f64::from(cut.width) - SIDE) / half;
        let by_height = (f64::from(cut.height) - HEAD - FOOT) / (high - low).max(1e-3);
        Self {
            model,
            title,
            ground,
            poses,
            camera,
            size: [cut.width, cut.height],
            scale: by_width.min(by_height),
            bottom: low,
        }
    }

    /// One frame, as an image of its own.
    pub(super) fn draw(&self, frame: u32) -> Result<Canvas, DrawingError> {
        let [width, height] = self.size;
        let index = (frame as usize).min(self.poses.len().saturating_sub(1));
        let left = 0.5 * f64::from(width) - self.scale * self.camera[index];
        let view = View { scale: self.scale, origin: [left, f64::from(height) - FOOT + self.scale * self.bottom] };
        let mut canvas = scene::backdrop(self.size, &view, &self.ground)?;
        self.model.draw(&mut canvas, &view, &self.poses[index]);
        let title = Style::Label.cut(&self.title, room(width));
        canvas.text(&title, Style::Label, [TITLE, 6.0], Anchor::Left, INK);
        Ok(canvas)
    }
}

/// The width of a title, px, in a panel of this width.
fn room(width: u32) -> f32 {
    width as f32 - 2.0 * TITLE
}

/// The path of the camera: where the body is, in the mean of its surroundings.
fn glide(middles: &[f64]) -> Vec<f64> {
    let last = middles.len().saturating_sub(1);
    let mean_around = |index: usize| {
        // The window is equally wide on both sides, so that the camera neither lags nor leads.
        let reach = GLIDE.min(index).min(last - index);
        let window = &middles[index - reach..=index + reach];
        window.iter().sum::<f64>() / window.len() as f64
    };
    (0..middles.len()).map(mean_around).collect()
}
