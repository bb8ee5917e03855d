//! The champion's gait for the page.

use serde::Serialize;
use tasks::gait::{GaitReport, Kind};

/// A gait report with what only Rust can say of it.
#[derive(Serialize)]
pub(super) struct GaitData {
    #[serde(flatten)]
    report: GaitReport,
    /// What speaks against it, in words.
    against: Vec<String>,
    /// What the audit flagged, in words.
    flagged: Vec<String>,
    /// From when to when speed and rhythm are measured, s.
    window_s: [f64; 2],
}

impl From<GaitReport> for GaitData {
    fn from(report: GaitReport) -> Self {
        let reasons = report.verdict.iter().flat_map(|verdict| &verdict.reasons);
        let from = if report.kind == Some(Kind::Jumping) { 0.0 } else { 0.5 * report.duration };
        Self {
            against: reasons.map(ToString::to_string).collect(),
            flagged: report.cheats.iter().map(ToString::to_string).collect(),
            window_s: [from, report.duration],
            report,
        }
    }
}
