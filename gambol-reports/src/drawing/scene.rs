//! The world around a creature: the ground, and marks that stay where they are.

use super::{
    DrawingError,
    axis::ticks,
    canvas::{Canvas, GROUND, GROUND_LINE, QUIET, SKY, WATER, lines},
    corners::outlines,
    creature::View,
    text::{Anchor, Style},
};
use envs_core::Ground;
use tiny_skia::Transform;

/// A mark on the ground is numbered if there is so much room, px.
const ROOM_FOR_NUMBER: f64 = 90.0;

/// An image of the world without a creature, width and height in px: sky and ground, or water where there is no ground, and marks
/// along the bottom.
pub(crate) fn backdrop(size: [u32; 2], view: &View, ground: &Ground) -> Result<Canvas, DrawingError> {
    let [width, height] = size;
    let mut canvas = Canvas::new(width, height, if *ground == Ground::none() { WATER } else { SKY })?;
    draw_ground(&mut canvas, view, ground);
    draw_marks(&mut canvas, view);
    Ok(canvas)
}

/// All shapes as one: outlines first, so that what lies inside another shape is covered.
fn draw_ground(canvas: &mut Canvas, view: &View, ground: &Ground) {
    let (right, below) = (canvas.width() + 10.0, canvas.height() + 10.0);
    let on_screen = |outline: Result<Vec<[f32; 2]>, f32>| match outline {
        Ok(corners) => corners.into_iter().map(|corner| view.point(corner)).collect(),
        Err(height) => {
            let top = view.point([0.0, height])[1];
            vec![[-10.0, top], [right, top], [right, below.max(top)], [-10.0, below.max(top)]]
        }
    };
    let shapes = outlines(ground).map(on_screen);
    let is_seen = |points: &Vec<[f32; 2]>| {
        let beyond = |outside: &dyn Fn(&[f32; 2]) -> bool| points.iter().all(outside);
        !(beyond(&|point| point[0] < -5.0) || beyond(&|point| point[0] > right) || beyond(&|point| point[1] > below))
    };
    let paths: Vec<_> = shapes.filter(is_seen).filter_map(|points| lines(&points, true)).collect();
    for path in &paths {
        canvas.outline(path, Transform::identity(), 3.0, GROUND_LINE, 1.0);
    }
    for path in &paths {
        canvas.fill(path, Transform::identity(), GROUND, 1.0);
    }
}

/// Marks along the bottom that stay where they are in the world, some with their x.
fn draw_marks(canvas: &mut Canvas, view: &View) {
    let (width, height) = (f64::from(canvas.width()), canvas.height());
    let [from, to] = [-view.origin[0] / view.scale, (width - view.origin[0]) / view.scale];
    let numbered = ticks([from, to], width / ROOM_FOR_NUMBER);
    let x = |place: f64| (view.origin[0] + view.scale * place) as f32;
    for &place in &numbered.places {
        canvas.rectangle([x(place) - 0.75, height - 26.0, 1.5, 6.0], GROUND_LINE);
        let text = format!("{} m", numbered.label(place));
        let half = 0.5 * Style::Label.width(&text) + 2.0;
        if (half..canvas.width() - half).contains(&x(place)) {
            canvas.text(&text, Style::Label, [x(place), height - 21.0], Anchor::Middle, QUIET);
        }
    }
}
