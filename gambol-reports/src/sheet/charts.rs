//! The charts: footfalls, pitch and height of the torso, and its speed where it is told one, over the episode and over its last seconds.

use super::{
    MARGIN, Subject, WIDTH,
    footfalls::{self, Row},
    moments::{CLOSE_UP, Moments},
};
use crate::drawing::{
    axis::{multiples, ticks},
    canvas::{ALARM, BAND, CARD, CONTACT, CURVE, Canvas, GRID, INK, QUIET},
    text::{Anchor, Style},
};

use tasks::Command;

/// Left of the charts, for names and numbers, px.
const LABELS: f32 = 176.0;
/// Between the two panels, px.
const BETWEEN: f32 = 60.0;
/// A line of text, px.
const LINE: f32 = 30.0;
/// A row of the footfall diagram, px.
const ROW: f32 = 22.0;
/// The height of a plot, px.
const PLOT: f32 = 120.0;
/// Between two charts, px.
const GAP: f32 = 10.0;
/// Below a chart, for the numbers of the time axis, px.
const TIMES: f32 = 28.0;
/// Between two numbers of the time axis, px.
const TIME_SPACING: f32 = 75.0;
/// A pitch to look at, degrees: beyond it an animator would not call a torso upright.
const PITCH: f64 = 45.0;

/// A stretch of time, beside others.
struct Panel {
    name: String,
    /// Its left side and its width, px.
    left: f32,
    width: f32,
    /// From when to when it shows the episode, s.
    time: [f64; 2],
}

/// A curve over time.
struct Plot {
    title: String,
    /// One for each snapshot.
    values: Vec<f64>,
    /// What they should be, behind them; empty where they need not be anything.
    wanted: Vec<f64>,
    /// From the bottom to the top.
    range: [f64; 2],
    /// What is marked on its axis.
    marks: Vec<(f64, String)>,
    /// Dashed lines.
    limits: Vec<f64>,
}

/// The charts of a sheet, ready to be drawn.
pub(super) struct Charts<'a> {
    subject: &'a Subject<'a>,
    moments: &'a Moments,
    panels: Vec<Panel>,
    rows: Vec<Row>,
    plots: Vec<Plot>,
}

impl<'a> Charts<'a> {
    pub(super) fn new(subject: &'a Subject<'a>, moments: &'a Moments) -> Self {
        let told = subject.snapshots.iter().any(|snapshot| snapshot.command != Command::default());
        let speed = told.then(|| speed(subject));
        let plots = speed.into_iter().chain([pitch(subject), height(subject)]).collect();
        Self { subject, moments, panels: panels(subject.duration()), rows: footfalls::rows(subject), plots }
    }

    /// px.
    pub(super) fn height(&self) -> f32 {
        let footfalls = if self.rows.is_empty() { 0.0 } else { LINE + self.rows_height() + TIMES + GAP };
        LINE + footfalls + self.plots.len() as f32 * (LINE + PLOT + TIMES + GAP) - GAP
    }

    fn rows_height(&self) -> f32 {
        self.rows.len() as f32 * ROW + 6.0
    }

    pub(super) fn draw(&self, sheet: &mut Canvas, top: f32) {
        self.draw_names(sheet, top);
        let mut top = top + LINE;
        if !self.rows.is_empty() {
            let title = "footfalls: a bar while the part touches the ground";
            sheet.text(title, Style::Label, [MARGIN, top], Anchor::Left, INK);
            top += LINE;
            self.draw_footfalls(sheet, top);
            top += self.rows_height() + TIMES + GAP;
        }
        for plot in &self.plots {
            sheet.text(&plot.title, Style::Label, [MARGIN, top], Anchor::Left, INK);
            top += LINE;
            self.draw_plot(sheet, plot, top);
            top += PLOT + TIMES + GAP;
        }
    }

    /// The names of the panels, and what the band means.
    fn draw_names(&self, sheet: &mut Canvas, top: f32) {
        for panel in &self.panels {
            sheet.text(&panel.name, Style::Label, [panel.left, top], Anchor::Left, QUIET);
        }
        let (key, right) = ("time of the frames", WIDTH as f32 - MARGIN);
        let left = right - Style::Label.width(key);
        sheet.rectangle([left - 24.0, top + 4.0, 16.0, 14.0], BAND);
        sheet.text(key, Style::Label, [right, top], Anchor::Right, QUIET);
    }

