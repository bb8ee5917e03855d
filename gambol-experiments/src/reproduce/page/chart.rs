//! The best fitness against the generation, as SVG.

use super::super::{CellOutcome, RunResult};
use ne_statistics::quantile;
use std::fmt::Write;

const WIDTH: f64 = 720.0;
const HEIGHT: f64 = 260.0;
/// Room for numbers at the left, and for those below.
const LEFT: f64 = 56.0;
const BELOW: f64 = 34.0;
const ABOVE: f64 = 8.0;
const RIGHT: f64 = 8.0;
/// A single run is drawn with at most so many points.
const POINTS: usize = 150;

/// The runs of each preset: thin ones alone, their median with its quartiles, and the median of the mean fitness, dashed.
/// `colours` are the classes that give presets their colours. Empty without a number to draw.
pub(super) fn draw(cells: &[&CellOutcome], colours: &[String], label: &str) -> String {
    let values = cells.iter().flat_map(|cell| &cell.runs).flat_map(|run| run.best.iter().flatten());
    let (mut lowest, mut highest) = (0.0f64, f64::NEG_INFINITY);
    let mut longest = 0;
    for &value in values {
        (lowest, highest) = (lowest.min(value), highest.max(value));
    }
    for run in cells.iter().flat_map(|cell| &cell.runs) {
        longest = longest.max(run.best.len());
    }
    if !(highest - lowest).is_finite() {
        return String::new();
    }
    let step = round_step((highest - lowest).max(1e-3) / 5.0);
    let (bottom, top) = ((lowest / step).floor() * step, (highest / step).ceil().max(1.0) * step);
    let scale = Scale { generations: longest, bottom, top };
    let mut svg = format!(
        "<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" aria-label=\"{label}\">{}{}",
        scale.grid(step),
        scale.generation_axis()
    );
    // A drawing in the drawing cuts off what leaves it.
    let (width, height) = (scale.width(), scale.height());
    let _ = write!(
        svg,
        "<svg x=\"{LEFT}\" y=\"{ABOVE}\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">"
    );
    for (cell, colour) in cells.iter().zip(colours) {
        let _ = write!(svg, "<g class=\"{colour}\">");
        for run in &cell.runs {
            let _ = write!(svg, "<path class=\"single\" d=\"{}\"/>", scale.line(&thinned(&run.best)));
        }
        let quartile = |share| across(&cell.runs, longest, |run| &run.best, share);
        let [low, middle, high] = [0.25, 0.5, 0.75].map(quartile);
        let mean = across(&cell.runs, longest, |run| &run.mean, 0.5);
        let _ = write!(
            svg,
            "<path class=\"band\" d=\"{}\"/><path class=\"line average\" d=\"{}\"/><path class=\"line\" d=\"{}\"/></g>",
            scale.band(&low, &high),
            scale.line(&thinned(&mean)),
            scale.line(&thinned(&middle))
        );
    }
    svg + "</svg></svg>"
}

/// Where numbers are in the drawing.
struct Scale {
    generations: usize,
    bottom: f64,
    top: f64,
}

/// Place of a generation, from 0, and what it is worth.
type Point = (usize, f64);

impl Scale {
    fn width(&self) -> f64 {
        WIDTH - LEFT - RIGHT
    }

    fn height(&self) -> f64 {
        HEIGHT - ABOVE - BELOW
    }

    fn x(&self, place: usize) -> f64 {
        place as f64 / self.generations.saturating_sub(1).max(1) as f64 * self.width()
    }

    fn y(&self, value: f64) -> f64 {
        // Far outside is far enough, and stays a number a browser can read.
        let share = ((self.top - value) / (self.top - self.bottom)).clamp(-10.0, 10.0);
        share * self.height()
    }

    fn line(&self, points: &[Point]) -> String {
        let mut path = String::new();
        for (index, &(place, value)) in points.iter().enumerate() {
            let letter = if index == 0 { 'M' } else { 'L' };
            let _ = write!(path, "{letter}{:.1} {:.1}", self.x(place), self.y(value));
        }
        path
    }

    fn band(&self, low: &[Option<f64>], high: &[Option<f64>]) -> String {
        let (there, mut back) = (thinned(high), thinned(low));
        back.reverse();
        let path = self.line(&[there, back].concat());
        if path.is_empty() { path } else { path + "Z" }
    }

    /// Lines at round numbers, with the numbers.
    fn grid(&self, step: f64) -> String {
        let mut grid = String::new();
        let decimals = (-step.log10().floor()).max(0.0) as usize;
        let lines = ((self.top - self.bottom) / step).round() as u64;
        for line in 0..=lines {
            let value = self.bottom + line as f64 * step;
            let (y, right) = (ABOVE + self.y(value), WIDTH - RIGHT);
            // Not "-0".
            let value = if value.abs() < step / 2.0 { 0.0 } else { value };
            let _ = write!(
                grid,
                "<line class=\"grid\" x1=\"{LEFT}\" x2=\"{right}\" y1=\"{y:.1}\" y2=\"{y:.1}\"/>\
                 <text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"end\">{value:.decimals$}</text>",
                LEFT - 8.0,
                y + 4.0
            );
        }
        grid
    }

    /// The first, the middle and the last generation.
    fn generation_axis(&self) -> String {
        let mut axis = String::new();
        let last = self.generations.saturating_sub(1);
        let mut places = vec![0, last / 2, last];
        places.dedup();
        for place in places {
            let anchor = match place {
                0 => "start",
                place if place == last => "end",
                _ => "middle",
            };
            let words = if place == 0 { "generation " } else { "" };
            let _ = write!(
                axis,
                "<text x=\"{:.1}\" y=\"{:.1}\" text-anchor=\"{anchor}\">{words}{}</text>",
                LEFT + self.x(place),
                HEIGHT - 12.0,
                place + 1
            );
        }
        axis
    }
}

/// A quantile over the runs for each generation, of those that have a number.
fn across(
    runs: &[RunResult],
    generations: usize,
    curve: fn(&RunResult) -> &Vec<Option<f64>>,
    share: f64,
) -> Vec<Option<f64>> {
    let at = |place| {
        let values: Vec<f64> = runs.iter().filter_map(|run| *curve(run).get(place)?).collect();
        quantile(&values, share)
    };
    (0..generations).map(at).collect()
}

/// The numbers of a curve, of so few generations that the drawing stays small; the last one among them.
fn thinned(curve: &[Option<f64>]) -> Vec<Point> {
    let every = curve.len().div_ceil(POINTS).max(1);
    let chosen = |place: usize| place.is_multiple_of(every) || place + 1 == curve.len();
    let points = curve.iter().enumerate().filter(|(place, _)| chosen(*place));
    points.filter_map(|(place, value)| Some((place, (*value)?))).collect()
}

/// 1, 2 or 5 times a power of ten, at least `least`.
fn round_step(least: f64) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|times| times * power).find(|step| *step >= least).unwrap_or(10.0 * power)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round_and_curves_keep_their_end() {
        assert_eq!([0.9, 1.0, 1.1, 4.0, 7.0].map(round_step), [1.0, 1.0, 2.0, 5.0, 10.0]);
        let curve: Vec<Option<f64>> = (0..1001).map(|value| (value != 0).then_some(f64::from(value))).collect();
        let points = thinned(&curve);
        assert!(points.len() <= POINTS + 1);
        assert_eq!((points[0].0, points.last()), (7, Some(&(1000, 1000.0))));
        assert_eq!(thinned(&[]), []);
    }
}
