//! The head of the sheet: whose gait it is, the verdict with its first reasons, and how fast or how high.

use super::{MARGIN, Subject, WIDTH};
use crate::drawing::{
    canvas::{ALARM, Canvas, GOOD, INK, Ink, QUIET},
    text::{Anchor, Style},
};
use tasks::gait::Goal;

/// How many reasons are given.
const REASONS: usize = 3;
const TITLE: f32 = 32.0;
const LINE: f32 = 24.0;

/// The text at the top.
pub(super) struct Heading {
    name: String,
    verdict: (&'static str, Ink),
    /// How fast it is, or how high.
    figure: String,
    reasons: Vec<String>,
}

impl Heading {
    pub(super) fn new(subject: &Subject<'_>) -> Self {
        let report = subject.report;
        let movement = subject.movement.map_or_else(String::new, |movement| format!(" {movement}"));
        let all: Vec<String> = match &report.verdict {
            Some(verdict) => verdict.reasons.iter().map(ToString::to_string).collect(),
            None => report.cheats.iter().map(ToString::to_string).collect(),
        };
        let mut reasons: Vec<String> = all.iter().take(REASONS).cloned().collect();
        if let (Some(last), more @ 1..) = (reasons.last_mut(), all.len().saturating_sub(REASONS)) {
            last.push_str(&format!("; and {more} more"));
        }
        Self {
            name: format!("{}{movement}", subject.blueprint.name()),
            verdict: match &report.verdict {
                None => ("not judged", QUIET),
                Some(verdict) if verdict.usable => ("usable", GOOD),
                Some(_) => ("not usable", ALARM),
            },
            figure: figure(subject),
            reasons,
        }
    }

    /// px.
    pub(super) fn height(&self) -> f32 {
        TITLE + self.reasons.len() as f32 * LINE
    }

    pub(super) fn draw(&self, sheet: &mut Canvas, top: f32) {
        let (verdict, ink) = self.verdict;
        let right = WIDTH as f32 - MARGIN;
        sheet.text(&self.figure, Style::Title, [right, top], Anchor::Right, INK);
        let end = Style::Title.width(&format!(": {verdict}  {}", self.figure));
        let name = format!("{}: ", Style::Title.cut(&self.name, right - MARGIN - end));
        sheet.text(&name, Style::Title, [MARGIN, top], Anchor::Left, INK);
        sheet.text(verdict, Style::Title, [MARGIN + Style::Title.width(&name), top], Anchor::Left, ink);
        for (index, reason) in self.reasons.iter().enumerate() {
            let reason = Style::Label.cut(&format!("- {reason}"), right - MARGIN);
            let y = top + TITLE + index as f32 * LINE;
            sheet.text(&reason, Style::Label, [MARGIN, y], Anchor::Left, ink);
        }
    }
}

fn figure(subject: &Subject<'_>) -> String {
    let report = subject.report;
    if report.view.goal == Goal::Distance {
        return format!("{:.2} body lengths/s in the second half", report.travel.second_half_relative_speed);
    }
    match report.best_flight().map(|flight| flight.rise).or(report.aloft.highest) {
        Some(rise) => format!("rises by {:.2} × its start height", rise / subject.start_height()),
        None => "never off the ground".into(),
    }
}