    fn draw_footfalls(&self, sheet: &mut Canvas, top: f32) {
        let height = self.rows_height();
        self.panels.iter().for_each(|panel| self.draw_panel(sheet, panel, top, height));
        for (index, row) in self.rows.iter().enumerate() {
            let y = top + 3.0 + index as f32 * ROW;
            let ink = if row.alarming { ALARM } else { INK };
            let name = Style::Label.cut(&row.name, LABELS - 12.0);
            sheet.text(&name, Style::Label, [MARGIN + LABELS - 10.0, y + 1.0], Anchor::Right, ink);
            for panel in &self.panels {
                sheet.rectangle([panel.left, y + 0.5 * ROW - 0.5, panel.width, 1.0], GRID);
                for &[from, to] in row.spans.iter().filter(|[from, to]| *to > panel.time[0] && *from < panel.time[1]) {
                    let (left, right) = (panel.x(from), panel.x(to));
                    let ink = if row.alarming { ALARM } else { CONTACT };
                    sheet.rectangle([left, y + 4.0, (right - left).max(1.0), ROW - 8.0], ink);
                }
            }
        }
    }

    fn draw_plot(&self, sheet: &mut Canvas, plot: &Plot, top: f32) {
        let y = |value: f64| {
            let [low, high] = plot.range;
            top + PLOT * ((high - value) / (high - low)).clamp(0.0, 1.0) as f32
        };
        for (value, label) in &plot.marks {
            let at = [MARGIN + LABELS - 10.0, y(*value) - 0.5 * Style::Label.height()];
            sheet.text(label, Style::Label, at, Anchor::Right, QUIET);
        }
        for panel in &self.panels {
            self.draw_panel(sheet, panel, top, PLOT);
            for (value, _) in &plot.marks {
                sheet.rectangle([panel.left, y(*value) - 0.5, panel.width, 1.0], GRID);
            }
            for &limit in &plot.limits {
                sheet.dashed_line(&[[panel.left, y(limit)], [panel.right(), y(limit)]], 1.5, ALARM);
            }
            let [first, last] = panel.time.map(|time| self.subject.step_at(time));
            let curve = |values: &[f64]| {
                let points: Vec<(f32, f32)> =
                    (first..=last).map(|step| (panel.x(self.subject.time(step)), y(values[step]))).collect();
                thinned(&points)
            };
            if !plot.wanted.is_empty() {
                sheet.line(&curve(&plot.wanted), 6.0, QUIET);
            }
            sheet.line(&curve(&plot.values), 2.0, CURVE);
        }
    }

    /// Background, the time of the frames, and the time axis.
    fn draw_panel(&self, sheet: &mut Canvas, panel: &Panel, top: f32, height: f32) {
        sheet.rectangle([panel.left, top, panel.width, height], CARD);
        let [from, to] = self.moments.span.map(|time| panel.x(time));
        if to > from {
            sheet.rectangle([from, top, (to - from).max(1.0), height], BAND);
        }
        let times = ticks(panel.time, f64::from(panel.width / TIME_SPACING));
        for &time in &times.places {
            let x = panel.x(time);
            sheet.rectangle([x - 0.5, top, 1.0, height], GRID);
            sheet.rectangle([x - 0.5, top + height, 1.0, 5.0], QUIET);
            let label = format!("{} s", times.label(time));
            sheet.text(&label, Style::Label, [x, top + height + 5.0], Anchor::Middle, QUIET);
        }
        sheet.rectangle([panel.left, top + height - 0.5, panel.width, 1.0], QUIET);
    }
}

impl Panel {
    fn right(&self) -> f32 {
        self.left + self.width
    }

    /// Where a time is, px; one before or after the panel at its edge.
    fn x(&self, time: f64) -> f32 {
        let [from, to] = self.time;
        self.left + self.width * ((time - from) / (to - from)).clamp(0.0, 1.0) as f32
    }
}

/// The whole episode; beside it the last seconds of a long one.
fn panels(duration: f64) -> Vec<Panel> {
    let left = MARGIN + LABELS;
    // The last number of the time axis reaches beyond the panel.
    let room = WIDTH as f32 - MARGIN - 20.0 - left;
    let whole = |width| Panel { name: "the whole episode".into(), left, width, time: [0.0, duration] };
    if duration <= 1.2 * CLOSE_UP {
        return vec![whole(room)];
    }
    let width = (0.48 * (room - BETWEEN)).floor();
    let close_up = Panel {
        name: format!("its last {CLOSE_UP} s"),
        left: left + width + BETWEEN,
        width: room - BETWEEN - width,
        time: [duration - CLOSE_UP, duration],
    };
    vec![whole(width), close_up]
}

