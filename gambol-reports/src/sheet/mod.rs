//! The contact sheet of a gait: one image from which an animator judges it in seconds.
//!
//! From top to bottom: whose gait it is, whether it is usable and why not; [twelve frames](FRAMES) over a stride or a
//! jump, with the parts that touch the ground outlined; footfalls, pitch and height of the torso over the episode, and
//! over its last seconds. The same recording gives the same bytes.

mod charts;
mod footfalls;
mod frames;
mod heading;
mod moments;
#[cfg(test)]
mod tests;

use crate::drawing::{
    DrawingError,
    canvas::{Canvas, PAPER},
    check_poses,
};
use charts::Charts;
use creatures::Blueprint;
use envs_core::Ground;
use frames::Frames;
use gambol_runs::{Registry, champion::Champion, judge::Judge};
use heading::Heading;
use moments::Moments;
use tasks::{Snapshot, gait::GaitReport};

/// The width of a sheet, pixels. Its height depends on what it shows.
pub const WIDTH: u32 = 1440;
/// How many frames a sheet has.
pub const FRAMES: usize = 12;

/// Left and right of everything, px.
const MARGIN: f32 = 24.0;
/// Between headings, frames and charts, px.
const GAP: f32 = 18.0;

/// What a sheet shows.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Whose gait it is, and how it looks.
    pub blueprint: &'a Blueprint,
    /// What it was to do; `None` if that is not known.
    pub movement: Option<&'a str>,
    /// What it moves on; without shapes: water.
    pub ground: &'a Ground,
    /// The recording: one snapshot a physics step, the settled start first.
    pub snapshots: &'a [Snapshot],
    /// What was measured of this recording.
    pub report: &'a GaitReport,
}

/// Draws the sheet, as the bytes of a PNG image [`WIDTH`] pixels wide.
///
/// # Errors
/// If there are fewer than 2 snapshots, one is not of this creature, or a place is not finite.
pub fn draw(subject: &Subject<'_>) -> Result<Vec<u8>, DrawingError> {
    check_poses(subject.blueprint, subject.snapshots)?;
    let moments = Moments::choose(subject);
    let heading = Heading::new(subject);
    let frames = Frames::new(subject, &moments);
    let charts = Charts::new(subject, &moments);
    let height = MARGIN + heading.height() + GAP + frames.height() + GAP + charts.height() + MARGIN;
    let mut sheet = Canvas::new(WIDTH, height as u32, PAPER)?;
    heading.draw(&mut sheet, MARGIN);
    let top = MARGIN + heading.height() + GAP;
    frames.draw(&mut sheet, top)?;
    charts.draw(&mut sheet, top + frames.height() + GAP);
    sheet.into_png()
}

/// Draws the sheet of a champion, replayed in rapier as it is judged. `report`: what was measured of it.
///
/// # Errors
/// If the champion's world cannot be built, or its episode breaks off at once.
pub fn of_champion(champion: &Champion, report: &GaitReport, registry: &Registry) -> Result<Vec<u8>, DrawingError> {
    let judge = Judge::new(champion.episode_parts(), registry)?;
    let snapshots = judge.record(&champion.network).snapshots;
    let environment = judge.environment();
    draw(&Subject {
        blueprint: environment.blueprint(),
        movement: Some(&champion.movement.name),
        ground: environment.ground(),
        snapshots: &snapshots,
        report,
    })
}

impl Subject<'_> {
    /// The index of the last snapshot.
    fn last(&self) -> usize {
        self.snapshots.len() - 1
    }

    /// When a step was over, s.
    fn time(&self, step: usize) -> f64 {
        step as f64 * self.report.time_step
    }

    /// The first step that is over at a time, s.
    fn step_at(&self, time: f64) -> usize {
        ((time / self.report.time_step).round() as usize).min(self.last())
    }

    /// How long it lasted, s.
    fn duration(&self) -> f64 {
        self.time(self.last())
    }

    fn in_water(&self) -> bool {
        *self.ground == Ground::none()
    }

    /// The height of the torso's centre at the start, m; positive.
    fn start_height(&self) -> f64 {
        let settled = f64::from(self.snapshots[0].torso().y);
        if settled > 0.0 { settled } else { f64::from(self.blueprint.start_height()) }
    }
}