/// Degrees against the start, whole turns counted.
fn pitch(subject: &Subject<'_>) -> Plot {
    let mut values: Vec<f64> = Vec::with_capacity(subject.snapshots.len());
    let mut before = subject.snapshots[0].torso();
    for snapshot in subject.snapshots {
        let torso = snapshot.torso();
        let (sin, cos) =
            (before.cos * torso.sin - before.sin * torso.cos, before.cos * torso.cos + before.sin * torso.sin);
        values.push(values.last().unwrap_or(&0.0) + f64::from(libm::atan2f(sin, cos)).to_degrees());
        before = torso;
    }
    let [low, high] = extent(&values);
    let range = [(low - 5.0).min(-60.0), (high + 5.0).max(60.0)];
    // As far apart as need be for a handful.
    let step =
        (0..30).map(|doubling| PITCH * f64::from(1_u32 << doubling)).find(|step| (range[1] - range[0]) / step <= 5.0);
    let marks =
        multiples(range, step.unwrap_or(f64::MAX)).into_iter().map(|value| (value, format!("{:.0}°", value + 0.0)));
    Plot {
        title: format!("torso pitch against the start, degrees; nose up: positive; dashed: ± {PITCH}°"),
        values,
        wanted: Vec::new(),
        range,
        marks: marks.collect(),
        limits: vec![-PITCH, PITCH],
    }
}

fn height(subject: &Subject<'_>) -> Plot {
    let water = subject.in_water();
    let start = f64::from(subject.snapshots[0].torso().y);
    let height = |y: f64| {
        if water { (y - start) / f64::from(subject.blueprint.body_length()) } else { y / subject.start_height() }
    };
    let values: Vec<f64> = subject.snapshots.iter().map(|snapshot| height(f64::from(snapshot.torso().y))).collect();
    let [low, high] = extent(&values);
    let usual = if water { [-0.5, 0.5] } else { [0.8, 1.2] };
    let range = [(low - 0.02).min(usual[0]), (high + 0.02).max(usual[1])];
    let marks = ticks(range, 4.0);
    let suffix = if water { "" } else { " ×" };
    let title = if water { "torso height above the start, body lengths" } else { "torso height, in start heights" };
    Plot {
        title: title.into(),
        values,
        wanted: Vec::new(),
        range,
        marks: marks.places.iter().map(|&value| (value, format!("{}{suffix}", marks.label(value)))).collect(),
        limits: Vec::new(),
    }
}

/// The forward speed of the torso as a mean over half a second, and the one it is told.
fn speed(subject: &Subject<'_>) -> Plot {
    let length = f64::from(subject.blueprint.body_length());
    let half = ((0.25 / subject.report.time_step).round() as usize).max(1);
    let mean = |step: usize| {
        let (from, to) = (step.saturating_sub(half), (step + half).min(subject.last()));
        let way = f64::from(subject.snapshots[to].torso().x) - f64::from(subject.snapshots[from].torso().x);
        way / ((to - from).max(1) as f64 * subject.report.time_step) / length
    };
    let values: Vec<f64> = (0..=subject.last()).map(mean).collect();
    let wanted: Vec<f64> = subject.snapshots.iter().map(|snapshot| snapshot.command.speed.into()).collect();
    let ([low, high], [least, most]) = (extent(&values), extent(&wanted));
    let range = [low.min(least).min(0.0) - 0.1, high.max(most).max(0.5) + 0.1];
    let marks = ticks(range, 4.0);
    Plot {
        title: "speed, body lengths/s; thick: as told".into(),
        values,
        wanted,
        range,
        marks: marks.places.iter().map(|&value| (value, marks.label(value))).collect(),
        limits: Vec::new(),
    }
}

fn extent(values: &[f64]) -> [f64; 2] {
    values.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &value| [low.min(value), high.max(value)])
}

/// The same curve with no more than two points in a column of pixels: the highest and the lowest.
fn thinned(points: &[(f32, f32)]) -> Vec<[f32; 2]> {
    let columns = points.chunk_by(|one, other| one.0.floor() == other.0.floor());
    let ends = |column: &[(f32, f32)]| match column {
        [(x, y)] => vec![[*x, *y]],
        _ => {
            let x = column[0].0;
            let low = column.iter().map(|point| point.1).fold(f32::INFINITY, f32::min);
            let high = column.iter().map(|point| point.1).fold(f32::NEG_INFINITY, f32::max);
            // In the order the curve comes to them, nearly: from the side it enters.
            if column[0].1 <= column[column.len() - 1].1 {
                vec![[x, low], [x, high]]
            } else {
                vec![[x, high], [x, low]]
            }
        }
    };
    columns.flat_map(ends).collect()
}
